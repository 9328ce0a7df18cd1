"""The scene of docs/first.toml, and its ball and start for other runs."""

from pathlib import Path

FIRST = Path(__file__).parents[1] / "docs" / "first.toml"
#: Everything up to the keys of [run].
BALL = FIRST.read_text(encoding="utf-8").partition("time_step")[0]

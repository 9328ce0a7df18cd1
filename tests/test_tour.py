"""The notebook of the docs runs, and its stored outputs are what it prints and draws."""

import builtins
import re
import sys
from pathlib import Path

import nbformat
import pytest
from IPython.core.displayhook import CapturingDisplayHook
from IPython.core.interactiveshell import InteractiveShell
from IPython.utils.capture import capture_output
from nbclient import NotebookClient
from nbformat import NotebookNode
from nbformat.v4 import new_output
from traitlets.config import Config
from waiting import GUARD

TOUR = Path(__file__).parents[1] / "docs" / "tour.ipynb"


def executed(notebook):
    """A notebook with the outputs of this run; numbers of executions, but no times and no ids of the session."""
    fresh = nbformat.from_dict(notebook)
    for cell in fresh.cells:
        if cell.cell_type == "code":
            cell.outputs, cell.execution_count = [], None
    NotebookClient(fresh, timeout=GUARD, startup_timeout=GUARD, kernel_name="python3", record_timing=False).execute()
    return fresh


def shown(cell):
    """What a reader sees of the outputs of a cell: texts, and the pictures' kinds."""
    found = []
    for output in cell.outputs:
        if output.output_type == "stream":
            found.append(output.text)
        else:
            data = output.data
            if "text/html" in data:
                html = re.sub(r"<svg.*</svg>", "picture", data["text/html"], flags=re.DOTALL)
                found.append(re.sub(r"<iframe.*</iframe>", "page", html, flags=re.DOTALL))
            elif "image/svg+xml" in data:
                found.append("picture")
            else:
                found.append(data["text/plain"])
    # Roundoff differs from one processor to another, its size does not.
    return [re.sub(r"\d\.\de-1[4-6]", "~1e-15", text) for text in found]


@pytest.fixture(scope="module")
def tour():
    return nbformat.read(TOUR, as_version=4)


def test_the_tour_runs_and_shows_what_is_stored(tour, monkeypatch):
    """In IPython itself: a kernel is only needed to write the outputs anew."""
    monkeypatch.setitem(sys.modules, "__main__", sys.modules["__main__"])  # which IPython replaces by its own
    for name in ("__IPYTHON__", "display"):
        monkeypatch.setattr(builtins, name, None, raising=False)
    shell = InteractiveShell(config=Config({"HistoryManager": {"enabled": False}}))
    for stored in tour.cells:
        if stored.cell_type == "code":
            results = []
            shell.display_trap.hook = CapturingDisplayHook(shell, results)
            with capture_output(display=False) as printed:
                shell.run_cell(stored.source).raise_error()
            now = [new_output("stream", text=printed.stdout)] * bool(printed.stdout)
            now += [new_output("execute_result", one["data"]) for one in results]
            assert shown(stored) == shown(NotebookNode(outputs=now)), stored.source


def test_every_cell_of_the_tour_has_its_outputs_stored(tour):
    silent = [cell.source for cell in tour.cells if cell.cell_type == "code" and not cell.outputs]
    assert not silent
    pictures = str(tour.cells).count("<svg ")
    assert pictures == 5
    assert TOUR.stat().st_size < 1_000_000
    assert not re.search(r"/(home|root|tmp|work)/", TOUR.read_text(encoding="utf-8"))


if __name__ == "__main__":  # python tests/test_tour.py writes the outputs anew
    nbformat.write(executed(nbformat.read(TOUR, as_version=4)), TOUR)

"""The page in the browser: its Python needs the standard library alone, and runs in Pyodide, where that is here."""

import functools
import http.server
import json
import math
import re
import runpy
import subprocess
import sys
import threading
import zipfile

import pages
import pytest
from waiting import until

import chapsym

PYODIDE = pages.ROOT / "docs" / "_build" / "pyodide"
MISSING = "no Pyodide in docs/_build/pyodide: docs/in-browser.md says how to put it there"
GIVEN = {"inertia": ".006, .007, .009", "mass": "2", "radius": ".1", "omega": "3, -2, 1", "time": "2", "step": ".05"}


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """What the page loads, and the page with its forms alone."""
    folder = tmp_path_factory.mktemp("site")
    runpy.run_path(str(pages.ROOT / "docs/browser/make.py"))["write"](folder / "browser")
    page = (pages.ROOT / "docs/in-browser.md").read_text(encoding="utf-8")
    forms = "".join(block.text for block in pages.blocks(page) if block.kind == "{raw} html")
    (folder / "index.html").write_text(f"<!doctype html><meta charset=utf-8>{forms}", encoding="utf-8")
    return folder


@pytest.fixture(scope="module")
def call(site):
    """Calls what the page calls, by a Python without any package."""
    with zipfile.ZipFile(site / "browser" / "chapsym.zip") as packed:
        packed.extractall(site / "python")
    program = "import sys; sys.path.append('.'); import in_browser; print(in_browser.called(*sys.argv[1:]))"

    def answer(name, **given):
        command = [sys.executable, "-S", "-I", "-c", program, name, json.dumps(given)]
        done = subprocess.run(command, capture_output=True, text=True, cwd=site / "python", check=False)
        assert done.stderr == ""
        return json.loads(done.stdout)

    return answer


def rolled():
    """Where the ball of GIVEN touches the plane at the end."""
    ball = chapsym.Ball.from_inertia((0.006, 0.007, 0.009), mass=2.0, radius=0.1)
    return chapsym.roll(ball, (3, -2, 1), 0.05, 40, contact=True, map=True).contact[-1].tolist()


def test_a_ball_is_rolled_by_the_standard_library_as_by_chapsym(call):
    said = call("roll", **GIVEN)["said"][0]
    assert "({:.4f}, {:.4f}) m".format(*rolled()) in said


@pytest.mark.parametrize(
    ("name", "value", "said"),
    [
        ("inertia", "1, 2", "inertia must be 3 numbers"),
        ("inertia", "1, 2, 4", "no body has such moments"),
        ("mass", "-1", "mass must be positive"),
        ("omega", "1, nan, 2", "omega must be 3 numbers"),
        ("step", "1e-9", "from 1 to 20000 steps, not 2000000000"),
        ("omega", "300, 200, 1", "take a shorter step"),
        ("radius", "1e200", "too large or too small"),
    ],
)
def test_what_no_ball_has_is_answered_by_a_sentence(call, name, value, said):
    assert said in call("roll", **GIVEN | {name: value})["error"]


@pytest.mark.parametrize("claim", ["4.1", "4.6"])  # alone, and with others that it uses
def test_a_claim_is_judged_by_the_standard_library(call, claim):
    found = call("judge", claim=claim)
    assert found["said"][0] == f"certificates/register/{claim}.json: accepted (register-claim)"
    assert found["formulas"][0].startswith("printed: ")


def test_the_claims_of_the_list_are_all_that_have_a_certificate(site):
    claims = json.loads((site / "browser" / "claims.json").read_text())
    assert len(claims) == len(list((pages.ROOT / "proofs/certificates/register").glob("*.json")))


@pytest.fixture
def served(site):
    """The address of the page on a server, with Pyodide's files."""
    if not (PYODIDE / "pyodide.mjs").exists():
        pytest.skip(MISSING)
    if not (site / "pyodide").exists():
        (site / "pyodide").symlink_to(PYODIDE)

    class Silent(http.server.SimpleHTTPRequestHandler):
        def log_message(self, *_):
            pass

    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Silent, directory=site)) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}/"
        server.shutdown()


def test_the_page_rolls_a_ball_and_judges_a_claim_in_a_browser(served, tabs):
    tab = tabs(webgl=True, offline=False).tab
    asked = []
    tab.on("request", lambda request: asked.append(request.url))
    tab.goto(served)

    def answer(name, place):
        """What is said under the button of this name when it is pressed."""
        tab.get_by_role("button", name=name).click()
        said = tab.get_by_role("status").nth(place)
        until(lambda: said.inner_text() not in ("", "…"))
        return said.inner_text()

    for name, value in GIVEN.items():
        tab.locator(f"[name={name}]").fill(value)
    assert "D = 0.02 kg m²" in answer("Roll", 0)
    frame = tab.frame_locator("iframe.rolling")
    frame.locator("canvas").wait_for()
    assert frame.locator(".plan").inner_text() == "40 steps of 0.05 s, the map of the paper"
    end = frame.locator(":root").evaluate("chapsym.position(40)")
    assert math.dist(end, rolled()) < 1e-13
    tab.locator("select").select_option("4.1")
    assert ": accepted (register-claim)" in answer("Judge", 1)
    tab.locator("[name=mass]").fill("many")
    assert answer("Roll", 0) == "mass must be a number"
    assert not [url for url in asked if not re.match(rf"{served}|data:|about:", url)]

"""The rolling ball in a real browser, from disk and offline: it moves, as it should, on a desk and on a phone."""

import io
import re
from itertools import product

import numpy as np
import pytest
from budget import slow
from contrast import contrast, low
from matplotlib import image
from results import BALL, EVEN, rolled
from shown import DESK, PHONE
from waiting import until

from chapsym.dynamics import Status, kernels
from chapsym.show.result import Result
from chapsym.show.rolling import write_page
from chapsym.show.rolling.motion import TOO_FAR, motion
from chapsym.show.rolling.page import FOLDER

#: As wide as a desk, for the page, and small: the picture is drawn without a graphics card.
SMALL = {"width": 800, "height": 500}
SINGLE = float(np.finfo(np.float32).eps)


class Rolling:
    """A page with its ball, which is at rest until it is words to roll."""

    def __init__(self, shown):
        self.tab, self.drawn, self.ask, self.said = shown.tab, shown.drawn, shown.ask, shown.said

    def until(self, text):
        """Waits until an expression is true; the page forbids the `eval` of playwright's own waiting."""
        until(lambda: self.drawn() or self.ask(text))

    def picture(self):
        self.drawn()
        return self.tab.locator("canvas").screenshot()


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    """Pages of one ball and of three, and what they show."""
    folder = tmp_path_factory.mktemp("rolling")
    one = rolled(600)
    three = rolled(400, omega=[(3.0, 4.0 + i, 10.0) for i in range(3)], every=4, title="Three starts")
    for name in ("momentum", "gamma", "omega", "attitude", "contact"):
        three[name][2, 51:] = np.nan
    three["taken"][2], three["status"][2] = 200, Status.FOLDED
    write_page(one, folder / "one.html")
    write_page(three, folder / "three.html")
    return {"one": (folder / "one.html", one), "three": (folder / "three.html", three)}


@pytest.fixture
def rolling(opened, results):
    """Opens a page: one of the results, or a file; without WebGL, which takes most of the time, no ball is drawn."""

    def open_page(page="one", size=SMALL, webgl=True, **options):
        path = results[page][0] if page in results else page
        shown = opened(path, size, webgl, **({"reduced_motion": "reduce"} | options))
        shown.said[:] = [text for text in shown.said if webgl or not text.startswith("THREE.WebGLRenderer: ")]
        return Rolling(shown)

    return open_page


def test_play_moves_the_ball(rolling):
    page = rolling()
    assert page.ask("[chapsym.playing, chapsym.frame, chapsym.stage.eye.share]") == [False, 0, 1]
    before, place = page.picture(), page.ask("chapsym.position(chapsym.frame)")
    page.tab.get_by_role("button", name="Play").click()
    page.until("chapsym.frame > 60")
    page.tab.get_by_role("button", name="Pause").click()
    assert page.ask("chapsym.playing") is False
    assert page.picture() != before
    after = page.ask("chapsym.position(chapsym.frame)")
    assert np.hypot(*np.subtract(after, place)) > 0.02
    stopped = page.ask("chapsym.frame")
    page.drawn()
    assert page.ask("chapsym.frame") == stopped
    clock = page.tab.locator("#now").inner_text()
    assert clock == f"{page.ask('chapsym.motion.timeAt(chapsym.frame).toFixed(3)')} / 3.000 s"


def test_what_is_drawn_is_what_was_computed_between_the_frames_too_and_in_body_axes(rolling, results):
    page, ball = rolling(), motion(results["one"][1]).balls[0]
    positions = page.ask("Array.from({length: 601}, (_, i) => chapsym.position(i))")
    np.testing.assert_array_equal(positions, ball.contact)
    quaternions = page.ask("Array.from({length: 601}, (_, i) => chapsym.quaternion(i))")
    np.testing.assert_allclose(quaternions, ball.attitude, rtol=0, atol=2 * SINGLE)
    page.ask("chapsym.seek(321.25)")
    page.drawn()
    drawn = page.ask(
        """(() => { const { balls: [one], anchor } = chapsym.stage;
           const { x, y } = one.group.position, q = one.body.quaternion;
           return [x + anchor[0], y + anchor[1], one.body.position.z, q.w, q.x, q.y, q.z]; })()"""
    )
    asked = page.ask("[...chapsym.position(321.25), 0.11, ...chapsym.quaternion(321.25)]")
    np.testing.assert_allclose(drawn, asked, rtol=0, atol=1e-14)
    # Arrows: γ stands upright, 𝒦 stays where it is, ω has its length; in body axes they all turn.
    found = page.ask(
        """(() => { const [ball] = chapsym.motion.balls, at = [0, 150.5, 600];
           return ['gamma', 'momentum', 'omega'].map(name => at.map(i => ball.inSpace(name, i).toArray())); })()"""
    )
    gamma, momentum, omega = map(np.array, found)
    np.testing.assert_allclose(gamma, np.tile([0, 0, 1], (3, 1)), atol=8 * SINGLE)
    size = np.linalg.norm(ball.vectors["momentum"][0])
    np.testing.assert_allclose(momentum, np.tile(momentum[0], (3, 1)), atol=8 * SINGLE * size)
    lengths = np.linalg.norm(ball.vectors["omega"], axis=1)
    np.testing.assert_allclose(np.linalg.norm(omega[[0, 2]], axis=1), lengths[[0, -1]], rtol=8 * SINGLE)
    assert np.ptp(ball.vectors["momentum"], axis=0).max() > 0.1 * size

    # Between the frames ẋ = ρ ω × e₃ sin φ/φ: the discrete ball goes ρ sin φ where it turns by φ (4.9).
    at = [i + s for i in (0, 100, 377, 599) for s in (0.05, 0.5)]
    h = 0.4
    found = page.ask(f"{at}.map(i => [i, i + {h}].map(j => [chapsym.position(j), chapsym.quaternion(j)]))")
    for (r0, q0), (r1, q1) in found:
        turn = kernels.compose(np.array(q1), np.array(q0) * [1, -1, -1, -1])
        turn *= np.sign(turn[0])
        angle = 2 * np.arcsin(np.linalg.norm(turn[1:]))
        axis = turn[1:] / np.linalg.norm(turn[1:])
        step = angle / h
        way = 0.11 * np.cross(axis, [0, 0, 1])[:2] * h * np.sin(step)
        # The attitudes are known to float32, both of them.
        np.testing.assert_allclose(np.subtract(r1, r0), way, rtol=0, atol=0.11 * 8 * SINGLE)
        assert np.hypot(*way) > 1000 * 0.11 * 8 * SINGLE

    # On the sphere, in body axes: octants by the sign of xyz, and marks that are dark at the positive ends.
    shades = page.ask(
        """(() => {
          const mesh = chapsym.stage.balls[0].body.children[0], { position, uv } = mesh.geometry.attributes;
          const image = mesh.material.map.image;
          const pixels = image.getContext('2d').getImageData(0, 0, image.width, image.height).data;
          return Array.from({ length: position.count }, (_, i) => {
            const at = (share, count) => Math.min(Math.floor(share * count), count - 1);
            const x = at(uv.getX(i), image.width), y = at(1 - uv.getY(i), image.height);
            return [position.getX(i), position.getY(i), position.getZ(i), pixels[4 * (y * image.width + x)]];
          });
        })()"""
    )
    points, shade = np.array(shades)[:, :3], np.array(shades)[:, 3]
    size = np.sort(np.abs(points), axis=1)
    octants = (size[:, 0] > 0.1) & (size[:, 2] < 0.93)
    assert octants.sum() > 1000
    np.testing.assert_array_equal(shade[octants], np.where(points[octants].prod(axis=1) > 0, 255, 150))
    beside = np.sqrt(1 - size[:, 2] ** 2) / 0.25  # of the number, and inside the rim
    for axis in range(3):
        for sign, colour in ((1, 30), (-1, 255)):
            marks = (sign * points[:, axis] == size[:, 2]) & (beside > 0.68) & (beside < 0.84)
            assert marks.any()
            assert set(shade[marks]) == {colour}


def test_scrub_and_keys(rolling):
    page = rolling()
    slider = page.tab.get_by_role("slider", name="Time")
    slider.fill("1.5")
    assert page.ask("chapsym.frame") == pytest.approx(300)
    assert slider.get_attribute("aria-valuetext") == "1.500 s"
    assert page.tab.locator("[data-read=time]").inner_text() == "1.500 s"
    press = page.tab.keyboard.press
    for key, frame in [("Home", 0), ("ArrowRight", 6), ("Shift+ArrowRight", 7), ("Shift+ArrowLeft", 6), ("End", 600)]:
        press(key)
        assert page.ask("chapsym.frame") == pytest.approx(frame, abs=1e-9), key
    pace = page.tab.locator("#speed")
    before = pace.inner_text()
    press("+")
    press("+")
    faster = pace.inner_text()
    press("-")
    press("-")
    assert (before, pace.inner_text(), faster == before) == (before, before, False)
    for key, mode in [("t", "top"), ("o", "free"), ("f", "follow")]:
        press(key)
        assert page.tab.locator("[data-look][aria-pressed=true]").get_attribute("data-look") == mode
    view = "chapsym.stage.camera.position.toArray()"
    page.ask("chapsym.stage.camera.position.multiplyScalar(2)")
    moved = page.ask(view)
    press("r")
    assert page.ask(view) != moved
    press("?")
    assert page.tab.get_by_role("dialog").is_visible()
    press("Escape")
    assert not page.tab.get_by_role("dialog").is_visible()
    press("Home")
    press("Space")
    assert page.ask("chapsym.playing") is True


def test_the_camera_follows_the_ball_or_stays(rolling):
    page = rolling()
    where = "chapsym.stage.balls[0].group.position.toArray().slice(0, 2)"
    page.ask("chapsym.seek(500)")
    page.drawn()
    assert np.abs(page.ask(where)).max() < 1e-9
    page.tab.get_by_role("button", name="Orbit").click()
    page.ask("chapsym.seek(0)")
    page.drawn()
    assert np.hypot(*page.ask(where)) > 0.5
    page.tab.get_by_role("button", name="Top").click()
    page.drawn()
    page.ask("chapsym.stage.camera.updateMatrixWorld()")
    corners = page.ask(
        """[0, 600].map(i => { const [x, y] = chapsym.position(i), { anchor, camera } = chapsym.stage;
           const place = camera.position.clone().set(x - anchor[0], y - anchor[1], 0);
           return place.project(camera).toArray().slice(0, 2); })"""
    )
    assert np.abs(corners).max() < 1


def test_a_mouse_turns_the_view_moves_it_along_the_plane_and_a_wheel_brings_it_nearer(rolling):
    """What is grabbed on the plane stays under the hand; from the top nothing turns; the eye stays above the plane."""
    page = rolling()
    mouse = page.tab.mouse
    look = "(({ azimuth, polar, distance, anchor }) => [azimuth, polar, distance, ...anchor])(chapsym.stage.eye)"
    height = page.ask("document.querySelector('canvas').clientHeight")

    def drag(x, y, **options):
        before = np.array(page.ask(look))
        mouse.move(300, 250)
        mouse.down(**options)
        mouse.move(300 + x / 2, 250 + y / 2)
        mouse.move(300 + x, 250 + y)
        mouse.up(**options)
        page.drawn()
        return np.array(page.ask(look)) - before

    assert drag(50, -20) == pytest.approx(np.array([-100, 40, 0, 0, 0]) * np.pi / height)
    assert drag(0, -2000)[1] > 0
    assert page.ask("chapsym.stage.camera.position.z") > 0
    page.tab.keyboard.press("r")
    assert drag(70, 0)[0] != 0

    def moved(x, y):
        azimuth, _, distance, *_ = page.ask(look)
        seen = 2 * distance * np.tan(np.deg2rad(19)) / height
        right, ahead = (-np.sin(azimuth), np.cos(azimuth)), (-np.cos(azimuth), -np.sin(azimuth))
        return [0, 0, 0, *(seen * (y * np.array(ahead) - x * np.array(right)))]

    assert drag(40, 30, button="right") == pytest.approx(moved(40, 30), abs=1e-6)
    page.tab.keyboard.press("t")
    page.drawn()
    assert drag(40, 30) == pytest.approx(moved(40, 30), abs=1e-6)
    near = page.ask("chapsym.stage.eye.distance")
    mouse.wheel(0, -300)
    page.until(f"chapsym.stage.eye.distance < {near}")
    assert page.ask("chapsym.stage.eye.distance") == pytest.approx(near * 0.95**3)


def test_unless_motion_is_unwelcome_it_plays_at_once_to_its_end_and_a_turn_of_the_view_comes_to_rest_softly(rolling):
    page = rolling(reduced_motion="no-preference")
    assert page.ask("chapsym.playing") is True
    look = "(({ azimuth, turn, share }) => [azimuth, turn.x, share])(chapsym.stage.eye)"
    start, _, _ = page.ask(look)
    page.tab.mouse.move(300, 250)
    page.tab.mouse.down()
    page.tab.mouse.move(400, 250)
    page.tab.mouse.up()
    page.until("chapsym.stage.eye.turn.x > 0")
    (first, left, share), _, (later, less, _) = page.ask(look), page.drawn(), page.ask(look)
    assert share == 0.05
    assert later < first <= start
    assert 0 < less < left
    whole = 200 * np.pi / page.ask("document.querySelector('canvas').clientHeight")
    assert start - later + less == pytest.approx(whole)
    page.ask("chapsym.seek(597)")
    page.until("!chapsym.playing")
    assert page.ask("chapsym.frame") == 600
    page.tab.keyboard.press("Space")
    assert page.ask("chapsym.playing && chapsym.frame < 300") is True


def test_many_balls_are_followed_hidden_and_stop_and_every_control_has_a_name_and_can_be_focused(rolling):
    page = rolling("three")
    assert page.tab.locator("h1").inner_text() == "Three starts"
    assert page.tab.locator(".plan").inner_text() == "model: full · 400 steps of 0.005 s · 3 balls"
    assert "ball 3: it stops after step 200: the small-rotation branch folds" in page.tab.locator(".notes").inner_text()
    page.ask("chapsym.seek(80)")
    assert page.ask("chapsym.position(80, 2)") == page.ask("chapsym.position(50, 2)")
    seen = page.tab.locator(".balls em").evaluate_all("found => found.map(x => x.checkVisibility())")
    assert seen == [False, False, True]
    names = page.ask(
        """[...document.querySelectorAll('button, input, summary')].filter(x => x.checkVisibility())
           .map(x => x.getAttribute('aria-label') || x.textContent.trim() || '')"""
    )
    assert len(names) > 15
    assert all(names)
    reached = set()
    for _ in range(40):
        page.tab.keyboard.press("Tab")
        reached.add(page.ask("(document.activeElement.ariaLabel || document.activeElement.textContent.trim())"))
    assert {"Play", "Time", "Slower", "Faster", "Orbit", "Top", "Whole trace", "Help", "Show ball 2"} <= reached
    before = page.tab.locator("[data-read=position]").inner_text()
    page.tab.get_by_role("radio", name="Follow ball 2").check()
    assert page.tab.locator("[data-read=position]").inner_text() != before
    shown = page.picture()
    page.tab.get_by_role("checkbox", name="Show ball 1").uncheck()
    page.tab.get_by_role("checkbox", name="Show ball 2").uncheck()
    assert page.picture() != shown
    page.tab.get_by_role("radio", name="Follow ball 3").check()
    page.ask("chapsym.seek(50)")
    assert "rad/s" in page.tab.locator("[data-read=speed]").inner_text()
    page.ask("chapsym.seek(80)")
    assert page.tab.locator("[data-read=speed]").inner_text() == "stopped"
    assert page.tab.locator("[data-read=position]").inner_text() != ""
    assert page.ask("chapsym.quaternion(80, 2)") == page.ask("chapsym.quaternion(50, 2)")
    assert page.ask("chapsym.stage.balls[2].group.visible")


def test_a_ball_that_stops_is_the_end_of_its_page(rolling, tmp_path):
    alone = rolled(400, every=4)
    for name in ("momentum", "gamma", "omega", "attitude", "contact"):
        alone[name][0, 51:] = np.nan
    alone["taken"][0], alone["status"][0] = 200, Status.FOLDED
    write_page(alone, tmp_path / "alone.html")
    page = rolling(tmp_path / "alone.html")
    page.tab.keyboard.press("End")
    assert page.tab.locator("#now").inner_text() == "1.000 / 1.000 s"
    assert page.ask("chapsym.position(1e9)") == pytest.approx(alone["contact"].values[0, 50])
    assert "NaN" not in page.tab.locator("body").inner_text()


def test_in_a_notebook_the_page_stands_below_the_table_and_the_ball_rolls_there(rolling, results, tmp_path):
    """Without network, in a frame of its own that nothing reaches: as a notebook's cell shows its result."""
    shown = Result(results["one"][1])._repr_html_()
    assert len(shown) < 900_000
    (tmp_path / "cell.html").write_text(f"<!doctype html><meta charset=utf-8><body>{shown}", encoding="utf-8")
    page = rolling(tmp_path / "cell.html")
    assert page.tab.locator("table, svg").first.is_visible()
    frame = page.tab.locator("iframe")
    frame.scroll_into_view_if_needed()
    inner = frame.element_handle().content_frame()
    until(lambda: inner.evaluate("Boolean(window.chapsym && chapsym.stage)"))
    inner.evaluate("chapsym.seek(100)")
    assert inner.evaluate("chapsym.position(100)") == pytest.approx(results["one"][1]["contact"].values[0, 100])
    assert inner.evaluate("document.documentElement.scrollWidth <= innerWidth")
    page.drawn(inner)
    until(lambda: pixels(frame.screenshot()).std() > 0.1)  # the browser shows a frame after it is drawn
    assert page.ask("(() => { try { return Boolean(frames[0].chapsym); } catch { return 'closed'; } })()") == "closed"


def test_a_page_too_large_for_a_notebook_is_left_out_and_says_where_to_write_it(results, monkeypatch):
    monkeypatch.setattr("chapsym.show.rolling.page.MOST", 1000)
    shown = Result(results["one"][1])._repr_html_()
    assert "<iframe" not in shown
    assert "too large to stand here: write it with <code>page(path)</code>" in shown
    assert "<iframe" not in Result(results["one"][1].drop_vars("attitude"))._repr_html_()


def pixels(png):
    """The colours of a picture, (rows, columns, 3)."""
    return image.imread(io.BytesIO(png))[..., :3]


def boxes_apart(page):
    """No two of the page's parts overlap, and none is wider than the window."""
    width = page.tab.viewport_size["width"]  # a phone's innerWidth grows with what does not fit
    parts = page.ask(
        """['h1', '.plan', '.notes', '.stage', '.readout', '.balls', '.clock', '.tools']
           .map(name => document.querySelector(name))
           .filter(x => x && x.checkVisibility()).map(x => x.getBoundingClientRect().toJSON())"""
    )
    buttons = page.ask(
        "[...document.querySelectorAll('footer button, footer input')].map(x => x.getBoundingClientRect().toJSON())"
    )
    for group in (parts, buttons):
        for i, a in enumerate(group):
            assert a["left"] >= 0
            assert a["right"] <= width
            for b in group[:i]:
                across = min(a["right"], b["right"]) - max(a["left"], b["left"])
                along = min(a["bottom"], b["bottom"]) - max(a["top"], b["top"])
                assert min(across, along) <= 1, (a, b)
    assert page.ask("document.documentElement.scrollWidth") <= width
    return buttons


@pytest.mark.parametrize("name", ["three", *slow("one")])
def test_a_phone(rolling, name):
    """At 390 px nothing overlaps; a finger presses play, and one that drags turns the view."""
    page = rolling(name, PHONE, has_touch=True, is_mobile=True)
    buttons = boxes_apart(page)
    assert min(box["height"] for box in buttons) >= 44
    page.tab.get_by_role("button", name="Play").tap()
    page.until("chapsym.frame > 5")
    page.tab.get_by_role("button", name="Pause").tap()
    assert page.ask("document.querySelector('.stage').getBoundingClientRect().bottom <= innerHeight")
    eye = "chapsym.stage.camera.position.toArray()"
    before = page.ask(eye)
    fingers = page.tab.context.new_cdp_session(page.tab)
    for kind, points in [
        ("touchStart", [{"x": 150, "y": 250}]), ("touchMove", [{"x": 180, "y": 260}]),
        ("touchMove", [{"x": 230, "y": 270}]), ("touchEnd", []),
    ]:  # fmt: skip
        fingers.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})
    page.drawn()
    after = page.ask(eye)
    assert np.linalg.norm(np.subtract(after, before)) > 0.05
    distance = "chapsym.stage.eye.distance"
    near = page.ask(distance)
    for kind, gap in [("touchStart", 30), ("touchMove", 50), ("touchMove", 100)]:
        points = [{"x": 195 - gap, "y": 250, "id": 0}, {"x": 195 + gap, "y": 250, "id": 1}]
        fingers.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})
    fingers.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    page.drawn()
    assert page.ask(distance) < 0.7 * near


@pytest.mark.parametrize("size", [{"width": 900, "height": 700}, *slow(DESK)])
def test_nothing_overlaps_on_a_desk(rolling, size):
    boxes_apart(rolling("three", size))


@pytest.mark.parametrize("scheme", ["light", *slow("dark")])
def test_controls_and_letters_can_be_told_from_what_they_stand_on(rolling, scheme):
    """4.5 of every control in both states, of its border, and of the slider, whose parts no script can ask for."""
    page = rolling(color_scheme=scheme)
    used = "button, input, summary, label, output, dt, dd, kbd, h1, h2, p, li, em"
    for _ in range(2):
        found, count = low(page.tab, used)
        assert found == []
        assert count > 40
        page.tab.locator("[aria-pressed]").evaluate_all("all => all.forEach(x => x.click())")
    page.tab.keyboard.press("?")
    assert low(page.tab, "dialog *")[0] == []
    style = (FOLDER / "page.css").read_text(encoding="utf-8")
    sign = r"slider-runnable-track \{.*?to right, var\(--([a-z]+)\).*?var\(--([a-z]+)\) 0"
    track = re.findall(sign, style, re.DOTALL)[0]
    thumb = re.search(r"-webkit-slider-thumb \{.*?background: var\(--([a-z]+)\)", style, re.DOTALL)[1]
    named = product((*track, thumb, "link", "muted", "gamma", "omega", "momentum"), ("paper", "raised", "on", "plane"))
    for root, (name, ground) in product(re.findall(r":root \{(.*?)\}", style, re.DOTALL)[:2], list(named)):
        colours = dict(re.findall(r"--([a-z]+): (#[0-9a-f]{6});", root))
        assert contrast(colours[name], colours[ground]) >= 4.5, (name, ground)


def test_dark_and_light_and_arrows_that_are_shown_when_asked_for(rolling):
    page = rolling(color_scheme="dark")
    dark = page.picture()
    background = "getComputedStyle(document.body).backgroundColor"
    assert page.ask(background) == "rgb(20, 23, 26)"
    page.tab.emulate_media(color_scheme="light", reduced_motion="reduce")
    page.drawn()
    assert page.ask(background) == "rgb(252, 252, 250)"
    corner = (slice(4, 40), slice(4, 40))
    assert pixels(dark)[corner].mean() < 0.4 < 0.8 < pixels(page.picture())[corner].mean()
    page.ask("chapsym.seek(200)")
    before = page.picture()
    for name in ("γ, the vertical", "ω, the angular velocity", "K, the momentum"):
        button = page.tab.get_by_role("button", name=f"Arrow of {name}")
        button.click()
        assert button.get_attribute("aria-pressed") == "true"
        assert page.picture() != before
        button.click()
        page.tab.mouse.move(640, 5)
        assert page.picture() == before


def test_far_away_nothing_jitters(rolling, tmp_path):
    """50 000 km from the origin floats are 4 m apart; the ball, its trace and the eye stay together to a hair."""
    far = rolled(900)
    far["contact"] += 5e7
    write_page(far, tmp_path / "far.html")
    page = rolling(tmp_path / "far.html")
    for frame in (0.5, 511.5, 513.25, 899.5):
        page.ask(f"chapsym.seek({frame})")
        page.drawn()
        ball, tip = page.ask(
            """(() => { const { balls: [one], traces: [trace] } = chapsym.stage;
               const ends = trace.tip.geometry.attributes.ends.array;
               return [one.group.position.toArray().slice(0, 2),
                       [trace.tip.position.x + ends[2], trace.tip.position.y + ends[3]]]; })()"""
        )
        assert np.abs(ball).max() < 1e-4
        # What doubles resolve at 5e7.
        np.testing.assert_allclose(tip, ball, rtol=0, atol=2e-8)
        pieces = page.ask(
            """chapsym.stage.traces[0].pieces.map(p => [p.solid.position.x, p.origin[0] - chapsym.stage.anchor[0],
               Math.max(...p.solid.geometry.attributes.ends.array.map(Math.abs))])"""
        )
        for placed, wanted, longest in pieces:
            assert placed == wanted
            assert longest < 5


def test_a_ball_on_the_spot_has_no_way(rolling, tmp_path):
    write_page(rolled(50).drop_vars(["contact", "time"]), tmp_path / "spot.html")
    page = rolling(tmp_path / "spot.html")
    assert page.tab.locator("[data-read=position], #ghost").count() == 0
    assert page.tab.locator("#speed").inner_text() == "2 steps/s"
    page.tab.keyboard.press("End")
    assert page.tab.locator("[data-read=time]").inner_text() == "step 50 of 50"
    assert page.ask("chapsym.position(0)") == page.ask("chapsym.position(50)") == [0, 0]
    assert page.ask("chapsym.quaternion(0)") != page.ask("chapsym.quaternion(50)")


def test_the_ellipsoid_has_the_principal_axes(rolling, tmp_path):
    """Its semi-axes are as 1/√I, along the principal axes, which the quaternion `axes` turns to those of the body."""
    turned = rolled(10).assign(axes=(("ball", "quaternion"), [[0.5, 0.5, -0.5, 0.5]]))
    write_page(turned, tmp_path / "axes.html")
    page = rolling(tmp_path / "axes.html")
    before = page.picture()
    page.tab.get_by_role("button", name="Ellipsoid of inertia").click()
    assert page.picture() != before
    axes = np.array(
        page.ask(
            """(() => { const { ellipsoid, body } = chapsym.stage.balls[0], [surface] = ellipsoid.children;
               chapsym.stage.scene.updateMatrixWorld();
               const seen = body.matrixWorld.clone().invert().multiply(surface.matrixWorld);
               return [0, 1, 2].map(i => seen.elements.slice(4 * i, 4 * i + 3)); })()"""
        )
    )
    wanted = kernels.rotate(np.full((3, 4), [0.5, 0.5, -0.5, 0.5]), np.diag(1 / np.sqrt(BALL.inertia)))
    np.testing.assert_allclose(axes / np.linalg.norm(axes), wanted / np.linalg.norm(wanted), rtol=0, atol=1e-12)


def test_frames_too_far_apart_are_shown_as_they_are(rolling, tmp_path):
    write_page(rolled(3900, every=60, ball=EVEN).drop_vars("omega"), tmp_path / "coarse.html")
    page = rolling(tmp_path / "coarse.html", webgl=False)
    assert TOO_FAR in page.tab.locator(".notes").inner_text()
    assert page.ask("chapsym.quaternion(3.7)") == page.ask("chapsym.quaternion(3)")
    assert page.ask("chapsym.position(3.7)") != page.ask("chapsym.position(3)")
    write_page(rolled(3900, every=60, ball=EVEN), tmp_path / "words.html")
    page = rolling(tmp_path / "words.html", webgl=False)
    assert page.tab.locator(".notes").count() == 0
    half = page.ask("[3, 3.5, 4].map(i => chapsym.quaternion(i))")
    first, second = (2 * np.arccos(min(1, abs(np.dot(a, b)))) for a, b in ((half[0], half[1]), (half[1], half[2])))
    assert first == pytest.approx(second, abs=1e-3)
    # Both halves of the same turn of more than π: 11.18 rad/s for 0.15 s.
    assert first == pytest.approx(np.linalg.norm([3, 4, 10]) * 0.15, rel=2e-3)


def test_lost_graphics_are_told_and_come_back(rolling):
    page = rolling()
    shown = page.picture()
    page.ask(
        """window.lost = document.querySelector('canvas').getContext('webgl2').getExtension('WEBGL_lose_context');
           lost.loseContext()"""
    )
    alert = page.tab.get_by_role("alert")
    alert.wait_for(state="visible")
    assert "taken the graphics away" in alert.inner_text()
    page.ask("lost.restoreContext()")
    alert.wait_for(state="hidden")
    back = page.picture()
    page.said[:] = [text for text in page.said if not text.startswith("THREE.WebGLRenderer: Context")]
    # Edges are smoothed otherwise in the new context; the ball, takes 5 % of the picture.
    changed = np.abs(pixels(back) - pixels(shown)).max(axis=2) > 0.3
    assert changed.mean() < 0.005


def test_no_webgl_is_told(rolling):
    page = rolling(webgl=False)
    alert = page.tab.get_by_role("alert")
    assert "which this browser does not offer" in alert.inner_text()
    assert page.tab.locator("[data-read=position]").inner_text() == "0.000, 0.000 m"


@pytest.mark.parametrize(
    ("size", "away", "shown"), [(1.0, 1e9, r"\d{9,10}\.\d+, \d{9,10}\.\d+ m"), (1e-20, 0.0, r".*e−2\d.*")]
)
def test_numbers_of_all_sizes_are_readable(rolling, tmp_path, size, away, shown):
    data = rolled(20)
    write_page(data.assign(radius=size * data["radius"], contact=size * data["contact"] + away), tmp_path / "page.html")
    page = rolling(tmp_path / "page.html", webgl=False)
    page.ask("chapsym.seek(20)")
    place = page.tab.locator("[data-read=position]")
    assert re.fullmatch(shown, place.inner_text()), place.inner_text()
    assert page.ask(
        "(() => { const x = document.querySelector('[data-read=position]'); return x.scrollWidth <= x.clientWidth })()"
    )

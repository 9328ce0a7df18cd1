"""Moving pictures: the ball as it turns at each time, its way, and what is written where."""

import io
import os

import numpy as np
import pytest
import results
from commands import chapsym as command
from commands import refused
from PIL import Image

import chapsym
from chapsym.dynamics import BadInput, kernels
from chapsym.show import moving
from chapsym.show.moving import ACROSS, MOST, RATE, TURN, save_motion
from chapsym.show.result import Result


@pytest.fixture
def fake_ffmpeg(tmp_path, monkeypatch):
    """An ffmpeg that keeps what it is given: the raw pictures are the file."""
    folder = tmp_path / "bin"
    folder.mkdir()
    program = folder / "ffmpeg"
    program.write_text('#!/bin/bash\ncat > "${@: -1}"\n')
    program.chmod(0o755)
    monkeypatch.setenv("PATH", f"{folder}{os.pathsep}{os.environ['PATH']}")
    return program


def scene(dataset):
    with moving.styled():
        return moving._Scene(dataset)


def test_each_picture_shows_the_ball_and_its_place_at_its_time():
    dataset = results.bowling(200)
    drawn = scene(dataset)
    true = chapsym.interpolated(dataset, drawn.t)
    assert drawn.attitude == pytest.approx(true["attitude"].values[0], abs=1e-14)
    for i in range(len(drawn.t)):
        drawn.show(i)
        assert drawn.dot.get_xydata()[0] * drawn.factor == pytest.approx(true["contact"].values[0, i], abs=1e-14)
        assert len(drawn.way.get_xdata()) == i + 1
    last = drawn.attitude[-1]
    # The sign of xyz in body axes tells the octant of each pixel, light or dark.
    picture = drawn.image.get_array()
    side = np.linspace(-1.0, 1.0, ACROSS)
    for row, column in ((60, 60), (60, 160), (150, 90), (110, 170), (170, 120)):
        x, y = side[column], side[row]
        depth = np.sqrt(1.0 - x * x - y * y)
        seen = x * drawn.view.right + y * drawn.view.up + depth * drawn.view.towards
        body = kernels.rotate(last * [1.0, -1.0, -1.0, -1.0], seen)
        if np.abs(body).min() > 0.05 and np.abs(body).max() < 0.9:
            light = picture[row, column, 2] / (0.92 * (0.72 + 0.28 * depth))
            assert (light > 0.8) == (body.prod() > 0)
    assert drawn.clock.get_text() == f"{drawn.t[-1]:.2f} s"
    short = scene(dataset.assign_coords(time=dataset["time"] * 1e-6))
    short.show(len(short.t) - 1)
    assert short.clock.get_text() == f"{1e9 * short.t[-1]:.2f} 10⁻⁹ s"


def test_a_ball_that_stops_at_once_has_no_motion(tmp_path):
    dataset = results.bowling(20)
    with pytest.raises(BadInput, match="a motion needs two frames"):
        moving.save_motion(dataset.assign(taken=0 * dataset["taken"]), tmp_path / "a.gif")


def test_what_turns_too_fast_for_all_pictures_is_a_part_and_says_so():
    whole, part, far = (
        scene(data)
        for data in (results.bowling(500), results.bowling(8000, every=5), results.bowling(40_000, every=100))
    )
    assert (whole.span, whole.t[-1]) == ("", 0.5)
    assert len(whole.t) >= 2 * RATE
    assert part.span.startswith("the first ")
    assert part.span.endswith(" of 8 s")
    for shown in (whole, part):
        turned = 2 * np.arccos(np.abs((shown.attitude[1:] * shown.attitude[:-1]).sum(axis=-1)).clip(max=1.0))
        assert turned.max() < 1.1 * TURN
    # 3 radians apart: the frames themselves, and no more of them than pictures.
    assert far.t == pytest.approx(0.1 * np.arange(MOST))


def test_the_files_are_whole_and_what_cannot_be_written_is_a_sentence(tmp_path, fake_ffmpeg, monkeypatch):
    monkeypatch.setattr(moving, "RATE", 3)
    dataset = results.bowling(60)
    words = []
    save_motion(dataset, tmp_path / "a.gif", progress=lambda drawn, of: words.append((drawn, of)))
    with Image.open(tmp_path / "a.gif") as picture:
        count = picture.n_frames
        assert picture.size == (320, 480)
    assert words == [(i + 1, count) for i in range(count)]
    Result(dataset).animate(tmp_path / "a.mp4")
    assert (tmp_path / "a.mp4").stat().st_size == count * 320 * 480 * 4
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.gif", "a.mp4", "bin"]
    fake_ffmpeg.write_text("#!/bin/bash\nexit 1\n")
    with pytest.raises(BadInput, match=r"ffmpeg could not write the motion .*a \.gif needs none"):
        save_motion(dataset, tmp_path / "b.mp4")
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(BadInput, match=r"ffmpeg, which is not installed here: install it, or write a \.gif"):
        save_motion(dataset, tmp_path / "b.mp4")
    with pytest.raises(BadInput, match=r"end in \.gif or \.mp4"):
        save_motion(dataset, tmp_path / "b.avi")
    with pytest.raises(BadInput, match='no attitude: add "attitude"'):
        save_motion(dataset.drop_vars("attitude"), tmp_path / "b.gif")
    with pytest.raises(BadInput, match="three dimensions only"):
        save_motion(results.four(5), tmp_path / "b.gif")
    assert not list(tmp_path.glob("b.*"))


def test_a_ball_that_stops_and_one_without_contact_move_until_their_last_frame(monkeypatch):
    dataset = results.folded()
    dataset["attitude"] = ("ball", "frame", "quaternion"), np.tile([1.0, 0.0, 0.0, 0.0], (2, 301, 1))
    drawn = scene(dataset.isel(ball=[1]).drop_vars("contact"))
    assert drawn.t[-1] == int(dataset["taken"][1])
    assert drawn.contact is None
    assert len(drawn.figure.axes) == 1
    drawn.show(len(drawn.t) - 1)
    assert drawn.clock.get_text() == f"step {int(dataset['taken'][1])}"


def test_the_command_writes_the_motion_and_figures_in_every_format(tmp_path, monkeypatch):
    monkeypatch.setattr(moving, "RATE", 2)
    Result(results.bowling(40)).save(tmp_path / "a.nc")
    done = command("show", tmp_path / "a.nc", "-o", tmp_path / "b", "--format", "gif", "--no-page")
    assert done.stdout == f"{tmp_path / 'b' / 'motion.gif'}\n"
    assert Image.open(io.BytesIO((tmp_path / "b" / "motion.gif").read_bytes())).n_frames >= 2
    done = command("show", tmp_path / "a.nc", "-o", tmp_path / "c", "--format", "pdf", "--figures", "contact")
    assert (tmp_path / "c" / "contact.pdf").read_bytes()[:5] == b"%PDF-"
    assert "figures do not move" in refused("show", tmp_path / "a.nc", "--format", "gif", "--figures", "omega")
    monkeypatch.setenv("PATH", str(tmp_path))
    assert "install it, or write a .gif" in refused("show", tmp_path / "nothing.toml", "--format", "mp4")

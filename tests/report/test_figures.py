"""The figures of a result: what is drawn is what was computed, and what is missing is said."""

import re
from pathlib import Path

import matplotlib
import numpy as np
import pytest
import results
import xarray as xr
from budget import slow

import chapsym
from chapsym import files
from chapsym.dynamics import BadInput
from chapsym.show import figures
from chapsym.show.drawing import reading, series
from chapsym.show.figures import over_time, phase
from chapsym.show.result import Result

GAMMA = (0.48, 0.6, 0.64)


def lines(axis):
    """The lines of an axis that have data, without markers of single points."""
    return [line for line in axis.lines if len(line.get_xdata()) > 1 and line.get_zorder() >= 2]


def texts(figure):
    return [text.get_text() for legend in figure.legends for text in legend.get_texts()]


def test_the_trace_of_one_ball_is_its_contact_point_in_metres_with_its_ends_and_direction():
    dataset = results.uneven(200)
    figure = figures.draw(dataset, "contact")
    axis = figure.axes[0]
    (line,) = lines(axis)
    trace = dataset["contact"].values[0]
    assert (trace == np.array(line.get_data()).T).all()
    assert axis.get_aspect() == 1.0
    assert (axis.get_xlabel(), axis.get_ylabel()) == ("x, m", "y, m")
    ends = {line.get_label(): np.ravel(line.get_data()) for line in axis.lines if len(line.get_xdata()) == 1}
    assert (ends["start"] == trace[0]).all()
    assert (ends["end"] == trace[-1]).all()
    assert sum(text.arrow_patch is not None for text in axis.texts) == 4
    for arrow in axis.texts:  # along the path, the way the ball goes
        here = np.flatnonzero((trace == arrow.xy).all(axis=1))[0]
        assert (trace[here - 1] == arrow.xyann).all()


def test_a_trace_that_is_nearly_straight_is_shown_enlarged_across_its_way():
    dataset = results.uneven(500)
    _, below = figures.draw(dataset, "contact").axes
    trace = dataset["contact"].values[0]
    way = (trace[-1] - trace[0]) @ [1, 1j]
    turned = (trace - trace[0]) @ [1, 1j] / (way / abs(way))
    line = below.lines[0]
    assert line.get_xdata() == pytest.approx(turned.real)
    assert line.get_ydata() * 1e-3 == pytest.approx(turned.imag)
    assert below.get_ylabel() == "to the left, 10⁻³ m"
    dataset["contact"] = dataset["contact"] * xr.DataArray([1.0, 0.0], dims="plane")
    assert len(figures.draw(dataset, "contact").axes) == 1
    turn = np.linspace(0, 3, 501)
    dataset["contact"] = ("ball", "frame", "plane"), np.stack([np.cos(turn), np.sin(turn)], axis=-1)[np.newaxis]
    assert len(figures.draw(dataset, "contact").axes) == 1


def test_a_tiny_trace_is_drawn_in_a_power_of_ten_without_offsets():
    dataset = results.uneven(100)
    dataset["contact"] = dataset["contact"] * 1e-8
    axis = figures.draw(dataset, "contact").axes[0]
    assert axis.get_xlabel() == "x, 10⁻⁹ m"
    assert lines(axis)[0].get_xdata() == pytest.approx(dataset["contact"].values[0, :, 0] * 1e9)


def test_several_balls_have_a_colour_and_a_name_each():
    dataset = results.batch(4, 60, 1)
    figure = figures.draw(dataset, "contact")
    drawn = lines(figure.axes[0])
    assert texts(figure) == ["0", "1", "2", "3"]
    assert len({line.get_color() for line in drawn}) == 4
    assert all((line.get_ydata() == y).all() for line, y in zip(drawn, dataset["contact"].values[..., 1], strict=True))


def test_a_few_dozen_balls_are_coloured_by_what_was_varied():
    dataset = results.batch(20, 40, 1)
    axis, bar = figures.draw(dataset, "contact").axes
    assert bar.get_xlabel() == "start.omega.1, rad s⁻¹"
    drawn = lines(axis)
    order = np.argsort(dataset["start.omega.1"].values)
    assert len(drawn) == 20
    low, high = drawn[order[0]].get_color(), drawn[order[-1]].get_color()
    assert low == pytest.approx(matplotlib.colormaps["viridis"](0))
    assert high == pytest.approx(matplotlib.colormaps["viridis"](255))


def test_thousands_of_balls_are_a_density_that_counts_every_frame():
    dataset = results.batch(100, 200, 5)
    axis, _ = figures.draw(dataset, "contact").axes
    (image,) = axis.images
    assert image.get_array().sum() == 100 * 41
    mean = next(line for line in axis.lines if line.get_label() == "mean of the balls")
    assert pytest.approx(dataset["contact"].values.mean(axis=0)) == np.array(mean.get_data()).T
    assert len([line for line in axis.lines if len(line.get_xdata()) == 91]) == 8


@pytest.mark.filterwarnings("error", "ignore::DeprecationWarning")
def test_balls_that_are_hardly_apart_far_from_the_origin_are_a_density():
    dataset = results.batch(100, 2, 1)
    dataset["contact"] = ("ball", "frame", "plane"), np.full((100, 3, 2), 1e6)
    dataset["contact"][:50, :, 0] = np.nextafter(1e6, 2e6)
    axis = figures.draw(dataset, "contact").axes[0]
    assert axis.get_xlim()[0] < axis.get_xlim()[1]


def test_an_ellipse_holds_its_share_of_the_balls():
    from matplotlib.path import Path

    from chapsym.show.figures.contact import ellipse

    points = np.random.default_rng(3).standard_normal((2000, 2)) @ [[3.0, 1.0], [0.0, 0.5]] + [10.0, -4.0]
    for share in (50, 90):
        inside = Path(ellipse(points, share)).contains_points(points).mean()
        # The polygon of 90 sides lies inside the ellipse: it may lose the balls in the last 0.06 % of its radius.
        assert inside == pytest.approx(share / 100, abs=3e-3)


def test_a_ball_that_stopped_ends_where_it_stopped_and_says_so():
    dataset = results.folded()
    figure = figures.draw(dataset, "contact")
    _, fast = lines(figure.axes[0])
    taken = int(dataset["taken"][1])
    assert 0 < taken < 300
    assert len(fast.get_xdata()) == taken + 1
    assert "stopped early" in texts(figure)
    alone = figures.draw(dataset, "contact", "fast")
    assert texts(alone) == ["start", "stopped"]
    assert np.isfinite(lines(alone.axes[0])[0].get_xydata()).all()


def test_a_change_at_roundoff_is_drawn_in_a_range_of_twenty_ulps_and_a_real_drift_is_seen():
    dataset = results.uneven(300)
    axis = figures.draw(dataset, "integrals").axes[0]
    assert axis.get_ylim() == pytest.approx((-2.22, 2.22), rel=1e-3)
    assert axis.get_ylabel() == "relative change, 10⁻¹⁵"
    found = dataset["integrals"].values[0]
    drawn = [line for line in lines(axis) if len(line.get_xdata()) == 301]
    sizes = [np.sqrt(found[0, 1] * found[0, 2]), found[0, 1], found[0, 2]]
    for i, line in enumerate(drawn):
        assert line.get_ydata() * 1e-15 == pytest.approx((found[:, i] - found[0, i]) / sizes[i], abs=1e-30)
    dataset["integrals"] = dataset["integrals"] * (1 + 1e-7 * np.linspace(0, 1, 301)[:, np.newaxis])
    figure = figures.draw(dataset, "integrals")
    assert figure.axes[0].get_ylabel() == "relative change, 10⁻⁹"
    assert figure.axes[0].get_ylim()[1] > 100
    assert [text[-6:] for text in texts(figure)[1:]] == ["1.0e-7", "1.0e-7"]
    x = np.array([[2.0, 2.5], [0.0, 0.25]])
    assert (over_time.relative(x, np.array([2.0, 0.0])) == [[0.0, 0.25], [0.0, 0.25]]).all()


def test_the_energy_is_drawn_as_its_relative_change():
    dataset = results.bowling(300)
    axis = figures.draw(dataset, "energy").axes[0]
    energy = dataset["energy"].values[0]
    line = max(axis.lines, key=lambda line: len(line.get_xdata()))
    assert line.get_ydata() * 1e-12 == pytest.approx(energy / energy[0] - 1, abs=4e-16)
    assert f"{energy[0]:.6g} J" in axis.get_title()
    assert (line.get_xdata() == dataset["time"].values).all()


def test_the_components_of_one_ball_share_a_panel_and_those_of_several_have_their_own():
    one, few, many = results.bowling(50), results.batch(3, 50, 1), results.batch(40, 50, 1)
    (axis,) = figures.draw(one, "omega").axes
    assert axis.get_ylabel() == "$\\omega$, rad s⁻¹"
    assert all((line.get_ydata() == one["omega"].values[0, :, i]).all() for i, line in enumerate(lines(axis)))
    panels = figures.draw(few, "omega").axes
    assert [len(lines(panel)) for panel in panels] == [3, 3, 3]
    panels = figures.draw(many, "omega").axes
    for i, panel in enumerate(panels):
        (median,) = lines(panel)
        assert median.get_ydata() == pytest.approx(np.median(many["omega"].values[..., i], axis=0))
        assert len(panel.collections) == 3


def test_bands_say_how_many_balls_stopped_early():
    dataset = results.batch(20, 40, 1)
    assert "stopped" not in figures.draw(dataset, "omega").get_supxlabel()
    dataset["taken"][:3], dataset["status"][:3] = 10, chapsym.Status.FOLDED
    assert "without the 3 of 20 balls that stopped early" in figures.draw(dataset, "omega").get_supxlabel()


def test_the_slip_is_drawn_in_metres_per_second():
    slip = 3e-3 * np.sin(np.arange(21.0))
    (axis,) = figures.draw(results.bowling(20).assign(slip=(("ball", "frame"), slip[np.newaxis])), "slip").axes
    assert lines(axis)[0].get_ydata() * 1e-3 == pytest.approx(slip)
    assert axis.get_ylabel() == "slip, 10⁻³ m s⁻¹"


#: The test that compares each kind of figure with numbers that it computes itself.
COMPARED = {
    "contact": "test_figures.test_the_trace_of_one_ball_is_its_contact_point_in_metres_with_its_ends_and_direction",
    "spheres": "test_spheres.test_what_is_drawn_is_an_orthogonal_projection_of_the_directions",
    "spread": "test_figures.test_the_spread_is_the_distance_from_the_mean_in_logarithms_if_it_grows_exponentially",
    "rotation": "test_figures.test_the_rotation_number_is_drawn_over_what_was_varied",
    "phase": "test_figures.test_the_phase_and_its_increments_where_a_constant_looks_constant",
    "slip": "test_figures.test_the_slip_is_drawn_in_metres_per_second",
    "omega": "test_figures.test_the_components_of_one_ball_share_a_panel_and_those_of_several_have_their_own",
    "attitude": "test_spheres.test_the_body_axes_in_space_are_those_of_the_attitude",
    "energy": "test_figures.test_the_energy_is_drawn_as_its_relative_change",
    "integrals": "test_figures.test_a_change_at_roundoff_is_drawn_in_a_range_of_twenty_ulps_and_a_real_drift_is_seen",
}


def test_each_kind_of_figure_is_compared_with_numbers():
    assert COMPARED.keys() == figures.kinds().keys()
    for kind, place in COMPARED.items():
        file, name = place.split(".")
        text = Path(__file__).with_name(f"{file}.py").read_text(encoding="utf-8")
        body = text.partition(f"\ndef {name}(")[2].partition("\n\n\n")[0]
        assert f'"{kind}"' in body, place
        assert re.search(r"get_[xy]?data\(|get_offsets\(|vertices", body), place


def test_thinning_out_loses_no_spike():
    from matplotlib.figure import Figure

    axis, t = Figure().subplots(), np.arange(50_000.0)
    y = np.zeros(50_000)
    y[12_345], y[40_001] = 7.0, -3.0
    series.line(axis, t, y, "black")
    (area,) = axis.collections
    drawn = area.get_paths()[0].vertices
    assert (drawn[:, 1].max(), drawn[:, 1].min()) == (7.0, -3.0)
    assert len(drawn) < 4000


def test_the_phase_and_its_increments_where_a_constant_looks_constant():
    dataset = results.vertical(100)
    above, below = figures.draw(dataset, "phase").axes
    u = dataset["phase"].values[0]
    assert lines(above)[0].get_ydata() == pytest.approx(u, abs=1e-13)
    assert (lines(below)[0].get_ydata() == np.diff(u)).all()
    dataset["rotation_number"] = "ball", [np.diff(u).mean() / chapsym.Curve.through(results.VERTICAL, GAMMA).period]
    thinned = dataset.isel(frame=slice(None, None, 4))
    each = lines(figures.draw(thinned, "phase").axes[1])[0].get_ydata()
    assert each == pytest.approx(np.diff(u)[:100].reshape(25, 4).mean(axis=1), rel=1e-13)
    dataset = results.vertical(50)
    dataset["phase"] = ("ball", "frame"), (0.1 * np.arange(51) + 40.0)[np.newaxis]
    _, below = figures.draw(dataset, "phase").axes
    low, high = below.get_ylim()
    assert high - low == pytest.approx(1e-4)


@pytest.mark.parametrize("every", [1, 5, 60])
def test_a_phase_that_is_kept_within_its_period_is_drawn_as_it_runs(every):
    dataset = results.vertical(300)
    running = dataset["phase"].values[0]
    curve = chapsym.Curve.through(results.VERTICAL, dataset["gamma"].values[0, 0])
    wrapped = np.remainder(running + curve.period / 2, curve.period) - curve.period / 2
    assert np.abs(np.diff(wrapped)).max() > curve.period / 2
    dataset["phase"] = ("ball", "frame"), wrapped[np.newaxis]
    dataset["rotation_number"] = "ball", [np.diff(running).mean() / curve.period]
    thinned = dataset.isel(frame=slice(None, None, every))
    above, below = figures.draw(thinned, "phase").axes
    kept = running[::every]
    assert lines(above)[0].get_ydata() - wrapped[0] == pytest.approx(kept - kept[0], abs=1e-12)
    assert lines(below)[0].get_ydata() == pytest.approx(np.diff(kept) / every, abs=1e-12)


def test_a_phase_whose_period_is_not_known_keeps_its_jumps_but_not_as_increments():
    dataset = results.vertical(300)
    period = chapsym.Curve.through(results.VERTICAL, dataset["gamma"].values[0, 0]).period
    dataset["phase"] = np.remainder(dataset["phase"] + period / 2, period) - period / 2
    above, below = figures.draw(dataset.drop_vars("gamma"), "phase").axes
    assert below.get_ylabel() == "gain a frame"
    each = lines(below)[0].get_ydata()
    assert np.nanmax(np.abs(each)) < 0.2
    assert np.isnan(each).sum() == (np.abs(np.diff(dataset["phase"].values[0])) > period / 2).sum() > 0
    assert np.isnan(lines(above)[0].get_ydata()).sum() == np.isnan(each).sum()


def test_the_rotation_number_is_drawn_over_what_was_varied():
    dataset = results.sweep(12).isel(ball=[5, 2, 9, 0, 11])
    axis = figures.draw(dataset, "rotation").axes[0]
    (line,) = lines(axis)
    x = np.sort(dataset["start.momentum"].values)
    assert (line.get_xdata() == x).all()
    assert line.get_ydata() == pytest.approx(x / (1 + x))
    assert axis.get_xlabel() == "start.momentum, kg m²"
    assert "sweep" in figures.available(dataset.isel(ball=[0]))["rotation"]


def test_two_swept_parameters_are_an_axis_and_a_colour_and_what_is_missing_is_counted():
    dataset = results.sweep(10).assign_coords({"ball.mass": ("ball", np.arange(10.0), {"units": "kg"})})
    axis, bar = figures.draw(dataset, "rotation").axes
    assert (axis.get_xlabel(), bar.get_xlabel()) == ("start.momentum, kg m²", "ball.mass, kg")
    assert axis.collections[0].get_offsets()[:, 1].data == pytest.approx(dataset["rotation_number"].values)
    dataset["rotation_number"][3] = np.nan
    assert "1 of 10" in figures.draw(dataset, "rotation").axes[0].get_title()


def test_the_spread_is_the_distance_from_the_mean_in_logarithms_if_it_grows_exponentially():
    dataset = results.batch(50, 100, 1)
    above, below = figures.draw(dataset, "spread").axes
    contact, gamma = dataset["contact"].values, dataset["gamma"].values
    far = np.sqrt(((contact - contact.mean(axis=0)) ** 2).sum(axis=-1))
    assert lines(above)[0].get_ydata() == pytest.approx(np.median(far, axis=0))
    mean = gamma.mean(axis=0)
    mean /= np.sqrt((mean**2).sum(axis=-1, keepdims=True))
    angle = np.rad2deg(np.arccos(np.clip((gamma * mean).sum(axis=-1), -1, 1)))
    assert lines(below)[0].get_ydata() == pytest.approx(np.median(angle, axis=0), abs=1e-5)
    assert above.get_yscale() == "linear"
    away = np.random.default_rng(1).standard_normal((50, 1, 2)) * np.exp(np.linspace(-20, 0, 101))[:, np.newaxis]
    dataset["contact"] = ("ball", "frame", "plane"), away
    assert figures.draw(dataset, "spread").axes[0].get_yscale() == "log"
    away[25:] = -away[:25]
    away[[0, 1, 2, 25, 26, 27]] = 0.0  # the least of them is no distance at all
    above = figures.draw(dataset, "spread").axes[0]
    assert above.get_yscale() == "log"
    assert 0.0 < above.get_ylim()[0] < np.exp(-19)


def test_a_figure_that_cannot_be_drawn_leaves_no_folder(tmp_path):
    with pytest.raises(BadInput, match="contact: no contact"):
        figures.save_all(results.bowling(20, outputs=("gamma",)), tmp_path / "new", names=["spheres", "contact"])
    damaged = results.bowling(20, outputs=("gamma", "contact"))
    damaged["contact"][0, 3] = np.nan
    with pytest.raises(BadInput, match="the result is damaged"):
        figures.save_all(damaged, tmp_path / "new")
    assert not (tmp_path / "new").exists()


def test_what_is_missing_is_said_in_a_sentence():
    dataset = results.bowling(20, outputs=("gamma",))
    found = figures.available(dataset)
    assert [name for name, reason in found.items() if reason is None] == ["spheres"]
    assert found["contact"] == 'no contact: add "contact" to run.outputs'
    for name, output in (("omega", "omega"), ("energy", "energy"), ("attitude", "attitude"), ("phase", "phase")):
        assert f'add "{output}" to run.outputs' in found[name]
        with pytest.raises(BadInput, match=f'{name}: no .* "{output}"'):
            figures.draw(dataset, name)
    with pytest.raises(BadInput, match="or no frames"):
        figures.available(dataset.isel(frame=slice(0, 0)))


@pytest.mark.parametrize("output", ["contact", "omega", "energy", "attitude", "integrals"])
def test_one_output_is_one_figure(output):
    found = figures.available(results.bowling(5, outputs=(output,)))
    assert [name for name, reason in found.items() if reason is None] == [output]


def test_a_figure_and_a_ball_are_chosen_by_name_or_index():
    dataset = results.folded()
    with pytest.raises(BadInput, match="no figure 'trace'; choose of contact, spheres"):
        figures.draw(dataset, "trace")
    with pytest.raises(BadInput, match="no ball 'third'; its balls: slow, fast"):
        figures.draw(dataset, "contact", "third")
    with pytest.raises(BadInput, match="no result"):
        figures.available(dataset[["D"]])
    for ball in ("slow", 0, -2):
        (line,) = lines(figures.draw(dataset, "contact", ball).axes[0])
        assert (line.get_xdata() == dataset["contact"].values[0, :, 0]).all()
    assert figures.draw(dataset.isel(ball=0), "contact").axes


def test_all_integrals_of_many_dimensions_are_drawn():
    beginning = {
        "momentum": (np.triu(np.full((11, 11), 0.01), 1) - np.tril(np.full((11, 11), 0.01), -1)).tolist(),
        "gamma": [0] * 10 + [1],
    }
    scene = {"ball": {"mass_tensor": list(range(1, 12)), "D": 3}, "start": beginning}
    run = chapsym.run_scene(scene | {"run": {"steps": 2, "outputs": ["integrals"]}})
    drawn = [line.get_label() for line in lines(figures.draw(run.dataset, "integrals").axes[0])]
    assert len(drawn) == run.dataset.sizes["integral"] == 11
    assert drawn[4].startswith(r"$\mathrm{tr}\,\mathcal{K}^{10}$: ")


def test_integrals_that_are_variables_of_their_own_are_drawn_as_those_in_one():
    dataset = results.uneven(200)
    apart = dataset.drop_vars("integrals")
    assert 'add "vertical_momentum" and "momentum_squared"' in figures.available(apart)["integrals"]
    for i, name in enumerate(over_time.OF_ONE):
        apart[name] = dataset["integrals"][..., i].drop_vars("integral")
    one, same = (figures.draw(data, "integrals").axes[0] for data in (apart, dataset))
    for here, there in zip(one.lines, same.lines, strict=True):
        assert np.array_equal(here.get_ydata(), there.get_ydata())
        assert here.get_label() == there.get_label()
    assert dict(Result(apart).rows())["drift"] == dict(Result(dataset).rows())["drift"]


@pytest.mark.parametrize("name", ["contact", "omega", "energy", "integrals", "attitude", "spheres"])
def test_a_frame_that_was_reached_and_is_not_finite_is_an_error(name):
    dataset = results.bowling(20)
    variable = {"spheres": "gamma"}.get(name, name)
    dataset[variable][0, 7] = np.nan
    with pytest.raises(BadInput, match=f"{variable} of the ball '0' is not finite at step 7"):
        figures.draw(dataset, name)


def test_what_stands_behind_the_last_step_is_left_out():
    dataset = results.folded()
    dataset["contact"] = dataset["contact"].fillna(99.0)
    read = reading.values(dataset, "contact")
    assert np.isnan(read[1, int(dataset["taken"][1]) + 1 :]).all()
    assert np.isfinite(read[0]).all()


def test_an_interrupted_sweep_shows_the_balls_that_have_run():
    dataset = results.batch(100, 20, 1)
    dataset["taken"][70:] = -1
    for name in ("contact", "momentum", "gamma", "omega", "attitude", "energy", "integrals"):
        dataset[name][70:] = np.nan
    for name in ("contact", "spread"):
        assert figures.draw(dataset, name).axes
    assert "100" in repr(Result(dataset))
    dataset["taken"][45:] = -1  # less than half: the density is of those that have run
    assert len(figures.draw(dataset, "contact").axes) == 2
    dataset["taken"][7:] = -1
    assert len(lines(figures.draw(dataset, "contact").axes[0])) == 7
    dataset["taken"][1:] = -1
    dataset["taken"][0], dataset["taken"][99] = -1, 20
    dataset["gamma"][99] = dataset["momentum"][99] = [0.0, 0.0, 1.0]
    assert figures.draw(dataset, "spheres").axes
    waiting = results.sweep(20)
    waiting["taken"][5:], waiting["rotation_number"][5:] = -1, np.nan
    assert figures.draw(waiting, "rotation").axes[0].get_title() == ""


def test_decimal_strings_are_drawn_as_the_numbers_they_are():
    dataset = results.bowling(10, outputs=("contact",))
    expected = dataset["contact"].values[0, :, 0]
    dataset["contact"] = dataset["contact"].astype(str)
    assert (lines(figures.draw(dataset, "contact").axes[0])[0].get_xdata() == expected).all()


@pytest.mark.parametrize("dataset", [lambda: results.bowling(0), lambda: results.batch(30, 0, 1)], ids=["one", "many"])
def test_a_result_of_one_frame_is_drawn(dataset):
    data = dataset()
    drawn = {name for name, reason in figures.available(data).items() if reason is None and figures.draw(data, name)}
    assert drawn >= {"contact", "spheres", "omega", "energy", "integrals", "attitude"}
    for name in ("omega", "energy") if data.sizes["ball"] == 1 else ():
        seen = [line for line in figures.draw(data, name).axes[0].lines if line.get_zorder() >= 2]
        assert seen
        assert all(line.get_marker() == "o" for line in seen)


def test_a_ball_at_rest_is_drawn():
    run = chapsym.roll(results.UNEVEN, (0.0, 0.0, 0.0), 0.01, 20, contact=True)
    dataset = results.of(run, results.ALL, "At rest")
    found = [name for name, reason in figures.available(dataset).items() if reason is None]
    assert len([figures.draw(dataset, name) for name in found]) == 6
    assert figures.draw(dataset, "energy").axes[0].get_ylim() == pytest.approx((-2.22, 2.22), rel=1e-3)


def test_the_same_result_gives_the_same_bytes_whatever_the_user_has_set(tmp_path):
    dataset = results.vertical(60)
    saved = lambda name: [  # noqa: E731
        *figures.save_all(dataset, tmp_path / name),
        *figures.save_all(dataset, tmp_path / name, ("png",), names=["spheres"]),
    ]
    first = saved("a")
    own = {"font.size": 30, "axes.linewidth": 5.0, "axes.facecolor": "red", "svg.hashsalt": "other"}
    with matplotlib.rc_context(own):
        second = saved("b")
        assert matplotlib.rcParams["font.size"] == 30
    assert [path.name for path in first] == [path.name for path in second]
    for one, other in zip(first, second, strict=True):
        assert one.read_bytes() == other.read_bytes(), one.name
    assert b"<dc:date>" not in first[0].read_bytes()


@pytest.mark.thorough  # that long lines are thinned out is seen above
def test_large_results_and_long_runs_make_small_files(tmp_path):
    for dataset in (results.bowling(20_000), results.batch(1200, 200, 5)):
        sizes = {path.stem: path.stat().st_size for path in figures.save_all(dataset, tmp_path)}
        assert len(sizes) >= 6
        assert max(sizes.values()) < 1_000_000, sizes


def test_a_folder_that_cannot_be_is_one_sentence(tmp_path):
    (tmp_path / "file").write_text("kept")
    with pytest.raises(files.CannotWrite, match="cannot be a folder of results: it is a file"):
        figures.save_all(results.sweep(4), tmp_path / "file")
    assert (tmp_path / "file").read_text() == "kept"
    with pytest.raises(BadInput, match=r"ends in \.svg, \.png or \.pdf"):
        figures.save(figures.draw(results.sweep(4), "rotation"), tmp_path / "a.tiff")


def test_titles_are_those_of_the_scene_as_written():
    dataset = results.sweep(4).assign_attrs(title="100 $ a ball_1 $ or " + "more " * 40)
    title = figures.draw(dataset, "rotation").get_suptitle()
    assert title.startswith("100 $ a ball_1 $ or")
    assert title.count("\n") == 1
    assert title.endswith("...")


@pytest.mark.parametrize("name", ["$x^$", *slow(r"\$ and $")])
def test_names_and_units_are_text_whatever_is_in_them(name, tmp_path):
    dataset = results.folded().assign_coords(ball=[name, "b"])
    dataset["integral"] = ["K.gamma", "K^$", name]
    dataset["contact"].attrs["units"] = name
    figures.save_all(dataset, tmp_path, names=["contact", "integrals", "spheres"])
    (shown, *_) = figures.draw(dataset, "contact").legends[0].get_texts()
    assert shown._preprocess_math(shown.get_text()) == (name, False)
    swept = results.sweep(5).rename({"start.momentum": name})
    swept[name].attrs["units"] = name
    figures.save_all(swept, tmp_path)


def test_a_long_name_is_cut_in_a_figure():
    name = "long " * 15
    dataset = results.folded().assign_coords(ball=[name, "b"])
    (shown, *_) = figures.draw(dataset, "contact").legends[0].get_texts()
    assert shown.get_text() == name[:35] + "…"


@pytest.mark.filterwarnings("error", "ignore::DeprecationWarning")
def test_a_name_that_the_font_has_not_is_drawn_without_warnings(tmp_path):
    ball = {"name": "球", "inertia": [0.006, 0.007, 0.009], "mass": 2, "radius": 0.1}
    scene = {"ball": [ball, ball | {"name": "b"}], "start": {"omega": [1, 2, 3]}, "run": {"time_step": 0.1, "steps": 3}}
    run = chapsym.run_scene(scene)
    assert len(figures.save_all(run.dataset, tmp_path, ("png",), names=["spheres"])) == 1


@pytest.mark.filterwarnings("error", "ignore::DeprecationWarning")
def test_phases_of_balls_that_have_not_run_yet_are_drawn_without_a_warning():
    u = np.array([np.linspace(0.0, 1.0, 9), np.full(9, np.nan)])
    gained, known = phase.gains(u, np.ones(8), None, None)
    assert not known
    assert np.array_equal(gained, np.diff(u, axis=1), equal_nan=True)


def test_a_spread_needs_three_balls_that_go_on():
    J = np.repeat(np.atleast_2d(results.UNEVEN.mass_tensor), 5, axis=0)
    balls = chapsym.Ball(J, np.repeat(results.UNEVEN.D, 5), np.repeat(results.UNEVEN.radius, 5))
    omega = np.array([[10.0, -2.0, 1.0]] * 2 + [[3000.0, -2.0, 1.0]] * 3)
    two = results.of(chapsym.roll(balls, omega, time_step=0.01, steps=5, contact=True, map=True), ["contact", "gamma"])
    assert figures.available(two)["spread"] == "a spread needs at least three balls that go on"


def timed(every, steps=2000):
    """The bowling ball, 30 rad/s, at every so many milliseconds, and at every one."""
    return results.bowling(steps, every=every), results.bowling(steps)


def shown_texts(figure):
    """What stands in titles, in legends, and below the axes."""
    words = [axis.get_title() for axis in figure.axes] + [legend.get_title().get_text() for legend in figure.legends]
    return "\n".join([*words, figure.get_supxlabel()])


CURVES = {name for name, kind in figures.kinds().items() if kind.curve}


@pytest.mark.parametrize("name", [*sorted(CURVES - {"attitude", "spheres"}), *slow("attitude", "spheres")])
def test_sparse_frames_are_drawn_as_the_curve_between_them(name):
    sparse, dense = timed(20, 400)
    both = (lines(figures.draw(data, name).axes[0]) for data in (sparse, dense))
    drawn, true = (max(those, key=lambda line: len(line.get_xdata())) for those in both)
    assert drawn.get_marker() == "None"
    assert len(drawn.get_xdata()) == 7 * 20 + 1
    x, y = np.array(true.get_data())[:, ::20], np.array(drawn.get_data())[:, ::7]
    if name != "spheres":  # which are seen from where most of the points are
        assert y == pytest.approx(x, abs=1e-12, nan_ok=True)
    assert "turning apart" not in shown_texts(figures.draw(sparse, name))


def test_a_sphere_has_lines_where_the_frames_are_sparse_and_the_curve_is_that_of_all_frames():
    from chapsym.show.drawing.curves import finer

    sparse, dense = timed(20, 400)
    fine = finer(sparse)
    true = chapsym.interpolated(dense, fine["time"].values)
    for name in ("gamma", "momentum", "omega", "contact"):
        size = np.abs(true[name].values).max()
        assert np.abs(fine[name].values - true[name].values).max() < 5e-5 * size, name  # the map itself
    assert finer(dense) is dense


def test_a_map_without_time_is_an_orbit_of_points_and_is_not_made_a_curve():
    from chapsym.show.drawing.curves import finer, note

    dataset = results.top(40, 3)
    assert finer(dataset) is dataset
    assert note(dataset) == ""


@pytest.mark.parametrize("name", ["contact", "omega", "energy", *slow("spheres", "attitude")])
def test_frames_too_far_apart_are_points_and_the_figure_says_so(name):
    dataset = timed(100)[0]
    figure = figures.draw(dataset, name)
    assert "frames are 3.1 rad of turning apart: what is between is not seen" in shown_texts(figure)
    if name != "contact":
        drawn = [line for axis in figure.axes for line in axis.lines if len(line.get_xdata()) == 21]
        assert all(line.get_linestyle() == "None" for line in drawn)
    way = dataset[["contact", "radius", "energy", "taken", "status"]]
    assert "rad of turning apart" in shown_texts(figures.draw(way, "energy"))


def test_hundreds_of_turns_are_ranges_and_a_part_that_says_what_it_is():
    dataset = results.bowling(40_000, every=5)
    omega, q, gamma = (figures.draw(dataset, name) for name in ("omega", "attitude", "spheres"))
    whole, start = omega.axes
    assert "range of each in the whole run; below, its start" in whole.get_title()
    assert len(whole.collections) == 3
    assert 0 < start.lines[0].get_xdata()[-1] < 8.0
    assert start.lines[0].get_ydata() == pytest.approx(
        chapsym.interpolated(dataset, start.lines[0].get_xdata())["omega"].values[0, :, 0]
    )
    title = q.axes[1].get_title()
    assert title.startswith("its start, ")
    assert title.endswith(" of 40 s")
    for axis in (*gamma.axes, q.axes[0]):
        assert "line: the first " in axis.get_title()
        length = 0.0
        for line in axis.lines:
            x, y = np.array(line.get_data())
            if line.get_linewidth() == 1.2 and len(x) > 500:
                length += np.nansum(np.hypot(np.diff(x), np.diff(y)))
        assert 20 < length < 200


def test_a_series_that_swings_often_is_the_range_of_its_swings():
    from matplotlib.figure import Figure

    axis, t = Figure().subplots(), np.linspace(0.0, 1.0, 2501)
    y = (2.0 + t) * np.sin(2 * np.pi * 250.3 * t)
    assert series.swings(y) == pytest.approx(250, abs=1)
    series.line(axis, t, y, "black")
    assert not axis.lines
    (area,) = axis.collections
    x, drawn = area.get_paths()[0].vertices.T
    inside = (x > 0.05) & (x < 0.95)
    assert np.abs(np.abs(drawn[inside]) / (2.0 + x[inside]) - 1.0).max() < 0.06
    assert series.start(y[:, np.newaxis]) == pytest.approx(2501 * 20 / 250.3, abs=12)
    assert series.start(np.zeros((9, 1))) == 9

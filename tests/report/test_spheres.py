"""The spheres: the curve is the orbit's, what is behind is behind, and the grey region forbids no state of the run."""

import numpy as np
import pytest
import results
from budget import slow

from chapsym.dynamics import Ball, kernels
from chapsym.show import figures
from chapsym.show.drawing import invariant, sphere
from chapsym.show.drawing.invariant import curve_through, energy_range, unit
from chapsym.show.figures import over_time, spheres

J, D = np.array([0.1, 0.5, 1.6]), 0.7
AXES, SAME = np.array([0.8, 0.36, -0.48, 0.0]), np.array([1.0, 0.0, 0.0, 0.0])


def nearest(points, curve):
    """The largest distance of points (n, 3) from the vertices of a curve (m, 3)."""
    return max(float(np.sqrt(((curve - point) ** 2).sum(axis=1)).min()) for point in points)


@pytest.mark.parametrize("axes", [SAME, AXES], ids=["principal", "turned"])
def test_the_curve_of_a_vertical_momentum_is_that_of_its_orbit(axes):
    body = Ball(J, D, axes=axes)
    orbit = body.from_principal(results.vertical(300)["gamma"].values[0])
    curve = curve_through(body, orbit, D)
    assert curve == pytest.approx(unit(curve), abs=1e-15)
    # Vertices of a curve of length < 2π, 720 pieces: no point is farther from one than half a piece or so.
    assert nearest(orbit, curve) < 0.01
    assert nearest(curve, orbit) < 0.08  # steps of the orbit
    if axes is AXES:
        assert curve_through(Ball(J, D), orbit, D) is None or nearest(orbit, curve_through(Ball(J, D), orbit, D)) > 0.05


def test_the_forbidden_region_is_the_same_in_all_units():
    """Squares of the energies of this ball, for momenta of length 1, are beyond float64."""
    dataset, size = results.uneven(200), 1e-200
    other = dataset.assign(mass_tensor=size * dataset["mass_tensor"], D=size * dataset["D"])
    grey, again = (
        [axis.images[0].get_array() for axis in figures.draw(one, "spheres").axes] for one in (dataset, other)
    )
    assert all(image[..., 3].any() for image in grey)
    assert all((image != same).any(axis=-1).mean() < 1e-3 for image, same in zip(grey, again, strict=True))


def test_no_curve_is_drawn_that_is_not_the_orbits():
    orbit = results.vertical(100)["gamma"].values[0]
    assert curve_through(Ball(J[[1, 0, 2]], D), orbit, D) is None
    assert curve_through(Ball(J, D), np.tile([0.0, 0.0, 1.0], (5, 1)), D) is None
    assert curve_through(Ball(np.ones(3), D), orbit, D) is None
    astray = orbit.copy()
    astray[50] = unit(astray[50] + [1e-3, 0.0, 0.0])
    assert curve_through(Ball(J, D), astray, D) is None


def test_the_polhode_is_that_of_the_momentum_of_a_top():
    dataset = results.top(200)
    momentum = unit(dataset["momentum"].values[0])
    curve = curve_through(Ball(np.array([1.0, 2.0, 4.0]), 0.0), momentum, 0.0)
    assert nearest(momentum, curve) < 0.01
    gamma, sphere_of_momentum = figures.draw(dataset, "spheres").axes
    labels = [axis.get_legend_handles_labels()[1] for axis in (gamma, sphere_of_momentum)]
    assert "invariant curve" not in labels[0]
    assert "invariant curve" in labels[1]


def test_a_vertical_momentum_has_one_sphere_with_its_curve_in_the_axes_that_were_given():
    figure = figures.draw(results.vertical(100), "spheres")
    (axis,) = figure.axes
    assert axis.get_title() == r"$\gamma$, and $\mathcal{K} = h\gamma$"
    assert "invariant curve" in axis.get_legend_handles_labels()[1]
    upwards = results.vertical(100, height=-0.3)
    assert len(figures.draw(upwards, "spheres").axes) == 1
    dataset = results.vertical(100)
    for name in ("gamma", "momentum"):
        dataset[name] = dataset[name].dims, Ball(J, D, axes=AXES).from_principal(dataset[name].values)
    assert "invariant curve" not in figures.draw(dataset, "spheres").axes[0].get_legend_handles_labels()[1]
    dataset["axes"] = ("ball", "quaternion"), AXES[np.newaxis]
    assert "invariant curve" in figures.draw(dataset, "spheres").axes[0].get_legend_handles_labels()[1]


@pytest.mark.filterwarnings("error")
def test_vectors_of_any_size_have_a_direction():
    directions = unit(np.array([[3e300, 0.0, 4e300], [3e-300, 0.0, 4e-300], [0.0, 0.0, 0.0]]))
    assert directions == pytest.approx(np.array([[0.6, 0.0, 0.8], [0.6, 0.0, 0.8], [0.0, 0.0, 0.0]]))


@pytest.mark.parametrize("of_gamma", [True, False])
def test_the_range_of_the_energy_is_that_of_all_states_with_these_integrals(of_gamma):
    rng = np.random.default_rng(5)
    body, cosine = Ball(J, D), 0.3
    directions = unit(rng.standard_normal((20, 3)))
    least, largest = energy_range(body, directions, cosine, of_gamma)
    whole = largest.max() - least.min()
    for direction, low, high in zip(directions, least, largest, strict=True):
        first = unit(np.cross(direction, [0.3, -0.8, 0.52]))
        turn = np.linspace(0, 2 * np.pi, 20_000)[:, np.newaxis]
        across = np.cos(turn) * first + np.sin(turn) * np.cross(direction, first)
        others = cosine * direction + np.sqrt(1 - cosine**2) * across
        here = np.broadcast_to(direction, others.shape)
        m, gamma = (others, here) if of_gamma else (here, others)
        energy = kernels.energy(m, gamma, J, np.float64(D))
        # A parabola through samples 7.5° apart: 1.6e-4 of the whole range was measured; the grey leaves 1e-3 free.
        assert low == pytest.approx(energy.min(), abs=2e-4 * whole)
        assert high == pytest.approx(energy.max(), abs=2e-4 * whole)


@pytest.mark.parametrize(
    "make", [lambda: results.uneven(1000), *slow(lambda: results.bowling(500), lambda: results.folded().isel(ball=[0]))]
)
def test_no_state_of_the_run_is_where_it_is_grey(make):
    dataset = make()
    figure = figures.draw(dataset, "spheres")
    greyed = 0
    for axis, name in zip(figure.axes, ("gamma", "momentum"), strict=True):
        points = unit(dataset[name].values[0])
        x, y, depth = sphere.View.of(points).project(points)
        if not axis.images:
            continue
        alpha = axis.images[0].get_array()[..., 3]
        at = [np.round((v + 1) / 2 * (len(alpha) - 1)).astype(int) for v in (y, x)]
        seen = (depth > 0.1) & (x * x + y * y < 0.98)
        # One pixel of the border, which is rounded.
        around = [alpha[at[0][seen] + i, at[1][seen] + j] for i in (-1, 0, 1) for j in (-1, 0, 1)]
        assert (np.min(around, axis=0) == 0).all()
        greyed += (alpha > 0).mean()
    assert greyed > 0.05


def test_what_is_behind_the_sphere_is_fainter():
    from matplotlib.figure import Figure

    axis = Figure().subplots()
    turn = np.linspace(0, 2 * np.pi, 60, endpoint=False)
    points = np.stack([np.cos(turn), np.sin(turn), 0 * turn], axis=-1)
    view = sphere.View(np.array([1.0, 0, 0]), np.array([0, 0, 1.0]), np.array([0, -1.0, 0]))
    sphere.draw_orbit(axis, view, points, "black")
    drawn = (line for line in axis.lines if len(line.get_xdata()) > 5)
    by_alpha = {line.get_alpha(): np.isfinite(line.get_ydata()).sum() for line in drawn}
    in_front = int((points @ view.towards >= 0).sum())
    assert by_alpha == {1.0: in_front, sphere.BEHIND: 60 - in_front}


def test_neighbours_that_are_far_are_points_and_near_ones_a_line():
    axis = figures.draw(results.top(40, 3), "spheres").axes[1]
    assert any(line.get_marker() == "o" and len(line.get_xdata()) > 5 for line in axis.lines)
    axis = figures.draw(results.bowling(100), "spheres").axes[1]
    assert not any(line.get_marker() == "o" and len(line.get_xdata()) > 1 for line in axis.lines)


@pytest.mark.parametrize("eye", [(0, 0, 1), (0, 0, -1), (1, 0, 0), (0.3, -0.4, 0.87)])
def test_a_view_is_a_right_handed_frame_that_sees_its_eye(eye):
    view = sphere.View.towards_eye(np.array(eye, dtype=float))
    frame = np.stack([view.right, view.up, view.towards])
    assert frame @ frame.T == pytest.approx(np.eye(3), abs=1e-14)
    assert np.linalg.det(frame) == pytest.approx(1.0)
    assert view.towards @ np.array(eye) > 0.8
    assert view.up[2] >= 0


def test_a_small_orbit_is_in_front_and_a_great_circle_is_never_seen_from_its_edge():
    turn = np.linspace(0, 2 * np.pi, 360, endpoint=False)
    circle = np.stack([np.cos(turn), np.sin(turn), 0 * turn], axis=-1)
    for turned in np.linalg.qr(np.random.default_rng(42).standard_normal((200, 3, 3)))[0]:
        small, great = unit(0.3 * circle + [0, 0, 1]) @ turned, circle @ turned
        assert (sphere.View.of(small).project(small)[2] > 0).all()
        x, y, _ = sphere.View.of(great).project(great)
        longest, shortest = np.linalg.svd(np.stack([x, y], axis=-1), compute_uv=False)
        assert shortest > 0.15 * longest  # 0.19 of 2000 is the least


def test_what_is_drawn_is_an_orthogonal_projection_of_the_directions():
    dataset = results.bowling(50)
    for axis, name in zip(figures.draw(dataset, "spheres").axes, ("gamma", "momentum"), strict=True):
        behind, front = (np.array(line.get_xydata()) for line in axis.lines if len(line.get_xdata()) == 51)
        drawn = np.where(np.isfinite(front), front, behind)
        directions = unit(dataset[name].values[0])
        screen, *_ = np.linalg.lstsq(directions, drawn, rcond=None)
        assert directions @ screen == pytest.approx(drawn, abs=1e-12)
        assert screen.T @ screen == pytest.approx(np.eye(2), abs=1e-6)


def test_many_balls_are_a_cloud_in_the_colour_of_time():
    dataset = results.batch(50, 200, 1)
    gamma, _, bar = figures.draw(dataset, "spheres").axes
    count = sum(len(dots.get_offsets()) for dots in gamma.collections)
    assert count == 50 * 201
    assert bar.get_xlabel() == "time, s"


def test_the_parts_of_a_momentum_in_four_dimensions_keep_their_lengths():
    plus, minus = spheres.halves(results.four(300)["momentum"].values[0])
    for part in (plus, minus):
        size = np.sqrt((part**2).sum(axis=-1))
        assert size[0] > 0.1
        assert size == pytest.approx(size[0], rel=1e-13)
    assert len(figures.draw(results.four(50), "spheres").axes) == 4
    assert len(figures.draw(results.four(50), "contact").axes) == 4


def test_the_body_axes_in_space_are_those_of_the_attitude():
    dataset = results.bowling(50)
    globe, below = figures.draw(dataset, "attitude").axes
    quaternions = dataset["attitude"].values[0]
    drawn = [line.get_ydata() for line in below.lines]
    assert all((line == quaternions[:, i]).all() for i, line in enumerate(drawn))
    ends = kernels.rotate(quaternions[-1], np.eye(3)[2])
    x, y, _ = sphere.View.towards_eye(sphere.EYE).project(ends)
    assert any(line.get_marker() == "s" and line.get_xydata()[0] == pytest.approx([x, y]) for line in globe.lines)


def test_quaternions_do_not_jump_where_only_their_sign_does():
    q = results.bowling(60)["attitude"].values.copy()
    flipped = q.copy()
    flipped[0, 20:35] *= -1
    assert (over_time.continued(flipped) == over_time.continued(q)).all()
    assert np.abs(np.diff(over_time.continued(flipped), axis=1)).max() < 0.05


def test_vertical_is_told_from_nearly_vertical():
    gamma = np.tile([0.48, 0.6, 0.64], (3, 1))
    assert invariant.is_vertical(-2 * gamma, gamma)
    assert not invariant.is_vertical(-2 * gamma + [1e-6, 0, 0], gamma)
    assert not invariant.is_vertical(0 * gamma, gamma)

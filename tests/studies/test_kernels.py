"""The errors of the kernels: the measure itself, and what a lost pass costs."""

import json
import math

import numpy as np
import pytest

from benchmarks import kernels
from chapsym.codegen import build, passes
from chapsym.generated import TABLE
from chapsym.proofs.kernels import KERNELS

POINTS = [np.random.default_rng([9, i]).uniform(size=kernels.DRAWN).tolist() for i in range(3)]


def test_an_ulp_is_an_ulp():
    """The measure on a kernel that is off by a known amount."""
    arguments = kernels.arguments("compose", "generic", POINTS[0])
    exact = TABLE["compose"][0](*map(kernels.CONTEXT.mpf, arguments))
    size = max(map(abs, exact))

    def off(*a):
        return exact[0] + 3.5 * 2.0**-52 * size, *exact[1:]

    assert kernels.errors("compose", off, "generic", arguments)[""].ulps == pytest.approx(3.5, rel=1e-9)
    assert kernels.errors("compose", lambda *a: (math.nan,) * 4, "generic", arguments)[""].ulps == math.inf


def test_the_condition_number_is_that_of_the_arguments():
    """⟨𝒦,γ⟩ of nearly orthogonal vectors: Σ 2|Kᵢγᵢ|/|⟨𝒦,γ⟩|."""
    arguments = [1.0, 1.0, 0.0, 0.6, -0.6 * (1 + 1e-9), 0.8]
    found = kernels.errors("invariants", TABLE["invariants"][0], "generic", arguments)
    assert found["h"].condition == pytest.approx(2 * 1.2 / 0.6e-9, rel=1e-6)
    assert found["n"].condition == pytest.approx(2.0)


@pytest.mark.parametrize("stratum", kernels.CHANGES)
def test_every_stratum_makes_what_it_says(stratum):
    for drawn in (*POINTS, [0.0] * kernels.DRAWN, [1.0] * kernels.DRAWN):
        world = kernels.world_of(stratum, drawn)
        assert abs(world.gamma @ world.gamma - 1) <= 4 * kernels.ULP
        assert (world.J >= 0).all()
        assert 0 < world.half <= np.pi / 2
    world = kernels.world_of(stratum, POINTS[1])
    made = {
        "tiny": world.half <= 1e-6, "D = 0": world.D == 0, "D = 1e2 to 1e6": 1e2 <= world.D <= 1e6,
        "D = 1e6 to 1e14": world.D >= 1e6, "spinning about γ": np.abs(np.cross(world.axis, world.gamma)).max() <= 0.02,
        "γ on an axis": np.abs(world.gamma).max() >= 0.99, "near a half turn": world.rotation[0] <= 0.01,
        "nearly equal J": np.ptp(world.J) <= 1e-13, "flat or a needle": world.J.min() <= 1e-3 * world.J.max(),
    }  # fmt: skip
    assert made.get(stratum, True)


#: What each kernel may lose, in ulps per unit of max(1, κ): a few roundings.
SHARE = 3.0
#: By a row the determinants of a ball with D ≫ I are lost: these kernels are not used for such balls.
BY_ROWS = {("gibbs_newton", "det"), ("gibbs_symmetric", "")}
LIGHT = {"generic", "tiny", "D = 0", "γ on an axis", "near a half turn", "nearly equal J"}


@pytest.mark.parametrize("kernel", TABLE)
def test_every_kernel_is_as_good_as_its_arguments(kernel):
    for view, found in kernels.sampled(kernel, TABLE[kernel][0], 2).items():
        for one in found:
            if (kernel, view) not in BY_ROWS or one.stratum in LIGHT:
                assert one.share <= SHARE, (view, one)


@pytest.mark.parametrize(
    ("kernel", "view"),
    [("momentum", "⟨𝒦,γ⟩"), ("residual", "⟨r,γ⟩"), ("gibbs_residual", "⟨r,γ⟩"), ("contact_momentum", "⟨K,γ⟩")],
)
def test_without_its_steps_a_kernel_loses_the_vertical_part(kernel, view):
    """The control: the same polynomial by the entries of B(γ), which is the text without the pass `factored`."""
    chosen = tuple(name for name in passes.PASSES if name != "factored")
    scope = {}
    exec(build.code(next(one for one in KERNELS if one.name == kernel), chosen), scope)
    assert max(one.share for one in kernels.sampled(kernel, scope[kernel], 6)[view]) > 1e3


def test_by_a_row_the_determinant_is_lost_and_by_the_vertical_it_is_not():
    worst = {
        name: max(one.share for one in kernels.sampled("gibbs_newton", TABLE[name][0], 6)["det"])
        for name in ("gibbs_newton", "gibbs_newton_heavy")
    }
    assert worst["gibbs_newton"] > 1e3
    assert worst["gibbs_newton_heavy"] <= SHARE


def printed_velocity(*arguments):
    """ω by Λ⁻¹K + (D⟨γ,Λ⁻¹K⟩/(1 - D⟨γ,Λ⁻¹γ⟩)) Λ⁻¹γ, as printed: 1 - D⟨γ,Λ⁻¹γ⟩ cancels for D ≫ J."""
    K, g, J = np.reshape(arguments[:9], (3, 3))
    D = arguments[9]
    moments = J.sum() - J + D
    return tuple(K / moments + D * (g @ (K / moments)) / (1 - D * (g @ (g / moments))) * g / moments)


def test_the_printed_form_of_the_velocity_fails_where_it_cancels():
    found = kernels.sampled("angular_velocity", printed_velocity, 6)[""]
    worst = {name: max(one.share for one in found if one.stratum == name) for name in ("D = 0", "D = 1e6 to 1e14")}
    assert worst["D = 0"] <= SHARE
    assert worst["D = 1e6 to 1e14"] > 1e3


def test_measured_rows():
    seen = []
    found = kernels.Kernels(True, seen.append, ["energy", "momentum"])
    assert seen == ["kernels: energy", "kernels: momentum"]
    outputs = [("energy", ""), ("momentum", "𝒦"), ("momentum", "⟨𝒦,γ⟩")]
    assert [(r["kernel"], r["output"]) for r in found.rows] == outputs
    for row in found.rows:
        kernel, worst = row["kernel"], row["worst"]
        assert set(row["strata"]) == set(kernels.CHANGES)
        assert worst.ulps == max(row["strata"].values())
        assert row["hardest"].share >= worst.share
        again = kernels.errors(kernel, TABLE[kernel][0], worst.stratum, worst.arguments)
        assert again[row["output"]] == worst  # it can be replayed
    plain = json.loads(json.dumps(found.as_json(), allow_nan=False))["kernels"]
    assert plain[0]["worst"]["arguments"]
    assert len(found.table()) == len(found.rows)

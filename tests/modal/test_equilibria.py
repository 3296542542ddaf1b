"""All static equilibria: against closed forms, elliptic integrals, and SciPy on the potential energy."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from itertools import product

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_bvp
from scipy.optimize import brentq, minimize
from scipy.special import ellipe, ellipk

from tmm_gen.errors import UserError
from tmm_gen.modal.equilibria import Equilibria, Equilibrium, equilibria, free_joints
from tmm_gen.scene import Scene, parse_scene
from tmm_gen.simulate.places import node_places

HEAD = """\
name = "arm"
model = { kind = "planar", gravity = 9.81 }
integrator = { name = "newmark", step = 1e-3 }
"""
LINKS = (
    HEAD
    + """\
base = { kind = "clamp" }
output = [{ name = "tip", at = "b", of = "position" }]
motor = [{ name = "m", gear = 20 }]
joint = [{ name = "h", on = "a" }]
link = [
  { name = "a", on = "m", length = 0.5, mass = 2.0, inertia = 0.05 },
  { name = "b", on = "h", length = 0.4, mass = 1.0, inertia = 0.02, center = 0.25 },
]
input = [
  { name = "torque", at = "m", acts = "torque" },
  { name = "side", at = "b", acts = "force_x" },
]
"""
)
BEAM = (
    HEAD
    + """\
base = { kind = "clamp" }
tip = { mass = 1e-9 }
output = [{ name = "tip", at = "tip", of = "position" }]
[beam]
length = 1.0
bending_stiffness = 2.0
mass_per_length = 0.5
links = 10
"""
)


def turned(found: Equilibria) -> list[tuple[float, ...]]:
    return [tuple(np.round(each.rest.free_angles, 9)) for each in found.found]


def tip(scene: Scene, each: Equilibrium) -> NDArray[np.float64]:
    return np.concatenate(node_places(scene, each.rest.angles[None]))[:, -1]


def test_two_links_hang_or_stand_in_four_ways() -> None:
    scene = parse_scene(LINKS)
    found = equilibria(scene)
    down, up = -np.pi / 2, np.pi / 2
    assert len(found.found) == 4
    standing = {tuple(np.sign(np.sin(e.rest.angles))): e for e in found.found}
    for a, b in product((down, up), repeat=2):
        each = standing[np.sign(a), np.sign(b)]
        assert np.sin(each.rest.angles) == pytest.approx(np.sin([a, b]), abs=1e-12)
        assert each.falls == (a > 0) + (b > 0)  # each link that stands can fall
        assert each.stable == (a < 0 and b < 0)
        assert each.rest.inner[0] == pytest.approx(
            [0.0, 9.81 * 3.0, 0.0], abs=1e-12
        )  # both weights, no torque
    assert [each.reached for each in found.found] == [True, False, False, False]
    assert found.found[0].stable
    assert found.starts == 16
    assert free_joints(scene) == (1, 2)


def test_a_torque_holds_the_weights_on_either_side() -> None:
    weights = 9.81 * (2.0 * 0.25 + 1.0 * 0.5)
    at = np.arccos(20 * 0.4 / weights)
    found = equilibria(parse_scene(LINKS), {"torque": 0.4}).found
    assert sorted((e.rest.angles[0], e.falls) for e in found) == [
        (pytest.approx(-at, abs=1e-12), 0),  # the second link hangs
        (pytest.approx(-at, abs=1e-12), 1),  # or stands
        (pytest.approx(at, abs=1e-12), 1),
        (pytest.approx(at, abs=1e-12), 2),
    ]
    assert all(e.rest.inner[0, 2] == pytest.approx(20 * 0.4) for e in found)
    with pytest.raises(UserError, match="no static equilibrium"):
        equilibria(parse_scene(LINKS), {"torque": 0.6})


@pytest.mark.parametrize("side", [0.5, -30.0, 1e4])
def test_each_link_stands_along_its_load(side: float) -> None:
    """Along or against the force that its weight and the push at the tip make at its end."""
    found = equilibria(parse_scene(LINKS), {"side": side}).found
    lower = np.arctan2(-9.81 * 1.0 * 0.25, side)
    upper = np.arctan2(-9.81 * (2.0 * 0.5 + 1.0), side)
    assert len(found) == 4
    against = set()
    for each in found:
        along = np.cos(each.rest.angles - [upper, lower])
        assert np.abs(along) == pytest.approx(1.0, abs=1e-12)
        assert each.falls == np.sum(along < 0.0)
        against.add(tuple(along < 0.0))
    assert len(against) == 4


def test_without_weight_an_arm_stays_wherever_it_is_put() -> None:
    found = equilibria(parse_scene(LINKS).replace(**{"model.gravity": 0.0, "initial.angles": 0.3})).found
    assert [(e.idle.shape[1], e.falls, e.stable, e.reached) for e in found] == [(2, 0, False, True)]
    assert found[0].rest.angles == pytest.approx(0.3)


def test_a_hub_that_nothing_holds_does_not_hide_how_links_stand_on_it() -> None:
    """A free hinge on a free hub: the hub stays anywhere, the link hangs or stands."""
    text = LINKS.replace('{ kind = "clamp" }', '{ kind = "motor", inertia = 0.1 }').replace(
        "motor = [", "joint = [", 1
    )
    text = text.replace(
        'joint = [{ name = "m", gear = 20 }]\njoint = [{ name = "h"', 'joint = [{ name = "m" }, { name = "h"'
    )
    found = equilibria(parse_scene(text)).found
    assert sorted((e.falls, e.idle.shape[1]) for e in found) == [(0, 1), (1, 1), (1, 1), (2, 1)]
    assert [e.state for e in found] == ["stays anywhere", *["falls over"] * 3]


def test_an_arm_that_starts_upright_is_said_to_fall() -> None:
    found = equilibria(parse_scene(LINKS).replace(**{"initial.angles": np.pi / 2})).found
    assert found[0].reached
    assert found[0].falls == 2
    assert sum(e.stable for e in found) == 1


def test_a_wound_up_start_is_the_same_equilibrium() -> None:
    plain = turned(equilibria(parse_scene(LINKS)))
    wound = turned(equilibria(parse_scene(LINKS).replace(**{"initial.angles": [12.5, -18.0]})))
    assert np.sin(sorted(wound)) == pytest.approx(np.sin(sorted(plain)), abs=1e-9)
    assert np.max(np.abs(wound)) < 2.0 * np.pi


def elastica(stiffness: float, weight: float) -> NDArray[np.float64]:
    """Return the tip of a clamped beam of 1 m, level at its root, that droops under its weight per length."""

    def slope(s: NDArray[np.float64], y: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.array([y[1], weight * (1.0 - s) * np.cos(y[0]) / stiffness, np.cos(y[0]), np.sin(y[0])])

    def ends(a: NDArray[np.float64], b: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.array([a[0], b[1], a[2], a[3]])

    along = np.linspace(0.0, 1.0, 50)
    solved = solve_bvp(slope, ends, along, np.array([0 * along, 0 * along, along, 0 * along]), tol=1e-8)
    assert solved.success
    return np.array([solved.y[2, -1], solved.y[3, -1]])


@pytest.mark.parametrize("stiffness", [0.2, 2.0])
def test_a_cantilever_droops_as_the_elastica(stiffness: float) -> None:
    scene = parse_scene(BEAM).replace(**{"beam.bending_stiffness": stiffness})
    exact = elastica(stiffness, 9.81 * 0.5)
    errors = []
    for links in (20, 40, 80):
        cut = scene.replace(**{"beam.links": links})
        (each,) = equilibria(cut).found
        assert each.stable
        errors.append(np.hypot(*(tip(cut, each) - exact)))
    assert errors[-1] < 1e-3
    assert np.log2(errors[1] / errors[2]) == pytest.approx(2.0, abs=0.1)


def test_a_column_buckles_to_either_side_as_far_as_elliptic_integrals_say() -> None:
    """Euler (1744): P/P_crit = (2 K(k)/pi)^2, and the tip comes down to L (2 E(k)/K(k) - 1)."""
    load = 1.3
    critical = np.pi**2 * 2.0 / 4.0
    standing = BEAM.replace('{ kind = "clamp" }', '{ kind = "prescribed", inertia = 1.0 }')
    scene = parse_scene(standing + '[[input]]\nname = "root"\nat = "base"\nacts = "angle"\n').replace(
        **{
            "beam.mass_per_length": 1e-9,
            "beam.links": 80,
            "tip.mass": load * critical / 9.81,
            "initial.angles": np.pi / 2,
        }
    )
    found = sorted(equilibria(scene, {"root": np.pi / 2}).found, key=lambda e: -e.falls)
    assert [e.falls for e in found] == [1, 0, 0]
    assert tip(scene, found[0]) == pytest.approx([0.0, 1.0])
    m = brentq(lambda m: (2.0 * ellipk(m) / np.pi) ** 2 - load, 1e-9, 0.9)
    height = 2.0 * ellipe(m) / ellipk(m) - 1.0
    left, right = (tip(scene, each) for each in found[1:])
    assert left == pytest.approx(right * [-1.0, 1.0], abs=1e-9)
    assert left[1] == pytest.approx(height, abs=2e-3)


def potential(scene: Scene, given: Mapping[str, float]) -> Callable[[NDArray[np.float64]], float]:
    """Return the energy of weights, springs with slack angles, and constant loads, written down once more."""

    def energy(angles: NDArray[np.float64]) -> float:
        turned = np.concatenate([[0.0], angles])
        hosts = [scene.host(joint) for joint in range(1, scene.stations + 1)]
        twists = angles - turned[hosts]
        outer = np.concatenate(node_places(scene, angles[None]))[:, 1:]
        total = 0.0
        for joint, link, twist, angle, end in zip(
            scene.joints, scene.links, twists, angles, outer[1], strict=True
        ):
            total += 0.5 * joint.stiffness * (twist - joint.rest) ** 2
            total += 9.81 * link.mass * (end - (1.0 - link.center) * link.length * np.sin(angle))
        total += 9.81 * scene.tip.mass * outer[1, -1] if scene.tip else 0.0
        for item in scene.inputs:
            if item.acts == "drive" and isinstance(item.at, int):
                total -= scene.joints[item.at - 1].gear * given.get(item.name, 0.0) * twists[item.at - 1]
            else:
                total -= given.get(item.name, 0.0) * outer[0, -1]  # side, at the tip
        return float(total)

    return energy


@pytest.mark.parametrize(
    ("name", "given"),
    [
        ("links", {"torque": 0.2, "side": 3.0}),
        ("elbow", {"shoulder_torque": 0.02}),
        ("elbow", {"shoulder_torque": 0.01, "elbow_torque": -0.008}),
    ],
)
def test_stable_shapes_are_minima_of_the_potential_energy(
    name: str, given: dict[str, float], scene_named: Callable[[str], Scene]
) -> None:
    sprung = LINKS.replace('on = "a" }', 'on = "a", stiffness = 2.0, rest = 0.4 }')
    scene = parse_scene(sprung) if name == "links" else scene_named(name)
    found = [e for e in equilibria(scene, given).found if e.stable]
    assert found
    for each in found:
        start = each.rest.angles + 0.02 * np.cos(np.arange(len(each.rest.angles)))
        solved = minimize(potential(scene, given), start, method="BFGS", options={"gtol": 1e-7})
        assert each.rest.angles == pytest.approx(solved.x, abs=1e-5)

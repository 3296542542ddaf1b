"""Numbers of an arm that nothing holds are found from records that equations written apart have made.

The equations here know nothing of scenes: Lagrange's for a planar tree whose root moves freely, from Jacobians of its
masses, integrated by SciPy.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from tmm_gen.calibration.calibrate import Calibration, calibrate
from tmm_gen.calibration.fitted_keys import default_keys
from tmm_gen.errors import UserError
from tmm_gen.inputs.signals import Table
from tmm_gen.resources import scenes_dir
from tmm_gen.scene import Scene, load_scene, parse_scene

pytestmark = pytest.mark.compiler

Array = NDArray[np.float64]
Torque = Callable[[float], float]
NOISE = 1e-3
"""Of a sensor, as a share of each column's standard deviation."""


@dataclass(frozen=True)
class Piece:
    """A rigid piece with its mass in the middle, and the joint at its inner end; the first one is the base."""

    host: int
    length: float
    mass: float
    inertia: float
    stiffness: float = 0.0
    damping: float = 0.0
    rest: float = 0.0
    angle: float = 0.0
    rate: float = 0.0


@dataclass(frozen=True)
class Motion:
    """Place of the base (complex), angles and rates of all pieces, places of their outer ends, by instants."""

    base: NDArray[np.complex128]
    angles: Array
    rates: Array
    ends: NDArray[np.complex128]


def still(_time: float) -> float:
    return 0.0


def floated(pieces: list[Piece], times: Array, torque: Torque = still, force: Torque = still) -> Motion:
    """Return the motion under a torque and a force along y on the base."""
    n = len(pieces)
    mass, inertia, stiffness, damping, rest, length = (
        np.array([getattr(piece, key) for piece in pieces])
        for key in ("mass", "inertia", "stiffness", "damping", "rest", "length")
    )
    inner, bent = np.zeros((n, n)), np.eye(n)
    for k, piece in enumerate(pieces[1:], start=1):
        inner[k] = inner[piece.host]
        inner[k, piece.host] += length[piece.host]
        bent[k, piece.host] = -1.0
    ends = inner + np.diag(length)
    middle = 0.5 * (inner + ends)
    along_x, along_y = np.tile([1.0, 0.0], (n, 1)), np.tile([0.0, 1.0], (n, 1))

    def rates(time: float, x: Array) -> Array:
        q, v = x[2 : n + 2], x[n + 4 :]
        to_x, to_y = np.hstack([along_x, -middle * np.sin(q)]), np.hstack([along_y, middle * np.cos(q)])
        total = to_x.T * mass @ to_x + to_y.T * mass @ to_y
        total[2:, 2:] += np.diag(inertia)
        inward_x, inward_y = middle * np.cos(q) @ v**2, middle * np.sin(q) @ v**2
        acting = to_x.T @ (mass * inward_x) + to_y.T @ (mass * inward_y)
        acting[2:] -= bent.T @ (stiffness * (bent @ q - rest) + damping * (bent @ v))
        acting[1:3] += force(time), torque(time)
        return np.concatenate([x[n + 2 :], np.linalg.solve(total, acting)])

    start = [0.0, 0.0, *(p.angle for p in pieces), 0.0, 0.0, *(p.rate for p in pieces)]
    found = solve_ivp(
        rates, (0.0, times[-1]), start, t_eval=times, method="LSODA", rtol=1e-10, atol=1e-12
    ).y.T
    base, angles = found[:, 0] + 1j * found[:, 1], found[:, 2 : n + 2]
    return Motion(base, angles, found[:, n + 4 :], base[:, None] + np.exp(1j * angles) @ ends.T)


def signal(until: float, size: float, seed: int) -> tuple[Table, Torque]:
    """Return what goes from one random value to another, in eight straight lines."""
    times = np.linspace(0.0, until, 9)
    values = size * np.random.default_rng(seed).uniform(-1.0, 1.0, 9)
    return Table(times, values), lambda t: float(np.interp(t, times, values))


Made = tuple[Scene, dict[str, Table], dict[str, float]]
"""An arm, a record of another one like it, and the numbers of that one."""

SPRINGS = {
    "joint.left_latch.stiffness": 45.0,
    "beam.left_panel.bending_stiffness": 12.0,
    "joint.right_latch.stiffness": 80.0,
    "beam.right_panel.bending_stiffness": 7.0,
}
DAMPERS = {
    "joint.left_latch.damping": 0.03,
    "beam.left_panel.damping_time": 2e-3,
    "joint.right_latch.damping": 0.012,
    "beam.right_panel.damping_time": 1.5e-3,
}


@pytest.fixture(scope="module")
def cube() -> Made:
    """The satellite with all springs and dampers others; two pieces in each panel, for the time it takes."""
    scene = load_scene(scenes_dir() / "cube.toml").replace(
        **{"beam.left_panel.links": 2, "beam.right_panel.links": 2},
        **{"integrator.name": "sdirk4", "integrator.step": 1e-3},
    )
    truth, until = SPRINGS | DAMPERS, 1.6
    wheel, at_wheel = signal(until, 3.0, 1)
    thruster, at_thruster = signal(until, 8.0, 2)
    pieces = [Piece(-1, 0.0, 14.0, 0.12)]
    for side, rest in (("left", np.pi), ("right", 0.0)):
        latch = truth[f"joint.{side}_latch.stiffness"], truth[f"joint.{side}_latch.damping"]
        root = len(pieces)
        pieces.append(Piece(0, 0.15, 0.12, 2.25e-4, *latch, rest, rest))
        spring = truth[f"beam.{side}_panel.bending_stiffness"] / 0.6
        for k, (far, times) in enumerate(((0.6, 2.0), (0.3, 1.0))):
            law = times * spring, times * spring * truth[f"beam.{side}_panel.damping_time"]
            pieces.append(Piece(root + k, far, 1.4 * far, 1.4 * far**3 / 12, *law, 0.0, rest))
    times = np.linspace(0.0, until, 401)
    moved = floated(pieces, times, at_wheel, at_thruster)
    bent, turning = (of[:, 4] - of[:, 0] for of in (moved.angles, moved.rates))
    columns = {
        "attitude": moved.angles[:, 0],
        "hub_x": moved.base.real,
        "hub_y": moved.base.imag,
        "right_end_x": moved.ends[:, 6].real,
        "right_end_y": moved.ends[:, 6].imag,
        "latch_torque": -pieces[4].stiffness * bent - pieces[4].damping * turning,
    }
    record = {name: Table(times, values) for name, values in columns.items()}
    return scene, record | {"wheel": wheel, "thruster": thruster}, truth


def errors(done: Calibration, truth: Mapping[str, float]) -> dict[str, float]:
    assert {found.key for found in done.found} == set(truth)
    return {found.key: found.value / truth[found.key] - 1.0 for found in done.found}


def test_springs_and_dampers_of_an_arm_that_floats_are_found(cube: Made) -> None:
    """All of both panels and latches at once, as nothing else is said."""
    scene, record, truth = cube
    assert set(default_keys(scene)) == set(truth)
    done = calibrate(scene, record)
    off = errors(done, truth)
    assert max(abs(off[key]) for key in SPRINGS) < 1e-6
    assert max(abs(off[key]) for key in DAMPERS) < 1e-4
    assert done.misfit < 1e-6
    assert done.misfit_before > 0.05


def test_within_their_deviations_under_noise(cube: Made) -> None:
    scene, record, truth = cube
    random = np.random.default_rng(1)
    noisy = {
        name: t
        if name in ("wheel", "thruster")
        else Table(t.times, t.values + NOISE * np.std(t.values) * random.standard_normal(len(t.times)))
        for name, t in record.items()
    }
    known = scene.replace(**DAMPERS)
    done = calibrate(known, noisy, list(SPRINGS))
    assert done.misfit == pytest.approx(NOISE, rel=0.1)
    for found in done.found:
        assert abs(found.value - truth[found.key]) < 4.0 * found.deviation
        assert found.deviation < 0.05 * found.value


def test_masses_of_what_floats_are_found(cube: Made) -> None:
    """Of the body that is the base, and of what hangs on it."""
    scene, record, truth = cube
    right = {
        "body.hub.mass": 14.0,
        "body.hub.inertia": 0.12,
        "beam.right_panel.mass_per_length": 1.4,
        "joint.left_latch.stiffness": 45.0,
    }
    wrong = {"body.hub.mass": 9.0, "body.hub.inertia": 0.2, "beam.right_panel.mass_per_length": 1.1}
    done = calibrate(
        scene.replace(**truth | wrong | {"joint.left_latch.stiffness": 60.0}), record, list(right)
    )
    assert max(map(abs, errors(done, right).values())) < 1e-6
    assert done.scene.base.inertia == pytest.approx(0.12, rel=1e-6)


FLYWHEEL = """
name = "flywheel"
[model]
kind = "planar"
[integrator]
name = "sdirk4"
step = 2e-3
[base]
kind = "free"
[[body]]
name = "rim"
on = "base"
mass = 2.0
inertia = 0.05
[[joint]]
name = "hinge"
on = "base"
stiffness = 0.9
[[link]]
name = "vane"
on = "hinge"
length = 0.4
mass = 0.3
inertia = 0.004
[initial]
angles = 0.5
rates = 1.0
[[output]]
name = "rim"
at = "rim"
of = "angle"
[[output]]
name = "vane"
at = "vane"
of = "angle"
"""


def test_what_no_force_tells_is_refused_with_what_can_be_fitted() -> None:
    """Without a force from outside all masses and springs may be twice as large: nothing moves otherwise."""
    times = np.linspace(0.0, 2.0, 201)
    vane = Piece(0, 0.4, 0.3, 0.006, 0.9, angle=0.5, rate=1.0)
    moved = floated([Piece(-1, 0.0, 2.0, 0.04, angle=0.0), vane], times)
    record = {name: Table(times, moved.angles[:, k]) for k, name in enumerate(("rim", "vane"))}
    scene = parse_scene(FLYWHEEL)
    keys = [
        "body.rim.mass",
        "body.rim.inertia",
        "joint.hinge.stiffness",
        "link.vane.mass",
        "link.vane.inertia",
    ]
    with pytest.raises(UserError, match="does not tell") as caught:
        calibrate(scene, record, keys)
    offered = re.findall(r"--fit (\S+?)[; ]", str(caught.value))
    assert len(offered) == 2  # of five, only two ratios of which move anything
    done = calibrate(scene, record, offered)
    assert done.misfit < 1e-6
    inertias = {"body.rim.inertia": 0.04, "link.vane.inertia": 0.006}
    assert max(map(abs, errors(calibrate(scene, record, list(inertias)), inertias).values())) < 1e-6

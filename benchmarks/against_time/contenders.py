"""Who takes part: for each a setting (a step, a tolerance), the error it leaves and the time it takes."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import casadi as ca
import numpy as np
from numpy.typing import NDArray
from peers.articulated import Articulated, step_function
from peers.joint_arm import JointArm, joint_arm
from peers.planar_solvers import Cvodes, Mujoco, Scipy, rk4_function
from time_to_error import CHECKPOINTS, FLAGS, Run, arm

from tmm_gen.native import FLAGS as EXACT
from tmm_gen.native import compile_kernel
from tmm_gen.native.batch import compile_batch
from tmm_gen.native.machine import machine_flags
from tmm_gen.program.build import build_program

Array = NDArray[np.float64]

OURS = ("newmark", "sdirk4", "radau3")
COUNTS = tuple(sorted({round(2 ** (k / 2)) for k in range(25)}))
"""Steps between checkpoints."""
TOLERANCES = tuple(10.0**-k for k in range(3, 13))
LANES = 8
"""Arms side by side in a vector."""
_STEPS = 100_000
"""Of all arms together, about, in one run of many."""
_SAMPLE = 2000
_LONGEST = 1.0
"""Nobody is followed to runs that take longer, s."""
_MOST_ACCURATE = 1e-9
"""Or that leave less, m: the truth is not known much better."""


@dataclass(frozen=True, eq=False)
class Contender:
    """Somebody's way to compute the second.

    Parameters
    ----------
    name : str
    panel : str
        "one" arm, or "many".
    settings : sequence of float
        From the coarsest to the finest: steps between checkpoints, or tolerances.
    error : callable
        Takes a setting and returns the largest error of the tip at the checkpoints, m.
    seconds : callable
        Takes a setting and measures once what the second took for one arm, s.
    """

    name: str
    panel: str
    settings: Sequence[float]
    error: Callable[[float], float]
    seconds: Callable[[float], float]


def contenders(links: int, truth: Array) -> list[Contender]:
    """Return everybody for an arm of so many links.

    Parameters
    ----------
    links : int
    truth : array, (10, 2)
        Where the tip is at the checkpoints, m.
    """
    jointed = joint_arm(arm("gravity", links, "newmark"))
    found = [_ours(name, links, truth) for name in OURS]
    return [*found, *peers(jointed, truth), *(_many(name, links, truth) for name in OURS)]


def peers(jointed: JointArm, truth: Array) -> list[Contender]:
    """Return everybody else for an arm that falls, tips being where truth says."""
    return [
        _in_c("articulated bodies in C, Newmark", jointed, truth, step_function, 3),
        _in_c("articulated bodies in C, RK4", jointed, truth, rk4_function, 2),
        _mujoco("MuJoCo, implicit", jointed, truth, "implicit"),
        _mujoco("MuJoCo, RK4", jointed, truth, "RK4"),
        _by_tolerance("CVODES", Cvodes(jointed, CHECKPOINTS).at_tolerance, jointed, truth),
        _by_tolerance("SciPy, LSODA", Scipy(jointed, CHECKPOINTS, "LSODA").at_tolerance, jointed, truth),
    ]


def useful(contender: Contender) -> list[tuple[float, float]]:
    """Return settings and their errors: those that work, until the error is nearly that of the truth or time is up."""
    found = []
    for setting in contender.settings:
        error = contender.error(setting)
        if not np.isfinite(error):
            continue
        found.append((setting, error))
        if error < _MOST_ACCURATE or contender.seconds(setting) > _LONGEST:
            break
    return found


def _tips(jointed: JointArm, angles: Array) -> Array:
    turned = np.cumsum(angles, axis=1)
    return np.column_stack([np.cos(turned) @ jointed.lengths, np.sin(turned) @ jointed.lengths])


def _off(places: Array, truth: Array) -> float:
    if places.shape != truth.shape or not np.isfinite(places).all():
        return math.inf
    found = float(np.max(np.linalg.norm(places - truth, axis=1)))
    return found if found < 1.0 else math.inf  # farther off than the arm is long: diverged


def _ours(name: str, links: int, truth: Array) -> Contender:
    scene = arm("gravity", links, name)
    run = Run(compile_kernel(build_program(scene), scene, flags=FLAGS), None, truth)
    return Contender(
        f"tmm-gen, {name}",
        "one",
        COUNTS,
        lambda count: run.error(int(count)),
        lambda count: run.timer(int(count))(),
    )


def _many(name: str, links: int, truth: Array) -> Contender:
    """Return the same arm so often, in vectors of several: their bits are those of the kernel for one."""
    scene = arm("gravity", links, name).replace(**{"emit.batch": LANES})
    flags = ("-O3", *EXACT[1:], *machine_flags("gcc"))
    batch = compile_batch(build_program(scene), scene, flags=flags)
    end = float(CHECKPOINTS[-1])

    def simulated(count: int, until: float) -> tuple[Array, float]:
        """Return the places of all tips, (instants, arms, 2), and the time it took, s."""
        arms = min(4096, max(8 * LANES, _STEPS // (len(CHECKPOINTS) * count)))
        begun = time.process_time()
        found = batch.simulate(until, step=0.1 / count, arms=arms, every=count, threads=1)
        seconds = time.process_time() - begun
        return np.stack([found.outputs["tip_x"], found.outputs["tip_y"]], axis=-1), seconds

    def error(setting: float) -> float:
        places, _ = simulated(int(setting), end)
        return max(_off(places[1:, k], truth) for k in range(places.shape[1]))

    def seconds(setting: float) -> float:
        places, whole = simulated(int(setting), end)
        _, start = simulated(int(setting), 0.0)
        each: float = (whole - start) / places.shape[1]
        return each

    return Contender(f"tmm-gen, {name}", "many", COUNTS, error, seconds)


def _in_c(
    name: str, jointed: JointArm, truth: Array, step: Callable[[JointArm], ca.Function], kinds: int
) -> Contender:
    """Return a step in C; one of some length serves for the time of all."""
    n, known = len(jointed.lengths), {}

    def at(count: int) -> Articulated:
        if count not in known:
            known[count] = Articulated(replace(jointed, step=0.1 / count), np.zeros(0), step)
        return known[count]

    def start(stepping: Articulated) -> Array:
        return stepping.started(np.zeros(n), np.zeros(n))[: kinds * n]

    def error(setting: float) -> float:
        stepping, found = at(int(setting)), []
        motion = start(stepping)
        for _ in CHECKPOINTS:
            motion, _ = stepping.advance(motion, int(setting))
            found.append(motion[:n])
        return _off(_tips(jointed, np.array(found)), truth)

    def seconds(setting: float) -> float:
        stepping = at(COUNTS[-1])
        _, taken = stepping.advance(start(stepping), _SAMPLE)
        return taken / _SAMPLE * len(CHECKPOINTS) * setting

    return Contender(name, "one", COUNTS, error, seconds)


def _mujoco(name: str, jointed: JointArm, truth: Array, method: str) -> Contender:
    peer, times = Mujoco(jointed, method), len(CHECKPOINTS)
    return Contender(
        name,
        "one",
        COUNTS,
        lambda count: _off(_tips(jointed, peer.advance(0.1 / count, int(count), times)[0]), truth),
        lambda count: peer.advance(0.1 / count, int(count), times)[1],
    )


def _by_tolerance(
    name: str, solve: Callable[[float], tuple[Array, float]], jointed: JointArm, truth: Array
) -> Contender:
    return Contender(
        name,
        "one",
        TOLERANCES,
        lambda tolerance: _off(_tips(jointed, solve(tolerance)[0]), truth),
        lambda tolerance: solve(tolerance)[1],
    )

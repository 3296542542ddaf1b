# thesis10: Ten-station torsional chain, Gholampour (2018), table 4-1
#
# Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
# scene digest: f0c976d21d4524b79e43b0ef658e9df768725b961ac09b0a12bdaf9596a590df
# sha256 of the rest of this file: a9d749ce6c55ce6e18eb64e6e70221183a275b3f299ab701f03fbb37d5a6f410
#
# model: torsional chain (linear)
# stations: 10
# base: clamp
# integrator: Newmark 1959, beta = 0.25, gamma = 0.5
# sweep: riccati
# unknown: acceleration
# operations of a step: 220, 22 per station (110 additions, 110 multiplications)
# operations of prepare: 69, 6.9 per station (21 additions, 38 multiplications, 10 divisions)
"""thesis10: Ten-station torsional chain, Gholampour (2018), table 4-1. Functions for optimisation and
control.

Columns: ``x`` the state (STATE_NAMES), ``u`` the inputs (INPUT_NAMES), ``p`` the step and the physical
parameters (PARAMETER_NAMES), ``y`` the outputs (OUTPUT_NAMES). The same operations in the same order as in
the NumPy kernel; pivots are not checked, since symbols have no sign.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import casadi as ca


def _numbered(name: str, count: int) -> tuple[str, ...]:
    """Return the names of an array's elements, base to tip."""
    return tuple(f"{name}_{station}" for station in range(1, count + 1))


STATIONS = 10
"""Number of links."""
STATE_NAMES: tuple[str, ...] = (
    *_numbered("angle", 10),
    *_numbered("rate", 10),
    *_numbered("acceleration", 10),
)
INPUT_NAMES: tuple[str, ...] = ("tip_torque",)
OUTPUT_NAMES: tuple[str, ...] = ("tip", "base_torque")
PARAMETER_NAMES: tuple[str, ...] = ("step", "stiffness", "damping", "inertia")
STAGE_INSTANTS = ((1.0,),)
"""When inputs are read, in steps from the start of the step."""


def default_parameters() -> ca.DM:
    """Return the scene's step and physical parameters, a column ``p``."""
    values = (0.01, 20.0, 5.0, 1.0)
    return ca.DM(values)


def step_function() -> ca.Function:
    """Return the step ``(x, u, p) -> (x_next, y)``: the state one step later, and the outputs at ``x``."""
    return _function("thesis10_step", _step, STAGE_INSTANTS[-1])


def start_functions() -> tuple[ca.Function, ...]:
    """Return the functions of the first steps, to be used before that of :func:`step_function`, each once.

    This integrator needs none.
    """
    return ()


def initial_function() -> ca.Function:
    """Return the start ``(initial_angle, initial_rate, u, p) -> x``.

    Start from given angles and rates with the acceleration that satisfies the equations of motion.
    """
    given = {
        "initial_angle": ca.SX.sym("initial_angle", 10),  # angles to start from (rad)
        "initial_rate": ca.SX.sym("initial_rate", 10),  # rates to start from (rad/s)
    }
    u, p = _symbols(INPUT_NAMES), _symbols(PARAMETER_NAMES)
    with _as_written():
        x = _initialise(given, [u], p)
    return ca.Function("thesis10_initial", [*given.values(), u, p], [x], [*given, "u", "p"], ["x"])


def _function(
    name: str,
    advance: Callable[[dict[str, Any], ca.SX, Sequence[ca.SX]], ca.SX],
    instants: Sequence[float],
) -> ca.Function:
    """Build a step with its outputs."""
    x, p = _symbols(STATE_NAMES), _symbols(PARAMETER_NAMES)
    u = _symbols(INPUT_NAMES)
    stages = [u] * len(instants)
    with _as_written():
        model = _prepare(p)
        results = [advance(model, x, stages), _output(model, x, stages)]
    return ca.Function(name, [x, u, p], results, ["x", "u", "p"], ["x_next", "y"])


@contextmanager
def _as_written() -> Iterator[None]:
    """Keep CasADi from reordering operations: results are those of the other backends to the last bit."""
    before = ca.GlobalOptions.getSimplificationOnTheFly()
    ca.GlobalOptions.setSimplificationOnTheFly(False)
    try:
        yield
    finally:
        ca.GlobalOptions.setSimplificationOnTheFly(before)


def _symbols(names: Sequence[str]) -> ca.SX:
    """Return a column of named symbols."""
    return _column(*(ca.SX.sym(name) for name in names))


def _column(*items: Any) -> ca.SX:
    """Put symbols and numbers in a column."""
    return ca.SX(ca.vertcat(*items)) if items else ca.SX(0, 1)


def _prepare(p: ca.SX) -> dict[str, Any]:
    """Compute what depends on parameters and step alone."""
    step = p[0]
    stiffness = p[1]
    damping = p[2]
    inertia = p[3]
    admittance: list[Any] = [0.0] * STATIONS
    reflection: list[Any] = [0.0] * STATIONS
    transmission: list[Any] = [0.0] * STATIONS

    # factors of the sweep that do not change from step to step
    impedance: Any = 0.0
    joint_impedance = 0.5 * damping * step + 0.25 * (step * step) * stiffness
    for j in reversed(range(STATIONS)):
        impedance = impedance - inertia
        pivot = joint_impedance - impedance
        admittance[j] = 1.0 / pivot
        transmission[j] = admittance[j] * joint_impedance
        reflection[j] = -admittance[j] * impedance
        impedance = impedance * transmission[j]

    # Factors of the step that depend on the time step and parameters alone
    rate_per_acceleration = 0.5 * step
    angle_per_acceleration = 0.25 * (step * step)
    return {
        "step": step,
        "stiffness": stiffness,
        "damping": damping,
        "rate_per_acceleration": rate_per_acceleration,
        "angle_per_acceleration": angle_per_acceleration,
        "admittance": admittance,
        "transmission": transmission,
        "reflection": reflection,
    }


def _initialise(given: dict[str, ca.SX], stages: Sequence[ca.SX], p: ca.SX) -> ca.SX:
    """Start from given angles and rates with the acceleration that satisfies the equations of motion."""
    stiffness = p[1]
    damping = p[2]
    inertia = p[3]
    initial_angle = ca.vertsplit(given["initial_angle"])
    initial_rate = ca.vertsplit(given["initial_rate"])
    tip_torque = stages[0][0]
    acceleration: list[Any] = [0.0] * STATIONS
    angle: list[Any] = [0.0] * STATIONS
    answer_own: list[Any] = [0.0] * STATIONS
    joint_torque: list[Any] = [0.0] * STATIONS
    known_angle: list[Any] = [0.0] * (STATIONS + 1)
    known_rate: list[Any] = [0.0] * (STATIONS + 1)
    rate: list[Any] = [0.0] * STATIONS
    solved: list[Any] = [0.0] * STATIONS

    # what is the same at every station
    impedance = -inertia
    pivot = -impedance
    start_admittance = 1.0 / pivot

    # motion known before the sweep
    known_rate[0] = 0.0
    known_angle[0] = 0.0
    for j in range(STATIONS):
        known_rate[j + 1] = initial_rate[j]
        known_angle[j + 1] = initial_angle[j]

    # forces of the joints at the motion so far
    for j in range(STATIONS):
        joint_torque[j] = damping * (known_rate[j + 1] - known_rate[j]) + stiffness * (
            known_angle[j + 1] - known_angle[j]
        )

    # sweep inward: force beyond each joint as an affine function of the motion at it
    torque = tip_torque
    for j in reversed(range(STATIONS)):
        answer_own[j] = start_admittance * (torque - joint_torque[j])
        torque = joint_torque[j]

    # the base
    unknown: Any = 0.0

    # sweep outward: the unknown of each station
    for j in range(STATIONS):
        unknown = answer_own[j]
        solved[j] = unknown

    # motion at the end of the step
    for j in range(STATIONS):
        angle[j] = known_angle[j + 1]
        rate[j] = known_rate[j + 1]
        acceleration[j] = solved[j]
    return _column(*angle, *rate, *acceleration)


def _step(model: dict[str, Any], x: ca.SX, stages: Sequence[ca.SX]) -> ca.SX:
    """Advance the state by one step."""
    step = model["step"]
    stiffness = model["stiffness"]
    damping = model["damping"]
    rate_per_acceleration = model["rate_per_acceleration"]
    angle_per_acceleration = model["angle_per_acceleration"]
    admittance = model["admittance"]
    transmission = model["transmission"]
    reflection = model["reflection"]
    angle = ca.vertsplit(x[0:10])
    rate = ca.vertsplit(x[10:20])
    acceleration = ca.vertsplit(x[20:30])
    tip_torque = stages[0][0]
    answer_own: list[Any] = [0.0] * STATIONS
    joint_torque: list[Any] = [0.0] * STATIONS
    known_angle: list[Any] = [0.0] * (STATIONS + 1)
    known_rate: list[Any] = [0.0] * (STATIONS + 1)
    solved: list[Any] = [0.0] * STATIONS

    # motion known before the sweep
    known_rate[0] = 0.0
    known_angle[0] = 0.0
    for j in range(STATIONS):
        known_rate[j + 1] = rate[j] + acceleration[j] * rate_per_acceleration
        known_angle[j + 1] = angle[j] + acceleration[j] * angle_per_acceleration + rate[j] * step

    # forces of the joints at the motion so far
    for j in range(STATIONS):
        joint_torque[j] = damping * (known_rate[j + 1] - known_rate[j]) + stiffness * (
            known_angle[j + 1] - known_angle[j]
        )

    # sweep inward: force beyond each joint as an affine function of the motion at it
    torque = tip_torque
    for j in reversed(range(STATIONS)):
        answer_own[j] = admittance[j] * (torque - joint_torque[j])
        torque = joint_torque[j] * reflection[j] + torque * transmission[j]

    # the base
    unknown: Any = 0.0

    # sweep outward: the unknown of each station
    for j in range(STATIONS):
        unknown = answer_own[j] + transmission[j] * unknown
        solved[j] = unknown

    # motion at the end of the step
    for j in range(STATIONS):
        angle[j] = known_angle[j + 1] + angle_per_acceleration * solved[j]
        rate[j] = known_rate[j + 1] + rate_per_acceleration * solved[j]
        acceleration[j] = solved[j]
    return _column(*angle, *rate, *acceleration)


def _output(model: dict[str, Any], x: ca.SX, stages: Sequence[ca.SX]) -> ca.SX:
    """Read the outputs off a state."""
    stiffness = model["stiffness"]
    damping = model["damping"]
    angle = ca.vertsplit(x[0:10])
    rate = ca.vertsplit(x[10:20])

    # outputs
    tip = angle[9]
    base_torque = angle[0] * stiffness + damping * rate[0]
    return _column(tip, base_torque)

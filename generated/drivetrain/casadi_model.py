# drivetrain: Servo drive with gearbox, roller, brake and encoder
#
# Written by tmm-gen 0.1.0. Do not edit: change the scene and run `tmm-gen build`.
# scene digest: 260c88ca5ffe6b93ea5946fad67187e547942573db1dc2f710bcd9a0610b8738
# sha256 of the rest of this file: d788b16a8b9ab49e0f2c6acf1a91d8c25759cf37cf5b21ec31333358e25abb52
#
# model: torsional chain (linear)
# stations: 6
# base: motor
# integrator: Generalised alpha (Chung & Hulbert 1993), rho_inf = 0.8
# sweep: riccati
# unknown: acceleration
# operations of a step: 215, 35.83 per station (107 additions, 108 multiplications)
# operations of prepare: 88, 14.67 per station (20 additions, 61 multiplications, 7 divisions)
"""drivetrain: Servo drive with gearbox, roller, brake and encoder. Functions for optimisation and control.

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


STATIONS = 6
"""Number of links."""
STATE_NAMES: tuple[str, ...] = (
    "hub_angle",
    "hub_rate",
    "hub_acceleration",
    *_numbered("angle", 6),
    *_numbered("rate", 6),
    *_numbered("acceleration", 6),
)
INPUT_NAMES: tuple[str, ...] = ("motor_torque", "load_torque")
OUTPUT_NAMES: tuple[str, ...] = ("motor_speed", "roller_speed", "shaft_torque", "encoder")
PARAMETER_NAMES: tuple[str, ...] = (
    "step",
    *_numbered("stiffness", 6),
    *_numbered("damping", 6),
    *_numbered("inertia", 6),
    "hub_inertia",
    "hub_damping",
)
STAGE_INSTANTS = ((0.5555555555555556,),)
"""When inputs are read, in steps from the start of the step."""


def default_parameters() -> ca.DM:
    """Return the scene's step and physical parameters, a column ``p``."""
    values = (
        0.0001,
        24000.0,
        2600.0,
        60000.0,
        2000.0,
        1600.0,
        150.0,
        0.05,
        1.5,
        0.4,
        0.1,
        0.08,
        0.002,
        0.0004,
        0.0011,
        0.0028,
        0.019,
        0.0024,
        2e-05,
        0.0027,
        0.001,
    )
    return ca.DM(values)


def step_function() -> ca.Function:
    """Return the step ``(x, u, p) -> (x_next, y)``: the state one step later, and the outputs at ``x``."""
    return _function("drivetrain_step", _step, STAGE_INSTANTS[-1])


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
        "initial_angle": ca.SX.sym("initial_angle", 6),  # angles to start from (rad)
        "initial_rate": ca.SX.sym("initial_rate", 6),  # rates to start from (rad/s)
    }
    u, p = _symbols(INPUT_NAMES), _symbols(PARAMETER_NAMES)
    with _as_written():
        x = _initialise(given, [u], p)
    return ca.Function("drivetrain_initial", [*given.values(), u, p], [x], [*given, "u", "p"], ["x"])


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
    stiffness = ca.vertsplit(p[1:7])
    damping = ca.vertsplit(p[7:13])
    inertia = ca.vertsplit(p[13:19])
    hub_inertia = p[19]
    hub_damping = p[20]
    admittance: list[Any] = [0.0] * STATIONS
    reflection: list[Any] = [0.0] * STATIONS
    transmission: list[Any] = [0.0] * STATIONS

    # Riccati factors, swept from tip to base
    impedance: Any = 0.0
    for j in reversed(range(STATIONS)):
        joint_impedance = (55.0 / 108.0) * damping[j] * step + (125.0 / 486.0) * (step * step) * stiffness[j]
        impedance = impedance - inertia[j]
        pivot = joint_impedance - impedance
        admittance[j] = 1.0 / pivot
        transmission[j] = admittance[j] * joint_impedance
        reflection[j] = -admittance[j] * impedance
        impedance = impedance * transmission[j]
    hub_pivot = hub_inertia - impedance + (55.0 / 108.0) * hub_damping * step
    hub_admittance = 1.0 / hub_pivot

    # Factors of the step that depend on the time step and parameters alone
    step_5_over_108 = (5.0 / 108.0) * step
    step2_5_over_243 = (5.0 / 243.0) * (step * step)
    step_5_over_9 = (5.0 / 9.0) * step
    factor_4 = hub_admittance * hub_damping
    step2_1_over_27 = (1.0 / 27.0) * (step * step)
    step2_25_over_54 = (25.0 / 54.0) * (step * step)
    step_1_over_12 = (1.0 / 12.0) * step
    step_11_over_12 = (11.0 / 12.0) * step
    return {
        "step": step,
        "stiffness": stiffness,
        "damping": damping,
        "step_5_over_108": step_5_over_108,
        "step2_5_over_243": step2_5_over_243,
        "step_5_over_9": step_5_over_9,
        "factor_4": factor_4,
        "step2_1_over_27": step2_1_over_27,
        "step2_25_over_54": step2_25_over_54,
        "step_1_over_12": step_1_over_12,
        "step_11_over_12": step_11_over_12,
        "admittance": admittance,
        "transmission": transmission,
        "reflection": reflection,
        "hub_admittance": hub_admittance,
    }


def _initialise(given: dict[str, ca.SX], stages: Sequence[ca.SX], p: ca.SX) -> ca.SX:
    """Start from given angles and rates with the acceleration that satisfies the equations of motion."""
    stiffness = ca.vertsplit(p[1:7])
    damping = ca.vertsplit(p[7:13])
    inertia = ca.vertsplit(p[13:19])
    hub_inertia = p[19]
    hub_damping = p[20]
    initial_angle = ca.vertsplit(given["initial_angle"])
    initial_rate = ca.vertsplit(given["initial_rate"])
    motor_torque = stages[0][0]
    load_torque = stages[0][1]
    acceleration: list[Any] = [0.0] * STATIONS
    angle: list[Any] = [0.0] * STATIONS
    correction: list[Any] = [0.0] * STATIONS
    joint_torque: list[Any] = [0.0] * STATIONS
    known_angle: list[Any] = [0.0] * (STATIONS + 1)
    known_rate: list[Any] = [0.0] * (STATIONS + 1)
    load: list[Any] = [0.0] * STATIONS
    rate: list[Any] = [0.0] * STATIONS
    solved: list[Any] = [0.0] * STATIONS

    # motion known before the sweep
    known_rate[0] = 0.0
    known_angle[0] = 0.0
    for j in range(STATIONS):
        known_rate[j + 1] = initial_rate[j]
        known_angle[j + 1] = initial_angle[j]

    # torque of each joint at the known motion
    for j in range(STATIONS):
        joint_torque[j] = damping[j] * (known_rate[j + 1] - known_rate[j]) + stiffness[j] * (
            known_angle[j + 1] - known_angle[j]
        )

    # sweep inward: torque beyond each joint as if its inner side did not move
    for j in range(STATIONS):
        load[j] = 0.0
    load[3] = load_torque
    bias: Any = 0.0
    for j in reversed(range(STATIONS)):
        bias = bias + load[j]
        correction[j] = (bias - joint_torque[j]) / inertia[j]
        bias = joint_torque[j]

    # the base
    unknown = (bias + motor_torque - hub_damping * known_rate[0]) / hub_inertia
    hub_unknown = unknown

    # sweep outward: the unknown of each station
    for j in range(STATIONS):
        unknown = correction[j]
        solved[j] = unknown

    # motion at the end of the step
    hub_angle = known_angle[0]
    hub_rate = known_rate[0]
    hub_acceleration = hub_unknown
    for j in range(STATIONS):
        angle[j] = known_angle[j + 1]
        rate[j] = known_rate[j + 1]
        acceleration[j] = solved[j]
    return _column(hub_angle, hub_rate, hub_acceleration, *angle, *rate, *acceleration)


def _step(model: dict[str, Any], x: ca.SX, stages: Sequence[ca.SX]) -> ca.SX:
    """Advance the state by one step."""
    step = model["step"]
    stiffness = model["stiffness"]
    damping = model["damping"]
    step_5_over_108 = model["step_5_over_108"]
    step2_5_over_243 = model["step2_5_over_243"]
    step_5_over_9 = model["step_5_over_9"]
    factor_4 = model["factor_4"]
    step2_1_over_27 = model["step2_1_over_27"]
    step2_25_over_54 = model["step2_25_over_54"]
    step_1_over_12 = model["step_1_over_12"]
    step_11_over_12 = model["step_11_over_12"]
    admittance = model["admittance"]
    transmission = model["transmission"]
    reflection = model["reflection"]
    hub_admittance = model["hub_admittance"]
    hub_angle = x[0]
    hub_rate = x[1]
    hub_acceleration = x[2]
    angle = ca.vertsplit(x[3:9])
    rate = ca.vertsplit(x[9:15])
    acceleration = ca.vertsplit(x[15:21])
    motor_torque = stages[0][0]
    load_torque = stages[0][1]
    correction: list[Any] = [0.0] * STATIONS
    joint_torque: list[Any] = [0.0] * STATIONS
    known_angle: list[Any] = [0.0] * (STATIONS + 1)
    known_rate: list[Any] = [0.0] * (STATIONS + 1)
    load: list[Any] = [0.0] * STATIONS
    solved: list[Any] = [0.0] * STATIONS

    # motion known before the sweep
    known_rate[0] = hub_rate + hub_acceleration * step_5_over_108
    known_angle[0] = hub_angle + hub_acceleration * step2_5_over_243 + hub_rate * step_5_over_9
    for j in range(STATIONS):
        known_rate[j + 1] = rate[j] + acceleration[j] * step_5_over_108
        known_angle[j + 1] = angle[j] + acceleration[j] * step2_5_over_243 + rate[j] * step_5_over_9

    # torque of each joint at the known motion
    for j in range(STATIONS):
        joint_torque[j] = damping[j] * (known_rate[j + 1] - known_rate[j]) + stiffness[j] * (
            known_angle[j + 1] - known_angle[j]
        )

    # sweep inward: torque beyond each joint as if its inner side did not move
    for j in range(STATIONS):
        load[j] = 0.0
    load[3] = load_torque
    bias: Any = 0.0
    for j in reversed(range(STATIONS)):
        bias = bias + load[j]
        correction[j] = admittance[j] * (bias - joint_torque[j])
        bias = bias * transmission[j] + joint_torque[j] * reflection[j]

    # the base
    unknown = hub_admittance * (bias + motor_torque) - factor_4 * known_rate[0]
    hub_unknown = unknown

    # sweep outward: the unknown of each station
    for j in range(STATIONS):
        unknown = correction[j] + transmission[j] * unknown
        solved[j] = unknown

    # motion at the end of the step
    hub_angle = (
        hub_angle + hub_acceleration * step2_1_over_27 + hub_rate * step + hub_unknown * step2_25_over_54
    )
    hub_rate = hub_rate + hub_acceleration * step_1_over_12 + hub_unknown * step_11_over_12
    hub_acceleration = 1.5 * hub_unknown - 0.5 * hub_acceleration
    for j in range(STATIONS):
        angle[j] = (
            angle[j] + acceleration[j] * step2_1_over_27 + rate[j] * step + solved[j] * step2_25_over_54
        )
        rate[j] = rate[j] + acceleration[j] * step_1_over_12 + solved[j] * step_11_over_12
        acceleration[j] = 1.5 * solved[j] - 0.5 * acceleration[j]
    return _column(hub_angle, hub_rate, hub_acceleration, *angle, *rate, *acceleration)


def _output(model: dict[str, Any], x: ca.SX, stages: Sequence[ca.SX]) -> ca.SX:
    """Read the outputs off a state."""
    stiffness = model["stiffness"]
    damping = model["damping"]
    hub_rate = x[1]
    angle = ca.vertsplit(x[3:9])
    rate = ca.vertsplit(x[9:15])

    # outputs
    motor_speed = hub_rate
    roller_speed = rate[3]
    shaft_torque = damping[3] * (rate[3] - rate[2]) + stiffness[3] * (angle[3] - angle[2])
    encoder = angle[5]
    return _column(motor_speed, roller_speed, shaft_torque, encoder)

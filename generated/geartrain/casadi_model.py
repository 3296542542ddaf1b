# geartrain: Servo with two stages of gears on a table and a feeder
#
# Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
# scene digest: 066060c018d378c5aa38f61f583a4ed37c9ee269f8287dfe93f42445474eebe1
# sha256 of the rest of this file: 07a87e1c37701841db127d638d30ea220ad7c5ac3cd01c75e458bd9d7c8fea37
#
# model: torsional chain (linear)
# stations: 4
# base: motor
# integrator: Generalised alpha (Chung & Hulbert 1993), rho_inf = 0.8
# sweep: riccati
# unknown: acceleration
# joints in arrays, from 0: coupling 0, belt 1, second 2, shaft 3
# links in arrays, from 0: pinion 0, layshaft 0, feeder 1, wheel 2, table 3
# operations of a step: 159, 39.75 per station (75 additions, 84 multiplications)
# operations of prepare: 75, 18.75 per station (13 additions, 51 multiplications, 11 divisions)
"""geartrain: Servo with two stages of gears on a table and a feeder. Functions for optimisation and control.

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


STATIONS = 4
"""Number of links."""
STATE_NAMES: tuple[str, ...] = (
    "hub_angle",
    "hub_rate",
    "hub_acceleration",
    *_numbered("angle", 4),
    *_numbered("rate", 4),
    *_numbered("acceleration", 4),
)
INPUT_NAMES: tuple[str, ...] = ("motor_torque", "load_torque", "feeder_torque")
OUTPUT_NAMES: tuple[str, ...] = (
    "motor_speed",
    "table",
    "table_speed",
    "feeder_speed",
    "coupling_torque",
    "teeth",
)
PARAMETER_NAMES: tuple[str, ...] = (
    "step",
    *_numbered("stiffness", 4),
    *_numbered("damping", 4),
    *_numbered("ratio", 4),
    *_numbered("inertia", 4),
    "hub_inertia",
    "hub_damping",
)
STAGE_INSTANTS = ((0.5555555555555556,),)
"""When inputs are read, in steps from the start of the step."""


def default_parameters() -> ca.DM:
    """Return the scene's step and physical parameters, a column ``p``."""
    values = (
        0.0001,
        150.0,
        60.0,
        60000.0,
        2500.0,
        0.02,
        0.01,
        4.0,
        0.8,
        1.0,
        -4.0,
        20.0,
        1.0,
        0.00027,
        0.0008,
        0.011,
        0.65,
        0.0006,
        0.001,
    )
    return ca.DM(values)


def step_function() -> ca.Function:
    """Return the step ``(x, u, p) -> (x_next, y)``: the state one step later, and the outputs at ``x``."""
    return _function("geartrain_step", _step, STAGE_INSTANTS[-1])


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
        "initial_angle": ca.SX.sym("initial_angle", 4),  # angles to start from (rad)
        "initial_rate": ca.SX.sym("initial_rate", 4),  # rates to start from (rad/s)
    }
    u, p = _symbols(INPUT_NAMES), _symbols(PARAMETER_NAMES)
    with _as_written():
        x = _initialise(given, [u], p)
    return ca.Function("geartrain_initial", [*given.values(), u, p], [x], [*given, "u", "p"], ["x"])


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
    stiffness = ca.vertsplit(p[1:5])
    damping = ca.vertsplit(p[5:9])
    ratio = ca.vertsplit(p[9:13])
    inertia = ca.vertsplit(p[13:17])
    hub_inertia = p[17]
    hub_damping = p[18]
    admittance: list[Any] = [0.0] * STATIONS
    reflection: list[Any] = [0.0] * STATIONS
    transmission: list[Any] = [0.0] * STATIONS
    turn: list[Any] = [0.0] * STATIONS

    # how gears turn
    for j in range(STATIONS):
        turn[j] = 1.0 / ratio[j]

    # factors of the sweep that do not change from step to step
    for j in reversed(range(3, STATIONS)):
        impedance = -inertia[j]
        joint_impedance = (55.0 / 108.0) * damping[j] * step + (125.0 / 486.0) * (step * step) * stiffness[j]
        pivot = joint_impedance - impedance
        admittance[j] = 1.0 / pivot
        transmission[j] = admittance[j] * joint_impedance
        reflection[j] = -admittance[j] * impedance
        impedance = impedance * transmission[j]
    for j in reversed(range(2, 3)):
        impedance = impedance - inertia[j]
        joint_impedance = (55.0 / 108.0) * damping[j] * step + (125.0 / 486.0) * (step * step) * stiffness[j]
        pivot = joint_impedance - impedance
        admittance[j] = 1.0 / pivot
        transmission[j] = admittance[j] * joint_impedance * turn[j]
        reflection[j] = -admittance[j] * impedance * turn[j]
        impedance = impedance * transmission[j] * turn[j]
    impedance_of_branch_3 = impedance
    for j in reversed(range(1, 2)):
        impedance = -inertia[j]
        joint_impedance = (55.0 / 108.0) * damping[j] * step + (125.0 / 486.0) * (step * step) * stiffness[j]
        pivot = joint_impedance - impedance
        admittance[j] = 1.0 / pivot
        transmission[j] = admittance[j] * joint_impedance * turn[j]
        reflection[j] = -admittance[j] * impedance * turn[j]
        impedance = impedance * transmission[j] * turn[j]
    impedance = impedance + impedance_of_branch_3
    for j in reversed(range(1)):
        impedance = impedance - inertia[j]
        joint_impedance = (55.0 / 108.0) * damping[j] * step + (125.0 / 486.0) * (step * step) * stiffness[j]
        pivot = joint_impedance - impedance
        admittance[j] = 1.0 / pivot
        transmission[j] = admittance[j] * joint_impedance
        reflection[j] = -admittance[j] * impedance
        impedance = impedance * transmission[j]
    hub_impedance = hub_inertia + (55.0 / 108.0) * hub_damping * step
    hub_pivot = hub_impedance - impedance
    hub_admittance = 1.0 / hub_pivot

    # Factors of the step that depend on the time step and parameters alone
    known_rate_per_acceleration = (5.0 / 108.0) * step
    known_angle_per_acceleration = (5.0 / 243.0) * (step * step)
    five_ninths_timestep = (5.0 / 9.0) * step
    unknown_per_known_rate = hub_admittance * hub_damping
    angle_per_acceleration_2 = (1.0 / 27.0) * (step * step)
    angle_per_unknown = (25.0 / 54.0) * (step * step)
    twelfth_timestep = (1.0 / 12.0) * step
    eleven_twelfths_timestep = (11.0 / 12.0) * step
    teeth_per_angle = stiffness[2] / ratio[2]
    teeth_per_rate = damping[2] / ratio[2]
    return {
        "step": step,
        "stiffness": stiffness,
        "damping": damping,
        "known_rate_per_acceleration": known_rate_per_acceleration,
        "known_angle_per_acceleration": known_angle_per_acceleration,
        "five_ninths_timestep": five_ninths_timestep,
        "unknown_per_known_rate": unknown_per_known_rate,
        "angle_per_acceleration_2": angle_per_acceleration_2,
        "angle_per_unknown": angle_per_unknown,
        "twelfth_timestep": twelfth_timestep,
        "eleven_twelfths_timestep": eleven_twelfths_timestep,
        "teeth_per_angle": teeth_per_angle,
        "teeth_per_rate": teeth_per_rate,
        "turn": turn,
        "admittance": admittance,
        "transmission": transmission,
        "reflection": reflection,
        "hub_admittance": hub_admittance,
    }


def _initialise(given: dict[str, ca.SX], stages: Sequence[ca.SX], p: ca.SX) -> ca.SX:
    """Start from given angles and rates with the acceleration that satisfies the equations of motion."""
    stiffness = ca.vertsplit(p[1:5])
    damping = ca.vertsplit(p[5:9])
    ratio = ca.vertsplit(p[9:13])
    inertia = ca.vertsplit(p[13:17])
    hub_inertia = p[17]
    hub_damping = p[18]
    initial_angle = ca.vertsplit(given["initial_angle"])
    initial_rate = ca.vertsplit(given["initial_rate"])
    motor_torque = stages[0][0]
    load_torque_ = stages[0][1]
    feeder_torque = stages[0][2]
    acceleration: list[Any] = [0.0] * STATIONS
    angle: list[Any] = [0.0] * STATIONS
    answer_own: list[Any] = [0.0] * STATIONS
    joint_torque: list[Any] = [0.0] * STATIONS
    known_angle: list[Any] = [0.0] * (STATIONS + 1)
    known_rate: list[Any] = [0.0] * (STATIONS + 1)
    load_torque: list[Any] = [0.0] * STATIONS
    rate: list[Any] = [0.0] * STATIONS
    solved: list[Any] = [0.0] * STATIONS
    start_turn: list[Any] = [0.0] * STATIONS

    # how gears turn
    for j in range(STATIONS):
        start_turn[j] = 1.0 / ratio[j]

    # motion known before the sweep
    known_rate[0] = 0.0
    known_angle[0] = 0.0
    for j in range(STATIONS):
        known_rate[j + 1] = initial_rate[j]
        known_angle[j + 1] = initial_angle[j]

    # forces of the joints at the motion so far
    for j in range(1):
        joint_torque[j] = damping[j] * (known_rate[j + 1] - known_rate[j]) + stiffness[j] * (
            known_angle[j + 1] - known_angle[j]
        )
    for j in range(1, 2):
        joint_torque[j] = (
            damping[j] * known_rate[j + 1]
            + known_angle[j + 1] * stiffness[j]
            - damping[j] * known_rate[j] * start_turn[j]
            - known_angle[j] * start_turn[j] * stiffness[j]
        )
    for j in range(2, 3):
        joint_torque[j] = (
            damping[j] * known_rate[j + 1]
            + known_angle[j + 1] * stiffness[j]
            - damping[j] * known_rate[1] * start_turn[j]
            - known_angle[1] * start_turn[j] * stiffness[j]
        )
    for j in range(3, STATIONS):
        joint_torque[j] = damping[j] * (known_rate[j + 1] - known_rate[j]) + stiffness[j] * (
            known_angle[j + 1] - known_angle[j]
        )

    # sweep inward: force beyond each joint as an affine function of the motion at it
    for j in range(STATIONS):
        load_torque[j] = 0.0
    load_torque[1] = feeder_torque
    torque = load_torque_
    for j in reversed(range(3, STATIONS)):
        torque = load_torque[j] + torque
        impedance = -inertia[j]
        pivot = -impedance
        start_admittance = 1.0 / pivot
        answer_own[j] = start_admittance * (torque - joint_torque[j])
        torque = joint_torque[j]
    for j in reversed(range(2, 3)):
        torque = load_torque[j] + torque
        impedance = -inertia[j]
        pivot = -impedance
        start_admittance = 1.0 / pivot
        answer_own[j] = start_admittance * (torque - joint_torque[j])
        torque = joint_torque[j] * start_turn[j]
    torque_of_branch_3 = torque
    for j in reversed(range(1, 2)):
        torque = load_torque[j]
        impedance = -inertia[j]
        pivot = -impedance
        start_admittance = 1.0 / pivot
        answer_own[j] = start_admittance * (torque - joint_torque[j])
        torque = joint_torque[j] * start_turn[j]
    torque = torque + torque_of_branch_3
    for j in reversed(range(1)):
        torque = load_torque[j] + torque
        impedance = -inertia[j]
        pivot = -impedance
        start_admittance = 1.0 / pivot
        answer_own[j] = start_admittance * (torque - joint_torque[j])
        torque = joint_torque[j]

    # the base
    hub_pivot = hub_inertia
    start_hub_admittance = 1.0 / hub_pivot
    unknown = start_hub_admittance * (motor_torque + torque - hub_damping * known_rate[0])
    hub_unknown = unknown

    # sweep outward: the unknown of each station
    for j in range(1):
        unknown = answer_own[j]
        solved[j] = unknown
    for j in range(1, 2):
        unknown = answer_own[j]
        solved[j] = unknown
    unknown = solved[0]
    for j in range(2, 3):
        unknown = answer_own[j]
        solved[j] = unknown
    for j in range(3, STATIONS):
        unknown = answer_own[j]
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
    known_rate_per_acceleration = model["known_rate_per_acceleration"]
    known_angle_per_acceleration = model["known_angle_per_acceleration"]
    five_ninths_timestep = model["five_ninths_timestep"]
    unknown_per_known_rate = model["unknown_per_known_rate"]
    angle_per_acceleration_2 = model["angle_per_acceleration_2"]
    angle_per_unknown = model["angle_per_unknown"]
    twelfth_timestep = model["twelfth_timestep"]
    eleven_twelfths_timestep = model["eleven_twelfths_timestep"]
    turn = model["turn"]
    admittance = model["admittance"]
    transmission = model["transmission"]
    reflection = model["reflection"]
    hub_admittance = model["hub_admittance"]
    hub_angle = x[0]
    hub_rate = x[1]
    hub_acceleration = x[2]
    angle = ca.vertsplit(x[3:7])
    rate = ca.vertsplit(x[7:11])
    acceleration = ca.vertsplit(x[11:15])
    motor_torque = stages[0][0]
    load_torque_ = stages[0][1]
    feeder_torque = stages[0][2]
    answer_own: list[Any] = [0.0] * STATIONS
    joint_torque: list[Any] = [0.0] * STATIONS
    known_angle: list[Any] = [0.0] * (STATIONS + 1)
    known_rate: list[Any] = [0.0] * (STATIONS + 1)
    load_torque: list[Any] = [0.0] * STATIONS
    solved: list[Any] = [0.0] * STATIONS

    # motion known before the sweep
    known_rate[0] = hub_rate + hub_acceleration * known_rate_per_acceleration
    known_angle[0] = (
        hub_angle + five_ninths_timestep * hub_rate + hub_acceleration * known_angle_per_acceleration
    )
    for j in range(STATIONS):
        known_rate[j + 1] = rate[j] + acceleration[j] * known_rate_per_acceleration
        known_angle[j + 1] = (
            angle[j] + acceleration[j] * known_angle_per_acceleration + five_ninths_timestep * rate[j]
        )

    # forces of the joints at the motion so far
    for j in range(1):
        joint_torque[j] = damping[j] * (known_rate[j + 1] - known_rate[j]) + stiffness[j] * (
            known_angle[j + 1] - known_angle[j]
        )
    for j in range(1, 2):
        joint_torque[j] = (
            damping[j] * known_rate[j + 1]
            + known_angle[j + 1] * stiffness[j]
            - damping[j] * known_rate[j] * turn[j]
            - known_angle[j] * stiffness[j] * turn[j]
        )
    for j in range(2, 3):
        joint_torque[j] = (
            damping[j] * known_rate[j + 1]
            + known_angle[j + 1] * stiffness[j]
            - damping[j] * known_rate[1] * turn[j]
            - known_angle[1] * stiffness[j] * turn[j]
        )
    for j in range(3, STATIONS):
        joint_torque[j] = damping[j] * (known_rate[j + 1] - known_rate[j]) + stiffness[j] * (
            known_angle[j + 1] - known_angle[j]
        )

    # sweep inward: force beyond each joint as an affine function of the motion at it
    for j in range(STATIONS):
        load_torque[j] = 0.0
    load_torque[1] = feeder_torque
    torque = load_torque_
    for j in reversed(range(3, STATIONS)):
        torque = load_torque[j] + torque
        answer_own[j] = admittance[j] * (torque - joint_torque[j])
        torque = joint_torque[j] * reflection[j] + torque * transmission[j]
    for j in reversed(range(2, 3)):
        torque = load_torque[j] + torque
        answer_own[j] = admittance[j] * (torque - joint_torque[j])
        torque = joint_torque[j] * reflection[j] + torque * transmission[j]
    torque_of_branch_3 = torque
    for j in reversed(range(1, 2)):
        torque = load_torque[j]
        answer_own[j] = admittance[j] * (torque - joint_torque[j])
        torque = joint_torque[j] * reflection[j] + torque * transmission[j]
    torque = torque + torque_of_branch_3
    for j in reversed(range(1)):
        torque = load_torque[j] + torque
        answer_own[j] = admittance[j] * (torque - joint_torque[j])
        torque = joint_torque[j] * reflection[j] + torque * transmission[j]

    # the base
    unknown = hub_admittance * (motor_torque + torque) - known_rate[0] * unknown_per_known_rate
    hub_unknown = unknown

    # sweep outward: the unknown of each station
    for j in range(1):
        unknown = answer_own[j] + transmission[j] * unknown
        solved[j] = unknown
    for j in range(1, 2):
        unknown = answer_own[j] + transmission[j] * unknown
        solved[j] = unknown
    unknown = solved[0]
    for j in range(2, 3):
        unknown = answer_own[j] + transmission[j] * unknown
        solved[j] = unknown
    for j in range(3, STATIONS):
        unknown = answer_own[j] + transmission[j] * unknown
        solved[j] = unknown

    # motion at the end of the step
    hub_angle = (
        hub_angle
        + angle_per_acceleration_2 * hub_acceleration
        + angle_per_unknown * hub_unknown
        + hub_rate * step
    )
    hub_rate = hub_rate + eleven_twelfths_timestep * hub_unknown + hub_acceleration * twelfth_timestep
    hub_acceleration = 1.5 * hub_unknown - 0.5 * hub_acceleration
    for j in range(STATIONS):
        angle[j] = (
            angle[j]
            + acceleration[j] * angle_per_acceleration_2
            + angle_per_unknown * solved[j]
            + rate[j] * step
        )
        rate[j] = rate[j] + acceleration[j] * twelfth_timestep + eleven_twelfths_timestep * solved[j]
        acceleration[j] = 1.5 * solved[j] - 0.5 * acceleration[j]
    return _column(hub_angle, hub_rate, hub_acceleration, *angle, *rate, *acceleration)


def _output(model: dict[str, Any], x: ca.SX, stages: Sequence[ca.SX]) -> ca.SX:
    """Read the outputs off a state."""
    stiffness = model["stiffness"]
    damping = model["damping"]
    teeth_per_angle = model["teeth_per_angle"]
    teeth_per_rate = model["teeth_per_rate"]
    hub_angle = x[0]
    hub_rate = x[1]
    angle = ca.vertsplit(x[3:7])
    rate = ca.vertsplit(x[7:11])

    # outputs
    motor_speed = hub_rate
    table = angle[3]
    table_speed = rate[3]
    feeder_speed = rate[1]
    coupling_torque = damping[0] * (hub_rate - rate[0]) + stiffness[0] * (hub_angle - angle[0])
    teeth = (
        angle[0] * teeth_per_angle - angle[2] * stiffness[2] - damping[2] * rate[2] + rate[0] * teeth_per_rate
    )
    return _column(motor_speed, table, table_speed, feeder_speed, coupling_torque, teeth)

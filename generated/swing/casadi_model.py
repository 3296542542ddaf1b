# swing: Flexible arm swung by one radian
#
# Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
# scene digest: c9c08efbdc9f2f1b1ddadadab522649e5100f98e9cdabe31fcf56b416283c60f
# sha256 of the rest of this file: 0f48e2e709041cb415bdb25608c070a13d6fcd12c74812da50aef020e28ed7f0
#
# model: planar arm, large rotations, tip mass
# stations: 5
# base: motor
# integrator: Newmark 1959, beta = 0.25, gamma = 0.5
# linearisation: newton
# sweep: riccati
# unknown: acceleration
# operations of a step: 595, 119 per station (275 additions, 304 multiplications, 6 divisions, 10 sines and
#     cosines)
# operations of prepare: 47, 9.4 per station (10 additions, 37 multiplications)
"""swing: Flexible arm swung by one radian. Functions for optimisation and control.

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


STATIONS = 5
"""Number of links."""
STATE_NAMES: tuple[str, ...] = (
    "hub_angle",
    "hub_rate",
    "hub_acceleration",
    *_numbered("angle", 5),
    *_numbered("rate", 5),
    *_numbered("acceleration", 5),
)
INPUT_NAMES: tuple[str, ...] = ("hub_torque",)
OUTPUT_NAMES: tuple[str, ...] = ("tip_x", "tip_y", "hub")
PARAMETER_NAMES: tuple[str, ...] = (
    "step",
    "length",
    "mass",
    "inertia",
    "center",
    *_numbered("stiffness", 5),
    *_numbered("damping", 5),
    "hub_inertia",
    "hub_damping",
    "tip_mass",
)
STAGE_INSTANTS = ((1.0,),)
"""When inputs are read, in steps from the start of the step."""


def default_parameters() -> ca.DM:
    """Return the scene's step and physical parameters, a column ``p``."""
    values = (
        0.005,
        0.2,
        0.08,
        0.0002666666666666667,
        0.5,
        120.0,
        60.0,
        60.0,
        60.0,
        60.0,
        0.18,
        0.09,
        0.09,
        0.09,
        0.09,
        0.05,
        0.02,
        0.1,
    )
    return ca.DM(values)


def step_function() -> ca.Function:
    """Return the step ``(x, u, p) -> (x_next, y)``: the state one step later, and the outputs at ``x``."""
    return _function("swing_step", _step, STAGE_INSTANTS[-1])


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
        "initial_angle": ca.SX.sym("initial_angle", 5),  # angles to start from (rad)
        "initial_rate": ca.SX.sym("initial_rate", 5),  # rates to start from (rad/s)
    }
    u, p = _symbols(INPUT_NAMES), _symbols(PARAMETER_NAMES)
    with _as_written():
        x = _initialise(given, [u], p)
    return ca.Function("swing_initial", [*given.values(), u, p], [x], [*given, "u", "p"], ["x"])


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
    length = p[1]
    mass = p[2]
    inertia = p[3]
    center = p[4]
    stiffness = ca.vertsplit(p[5:10])
    damping = ca.vertsplit(p[10:15])
    hub_inertia = p[15]
    hub_damping = p[16]
    tip_mass = p[17]
    joint_impedance: list[Any] = [0.0] * STATIONS

    # masses at the nodes between links, and what they leave over
    end_mass = tip_mass - mass * (1.0 - center)
    rod_inertia = inertia - center * (length * length) * mass * (1.0 - center)

    # factors of the sweep that do not change from step to step
    for j in reversed(range(STATIONS)):
        joint_impedance[j] = 0.5 * damping[j] * step + 0.25 * (step * step) * stiffness[j]
    hub_impedance = hub_inertia + 0.5 * hub_damping * step

    # Factors of the step that depend on the time step and parameters alone
    half_step_squared = 0.5 * (step * step)
    angle_per_acceleration = 0.25 * (step * step)
    rate_per_acceleration = 0.5 * step
    return {
        "step": step,
        "length": length,
        "mass": mass,
        "stiffness": stiffness,
        "damping": damping,
        "hub_inertia": hub_inertia,
        "hub_damping": hub_damping,
        "half_step_squared": half_step_squared,
        "angle_per_acceleration": angle_per_acceleration,
        "rate_per_acceleration": rate_per_acceleration,
        "end_mass": end_mass,
        "rod_inertia": rod_inertia,
        "joint_impedance": joint_impedance,
        "hub_impedance": hub_impedance,
    }


def _initialise(given: dict[str, ca.SX], stages: Sequence[ca.SX], p: ca.SX) -> ca.SX:
    """Start from given angles and rates with the acceleration that satisfies the equations of motion."""
    length = p[1]
    mass = p[2]
    inertia = p[3]
    center = p[4]
    stiffness = ca.vertsplit(p[5:10])
    damping = ca.vertsplit(p[10:15])
    hub_inertia = p[15]
    hub_damping = p[16]
    tip_mass = p[17]
    initial_angle = ca.vertsplit(given["initial_angle"])
    initial_rate = ca.vertsplit(given["initial_rate"])
    hub_torque = stages[0][0]
    acceleration: list[Any] = [0.0] * STATIONS
    acceleration_x: list[Any] = [0.0] * (STATIONS + 1)
    acceleration_y: list[Any] = [0.0] * (STATIONS + 1)
    angle: list[Any] = [0.0] * STATIONS
    answer_own: list[Any] = [0.0] * STATIONS
    answer_x: list[Any] = [0.0] * STATIONS
    answer_y: list[Any] = [0.0] * STATIONS
    joint_torque: list[Any] = [0.0] * STATIONS
    lever_cosine: list[Any] = [0.0] * STATIONS
    lever_sine: list[Any] = [0.0] * STATIONS
    predicted_acceleration: list[Any] = [0.0] * (STATIONS + 1)
    predicted_angle: list[Any] = [0.0] * (STATIONS + 1)
    predicted_rate: list[Any] = [0.0] * (STATIONS + 1)
    rate: list[Any] = [0.0] * STATIONS
    relative_x: list[Any] = [0.0] * STATIONS
    relative_y: list[Any] = [0.0] * STATIONS
    solved: list[Any] = [0.0] * STATIONS

    # masses at the nodes between links, and what they leave over
    start_end_mass = tip_mass - mass * (1.0 - center)
    start_rod_inertia = inertia - center * (length * length) * mass * (1.0 - center)

    # what is the same at every station
    hub_pivot = hub_inertia

    # predicted motion
    predicted_rate[0] = 0.0
    predicted_angle[0] = 0.0
    predicted_acceleration[0] = 0.0
    for j in range(STATIONS):
        predicted_rate[j + 1] = initial_rate[j]
        predicted_angle[j + 1] = initial_angle[j]
        predicted_acceleration[j + 1] = 0.0

    # accelerations of the nodes
    for j in range(STATIONS):
        lever_cosine[j] = length * ca.cos(predicted_angle[j + 1])
        lever_sine[j] = length * ca.sin(predicted_angle[j + 1])
        square = predicted_rate[j + 1] * predicted_rate[j + 1]
        relative_x[j] = -lever_cosine[j] * square - lever_sine[j] * predicted_acceleration[j + 1]
        relative_y[j] = lever_cosine[j] * predicted_acceleration[j + 1] - lever_sine[j] * square
    node_x: Any = 0.0
    node_y: Any = 0.0
    acceleration_x[0] = node_x
    acceleration_y[0] = node_y
    for j in range(STATIONS):
        node_x = node_x + relative_x[j]
        node_y = node_y + relative_y[j]
        acceleration_x[j + 1] = node_x
        acceleration_y[j + 1] = node_y

    # forces of the joints at the motion so far
    for j in range(STATIONS):
        joint_torque[j] = damping[j] * (predicted_rate[j] - predicted_rate[j + 1]) + stiffness[j] * (
            predicted_angle[j] - predicted_angle[j + 1]
        )

    # sweep inward: force beyond each joint as an affine function of the motion at it
    impedance_xx = start_end_mass
    impedance_xy: Any = 0.0
    impedance_yx: Any = 0.0
    impedance_yy = start_end_mass
    force_x = acceleration_x[5] * start_end_mass
    force_y = acceleration_y[5] * start_end_mass
    torque: Any = 0.0
    for j in reversed(range(STATIONS)):
        impedance_xx = impedance_xx + mass
        force_x = force_x + acceleration_x[j + 1] * mass
        impedance_yy = impedance_yy + mass
        force_y = force_y + acceleration_y[j + 1] * mass
        impedance_xu = impedance_xy * lever_cosine[j] - impedance_xx * lever_sine[j]
        impedance_yu = impedance_yy * lever_cosine[j] - impedance_yx * lever_sine[j]
        impedance_ux = impedance_yx * lever_cosine[j] - impedance_xx * lever_sine[j]
        impedance_uy = impedance_yy * lever_cosine[j] - impedance_xy * lever_sine[j]
        impedance_uu = start_rod_inertia - impedance_xu * lever_sine[j] + impedance_yu * lever_cosine[j]
        torque = (
            torque
            - force_x * lever_sine[j]
            + force_y * lever_cosine[j]
            + predicted_acceleration[j + 1] * start_rod_inertia
        )
        pivot = impedance_uu
        admittance = 1.0 / pivot
        answer_own[j] = admittance * (joint_torque[j] - torque)
        answer_x[j] = admittance * impedance_ux
        answer_y[j] = admittance * impedance_uy
        impedance_xx = impedance_xx - answer_x[j] * impedance_xu
        impedance_xy = impedance_xy - answer_y[j] * impedance_xu
        force_x = force_x + answer_own[j] * impedance_xu
        impedance_yx = impedance_yx - answer_x[j] * impedance_yu
        impedance_yy = impedance_yy - answer_y[j] * impedance_yu
        force_y = force_y + answer_own[j] * impedance_yu
        torque = joint_torque[j]

    # the base
    unknown = (
        hub_torque - torque - hub_damping * predicted_rate[0] - hub_inertia * predicted_acceleration[0]
    ) / hub_pivot
    hub_unknown = unknown

    # sweep outward: the unknown of each station
    change_x: Any = 0.0
    change_y: Any = 0.0
    for j in range(STATIONS):
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y
        change_x = change_x - lever_sine[j] * unknown
        change_y = change_y + lever_cosine[j] * unknown
        solved[j] = unknown

    # motion at the end of the step
    hub_angle = predicted_angle[0]
    hub_rate = predicted_rate[0]
    hub_acceleration = hub_unknown + predicted_acceleration[0]
    for j in range(STATIONS):
        angle[j] = predicted_angle[j + 1]
        rate[j] = predicted_rate[j + 1]
        acceleration[j] = predicted_acceleration[j + 1] + solved[j]
    return _column(hub_angle, hub_rate, hub_acceleration, *angle, *rate, *acceleration)


def _step(model: dict[str, Any], x: ca.SX, stages: Sequence[ca.SX]) -> ca.SX:
    """Advance the state by one step."""
    step = model["step"]
    length = model["length"]
    mass = model["mass"]
    stiffness = model["stiffness"]
    damping = model["damping"]
    hub_inertia = model["hub_inertia"]
    hub_damping = model["hub_damping"]
    half_step_squared = model["half_step_squared"]
    angle_per_acceleration = model["angle_per_acceleration"]
    rate_per_acceleration = model["rate_per_acceleration"]
    end_mass = model["end_mass"]
    rod_inertia = model["rod_inertia"]
    joint_impedance = model["joint_impedance"]
    hub_impedance = model["hub_impedance"]
    hub_angle = x[0]
    hub_rate = x[1]
    hub_acceleration = x[2]
    angle = ca.vertsplit(x[3:8])
    rate = ca.vertsplit(x[8:13])
    acceleration = ca.vertsplit(x[13:18])
    hub_torque = stages[0][0]
    acceleration_x: list[Any] = [0.0] * (STATIONS + 1)
    acceleration_y: list[Any] = [0.0] * (STATIONS + 1)
    answer_own: list[Any] = [0.0] * STATIONS
    answer_x: list[Any] = [0.0] * STATIONS
    answer_y: list[Any] = [0.0] * STATIONS
    joint_torque: list[Any] = [0.0] * STATIONS
    lever_cosine: list[Any] = [0.0] * STATIONS
    lever_sine: list[Any] = [0.0] * STATIONS
    predicted_angle: list[Any] = [0.0] * (STATIONS + 1)
    predicted_rate: list[Any] = [0.0] * (STATIONS + 1)
    relative_x: list[Any] = [0.0] * STATIONS
    relative_y: list[Any] = [0.0] * STATIONS
    solved: list[Any] = [0.0] * STATIONS
    swing_x: list[Any] = [0.0] * STATIONS
    swing_y: list[Any] = [0.0] * STATIONS
    transmission: list[Any] = [0.0] * STATIONS

    # predicted motion
    predicted_rate[0] = hub_rate + hub_acceleration * step
    predicted_angle[0] = hub_angle + half_step_squared * hub_acceleration + hub_rate * step
    for j in range(STATIONS):
        predicted_rate[j + 1] = rate[j] + acceleration[j] * step
        predicted_angle[j + 1] = angle[j] + acceleration[j] * half_step_squared + rate[j] * step

    # accelerations of the nodes
    for j in range(STATIONS):
        lever_cosine[j] = length * ca.cos(predicted_angle[j + 1])
        lever_sine[j] = length * ca.sin(predicted_angle[j + 1])
        square = predicted_rate[j + 1] * predicted_rate[j + 1]
        relative_x[j] = -acceleration[j] * lever_sine[j] - lever_cosine[j] * square
        relative_y[j] = acceleration[j] * lever_cosine[j] - lever_sine[j] * square
        turning = predicted_rate[j + 1] * step
        swing_x[j] = -lever_sine[j] - angle_per_acceleration * relative_y[j] - lever_cosine[j] * turning
        swing_y[j] = lever_cosine[j] + angle_per_acceleration * relative_x[j] - lever_sine[j] * turning
    node_x: Any = 0.0
    node_y: Any = 0.0
    acceleration_x[0] = node_x
    acceleration_y[0] = node_y
    for j in range(STATIONS):
        node_x = node_x + relative_x[j]
        node_y = node_y + relative_y[j]
        acceleration_x[j + 1] = node_x
        acceleration_y[j + 1] = node_y

    # forces of the joints at the motion so far
    for j in range(STATIONS):
        joint_torque[j] = damping[j] * (predicted_rate[j] - predicted_rate[j + 1]) + stiffness[j] * (
            predicted_angle[j] - predicted_angle[j + 1]
        )

    # sweep inward: force beyond each joint as an affine function of the motion at it
    impedance_xx = end_mass
    impedance_xy: Any = 0.0
    impedance_xu: Any = 0.0
    impedance_yx: Any = 0.0
    impedance_yy = end_mass
    impedance_yu: Any = 0.0
    impedance_ux: Any = 0.0
    impedance_uy: Any = 0.0
    impedance_uu: Any = 0.0
    force_x = acceleration_x[5] * end_mass
    force_y = acceleration_y[5] * end_mass
    torque: Any = 0.0
    for j in reversed(range(STATIONS)):
        impedance_xx = impedance_xx + mass
        force_x = force_x + acceleration_x[j + 1] * mass
        impedance_yy = impedance_yy + mass
        force_y = force_y + acceleration_y[j + 1] * mass
        impedance_xu = impedance_xu + impedance_xx * swing_x[j] + impedance_xy * swing_y[j]
        impedance_yu = impedance_yu + impedance_yx * swing_x[j] + impedance_yy * swing_y[j]
        impedance_uu = impedance_uu + impedance_ux * swing_x[j] + impedance_uy * swing_y[j]
        impedance_ux = impedance_ux - impedance_xx * lever_sine[j] + impedance_yx * lever_cosine[j]
        impedance_uy = impedance_uy - impedance_xy * lever_sine[j] + impedance_yy * lever_cosine[j]
        impedance_uu = (
            impedance_uu
            + rod_inertia
            + lever_cosine[j] * (impedance_yu - angle_per_acceleration * force_x)
            + lever_sine[j] * (-impedance_xu - angle_per_acceleration * force_y)
        )
        torque = torque + acceleration[j] * rod_inertia - force_x * lever_sine[j] + force_y * lever_cosine[j]
        pivot = impedance_uu + joint_impedance[j]
        admittance = 1.0 / pivot
        answer_own[j] = admittance * (joint_torque[j] - torque)
        answer_x[j] = admittance * impedance_ux
        answer_y[j] = admittance * impedance_uy
        transmission[j] = admittance * joint_impedance[j]
        impedance_xx = impedance_xx - answer_x[j] * impedance_xu
        impedance_xy = impedance_xy - answer_y[j] * impedance_xu
        force_x = force_x + answer_own[j] * impedance_xu
        impedance_xu = impedance_xu * transmission[j]
        impedance_yx = impedance_yx - answer_x[j] * impedance_yu
        impedance_yy = impedance_yy - answer_y[j] * impedance_yu
        force_y = force_y + answer_own[j] * impedance_yu
        impedance_yu = impedance_yu * transmission[j]
        impedance_ux = answer_x[j] * joint_impedance[j]
        impedance_uy = answer_y[j] * joint_impedance[j]
        impedance_uu = impedance_uu * transmission[j]
        torque = joint_torque[j] - answer_own[j] * joint_impedance[j]

    # the base
    hub_pivot = hub_impedance + impedance_uu
    unknown = (
        hub_torque - torque - hub_acceleration * hub_inertia - hub_damping * predicted_rate[0]
    ) / hub_pivot
    hub_unknown = unknown

    # sweep outward: the unknown of each station
    change_x: Any = 0.0
    change_y: Any = 0.0
    for j in range(STATIONS):
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y + transmission[j] * unknown
        change_x = change_x + swing_x[j] * unknown
        change_y = change_y + swing_y[j] * unknown
        solved[j] = unknown

    # motion at the end of the step
    hub_angle = predicted_angle[0] + angle_per_acceleration * hub_unknown
    hub_rate = predicted_rate[0] + hub_unknown * rate_per_acceleration
    hub_acceleration = hub_acceleration + hub_unknown
    for j in range(STATIONS):
        angle[j] = predicted_angle[j + 1] + angle_per_acceleration * solved[j]
        rate[j] = predicted_rate[j + 1] + rate_per_acceleration * solved[j]
        acceleration[j] = acceleration[j] + solved[j]
    return _column(hub_angle, hub_rate, hub_acceleration, *angle, *rate, *acceleration)


def _output(model: dict[str, Any], x: ca.SX, stages: Sequence[ca.SX]) -> ca.SX:
    """Read the outputs off a state."""
    length = model["length"]
    hub_angle = x[0]
    angle = ca.vertsplit(x[3:8])

    # output tip: position
    tip_x: Any = 0.0
    tip_y: Any = 0.0
    for j in range(STATIONS):
        tip_x = tip_x + length * ca.cos(angle[j])
        tip_y = tip_y + length * ca.sin(angle[j])

    # output hub: angle
    hub = hub_angle
    return _column(tip_x, tip_y, hub)

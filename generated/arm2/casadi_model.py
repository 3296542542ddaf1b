# arm2: Two unlike links swung by a motor
#
# Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
# scene digest: c5e09abbb61734735cef8cfddf39dd959eb5765da3ad6484bed2957b4fdf212c
# sha256 of the rest of this file: 6acba0fa1ceb9bc60af645232aa961fad80577a4a0c558ca7a5e81db5e12d0e8
#
# model: planar arm, large rotations, gravity, tip mass
# stations: 2
# base: motor
# integrator: Newmark 1959, beta = 0.25, gamma = 0.5
# linearisation: newton
# sweep: riccati
# unknown: acceleration
# operations of a step: 249, 124.5 per station (116 additions, 126 multiplications, 3 divisions, 4 sines and
#     cosines)
# operations of prepare: 38, 19 per station (10 additions, 28 multiplications)
"""arm2: Two unlike links swung by a motor. Functions for optimisation and control.

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


STATIONS = 2
"""Number of links."""
STATE_NAMES: tuple[str, ...] = (
    "hub_angle",
    "hub_rate",
    "hub_acceleration",
    *_numbered("angle", 2),
    *_numbered("rate", 2),
    *_numbered("acceleration", 2),
)
INPUT_NAMES: tuple[str, ...] = ("hub_torque",)
OUTPUT_NAMES: tuple[str, ...] = ("tip_x", "tip_y", "hub", "elbow")
PARAMETER_NAMES: tuple[str, ...] = (
    "step",
    *_numbered("length", 2),
    *_numbered("mass", 2),
    *_numbered("inertia", 2),
    *_numbered("center", 2),
    *_numbered("stiffness", 2),
    *_numbered("damping", 2),
    "gravity",
    "hub_inertia",
    "hub_damping",
    "tip_mass",
    "tip_inertia",
)
STAGE_INSTANTS = ((1.0,),)
"""When inputs are read, in steps from the start of the step."""


def default_parameters() -> ca.DM:
    """Return the scene's step and physical parameters, a column ``p``."""
    values = (
        0.001,
        0.45,
        0.35,
        0.9,
        0.5,
        0.016,
        0.006,
        0.4,
        0.45,
        120.0,
        40.0,
        0.6,
        0.2,
        9.81,
        0.05,
        0.05,
        0.1,
        0.0002,
    )
    return ca.DM(values)


def step_function() -> ca.Function:
    """Return the step ``(x, u, p) -> (x_next, y)``: the state one step later, and the outputs at ``x``."""
    return _function("arm2_step", _step, STAGE_INSTANTS[-1])


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
        "initial_angle": ca.SX.sym("initial_angle", 2),  # angles to start from (rad)
        "initial_rate": ca.SX.sym("initial_rate", 2),  # rates to start from (rad/s)
    }
    u, p = _symbols(INPUT_NAMES), _symbols(PARAMETER_NAMES)
    with _as_written():
        x = _initialise(given, [u], p)
    return ca.Function("arm2_initial", [*given.values(), u, p], [x], [*given, "u", "p"], ["x"])


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
    length = ca.vertsplit(p[1:3])
    mass = ca.vertsplit(p[3:5])
    inertia = ca.vertsplit(p[5:7])
    center = ca.vertsplit(p[7:9])
    stiffness = ca.vertsplit(p[9:11])
    damping = ca.vertsplit(p[11:13])
    gravity = p[13]
    hub_inertia = p[14]
    hub_damping = p[15]
    tip_mass = p[16]
    tip_inertia = p[17]
    joint_impedance: list[Any] = [0.0] * STATIONS
    node_mass: list[Any] = [0.0] * STATIONS
    rod_inertia: list[Any] = [0.0] * STATIONS

    # masses at the nodes between links, and what they leave over
    for j in range(1):
        node_mass[j] = center[j] * mass[j] + mass[j + 1] * (1.0 - center[j + 1])
    node_mass[1] = tip_mass + center[1] * mass[1]
    for j in range(STATIONS):
        rod_inertia[j] = inertia[j] - center[j] * (length[j] * length[j]) * mass[j] * (1.0 - center[j])

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
        "stiffness": stiffness,
        "damping": damping,
        "gravity": gravity,
        "hub_inertia": hub_inertia,
        "hub_damping": hub_damping,
        "tip_inertia": tip_inertia,
        "half_step_squared": half_step_squared,
        "angle_per_acceleration": angle_per_acceleration,
        "rate_per_acceleration": rate_per_acceleration,
        "node_mass": node_mass,
        "rod_inertia": rod_inertia,
        "joint_impedance": joint_impedance,
        "hub_impedance": hub_impedance,
    }


def _initialise(given: dict[str, ca.SX], stages: Sequence[ca.SX], p: ca.SX) -> ca.SX:
    """Start from given angles and rates with the acceleration that satisfies the equations of motion."""
    length = ca.vertsplit(p[1:3])
    mass = ca.vertsplit(p[3:5])
    inertia = ca.vertsplit(p[5:7])
    center = ca.vertsplit(p[7:9])
    stiffness = ca.vertsplit(p[9:11])
    damping = ca.vertsplit(p[11:13])
    gravity = p[13]
    hub_inertia = p[14]
    hub_damping = p[15]
    tip_mass = p[16]
    tip_inertia = p[17]
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
    start_node_mass: list[Any] = [0.0] * STATIONS
    start_rod_inertia: list[Any] = [0.0] * STATIONS

    # masses at the nodes between links, and what they leave over
    for j in range(1):
        start_node_mass[j] = center[j] * mass[j] + mass[j + 1] * (1.0 - center[j + 1])
    start_node_mass[1] = tip_mass + center[1] * mass[1]
    for j in range(STATIONS):
        start_rod_inertia[j] = inertia[j] - center[j] * (length[j] * length[j]) * mass[j] * (1.0 - center[j])

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

    # accelerations of the nodes, seen from a falling frame: gravity is the base's own
    for j in range(STATIONS):
        lever_cosine[j] = length[j] * ca.cos(predicted_angle[j + 1])
        lever_sine[j] = length[j] * ca.sin(predicted_angle[j + 1])
        square = predicted_rate[j + 1] * predicted_rate[j + 1]
        relative_x[j] = -lever_cosine[j] * square - lever_sine[j] * predicted_acceleration[j + 1]
        relative_y[j] = lever_cosine[j] * predicted_acceleration[j + 1] - lever_sine[j] * square
    node_x: Any = 0.0
    node_y = gravity
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
    impedance_xx: Any = 0.0
    impedance_xy: Any = 0.0
    impedance_yx: Any = 0.0
    impedance_yy: Any = 0.0
    impedance_uu = tip_inertia
    force_x: Any = 0.0
    force_y: Any = 0.0
    torque = predicted_acceleration[2] * tip_inertia
    for j in reversed(range(STATIONS)):
        impedance_xx = impedance_xx + start_node_mass[j]
        force_x = force_x + acceleration_x[j + 1] * start_node_mass[j]
        impedance_yy = impedance_yy + start_node_mass[j]
        force_y = force_y + acceleration_y[j + 1] * start_node_mass[j]
        impedance_xu = impedance_xy * lever_cosine[j] - impedance_xx * lever_sine[j]
        impedance_yu = impedance_yy * lever_cosine[j] - impedance_yx * lever_sine[j]
        impedance_ux = impedance_yx * lever_cosine[j] - impedance_xx * lever_sine[j]
        impedance_uy = impedance_yy * lever_cosine[j] - impedance_xy * lever_sine[j]
        impedance_uu = (
            impedance_uu
            + start_rod_inertia[j]
            - impedance_xu * lever_sine[j]
            + impedance_yu * lever_cosine[j]
        )
        torque = (
            torque
            - force_x * lever_sine[j]
            + force_y * lever_cosine[j]
            + predicted_acceleration[j + 1] * start_rod_inertia[j]
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
        impedance_uu = 0.0

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
    stiffness = model["stiffness"]
    damping = model["damping"]
    gravity = model["gravity"]
    hub_inertia = model["hub_inertia"]
    hub_damping = model["hub_damping"]
    tip_inertia = model["tip_inertia"]
    half_step_squared = model["half_step_squared"]
    angle_per_acceleration = model["angle_per_acceleration"]
    rate_per_acceleration = model["rate_per_acceleration"]
    node_mass = model["node_mass"]
    rod_inertia = model["rod_inertia"]
    joint_impedance = model["joint_impedance"]
    hub_impedance = model["hub_impedance"]
    hub_angle = x[0]
    hub_rate = x[1]
    hub_acceleration = x[2]
    angle = ca.vertsplit(x[3:5])
    rate = ca.vertsplit(x[5:7])
    acceleration = ca.vertsplit(x[7:9])
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

    # accelerations of the nodes, seen from a falling frame: gravity is the base's own
    for j in range(STATIONS):
        lever_cosine[j] = length[j] * ca.cos(predicted_angle[j + 1])
        lever_sine[j] = length[j] * ca.sin(predicted_angle[j + 1])
        square = predicted_rate[j + 1] * predicted_rate[j + 1]
        relative_x[j] = -acceleration[j] * lever_sine[j] - lever_cosine[j] * square
        relative_y[j] = acceleration[j] * lever_cosine[j] - lever_sine[j] * square
        turning = predicted_rate[j + 1] * step
        swing_x[j] = -lever_sine[j] - angle_per_acceleration * relative_y[j] - lever_cosine[j] * turning
        swing_y[j] = lever_cosine[j] + angle_per_acceleration * relative_x[j] - lever_sine[j] * turning
    node_x: Any = 0.0
    node_y = gravity
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
    impedance_xx: Any = 0.0
    impedance_xy: Any = 0.0
    impedance_xu: Any = 0.0
    impedance_yx: Any = 0.0
    impedance_yy: Any = 0.0
    impedance_yu: Any = 0.0
    impedance_ux: Any = 0.0
    impedance_uy: Any = 0.0
    impedance_uu = tip_inertia
    force_x: Any = 0.0
    force_y: Any = 0.0
    torque = acceleration[1] * tip_inertia
    for j in reversed(range(STATIONS)):
        impedance_xx = impedance_xx + node_mass[j]
        force_x = force_x + acceleration_x[j + 1] * node_mass[j]
        impedance_yy = impedance_yy + node_mass[j]
        force_y = force_y + acceleration_y[j + 1] * node_mass[j]
        impedance_xu = impedance_xu + impedance_xx * swing_x[j] + impedance_xy * swing_y[j]
        impedance_yu = impedance_yu + impedance_yx * swing_x[j] + impedance_yy * swing_y[j]
        impedance_uu = impedance_uu + impedance_ux * swing_x[j] + impedance_uy * swing_y[j]
        impedance_ux = impedance_ux - impedance_xx * lever_sine[j] + impedance_yx * lever_cosine[j]
        impedance_uy = impedance_uy - impedance_xy * lever_sine[j] + impedance_yy * lever_cosine[j]
        impedance_uu = (
            impedance_uu
            + rod_inertia[j]
            + lever_cosine[j] * (impedance_yu - angle_per_acceleration * force_x)
            + lever_sine[j] * (-impedance_xu - angle_per_acceleration * force_y)
        )
        torque = (
            torque + acceleration[j] * rod_inertia[j] - force_x * lever_sine[j] + force_y * lever_cosine[j]
        )
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
    stiffness = model["stiffness"]
    damping = model["damping"]
    hub_angle = x[0]
    angle = ca.vertsplit(x[3:5])
    rate = ca.vertsplit(x[5:7])

    # output tip: position
    tip_x: Any = 0.0
    tip_y: Any = 0.0
    for j in range(STATIONS):
        tip_x = tip_x + length[j] * ca.cos(angle[j])
        tip_y = tip_y + length[j] * ca.sin(angle[j])

    # output hub: angle
    hub = hub_angle

    # output elbow: torque
    elbow = damping[1] * (rate[1] - rate[0]) + stiffness[1] * (angle[1] - angle[0])
    return _column(tip_x, tip_y, hub, elbow)

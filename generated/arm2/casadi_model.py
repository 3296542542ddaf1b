# arm2: Two unlike links swung by a motor
#
# Written by tmm-gen 0.1.0. Do not edit: change the scene and run `tmm-gen build`.
# scene digest: c5e09abbb61734735cef8cfddf39dd959eb5765da3ad6484bed2957b4fdf212c
# sha256 of the rest of this file: f84cfca03752ad927b30c84ceed509d2eeed4f2775eb5a145a212edf7879ea7d
#
# model: planar arm, large rotations, gravity, tip mass
# stations: 2
# base: motor
# integrator: Newmark 1959, beta = 0.25, gamma = 0.5
# linearisation: newton
# sweep: riccati
# unknown: acceleration
# operations of a step: 287, 143.5 per station (132 additions, 148 multiplications, 3 divisions, 4 functions)
# operations of prepare: 37, 18.5 per station (7 additions, 30 multiplications)
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
    carried_mass: list[Any] = [0.0] * STATIONS
    inner_mass: list[Any] = [0.0] * STATIONS
    joint_impedance: list[Any] = [0.0] * STATIONS
    pin_inertia: list[Any] = [0.0] * STATIONS

    # Masses by the ends they act at, and joint impedances
    for j in range(STATIONS):
        carried_mass[j] = center[j] * mass[j]
        inner_mass[j] = mass[j] - center[j] * mass[j]
        pin_inertia[j] = inertia[j] + center[j] * center[j] * (length[j] * length[j]) * mass[j]
        joint_impedance[j] = 0.5 * damping[j] * step + 0.25 * (step * step) * stiffness[j]

    # Factors of the step that depend on the time step and parameters alone
    step2_1_over_2 = 0.5 * (step * step)
    angle_per_acceleration = 0.25 * (step * step)
    factor_3 = 0.5 * (2.0 * hub_inertia + hub_damping * step)
    rate_per_acceleration = 0.5 * step
    return {
        "step": step,
        "length": length,
        "mass": mass,
        "stiffness": stiffness,
        "damping": damping,
        "gravity": gravity,
        "hub_inertia": hub_inertia,
        "hub_damping": hub_damping,
        "tip_mass": tip_mass,
        "tip_inertia": tip_inertia,
        "step2_1_over_2": step2_1_over_2,
        "angle_per_acceleration": angle_per_acceleration,
        "factor_3": factor_3,
        "rate_per_acceleration": rate_per_acceleration,
        "carried_mass": carried_mass,
        "inner_mass": inner_mass,
        "pin_inertia": pin_inertia,
        "joint_impedance": joint_impedance,
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
    solved: list[Any] = [0.0] * STATIONS
    swing_x: list[Any] = [0.0] * STATIONS
    swing_y: list[Any] = [0.0] * STATIONS

    # predicted motion
    predicted_angle[0] = 0.0
    predicted_rate[0] = 0.0
    predicted_acceleration[0] = 0.0
    for j in range(STATIONS):
        predicted_angle[j + 1] = initial_angle[j]
        predicted_rate[j + 1] = initial_rate[j]
        predicted_acceleration[j + 1] = 0.0

    # accelerations of the nodes, seen from a falling frame: gravity is the base's own
    for j in range(STATIONS):
        lever_sine[j] = length[j] * ca.sin(predicted_angle[j + 1])
        lever_cosine[j] = length[j] * ca.cos(predicted_angle[j + 1])
    node_x: Any = 0.0
    node_y = gravity
    acceleration_x[0] = node_x
    acceleration_y[0] = node_y
    for j in range(STATIONS):
        square = predicted_rate[j + 1] * predicted_rate[j + 1]
        node_x = node_x - lever_cosine[j] * square - lever_sine[j] * predicted_acceleration[j + 1]
        node_y = node_y + lever_cosine[j] * predicted_acceleration[j + 1] - lever_sine[j] * square
        acceleration_x[j + 1] = node_x
        acceleration_y[j + 1] = node_y

    # how each link's outer end answers to its unknown, and the predicted joint torques
    for j in range(STATIONS):
        swing_x[j] = -lever_sine[j]
        swing_y[j] = lever_cosine[j]
        joint_torque[j] = damping[j] * (predicted_rate[j] - predicted_rate[j + 1]) + stiffness[j] * (
            predicted_angle[j] - predicted_angle[j + 1]
        )

    # sweep inward: force beyond each joint as an affine function of the motion at it
    impedance_xx = tip_mass
    impedance_xy: Any = 0.0
    impedance_xu: Any = 0.0
    impedance_yx: Any = 0.0
    impedance_yy = tip_mass
    impedance_yu: Any = 0.0
    impedance_ux: Any = 0.0
    impedance_uy: Any = 0.0
    impedance_uu = tip_inertia
    force_x = acceleration_x[2] * tip_mass
    force_y = acceleration_y[2] * tip_mass
    torque = predicted_acceleration[2] * tip_inertia
    for j in reversed(range(STATIONS)):
        outer_x = impedance_xu + impedance_xx * swing_x[j] + impedance_xy * swing_y[j]
        outer_y = impedance_yu + impedance_yx * swing_x[j] + impedance_yy * swing_y[j]
        outer_u = impedance_uu + impedance_ux * swing_x[j] + impedance_uy * swing_y[j]
        load_x = force_x + acceleration_x[j] * center[j] * mass[j]
        load_y = force_y + acceleration_y[j] * center[j] * mass[j]
        link_ux = (
            impedance_ux
            + impedance_yx * lever_cosine[j]
            - lever_sine[j] * (impedance_xx + center[j] * mass[j])
        )
        link_uy = (
            impedance_uy
            - impedance_xy * lever_sine[j]
            + lever_cosine[j] * (impedance_yy + center[j] * mass[j])
        )
        link_uu = (
            inertia[j]
            + outer_u
            + lever_cosine[j] * outer_y
            - lever_sine[j] * outer_x
            + center[j] * center[j] * (length[j] * length[j]) * mass[j]
        )
        link_xx = impedance_xx + mass[j]
        link_xy = impedance_xy
        link_xu = outer_x + center[j] * mass[j] * swing_x[j]
        link_yx = impedance_yx
        link_yy = impedance_yy + mass[j]
        link_yu = outer_y + center[j] * mass[j] * swing_y[j]
        torque = (
            torque
            + lever_cosine[j] * load_y
            - lever_sine[j] * load_x
            + predicted_acceleration[j + 1]
            * (inertia[j] + center[j] * center[j] * (length[j] * length[j]) * mass[j])
        )
        force_x = (
            force_x
            + acceleration_x[j] * (mass[j] - center[j] * mass[j])
            + acceleration_x[j + 1] * center[j] * mass[j]
        )
        force_y = (
            force_y
            + acceleration_y[j] * (mass[j] - center[j] * mass[j])
            + acceleration_y[j + 1] * center[j] * mass[j]
        )
        pivot = link_uu
        inverse_pivot = 1.0 / pivot
        answer_own[j] = inverse_pivot * (joint_torque[j] - torque)
        answer_x[j] = inverse_pivot * link_ux
        answer_y[j] = inverse_pivot * link_uy
        impedance_xx = link_xx - answer_x[j] * link_xu
        impedance_xy = link_xy - answer_y[j] * link_xu
        impedance_xu = 0.0
        force_x = force_x + answer_own[j] * link_xu
        impedance_yx = link_yx - answer_x[j] * link_yu
        impedance_yy = link_yy - answer_y[j] * link_yu
        impedance_yu = 0.0
        force_y = force_y + answer_own[j] * link_yu
        impedance_ux = 0.0
        impedance_uy = 0.0
        impedance_uu = 0.0
        torque = joint_torque[j]

    # the hub
    hub_pivot = hub_inertia + impedance_uu
    unknown = (
        hub_torque - torque - hub_damping * predicted_rate[0] - hub_inertia * predicted_acceleration[0]
    ) / hub_pivot
    hub_unknown = unknown

    # sweep outward: the increment of each link's unknown
    change_x: Any = 0.0
    change_y: Any = 0.0
    for j in range(STATIONS):
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y
        change_x = change_x + swing_x[j] * unknown
        change_y = change_y + swing_y[j] * unknown
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
    gravity = model["gravity"]
    hub_inertia = model["hub_inertia"]
    hub_damping = model["hub_damping"]
    tip_mass = model["tip_mass"]
    tip_inertia = model["tip_inertia"]
    step2_1_over_2 = model["step2_1_over_2"]
    angle_per_acceleration = model["angle_per_acceleration"]
    factor_3 = model["factor_3"]
    rate_per_acceleration = model["rate_per_acceleration"]
    carried_mass = model["carried_mass"]
    inner_mass = model["inner_mass"]
    pin_inertia = model["pin_inertia"]
    joint_impedance = model["joint_impedance"]
    hub_angle = x[0]
    hub_rate = x[1]
    hub_acceleration = x[2]
    angle = ca.vertsplit(x[3:5])
    rate = ca.vertsplit(x[5:7])
    acceleration = ca.vertsplit(x[7:9])
    hub_torque = stages[0][0]
    acceleration_x: list[Any] = [0.0] * (STATIONS + 1)
    acceleration_y: list[Any] = [0.0] * (STATIONS + 1)
    answer_from_inner: list[Any] = [0.0] * STATIONS
    answer_own: list[Any] = [0.0] * STATIONS
    answer_x: list[Any] = [0.0] * STATIONS
    answer_y: list[Any] = [0.0] * STATIONS
    joint_torque: list[Any] = [0.0] * STATIONS
    lever_cosine: list[Any] = [0.0] * STATIONS
    lever_sine: list[Any] = [0.0] * STATIONS
    predicted_acceleration: list[Any] = [0.0] * (STATIONS + 1)
    predicted_angle: list[Any] = [0.0] * (STATIONS + 1)
    predicted_rate: list[Any] = [0.0] * (STATIONS + 1)
    solved: list[Any] = [0.0] * STATIONS
    swing_x: list[Any] = [0.0] * STATIONS
    swing_y: list[Any] = [0.0] * STATIONS

    # predicted motion
    predicted_angle[0] = hub_angle + hub_acceleration * step2_1_over_2 + hub_rate * step
    predicted_rate[0] = hub_rate + hub_acceleration * step
    predicted_acceleration[0] = hub_acceleration
    for j in range(STATIONS):
        predicted_angle[j + 1] = angle[j] + acceleration[j] * step2_1_over_2 + rate[j] * step
        predicted_rate[j + 1] = rate[j] + acceleration[j] * step
        predicted_acceleration[j + 1] = acceleration[j]

    # accelerations of the nodes, seen from a falling frame: gravity is the base's own
    for j in range(STATIONS):
        lever_sine[j] = length[j] * ca.sin(predicted_angle[j + 1])
        lever_cosine[j] = length[j] * ca.cos(predicted_angle[j + 1])
    node_x: Any = 0.0
    node_y = gravity
    acceleration_x[0] = node_x
    acceleration_y[0] = node_y
    for j in range(STATIONS):
        square = predicted_rate[j + 1] * predicted_rate[j + 1]
        node_x = node_x - lever_cosine[j] * square - lever_sine[j] * predicted_acceleration[j + 1]
        node_y = node_y + lever_cosine[j] * predicted_acceleration[j + 1] - lever_sine[j] * square
        acceleration_x[j + 1] = node_x
        acceleration_y[j + 1] = node_y

    # how each link's outer end answers to its unknown, and the predicted joint torques
    for j in range(STATIONS):
        tangential = 1.0 - angle_per_acceleration * (predicted_rate[j + 1] * predicted_rate[j + 1])
        turning = angle_per_acceleration * predicted_acceleration[j + 1] + predicted_rate[j + 1] * step
        swing_x[j] = -lever_cosine[j] * turning - lever_sine[j] * tangential
        swing_y[j] = lever_cosine[j] * tangential - lever_sine[j] * turning
        joint_torque[j] = damping[j] * (predicted_rate[j] - predicted_rate[j + 1]) + stiffness[j] * (
            predicted_angle[j] - predicted_angle[j + 1]
        )

    # sweep inward: force beyond each joint as an affine function of the motion at it
    impedance_xx = tip_mass
    impedance_xy: Any = 0.0
    impedance_xu: Any = 0.0
    impedance_yx: Any = 0.0
    impedance_yy = tip_mass
    impedance_yu: Any = 0.0
    impedance_ux: Any = 0.0
    impedance_uy: Any = 0.0
    impedance_uu = tip_inertia
    force_x = acceleration_x[2] * tip_mass
    force_y = acceleration_y[2] * tip_mass
    torque = predicted_acceleration[2] * tip_inertia
    for j in reversed(range(STATIONS)):
        outer_x = impedance_xu + impedance_xx * swing_x[j] + impedance_xy * swing_y[j]
        outer_y = impedance_yu + impedance_yx * swing_x[j] + impedance_yy * swing_y[j]
        outer_u = impedance_uu + impedance_ux * swing_x[j] + impedance_uy * swing_y[j]
        load_x = force_x + acceleration_x[j] * carried_mass[j]
        load_y = force_y + acceleration_y[j] * carried_mass[j]
        link_ux = (
            impedance_ux + impedance_yx * lever_cosine[j] - lever_sine[j] * (carried_mass[j] + impedance_xx)
        )
        link_uy = (
            impedance_uy - impedance_xy * lever_sine[j] + lever_cosine[j] * (carried_mass[j] + impedance_yy)
        )
        link_uu = (
            outer_u
            + pin_inertia[j]
            + angle_per_acceleration * (-lever_cosine[j] * load_x - lever_sine[j] * load_y)
            + lever_cosine[j] * outer_y
            - lever_sine[j] * outer_x
        )
        link_xx = impedance_xx + mass[j]
        link_xy = impedance_xy
        link_xu = outer_x + carried_mass[j] * swing_x[j]
        link_yx = impedance_yx
        link_yy = impedance_yy + mass[j]
        link_yu = outer_y + carried_mass[j] * swing_y[j]
        torque = (
            torque
            + lever_cosine[j] * load_y
            - lever_sine[j] * load_x
            + pin_inertia[j] * predicted_acceleration[j + 1]
        )
        force_x = force_x + acceleration_x[j + 1] * carried_mass[j] + acceleration_x[j] * inner_mass[j]
        force_y = force_y + acceleration_y[j + 1] * carried_mass[j] + acceleration_y[j] * inner_mass[j]
        pivot = joint_impedance[j] + link_uu
        inverse_pivot = 1.0 / pivot
        answer_own[j] = inverse_pivot * (joint_torque[j] - torque)
        answer_x[j] = inverse_pivot * link_ux
        answer_y[j] = inverse_pivot * link_uy
        answer_from_inner[j] = inverse_pivot * joint_impedance[j]
        impedance_xx = link_xx - answer_x[j] * link_xu
        impedance_xy = link_xy - answer_y[j] * link_xu
        impedance_xu = answer_from_inner[j] * link_xu
        force_x = force_x + answer_own[j] * link_xu
        impedance_yx = link_yx - answer_x[j] * link_yu
        impedance_yy = link_yy - answer_y[j] * link_yu
        impedance_yu = answer_from_inner[j] * link_yu
        force_y = force_y + answer_own[j] * link_yu
        impedance_ux = answer_x[j] * joint_impedance[j]
        impedance_uy = answer_y[j] * joint_impedance[j]
        impedance_uu = answer_from_inner[j] * link_uu
        torque = joint_torque[j] - answer_own[j] * joint_impedance[j]

    # the hub
    hub_pivot = factor_3 + impedance_uu
    unknown = (
        hub_torque - torque - hub_damping * predicted_rate[0] - hub_inertia * predicted_acceleration[0]
    ) / hub_pivot
    hub_unknown = unknown

    # sweep outward: the increment of each link's unknown
    change_x: Any = 0.0
    change_y: Any = 0.0
    for j in range(STATIONS):
        unknown = (
            answer_own[j] + answer_from_inner[j] * unknown - answer_x[j] * change_x - answer_y[j] * change_y
        )
        change_x = change_x + swing_x[j] * unknown
        change_y = change_y + swing_y[j] * unknown
        solved[j] = unknown

    # motion at the end of the step
    hub_angle = predicted_angle[0] + angle_per_acceleration * hub_unknown
    hub_rate = predicted_rate[0] + hub_unknown * rate_per_acceleration
    hub_acceleration = hub_unknown + predicted_acceleration[0]
    for j in range(STATIONS):
        angle[j] = predicted_angle[j + 1] + angle_per_acceleration * solved[j]
        rate[j] = predicted_rate[j + 1] + rate_per_acceleration * solved[j]
        acceleration[j] = predicted_acceleration[j + 1] + solved[j]
    return _column(hub_angle, hub_rate, hub_acceleration, *angle, *rate, *acceleration)


def _output(model: dict[str, Any], x: ca.SX, stages: Sequence[ca.SX]) -> ca.SX:
    """Read the outputs off a state."""
    length = model["length"]
    stiffness = model["stiffness"]
    damping = model["damping"]
    hub_angle = x[0]
    angle = ca.vertsplit(x[3:5])
    rate = ca.vertsplit(x[5:7])

    # tip: position
    tip_x: Any = 0.0
    tip_y: Any = 0.0
    for j in range(STATIONS):
        tip_x = tip_x + length[j] * ca.cos(angle[j])
        tip_y = tip_y + length[j] * ca.sin(angle[j])

    # hub: angle
    hub = hub_angle

    # elbow: torque
    elbow = damping[1] * (rate[1] - rate[0]) + stiffness[1] * (angle[1] - angle[0])
    return _column(tip_x, tip_y, hub, elbow)

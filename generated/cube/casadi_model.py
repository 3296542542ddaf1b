# cube: Satellite with two flexible panels
#
# Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
# scene digest: f046f23ff154c77eb0de6f429bf04f6275910b87af75eea62b4aa0e7be8a3583
# sha256 of the rest of this file: 7e40eedea962aa0d9c7a863b64281c7b90742466e09035ae666ee1d1cf353c97
#
# model: planar arm, large rotations
# stations: 12
# base: free
# integrator: Newmark 1959, beta = 0.25, gamma = 0.5
# linearisation: newton
# sweep: riccati
# unknown: acceleration
# joints in arrays, from 0: left_latch 0, right_latch 6
# links in arrays, from 0: left_yoke 0, left_panel 1 to 5, right_yoke 6, right_panel 7 to 11
# operations of a step: 1462, 121.8 per station (686 additions, 734 multiplications, 18 divisions, 24 sines
#     and cosines)
# operations of prepare: 201, 16.75 per station (62 additions, 139 multiplications)
"""cube: Satellite with two flexible panels. Functions for optimisation and control.

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


STATIONS = 12
"""Number of links."""
STATE_NAMES: tuple[str, ...] = (
    "hub_angle",
    "hub_rate",
    "hub_acceleration",
    *_numbered("angle", 12),
    *_numbered("rate", 12),
    *_numbered("acceleration", 12),
    "base_place_x",
    "base_velocity_x",
    "base_acceleration_x",
    "base_place_y",
    "base_velocity_y",
    "base_acceleration_y",
)
INPUT_NAMES: tuple[str, ...] = ("wheel", "thruster")
OUTPUT_NAMES: tuple[str, ...] = ("attitude", "hub_x", "hub_y", "right_end_x", "right_end_y", "latch_torque")
PARAMETER_NAMES: tuple[str, ...] = (
    "step",
    *_numbered("length", 12),
    *_numbered("mass", 12),
    *_numbered("inertia", 12),
    "center",
    *_numbered("stiffness", 12),
    *_numbered("damping", 12),
    *_numbered("rest", 12),
    "hub_inertia",
    "hub_mass",
)
STAGE_INSTANTS = ((1.0,),)
"""When inputs are read, in steps from the start of the step."""


def default_parameters() -> ca.DM:
    """Return the scene's step and physical parameters, a column ``p``."""
    values = (
        0.002,
        0.15,
        0.2,
        0.2,
        0.2,
        0.2,
        0.1,
        0.15,
        0.2,
        0.2,
        0.2,
        0.2,
        0.1,
        0.12,
        0.28,
        0.28,
        0.28,
        0.28,
        0.14,
        0.12,
        0.28,
        0.28,
        0.28,
        0.28,
        0.14,
        0.000225,
        0.0009333333333333333,
        0.0009333333333333333,
        0.0009333333333333333,
        0.0009333333333333333,
        0.00011666666666666667,
        0.000225,
        0.0009333333333333333,
        0.0009333333333333333,
        0.0009333333333333333,
        0.0009333333333333333,
        0.00011666666666666667,
        0.5,
        60.0,
        90.0,
        45.0,
        45.0,
        45.0,
        45.0,
        60.0,
        90.0,
        45.0,
        45.0,
        45.0,
        45.0,
        0.02,
        0.09,
        0.045,
        0.045,
        0.045,
        0.045,
        0.02,
        0.09,
        0.045,
        0.045,
        0.045,
        0.045,
        3.141592653589793,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
        0.12,
        14.0,
    )
    return ca.DM(values)


def step_function() -> ca.Function:
    """Return the step ``(x, u, p) -> (x_next, y)``: the state one step later, and the outputs at ``x``."""
    return _function("cube_step", _step, STAGE_INSTANTS[-1])


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
        "initial_angle": ca.SX.sym("initial_angle", 12),  # angles to start from (rad)
        "initial_rate": ca.SX.sym("initial_rate", 12),  # rates to start from (rad/s)
    }
    u, p = _symbols(INPUT_NAMES), _symbols(PARAMETER_NAMES)
    with _as_written():
        x = _initialise(given, [u], p)
    return ca.Function("cube_initial", [*given.values(), u, p], [x], [*given, "u", "p"], ["x"])


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
    length = ca.vertsplit(p[1:13])
    mass = ca.vertsplit(p[13:25])
    inertia = ca.vertsplit(p[25:37])
    center = p[37]
    stiffness = ca.vertsplit(p[38:50])
    damping = ca.vertsplit(p[50:62])
    rest = ca.vertsplit(p[62:74])
    hub_inertia = p[74]
    hub_mass = p[75]
    joint_impedance: list[Any] = [0.0] * STATIONS
    node_mass: list[Any] = [0.0] * STATIONS
    rod_inertia: list[Any] = [0.0] * STATIONS

    # masses at the nodes between links, and what they leave over
    for j in range(11):
        node_mass[j] = center * mass[j] + mass[j + 1] * (1.0 - center)
    node_mass[5] = center * mass[5]
    node_mass[11] = center * mass[11]
    for j in range(STATIONS):
        rod_inertia[j] = inertia[j] - center * (length[j] * length[j]) * mass[j] * (1.0 - center)
    base_mass = hub_mass + mass[0] * (1.0 - center) + mass[6] * (1.0 - center)

    # factors of the sweep that do not change from step to step
    for j in reversed(range(7, STATIONS)):
        joint_impedance[j] = 0.5 * damping[j] * step + 0.25 * (step * step) * stiffness[j]
    for j in reversed(range(6, 7)):
        joint_impedance[j] = 0.5 * damping[j] * step + 0.25 * (step * step) * stiffness[j]
    for j in reversed(range(1, 6)):
        joint_impedance[j] = 0.5 * damping[j] * step + 0.25 * (step * step) * stiffness[j]
    for j in reversed(range(1)):
        joint_impedance[j] = 0.5 * damping[j] * step + 0.25 * (step * step) * stiffness[j]

    # Factors of the step that depend on the time step and parameters alone
    half_step_squared = 0.5 * (step * step)
    angle_per_acceleration = 0.25 * (step * step)
    rate_per_acceleration = 0.5 * step
    return {
        "step": step,
        "length": length,
        "stiffness": stiffness,
        "damping": damping,
        "rest": rest,
        "hub_inertia": hub_inertia,
        "half_step_squared": half_step_squared,
        "angle_per_acceleration": angle_per_acceleration,
        "rate_per_acceleration": rate_per_acceleration,
        "node_mass": node_mass,
        "rod_inertia": rod_inertia,
        "base_mass": base_mass,
        "joint_impedance": joint_impedance,
    }


def _initialise(given: dict[str, ca.SX], stages: Sequence[ca.SX], p: ca.SX) -> ca.SX:
    """Start from given angles and rates with the acceleration that satisfies the equations of motion."""
    length = ca.vertsplit(p[1:13])
    mass = ca.vertsplit(p[13:25])
    inertia = ca.vertsplit(p[25:37])
    center = p[37]
    stiffness = ca.vertsplit(p[38:50])
    damping = ca.vertsplit(p[50:62])
    rest = ca.vertsplit(p[62:74])
    hub_inertia = p[74]
    hub_mass = p[75]
    initial_angle = ca.vertsplit(given["initial_angle"])
    initial_rate = ca.vertsplit(given["initial_rate"])
    wheel = stages[0][0]
    thruster = stages[0][1]
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
    for j in range(11):
        start_node_mass[j] = center * mass[j] + mass[j + 1] * (1.0 - center)
    start_node_mass[5] = center * mass[5]
    start_node_mass[11] = center * mass[11]
    for j in range(STATIONS):
        start_rod_inertia[j] = inertia[j] - center * (length[j] * length[j]) * mass[j] * (1.0 - center)
    start_base_mass = hub_mass + mass[0] * (1.0 - center) + mass[6] * (1.0 - center)

    # predicted motion
    trial_acceleration_x: Any = 0.0
    trial_acceleration_y: Any = 0.0
    predicted_rate[0] = 0.0
    predicted_angle[0] = 0.0
    predicted_acceleration[0] = 0.0
    for j in range(STATIONS):
        predicted_rate[j + 1] = initial_rate[j]
        predicted_angle[j + 1] = initial_angle[j]
        predicted_acceleration[j + 1] = 0.0

    # accelerations of the nodes
    for j in range(1):
        lever_cosine[j] = length[j] * ca.cos(predicted_angle[j + 1])
        lever_sine[j] = length[j] * ca.sin(predicted_angle[j + 1])
        square = predicted_rate[j + 1] * predicted_rate[j + 1]
        relative_x[j] = -lever_cosine[j] * square - lever_sine[j] * predicted_acceleration[j + 1]
        relative_y[j] = lever_cosine[j] * predicted_acceleration[j + 1] - lever_sine[j] * square
    for j in range(1, 6):
        lever_cosine[j] = length[j] * ca.cos(predicted_angle[j + 1])
        lever_sine[j] = length[j] * ca.sin(predicted_angle[j + 1])
        square = predicted_rate[j + 1] * predicted_rate[j + 1]
        relative_x[j] = -lever_cosine[j] * square - lever_sine[j] * predicted_acceleration[j + 1]
        relative_y[j] = lever_cosine[j] * predicted_acceleration[j + 1] - lever_sine[j] * square
    for j in range(6, 7):
        lever_cosine[j] = length[j] * ca.cos(predicted_angle[j + 1])
        lever_sine[j] = length[j] * ca.sin(predicted_angle[j + 1])
        square = predicted_rate[j + 1] * predicted_rate[j + 1]
        relative_x[j] = -lever_cosine[j] * square - lever_sine[j] * predicted_acceleration[j + 1]
        relative_y[j] = lever_cosine[j] * predicted_acceleration[j + 1] - lever_sine[j] * square
    for j in range(7, STATIONS):
        lever_cosine[j] = length[j] * ca.cos(predicted_angle[j + 1])
        lever_sine[j] = length[j] * ca.sin(predicted_angle[j + 1])
        square = predicted_rate[j + 1] * predicted_rate[j + 1]
        relative_x[j] = -lever_cosine[j] * square - lever_sine[j] * predicted_acceleration[j + 1]
        relative_y[j] = lever_cosine[j] * predicted_acceleration[j + 1] - lever_sine[j] * square
    node_x = trial_acceleration_x
    node_y = trial_acceleration_y
    acceleration_x[0] = node_x
    acceleration_y[0] = node_y
    for j in range(1):
        node_x = node_x + relative_x[j]
        node_y = node_y + relative_y[j]
        acceleration_x[j + 1] = node_x
        acceleration_y[j + 1] = node_y
    for j in range(1, 6):
        node_x = node_x + relative_x[j]
        node_y = node_y + relative_y[j]
        acceleration_x[j + 1] = node_x
        acceleration_y[j + 1] = node_y
    node_x = acceleration_x[0]
    node_y = acceleration_y[0]
    for j in range(6, 7):
        node_x = node_x + relative_x[j]
        node_y = node_y + relative_y[j]
        acceleration_x[j + 1] = node_x
        acceleration_y[j + 1] = node_y
    for j in range(7, STATIONS):
        node_x = node_x + relative_x[j]
        node_y = node_y + relative_y[j]
        acceleration_x[j + 1] = node_x
        acceleration_y[j + 1] = node_y

    # forces of the joints at the motion so far
    for j in range(1):
        joint_torque[j] = (
            damping[j] * (predicted_rate[j] - predicted_rate[j + 1])
            + rest[j] * stiffness[j]
            + stiffness[j] * (predicted_angle[j] - predicted_angle[j + 1])
        )
    for j in range(1, 6):
        joint_torque[j] = damping[j] * (predicted_rate[j] - predicted_rate[j + 1]) + stiffness[j] * (
            predicted_angle[j] - predicted_angle[j + 1]
        )
    for j in range(6, 7):
        joint_torque[j] = damping[j] * (predicted_rate[0] - predicted_rate[j + 1]) + stiffness[j] * (
            predicted_angle[0] - predicted_angle[j + 1]
        )
    for j in range(7, STATIONS):
        joint_torque[j] = damping[j] * (predicted_rate[j] - predicted_rate[j + 1]) + stiffness[j] * (
            predicted_angle[j] - predicted_angle[j + 1]
        )

    # sweep inward: force beyond each joint as an affine function of the motion at it
    impedance_xx: Any = 0.0
    impedance_xy: Any = 0.0
    impedance_yx: Any = 0.0
    impedance_yy: Any = 0.0
    force_x: Any = 0.0
    force_y: Any = 0.0
    torque: Any = 0.0
    for j in reversed(range(7, STATIONS)):
        impedance_xx = impedance_xx + start_node_mass[j]
        force_x = force_x + acceleration_x[j + 1] * start_node_mass[j]
        impedance_yy = impedance_yy + start_node_mass[j]
        force_y = force_y + acceleration_y[j + 1] * start_node_mass[j]
        impedance_xu = impedance_xy * lever_cosine[j] - impedance_xx * lever_sine[j]
        impedance_yu = impedance_yy * lever_cosine[j] - impedance_yx * lever_sine[j]
        impedance_ux = impedance_yx * lever_cosine[j] - impedance_xx * lever_sine[j]
        impedance_uy = impedance_yy * lever_cosine[j] - impedance_xy * lever_sine[j]
        impedance_uu = start_rod_inertia[j] - impedance_xu * lever_sine[j] + impedance_yu * lever_cosine[j]
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
    for j in reversed(range(6, 7)):
        impedance_xx = impedance_xx + start_node_mass[j]
        force_x = force_x + acceleration_x[j + 1] * start_node_mass[j]
        impedance_yy = impedance_yy + start_node_mass[j]
        force_y = force_y + acceleration_y[j + 1] * start_node_mass[j]
        impedance_xu = impedance_xy * lever_cosine[j] - impedance_xx * lever_sine[j]
        impedance_yu = impedance_yy * lever_cosine[j] - impedance_yx * lever_sine[j]
        impedance_ux = impedance_yx * lever_cosine[j] - impedance_xx * lever_sine[j]
        impedance_uy = impedance_yy * lever_cosine[j] - impedance_xy * lever_sine[j]
        impedance_uu = start_rod_inertia[j] - impedance_xu * lever_sine[j] + impedance_yu * lever_cosine[j]
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
    impedance_xx_of_branch_7 = impedance_xx
    impedance_xy_of_branch_7 = impedance_xy
    impedance_yx_of_branch_7 = impedance_yx
    impedance_yy_of_branch_7 = impedance_yy
    force_x_of_branch_7 = force_x
    force_y_of_branch_7 = force_y
    torque_of_branch_7 = torque
    impedance_xx = 0.0
    impedance_xy = 0.0
    impedance_yx = 0.0
    impedance_yy = 0.0
    force_x = 0.0
    force_y = 0.0
    torque = 0.0
    for j in reversed(range(1, 6)):
        impedance_xx = impedance_xx + start_node_mass[j]
        force_x = force_x + acceleration_x[j + 1] * start_node_mass[j]
        impedance_yy = impedance_yy + start_node_mass[j]
        force_y = force_y + acceleration_y[j + 1] * start_node_mass[j]
        impedance_xu = impedance_xy * lever_cosine[j] - impedance_xx * lever_sine[j]
        impedance_yu = impedance_yy * lever_cosine[j] - impedance_yx * lever_sine[j]
        impedance_ux = impedance_yx * lever_cosine[j] - impedance_xx * lever_sine[j]
        impedance_uy = impedance_yy * lever_cosine[j] - impedance_xy * lever_sine[j]
        impedance_uu = start_rod_inertia[j] - impedance_xu * lever_sine[j] + impedance_yu * lever_cosine[j]
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
    for j in reversed(range(1)):
        impedance_xx = impedance_xx + start_node_mass[j]
        force_x = force_x + acceleration_x[j + 1] * start_node_mass[j]
        impedance_yy = impedance_yy + start_node_mass[j]
        force_y = force_y + acceleration_y[j + 1] * start_node_mass[j]
        impedance_xu = impedance_xy * lever_cosine[j] - impedance_xx * lever_sine[j]
        impedance_yu = impedance_yy * lever_cosine[j] - impedance_yx * lever_sine[j]
        impedance_ux = impedance_yx * lever_cosine[j] - impedance_xx * lever_sine[j]
        impedance_uy = impedance_yy * lever_cosine[j] - impedance_xy * lever_sine[j]
        impedance_uu = start_rod_inertia[j] - impedance_xu * lever_sine[j] + impedance_yu * lever_cosine[j]
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
    impedance_xx = impedance_xx + impedance_xx_of_branch_7
    impedance_xy = impedance_xy + impedance_xy_of_branch_7
    impedance_yx = impedance_yx + impedance_yx_of_branch_7
    impedance_yy = impedance_yy + impedance_yy_of_branch_7
    force_x = force_x + force_x_of_branch_7
    force_y = force_y + force_y_of_branch_7
    torque = torque + torque_of_branch_7

    # the base
    whole_impedance_xx = impedance_xx + start_base_mass
    whole_impedance_yy = impedance_yy + start_base_mass
    share_yx = impedance_yx / whole_impedance_xx
    impedance_yy_freed_x = whole_impedance_yy - impedance_xy * share_yx
    whole_force_x = force_x + acceleration_x[0] * start_base_mass
    whole_force_y = force_y - thruster + acceleration_y[0] * start_base_mass
    whole_torque = torque - wheel + hub_inertia * predicted_acceleration[0]
    force_y_freed_x = whole_force_y - share_yx * whole_force_x
    unknown = -whole_torque / hub_inertia
    change_y = -force_y_freed_x / impedance_yy_freed_x
    change_x = (-whole_force_x - change_y * impedance_xy) / whole_impedance_xx
    base_change_x = change_x
    base_change_y = change_y
    hub_unknown = unknown

    # sweep outward: the unknown of each station
    change_x = base_change_x
    change_y = base_change_y
    for j in range(1):
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y
        change_x = change_x - lever_sine[j] * unknown
        change_y = change_y + lever_cosine[j] * unknown
        solved[j] = unknown
    for j in range(1, 6):
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y
        change_x = change_x - lever_sine[j] * unknown
        change_y = change_y + lever_cosine[j] * unknown
        solved[j] = unknown
    change_x = base_change_x
    change_y = base_change_y
    unknown = hub_unknown
    for j in range(6, 7):
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y
        change_x = change_x - lever_sine[j] * unknown
        change_y = change_y + lever_cosine[j] * unknown
        solved[j] = unknown
    for j in range(7, STATIONS):
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y
        change_x = change_x - lever_sine[j] * unknown
        change_y = change_y + lever_cosine[j] * unknown
        solved[j] = unknown

    # motion at the end of the step
    trial_acceleration_x = base_change_x + trial_acceleration_x
    trial_acceleration_y = base_change_y + trial_acceleration_y
    hub_angle = predicted_angle[0]
    hub_rate = predicted_rate[0]
    hub_acceleration = hub_unknown + predicted_acceleration[0]
    base_place_x = 0.0
    base_velocity_x = 0.0
    base_acceleration_x = trial_acceleration_x
    base_place_y = 0.0
    base_velocity_y = 0.0
    base_acceleration_y = trial_acceleration_y
    for j in range(STATIONS):
        angle[j] = predicted_angle[j + 1]
        rate[j] = predicted_rate[j + 1]
        acceleration[j] = predicted_acceleration[j + 1] + solved[j]
    return _column(
        hub_angle,
        hub_rate,
        hub_acceleration,
        *angle,
        *rate,
        *acceleration,
        base_place_x,
        base_velocity_x,
        base_acceleration_x,
        base_place_y,
        base_velocity_y,
        base_acceleration_y,
    )


def _step(model: dict[str, Any], x: ca.SX, stages: Sequence[ca.SX]) -> ca.SX:
    """Advance the state by one step."""
    step = model["step"]
    length = model["length"]
    stiffness = model["stiffness"]
    damping = model["damping"]
    rest = model["rest"]
    hub_inertia = model["hub_inertia"]
    half_step_squared = model["half_step_squared"]
    angle_per_acceleration = model["angle_per_acceleration"]
    rate_per_acceleration = model["rate_per_acceleration"]
    node_mass = model["node_mass"]
    rod_inertia = model["rod_inertia"]
    base_mass = model["base_mass"]
    joint_impedance = model["joint_impedance"]
    hub_angle = x[0]
    hub_rate = x[1]
    hub_acceleration = x[2]
    angle = ca.vertsplit(x[3:15])
    rate = ca.vertsplit(x[15:27])
    acceleration = ca.vertsplit(x[27:39])
    base_place_x = x[39]
    base_velocity_x = x[40]
    base_acceleration_x = x[41]
    base_place_y = x[42]
    base_velocity_y = x[43]
    base_acceleration_y = x[44]
    wheel = stages[0][0]
    thruster = stages[0][1]
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
    trial_acceleration_x = base_acceleration_x
    trial_acceleration_y = base_acceleration_y
    predicted_rate[0] = hub_rate + hub_acceleration * step
    predicted_angle[0] = hub_angle + half_step_squared * hub_acceleration + hub_rate * step
    for j in range(STATIONS):
        predicted_rate[j + 1] = rate[j] + acceleration[j] * step
        predicted_angle[j + 1] = angle[j] + acceleration[j] * half_step_squared + rate[j] * step

    # accelerations of the nodes
    for j in range(1):
        lever_cosine[j] = length[j] * ca.cos(predicted_angle[j + 1])
        lever_sine[j] = length[j] * ca.sin(predicted_angle[j + 1])
        square = predicted_rate[j + 1] * predicted_rate[j + 1]
        relative_x[j] = -acceleration[j] * lever_sine[j] - lever_cosine[j] * square
        relative_y[j] = acceleration[j] * lever_cosine[j] - lever_sine[j] * square
        turning = predicted_rate[j + 1] * step
        swing_x[j] = -lever_sine[j] - angle_per_acceleration * relative_y[j] - lever_cosine[j] * turning
        swing_y[j] = lever_cosine[j] + angle_per_acceleration * relative_x[j] - lever_sine[j] * turning
    for j in range(1, 6):
        lever_cosine[j] = length[j] * ca.cos(predicted_angle[j + 1])
        lever_sine[j] = length[j] * ca.sin(predicted_angle[j + 1])
        square = predicted_rate[j + 1] * predicted_rate[j + 1]
        relative_x[j] = -acceleration[j] * lever_sine[j] - lever_cosine[j] * square
        relative_y[j] = acceleration[j] * lever_cosine[j] - lever_sine[j] * square
        turning = predicted_rate[j + 1] * step
        swing_x[j] = -lever_sine[j] - angle_per_acceleration * relative_y[j] - lever_cosine[j] * turning
        swing_y[j] = lever_cosine[j] + angle_per_acceleration * relative_x[j] - lever_sine[j] * turning
    for j in range(6, 7):
        lever_cosine[j] = length[j] * ca.cos(predicted_angle[j + 1])
        lever_sine[j] = length[j] * ca.sin(predicted_angle[j + 1])
        square = predicted_rate[j + 1] * predicted_rate[j + 1]
        relative_x[j] = -acceleration[j] * lever_sine[j] - lever_cosine[j] * square
        relative_y[j] = acceleration[j] * lever_cosine[j] - lever_sine[j] * square
        turning = predicted_rate[j + 1] * step
        swing_x[j] = -lever_sine[j] - angle_per_acceleration * relative_y[j] - lever_cosine[j] * turning
        swing_y[j] = lever_cosine[j] + angle_per_acceleration * relative_x[j] - lever_sine[j] * turning
    for j in range(7, STATIONS):
        lever_cosine[j] = length[j] * ca.cos(predicted_angle[j + 1])
        lever_sine[j] = length[j] * ca.sin(predicted_angle[j + 1])
        square = predicted_rate[j + 1] * predicted_rate[j + 1]
        relative_x[j] = -acceleration[j] * lever_sine[j] - lever_cosine[j] * square
        relative_y[j] = acceleration[j] * lever_cosine[j] - lever_sine[j] * square
        turning = predicted_rate[j + 1] * step
        swing_x[j] = -lever_sine[j] - angle_per_acceleration * relative_y[j] - lever_cosine[j] * turning
        swing_y[j] = lever_cosine[j] + angle_per_acceleration * relative_x[j] - lever_sine[j] * turning
    node_x = trial_acceleration_x
    node_y = trial_acceleration_y
    acceleration_x[0] = node_x
    acceleration_y[0] = node_y
    for j in range(1):
        node_x = node_x + relative_x[j]
        node_y = node_y + relative_y[j]
        acceleration_x[j + 1] = node_x
        acceleration_y[j + 1] = node_y
    for j in range(1, 6):
        node_x = node_x + relative_x[j]
        node_y = node_y + relative_y[j]
        acceleration_x[j + 1] = node_x
        acceleration_y[j + 1] = node_y
    node_x = acceleration_x[0]
    node_y = acceleration_y[0]
    for j in range(6, 7):
        node_x = node_x + relative_x[j]
        node_y = node_y + relative_y[j]
        acceleration_x[j + 1] = node_x
        acceleration_y[j + 1] = node_y
    for j in range(7, STATIONS):
        node_x = node_x + relative_x[j]
        node_y = node_y + relative_y[j]
        acceleration_x[j + 1] = node_x
        acceleration_y[j + 1] = node_y

    # forces of the joints at the motion so far
    for j in range(1):
        joint_torque[j] = (
            damping[j] * (predicted_rate[j] - predicted_rate[j + 1])
            + rest[j] * stiffness[j]
            + stiffness[j] * (predicted_angle[j] - predicted_angle[j + 1])
        )
    for j in range(1, 6):
        joint_torque[j] = damping[j] * (predicted_rate[j] - predicted_rate[j + 1]) + stiffness[j] * (
            predicted_angle[j] - predicted_angle[j + 1]
        )
    for j in range(6, 7):
        joint_torque[j] = damping[j] * (predicted_rate[0] - predicted_rate[j + 1]) + stiffness[j] * (
            predicted_angle[0] - predicted_angle[j + 1]
        )
    for j in range(7, STATIONS):
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
    impedance_uu: Any = 0.0
    force_x: Any = 0.0
    force_y: Any = 0.0
    torque: Any = 0.0
    for j in reversed(range(7, STATIONS)):
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
    for j in reversed(range(6, 7)):
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
    impedance_xx_of_branch_7 = impedance_xx
    impedance_xy_of_branch_7 = impedance_xy
    impedance_xu_of_branch_7 = impedance_xu
    impedance_yx_of_branch_7 = impedance_yx
    impedance_yy_of_branch_7 = impedance_yy
    impedance_yu_of_branch_7 = impedance_yu
    impedance_ux_of_branch_7 = impedance_ux
    impedance_uy_of_branch_7 = impedance_uy
    impedance_uu_of_branch_7 = impedance_uu
    force_x_of_branch_7 = force_x
    force_y_of_branch_7 = force_y
    torque_of_branch_7 = torque
    impedance_xx = 0.0
    impedance_xy = 0.0
    impedance_xu = 0.0
    impedance_yx = 0.0
    impedance_yy = 0.0
    impedance_yu = 0.0
    impedance_ux = 0.0
    impedance_uy = 0.0
    impedance_uu = 0.0
    force_x = 0.0
    force_y = 0.0
    torque = 0.0
    for j in reversed(range(1, 6)):
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
    for j in reversed(range(1)):
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
    impedance_xx = impedance_xx + impedance_xx_of_branch_7
    impedance_xy = impedance_xy + impedance_xy_of_branch_7
    impedance_xu = impedance_xu + impedance_xu_of_branch_7
    impedance_yx = impedance_yx + impedance_yx_of_branch_7
    impedance_yy = impedance_yy + impedance_yy_of_branch_7
    impedance_yu = impedance_yu + impedance_yu_of_branch_7
    impedance_ux = impedance_ux + impedance_ux_of_branch_7
    impedance_uy = impedance_uy + impedance_uy_of_branch_7
    impedance_uu = impedance_uu + impedance_uu_of_branch_7
    force_x = force_x + force_x_of_branch_7
    force_y = force_y + force_y_of_branch_7
    torque = torque + torque_of_branch_7

    # the base
    whole_impedance_xx = base_mass + impedance_xx
    whole_impedance_yy = base_mass + impedance_yy
    whole_impedance_uu = hub_inertia + impedance_uu
    share_yx = impedance_yx / whole_impedance_xx
    impedance_yy_freed_x = whole_impedance_yy - impedance_xy * share_yx
    impedance_yu_freed_x = impedance_yu - impedance_xu * share_yx
    share_ux = impedance_ux / whole_impedance_xx
    impedance_uy_freed_x = impedance_uy - impedance_xy * share_ux
    impedance_uu_freed_x = whole_impedance_uu - impedance_xu * share_ux
    share_uy = impedance_uy_freed_x / impedance_yy_freed_x
    impedance_uu_freed_y = impedance_uu_freed_x - impedance_yu_freed_x * share_uy
    whole_force_x = force_x + acceleration_x[0] * base_mass
    whole_force_y = force_y - thruster + acceleration_y[0] * base_mass
    whole_torque = torque - wheel + hub_acceleration * hub_inertia
    force_y_freed_x = whole_force_y - share_yx * whole_force_x
    torque_freed_x = whole_torque - share_ux * whole_force_x
    torque_freed_y = torque_freed_x - force_y_freed_x * share_uy
    unknown = -torque_freed_y / impedance_uu_freed_y
    change_y = (-force_y_freed_x - impedance_yu_freed_x * unknown) / impedance_yy_freed_x
    change_x = (-whole_force_x - change_y * impedance_xy - impedance_xu * unknown) / whole_impedance_xx
    base_change_x = change_x
    base_change_y = change_y
    hub_unknown = unknown

    # sweep outward: the unknown of each station
    change_x = base_change_x
    change_y = base_change_y
    for j in range(1):
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y + transmission[j] * unknown
        change_x = change_x + swing_x[j] * unknown
        change_y = change_y + swing_y[j] * unknown
        solved[j] = unknown
    for j in range(1, 6):
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y + transmission[j] * unknown
        change_x = change_x + swing_x[j] * unknown
        change_y = change_y + swing_y[j] * unknown
        solved[j] = unknown
    change_x = base_change_x
    change_y = base_change_y
    unknown = hub_unknown
    for j in range(6, 7):
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y + transmission[j] * unknown
        change_x = change_x + swing_x[j] * unknown
        change_y = change_y + swing_y[j] * unknown
        solved[j] = unknown
    for j in range(7, STATIONS):
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y + transmission[j] * unknown
        change_x = change_x + swing_x[j] * unknown
        change_y = change_y + swing_y[j] * unknown
        solved[j] = unknown

    # motion at the end of the step
    trial_acceleration_x = base_change_x + trial_acceleration_x
    trial_acceleration_y = base_change_y + trial_acceleration_y
    hub_angle = predicted_angle[0] + angle_per_acceleration * hub_unknown
    hub_rate = predicted_rate[0] + hub_unknown * rate_per_acceleration
    hub_acceleration = hub_acceleration + hub_unknown
    base_place_x = (
        base_place_x
        + angle_per_acceleration * (base_acceleration_x + trial_acceleration_x)
        + base_velocity_x * step
    )
    base_velocity_x = base_velocity_x + rate_per_acceleration * (base_acceleration_x + trial_acceleration_x)
    base_acceleration_x = trial_acceleration_x
    base_place_y = (
        base_place_y
        + angle_per_acceleration * (base_acceleration_y + trial_acceleration_y)
        + base_velocity_y * step
    )
    base_velocity_y = base_velocity_y + rate_per_acceleration * (base_acceleration_y + trial_acceleration_y)
    base_acceleration_y = trial_acceleration_y
    for j in range(STATIONS):
        angle[j] = predicted_angle[j + 1] + angle_per_acceleration * solved[j]
        rate[j] = predicted_rate[j + 1] + rate_per_acceleration * solved[j]
        acceleration[j] = acceleration[j] + solved[j]
    return _column(
        hub_angle,
        hub_rate,
        hub_acceleration,
        *angle,
        *rate,
        *acceleration,
        base_place_x,
        base_velocity_x,
        base_acceleration_x,
        base_place_y,
        base_velocity_y,
        base_acceleration_y,
    )


def _output(model: dict[str, Any], x: ca.SX, stages: Sequence[ca.SX]) -> ca.SX:
    """Read the outputs off a state."""
    length = model["length"]
    stiffness = model["stiffness"]
    damping = model["damping"]
    hub_angle = x[0]
    hub_rate = x[1]
    angle = ca.vertsplit(x[3:15])
    rate = ca.vertsplit(x[15:27])
    base_place_x = x[39]
    base_place_y = x[42]

    # output attitude: angle
    attitude = hub_angle

    # output hub: position
    hub_x = base_place_x
    hub_y = base_place_y

    # output right_end: position
    right_end_x = base_place_x
    right_end_y = base_place_y
    for j in range(6, 7):
        right_end_x = right_end_x + length[j] * ca.cos(angle[j])
        right_end_y = right_end_y + length[j] * ca.sin(angle[j])
    for j in range(7, STATIONS):
        right_end_x = right_end_x + length[j] * ca.cos(angle[j])
        right_end_y = right_end_y + length[j] * ca.sin(angle[j])

    # output latch_torque: joint torque
    latch_torque = damping[6] * (hub_rate - rate[6]) + stiffness[6] * (hub_angle - angle[6])
    return _column(attitude, hub_x, hub_y, right_end_x, right_end_y, latch_torque)

# elbow: Flexible arm with motors at shoulder and elbow
#
# Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
# scene digest: b7474d2f501b0139799e3f1e1a14aa2a3a455ea0221cabb6918551519b3600d0
# sha256 of the rest of this file: 0d2d8505bb01fa8131b7ae2d2d6c34b3a279ac767af0db0982c234d5b77fcbe8
#
# model: planar arm, large rotations, gravity, tip mass
# stations: 12
# base: clamp
# integrator: Newmark 1959, beta = 0.25, gamma = 0.5
# linearisation: newton
# sweep: riccati
# unknown: acceleration
# joints in arrays, from 0: shoulder 0, elbow 6
# links in arrays, from 0: upper 0 to 5, forearm 6 to 11
# operations of a step: 1385, 115.4 per station (638 additions, 711 multiplications, 12 divisions, 24 sines
#     and cosines)
# operations of prepare: 213, 17.75 per station (59 additions, 154 multiplications)
"""elbow: Flexible arm with motors at shoulder and elbow. Functions for optimisation and control.

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
    *_numbered("angle", 12),
    *_numbered("rate", 12),
    *_numbered("acceleration", 12),
)
INPUT_NAMES: tuple[str, ...] = ("shoulder_torque", "elbow_torque")
OUTPUT_NAMES: tuple[str, ...] = ("payload_x", "payload_y", "shoulder", "elbow")
PARAMETER_NAMES: tuple[str, ...] = (
    "step",
    *_numbered("length", 12),
    *_numbered("mass", 12),
    *_numbered("inertia", 12),
    *_numbered("center", 12),
    *_numbered("stiffness", 12),
    *_numbered("damping", 12),
    *_numbered("rotor_inertia", 12),
    *_numbered("gear", 12),
    "gravity",
    "tip_mass",
    "tip_inertia",
)
STAGE_INSTANTS = ((1.0,),)
"""When inputs are read, in steps from the start of the step."""


def default_parameters() -> ca.DM:
    """Return the scene's step and physical parameters, a column ``p``."""
    values = (
        0.001,
        0.05,
        0.1,
        0.1,
        0.1,
        0.1,
        0.05,
        0.04,
        0.08,
        0.08,
        0.08,
        0.08,
        0.04,
        0.0162,
        0.0324,
        0.0324,
        0.0324,
        0.0324,
        0.2662,
        0.00648,
        0.01296,
        0.01296,
        0.01296,
        0.01296,
        0.00648,
        3.375e-06,
        2.7e-05,
        2.7e-05,
        2.7e-05,
        2.7e-05,
        0.0001128838279489106,
        8.64e-07,
        6.912e-06,
        6.912e-06,
        6.912e-06,
        6.912e-06,
        8.64e-07,
        0.5,
        0.5,
        0.5,
        0.5,
        0.5,
        0.9695717505634861,
        0.5,
        0.5,
        0.5,
        0.5,
        0.5,
        0.5,
        0.0,
        112.0,
        112.0,
        112.0,
        112.0,
        112.0,
        0.0,
        39.375,
        39.375,
        39.375,
        39.375,
        39.375,
        0.5,
        0.224,
        0.224,
        0.224,
        0.224,
        0.224,
        0.1,
        0.07875,
        0.07875,
        0.07875,
        0.07875,
        0.07875,
        2e-05,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
        1e-05,
        0.0,
        0.0,
        0.0,
        0.0,
        0.0,
        100.0,
        1.0,
        1.0,
        1.0,
        1.0,
        1.0,
        50.0,
        1.0,
        1.0,
        1.0,
        1.0,
        1.0,
        9.81,
        0.3,
        0.0002,
    )
    return ca.DM(values)


def step_function() -> ca.Function:
    """Return the step ``(x, u, p) -> (x_next, y)``: the state one step later, and the outputs at ``x``."""
    return _function("elbow_step", _step, STAGE_INSTANTS[-1])


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
    return ca.Function("elbow_initial", [*given.values(), u, p], [x], [*given, "u", "p"], ["x"])


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
    center = ca.vertsplit(p[37:49])
    stiffness = ca.vertsplit(p[49:61])
    damping = ca.vertsplit(p[61:73])
    rotor_inertia = ca.vertsplit(p[73:85])
    gear = ca.vertsplit(p[85:97])
    gravity = p[97]
    tip_mass = p[98]
    tip_inertia = p[99]
    armature: list[Any] = [0.0] * STATIONS
    joint_impedance: list[Any] = [0.0] * STATIONS
    node_mass: list[Any] = [0.0] * STATIONS
    rod_inertia: list[Any] = [0.0] * STATIONS

    # masses at the nodes between links, and what they leave over
    for j in range(11):
        node_mass[j] = center[j] * mass[j] + mass[j + 1] * (1.0 - center[j + 1])
    node_mass[11] = tip_mass + center[11] * mass[11]
    for j in range(STATIONS):
        rod_inertia[j] = inertia[j] - center[j] * (length[j] * length[j]) * mass[j] * (1.0 - center[j])
    for j in range(STATIONS):
        armature[j] = gear[j] * gear[j] * rotor_inertia[j]

    # factors of the sweep that do not change from step to step
    for j in reversed(range(7, STATIONS)):
        joint_impedance[j] = 0.5 * damping[j] * step + 0.25 * (step * step) * stiffness[j]
    for j in reversed(range(6, 7)):
        joint_impedance[j] = armature[j] + 0.5 * damping[j] * step
    for j in reversed(range(1, 6)):
        joint_impedance[j] = 0.5 * damping[j] * step + 0.25 * (step * step) * stiffness[j]
    for j in reversed(range(1)):
        joint_impedance[j] = armature[j] + 0.5 * damping[j] * step

    # Factors of the step that depend on the time step and parameters alone
    half_step_squared = 0.5 * (step * step)
    angle_per_acceleration = 0.25 * (step * step)
    rate_per_acceleration = 0.5 * step
    return {
        "step": step,
        "length": length,
        "stiffness": stiffness,
        "damping": damping,
        "gear": gear,
        "gravity": gravity,
        "tip_inertia": tip_inertia,
        "half_step_squared": half_step_squared,
        "angle_per_acceleration": angle_per_acceleration,
        "rate_per_acceleration": rate_per_acceleration,
        "node_mass": node_mass,
        "rod_inertia": rod_inertia,
        "armature": armature,
        "joint_impedance": joint_impedance,
    }


def _initialise(given: dict[str, ca.SX], stages: Sequence[ca.SX], p: ca.SX) -> ca.SX:
    """Start from given angles and rates with the acceleration that satisfies the equations of motion."""
    length = ca.vertsplit(p[1:13])
    mass = ca.vertsplit(p[13:25])
    inertia = ca.vertsplit(p[25:37])
    center = ca.vertsplit(p[37:49])
    stiffness = ca.vertsplit(p[49:61])
    damping = ca.vertsplit(p[61:73])
    rotor_inertia = ca.vertsplit(p[73:85])
    gear = ca.vertsplit(p[85:97])
    gravity = p[97]
    tip_mass = p[98]
    tip_inertia = p[99]
    initial_angle = ca.vertsplit(given["initial_angle"])
    initial_rate = ca.vertsplit(given["initial_rate"])
    shoulder_torque = stages[0][0]
    elbow_torque = stages[0][1]
    acceleration: list[Any] = [0.0] * STATIONS
    acceleration_x: list[Any] = [0.0] * (STATIONS + 1)
    acceleration_y: list[Any] = [0.0] * (STATIONS + 1)
    angle: list[Any] = [0.0] * STATIONS
    answer_own: list[Any] = [0.0] * STATIONS
    answer_x: list[Any] = [0.0] * STATIONS
    answer_y: list[Any] = [0.0] * STATIONS
    drive: list[Any] = [0.0] * STATIONS
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
    start_armature: list[Any] = [0.0] * STATIONS
    start_node_mass: list[Any] = [0.0] * STATIONS
    start_rod_inertia: list[Any] = [0.0] * STATIONS
    transmission: list[Any] = [0.0] * STATIONS

    # masses at the nodes between links, and what they leave over
    for j in range(11):
        start_node_mass[j] = center[j] * mass[j] + mass[j + 1] * (1.0 - center[j + 1])
    start_node_mass[11] = tip_mass + center[11] * mass[11]
    for j in range(STATIONS):
        start_rod_inertia[j] = inertia[j] - center[j] * (length[j] * length[j]) * mass[j] * (1.0 - center[j])
    for j in range(STATIONS):
        start_armature[j] = gear[j] * gear[j] * rotor_inertia[j]

    # predicted motion
    predicted_rate[0] = 0.0
    predicted_angle[0] = 0.0
    predicted_acceleration[0] = 0.0
    for j in range(STATIONS):
        predicted_rate[j + 1] = initial_rate[j]
        predicted_angle[j + 1] = initial_angle[j]
        predicted_acceleration[j + 1] = 0.0

    # accelerations of the nodes, seen from a falling frame: gravity is the base's own
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
    node_x: Any = 0.0
    node_y = gravity
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
    for j in range(STATIONS):
        drive[j] = 0.0
    drive[0] = shoulder_torque
    drive[6] = elbow_torque
    for j in range(1):
        joint_torque[j] = (
            damping[j] * (predicted_rate[j] - predicted_rate[j + 1])
            + drive[j] * gear[j]
            + start_armature[j] * (predicted_acceleration[j] - predicted_acceleration[j + 1])
        )
    for j in range(1, 6):
        joint_torque[j] = damping[j] * (predicted_rate[j] - predicted_rate[j + 1]) + stiffness[j] * (
            predicted_angle[j] - predicted_angle[j + 1]
        )
    for j in range(6, 7):
        joint_torque[j] = (
            damping[j] * (predicted_rate[j] - predicted_rate[j + 1])
            + drive[j] * gear[j]
            + start_armature[j] * (predicted_acceleration[j] - predicted_acceleration[j + 1])
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
    impedance_uu = tip_inertia
    force_x: Any = 0.0
    force_y: Any = 0.0
    torque = predicted_acceleration[12] * tip_inertia
    for j in reversed(range(7, STATIONS)):
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
        start_joint_impedance = start_armature[j]
        pivot = impedance_uu + start_joint_impedance
        admittance = 1.0 / pivot
        answer_own[j] = admittance * (joint_torque[j] - torque)
        answer_x[j] = admittance * impedance_ux
        answer_y[j] = admittance * impedance_uy
        transmission[j] = admittance * start_joint_impedance
        impedance_xx = impedance_xx - answer_x[j] * impedance_xu
        impedance_xy = impedance_xy - answer_y[j] * impedance_xu
        force_x = force_x + answer_own[j] * impedance_xu
        impedance_xu = impedance_xu * transmission[j]
        impedance_yx = impedance_yx - answer_x[j] * impedance_yu
        impedance_yy = impedance_yy - answer_y[j] * impedance_yu
        force_y = force_y + answer_own[j] * impedance_yu
        impedance_yu = impedance_yu * transmission[j]
        impedance_ux = answer_x[j] * start_joint_impedance
        impedance_uy = answer_y[j] * start_joint_impedance
        impedance_uu = impedance_uu * transmission[j]
        torque = joint_torque[j] - answer_own[j] * start_joint_impedance
    for j in reversed(range(1, 6)):
        impedance_xx = impedance_xx + start_node_mass[j]
        force_x = force_x + acceleration_x[j + 1] * start_node_mass[j]
        impedance_yy = impedance_yy + start_node_mass[j]
        force_y = force_y + acceleration_y[j + 1] * start_node_mass[j]
        impedance_xu = impedance_xu - impedance_xx * lever_sine[j] + impedance_xy * lever_cosine[j]
        impedance_yu = impedance_yu - impedance_yx * lever_sine[j] + impedance_yy * lever_cosine[j]
        impedance_uu = impedance_uu - impedance_ux * lever_sine[j] + impedance_uy * lever_cosine[j]
        impedance_ux = impedance_ux - impedance_xx * lever_sine[j] + impedance_yx * lever_cosine[j]
        impedance_uy = impedance_uy - impedance_xy * lever_sine[j] + impedance_yy * lever_cosine[j]
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
        impedance_ux = 0.0
        impedance_uy = 0.0
        impedance_xu = 0.0
        impedance_yu = 0.0
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
        start_joint_impedance = start_armature[j]
        pivot = impedance_uu + start_joint_impedance
        admittance = 1.0 / pivot
        answer_own[j] = admittance * (joint_torque[j] - torque)
        answer_x[j] = admittance * impedance_ux
        answer_y[j] = admittance * impedance_uy
        transmission[j] = admittance * start_joint_impedance
        impedance_xx = impedance_xx - answer_x[j] * impedance_xu
        impedance_xy = impedance_xy - answer_y[j] * impedance_xu
        force_x = force_x + answer_own[j] * impedance_xu
        impedance_yx = impedance_yx - answer_x[j] * impedance_yu
        impedance_yy = impedance_yy - answer_y[j] * impedance_yu
        force_y = force_y + answer_own[j] * impedance_yu
        torque = joint_torque[j] - answer_own[j] * start_joint_impedance

    # the base
    unknown: Any = 0.0

    # sweep outward: the unknown of each station
    change_x: Any = 0.0
    change_y: Any = 0.0
    for j in range(1):
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y + transmission[j] * unknown
        change_x = change_x - lever_sine[j] * unknown
        change_y = change_y + lever_cosine[j] * unknown
        solved[j] = unknown
    for j in range(1, 6):
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y
        change_x = change_x - lever_sine[j] * unknown
        change_y = change_y + lever_cosine[j] * unknown
        solved[j] = unknown
    for j in range(6, 7):
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y + transmission[j] * unknown
        change_x = change_x - lever_sine[j] * unknown
        change_y = change_y + lever_cosine[j] * unknown
        solved[j] = unknown
    for j in range(7, STATIONS):
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y
        change_x = change_x - lever_sine[j] * unknown
        change_y = change_y + lever_cosine[j] * unknown
        solved[j] = unknown

    # motion at the end of the step
    for j in range(STATIONS):
        angle[j] = predicted_angle[j + 1]
        rate[j] = predicted_rate[j + 1]
        acceleration[j] = predicted_acceleration[j + 1] + solved[j]
    return _column(*angle, *rate, *acceleration)


def _step(model: dict[str, Any], x: ca.SX, stages: Sequence[ca.SX]) -> ca.SX:
    """Advance the state by one step."""
    step = model["step"]
    length = model["length"]
    stiffness = model["stiffness"]
    damping = model["damping"]
    gear = model["gear"]
    gravity = model["gravity"]
    tip_inertia = model["tip_inertia"]
    half_step_squared = model["half_step_squared"]
    angle_per_acceleration = model["angle_per_acceleration"]
    rate_per_acceleration = model["rate_per_acceleration"]
    node_mass = model["node_mass"]
    rod_inertia = model["rod_inertia"]
    armature = model["armature"]
    joint_impedance = model["joint_impedance"]
    angle = ca.vertsplit(x[0:12])
    rate = ca.vertsplit(x[12:24])
    acceleration = ca.vertsplit(x[24:36])
    shoulder_torque = stages[0][0]
    elbow_torque = stages[0][1]
    acceleration_x: list[Any] = [0.0] * (STATIONS + 1)
    acceleration_y: list[Any] = [0.0] * (STATIONS + 1)
    answer_own: list[Any] = [0.0] * STATIONS
    answer_x: list[Any] = [0.0] * STATIONS
    answer_y: list[Any] = [0.0] * STATIONS
    drive: list[Any] = [0.0] * STATIONS
    joint_torque: list[Any] = [0.0] * STATIONS
    lever_cosine: list[Any] = [0.0] * STATIONS
    lever_sine: list[Any] = [0.0] * STATIONS
    predicted_acceleration: list[Any] = [0.0] * (STATIONS + 1)
    predicted_angle: list[Any] = [0.0] * (STATIONS + 1)
    predicted_rate: list[Any] = [0.0] * (STATIONS + 1)
    relative_x: list[Any] = [0.0] * STATIONS
    relative_y: list[Any] = [0.0] * STATIONS
    solved: list[Any] = [0.0] * STATIONS
    swing_x: list[Any] = [0.0] * STATIONS
    swing_y: list[Any] = [0.0] * STATIONS
    transmission: list[Any] = [0.0] * STATIONS

    # predicted motion
    predicted_rate[0] = 0.0
    predicted_angle[0] = 0.0
    predicted_acceleration[0] = 0.0
    for j in range(STATIONS):
        predicted_rate[j + 1] = rate[j] + acceleration[j] * step
        predicted_angle[j + 1] = angle[j] + acceleration[j] * half_step_squared + rate[j] * step
        predicted_acceleration[j + 1] = acceleration[j]

    # accelerations of the nodes, seen from a falling frame: gravity is the base's own
    for j in range(1):
        lever_cosine[j] = length[j] * ca.cos(predicted_angle[j + 1])
        lever_sine[j] = length[j] * ca.sin(predicted_angle[j + 1])
        square = predicted_rate[j + 1] * predicted_rate[j + 1]
        relative_x[j] = -lever_cosine[j] * square - lever_sine[j] * predicted_acceleration[j + 1]
        relative_y[j] = lever_cosine[j] * predicted_acceleration[j + 1] - lever_sine[j] * square
        turning = predicted_rate[j + 1] * step
        swing_x[j] = -lever_sine[j] - angle_per_acceleration * relative_y[j] - lever_cosine[j] * turning
        swing_y[j] = lever_cosine[j] + angle_per_acceleration * relative_x[j] - lever_sine[j] * turning
    for j in range(1, 6):
        lever_cosine[j] = length[j] * ca.cos(predicted_angle[j + 1])
        lever_sine[j] = length[j] * ca.sin(predicted_angle[j + 1])
        square = predicted_rate[j + 1] * predicted_rate[j + 1]
        relative_x[j] = -lever_cosine[j] * square - lever_sine[j] * predicted_acceleration[j + 1]
        relative_y[j] = lever_cosine[j] * predicted_acceleration[j + 1] - lever_sine[j] * square
        turning = predicted_rate[j + 1] * step
        swing_x[j] = -lever_sine[j] - angle_per_acceleration * relative_y[j] - lever_cosine[j] * turning
        swing_y[j] = lever_cosine[j] + angle_per_acceleration * relative_x[j] - lever_sine[j] * turning
    for j in range(6, 7):
        lever_cosine[j] = length[j] * ca.cos(predicted_angle[j + 1])
        lever_sine[j] = length[j] * ca.sin(predicted_angle[j + 1])
        square = predicted_rate[j + 1] * predicted_rate[j + 1]
        relative_x[j] = -lever_cosine[j] * square - lever_sine[j] * predicted_acceleration[j + 1]
        relative_y[j] = lever_cosine[j] * predicted_acceleration[j + 1] - lever_sine[j] * square
        turning = predicted_rate[j + 1] * step
        swing_x[j] = -lever_sine[j] - angle_per_acceleration * relative_y[j] - lever_cosine[j] * turning
        swing_y[j] = lever_cosine[j] + angle_per_acceleration * relative_x[j] - lever_sine[j] * turning
    for j in range(7, STATIONS):
        lever_cosine[j] = length[j] * ca.cos(predicted_angle[j + 1])
        lever_sine[j] = length[j] * ca.sin(predicted_angle[j + 1])
        square = predicted_rate[j + 1] * predicted_rate[j + 1]
        relative_x[j] = -lever_cosine[j] * square - lever_sine[j] * predicted_acceleration[j + 1]
        relative_y[j] = lever_cosine[j] * predicted_acceleration[j + 1] - lever_sine[j] * square
        turning = predicted_rate[j + 1] * step
        swing_x[j] = -lever_sine[j] - angle_per_acceleration * relative_y[j] - lever_cosine[j] * turning
        swing_y[j] = lever_cosine[j] + angle_per_acceleration * relative_x[j] - lever_sine[j] * turning
    node_x: Any = 0.0
    node_y = gravity
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
    for j in range(STATIONS):
        drive[j] = 0.0
    drive[0] = shoulder_torque
    drive[6] = elbow_torque
    for j in range(1):
        joint_torque[j] = (
            armature[j] * (predicted_acceleration[j] - predicted_acceleration[j + 1])
            + damping[j] * (predicted_rate[j] - predicted_rate[j + 1])
            + drive[j] * gear[j]
        )
    for j in range(1, 6):
        joint_torque[j] = damping[j] * (predicted_rate[j] - predicted_rate[j + 1]) + stiffness[j] * (
            predicted_angle[j] - predicted_angle[j + 1]
        )
    for j in range(6, 7):
        joint_torque[j] = (
            armature[j] * (predicted_acceleration[j] - predicted_acceleration[j + 1])
            + damping[j] * (predicted_rate[j] - predicted_rate[j + 1])
            + drive[j] * gear[j]
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
    impedance_uu = tip_inertia
    force_x: Any = 0.0
    force_y: Any = 0.0
    torque = predicted_acceleration[12] * tip_inertia
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
            torque
            - force_x * lever_sine[j]
            + force_y * lever_cosine[j]
            + predicted_acceleration[j + 1] * rod_inertia[j]
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
            torque
            - force_x * lever_sine[j]
            + force_y * lever_cosine[j]
            + predicted_acceleration[j + 1] * rod_inertia[j]
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
            torque
            - force_x * lever_sine[j]
            + force_y * lever_cosine[j]
            + predicted_acceleration[j + 1] * rod_inertia[j]
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
            torque
            - force_x * lever_sine[j]
            + force_y * lever_cosine[j]
            + predicted_acceleration[j + 1] * rod_inertia[j]
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
    unknown: Any = 0.0

    # sweep outward: the unknown of each station
    change_x: Any = 0.0
    change_y: Any = 0.0
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
    for j in range(STATIONS):
        angle[j] = predicted_angle[j + 1] + angle_per_acceleration * solved[j]
        rate[j] = predicted_rate[j + 1] + rate_per_acceleration * solved[j]
        acceleration[j] = predicted_acceleration[j + 1] + solved[j]
    return _column(*angle, *rate, *acceleration)


def _output(model: dict[str, Any], x: ca.SX, stages: Sequence[ca.SX]) -> ca.SX:
    """Read the outputs off a state."""
    length = model["length"]
    angle = ca.vertsplit(x[0:12])

    # output payload: position
    payload_x: Any = 0.0
    payload_y: Any = 0.0
    for j in range(1):
        payload_x = payload_x + length[j] * ca.cos(angle[j])
        payload_y = payload_y + length[j] * ca.sin(angle[j])
    for j in range(1, 6):
        payload_x = payload_x + length[j] * ca.cos(angle[j])
        payload_y = payload_y + length[j] * ca.sin(angle[j])
    for j in range(6, 7):
        payload_x = payload_x + length[j] * ca.cos(angle[j])
        payload_y = payload_y + length[j] * ca.sin(angle[j])
    for j in range(7, STATIONS):
        payload_x = payload_x + length[j] * ca.cos(angle[j])
        payload_y = payload_y + length[j] * ca.sin(angle[j])

    # output shoulder: joint angle
    shoulder = angle[0]

    # output elbow: joint angle
    elbow = angle[6] - angle[5]
    return _column(payload_x, payload_y, shoulder, elbow)

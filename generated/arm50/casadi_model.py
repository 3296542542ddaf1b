# arm50: Stiff arm of fifty links on a servo
#
# Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
# scene digest: 7e2e87b8a48332cf3886a22711bd9428eeea692a0d70cc5ae1662962d37ffc57
# sha256 of the rest of this file: 707bf28798477d6de3fae185b9f6b4110cac05510765f26a98d7d317c08813f2
#
# model: planar arm, large rotations, tip mass
# stations: 50
# base: prescribed
# integrator: SDIRK, order 4, 5 stages (Hairer & Wanner 1996)
# linearisation: newton
# sweep: riccati
# unknown: acceleration
# operations of a step: 29465, 589.3 per station (13600 additions, 15115 multiplications, 250 divisions, 500
#     sines and cosines)
# operations of prepare: 329, 6.58 per station (55 additions, 274 multiplications)
"""arm50: Stiff arm of fifty links on a servo. Functions for optimisation and control.

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


STATIONS = 50
"""Number of links."""
STATE_NAMES: tuple[str, ...] = (
    "hub_angle",
    "hub_rate",
    *_numbered("angle", 50),
    *_numbered("rate", 50),
    *_numbered("acceleration", 50),
)
INPUT_NAMES: tuple[str, ...] = ("base_angle", "base_angle_rate", "base_angle_acceleration")
OUTPUT_NAMES: tuple[str, ...] = ("tip_x", "tip_y", "tip_angle", "reaction_x", "reaction_y", "drive")
PARAMETER_NAMES: tuple[str, ...] = (
    "step",
    "length",
    "mass",
    "inertia",
    "center",
    *_numbered("stiffness", 50),
    *_numbered("damping", 50),
    "tip_mass",
    "tip_inertia",
)
STAGE_INSTANTS = ((0.25, 0.75, 0.55, 0.5, 1.0),)
"""When inputs are read, in steps from the start of the step."""


def default_parameters() -> ca.DM:
    """Return the scene's step and physical parameters, a column ``p``."""
    values = (
        0.002,
        0.016,
        0.0304,
        6.485333333333333e-07,
        0.5,
        31250.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        15625.0,
        3.125,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        1.5625,
        0.5,
        0.0004,
    )
    return ca.DM(values)


def step_function(held: bool = True) -> ca.Function:
    """Return the step ``(x, u, p) -> (x_next, y)``: the state one step later, and the outputs at ``x``.

    Parameters
    ----------
    held : bool
        ``u`` is one column, held over the step. Otherwise it has one column for each stage, read at its
        instant in STAGE_INSTANTS.
    """
    return _function("arm50_step", _step, STAGE_INSTANTS[-1], held)


def start_functions(held: bool = True) -> tuple[ca.Function, ...]:
    """Return the functions of the first steps, to be used before that of :func:`step_function`, each once.

    This integrator needs none.
    """
    return ()


def initial_function() -> ca.Function:
    """Return the start ``(initial_angle, initial_rate, u, p) -> x``.

    Start from given angles and rates with the acceleration that satisfies the equations of motion.
    """
    given = {
        "initial_angle": ca.SX.sym("initial_angle", 50),  # angles to start from (rad)
        "initial_rate": ca.SX.sym("initial_rate", 50),  # rates to start from (rad/s)
    }
    u, p = _symbols(INPUT_NAMES), _symbols(PARAMETER_NAMES)
    with _as_written():
        x = _initialise(given, [u], p)
    return ca.Function("arm50_initial", [*given.values(), u, p], [x], [*given, "u", "p"], ["x"])


def _function(
    name: str,
    advance: Callable[[dict[str, Any], ca.SX, Sequence[ca.SX]], ca.SX],
    instants: Sequence[float],
    held: bool,
) -> ca.Function:
    """Build a step with its outputs."""
    x, p = _symbols(STATE_NAMES), _symbols(PARAMETER_NAMES)
    u = _symbols(INPUT_NAMES) if held else ca.SX.sym("u", len(INPUT_NAMES), len(instants))
    stages = [u] * len(instants) if held else ca.horzsplit(u)
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
    stiffness = ca.vertsplit(p[5:55])
    damping = ca.vertsplit(p[55:105])
    tip_mass = p[105]
    tip_inertia = p[106]
    joint_impedance: list[Any] = [0.0] * STATIONS

    # masses at the nodes between links, and what they leave over
    end_mass = tip_mass - mass * (1.0 - center)
    rod_inertia = inertia - center * (length * length) * mass * (1.0 - center)

    # factors of the sweep that do not change from step to step
    for j in reversed(range(STATIONS)):
        joint_impedance[j] = 0.25 * damping[j] * step + 0.0625 * (step * step) * stiffness[j]

    # Factors of the step that depend on the time step and parameters alone
    rate_per_acceleration = 0.25 * step
    half_timestep = 0.5 * step
    angle_per_acceleration = 0.0625 * (step * step)
    three_quarters_timestep = 0.75 * step
    predicted_rate_per_stage1_acceleration = (17.0 / 50.0) * step
    predicted_rate_per_stage2_acceleration = (21.0 / 100.0) * step
    predicted_angle_per_stage2_rate = (1.0 / 25.0) * step
    predicted_rate_per_stage1_acceleration_2 = (371.0 / 1360.0) * step
    predicted_rate_per_stage2_acceleration_2 = (137.0 / 2720.0) * step
    predicted_rate_per_stage3_acceleration = (151.0 / 544.0) * step
    predicted_angle_per_stage3_rate = (15.0 / 544.0) * step
    predicted_rate_per_stage1_acceleration_3 = (25.0 / 24.0) * step
    predicted_rate_per_stage2_acceleration_3 = (49.0 / 48.0) * step
    predicted_rate_per_stage3_acceleration_2 = 7.8125 * step
    predicted_rate_per_stage4_acceleration = (41.0 / 6.0) * step
    predicted_angle_per_stage4_rate = (85.0 / 12.0) * step
    reaction_x_per_acceleration_x = center * mass
    reaction_x_per_acceleration_x_2 = mass * (center - 1.0)
    return {
        "length": length,
        "mass": mass,
        "stiffness": stiffness,
        "damping": damping,
        "tip_mass": tip_mass,
        "tip_inertia": tip_inertia,
        "rate_per_acceleration": rate_per_acceleration,
        "half_timestep": half_timestep,
        "angle_per_acceleration": angle_per_acceleration,
        "three_quarters_timestep": three_quarters_timestep,
        "predicted_rate_per_stage1_acceleration": predicted_rate_per_stage1_acceleration,
        "predicted_rate_per_stage2_acceleration": predicted_rate_per_stage2_acceleration,
        "predicted_angle_per_stage2_rate": predicted_angle_per_stage2_rate,
        "predicted_rate_per_stage1_acceleration_2": predicted_rate_per_stage1_acceleration_2,
        "predicted_rate_per_stage2_acceleration_2": predicted_rate_per_stage2_acceleration_2,
        "predicted_rate_per_stage3_acceleration": predicted_rate_per_stage3_acceleration,
        "predicted_angle_per_stage3_rate": predicted_angle_per_stage3_rate,
        "predicted_rate_per_stage1_acceleration_3": predicted_rate_per_stage1_acceleration_3,
        "predicted_rate_per_stage2_acceleration_3": predicted_rate_per_stage2_acceleration_3,
        "predicted_rate_per_stage3_acceleration_2": predicted_rate_per_stage3_acceleration_2,
        "predicted_rate_per_stage4_acceleration": predicted_rate_per_stage4_acceleration,
        "predicted_angle_per_stage4_rate": predicted_angle_per_stage4_rate,
        "reaction_x_per_acceleration_x": reaction_x_per_acceleration_x,
        "reaction_x_per_acceleration_x_2": reaction_x_per_acceleration_x_2,
        "end_mass": end_mass,
        "rod_inertia": rod_inertia,
        "joint_impedance": joint_impedance,
    }


def _initialise(given: dict[str, ca.SX], stages: Sequence[ca.SX], p: ca.SX) -> ca.SX:
    """Start from given angles and rates with the acceleration that satisfies the equations of motion."""
    length = p[1]
    mass = p[2]
    inertia = p[3]
    center = p[4]
    stiffness = ca.vertsplit(p[5:55])
    damping = ca.vertsplit(p[55:105])
    tip_mass = p[105]
    tip_inertia = p[106]
    initial_angle = ca.vertsplit(given["initial_angle"])
    initial_rate = ca.vertsplit(given["initial_rate"])
    base_angle = [u[0] for u in stages]
    base_angle_rate = [u[1] for u in stages]
    base_angle_acceleration = [u[2] for u in stages]
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

    # predicted motion
    predicted_rate[0] = base_angle_rate[0]
    predicted_angle[0] = base_angle[0]
    predicted_acceleration[0] = base_angle_acceleration[0]
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
    impedance_uu = tip_inertia
    force_x = acceleration_x[50] * start_end_mass
    force_y = acceleration_y[50] * start_end_mass
    torque = predicted_acceleration[50] * tip_inertia
    for j in reversed(range(STATIONS)):
        impedance_xx = impedance_xx + mass
        force_x = force_x + acceleration_x[j + 1] * mass
        impedance_yy = impedance_yy + mass
        force_y = force_y + acceleration_y[j + 1] * mass
        impedance_xu = impedance_xy * lever_cosine[j] - impedance_xx * lever_sine[j]
        impedance_yu = impedance_yy * lever_cosine[j] - impedance_yx * lever_sine[j]
        impedance_ux = impedance_yx * lever_cosine[j] - impedance_xx * lever_sine[j]
        impedance_uy = impedance_yy * lever_cosine[j] - impedance_xy * lever_sine[j]
        impedance_uu = (
            impedance_uu + start_rod_inertia - impedance_xu * lever_sine[j] + impedance_yu * lever_cosine[j]
        )
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
        impedance_uu = 0.0

    # the base
    unknown: Any = 0.0

    # sweep outward: the unknown of each station
    change_x: Any = 0.0
    change_y: Any = 0.0
    for j in range(STATIONS):
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y
        change_x = change_x - lever_sine[j] * unknown
        change_y = change_y + lever_cosine[j] * unknown
        solved[j] = unknown

    # motion at the end of the step
    hub_angle = base_angle[0]
    hub_rate = base_angle_rate[0]
    for j in range(STATIONS):
        angle[j] = predicted_angle[j + 1]
        rate[j] = predicted_rate[j + 1]
        acceleration[j] = predicted_acceleration[j + 1] + solved[j]
    return _column(hub_angle, hub_rate, *angle, *rate, *acceleration)


def _step(model: dict[str, Any], x: ca.SX, stages: Sequence[ca.SX]) -> ca.SX:
    """Advance the state by one step."""
    length = model["length"]
    mass = model["mass"]
    stiffness = model["stiffness"]
    damping = model["damping"]
    tip_inertia = model["tip_inertia"]
    rate_per_acceleration = model["rate_per_acceleration"]
    half_timestep = model["half_timestep"]
    angle_per_acceleration = model["angle_per_acceleration"]
    three_quarters_timestep = model["three_quarters_timestep"]
    predicted_rate_per_stage1_acceleration = model["predicted_rate_per_stage1_acceleration"]
    predicted_rate_per_stage2_acceleration = model["predicted_rate_per_stage2_acceleration"]
    predicted_angle_per_stage2_rate = model["predicted_angle_per_stage2_rate"]
    predicted_rate_per_stage1_acceleration_2 = model["predicted_rate_per_stage1_acceleration_2"]
    predicted_rate_per_stage2_acceleration_2 = model["predicted_rate_per_stage2_acceleration_2"]
    predicted_rate_per_stage3_acceleration = model["predicted_rate_per_stage3_acceleration"]
    predicted_angle_per_stage3_rate = model["predicted_angle_per_stage3_rate"]
    predicted_rate_per_stage1_acceleration_3 = model["predicted_rate_per_stage1_acceleration_3"]
    predicted_rate_per_stage2_acceleration_3 = model["predicted_rate_per_stage2_acceleration_3"]
    predicted_rate_per_stage3_acceleration_2 = model["predicted_rate_per_stage3_acceleration_2"]
    predicted_rate_per_stage4_acceleration = model["predicted_rate_per_stage4_acceleration"]
    predicted_angle_per_stage4_rate = model["predicted_angle_per_stage4_rate"]
    end_mass = model["end_mass"]
    rod_inertia = model["rod_inertia"]
    joint_impedance = model["joint_impedance"]
    hub_angle = x[0]
    hub_rate = x[1]
    angle = ca.vertsplit(x[2:52])
    rate = ca.vertsplit(x[52:102])
    acceleration = ca.vertsplit(x[102:152])
    base_angle = [u[0] for u in stages]
    base_angle_rate = [u[1] for u in stages]
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
    stage1_acceleration: list[Any] = [0.0] * STATIONS
    stage1_rate: list[Any] = [0.0] * STATIONS
    stage2_acceleration: list[Any] = [0.0] * STATIONS
    stage2_rate: list[Any] = [0.0] * STATIONS
    stage3_acceleration: list[Any] = [0.0] * STATIONS
    stage3_rate: list[Any] = [0.0] * STATIONS
    stage4_acceleration: list[Any] = [0.0] * STATIONS
    stage4_rate: list[Any] = [0.0] * STATIONS
    swing_x: list[Any] = [0.0] * STATIONS
    swing_y: list[Any] = [0.0] * STATIONS
    transmission: list[Any] = [0.0] * STATIONS

    # Stage 1 of 5: predicted motion
    predicted_rate[0] = base_angle_rate[0]
    predicted_angle[0] = base_angle[0]
    for j in range(STATIONS):
        predicted_rate[j + 1] = rate[j] + acceleration[j] * rate_per_acceleration
        predicted_angle[j + 1] = angle[j] + predicted_rate[j + 1] * rate_per_acceleration

    # Stage 1 of 5: accelerations of the nodes
    for j in range(STATIONS):
        lever_cosine[j] = length * ca.cos(predicted_angle[j + 1])
        lever_sine[j] = length * ca.sin(predicted_angle[j + 1])
        square = predicted_rate[j + 1] * predicted_rate[j + 1]
        relative_x[j] = -acceleration[j] * lever_sine[j] - lever_cosine[j] * square
        relative_y[j] = acceleration[j] * lever_cosine[j] - lever_sine[j] * square
        turning = half_timestep * predicted_rate[j + 1]
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

    # Stage 1 of 5: forces of the joints at the motion so far
    for j in range(STATIONS):
        joint_torque[j] = damping[j] * (predicted_rate[j] - predicted_rate[j + 1]) + stiffness[j] * (
            predicted_angle[j] - predicted_angle[j + 1]
        )

    # Stage 1 of 5: sweep inward: force beyond each joint as an affine function of the motion at it
    impedance_xx = end_mass
    impedance_xy: Any = 0.0
    impedance_xu: Any = 0.0
    impedance_yx: Any = 0.0
    impedance_yy = end_mass
    impedance_yu: Any = 0.0
    impedance_ux: Any = 0.0
    impedance_uy: Any = 0.0
    impedance_uu = tip_inertia
    force_x = acceleration_x[50] * end_mass
    force_y = acceleration_y[50] * end_mass
    torque = acceleration[49] * tip_inertia
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

    # Stage 1 of 5: the base
    unknown: Any = 0.0

    # Stage 1 of 5: sweep outward: the unknown of each station
    change_x: Any = 0.0
    change_y: Any = 0.0
    for j in range(STATIONS):
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y + transmission[j] * unknown
        change_x = change_x + swing_x[j] * unknown
        change_y = change_y + swing_y[j] * unknown
        solved[j] = unknown

    # Stage 1 of 5: motion at this stage
    for j in range(STATIONS):
        stage1_acceleration[j] = acceleration[j] + solved[j]
        stage1_rate[j] = predicted_rate[j + 1] + rate_per_acceleration * solved[j]

    # Stage 2 of 5: predicted motion
    predicted_rate[0] = base_angle_rate[1]
    predicted_angle[0] = base_angle[1]
    for j in range(STATIONS):
        predicted_rate[j + 1] = rate[j] + stage1_acceleration[j] * three_quarters_timestep
        predicted_angle[j + 1] = (
            angle[j] + half_timestep * stage1_rate[j] + predicted_rate[j + 1] * rate_per_acceleration
        )

    # Stage 2 of 5: accelerations of the nodes
    for j in range(STATIONS):
        lever_cosine[j] = length * ca.cos(predicted_angle[j + 1])
        lever_sine[j] = length * ca.sin(predicted_angle[j + 1])
        square = predicted_rate[j + 1] * predicted_rate[j + 1]
        relative_x[j] = -lever_cosine[j] * square - lever_sine[j] * stage1_acceleration[j]
        relative_y[j] = lever_cosine[j] * stage1_acceleration[j] - lever_sine[j] * square
        turning = half_timestep * predicted_rate[j + 1]
        swing_x[j] = -lever_sine[j] - angle_per_acceleration * relative_y[j] - lever_cosine[j] * turning
        swing_y[j] = lever_cosine[j] + angle_per_acceleration * relative_x[j] - lever_sine[j] * turning
    node_x = 0.0
    node_y = 0.0
    acceleration_x[0] = node_x
    acceleration_y[0] = node_y
    for j in range(STATIONS):
        node_x = node_x + relative_x[j]
        node_y = node_y + relative_y[j]
        acceleration_x[j + 1] = node_x
        acceleration_y[j + 1] = node_y

    # Stage 2 of 5: forces of the joints at the motion so far
    for j in range(STATIONS):
        joint_torque[j] = damping[j] * (predicted_rate[j] - predicted_rate[j + 1]) + stiffness[j] * (
            predicted_angle[j] - predicted_angle[j + 1]
        )

    # Stage 2 of 5: sweep inward: force beyond each joint as an affine function of the motion at it
    impedance_xx = end_mass
    impedance_xy = 0.0
    impedance_xu = 0.0
    impedance_yx = 0.0
    impedance_yy = end_mass
    impedance_yu = 0.0
    impedance_ux = 0.0
    impedance_uy = 0.0
    impedance_uu = tip_inertia
    force_x = acceleration_x[50] * end_mass
    force_y = acceleration_y[50] * end_mass
    torque = stage1_acceleration[49] * tip_inertia
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
        torque = (
            torque
            - force_x * lever_sine[j]
            + force_y * lever_cosine[j]
            + rod_inertia * stage1_acceleration[j]
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

    # Stage 2 of 5: the base
    unknown = 0.0

    # Stage 2 of 5: sweep outward: the unknown of each station
    change_x = 0.0
    change_y = 0.0
    for j in range(STATIONS):
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y + transmission[j] * unknown
        change_x = change_x + swing_x[j] * unknown
        change_y = change_y + swing_y[j] * unknown
        solved[j] = unknown

    # Stage 2 of 5: motion at this stage
    for j in range(STATIONS):
        stage2_acceleration[j] = solved[j] + stage1_acceleration[j]
        stage2_rate[j] = predicted_rate[j + 1] + rate_per_acceleration * solved[j]

    # Stage 3 of 5: predicted motion
    predicted_rate[0] = base_angle_rate[2]
    predicted_angle[0] = base_angle[2]
    for j in range(STATIONS):
        predicted_rate[j + 1] = (
            rate[j]
            + predicted_rate_per_stage1_acceleration * stage1_acceleration[j]
            + predicted_rate_per_stage2_acceleration * stage2_acceleration[j]
        )
        predicted_angle[j + 1] = (
            angle[j]
            - predicted_angle_per_stage2_rate * stage2_rate[j]
            + predicted_rate[j + 1] * rate_per_acceleration
            + predicted_rate_per_stage1_acceleration * stage1_rate[j]
        )

    # Stage 3 of 5: accelerations of the nodes
    for j in range(STATIONS):
        lever_cosine[j] = length * ca.cos(predicted_angle[j + 1])
        lever_sine[j] = length * ca.sin(predicted_angle[j + 1])
        square = predicted_rate[j + 1] * predicted_rate[j + 1]
        relative_x[j] = -lever_cosine[j] * square - lever_sine[j] * stage2_acceleration[j]
        relative_y[j] = lever_cosine[j] * stage2_acceleration[j] - lever_sine[j] * square
        turning = half_timestep * predicted_rate[j + 1]
        swing_x[j] = -lever_sine[j] - angle_per_acceleration * relative_y[j] - lever_cosine[j] * turning
        swing_y[j] = lever_cosine[j] + angle_per_acceleration * relative_x[j] - lever_sine[j] * turning
    node_x = 0.0
    node_y = 0.0
    acceleration_x[0] = node_x
    acceleration_y[0] = node_y
    for j in range(STATIONS):
        node_x = node_x + relative_x[j]
        node_y = node_y + relative_y[j]
        acceleration_x[j + 1] = node_x
        acceleration_y[j + 1] = node_y

    # Stage 3 of 5: forces of the joints at the motion so far
    for j in range(STATIONS):
        joint_torque[j] = damping[j] * (predicted_rate[j] - predicted_rate[j + 1]) + stiffness[j] * (
            predicted_angle[j] - predicted_angle[j + 1]
        )

    # Stage 3 of 5: sweep inward: force beyond each joint as an affine function of the motion at it
    impedance_xx = end_mass
    impedance_xy = 0.0
    impedance_xu = 0.0
    impedance_yx = 0.0
    impedance_yy = end_mass
    impedance_yu = 0.0
    impedance_ux = 0.0
    impedance_uy = 0.0
    impedance_uu = tip_inertia
    force_x = acceleration_x[50] * end_mass
    force_y = acceleration_y[50] * end_mass
    torque = stage2_acceleration[49] * tip_inertia
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
        torque = (
            torque
            - force_x * lever_sine[j]
            + force_y * lever_cosine[j]
            + rod_inertia * stage2_acceleration[j]
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

    # Stage 3 of 5: the base
    unknown = 0.0

    # Stage 3 of 5: sweep outward: the unknown of each station
    change_x = 0.0
    change_y = 0.0
    for j in range(STATIONS):
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y + transmission[j] * unknown
        change_x = change_x + swing_x[j] * unknown
        change_y = change_y + swing_y[j] * unknown
        solved[j] = unknown

    # Stage 3 of 5: motion at this stage
    for j in range(STATIONS):
        stage3_acceleration[j] = solved[j] + stage2_acceleration[j]
        stage3_rate[j] = predicted_rate[j + 1] + rate_per_acceleration * solved[j]

    # Stage 4 of 5: predicted motion
    predicted_rate[0] = base_angle_rate[3]
    predicted_angle[0] = base_angle[3]
    for j in range(STATIONS):
        predicted_rate[j + 1] = (
            rate[j]
            + predicted_rate_per_stage1_acceleration_2 * stage1_acceleration[j]
            - predicted_rate_per_stage2_acceleration_2 * stage2_acceleration[j]
            + predicted_rate_per_stage3_acceleration * stage3_acceleration[j]
        )
        predicted_angle[j + 1] = (
            angle[j]
            + predicted_angle_per_stage3_rate * stage3_rate[j]
            + predicted_rate[j + 1] * rate_per_acceleration
            + predicted_rate_per_stage1_acceleration_2 * stage1_rate[j]
            - predicted_rate_per_stage2_acceleration_2 * stage2_rate[j]
        )

    # Stage 4 of 5: accelerations of the nodes
    for j in range(STATIONS):
        lever_cosine[j] = length * ca.cos(predicted_angle[j + 1])
        lever_sine[j] = length * ca.sin(predicted_angle[j + 1])
        square = predicted_rate[j + 1] * predicted_rate[j + 1]
        relative_x[j] = -lever_cosine[j] * square - lever_sine[j] * stage3_acceleration[j]
        relative_y[j] = lever_cosine[j] * stage3_acceleration[j] - lever_sine[j] * square
        turning = half_timestep * predicted_rate[j + 1]
        swing_x[j] = -lever_sine[j] - angle_per_acceleration * relative_y[j] - lever_cosine[j] * turning
        swing_y[j] = lever_cosine[j] + angle_per_acceleration * relative_x[j] - lever_sine[j] * turning
    node_x = 0.0
    node_y = 0.0
    acceleration_x[0] = node_x
    acceleration_y[0] = node_y
    for j in range(STATIONS):
        node_x = node_x + relative_x[j]
        node_y = node_y + relative_y[j]
        acceleration_x[j + 1] = node_x
        acceleration_y[j + 1] = node_y

    # Stage 4 of 5: forces of the joints at the motion so far
    for j in range(STATIONS):
        joint_torque[j] = damping[j] * (predicted_rate[j] - predicted_rate[j + 1]) + stiffness[j] * (
            predicted_angle[j] - predicted_angle[j + 1]
        )

    # Stage 4 of 5: sweep inward: force beyond each joint as an affine function of the motion at it
    impedance_xx = end_mass
    impedance_xy = 0.0
    impedance_xu = 0.0
    impedance_yx = 0.0
    impedance_yy = end_mass
    impedance_yu = 0.0
    impedance_ux = 0.0
    impedance_uy = 0.0
    impedance_uu = tip_inertia
    force_x = acceleration_x[50] * end_mass
    force_y = acceleration_y[50] * end_mass
    torque = stage3_acceleration[49] * tip_inertia
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
        torque = (
            torque
            - force_x * lever_sine[j]
            + force_y * lever_cosine[j]
            + rod_inertia * stage3_acceleration[j]
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

    # Stage 4 of 5: the base
    unknown = 0.0

    # Stage 4 of 5: sweep outward: the unknown of each station
    change_x = 0.0
    change_y = 0.0
    for j in range(STATIONS):
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y + transmission[j] * unknown
        change_x = change_x + swing_x[j] * unknown
        change_y = change_y + swing_y[j] * unknown
        solved[j] = unknown

    # Stage 4 of 5: motion at this stage
    for j in range(STATIONS):
        stage4_acceleration[j] = solved[j] + stage3_acceleration[j]
        stage4_rate[j] = predicted_rate[j + 1] + rate_per_acceleration * solved[j]

    # Stage 5 of 5: predicted motion
    predicted_rate[0] = base_angle_rate[4]
    predicted_angle[0] = base_angle[4]
    for j in range(STATIONS):
        predicted_rate[j + 1] = (
            rate[j]
            + predicted_rate_per_stage1_acceleration_3 * stage1_acceleration[j]
            - predicted_rate_per_stage2_acceleration_3 * stage2_acceleration[j]
            + predicted_rate_per_stage3_acceleration_2 * stage3_acceleration[j]
            - predicted_rate_per_stage4_acceleration * stage4_acceleration[j]
        )
        predicted_angle[j + 1] = (
            angle[j]
            - predicted_angle_per_stage4_rate * stage4_rate[j]
            + predicted_rate[j + 1] * rate_per_acceleration
            + predicted_rate_per_stage1_acceleration_3 * stage1_rate[j]
            - predicted_rate_per_stage2_acceleration_3 * stage2_rate[j]
            + predicted_rate_per_stage3_acceleration_2 * stage3_rate[j]
        )

    # Stage 5 of 5: accelerations of the nodes
    for j in range(STATIONS):
        lever_cosine[j] = length * ca.cos(predicted_angle[j + 1])
        lever_sine[j] = length * ca.sin(predicted_angle[j + 1])
        square = predicted_rate[j + 1] * predicted_rate[j + 1]
        relative_x[j] = -lever_cosine[j] * square - lever_sine[j] * stage4_acceleration[j]
        relative_y[j] = lever_cosine[j] * stage4_acceleration[j] - lever_sine[j] * square
        turning = half_timestep * predicted_rate[j + 1]
        swing_x[j] = -lever_sine[j] - angle_per_acceleration * relative_y[j] - lever_cosine[j] * turning
        swing_y[j] = lever_cosine[j] + angle_per_acceleration * relative_x[j] - lever_sine[j] * turning
    node_x = 0.0
    node_y = 0.0
    acceleration_x[0] = node_x
    acceleration_y[0] = node_y
    for j in range(STATIONS):
        node_x = node_x + relative_x[j]
        node_y = node_y + relative_y[j]
        acceleration_x[j + 1] = node_x
        acceleration_y[j + 1] = node_y

    # Stage 5 of 5: forces of the joints at the motion so far
    for j in range(STATIONS):
        joint_torque[j] = damping[j] * (predicted_rate[j] - predicted_rate[j + 1]) + stiffness[j] * (
            predicted_angle[j] - predicted_angle[j + 1]
        )

    # Stage 5 of 5: sweep inward: force beyond each joint as an affine function of the motion at it
    impedance_xx = end_mass
    impedance_xy = 0.0
    impedance_xu = 0.0
    impedance_yx = 0.0
    impedance_yy = end_mass
    impedance_yu = 0.0
    impedance_ux = 0.0
    impedance_uy = 0.0
    impedance_uu = tip_inertia
    force_x = acceleration_x[50] * end_mass
    force_y = acceleration_y[50] * end_mass
    torque = stage4_acceleration[49] * tip_inertia
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
        torque = (
            torque
            - force_x * lever_sine[j]
            + force_y * lever_cosine[j]
            + rod_inertia * stage4_acceleration[j]
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

    # Stage 5 of 5: the base
    unknown = 0.0

    # Stage 5 of 5: sweep outward: the unknown of each station
    change_x = 0.0
    change_y = 0.0
    for j in range(STATIONS):
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y + transmission[j] * unknown
        change_x = change_x + swing_x[j] * unknown
        change_y = change_y + swing_y[j] * unknown
        solved[j] = unknown

    # Stage 5 of 5: motion at the end of the step
    hub_angle = base_angle[4]
    hub_rate = base_angle_rate[4]
    for j in range(STATIONS):
        angle[j] = predicted_angle[j + 1] + angle_per_acceleration * solved[j]
        rate[j] = predicted_rate[j + 1] + rate_per_acceleration * solved[j]
        acceleration[j] = solved[j] + stage4_acceleration[j]
    return _column(hub_angle, hub_rate, *angle, *rate, *acceleration)


def _output(model: dict[str, Any], x: ca.SX, stages: Sequence[ca.SX]) -> ca.SX:
    """Read the outputs off a state."""
    length = model["length"]
    stiffness = model["stiffness"]
    damping = model["damping"]
    tip_mass = model["tip_mass"]
    reaction_x_per_acceleration_x = model["reaction_x_per_acceleration_x"]
    reaction_x_per_acceleration_x_2 = model["reaction_x_per_acceleration_x_2"]
    hub_angle = x[0]
    hub_rate = x[1]
    angle = ca.vertsplit(x[2:52])
    rate = ca.vertsplit(x[52:102])
    acceleration = ca.vertsplit(x[102:152])
    acceleration_x: list[Any] = [0.0] * (STATIONS + 1)
    acceleration_y: list[Any] = [0.0] * (STATIONS + 1)

    # output tip: position
    tip_x: Any = 0.0
    tip_y: Any = 0.0
    for j in range(STATIONS):
        tip_x = tip_x + length * ca.cos(angle[j])
        tip_y = tip_y + length * ca.sin(angle[j])

    # output tip_angle: angle
    tip_angle = angle[49]

    # output reaction: force
    a_x: Any = 0.0
    a_y: Any = 0.0
    acceleration_x[0] = a_x
    acceleration_y[0] = a_y
    for j in range(STATIONS):
        a_x = (
            a_x
            - acceleration[j] * length * ca.sin(angle[j])
            - length * (rate[j] * rate[j]) * ca.cos(angle[j])
        )
        a_y = (
            a_y
            + acceleration[j] * length * ca.cos(angle[j])
            - length * (rate[j] * rate[j]) * ca.sin(angle[j])
        )
        acceleration_x[j + 1] = a_x
        acceleration_y[j + 1] = a_y
    reaction_x = acceleration_x[50] * tip_mass
    reaction_y = acceleration_y[50] * tip_mass
    for j in reversed(range(STATIONS)):
        reaction_x = reaction_x + acceleration_x[j + 1] * reaction_x_per_acceleration_x
        reaction_y = reaction_y + acceleration_y[j + 1] * reaction_x_per_acceleration_x
        reaction_x = reaction_x - acceleration_x[j] * reaction_x_per_acceleration_x_2
        reaction_y = reaction_y - acceleration_y[j] * reaction_x_per_acceleration_x_2

    # output drive: torque
    drive = damping[0] * (rate[0] - hub_rate) + stiffness[0] * (angle[0] - hub_angle)
    return _column(tip_x, tip_y, tip_angle, reaction_x, reaction_y, drive)

# arm50: Stiff arm of fifty links on a servo
#
# Written by tmm-gen 0.1.0. Do not edit: change the scene and run `tmm-gen build`.
# scene digest: 7e2e87b8a48332cf3886a22711bd9428eeea692a0d70cc5ae1662962d37ffc57
# sha256 of the rest of this file: 2975a5241ad8fd721f466e99141813a21fbe787a78bcc272345040d39fa1eacd
#
# model: planar arm, large rotations, tip mass
# stations: 50
# base: prescribed
# integrator: SDIRK, order 4, 5 stages (Hairer & Wanner 1996)
# linearisation: newton
# sweep: riccati
# unknown: acceleration
# operations of a step: 35065, 701.3 per station (16150 additions, 18165 multiplications, 250 divisions, 500
#     functions)
# operations of prepare: 348, 6.96 per station (53 additions, 295 multiplications)
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

    # Masses by the ends they act at, and joint impedances
    carried_mass = center * mass
    inner_mass = mass - center * mass
    pin_inertia = inertia + center * center * (length * length) * mass
    for j in range(STATIONS):
        joint_impedance[j] = 0.25 * damping[j] * step + 0.0625 * (step * step) * stiffness[j]

    # Factors of the step that depend on the time step and parameters alone
    angle_per_acceleration = 0.0625 * (step * step)
    rate_per_acceleration = 0.25 * step
    step_1_over_2 = 0.5 * step
    step2_3_over_16 = 0.1875 * (step * step)
    step_3_over_4 = 0.75 * step
    step2_17_over_200 = (17.0 / 200.0) * (step * step)
    step_17_over_50 = (17.0 / 50.0) * step
    step2_21_over_400 = (21.0 / 400.0) * (step * step)
    step_1_over_25 = (1.0 / 25.0) * step
    step_21_over_100 = (21.0 / 100.0) * step
    step2_371_over_5440 = (371.0 / 5440.0) * (step * step)
    step_371_over_1360 = (371.0 / 1360.0) * step
    step2_137_over_10880 = (137.0 / 10880.0) * (step * step)
    step_137_over_2720 = (137.0 / 2720.0) * step
    step2_151_over_2176 = (151.0 / 2176.0) * (step * step)
    step_15_over_544 = (15.0 / 544.0) * step
    step_151_over_544 = (151.0 / 544.0) * step
    step2_25_over_96 = (25.0 / 96.0) * (step * step)
    step_25_over_24 = (25.0 / 24.0) * step
    step2_49_over_192 = (49.0 / 192.0) * (step * step)
    step_49_over_48 = (49.0 / 48.0) * step
    step2_125_over_64 = 1.953125 * (step * step)
    step_125_over_16 = 7.8125 * step
    step2_41_over_24 = (41.0 / 24.0) * (step * step)
    step_85_over_12 = (85.0 / 12.0) * step
    step_41_over_6 = (41.0 / 6.0) * step
    factor_27 = mass * (center - 1.0)
    factor_28 = center * mass
    return {
        "length": length,
        "mass": mass,
        "stiffness": stiffness,
        "damping": damping,
        "tip_mass": tip_mass,
        "tip_inertia": tip_inertia,
        "angle_per_acceleration": angle_per_acceleration,
        "rate_per_acceleration": rate_per_acceleration,
        "step_1_over_2": step_1_over_2,
        "step2_3_over_16": step2_3_over_16,
        "step_3_over_4": step_3_over_4,
        "step2_17_over_200": step2_17_over_200,
        "step_17_over_50": step_17_over_50,
        "step2_21_over_400": step2_21_over_400,
        "step_1_over_25": step_1_over_25,
        "step_21_over_100": step_21_over_100,
        "step2_371_over_5440": step2_371_over_5440,
        "step_371_over_1360": step_371_over_1360,
        "step2_137_over_10880": step2_137_over_10880,
        "step_137_over_2720": step_137_over_2720,
        "step2_151_over_2176": step2_151_over_2176,
        "step_15_over_544": step_15_over_544,
        "step_151_over_544": step_151_over_544,
        "step2_25_over_96": step2_25_over_96,
        "step_25_over_24": step_25_over_24,
        "step2_49_over_192": step2_49_over_192,
        "step_49_over_48": step_49_over_48,
        "step2_125_over_64": step2_125_over_64,
        "step_125_over_16": step_125_over_16,
        "step2_41_over_24": step2_41_over_24,
        "step_85_over_12": step_85_over_12,
        "step_41_over_6": step_41_over_6,
        "factor_27": factor_27,
        "factor_28": factor_28,
        "carried_mass": carried_mass,
        "inner_mass": inner_mass,
        "pin_inertia": pin_inertia,
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
    solved: list[Any] = [0.0] * STATIONS
    swing_x: list[Any] = [0.0] * STATIONS
    swing_y: list[Any] = [0.0] * STATIONS

    # predicted motion
    predicted_angle[0] = base_angle[0]
    predicted_rate[0] = base_angle_rate[0]
    predicted_acceleration[0] = base_angle_acceleration[0]
    for j in range(STATIONS):
        predicted_angle[j + 1] = initial_angle[j]
        predicted_rate[j + 1] = initial_rate[j]
        predicted_acceleration[j + 1] = 0.0

    # accelerations of the nodes
    for j in range(STATIONS):
        lever_sine[j] = length * ca.sin(predicted_angle[j + 1])
        lever_cosine[j] = length * ca.cos(predicted_angle[j + 1])
    node_x: Any = 0.0
    node_y: Any = 0.0
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
    force_x = acceleration_x[50] * tip_mass
    force_y = acceleration_y[50] * tip_mass
    torque = predicted_acceleration[50] * tip_inertia
    for j in reversed(range(STATIONS)):
        outer_x = impedance_xu + impedance_xx * swing_x[j] + impedance_xy * swing_y[j]
        outer_y = impedance_yu + impedance_yx * swing_x[j] + impedance_yy * swing_y[j]
        outer_u = impedance_uu + impedance_ux * swing_x[j] + impedance_uy * swing_y[j]
        load_x = force_x + acceleration_x[j] * center * mass
        load_y = force_y + acceleration_y[j] * center * mass
        link_ux = (
            impedance_ux + impedance_yx * lever_cosine[j] - lever_sine[j] * (impedance_xx + center * mass)
        )
        link_uy = (
            impedance_uy - impedance_xy * lever_sine[j] + lever_cosine[j] * (impedance_yy + center * mass)
        )
        link_uu = (
            inertia
            + outer_u
            + lever_cosine[j] * outer_y
            - lever_sine[j] * outer_x
            + center * center * (length * length) * mass
        )
        link_xx = impedance_xx + mass
        link_xy = impedance_xy
        link_xu = outer_x + center * mass * swing_x[j]
        link_yx = impedance_yx
        link_yy = impedance_yy + mass
        link_yu = outer_y + center * mass * swing_y[j]
        torque = (
            torque
            + lever_cosine[j] * load_y
            - lever_sine[j] * load_x
            + predicted_acceleration[j + 1] * (inertia + center * center * (length * length) * mass)
        )
        force_x = force_x + acceleration_x[j] * (mass - center * mass) + acceleration_x[j + 1] * center * mass
        force_y = force_y + acceleration_y[j] * (mass - center * mass) + acceleration_y[j + 1] * center * mass
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

    # the base moves as prescribed
    unknown: Any = 0.0

    # sweep outward: the increment of each link's unknown
    change_x: Any = 0.0
    change_y: Any = 0.0
    for j in range(STATIONS):
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y
        change_x = change_x + swing_x[j] * unknown
        change_y = change_y + swing_y[j] * unknown
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
    tip_mass = model["tip_mass"]
    tip_inertia = model["tip_inertia"]
    angle_per_acceleration = model["angle_per_acceleration"]
    rate_per_acceleration = model["rate_per_acceleration"]
    step_1_over_2 = model["step_1_over_2"]
    step2_3_over_16 = model["step2_3_over_16"]
    step_3_over_4 = model["step_3_over_4"]
    step2_17_over_200 = model["step2_17_over_200"]
    step_17_over_50 = model["step_17_over_50"]
    step2_21_over_400 = model["step2_21_over_400"]
    step_1_over_25 = model["step_1_over_25"]
    step_21_over_100 = model["step_21_over_100"]
    step2_371_over_5440 = model["step2_371_over_5440"]
    step_371_over_1360 = model["step_371_over_1360"]
    step2_137_over_10880 = model["step2_137_over_10880"]
    step_137_over_2720 = model["step_137_over_2720"]
    step2_151_over_2176 = model["step2_151_over_2176"]
    step_15_over_544 = model["step_15_over_544"]
    step_151_over_544 = model["step_151_over_544"]
    step2_25_over_96 = model["step2_25_over_96"]
    step_25_over_24 = model["step_25_over_24"]
    step2_49_over_192 = model["step2_49_over_192"]
    step_49_over_48 = model["step_49_over_48"]
    step2_125_over_64 = model["step2_125_over_64"]
    step_125_over_16 = model["step_125_over_16"]
    step2_41_over_24 = model["step2_41_over_24"]
    step_85_over_12 = model["step_85_over_12"]
    step_41_over_6 = model["step_41_over_6"]
    carried_mass = model["carried_mass"]
    inner_mass = model["inner_mass"]
    pin_inertia = model["pin_inertia"]
    joint_impedance = model["joint_impedance"]
    hub_angle = x[0]
    hub_rate = x[1]
    angle = ca.vertsplit(x[2:52])
    rate = ca.vertsplit(x[52:102])
    acceleration = ca.vertsplit(x[102:152])
    base_angle = [u[0] for u in stages]
    base_angle_rate = [u[1] for u in stages]
    base_angle_acceleration = [u[2] for u in stages]
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

    # Stage 1 of 5: predicted motion
    predicted_angle[0] = base_angle[0]
    predicted_rate[0] = base_angle_rate[0]
    predicted_acceleration[0] = base_angle_acceleration[0]
    for j in range(STATIONS):
        predicted_angle[j + 1] = (
            angle[j] + acceleration[j] * angle_per_acceleration + rate[j] * rate_per_acceleration
        )
        predicted_rate[j + 1] = rate[j] + acceleration[j] * rate_per_acceleration
        predicted_acceleration[j + 1] = acceleration[j]

    # Stage 1 of 5: accelerations of the nodes
    for j in range(STATIONS):
        lever_sine[j] = length * ca.sin(predicted_angle[j + 1])
        lever_cosine[j] = length * ca.cos(predicted_angle[j + 1])
    node_x: Any = 0.0
    node_y: Any = 0.0
    acceleration_x[0] = node_x
    acceleration_y[0] = node_y
    for j in range(STATIONS):
        square = predicted_rate[j + 1] * predicted_rate[j + 1]
        node_x = node_x - lever_cosine[j] * square - lever_sine[j] * predicted_acceleration[j + 1]
        node_y = node_y + lever_cosine[j] * predicted_acceleration[j + 1] - lever_sine[j] * square
        acceleration_x[j + 1] = node_x
        acceleration_y[j + 1] = node_y

    # Stage 1 of 5: how each link's outer end answers to its unknown, and the predicted joint torques
    for j in range(STATIONS):
        tangential = 1.0 - angle_per_acceleration * (predicted_rate[j + 1] * predicted_rate[j + 1])
        turning = (
            angle_per_acceleration * predicted_acceleration[j + 1] + predicted_rate[j + 1] * step_1_over_2
        )
        swing_x[j] = -lever_cosine[j] * turning - lever_sine[j] * tangential
        swing_y[j] = lever_cosine[j] * tangential - lever_sine[j] * turning
        joint_torque[j] = damping[j] * (predicted_rate[j] - predicted_rate[j + 1]) + stiffness[j] * (
            predicted_angle[j] - predicted_angle[j + 1]
        )

    # Stage 1 of 5: sweep inward: force beyond each joint as an affine function of the motion at it
    impedance_xx = tip_mass
    impedance_xy: Any = 0.0
    impedance_xu: Any = 0.0
    impedance_yx: Any = 0.0
    impedance_yy = tip_mass
    impedance_yu: Any = 0.0
    impedance_ux: Any = 0.0
    impedance_uy: Any = 0.0
    impedance_uu = tip_inertia
    force_x = acceleration_x[50] * tip_mass
    force_y = acceleration_y[50] * tip_mass
    torque = predicted_acceleration[50] * tip_inertia
    for j in reversed(range(STATIONS)):
        outer_x = impedance_xu + impedance_xx * swing_x[j] + impedance_xy * swing_y[j]
        outer_y = impedance_yu + impedance_yx * swing_x[j] + impedance_yy * swing_y[j]
        outer_u = impedance_uu + impedance_ux * swing_x[j] + impedance_uy * swing_y[j]
        load_x = force_x + acceleration_x[j] * carried_mass
        load_y = force_y + acceleration_y[j] * carried_mass
        link_ux = (
            impedance_ux + impedance_yx * lever_cosine[j] - lever_sine[j] * (carried_mass + impedance_xx)
        )
        link_uy = (
            impedance_uy - impedance_xy * lever_sine[j] + lever_cosine[j] * (carried_mass + impedance_yy)
        )
        link_uu = (
            outer_u
            + pin_inertia
            + angle_per_acceleration * (-lever_cosine[j] * load_x - lever_sine[j] * load_y)
            + lever_cosine[j] * outer_y
            - lever_sine[j] * outer_x
        )
        link_xx = impedance_xx + mass
        link_xy = impedance_xy
        link_xu = outer_x + carried_mass * swing_x[j]
        link_yx = impedance_yx
        link_yy = impedance_yy + mass
        link_yu = outer_y + carried_mass * swing_y[j]
        torque = (
            torque
            + lever_cosine[j] * load_y
            - lever_sine[j] * load_x
            + pin_inertia * predicted_acceleration[j + 1]
        )
        force_x = force_x + acceleration_x[j + 1] * carried_mass + acceleration_x[j] * inner_mass
        force_y = force_y + acceleration_y[j + 1] * carried_mass + acceleration_y[j] * inner_mass
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

    # Stage 1 of 5: the base moves as prescribed
    unknown: Any = 0.0

    # Stage 1 of 5: sweep outward: the increment of each link's unknown
    change_x: Any = 0.0
    change_y: Any = 0.0
    for j in range(STATIONS):
        unknown = (
            answer_own[j] + answer_from_inner[j] * unknown - answer_x[j] * change_x - answer_y[j] * change_y
        )
        change_x = change_x + swing_x[j] * unknown
        change_y = change_y + swing_y[j] * unknown
        solved[j] = unknown

    # Stage 1 of 5: motion at this stage
    for j in range(STATIONS):
        stage1_acceleration[j] = predicted_acceleration[j + 1] + solved[j]
        stage1_rate[j] = predicted_rate[j + 1] + rate_per_acceleration * solved[j]

    # Stage 2 of 5: predicted motion
    predicted_angle[0] = base_angle[1]
    predicted_rate[0] = base_angle_rate[1]
    predicted_acceleration[0] = base_angle_acceleration[1]
    for j in range(STATIONS):
        predicted_angle[j + 1] = (
            angle[j]
            + rate[j] * rate_per_acceleration
            + stage1_acceleration[j] * step2_3_over_16
            + stage1_rate[j] * step_1_over_2
        )
        predicted_rate[j + 1] = rate[j] + stage1_acceleration[j] * step_3_over_4
        predicted_acceleration[j + 1] = stage1_acceleration[j]

    # Stage 2 of 5: accelerations of the nodes
    for j in range(STATIONS):
        lever_sine[j] = length * ca.sin(predicted_angle[j + 1])
        lever_cosine[j] = length * ca.cos(predicted_angle[j + 1])
    node_x = 0.0
    node_y = 0.0
    acceleration_x[0] = node_x
    acceleration_y[0] = node_y
    for j in range(STATIONS):
        square = predicted_rate[j + 1] * predicted_rate[j + 1]
        node_x = node_x - lever_cosine[j] * square - lever_sine[j] * predicted_acceleration[j + 1]
        node_y = node_y + lever_cosine[j] * predicted_acceleration[j + 1] - lever_sine[j] * square
        acceleration_x[j + 1] = node_x
        acceleration_y[j + 1] = node_y

    # Stage 2 of 5: how each link's outer end answers to its unknown, and the predicted joint torques
    for j in range(STATIONS):
        tangential = 1.0 - angle_per_acceleration * (predicted_rate[j + 1] * predicted_rate[j + 1])
        turning = (
            angle_per_acceleration * predicted_acceleration[j + 1] + predicted_rate[j + 1] * step_1_over_2
        )
        swing_x[j] = -lever_cosine[j] * turning - lever_sine[j] * tangential
        swing_y[j] = lever_cosine[j] * tangential - lever_sine[j] * turning
        joint_torque[j] = damping[j] * (predicted_rate[j] - predicted_rate[j + 1]) + stiffness[j] * (
            predicted_angle[j] - predicted_angle[j + 1]
        )

    # Stage 2 of 5: sweep inward: force beyond each joint as an affine function of the motion at it
    impedance_xx = tip_mass
    impedance_xy = 0.0
    impedance_xu = 0.0
    impedance_yx = 0.0
    impedance_yy = tip_mass
    impedance_yu = 0.0
    impedance_ux = 0.0
    impedance_uy = 0.0
    impedance_uu = tip_inertia
    force_x = acceleration_x[50] * tip_mass
    force_y = acceleration_y[50] * tip_mass
    torque = predicted_acceleration[50] * tip_inertia
    for j in reversed(range(STATIONS)):
        outer_x = impedance_xu + impedance_xx * swing_x[j] + impedance_xy * swing_y[j]
        outer_y = impedance_yu + impedance_yx * swing_x[j] + impedance_yy * swing_y[j]
        outer_u = impedance_uu + impedance_ux * swing_x[j] + impedance_uy * swing_y[j]
        load_x = force_x + acceleration_x[j] * carried_mass
        load_y = force_y + acceleration_y[j] * carried_mass
        link_ux = (
            impedance_ux + impedance_yx * lever_cosine[j] - lever_sine[j] * (carried_mass + impedance_xx)
        )
        link_uy = (
            impedance_uy - impedance_xy * lever_sine[j] + lever_cosine[j] * (carried_mass + impedance_yy)
        )
        link_uu = (
            outer_u
            + pin_inertia
            + angle_per_acceleration * (-lever_cosine[j] * load_x - lever_sine[j] * load_y)
            + lever_cosine[j] * outer_y
            - lever_sine[j] * outer_x
        )
        link_xx = impedance_xx + mass
        link_xy = impedance_xy
        link_xu = outer_x + carried_mass * swing_x[j]
        link_yx = impedance_yx
        link_yy = impedance_yy + mass
        link_yu = outer_y + carried_mass * swing_y[j]
        torque = (
            torque
            + lever_cosine[j] * load_y
            - lever_sine[j] * load_x
            + pin_inertia * predicted_acceleration[j + 1]
        )
        force_x = force_x + acceleration_x[j + 1] * carried_mass + acceleration_x[j] * inner_mass
        force_y = force_y + acceleration_y[j + 1] * carried_mass + acceleration_y[j] * inner_mass
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

    # Stage 2 of 5: the base moves as prescribed
    unknown = 0.0

    # Stage 2 of 5: sweep outward: the increment of each link's unknown
    change_x = 0.0
    change_y = 0.0
    for j in range(STATIONS):
        unknown = (
            answer_own[j] + answer_from_inner[j] * unknown - answer_x[j] * change_x - answer_y[j] * change_y
        )
        change_x = change_x + swing_x[j] * unknown
        change_y = change_y + swing_y[j] * unknown
        solved[j] = unknown

    # Stage 2 of 5: motion at this stage
    for j in range(STATIONS):
        stage2_acceleration[j] = predicted_acceleration[j + 1] + solved[j]
        stage2_rate[j] = predicted_rate[j + 1] + rate_per_acceleration * solved[j]

    # Stage 3 of 5: predicted motion
    predicted_angle[0] = base_angle[2]
    predicted_rate[0] = base_angle_rate[2]
    predicted_acceleration[0] = base_angle_acceleration[2]
    for j in range(STATIONS):
        predicted_angle[j + 1] = (
            angle[j]
            + rate[j] * rate_per_acceleration
            + stage1_acceleration[j] * step2_17_over_200
            + stage1_rate[j] * step_17_over_50
            + stage2_acceleration[j] * step2_21_over_400
            - stage2_rate[j] * step_1_over_25
        )
        predicted_rate[j + 1] = (
            rate[j] + stage1_acceleration[j] * step_17_over_50 + stage2_acceleration[j] * step_21_over_100
        )
        predicted_acceleration[j + 1] = stage2_acceleration[j]

    # Stage 3 of 5: accelerations of the nodes
    for j in range(STATIONS):
        lever_sine[j] = length * ca.sin(predicted_angle[j + 1])
        lever_cosine[j] = length * ca.cos(predicted_angle[j + 1])
    node_x = 0.0
    node_y = 0.0
    acceleration_x[0] = node_x
    acceleration_y[0] = node_y
    for j in range(STATIONS):
        square = predicted_rate[j + 1] * predicted_rate[j + 1]
        node_x = node_x - lever_cosine[j] * square - lever_sine[j] * predicted_acceleration[j + 1]
        node_y = node_y + lever_cosine[j] * predicted_acceleration[j + 1] - lever_sine[j] * square
        acceleration_x[j + 1] = node_x
        acceleration_y[j + 1] = node_y

    # Stage 3 of 5: how each link's outer end answers to its unknown, and the predicted joint torques
    for j in range(STATIONS):
        tangential = 1.0 - angle_per_acceleration * (predicted_rate[j + 1] * predicted_rate[j + 1])
        turning = (
            angle_per_acceleration * predicted_acceleration[j + 1] + predicted_rate[j + 1] * step_1_over_2
        )
        swing_x[j] = -lever_cosine[j] * turning - lever_sine[j] * tangential
        swing_y[j] = lever_cosine[j] * tangential - lever_sine[j] * turning
        joint_torque[j] = damping[j] * (predicted_rate[j] - predicted_rate[j + 1]) + stiffness[j] * (
            predicted_angle[j] - predicted_angle[j + 1]
        )

    # Stage 3 of 5: sweep inward: force beyond each joint as an affine function of the motion at it
    impedance_xx = tip_mass
    impedance_xy = 0.0
    impedance_xu = 0.0
    impedance_yx = 0.0
    impedance_yy = tip_mass
    impedance_yu = 0.0
    impedance_ux = 0.0
    impedance_uy = 0.0
    impedance_uu = tip_inertia
    force_x = acceleration_x[50] * tip_mass
    force_y = acceleration_y[50] * tip_mass
    torque = predicted_acceleration[50] * tip_inertia
    for j in reversed(range(STATIONS)):
        outer_x = impedance_xu + impedance_xx * swing_x[j] + impedance_xy * swing_y[j]
        outer_y = impedance_yu + impedance_yx * swing_x[j] + impedance_yy * swing_y[j]
        outer_u = impedance_uu + impedance_ux * swing_x[j] + impedance_uy * swing_y[j]
        load_x = force_x + acceleration_x[j] * carried_mass
        load_y = force_y + acceleration_y[j] * carried_mass
        link_ux = (
            impedance_ux + impedance_yx * lever_cosine[j] - lever_sine[j] * (carried_mass + impedance_xx)
        )
        link_uy = (
            impedance_uy - impedance_xy * lever_sine[j] + lever_cosine[j] * (carried_mass + impedance_yy)
        )
        link_uu = (
            outer_u
            + pin_inertia
            + angle_per_acceleration * (-lever_cosine[j] * load_x - lever_sine[j] * load_y)
            + lever_cosine[j] * outer_y
            - lever_sine[j] * outer_x
        )
        link_xx = impedance_xx + mass
        link_xy = impedance_xy
        link_xu = outer_x + carried_mass * swing_x[j]
        link_yx = impedance_yx
        link_yy = impedance_yy + mass
        link_yu = outer_y + carried_mass * swing_y[j]
        torque = (
            torque
            + lever_cosine[j] * load_y
            - lever_sine[j] * load_x
            + pin_inertia * predicted_acceleration[j + 1]
        )
        force_x = force_x + acceleration_x[j + 1] * carried_mass + acceleration_x[j] * inner_mass
        force_y = force_y + acceleration_y[j + 1] * carried_mass + acceleration_y[j] * inner_mass
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

    # Stage 3 of 5: the base moves as prescribed
    unknown = 0.0

    # Stage 3 of 5: sweep outward: the increment of each link's unknown
    change_x = 0.0
    change_y = 0.0
    for j in range(STATIONS):
        unknown = (
            answer_own[j] + answer_from_inner[j] * unknown - answer_x[j] * change_x - answer_y[j] * change_y
        )
        change_x = change_x + swing_x[j] * unknown
        change_y = change_y + swing_y[j] * unknown
        solved[j] = unknown

    # Stage 3 of 5: motion at this stage
    for j in range(STATIONS):
        stage3_acceleration[j] = predicted_acceleration[j + 1] + solved[j]
        stage3_rate[j] = predicted_rate[j + 1] + rate_per_acceleration * solved[j]

    # Stage 4 of 5: predicted motion
    predicted_angle[0] = base_angle[3]
    predicted_rate[0] = base_angle_rate[3]
    predicted_acceleration[0] = base_angle_acceleration[3]
    for j in range(STATIONS):
        predicted_angle[j + 1] = (
            angle[j]
            + rate[j] * rate_per_acceleration
            + stage1_acceleration[j] * step2_371_over_5440
            + stage1_rate[j] * step_371_over_1360
            - stage2_acceleration[j] * step2_137_over_10880
            - stage2_rate[j] * step_137_over_2720
            + stage3_acceleration[j] * step2_151_over_2176
            + stage3_rate[j] * step_15_over_544
        )
        predicted_rate[j + 1] = (
            rate[j]
            + stage1_acceleration[j] * step_371_over_1360
            - stage2_acceleration[j] * step_137_over_2720
            + stage3_acceleration[j] * step_151_over_544
        )
        predicted_acceleration[j + 1] = stage3_acceleration[j]

    # Stage 4 of 5: accelerations of the nodes
    for j in range(STATIONS):
        lever_sine[j] = length * ca.sin(predicted_angle[j + 1])
        lever_cosine[j] = length * ca.cos(predicted_angle[j + 1])
    node_x = 0.0
    node_y = 0.0
    acceleration_x[0] = node_x
    acceleration_y[0] = node_y
    for j in range(STATIONS):
        square = predicted_rate[j + 1] * predicted_rate[j + 1]
        node_x = node_x - lever_cosine[j] * square - lever_sine[j] * predicted_acceleration[j + 1]
        node_y = node_y + lever_cosine[j] * predicted_acceleration[j + 1] - lever_sine[j] * square
        acceleration_x[j + 1] = node_x
        acceleration_y[j + 1] = node_y

    # Stage 4 of 5: how each link's outer end answers to its unknown, and the predicted joint torques
    for j in range(STATIONS):
        tangential = 1.0 - angle_per_acceleration * (predicted_rate[j + 1] * predicted_rate[j + 1])
        turning = (
            angle_per_acceleration * predicted_acceleration[j + 1] + predicted_rate[j + 1] * step_1_over_2
        )
        swing_x[j] = -lever_cosine[j] * turning - lever_sine[j] * tangential
        swing_y[j] = lever_cosine[j] * tangential - lever_sine[j] * turning
        joint_torque[j] = damping[j] * (predicted_rate[j] - predicted_rate[j + 1]) + stiffness[j] * (
            predicted_angle[j] - predicted_angle[j + 1]
        )

    # Stage 4 of 5: sweep inward: force beyond each joint as an affine function of the motion at it
    impedance_xx = tip_mass
    impedance_xy = 0.0
    impedance_xu = 0.0
    impedance_yx = 0.0
    impedance_yy = tip_mass
    impedance_yu = 0.0
    impedance_ux = 0.0
    impedance_uy = 0.0
    impedance_uu = tip_inertia
    force_x = acceleration_x[50] * tip_mass
    force_y = acceleration_y[50] * tip_mass
    torque = predicted_acceleration[50] * tip_inertia
    for j in reversed(range(STATIONS)):
        outer_x = impedance_xu + impedance_xx * swing_x[j] + impedance_xy * swing_y[j]
        outer_y = impedance_yu + impedance_yx * swing_x[j] + impedance_yy * swing_y[j]
        outer_u = impedance_uu + impedance_ux * swing_x[j] + impedance_uy * swing_y[j]
        load_x = force_x + acceleration_x[j] * carried_mass
        load_y = force_y + acceleration_y[j] * carried_mass
        link_ux = (
            impedance_ux + impedance_yx * lever_cosine[j] - lever_sine[j] * (carried_mass + impedance_xx)
        )
        link_uy = (
            impedance_uy - impedance_xy * lever_sine[j] + lever_cosine[j] * (carried_mass + impedance_yy)
        )
        link_uu = (
            outer_u
            + pin_inertia
            + angle_per_acceleration * (-lever_cosine[j] * load_x - lever_sine[j] * load_y)
            + lever_cosine[j] * outer_y
            - lever_sine[j] * outer_x
        )
        link_xx = impedance_xx + mass
        link_xy = impedance_xy
        link_xu = outer_x + carried_mass * swing_x[j]
        link_yx = impedance_yx
        link_yy = impedance_yy + mass
        link_yu = outer_y + carried_mass * swing_y[j]
        torque = (
            torque
            + lever_cosine[j] * load_y
            - lever_sine[j] * load_x
            + pin_inertia * predicted_acceleration[j + 1]
        )
        force_x = force_x + acceleration_x[j + 1] * carried_mass + acceleration_x[j] * inner_mass
        force_y = force_y + acceleration_y[j + 1] * carried_mass + acceleration_y[j] * inner_mass
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

    # Stage 4 of 5: the base moves as prescribed
    unknown = 0.0

    # Stage 4 of 5: sweep outward: the increment of each link's unknown
    change_x = 0.0
    change_y = 0.0
    for j in range(STATIONS):
        unknown = (
            answer_own[j] + answer_from_inner[j] * unknown - answer_x[j] * change_x - answer_y[j] * change_y
        )
        change_x = change_x + swing_x[j] * unknown
        change_y = change_y + swing_y[j] * unknown
        solved[j] = unknown

    # Stage 4 of 5: motion at this stage
    for j in range(STATIONS):
        stage4_acceleration[j] = predicted_acceleration[j + 1] + solved[j]
        stage4_rate[j] = predicted_rate[j + 1] + rate_per_acceleration * solved[j]

    # Stage 5 of 5: predicted motion
    predicted_angle[0] = base_angle[4]
    predicted_rate[0] = base_angle_rate[4]
    predicted_acceleration[0] = base_angle_acceleration[4]
    for j in range(STATIONS):
        predicted_angle[j + 1] = (
            angle[j]
            + rate[j] * rate_per_acceleration
            + stage1_acceleration[j] * step2_25_over_96
            + stage1_rate[j] * step_25_over_24
            - stage2_acceleration[j] * step2_49_over_192
            - stage2_rate[j] * step_49_over_48
            + stage3_acceleration[j] * step2_125_over_64
            + stage3_rate[j] * step_125_over_16
            - stage4_acceleration[j] * step2_41_over_24
            - stage4_rate[j] * step_85_over_12
        )
        predicted_rate[j + 1] = (
            rate[j]
            + stage1_acceleration[j] * step_25_over_24
            - stage2_acceleration[j] * step_49_over_48
            + stage3_acceleration[j] * step_125_over_16
            - stage4_acceleration[j] * step_41_over_6
        )
        predicted_acceleration[j + 1] = stage4_acceleration[j]

    # Stage 5 of 5: accelerations of the nodes
    for j in range(STATIONS):
        lever_sine[j] = length * ca.sin(predicted_angle[j + 1])
        lever_cosine[j] = length * ca.cos(predicted_angle[j + 1])
    node_x = 0.0
    node_y = 0.0
    acceleration_x[0] = node_x
    acceleration_y[0] = node_y
    for j in range(STATIONS):
        square = predicted_rate[j + 1] * predicted_rate[j + 1]
        node_x = node_x - lever_cosine[j] * square - lever_sine[j] * predicted_acceleration[j + 1]
        node_y = node_y + lever_cosine[j] * predicted_acceleration[j + 1] - lever_sine[j] * square
        acceleration_x[j + 1] = node_x
        acceleration_y[j + 1] = node_y

    # Stage 5 of 5: how each link's outer end answers to its unknown, and the predicted joint torques
    for j in range(STATIONS):
        tangential = 1.0 - angle_per_acceleration * (predicted_rate[j + 1] * predicted_rate[j + 1])
        turning = (
            angle_per_acceleration * predicted_acceleration[j + 1] + predicted_rate[j + 1] * step_1_over_2
        )
        swing_x[j] = -lever_cosine[j] * turning - lever_sine[j] * tangential
        swing_y[j] = lever_cosine[j] * tangential - lever_sine[j] * turning
        joint_torque[j] = damping[j] * (predicted_rate[j] - predicted_rate[j + 1]) + stiffness[j] * (
            predicted_angle[j] - predicted_angle[j + 1]
        )

    # Stage 5 of 5: sweep inward: force beyond each joint as an affine function of the motion at it
    impedance_xx = tip_mass
    impedance_xy = 0.0
    impedance_xu = 0.0
    impedance_yx = 0.0
    impedance_yy = tip_mass
    impedance_yu = 0.0
    impedance_ux = 0.0
    impedance_uy = 0.0
    impedance_uu = tip_inertia
    force_x = acceleration_x[50] * tip_mass
    force_y = acceleration_y[50] * tip_mass
    torque = predicted_acceleration[50] * tip_inertia
    for j in reversed(range(STATIONS)):
        outer_x = impedance_xu + impedance_xx * swing_x[j] + impedance_xy * swing_y[j]
        outer_y = impedance_yu + impedance_yx * swing_x[j] + impedance_yy * swing_y[j]
        outer_u = impedance_uu + impedance_ux * swing_x[j] + impedance_uy * swing_y[j]
        load_x = force_x + acceleration_x[j] * carried_mass
        load_y = force_y + acceleration_y[j] * carried_mass
        link_ux = (
            impedance_ux + impedance_yx * lever_cosine[j] - lever_sine[j] * (carried_mass + impedance_xx)
        )
        link_uy = (
            impedance_uy - impedance_xy * lever_sine[j] + lever_cosine[j] * (carried_mass + impedance_yy)
        )
        link_uu = (
            outer_u
            + pin_inertia
            + angle_per_acceleration * (-lever_cosine[j] * load_x - lever_sine[j] * load_y)
            + lever_cosine[j] * outer_y
            - lever_sine[j] * outer_x
        )
        link_xx = impedance_xx + mass
        link_xy = impedance_xy
        link_xu = outer_x + carried_mass * swing_x[j]
        link_yx = impedance_yx
        link_yy = impedance_yy + mass
        link_yu = outer_y + carried_mass * swing_y[j]
        torque = (
            torque
            + lever_cosine[j] * load_y
            - lever_sine[j] * load_x
            + pin_inertia * predicted_acceleration[j + 1]
        )
        force_x = force_x + acceleration_x[j + 1] * carried_mass + acceleration_x[j] * inner_mass
        force_y = force_y + acceleration_y[j + 1] * carried_mass + acceleration_y[j] * inner_mass
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

    # Stage 5 of 5: the base moves as prescribed
    unknown = 0.0

    # Stage 5 of 5: sweep outward: the increment of each link's unknown
    change_x = 0.0
    change_y = 0.0
    for j in range(STATIONS):
        unknown = (
            answer_own[j] + answer_from_inner[j] * unknown - answer_x[j] * change_x - answer_y[j] * change_y
        )
        change_x = change_x + swing_x[j] * unknown
        change_y = change_y + swing_y[j] * unknown
        solved[j] = unknown

    # Stage 5 of 5: motion at the end of the step
    hub_angle = base_angle[4]
    hub_rate = base_angle_rate[4]
    for j in range(STATIONS):
        angle[j] = predicted_angle[j + 1] + angle_per_acceleration * solved[j]
        rate[j] = predicted_rate[j + 1] + rate_per_acceleration * solved[j]
        acceleration[j] = predicted_acceleration[j + 1] + solved[j]
    return _column(hub_angle, hub_rate, *angle, *rate, *acceleration)


def _output(model: dict[str, Any], x: ca.SX, stages: Sequence[ca.SX]) -> ca.SX:
    """Read the outputs off a state."""
    length = model["length"]
    stiffness = model["stiffness"]
    damping = model["damping"]
    tip_mass = model["tip_mass"]
    factor_27 = model["factor_27"]
    factor_28 = model["factor_28"]
    hub_angle = x[0]
    hub_rate = x[1]
    angle = ca.vertsplit(x[2:52])
    rate = ca.vertsplit(x[52:102])
    acceleration = ca.vertsplit(x[102:152])

    # tip: position
    tip_x: Any = 0.0
    tip_y: Any = 0.0
    for j in range(STATIONS):
        tip_x = tip_x + length * ca.cos(angle[j])
        tip_y = tip_y + length * ca.sin(angle[j])

    # tip_angle: angle
    tip_angle = angle[49]

    # reaction: force
    node_x: Any = 0.0
    node_y: Any = 0.0
    reaction_x: Any = 0.0
    reaction_y: Any = 0.0
    for j in range(STATIONS):
        inner_x = node_x
        inner_y = node_y
        node_x = (
            node_x
            - acceleration[j] * length * ca.sin(angle[j])
            - length * (rate[j] * rate[j]) * ca.cos(angle[j])
        )
        node_y = (
            node_y
            + acceleration[j] * length * ca.cos(angle[j])
            - length * (rate[j] * rate[j]) * ca.sin(angle[j])
        )
        reaction_x = reaction_x - factor_27 * inner_x + factor_28 * node_x
        reaction_y = reaction_y - factor_27 * inner_y + factor_28 * node_y
    reaction_x = reaction_x + node_x * tip_mass
    reaction_y = reaction_y + node_y * tip_mass

    # drive: torque
    drive = damping[0] * (rate[0] - hub_rate) + stiffness[0] * (angle[0] - hub_angle)
    return _column(tip_x, tip_y, tip_angle, reaction_x, reaction_y, drive)

# arm50: Stiff arm of fifty links on a servo
#
# Written by tmm-gen 0.1.0. Do not edit: change the scene and run `tmm-gen build`.
# scene digest: 7e2e87b8a48332cf3886a22711bd9428eeea692a0d70cc5ae1662962d37ffc57
# sha256 of the rest of this file: 4b2485bce8017011ef26000b169a117bce17bf8e384dc6ed6c240c76461efaac
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
"""arm50: Stiff arm of fifty links on a servo.

A state goes in, a new one comes out: ``model = prepare(params, step)``, ``state = initialise(params,
input)``, ``state = step(model, state, input)``, ``y = output(model, state)``; or ``simulate(duration,
inputs)`` for all of them. Arrays are never written in place.

All arrays may have further axes behind, those of a batch: many arms at once, each with its own parameters,
inputs and state. What is one number for an arm then has the batch's shape; what differs between stations has
the stations first, base to tip. An arm with numbers that are not finite, or a step or pivot that is not
positive, is NaN; errors are left for where no other arm is left.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[Any]

STATIONS = 50
"""Number of links."""
STEP = 0.002
"""Time step of the scene (s)."""
INPUT_NAMES: tuple[str, ...] = ("base_angle", "base_angle_rate", "base_angle_acceleration")
OUTPUT_NAMES: tuple[str, ...] = ("tip_x", "tip_y", "tip_angle", "reaction_x", "reaction_y", "drive")
STAGE_INSTANTS = ((0.25, 0.75, 0.55, 0.5, 1.0),)
"""When inputs are read, in steps from the start of the step."""
INITIAL_ANGLE: ArrayLike = 0.0
INITIAL_RATE: ArrayLike = 0.0


class VanishingPivotError(ArithmeticError):
    """A pivot that is positive for every passive arm is not: the model cannot be solved."""


@dataclass(frozen=True, eq=False)
class Params:
    """Physical parameters, by default the scene's.

    Attributes
    ----------
    length : array_like, shape (*batch)
        Link length, the same everywhere (m).
    mass : array_like, shape (*batch)
        Link mass, the same everywhere (kg).
    inertia : array_like, shape (*batch)
        Link inertia about its centre of mass, the same everywhere (kg m^2).
    center : array_like, shape (*batch)
        Centre of mass along the link, 0 to 1, the same everywhere.
    stiffness : array_like, shape (50, *batch)
        Joint stiffness, base to tip (N m/rad).
    damping : array_like, shape (50, *batch)
        Joint damping, base to tip (N m s/rad).
    tip_mass : array_like, shape (*batch)
        Mass at the tip (kg).
    tip_inertia : array_like, shape (*batch)
        Inertia at the tip (kg m^2).
    """

    length: ArrayLike = 0.016
    mass: ArrayLike = 0.0304
    inertia: ArrayLike = 6.485333333333333e-07
    center: ArrayLike = 0.5
    stiffness: ArrayLike = (
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
    )
    damping: ArrayLike = (
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
    )
    tip_mass: ArrayLike = 0.5
    tip_inertia: ArrayLike = 0.0004


@dataclass(frozen=True, eq=False)
class Model:
    """What depends on parameters and step alone.

    Attributes
    ----------
    length : array, shape (*batch)
        Link length, the same everywhere (m).
    mass : array, shape (*batch)
        Link mass, the same everywhere (kg).
    stiffness : array, shape (50, *batch)
        Joint stiffness, base to tip (N m/rad).
    damping : array, shape (50, *batch)
        Joint damping, base to tip (N m s/rad).
    tip_mass : array, shape (*batch)
        Mass at the tip (kg).
    tip_inertia : array, shape (*batch)
        Inertia at the tip (kg m^2).
    angle_per_acceleration : array, shape (*batch)
        Angle per unit of acceleration: step**2/16 (SI).
    rate_per_acceleration : array, shape (*batch)
        Rate per unit of acceleration: step/4 (SI).
    step_1_over_2 : array, shape (*batch)
        Step/2 (s).
    step2_3_over_16 : array, shape (*batch)
        3*step**2/16 (s^2).
    step_3_over_4 : array, shape (*batch)
        3*step/4 (s).
    step2_17_over_200 : array, shape (*batch)
        17*step**2/200 (s^2).
    step_17_over_50 : array, shape (*batch)
        17*step/50 (s).
    step2_21_over_400 : array, shape (*batch)
        21*step**2/400 (s^2).
    step_1_over_25 : array, shape (*batch)
        Step/25 (s).
    step_21_over_100 : array, shape (*batch)
        21*step/100 (s).
    step2_371_over_5440 : array, shape (*batch)
        371*step**2/5440 (s^2).
    step_371_over_1360 : array, shape (*batch)
        371*step/1360 (s).
    step2_137_over_10880 : array, shape (*batch)
        137*step**2/10880 (s^2).
    step_137_over_2720 : array, shape (*batch)
        137*step/2720 (s).
    step2_151_over_2176 : array, shape (*batch)
        151*step**2/2176 (s^2).
    step_15_over_544 : array, shape (*batch)
        15*step/544 (s).
    step_151_over_544 : array, shape (*batch)
        151*step/544 (s).
    step2_25_over_96 : array, shape (*batch)
        25*step**2/96 (s^2).
    step_25_over_24 : array, shape (*batch)
        25*step/24 (s).
    step2_49_over_192 : array, shape (*batch)
        49*step**2/192 (s^2).
    step_49_over_48 : array, shape (*batch)
        49*step/48 (s).
    step2_125_over_64 : array, shape (*batch)
        125*step**2/64 (s^2).
    step_125_over_16 : array, shape (*batch)
        125*step/16 (s).
    step2_41_over_24 : array, shape (*batch)
        41*step**2/24 (s^2).
    step_85_over_12 : array, shape (*batch)
        85*step/12 (s).
    step_41_over_6 : array, shape (*batch)
        41*step/6 (s).
    factor_27 : array, shape (*batch)
        Mass*(center - 1) (SI).
    factor_28 : array, shape (*batch)
        Center*mass (SI).
    carried_mass : array, shape (*batch)
        Mass acting at a link's outer end (kg).
    inner_mass : array, shape (*batch)
        Mass acting at a link's inner end (kg).
    pin_inertia : array, shape (*batch)
        Inertia of a link about its inner end (kg m^2).
    joint_impedance : array, shape (50, *batch)
        Torque of a joint per difference of unknowns (SI).
    """

    length: Array
    mass: Array
    stiffness: Array
    damping: Array
    tip_mass: Array
    tip_inertia: Array
    angle_per_acceleration: Array
    rate_per_acceleration: Array
    step_1_over_2: Array
    step2_3_over_16: Array
    step_3_over_4: Array
    step2_17_over_200: Array
    step_17_over_50: Array
    step2_21_over_400: Array
    step_1_over_25: Array
    step_21_over_100: Array
    step2_371_over_5440: Array
    step_371_over_1360: Array
    step2_137_over_10880: Array
    step_137_over_2720: Array
    step2_151_over_2176: Array
    step_15_over_544: Array
    step_151_over_544: Array
    step2_25_over_96: Array
    step_25_over_24: Array
    step2_49_over_192: Array
    step_49_over_48: Array
    step2_125_over_64: Array
    step_125_over_16: Array
    step2_41_over_24: Array
    step_85_over_12: Array
    step_41_over_6: Array
    factor_27: Array
    factor_28: Array
    carried_mass: Array
    inner_mass: Array
    pin_inertia: Array
    joint_impedance: Array


@dataclass(frozen=True, eq=False)
class State:
    """Motion at one instant.

    Attributes
    ----------
    hub_angle : array, shape (*batch)
        Hub angle (rad).
    hub_rate : array, shape (*batch)
        Hub rate (rad/s).
    angle : array, shape (50, *batch)
        Angle of each link, base to tip (rad).
    rate : array, shape (50, *batch)
        Rate of each link, base to tip (rad/s).
    acceleration : array, shape (50, *batch)
        Acceleration of each link, base to tip (rad/s^2).
    """

    hub_angle: Array
    hub_rate: Array
    angle: Array
    rate: Array
    acceleration: Array


@dataclass(frozen=True, eq=False)
class Input:
    """What acts on the arm at one stage of a step.

    Attributes
    ----------
    base_angle : array_like, shape (*batch)
        Prescribed base angle, at each stage of the step (rad).
    base_angle_rate : array_like, shape (*batch)
        Prescribed base rate, at each stage of the step (rad/s).
    base_angle_acceleration : array_like, shape (*batch)
        Prescribed base acceleration, at each stage of the step (rad/s^2).
    """

    base_angle: ArrayLike = 0.0
    base_angle_rate: ArrayLike = 0.0
    base_angle_acceleration: ArrayLike = 0.0


@dataclass(frozen=True, eq=False)
class Output:
    """What the scene reports.

    Attributes
    ----------
    tip_x : array, shape (*batch)
        Position at the tip, x (m).
    tip_y : array, shape (*batch)
        Position at the tip, y (m).
    tip_angle : array, shape (*batch)
        Angle at the tip (rad).
    reaction_x : array, shape (*batch)
        Force at the base, x (N).
    reaction_y : array, shape (*batch)
        Force at the base, y (N).
    drive : array, shape (*batch)
        Torque at the base (N m).
    """

    tip_x: Array
    tip_y: Array
    tip_angle: Array
    reaction_x: Array
    reaction_y: Array
    drive: Array


@dataclass(frozen=True, eq=False)
class Result:
    """A simulation.

    Attributes
    ----------
    times : array, shape (steps + 1,)
        Instants (s).
    outputs : dict from str to array, shape (steps + 1, *batch)
        Outputs at these instants, by name.
    state : State
        Motion at the end.
    """

    times: Array
    outputs: dict[str, Array]
    state: State


@np.errstate(all="ignore")
def prepare(params: Params = Params(), step: ArrayLike = STEP) -> Model:
    """Compute what depends on parameters and step alone.

    Parameters
    ----------
    params : Params
        Physical parameters.
    step : array_like, shape (*batch)
        Time step (s).

    Raises
    ------
    FloatingPointError
        If parameters, step or what follows from them are not finite.
    ValueError
        If the step is not positive, or shapes do not fit.
    VanishingPivotError
        If parameters or step leave a pivot that is not positive.
    """
    step = _array(step, None, "step")
    length = _array(params.length, None, "length")
    mass = _array(params.mass, None, "mass")
    inertia = _array(params.inertia, None, "inertia")
    center = _array(params.center, None, "center")
    stiffness = _array(params.stiffness, STATIONS, "stiffness")
    damping = _array(params.damping, STATIONS, "damping")
    tip_mass = _array(params.tip_mass, None, "tip_mass")
    tip_inertia = _array(params.tip_inertia, None, "tip_inertia")
    good = _positive(step)
    numbers = (step, length, mass, inertia, center, tip_mass, tip_inertia)
    arrays = (stiffness, damping)
    batch, _ = _common(numbers, arrays)
    stiffness = _align(stiffness, batch)
    damping = _align(damping, batch)

    # Masses by the ends they act at, and joint impedances
    carried_mass = center * mass
    inner_mass = mass - center * mass
    pin_inertia = inertia + center * center * (length * length) * mass
    joint_impedance = 0.25 * damping * step + 0.0625 * (step * step) * stiffness

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

    numbers = (
        length,
        mass,
        tip_mass,
        tip_inertia,
        angle_per_acceleration,
        rate_per_acceleration,
        step_1_over_2,
        step2_3_over_16,
        step_3_over_4,
        step2_17_over_200,
        step_17_over_50,
        step2_21_over_400,
        step_1_over_25,
        step_21_over_100,
        step2_371_over_5440,
        step_371_over_1360,
        step2_137_over_10880,
        step_137_over_2720,
        step2_151_over_2176,
        step_15_over_544,
        step_151_over_544,
        step2_25_over_96,
        step_25_over_24,
        step2_49_over_192,
        step_49_over_48,
        step2_125_over_64,
        step_125_over_16,
        step2_41_over_24,
        step_85_over_12,
        step_41_over_6,
        factor_27,
        factor_28,
        carried_mass,
        inner_mass,
        pin_inertia,
        step,
        inertia,
        center,
    )
    arrays = (stiffness, damping, joint_impedance)
    good = _judged(good, numbers, arrays, "parameters or step are too large or too small for the number type")
    return Model(
        length=_kept(length, good, False),
        mass=_kept(mass, good, False),
        stiffness=_kept(stiffness, good, True),
        damping=_kept(damping, good, True),
        tip_mass=_kept(tip_mass, good, False),
        tip_inertia=_kept(tip_inertia, good, False),
        angle_per_acceleration=_kept(angle_per_acceleration, good, False),
        rate_per_acceleration=_kept(rate_per_acceleration, good, False),
        step_1_over_2=_kept(step_1_over_2, good, False),
        step2_3_over_16=_kept(step2_3_over_16, good, False),
        step_3_over_4=_kept(step_3_over_4, good, False),
        step2_17_over_200=_kept(step2_17_over_200, good, False),
        step_17_over_50=_kept(step_17_over_50, good, False),
        step2_21_over_400=_kept(step2_21_over_400, good, False),
        step_1_over_25=_kept(step_1_over_25, good, False),
        step_21_over_100=_kept(step_21_over_100, good, False),
        step2_371_over_5440=_kept(step2_371_over_5440, good, False),
        step_371_over_1360=_kept(step_371_over_1360, good, False),
        step2_137_over_10880=_kept(step2_137_over_10880, good, False),
        step_137_over_2720=_kept(step_137_over_2720, good, False),
        step2_151_over_2176=_kept(step2_151_over_2176, good, False),
        step_15_over_544=_kept(step_15_over_544, good, False),
        step_151_over_544=_kept(step_151_over_544, good, False),
        step2_25_over_96=_kept(step2_25_over_96, good, False),
        step_25_over_24=_kept(step_25_over_24, good, False),
        step2_49_over_192=_kept(step2_49_over_192, good, False),
        step_49_over_48=_kept(step_49_over_48, good, False),
        step2_125_over_64=_kept(step2_125_over_64, good, False),
        step_125_over_16=_kept(step_125_over_16, good, False),
        step2_41_over_24=_kept(step2_41_over_24, good, False),
        step_85_over_12=_kept(step_85_over_12, good, False),
        step_41_over_6=_kept(step_41_over_6, good, False),
        factor_27=_kept(factor_27, good, False),
        factor_28=_kept(factor_28, good, False),
        carried_mass=_kept(carried_mass, good, False),
        inner_mass=_kept(inner_mass, good, False),
        pin_inertia=_kept(pin_inertia, good, False),
        joint_impedance=_kept(joint_impedance, good, True),
    )


@np.errstate(all="ignore")
def initialise(
    params: Params = Params(),
    input: Input = Input(),
    *,
    initial_angle: ArrayLike = INITIAL_ANGLE,
    initial_rate: ArrayLike = INITIAL_RATE,
) -> State:
    """Start from given angles and rates with the acceleration that satisfies the equations of motion.

    Parameters
    ----------
    params : Params
        Physical parameters.
    input : Input
        What acts at the initial instant.
    initial_angle : number, or array_like, shape (50, *batch)
        Angles to start from (rad).
    initial_rate : number, or array_like, shape (50, *batch)
        Rates to start from (rad/s).

    Raises
    ------
    FloatingPointError
        If an argument or the state is not finite.
    ValueError
        If shapes do not fit.
    VanishingPivotError
        If parameters leave a pivot that is not positive.
    """
    stages = (input,)
    good: Any = True
    base_angle = _at_stages(stages, "base_angle")
    base_angle_rate = _at_stages(stages, "base_angle_rate")
    base_angle_acceleration = _at_stages(stages, "base_angle_acceleration")
    length = _array(params.length, None, "length")
    mass = _array(params.mass, None, "mass")
    inertia = _array(params.inertia, None, "inertia")
    center = _array(params.center, None, "center")
    stiffness = _array(params.stiffness, STATIONS, "stiffness")
    damping = _array(params.damping, STATIONS, "damping")
    tip_mass = _array(params.tip_mass, None, "tip_mass")
    tip_inertia = _array(params.tip_inertia, None, "tip_inertia")
    initial_angle = _array(initial_angle, STATIONS, "initial_angle")
    initial_rate = _array(initial_rate, STATIONS, "initial_rate")
    numbers = (
        *base_angle,
        *base_angle_rate,
        *base_angle_acceleration,
        length,
        mass,
        inertia,
        center,
        tip_mass,
        tip_inertia,
    )
    arrays = (stiffness, damping, initial_angle, initial_rate)
    batch, dtype = _common(numbers, arrays)
    stiffness = _align(stiffness, batch)
    damping = _align(damping, batch)
    initial_angle = _align(initial_angle, batch)
    initial_rate = _align(initial_rate, batch)
    acceleration_x = np.zeros((STATIONS + 1, *batch), dtype)
    acceleration_y = np.zeros((STATIONS + 1, *batch), dtype)
    answer_own = np.zeros((STATIONS, *batch), dtype)
    answer_x = np.zeros((STATIONS, *batch), dtype)
    answer_y = np.zeros((STATIONS, *batch), dtype)
    predicted_acceleration = np.zeros((STATIONS + 1, *batch), dtype)
    predicted_angle = np.zeros((STATIONS + 1, *batch), dtype)
    predicted_rate = np.zeros((STATIONS + 1, *batch), dtype)
    solved = np.zeros((STATIONS, *batch), dtype)

    # predicted motion
    predicted_angle[0] = base_angle[0]
    predicted_rate[0] = base_angle_rate[0]
    predicted_acceleration[0] = base_angle_acceleration[0]
    predicted_angle[1:] = initial_angle
    predicted_rate[1:] = initial_rate
    predicted_acceleration[1:] = 0.0

    # accelerations of the nodes
    lever_sine = length * np.sin(predicted_angle[1:])
    lever_cosine = length * np.cos(predicted_angle[1:])
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
    swing_x = -lever_sine
    swing_y = lever_cosine
    joint_torque = damping * (predicted_rate[:50] - predicted_rate[1:]) + stiffness * (
        predicted_angle[:50] - predicted_angle[1:]
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
        good = _positive_pivot(good, pivot, "pivot", j)
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
    angle = predicted_angle[1:]
    rate = predicted_rate[1:]
    acceleration = predicted_acceleration[1:] + solved

    numbers = (hub_angle, hub_rate)
    arrays = (angle, rate, acceleration)
    good = _judged(good, numbers, arrays, "the motion has outgrown the number type")
    return State(
        hub_angle=_kept(_spread(hub_angle, batch, False), good, False),
        hub_rate=_kept(_spread(hub_rate, batch, False), good, False),
        angle=_kept(_spread(angle, batch, True), good, True),
        rate=_kept(_spread(rate, batch, True), good, True),
        acceleration=_kept(_spread(acceleration, batch, True), good, True),
    )


@np.errstate(all="ignore")
def step(model: Model, state: State, input: Input | Sequence[Input] = Input()) -> State:
    """Advance the state by one step.

    Parameters
    ----------
    model : Model
        From :func:`prepare`.
    state : State
        At the start of the step; left as it is.
    input : Input or sequence of Input
        What acts during the step: held over it, or one for each stage, read at its instant in STAGE_INSTANTS.

    Returns
    -------
    State
        At the end of the step.

    Raises
    ------
    FloatingPointError
        If an input or the new state is not finite.
    ValueError
        If shapes do not fit.
    VanishingPivotError
        If the motion, parameters or step leave a pivot that is not positive.
    """
    good: Any = True
    stages = _stages(input, 5)
    base_angle = _at_stages(stages, "base_angle")
    base_angle_rate = _at_stages(stages, "base_angle_rate")
    base_angle_acceleration = _at_stages(stages, "base_angle_acceleration")
    length = model.length
    mass = model.mass
    stiffness = np.asarray(model.stiffness)
    damping = np.asarray(model.damping)
    tip_mass = model.tip_mass
    tip_inertia = model.tip_inertia
    angle_per_acceleration = model.angle_per_acceleration
    rate_per_acceleration = model.rate_per_acceleration
    step_1_over_2 = model.step_1_over_2
    step2_3_over_16 = model.step2_3_over_16
    step_3_over_4 = model.step_3_over_4
    step2_17_over_200 = model.step2_17_over_200
    step_17_over_50 = model.step_17_over_50
    step2_21_over_400 = model.step2_21_over_400
    step_1_over_25 = model.step_1_over_25
    step_21_over_100 = model.step_21_over_100
    step2_371_over_5440 = model.step2_371_over_5440
    step_371_over_1360 = model.step_371_over_1360
    step2_137_over_10880 = model.step2_137_over_10880
    step_137_over_2720 = model.step_137_over_2720
    step2_151_over_2176 = model.step2_151_over_2176
    step_15_over_544 = model.step_15_over_544
    step_151_over_544 = model.step_151_over_544
    step2_25_over_96 = model.step2_25_over_96
    step_25_over_24 = model.step_25_over_24
    step2_49_over_192 = model.step2_49_over_192
    step_49_over_48 = model.step_49_over_48
    step2_125_over_64 = model.step2_125_over_64
    step_125_over_16 = model.step_125_over_16
    step2_41_over_24 = model.step2_41_over_24
    step_85_over_12 = model.step_85_over_12
    step_41_over_6 = model.step_41_over_6
    carried_mass = model.carried_mass
    inner_mass = model.inner_mass
    pin_inertia = model.pin_inertia
    joint_impedance = np.asarray(model.joint_impedance)
    hub_angle = state.hub_angle
    hub_rate = state.hub_rate
    angle = np.asarray(state.angle)
    rate = np.asarray(state.rate)
    acceleration = np.asarray(state.acceleration)
    numbers = (
        *base_angle,
        *base_angle_rate,
        *base_angle_acceleration,
        length,
        mass,
        tip_mass,
        tip_inertia,
        angle_per_acceleration,
        rate_per_acceleration,
        step_1_over_2,
        step2_3_over_16,
        step_3_over_4,
        step2_17_over_200,
        step_17_over_50,
        step2_21_over_400,
        step_1_over_25,
        step_21_over_100,
        step2_371_over_5440,
        step_371_over_1360,
        step2_137_over_10880,
        step_137_over_2720,
        step2_151_over_2176,
        step_15_over_544,
        step_151_over_544,
        step2_25_over_96,
        step_25_over_24,
        step2_49_over_192,
        step_49_over_48,
        step2_125_over_64,
        step_125_over_16,
        step2_41_over_24,
        step_85_over_12,
        step_41_over_6,
        carried_mass,
        inner_mass,
        pin_inertia,
        hub_angle,
        hub_rate,
    )
    arrays = (stiffness, damping, joint_impedance, angle, rate, acceleration)
    batch, dtype = _common(numbers, arrays)
    stiffness = _align(stiffness, batch)
    damping = _align(damping, batch)
    joint_impedance = _align(joint_impedance, batch)
    hub_angle = _spread(hub_angle, batch, False)
    hub_rate = _spread(hub_rate, batch, False)
    angle = _spread(angle, batch, True)
    rate = _spread(rate, batch, True)
    acceleration = _spread(acceleration, batch, True)
    acceleration_x = np.zeros((STATIONS + 1, *batch), dtype)
    acceleration_y = np.zeros((STATIONS + 1, *batch), dtype)
    answer_from_inner = np.zeros((STATIONS, *batch), dtype)
    answer_own = np.zeros((STATIONS, *batch), dtype)
    answer_x = np.zeros((STATIONS, *batch), dtype)
    answer_y = np.zeros((STATIONS, *batch), dtype)
    predicted_acceleration = np.zeros((STATIONS + 1, *batch), dtype)
    predicted_angle = np.zeros((STATIONS + 1, *batch), dtype)
    predicted_rate = np.zeros((STATIONS + 1, *batch), dtype)
    solved = np.zeros((STATIONS, *batch), dtype)

    # Stage 1 of 5: predicted motion
    predicted_angle[0] = base_angle[0]
    predicted_rate[0] = base_angle_rate[0]
    predicted_acceleration[0] = base_angle_acceleration[0]
    predicted_angle[1:] = angle + acceleration * angle_per_acceleration + rate * rate_per_acceleration
    predicted_rate[1:] = rate + acceleration * rate_per_acceleration
    predicted_acceleration[1:] = acceleration

    # Stage 1 of 5: accelerations of the nodes
    lever_sine = length * np.sin(predicted_angle[1:])
    lever_cosine = length * np.cos(predicted_angle[1:])
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
    tangential = 1.0 - angle_per_acceleration * (predicted_rate[1:] * predicted_rate[1:])
    turning = angle_per_acceleration * predicted_acceleration[1:] + predicted_rate[1:] * step_1_over_2
    swing_x = -lever_cosine * turning - lever_sine * tangential
    swing_y = lever_cosine * tangential - lever_sine * turning
    joint_torque = damping * (predicted_rate[:50] - predicted_rate[1:]) + stiffness * (
        predicted_angle[:50] - predicted_angle[1:]
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
        good = _positive_pivot(good, pivot, "pivot", j)
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
    stage1_acceleration = predicted_acceleration[1:] + solved
    stage1_rate = predicted_rate[1:] + rate_per_acceleration * solved

    # Stage 2 of 5: predicted motion
    predicted_angle[0] = base_angle[1]
    predicted_rate[0] = base_angle_rate[1]
    predicted_acceleration[0] = base_angle_acceleration[1]
    predicted_angle[1:] = (
        angle
        + rate * rate_per_acceleration
        + stage1_acceleration * step2_3_over_16
        + stage1_rate * step_1_over_2
    )
    predicted_rate[1:] = rate + stage1_acceleration * step_3_over_4
    predicted_acceleration[1:] = stage1_acceleration

    # Stage 2 of 5: accelerations of the nodes
    lever_sine = length * np.sin(predicted_angle[1:])
    lever_cosine = length * np.cos(predicted_angle[1:])
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
    tangential = 1.0 - angle_per_acceleration * (predicted_rate[1:] * predicted_rate[1:])
    turning = angle_per_acceleration * predicted_acceleration[1:] + predicted_rate[1:] * step_1_over_2
    swing_x = -lever_cosine * turning - lever_sine * tangential
    swing_y = lever_cosine * tangential - lever_sine * turning
    joint_torque = damping * (predicted_rate[:50] - predicted_rate[1:]) + stiffness * (
        predicted_angle[:50] - predicted_angle[1:]
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
        good = _positive_pivot(good, pivot, "pivot", j)
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
    stage2_acceleration = predicted_acceleration[1:] + solved
    stage2_rate = predicted_rate[1:] + rate_per_acceleration * solved

    # Stage 3 of 5: predicted motion
    predicted_angle[0] = base_angle[2]
    predicted_rate[0] = base_angle_rate[2]
    predicted_acceleration[0] = base_angle_acceleration[2]
    predicted_angle[1:] = (
        angle
        + rate * rate_per_acceleration
        + stage1_acceleration * step2_17_over_200
        + stage1_rate * step_17_over_50
        + stage2_acceleration * step2_21_over_400
        - stage2_rate * step_1_over_25
    )
    predicted_rate[1:] = rate + stage1_acceleration * step_17_over_50 + stage2_acceleration * step_21_over_100
    predicted_acceleration[1:] = stage2_acceleration

    # Stage 3 of 5: accelerations of the nodes
    lever_sine = length * np.sin(predicted_angle[1:])
    lever_cosine = length * np.cos(predicted_angle[1:])
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
    tangential = 1.0 - angle_per_acceleration * (predicted_rate[1:] * predicted_rate[1:])
    turning = angle_per_acceleration * predicted_acceleration[1:] + predicted_rate[1:] * step_1_over_2
    swing_x = -lever_cosine * turning - lever_sine * tangential
    swing_y = lever_cosine * tangential - lever_sine * turning
    joint_torque = damping * (predicted_rate[:50] - predicted_rate[1:]) + stiffness * (
        predicted_angle[:50] - predicted_angle[1:]
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
        good = _positive_pivot(good, pivot, "pivot", j)
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
    stage3_acceleration = predicted_acceleration[1:] + solved
    stage3_rate = predicted_rate[1:] + rate_per_acceleration * solved

    # Stage 4 of 5: predicted motion
    predicted_angle[0] = base_angle[3]
    predicted_rate[0] = base_angle_rate[3]
    predicted_acceleration[0] = base_angle_acceleration[3]
    predicted_angle[1:] = (
        angle
        + rate * rate_per_acceleration
        + stage1_acceleration * step2_371_over_5440
        + stage1_rate * step_371_over_1360
        - stage2_acceleration * step2_137_over_10880
        - stage2_rate * step_137_over_2720
        + stage3_acceleration * step2_151_over_2176
        + stage3_rate * step_15_over_544
    )
    predicted_rate[1:] = (
        rate
        + stage1_acceleration * step_371_over_1360
        - stage2_acceleration * step_137_over_2720
        + stage3_acceleration * step_151_over_544
    )
    predicted_acceleration[1:] = stage3_acceleration

    # Stage 4 of 5: accelerations of the nodes
    lever_sine = length * np.sin(predicted_angle[1:])
    lever_cosine = length * np.cos(predicted_angle[1:])
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
    tangential = 1.0 - angle_per_acceleration * (predicted_rate[1:] * predicted_rate[1:])
    turning = angle_per_acceleration * predicted_acceleration[1:] + predicted_rate[1:] * step_1_over_2
    swing_x = -lever_cosine * turning - lever_sine * tangential
    swing_y = lever_cosine * tangential - lever_sine * turning
    joint_torque = damping * (predicted_rate[:50] - predicted_rate[1:]) + stiffness * (
        predicted_angle[:50] - predicted_angle[1:]
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
        good = _positive_pivot(good, pivot, "pivot", j)
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
    stage4_acceleration = predicted_acceleration[1:] + solved
    stage4_rate = predicted_rate[1:] + rate_per_acceleration * solved

    # Stage 5 of 5: predicted motion
    predicted_angle[0] = base_angle[4]
    predicted_rate[0] = base_angle_rate[4]
    predicted_acceleration[0] = base_angle_acceleration[4]
    predicted_angle[1:] = (
        angle
        + rate * rate_per_acceleration
        + stage1_acceleration * step2_25_over_96
        + stage1_rate * step_25_over_24
        - stage2_acceleration * step2_49_over_192
        - stage2_rate * step_49_over_48
        + stage3_acceleration * step2_125_over_64
        + stage3_rate * step_125_over_16
        - stage4_acceleration * step2_41_over_24
        - stage4_rate * step_85_over_12
    )
    predicted_rate[1:] = (
        rate
        + stage1_acceleration * step_25_over_24
        - stage2_acceleration * step_49_over_48
        + stage3_acceleration * step_125_over_16
        - stage4_acceleration * step_41_over_6
    )
    predicted_acceleration[1:] = stage4_acceleration

    # Stage 5 of 5: accelerations of the nodes
    lever_sine = length * np.sin(predicted_angle[1:])
    lever_cosine = length * np.cos(predicted_angle[1:])
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
    tangential = 1.0 - angle_per_acceleration * (predicted_rate[1:] * predicted_rate[1:])
    turning = angle_per_acceleration * predicted_acceleration[1:] + predicted_rate[1:] * step_1_over_2
    swing_x = -lever_cosine * turning - lever_sine * tangential
    swing_y = lever_cosine * tangential - lever_sine * turning
    joint_torque = damping * (predicted_rate[:50] - predicted_rate[1:]) + stiffness * (
        predicted_angle[:50] - predicted_angle[1:]
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
        good = _positive_pivot(good, pivot, "pivot", j)
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
    angle = predicted_angle[1:] + angle_per_acceleration * solved
    rate = predicted_rate[1:] + rate_per_acceleration * solved
    acceleration = predicted_acceleration[1:] + solved

    numbers = (hub_angle, hub_rate)
    arrays = (angle, rate, acceleration)
    good = _judged(good, numbers, arrays, "the motion has outgrown the number type")
    return State(
        hub_angle=_kept(_spread(hub_angle, batch, False), good, False),
        hub_rate=_kept(_spread(hub_rate, batch, False), good, False),
        angle=_kept(_spread(angle, batch, True), good, True),
        rate=_kept(_spread(rate, batch, True), good, True),
        acceleration=_kept(_spread(acceleration, batch, True), good, True),
    )


@np.errstate(all="ignore")
def output(model: Model, state: State) -> Output:
    """Read the outputs off a state.

    Parameters
    ----------
    model : Model
        From :func:`prepare`.
    state : State
        At the instant of the outputs.
    """
    length = model.length
    stiffness = np.asarray(model.stiffness)
    damping = np.asarray(model.damping)
    tip_mass = model.tip_mass
    factor_27 = model.factor_27
    factor_28 = model.factor_28
    hub_angle = state.hub_angle
    hub_rate = state.hub_rate
    angle = np.asarray(state.angle)
    rate = np.asarray(state.rate)
    acceleration = np.asarray(state.acceleration)
    numbers = (length, tip_mass, factor_27, factor_28, hub_angle, hub_rate)
    arrays = (stiffness, damping, angle, rate, acceleration)
    batch, _ = _common(numbers, arrays)
    stiffness = _align(stiffness, batch)
    damping = _align(damping, batch)
    hub_angle = _spread(hub_angle, batch, False)
    hub_rate = _spread(hub_rate, batch, False)
    angle = _spread(angle, batch, True)
    rate = _spread(rate, batch, True)
    acceleration = _spread(acceleration, batch, True)

    # tip: position
    tip_x: Any = 0.0
    tip_y: Any = 0.0
    for j in range(STATIONS):
        tip_x = tip_x + length * np.cos(angle[j])
        tip_y = tip_y + length * np.sin(angle[j])

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
            - acceleration[j] * length * np.sin(angle[j])
            - length * (rate[j] * rate[j]) * np.cos(angle[j])
        )
        node_y = (
            node_y
            + acceleration[j] * length * np.cos(angle[j])
            - length * (rate[j] * rate[j]) * np.sin(angle[j])
        )
        reaction_x = reaction_x - factor_27 * inner_x + factor_28 * node_x
        reaction_y = reaction_y - factor_27 * inner_y + factor_28 * node_y
    reaction_x = reaction_x + node_x * tip_mass
    reaction_y = reaction_y + node_y * tip_mass

    # drive: torque
    drive = damping[0] * (rate[0] - hub_rate) + stiffness[0] * (angle[0] - hub_angle)
    return Output(
        tip_x=_spread(tip_x, batch, False),
        tip_y=_spread(tip_y, batch, False),
        tip_angle=_spread(tip_angle, batch, False),
        reaction_x=_spread(reaction_x, batch, False),
        reaction_y=_spread(reaction_y, batch, False),
        drive=_spread(drive, batch, False),
    )


_advance = step  # an argument of simulate has the name


def simulate(
    duration: float,
    inputs: Mapping[str, ArrayLike | Callable[[float], ArrayLike]] | None = None,
    params: Params = Params(),
    step: float = STEP,
    *,
    initial_angle: ArrayLike = INITIAL_ANGLE,
    initial_rate: ArrayLike = INITIAL_RATE,
) -> Result:
    """Simulate from time zero in whole steps.

    Parameters
    ----------
    duration : float
        Time to simulate (s); the last instant is the last whole step within it.
    inputs : mapping from str
        Constants of shape ``(*batch)``, or functions of time (s) that return them; inputs not named are zero.
        Where ``base_angle`` is a function and ``base_angle_rate`` or ``base_angle_acceleration`` is not
        named, it is what differences of the function over a fraction of the step give.
    params : Params
        Physical parameters.
    step : float
        Time step (s).
    initial_angle : number, or array_like, shape (50, *batch)
        Angles to start from (rad).
    initial_rate : number, or array_like, shape (50, *batch)
        Rates to start from (rad/s).

    Raises
    ------
    FloatingPointError
        If an argument or an input is not finite.
    ValueError
        If shapes do not fit, an input has no such name, or there is no time to simulate.
    VanishingPivotError
        If parameters or step leave a pivot that is not positive.
    """
    if np.ndim(step) != 0 or not step > 0.0:
        raise ValueError(f"step must be one positive number, not {step!r}")
    if not 0.0 <= duration < np.inf:
        raise ValueError(f"duration must be a time, not {duration!r}")
    given = dict(inputs or {})
    if unknown := sorted(set(given) - set(INPUT_NAMES)):
        known = ", ".join(INPUT_NAMES) or "none"
        raise ValueError(f"no input is named {', '.join(unknown)}; there are: {known}")
    if callable(angle := given.get("base_angle")):
        given.setdefault("base_angle_rate", _difference(angle, 1, step / 4.0))
        given.setdefault("base_angle_acceleration", _difference(angle, 2, step / 4.0))

    def read(time: float) -> Input:
        return Input(**{name: value(time) if callable(value) else value for name, value in given.items()})

    model = prepare(params, step)
    state = initialise(params, read(0.0), initial_angle=initial_angle, initial_rate=initial_rate)
    rows = [output(model, state)]
    times = step * np.arange(int(np.floor(duration / step * (1.0 + 1e-12))) + 1)
    for index, time in enumerate(times[:-1].tolist()):
        instants = STAGE_INSTANTS[min(index, len(STAGE_INSTANTS) - 1)]
        state = _advance(model, state, [read(time + instant * step) for instant in instants])
        rows.append(output(model, state))
    outputs = {name: _series([getattr(row, name) for row in rows]) for name in OUTPUT_NAMES}
    return Result(times, outputs, state)


def _difference(angle: Callable[[float], ArrayLike], order: int, apart: float) -> Callable[[float], ArrayLike]:
    """Differentiate a function of time by fourth-order differences; at time zero they look forward only."""
    central = {1: (1.0, -8.0, 0.0, 8.0, -1.0), 2: (-1.0, 16.0, -30.0, 16.0, -1.0)}[order]
    forward = {1: (-25.0, 48.0, -36.0, 16.0, -3.0), 2: (35.0, -104.0, 114.0, -56.0, 11.0)}[order]

    def derivative(time: float) -> ArrayLike:
        weights, first = (central, time - 2.0 * apart) if time >= 2.0 * apart else (forward, time)
        values = [weight * np.asarray(angle(first + k * apart)) for k, weight in enumerate(weights)]
        return sum(values) / (12.0 * apart**order)

    return derivative


def _array(value: ArrayLike, length: int | None, what: str) -> Array:
    """Check what a user gives: a number for each arm if length is None, else an array over stations."""
    array = np.asarray(value)
    if array.dtype.kind in "biu":
        array = array.astype(float)
    if array.dtype.kind not in "fcO":
        raise TypeError(f"{what} must be numeric, not {value!r}")
    if length is not None and array.ndim == 0:
        array = np.full(length, array)
    if length is not None and array.shape[0] != length:
        expected = f"shape ({length}, *batch), or be one number"
        raise ValueError(f"{what} must have {expected}; it has shape {array.shape}")
    finite = _finite(array)
    if array.size and not np.any(finite if length is None else finite.all(axis=0)):
        raise FloatingPointError(f"{what} must be finite, not {value!r}")
    return array


def _finite(value: Any) -> Array:
    """Return which numbers are finite; of numbers that are objects nobody knows."""
    array = np.asarray(value)
    return np.ones(array.shape, dtype=bool) if array.dtype.kind == "O" else np.isfinite(array)


def _positive(step: Array) -> Any:
    """Return for which arms the time step is positive."""
    good = np.asarray(step > 0.0)
    if step.size and not good.any():
        raise ValueError(f"step must be positive, not {step}")
    return good


def _judged(good: Any, numbers: tuple[Any, ...], arrays: tuple[Any, ...], what: str) -> Any:
    """Return which arms are good so far and have only numbers that are finite; leave if there are none."""
    for number in numbers:
        good = good & _finite(number)
    for array in arrays:
        good = good & _finite(array).all(axis=0)
    if np.size(good) and not np.any(good):
        raise FloatingPointError(what)
    return good


def _kept(value: Any, good: Any, stations: bool) -> Array:
    """Return a result with NaN for the arms that are not good."""
    array = np.asarray(value)
    if np.all(good):
        return array
    if stations:
        array = _align(array, np.shape(good))
    return np.where(good, array, array.dtype.type(np.nan))


def _common(numbers: tuple[Any, ...], arrays: tuple[Array, ...]) -> tuple[tuple[int, ...], np.dtype[Any]]:
    """Return the shape of the batch and the number type of everything together."""
    single = [np.asarray(number) for number in numbers]
    shapes = {number.shape for number in single} | {array.shape[1:] for array in arrays}
    types = {array.dtype for array in (*single, *arrays)}
    try:
        batch = shapes.pop() if len(shapes) == 1 else np.broadcast_shapes(*shapes)
    except ValueError:
        raise ValueError(f"batch shapes do not fit together: {sorted(shapes)}") from None
    return batch, types.pop() if len(types) == 1 else np.result_type(*types)


def _align(array: Array, batch: tuple[int, ...]) -> Array:
    """Give an array over stations as many axes behind the first as the batch has."""
    missing = len(batch) + 1 - array.ndim
    return array.reshape(array.shape[0], *(1,) * missing, *array.shape[1:]) if missing else array


def _spread(value: Any, batch: tuple[int, ...], stations: bool) -> Array:
    """Return a number for every arm of the batch, or an array over stations for every arm."""
    array = np.asarray(value)
    if array.shape[stations:] == batch:
        return array
    if stations:
        return np.broadcast_to(_align(array, batch), (array.shape[0], *batch))
    return np.broadcast_to(array, batch)


def _stages(input: Input | Sequence[Input], count: int) -> Sequence[Input]:
    """Return the inputs at each stage: one input is held over the step."""
    if isinstance(input, Input):
        return (input,) * count
    if len(input) != count:
        raise ValueError(f"a step takes one input, or one for each of {count} stages; there are {len(input)}")
    return input


def _at_stages(stages: Sequence[Input], name: str) -> tuple[Array, ...]:
    """Return an input at each stage."""
    return tuple(_array(getattr(stage, name), None, f"input {name}") for stage in stages)


def _positive_pivot(good: Any, pivot: Any, name: str, station: int | None) -> Any:
    """Return which arms are good so far and have a positive pivot; leave if there are none."""
    good = good & np.asarray((pivot > 0.0) & (pivot < np.inf))
    if np.size(good) and not np.any(good):
        where = "" if station is None else f" of station {station + 1}"
        raise VanishingPivotError(
            f"{name}{where} must be positive and finite, not {pivot}; check parameters and step"
        )
    return good


def _series(values: list[Array]) -> Array:
    """Put values at all instants together; a batch that came with an input counts from the start."""
    shape = values[-1].shape
    return np.stack([np.broadcast_to(value, shape) for value in values])

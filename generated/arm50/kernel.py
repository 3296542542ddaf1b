# arm50: Stiff arm of fifty links on a servo
#
# Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
# scene digest: 7e2e87b8a48332cf3886a22711bd9428eeea692a0d70cc5ae1662962d37ffc57
# sha256 of the rest of this file: 5ee2b068ac5766e78275a82ce960275b852d5b92d572e01d56ad91203dd6ccdc
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
    rate_per_acceleration : array, shape (*batch)
        Rate per unit of acceleration: step/4 (s).
    half_timestep : array, shape (*batch)
        Step/2 (s).
    angle_per_acceleration : array, shape (*batch)
        Angle per unit of acceleration: step**2/16 (s^2).
    three_quarters_timestep : array, shape (*batch)
        3*step/4 (s).
    predicted_rate_per_stage1_acceleration : array, shape (*batch)
        17*step/50 (s).
    predicted_rate_per_stage2_acceleration : array, shape (*batch)
        21*step/100 (s).
    predicted_angle_per_stage2_rate : array, shape (*batch)
        Step/25 (s).
    predicted_rate_per_stage1_acceleration_2 : array, shape (*batch)
        371*step/1360 (s).
    predicted_rate_per_stage2_acceleration_2 : array, shape (*batch)
        137*step/2720 (s).
    predicted_rate_per_stage3_acceleration : array, shape (*batch)
        151*step/544 (s).
    predicted_angle_per_stage3_rate : array, shape (*batch)
        15*step/544 (s).
    predicted_rate_per_stage1_acceleration_3 : array, shape (*batch)
        25*step/24 (s).
    predicted_rate_per_stage2_acceleration_3 : array, shape (*batch)
        49*step/48 (s).
    predicted_rate_per_stage3_acceleration_2 : array, shape (*batch)
        125*step/16 (s).
    predicted_rate_per_stage4_acceleration : array, shape (*batch)
        41*step/6 (s).
    predicted_angle_per_stage4_rate : array, shape (*batch)
        85*step/12 (s).
    reaction_x_per_acceleration_x : array, shape (*batch)
        Center*mass (N s^2/m).
    reaction_x_per_acceleration_x_2 : array, shape (*batch)
        Mass*(center - 1) (N s^2/m).
    end_mass : array, shape (*batch)
        Mass at the tip less the share of a link beyond it (kg).
    rod_inertia : array, shape (*batch)
        Inertia of a link that masses at its ends leave over (kg m^2).
    joint_impedance : array, shape (50, *batch)
        Torque of a joint per difference of unknowns (kg m^2).
    """

    length: Array
    mass: Array
    stiffness: Array
    damping: Array
    tip_mass: Array
    tip_inertia: Array
    rate_per_acceleration: Array
    half_timestep: Array
    angle_per_acceleration: Array
    three_quarters_timestep: Array
    predicted_rate_per_stage1_acceleration: Array
    predicted_rate_per_stage2_acceleration: Array
    predicted_angle_per_stage2_rate: Array
    predicted_rate_per_stage1_acceleration_2: Array
    predicted_rate_per_stage2_acceleration_2: Array
    predicted_rate_per_stage3_acceleration: Array
    predicted_angle_per_stage3_rate: Array
    predicted_rate_per_stage1_acceleration_3: Array
    predicted_rate_per_stage2_acceleration_3: Array
    predicted_rate_per_stage3_acceleration_2: Array
    predicted_rate_per_stage4_acceleration: Array
    predicted_angle_per_stage4_rate: Array
    reaction_x_per_acceleration_x: Array
    reaction_x_per_acceleration_x_2: Array
    end_mass: Array
    rod_inertia: Array
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
    numbers: tuple[Any, ...] = (step, length, mass, inertia, center, tip_mass, tip_inertia)
    arrays: tuple[Any, ...] = (stiffness, damping)
    batch, _ = _common(numbers, arrays)
    stiffness = _align(stiffness, batch)
    damping = _align(damping, batch)

    # masses at the nodes between links, and what they leave over
    end_mass = tip_mass - mass * (1.0 - center)
    rod_inertia = inertia - center * (length * length) * mass * (1.0 - center)

    # factors of the sweep that do not change from step to step
    joint_impedance = 0.25 * damping * step + 0.0625 * (step * step) * stiffness

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

    numbers = (
        length,
        mass,
        tip_mass,
        tip_inertia,
        rate_per_acceleration,
        half_timestep,
        angle_per_acceleration,
        three_quarters_timestep,
        predicted_rate_per_stage1_acceleration,
        predicted_rate_per_stage2_acceleration,
        predicted_angle_per_stage2_rate,
        predicted_rate_per_stage1_acceleration_2,
        predicted_rate_per_stage2_acceleration_2,
        predicted_rate_per_stage3_acceleration,
        predicted_angle_per_stage3_rate,
        predicted_rate_per_stage1_acceleration_3,
        predicted_rate_per_stage2_acceleration_3,
        predicted_rate_per_stage3_acceleration_2,
        predicted_rate_per_stage4_acceleration,
        predicted_angle_per_stage4_rate,
        reaction_x_per_acceleration_x,
        reaction_x_per_acceleration_x_2,
        end_mass,
        rod_inertia,
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
        rate_per_acceleration=_kept(rate_per_acceleration, good, False),
        half_timestep=_kept(half_timestep, good, False),
        angle_per_acceleration=_kept(angle_per_acceleration, good, False),
        three_quarters_timestep=_kept(three_quarters_timestep, good, False),
        predicted_rate_per_stage1_acceleration=_kept(predicted_rate_per_stage1_acceleration, good, False),
        predicted_rate_per_stage2_acceleration=_kept(predicted_rate_per_stage2_acceleration, good, False),
        predicted_angle_per_stage2_rate=_kept(predicted_angle_per_stage2_rate, good, False),
        predicted_rate_per_stage1_acceleration_2=_kept(predicted_rate_per_stage1_acceleration_2, good, False),
        predicted_rate_per_stage2_acceleration_2=_kept(predicted_rate_per_stage2_acceleration_2, good, False),
        predicted_rate_per_stage3_acceleration=_kept(predicted_rate_per_stage3_acceleration, good, False),
        predicted_angle_per_stage3_rate=_kept(predicted_angle_per_stage3_rate, good, False),
        predicted_rate_per_stage1_acceleration_3=_kept(predicted_rate_per_stage1_acceleration_3, good, False),
        predicted_rate_per_stage2_acceleration_3=_kept(predicted_rate_per_stage2_acceleration_3, good, False),
        predicted_rate_per_stage3_acceleration_2=_kept(predicted_rate_per_stage3_acceleration_2, good, False),
        predicted_rate_per_stage4_acceleration=_kept(predicted_rate_per_stage4_acceleration, good, False),
        predicted_angle_per_stage4_rate=_kept(predicted_angle_per_stage4_rate, good, False),
        reaction_x_per_acceleration_x=_kept(reaction_x_per_acceleration_x, good, False),
        reaction_x_per_acceleration_x_2=_kept(reaction_x_per_acceleration_x_2, good, False),
        end_mass=_kept(end_mass, good, False),
        rod_inertia=_kept(rod_inertia, good, False),
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
    numbers: tuple[Any, ...] = (
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
    arrays: tuple[Any, ...] = (stiffness, damping, initial_angle, initial_rate)
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

    # masses at the nodes between links, and what they leave over
    start_end_mass = tip_mass - mass * (1.0 - center)
    start_rod_inertia = inertia - center * (length * length) * mass * (1.0 - center)

    # predicted motion
    predicted_rate[0] = base_angle_rate[0]
    predicted_angle[0] = base_angle[0]
    predicted_acceleration[0] = base_angle_acceleration[0]
    predicted_rate[1:] = initial_rate
    predicted_angle[1:] = initial_angle
    predicted_acceleration[1:] = 0.0

    # accelerations of the nodes
    lever_cosine = length * np.cos(predicted_angle[1:])
    lever_sine = length * np.sin(predicted_angle[1:])
    square = predicted_rate[1:] * predicted_rate[1:]
    relative_x = -lever_cosine * square - lever_sine * predicted_acceleration[1:]
    relative_y = lever_cosine * predicted_acceleration[1:] - lever_sine * square
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
    joint_torque = damping * (predicted_rate[:50] - predicted_rate[1:]) + stiffness * (
        predicted_angle[:50] - predicted_angle[1:]
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
        good = _positive_pivot(good, pivot, "pivot", j)
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
    length = model.length
    mass = model.mass
    stiffness = np.asarray(model.stiffness)
    damping = np.asarray(model.damping)
    tip_inertia = model.tip_inertia
    rate_per_acceleration = model.rate_per_acceleration
    half_timestep = model.half_timestep
    angle_per_acceleration = model.angle_per_acceleration
    three_quarters_timestep = model.three_quarters_timestep
    predicted_rate_per_stage1_acceleration = model.predicted_rate_per_stage1_acceleration
    predicted_rate_per_stage2_acceleration = model.predicted_rate_per_stage2_acceleration
    predicted_angle_per_stage2_rate = model.predicted_angle_per_stage2_rate
    predicted_rate_per_stage1_acceleration_2 = model.predicted_rate_per_stage1_acceleration_2
    predicted_rate_per_stage2_acceleration_2 = model.predicted_rate_per_stage2_acceleration_2
    predicted_rate_per_stage3_acceleration = model.predicted_rate_per_stage3_acceleration
    predicted_angle_per_stage3_rate = model.predicted_angle_per_stage3_rate
    predicted_rate_per_stage1_acceleration_3 = model.predicted_rate_per_stage1_acceleration_3
    predicted_rate_per_stage2_acceleration_3 = model.predicted_rate_per_stage2_acceleration_3
    predicted_rate_per_stage3_acceleration_2 = model.predicted_rate_per_stage3_acceleration_2
    predicted_rate_per_stage4_acceleration = model.predicted_rate_per_stage4_acceleration
    predicted_angle_per_stage4_rate = model.predicted_angle_per_stage4_rate
    end_mass = model.end_mass
    rod_inertia = model.rod_inertia
    joint_impedance = np.asarray(model.joint_impedance)
    hub_angle = state.hub_angle
    hub_rate = state.hub_rate
    angle = np.asarray(state.angle)
    rate = np.asarray(state.rate)
    acceleration = np.asarray(state.acceleration)
    numbers: tuple[Any, ...] = (
        *base_angle,
        *base_angle_rate,
        length,
        mass,
        tip_inertia,
        rate_per_acceleration,
        half_timestep,
        angle_per_acceleration,
        three_quarters_timestep,
        predicted_rate_per_stage1_acceleration,
        predicted_rate_per_stage2_acceleration,
        predicted_angle_per_stage2_rate,
        predicted_rate_per_stage1_acceleration_2,
        predicted_rate_per_stage2_acceleration_2,
        predicted_rate_per_stage3_acceleration,
        predicted_angle_per_stage3_rate,
        predicted_rate_per_stage1_acceleration_3,
        predicted_rate_per_stage2_acceleration_3,
        predicted_rate_per_stage3_acceleration_2,
        predicted_rate_per_stage4_acceleration,
        predicted_angle_per_stage4_rate,
        end_mass,
        rod_inertia,
        hub_angle,
        hub_rate,
    )
    arrays: tuple[Any, ...] = (stiffness, damping, joint_impedance, angle, rate, acceleration)
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
    answer_own = np.zeros((STATIONS, *batch), dtype)
    answer_x = np.zeros((STATIONS, *batch), dtype)
    answer_y = np.zeros((STATIONS, *batch), dtype)
    predicted_angle = np.zeros((STATIONS + 1, *batch), dtype)
    predicted_rate = np.zeros((STATIONS + 1, *batch), dtype)
    solved = np.zeros((STATIONS, *batch), dtype)
    transmission = np.zeros((STATIONS, *batch), dtype)

    # Stage 1 of 5: predicted motion
    predicted_rate[0] = base_angle_rate[0]
    predicted_angle[0] = base_angle[0]
    predicted_rate[1:] = rate + acceleration * rate_per_acceleration
    predicted_angle[1:] = angle + predicted_rate[1:] * rate_per_acceleration

    # Stage 1 of 5: accelerations of the nodes
    lever_cosine = length * np.cos(predicted_angle[1:])
    lever_sine = length * np.sin(predicted_angle[1:])
    square = predicted_rate[1:] * predicted_rate[1:]
    relative_x = -acceleration * lever_sine - lever_cosine * square
    relative_y = acceleration * lever_cosine - lever_sine * square
    turning = half_timestep * predicted_rate[1:]
    swing_x = -lever_sine - angle_per_acceleration * relative_y - lever_cosine * turning
    swing_y = lever_cosine + angle_per_acceleration * relative_x - lever_sine * turning
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
    joint_torque = damping * (predicted_rate[:50] - predicted_rate[1:]) + stiffness * (
        predicted_angle[:50] - predicted_angle[1:]
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
        good = _positive_pivot(good, pivot, "pivot", j)
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
    stage1_acceleration = acceleration + solved
    stage1_rate = predicted_rate[1:] + rate_per_acceleration * solved

    # Stage 2 of 5: predicted motion
    predicted_rate[0] = base_angle_rate[1]
    predicted_angle[0] = base_angle[1]
    predicted_rate[1:] = rate + stage1_acceleration * three_quarters_timestep
    predicted_angle[1:] = angle + half_timestep * stage1_rate + predicted_rate[1:] * rate_per_acceleration

    # Stage 2 of 5: accelerations of the nodes
    lever_cosine = length * np.cos(predicted_angle[1:])
    lever_sine = length * np.sin(predicted_angle[1:])
    square = predicted_rate[1:] * predicted_rate[1:]
    relative_x = -lever_cosine * square - lever_sine * stage1_acceleration
    relative_y = lever_cosine * stage1_acceleration - lever_sine * square
    turning = half_timestep * predicted_rate[1:]
    swing_x = -lever_sine - angle_per_acceleration * relative_y - lever_cosine * turning
    swing_y = lever_cosine + angle_per_acceleration * relative_x - lever_sine * turning
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
    joint_torque = damping * (predicted_rate[:50] - predicted_rate[1:]) + stiffness * (
        predicted_angle[:50] - predicted_angle[1:]
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
        good = _positive_pivot(good, pivot, "pivot", j)
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
    stage2_acceleration = solved + stage1_acceleration
    stage2_rate = predicted_rate[1:] + rate_per_acceleration * solved

    # Stage 3 of 5: predicted motion
    predicted_rate[0] = base_angle_rate[2]
    predicted_angle[0] = base_angle[2]
    predicted_rate[1:] = (
        rate
        + predicted_rate_per_stage1_acceleration * stage1_acceleration
        + predicted_rate_per_stage2_acceleration * stage2_acceleration
    )
    predicted_angle[1:] = (
        angle
        - predicted_angle_per_stage2_rate * stage2_rate
        + predicted_rate[1:] * rate_per_acceleration
        + predicted_rate_per_stage1_acceleration * stage1_rate
    )

    # Stage 3 of 5: accelerations of the nodes
    lever_cosine = length * np.cos(predicted_angle[1:])
    lever_sine = length * np.sin(predicted_angle[1:])
    square = predicted_rate[1:] * predicted_rate[1:]
    relative_x = -lever_cosine * square - lever_sine * stage2_acceleration
    relative_y = lever_cosine * stage2_acceleration - lever_sine * square
    turning = half_timestep * predicted_rate[1:]
    swing_x = -lever_sine - angle_per_acceleration * relative_y - lever_cosine * turning
    swing_y = lever_cosine + angle_per_acceleration * relative_x - lever_sine * turning
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
    joint_torque = damping * (predicted_rate[:50] - predicted_rate[1:]) + stiffness * (
        predicted_angle[:50] - predicted_angle[1:]
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
        good = _positive_pivot(good, pivot, "pivot", j)
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
    stage3_acceleration = solved + stage2_acceleration
    stage3_rate = predicted_rate[1:] + rate_per_acceleration * solved

    # Stage 4 of 5: predicted motion
    predicted_rate[0] = base_angle_rate[3]
    predicted_angle[0] = base_angle[3]
    predicted_rate[1:] = (
        rate
        + predicted_rate_per_stage1_acceleration_2 * stage1_acceleration
        - predicted_rate_per_stage2_acceleration_2 * stage2_acceleration
        + predicted_rate_per_stage3_acceleration * stage3_acceleration
    )
    predicted_angle[1:] = (
        angle
        + predicted_angle_per_stage3_rate * stage3_rate
        + predicted_rate[1:] * rate_per_acceleration
        + predicted_rate_per_stage1_acceleration_2 * stage1_rate
        - predicted_rate_per_stage2_acceleration_2 * stage2_rate
    )

    # Stage 4 of 5: accelerations of the nodes
    lever_cosine = length * np.cos(predicted_angle[1:])
    lever_sine = length * np.sin(predicted_angle[1:])
    square = predicted_rate[1:] * predicted_rate[1:]
    relative_x = -lever_cosine * square - lever_sine * stage3_acceleration
    relative_y = lever_cosine * stage3_acceleration - lever_sine * square
    turning = half_timestep * predicted_rate[1:]
    swing_x = -lever_sine - angle_per_acceleration * relative_y - lever_cosine * turning
    swing_y = lever_cosine + angle_per_acceleration * relative_x - lever_sine * turning
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
    joint_torque = damping * (predicted_rate[:50] - predicted_rate[1:]) + stiffness * (
        predicted_angle[:50] - predicted_angle[1:]
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
        good = _positive_pivot(good, pivot, "pivot", j)
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
    stage4_acceleration = solved + stage3_acceleration
    stage4_rate = predicted_rate[1:] + rate_per_acceleration * solved

    # Stage 5 of 5: predicted motion
    predicted_rate[0] = base_angle_rate[4]
    predicted_angle[0] = base_angle[4]
    predicted_rate[1:] = (
        rate
        + predicted_rate_per_stage1_acceleration_3 * stage1_acceleration
        - predicted_rate_per_stage2_acceleration_3 * stage2_acceleration
        + predicted_rate_per_stage3_acceleration_2 * stage3_acceleration
        - predicted_rate_per_stage4_acceleration * stage4_acceleration
    )
    predicted_angle[1:] = (
        angle
        - predicted_angle_per_stage4_rate * stage4_rate
        + predicted_rate[1:] * rate_per_acceleration
        + predicted_rate_per_stage1_acceleration_3 * stage1_rate
        - predicted_rate_per_stage2_acceleration_3 * stage2_rate
        + predicted_rate_per_stage3_acceleration_2 * stage3_rate
    )

    # Stage 5 of 5: accelerations of the nodes
    lever_cosine = length * np.cos(predicted_angle[1:])
    lever_sine = length * np.sin(predicted_angle[1:])
    square = predicted_rate[1:] * predicted_rate[1:]
    relative_x = -lever_cosine * square - lever_sine * stage4_acceleration
    relative_y = lever_cosine * stage4_acceleration - lever_sine * square
    turning = half_timestep * predicted_rate[1:]
    swing_x = -lever_sine - angle_per_acceleration * relative_y - lever_cosine * turning
    swing_y = lever_cosine + angle_per_acceleration * relative_x - lever_sine * turning
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
    joint_torque = damping * (predicted_rate[:50] - predicted_rate[1:]) + stiffness * (
        predicted_angle[:50] - predicted_angle[1:]
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
        good = _positive_pivot(good, pivot, "pivot", j)
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
    angle = predicted_angle[1:] + angle_per_acceleration * solved
    rate = predicted_rate[1:] + rate_per_acceleration * solved
    acceleration = solved + stage4_acceleration

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
    reaction_x_per_acceleration_x = model.reaction_x_per_acceleration_x
    reaction_x_per_acceleration_x_2 = model.reaction_x_per_acceleration_x_2
    hub_angle = state.hub_angle
    hub_rate = state.hub_rate
    angle = np.asarray(state.angle)
    rate = np.asarray(state.rate)
    acceleration = np.asarray(state.acceleration)
    numbers: tuple[Any, ...] = (
        length,
        tip_mass,
        reaction_x_per_acceleration_x,
        reaction_x_per_acceleration_x_2,
        hub_angle,
        hub_rate,
    )
    arrays: tuple[Any, ...] = (stiffness, damping, angle, rate, acceleration)
    batch, dtype = _common(numbers, arrays)
    stiffness = _align(stiffness, batch)
    damping = _align(damping, batch)
    hub_angle = _spread(hub_angle, batch, False)
    hub_rate = _spread(hub_rate, batch, False)
    angle = _spread(angle, batch, True)
    rate = _spread(rate, batch, True)
    acceleration = _spread(acceleration, batch, True)
    acceleration_x = np.zeros((STATIONS + 1, *batch), dtype)
    acceleration_y = np.zeros((STATIONS + 1, *batch), dtype)

    # output tip: position
    tip_x: Any = 0.0
    tip_y: Any = 0.0
    for j in range(STATIONS):
        tip_x = tip_x + length * np.cos(angle[j])
        tip_y = tip_y + length * np.sin(angle[j])

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
            - acceleration[j] * length * np.sin(angle[j])
            - length * (rate[j] * rate[j]) * np.cos(angle[j])
        )
        a_y = (
            a_y
            + acceleration[j] * length * np.cos(angle[j])
            - length * (rate[j] * rate[j]) * np.sin(angle[j])
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


def _positive_pivot(
    good: Any, pivot: Any, name: str, station: int | None, batch: tuple[int, ...] | None = None
) -> Any:
    """Return which arms are good so far and have a positive pivot; leave if there are none.

    With a batch given, the pivot may be that of all stations.
    """
    positive = np.asarray((pivot > 0.0) & (pivot < np.inf))
    if batch is not None and positive.ndim > len(batch):
        positive = np.all(positive, axis=0)
    good = good & positive
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

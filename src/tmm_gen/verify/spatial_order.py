"""The order of convergence of an arm in space, on a softened copy of it that starts as the scene does.

As in the plane, springs and dampers are scaled down alike until every vibration is slow, so that the same code makes a
motion whose order shows. All inputs act, as sines whose size is set by what they move.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from dataclasses import replace
from types import ModuleType

import numpy as np
from numpy.typing import NDArray

from tmm_gen.inputs.signals import Signal, Sine
from tmm_gen.reference.spatial_afloat import AfloatArm, joint_mass
from tmm_gen.reference.spatial_arm import WorldArm
from tmm_gen.reference.spatial_given import free_joints
from tmm_gen.reference.spatial_motion import motion, start
from tmm_gen.scene import Scene
from tmm_gen.scene.signal import ACCELERATION, PRESCRIBED, RATE
from tmm_gen.scene.spatial.arm import SpatialArm
from tmm_gen.scene.spatial.reach import longest_way
from tmm_gen.simulate.prescribed import Derivative
from tmm_gen.simulate.trace import BASE
from tmm_gen.verify.asymptotic import asymptotic_order
from tmm_gen.verify.check_row import SLOPE, CheckRow

Array = NDArray[np.float64]

_RATE = 1.0
"""rad/s that all joints together turn at first, beside what the scene says."""
_PULL = 3.0
"""rad/s^2 that each input alone gives the joint it moves most."""
_TURNED = 0.3
"""rad that a prescribed base turns either way."""
_SWING = 8.0
"""rad/s of the inputs."""
_FASTEST = 40.0
"""rad/s of the fastest vibration of the softened arm, and of its fastest decay."""
_COARSEST = 0.008
"""s."""
_STEPS = (32, 64, 128, 256)
_SMALL = 0.01
"""rad; of errors larger than this the order says nothing yet: finer steps are fitted."""
_ROUNDED = 1e-12
"""rad; errors smaller than this are the reference's too: coarser steps are fitted."""


def spatial_slope(scene: Scene, module: ModuleType, facts: dict[str, object]) -> CheckRow:
    """Compare the fitted order of the angles of all joints with the derived one.

    Where the scene takes fewer sweeps than the integrator's order asks for, what they promise stands for that; it may
    be surpassed. So may the order of stages that are solved at once: what iterations leave falls faster than the
    method's own error.

    Parameters
    ----------
    scene : Scene
        Of kind "spatial".
    module : module
        Its generated NumPy package.
    facts : dict
        Receives ``fitted_order`` and ``derived_order``.
    """
    from tmm_gen.derive.integrators.order import order
    from tmm_gen.derive.integrators.registry import integrator

    assert scene.spatial is not None
    method = integrator(scene.integrator.name, **scene.integrator.parameters)
    whole = order(method)
    derived = promised(scene, whole, len(module.STAGE_INSTANTS[-1]))
    surpassed = derived < whole or method.main.coupled

    def lacks(slope: float) -> float:
        return max(0.0, derived - slope) if surpassed else abs(slope - derived)

    fitted, counts = fitted_order(scene.spatial, module, lambda slope: lacks(slope) <= SLOPE)
    facts |= {"derived_order": derived, "fitted_order": fitted}
    return CheckRow(
        "order_against_derived",
        lacks(fitted),
        SLOPE,
        f"error goes with step^{fitted:.3f}, fitted on {len(counts)} steps from "
        f"{_COARSEST * _STEPS[0] / counts[0]:g} s down on the arm "
        f"with softened joints; derived: step^{derived}",
    )


def promised(scene: Scene, whole: int, stages: int) -> int:
    """Return the order that a scene's sweeps leave of an integrator's.

    Each inertial one is worth one, and so is a prediction with the newest acceleration, which steps of several stages
    make.
    """
    sweeps = scene.model.sweeps + (stages > 1)
    return whole if scene.model.linearisation == "newton" else min(whole, sweeps)


def fitted_order(
    arm: SpatialArm, module: ModuleType, holds: Callable[[float], bool] = lambda slope: True
) -> tuple[float, tuple[int, ...]]:
    """Return the order of a kernel's angles, and over how many steps each the same time was gone through for it.

    Parameters
    ----------
    holds : callable
        Whether an order is what is expected; steps are shortened until it is, or stays what it is.

    Raises
    ------
    ArithmeticError
        If the motion breaks off at the finest steps too.
    """
    moving = started(softened(arm))
    loads = swings(moving)
    times: Array = _COARSEST * np.arange(1, _STEPS[0] + 1, dtype=float)
    exact = motion(moving, loads, times)[0]

    def error(steps: int) -> float:
        stride, wider = max(1, steps // _STEPS[0]), max(1, _STEPS[0] // steps)
        found = _angles(module, moving, loads, float(times[-1]) / steps, steps)
        return float(np.max(np.abs(found[stride - 1 :: stride] - exact[wider - 1 :: wider])))

    found = asymptotic_order(error, _STEPS, holds, _ROUNDED, _SMALL)
    return found.order, found.counts


def softened(arm: SpatialArm) -> SpatialArm:
    """Return an arm with all springs and dampers scaled down until vibrations and decays are slow."""
    from scipy.linalg import eigh  # slow to import

    world, free = WorldArm(arm), free_joints(arm)
    mass = joint_mass(arm)[np.ix_(free, free)]
    square, decay = (
        float(eigh(np.diag(values[free]), mass, eigvals_only=True)[-1])
        for values in (world.stiffness, world.damping)
    )
    share = 1.0 / max(1.0, square / _FASTEST**2, decay / _FASTEST)
    joints = tuple(
        replace(joint, stiffness=share * joint.stiffness, damping=share * joint.damping)
        for joint in arm.joints
    )
    return replace(arm, joints=joints)


def started(arm: SpatialArm) -> SpatialArm:
    """Return an arm whose joints all turn at first, and whose base does where it floats."""
    more = _RATE / len(arm.joints)
    base = arm.base
    if base is not None:
        x, y, z = base.rate
        base = replace(base, rate=(x + more, y + more, z - more))
    joints = tuple(replace(joint, rate=joint.rate + more) for joint in arm.joints)
    return replace(arm, joints=joints, base=base)


def swings(arm: SpatialArm) -> dict[str, Signal]:
    """Return a sine for each column of the inputs, as large as the arm is heavy."""
    world: WorldArm | AfloatArm = WorldArm(arm) if arm.base is None else AfloatArm(arm)
    q = start(arm)[0]
    free = world.forward_dynamics(q, 0.0 * q, {})
    found: dict[str, Signal] = {}
    for item in (item for item in arm.inputs if item.acts in PRESCRIBED):
        way = _TURNED if item.acts == "angle" else _TURNED * longest_way(arm)
        found[item.name] = Sine(way, _SWING / 2.0)
    for column in (column for item in arm.inputs if item.acts not in PRESCRIBED for column in item.columns):
        moved = float(np.max(np.abs(world.forward_dynamics(q, 0.0 * q, {column: 1.0}) - free)))
        found[column] = Sine(_PULL / moved if moved > 0.0 else 1.0, _SWING, 0.3 * len(found))
    return found


def turned_alike(
    arm: SpatialArm, outputs: Mapping[str, Array], others: Mapping[str, Array]
) -> dict[str, Array]:
    """Return outputs whose orientations have the signs of others': a quaternion and its negative are the same turn."""
    found = dict(outputs)
    for columns in (output.columns for output in arm.outputs if output.quantity.parts == "wxyz"):
        along = sum((outputs[column] * others[column] for column in columns), np.zeros(()))
        sign = np.where(along < 0.0, -1.0, 1.0)
        found |= {column: sign * outputs[column] for column in columns}
    return found


def _angles(
    module: ModuleType, arm: SpatialArm, loads: Mapping[str, Signal], step: float, steps: int
) -> Array:
    """Return the angles after each step, (steps, n); where the base floats its place and quaternion first."""
    params = module.Params()
    joints = {"stiffness": [j.stiffness for j in arm.joints], "damping": [j.damping for j in arm.joints]}
    params = replace(
        params,
        **{
            # one number where all joints are alike
            name: np.array(values) if np.ndim(getattr(params, name)) else values[0]
            for name, values in joints.items()
            if hasattr(params, name)
        },
    )

    signals: dict[str, Signal | Derivative] = dict(loads)
    for item in (item for item in arm.inputs if item.acts in PRESCRIBED):
        for order, word in enumerate((RATE, ACCELERATION), start=1):
            signals[item.name + word] = Derivative(loads[item.name], order)

    def given(time: float) -> object:
        return module.Input(**{name: float(signal.at(time)) for name, signal in signals.items()})

    begun: dict[str, object] = {
        "initial_angle": np.array([j.angle for j in arm.joints]),
        "initial_rate": np.array([j.rate for j in arm.joints]),
    }
    if arm.base is not None:
        begun["initial_base_omega"] = np.array(arm.base.rate)
    if "step" in inspect.signature(module.initialise).parameters:
        begun["step"] = step
    model, state = module.prepare(params, step=step), module.initialise(params, given(0.0), **begun)
    own = BASE if arm.base is not None else ()
    found = np.empty((steps, len(own) + len(arm.joints)))
    for index in range(steps):
        instants = module.STAGE_INSTANTS[min(index, len(module.STAGE_INSTANTS) - 1)]
        stages = [given((index + at) * step) for at in instants]
        state = module.step(model, state, stages if len(stages) > 1 else stages[0])
        found[index] = [*(float(getattr(state, name)) for name in own), *state.angle]
    return found

"""The order of convergence of a planar arm's kernel, on a softened copy of its scene.

On the arm itself a step that resolves the fastest vibration is over before anything has turned, and one that does not
shows the integrator's treatment of what it cannot resolve rather than its order. With all springs and dampers scaled
down alike, the same code and the same links make a motion whose every vibration is as slow as its rotation.
"""

from __future__ import annotations

import inspect
from dataclasses import replace
from types import ModuleType

import numpy as np
from numpy.typing import NDArray

from tmm_gen.native.python_module import numpy_module
from tmm_gen.program.build import build_program
from tmm_gen.reference.frequency import fastest_mode
from tmm_gen.reference.planar_arm import Arm
from tmm_gen.scene import Scene
from tmm_gen.verify.asymptotic import asymptotic_order
from tmm_gen.verify.check_row import SLOPE, CheckRow

Array = NDArray[np.float64]

RATE = 1.0
"""rad/s at which all links turn at first."""
_FASTEST = 40.0
"""rad/s of the fastest vibration of the softened arm, and of its decay."""
_COARSEST = 0.004
"""s."""
_STEPS = (64, 128, 256, 512)
_SMALL = 0.01
"""rad; of errors larger than this the order says nothing yet: finer steps are fitted."""
_ROUNDED = 1e-13
"""rad; of errors smaller than this rounding is a part: coarser steps are fitted."""
_ITERATIONS = 5
"""Of coupled stages: as many as leave nothing that the order could be told from."""
_STEADY = 1e-10
"""rad; a motion this close to constant rates has no order: every integrator steps it exactly."""


def planar_slope(scene: Scene, module: ModuleType, facts: dict[str, object]) -> CheckRow:
    """Compare the fitted order of the angles of all links with the derived one.

    Parameters
    ----------
    scene : Scene
        Of kind "planar".
    module : module
        Its generated NumPy package.
    facts : dict
        Receives ``fitted_order`` and ``derived_order``; the latter alone where links turn at constant rates.
    """
    from tmm_gen.derive.integrators.order import order
    from tmm_gen.derive.integrators.registry import integrator

    method = integrator(scene.integrator.name, **scene.integrator.parameters)
    derived, solved = order(method), ""
    if method.main.coupled and scene.sweeps < _ITERATIONS:
        module, solved = _solved(scene), f" and {_ITERATIONS} iterations"
    soft = softened(scene)
    times: Array = _COARSEST * np.arange(1, _STEPS[0] + 1, dtype=float)
    moving = replace(
        soft, initial=replace(soft.initial, angles=(0.0,) * scene.stations, rates=(RATE,) * scene.stations)
    )
    arm = Arm(moving, {})
    exact = arm.trajectory(float(times[-1])).at(times)[0][:, arm.first :]

    def error(steps: int) -> float:
        step = _COARSEST * _STEPS[0] / steps
        found = _angles(module, soft, step, steps)
        stride, skip = max(steps // _STEPS[0], 1), max(_STEPS[0] // steps, 1)
        return float(np.max(np.abs(found[stride - 1 :: stride] - exact[skip - 1 :: skip])))

    facts["derived_order"] = derived
    if (
        np.max(np.abs(exact - RATE * times[:, None])) < _STEADY
    ):  # one link on a free joint, say, with nothing beyond
        return CheckRow(
            "order_against_derived",
            max(map(error, _STEPS)),
            _STEADY,
            "error in rad where links turn at constant rates: they show no order, and every step of them is exact",
        )
    found = asymptotic_order(error, _STEPS, lambda slope: abs(slope - derived) <= SLOPE, _ROUNDED, _SMALL)
    facts["fitted_order"] = found.order
    return CheckRow(
        "order_against_derived",
        abs(found.order - derived),
        SLOPE,
        f"error goes with step^{found.order:.3f}, fitted on {len(found.counts)} steps from "
        f"{_COARSEST * _STEPS[0] / found.counts[0]:g} s down on the arm "
        f"with softened joints{solved}; derived: step^{derived}",
    )


def _solved(scene: Scene) -> ModuleType:
    """Return the NumPy package of a scene whose coupled stages are solved to the end."""
    iterated = replace(scene, model=scene.model.model_copy(update={"iterations": _ITERATIONS}))
    return numpy_module(iterated, build_program(iterated))


def softened(scene: Scene) -> Scene:
    """Return a scene with all springs and dampers scaled down until the fastest vibration is slow."""
    mode = fastest_mode(scene)
    share = min(1.0, (_FASTEST / mode.frequency) ** 2) if mode.frequency > 0.0 else 1.0
    joints = tuple(
        j.model_copy(update={"stiffness": share * j.stiffness, "damping": share * j.damping})
        for j in scene.joints
    )
    return replace(scene, joints=joints)


def _angles(module: ModuleType, soft: Scene, step: float, steps: int) -> Array:
    """Return the angles after each step, (steps, n), all links turning alike at first, no input acting."""
    params = module.Params()
    joints = {"stiffness": [j.stiffness for j in soft.joints], "damping": [j.damping for j in soft.joints]}
    params = replace(
        params,
        **{
            # one number where all joints are alike
            name: np.array(values) if np.ndim(getattr(params, name)) else values[0]
            for name, values in joints.items()
            if hasattr(params, name)
        },
    )
    given = module.Input(**{item.name: 0.0 for item in soft.inputs})
    start = {"initial_angle": 0.0, "initial_rate": RATE}
    if "step" in inspect.signature(module.initialise).parameters:
        start["step"] = step
    model, state = module.prepare(params, step=step), module.initialise(params, given, **start)
    found = np.empty((steps, soft.stations))
    for index in range(steps):
        state = module.step(model, state, given)
        found[index] = state.angle
    return found

"""By how much a generated step answers its input late."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.arm.arms import arm_of
from tmm_gen.scene import Scene

Array = NDArray[np.float64]


def input_lag(
    scene: Scene, turned: Array, places: dict[str, list[int]], transition: Array, drive: Array
) -> float:
    """Return the share of a step by which an input comes late.

    Integrators whose state holds the last acceleration average it with the new one: part of the momentum a torque
    gives in its step shows in the next one only. That part, over all of it, is the mean delay in steps: half a
    step for Newmark's average acceleration, nothing for Runge-Kutta methods.

    Parameters
    ----------
    scene : Scene
        Whose step it is.
    turned : array, (d,)
        What the angles grow by where the motor turns and nothing bends.
    places : dict from str to list of int
        Where in the state rates and accelerations of hub and links are.
    transition, drive : array, (s, s) and (s,)
        Of one step of the straight arm, by the state and by the motor's torque.
    """
    kept = np.zeros(len(drive))
    kept[places["acceleration"]] = drive[places["acceleration"]]
    inertia = np.asarray(turned @ arm_of(scene).level_mass(), float)
    given = float(inertia @ drive[places["rate"]])
    coming = float(inertia @ (transition @ kept)[places["rate"]])
    share = coming / (given + coming)
    return share if abs(share) > 1e-6 else 0.0

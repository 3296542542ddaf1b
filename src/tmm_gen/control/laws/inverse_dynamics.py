"""The way of a rigid arm along a quintic, with the torques that take it there: what robots' controllers do as a rule.

The joints go from start to goal together, ``r = start + s (goal - start)`` with ``s = 10 t^3 - 15 t^4 + 6 t^5``, so
that rates and accelerations vanish at both ends. Torques are those of Lagrange's equations for the arm that does not
bend, ``tau = m(s) s'' + c(s) s'^2 + d(s) s' + g(s)``; the way lasts as long as the motors' bounds make it.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.arm.arms import arm_of
from tmm_gen.control.goals.way import Way
from tmm_gen.control.task.problem import ControlProblem
from tmm_gen.control.task.terms import Goal
from tmm_gen.scene import Scene

Array = NDArray[np.float64]

SPARED = 0.1
"""Share of a motor's range that the way leaves for what it does not know."""
MOST_SAMPLES = 500
_PLACES = 33


def quintic_way(scene: Scene, problem: ControlProblem, start: Array, goal: Goal) -> Way:
    """Return the shortest way along which all torques stay within nine tenths of their bounds.

    Parameters
    ----------
    scene : Scene
        Of the arm.
    problem : ControlProblem
        Sample time, bounds.
    start : array, (m,)
        Hub angles to go from, rad.
    goal : Goal
        Hub angles to go to, and the torques that hold the arm there.
    """
    arm = arm_of(scene)
    places = np.linspace(0.0, 1.0, _PLACES)
    along = goal.hub - start
    hub, none = start + places[:, None] * along, np.zeros((_PLACES, len(along)))
    ones = none + along
    still, pushed, ahead, back = (
        arm.rigid_torques(hub, rate, acceleration)
        for rate, acceleration in ((none, none), (none, ones), (ones, none), (-ones, none))
    )
    terms = (still, pushed - still, 0.5 * (ahead - back), 0.5 * (ahead + back) - still)

    def way(samples: int) -> Way:
        t, duration = np.arange(samples + 1) / samples, samples * problem.sample_time
        share = t**3 * (10.0 - 15.0 * t + 6.0 * t**2)
        speed = 30.0 * t**2 * (1.0 - t) ** 2 / duration
        growth = 60.0 * t * (1.0 - t) * (1.0 - 2.0 * t) / duration**2
        gravity, inertia, drag, swing = (
            np.column_stack([np.interp(share, places, each) for each in term.T]) for term in terms
        )
        torque = gravity + inertia * growth[:, None] + drag * speed[:, None] + swing * speed[:, None] ** 2
        torque[-1] = goal.torque
        shape = (1, len(along))
        return Way(np.tile(share[:, None], shape), np.tile(speed[:, None], shape), torque)

    low, high = problem.torque
    spared = SPARED * (high - low) / 2.0
    for samples in range(2, MOST_SAMPLES):
        found = way(samples)
        if np.all((found.torque >= low + spared) & (found.torque <= high - spared)):
            return found
    return way(MOST_SAMPLES)

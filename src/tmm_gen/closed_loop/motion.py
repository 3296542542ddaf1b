"""A closed loop as a simulation, to be shown in motion."""

from __future__ import annotations

import numpy as np

from tmm_gen.closed_loop.compare import Trial
from tmm_gen.control.arm.motor_rows import HUB
from tmm_gen.control.arm.motors import motors_of
from tmm_gen.control.plant.plant_scene import plant_scene
from tmm_gen.scene import Scene
from tmm_gen.simulate.simulation import Simulation
from tmm_gen.simulate.trace import Trace


def motion(scene: Scene, trial: Trial) -> Simulation:
    """Return the motion of the arm in a trial, an instant per sample.

    Parameters
    ----------
    scene : Scene
        What the user described.
    trial : Trial
        A controller under a condition.
    """
    arm = plant_scene(scene, trial.condition).replace(title=f"{trial.kind.title}, {trial.condition.title}")
    loop = trial.loop
    trace = Trace.empty(arm, len(loop.states))
    for state in loop.states:
        trace.add(state)
    names = motors_of(arm).names
    tips = {
        _column(names, "tip", k): np.interp(loop.sampled, loop.time, tip) for k, tip in enumerate(loop.tip.T)
    }
    torques = {_column(names, "torque", k): each for k, each in enumerate(loop.torque.T)}
    return Simulation(arm, "c", loop.sampled, tips, torques, None, trace)


def _column(names: tuple[str, ...], what: str, k: int) -> str:
    """Return the name of a column; the tip of an arm on a hub is the only one."""
    return what if names == (HUB,) and what == "tip" else f"{names[k]}_{what}"

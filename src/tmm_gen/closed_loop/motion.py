"""A closed loop as a simulation, to be shown in motion."""

from __future__ import annotations

import numpy as np

from tmm_gen.closed_loop.compare import Trial
from tmm_gen.closed_loop.plant import plant_scene
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
    angles = np.interp(loop.sampled, loop.time, loop.tip)
    return Simulation(arm, "c", loop.sampled, {"tip": angles}, {"hub_torque": loop.torque}, None, trace)

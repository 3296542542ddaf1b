"""The simulation of a scene that has a tolerance: steps of any length, rows at instants all alike."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from tmm_gen.inputs.signals import Signal
from tmm_gen.scene import Scene
from tmm_gen.simulate.adaptive.passes import Kept, kept
from tmm_gen.simulate.dense import halved
from tmm_gen.simulate.prescribed import followed
from tmm_gen.simulate.settled import outputs_at_rest
from tmm_gen.simulate.simulation import Simulation
from tmm_gen.simulate.stepping import Backend, Stepper
from tmm_gen.simulate.substeps import Progress
from tmm_gen.simulate.trace import Trace

Array = NDArray[np.float64]


def simulate_to_tolerance(
    scene: Scene,
    inputs: Mapping[str, Signal],
    time: Array,
    backend: Backend,
    advance: Progress,
    stepper: Stepper,
    *,
    trace: bool,
) -> Simulation:
    """Simulate a scene by steps that its tolerance chooses.

    Parameters
    ----------
    scene : Scene
        With ``integrator.tolerance``.
    inputs : mapping from str to Signal
        All its inputs by name.
    time : array, (r,)
        Instants of the rows, s, from 0 on; the run ends with the last.
    backend : {"numpy", "c"}
        Which kernel.
    advance : callable
        Told the number of rows passed since the last call; below zero where the run is taken again.
    stepper : Stepper
        Has the kernel.
    trace : bool
        Keep angles and rates of all links too.

    Raises
    ------
    ToleranceError
        If no run keeps the tolerance.
    """
    until = float(time[-1])
    shown = [0.0, 1.0]

    def show(share: float, number: int) -> None:
        if number > shown[1]:
            advance(-shown[0], f"{scene.name}: run {number}, by what the last one has shown")
            shown[:] = [0.0, number]
        count = share * (len(time) - 1)
        shown[0] += count
        advance(count)

    found = kept(scene, inputs, until, stepper, show)
    states = _rows(found, time)
    outputs = found.kernel.prepared(scene.integrator.step).outputs(states)
    motion = None
    if trace:
        motion = Trace.empty(scene, len(time))
        motion.extend(states)
    last = found.march.states[-1]
    return Simulation(
        scene=scene,
        backend=backend,
        time=time,
        outputs=outputs,
        inputs={name: signal.at(time) for name, signal in inputs.items()},
        rest=outputs_at_rest(scene, inputs, until),
        trace=motion,
        accuracy=found.accuracy,
        sweeps_per_step=float(last["sweeps"]) / found.chosen.steps if "sweeps" in last else None,
        chosen=found.chosen,
        notes=tuple(followed(scene, inputs, until)),
    )


def _rows(found: Kept, time: Array) -> dict[str, Array]:
    """Return the states at the instants of the rows."""
    return halved(time, found.march.instants, found.march.stacked)

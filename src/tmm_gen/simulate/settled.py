"""Outputs of what has come to rest."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from tmm_gen.errors import UserError
from tmm_gen.inputs.signals import Constant, Signal
from tmm_gen.reference.assembly import assemble
from tmm_gen.scene import Scene

Array = NDArray[np.float64]

_SHORT = 100
"""Links of a planar arm whose equilibrium is looked for."""


def outputs_at_rest(scene: Scene, signals: Mapping[str, Signal], until: float) -> dict[str, float] | None:
    """Return the outputs at rest under the last values of the inputs; None where there is no such thing.

    Parameters
    ----------
    scene : Scene
        Of any kind; rest of an arm in space is not looked for.
    signals : mapping from str to Signal
        All inputs by name.
    until : float
        End of the run, s.
    """
    if any(signal.ends > until for signal in signals.values()):
        return None
    last = {name: float(signal.at(until)) for name, signal in signals.items()}
    if scene.spatial is not None:
        return None  # its equilibria are not looked for yet
    if not scene.model.linear:
        return _planar_rest(scene, last)
    assembly = assemble(scene)
    if assembly.free:
        return None
    found = assembly.static(np.array(list(last.values())))
    return dict(zip(assembly.outputs, found.tolist(), strict=True))


def _planar_rest(scene: Scene, inputs: Mapping[str, float]) -> dict[str, float] | None:
    """Return the outputs of an arm that hangs still; None where it would turn on, or is too long to be looked at."""
    if scene.hub or scene.stations > _SHORT:
        return None
    from tmm_gen.modal.equilibrium import equilibrium
    from tmm_gen.reference.planar_arm import Arm
    from tmm_gen.reference.planar_reference import read

    try:
        angles = equilibrium(scene, inputs).free_angles[None]
    except UserError:
        return None
    arm = Arm(scene, {name: Constant(value) for name, value in inputs.items()})
    still = np.zeros_like(angles)
    found: dict[str, Array] = {}
    for output in scene.outputs:
        if not scene.quantity(output).accumulates:
            found |= read(arm, output, np.zeros(1), angles, still, still)
    return {name: float(value[0]) for name, value in found.items()}

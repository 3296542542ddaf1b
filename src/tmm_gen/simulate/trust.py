"""What is said of a run's error: how good it is, from what that is known, and why steps were divided."""

from __future__ import annotations

from tmm_gen.simulate.accuracy import SENSITIVE
from tmm_gen.simulate.simulation import Simulation

_BALANCED = 1e-2
"""Imbalance of energies, as a share of what moves, that is worth a word on how the step may cause it."""


def divided(simulation: Simulation) -> str:
    """Say that the steps of a run were divided, and why."""
    substeps, step = simulation.substeps, simulation.scene.integrator.step
    return (
        f"took {substeps.count} substeps per step: at the scene's step of {step:g} s {substeps.because} "
        f"(which --step {step:g} refuses)"
    )


def trusted(simulation: Simulation) -> str:
    """Say how good a run is, and from what that is known; nothing where it was not judged."""
    accuracy = simulation.accuracy
    if accuracy is None:
        return ""
    said = [f"accurate to about {share(accuracy.error)} of the motion{_why(simulation)}"]
    if accuracy.sensitivity is not None and accuracy.sensitivity > SENSITIVE:
        said.append(
            f"the motion is sensitive: a small disturbance of its start grows {accuracy.sensitivity:.0e}-fold, so that "
            "another machine may see another one"
        )
    if simulation.imbalance:
        said.append(
            _balance(simulation.imbalance, simulation.scene.integrator.step / simulation.substeps.count)
        )
    return "\n".join(said)


def _why(simulation: Simulation) -> str:
    """Name the figures behind the accuracy."""
    if simulation.unsolved is None:
        return ""
    left = f"{simulation.unsolved:.0e} of the energy" if simulation.unsolved else "nothing but rounding"
    sweeps = simulation.sweeps_per_step
    of = "substep" if simulation.substeps.count > 1 else "step"
    count = f" ({sweeps:.3g} a {of})" if sweeps is not None else ""
    return f" (the {of} errs by {simulation.step_error:.0e} per radian; sweeps{count} left {left} unsolved)"


def _balance(imbalance: float, step: float) -> str:
    said = f"work, energy and heat balance to {imbalance:.1e}"
    if imbalance <= _BALANCED:
        return said
    return (
        f"{said}: the step is long for this arm, or the integrator damps it; --step {step / 10:g} would tell"
    )


def share(error: float) -> str:
    """Return a share in words that a reader takes in at once."""
    return (
        f"{100.0 * error:.2g} %" if error >= 1e-3 else f"{error:.0e}" if error > 1e-13 else "the last digits"
    )

"""Telling that the simulation of a planar arm has lost the motion, and why."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from tmm_gen.scene import Scene
from tmm_gen.simulate.divergence import DivergedError, integrator_cause
from tmm_gen.simulate.too_long import TooLongError

Array = NDArray[np.float64]

TURN = math.pi
"""rad; a link that turns farther within one step is no motion a step can follow."""

START_TURN = (0.5, 1.0)
"""rad; a scene that starts faster than this per step is refused, with one sweep per stage and with more."""


@dataclass(eq=False)
class PlanarWatch:
    """Looks at each step how far the links turn.

    Parameters
    ----------
    scene : Scene
        What is simulated.
    step : float
        s.
    """

    scene: Scene
    step: float
    _before: Array | None = field(default=None, repr=False)

    def look(self, time: float, angles: Array) -> None:
        """Raise if a link, in space a joint, has turned by more than `TURN` since the last look, a step ago.

        Raises
        ------
        DivergedError
            With time, link or joint, cause and remedy.
        """
        before = np.array(self.scene.initial.angles) if self._before is None else self._before
        turned = np.abs(angles - before)
        for number, joint in enumerate(self.scene.spatial.joints if self.scene.spatial else ()):
            if joint.given:  # wherever its input has it
                turned[number] = 0.0
        self._before = np.array(angles)
        if turned.max() <= TURN:  # false for what is no number
            return
        worst = int(np.argmax(np.where(np.isnan(turned), np.inf, turned)))
        value = float(turned[worst])
        how = f"turns by {value:.1e} rad in one step" if math.isfinite(value) else "is no longer finite"
        arm = self.scene.spatial
        one, which = (
            (f"link {worst + 1}", f"link {worst + 1} of {self.scene.stations}")
            if arm is None
            else (f"joint '{arm.joints[worst].name}'",) * 2
        )
        raise DivergedError(
            f"scene '{self.scene.name}': the simulation has diverged: at t = {time:.6g} s {which} {how}.\n"
            f"{self.cause()}",
            reason=f"{one} {how} at t = {time:.3g} s",
        )

    def cause(self) -> str:
        """Say why, as far as linearisation and integrator tell, and what to do."""
        linearisation = self.scene.model.linearisation
        if linearisation == "frozen":
            return (
                "Cause: linearisation = 'frozen' takes the direction of each link from the prediction, so that the "
                "inertia of the links beyond it acts a step late, which no step is small enough for. "
                "Use --set model.linearisation=newton."
            )
        if linearisation == "taylor":
            return (
                "Cause: linearisation = 'taylor' integrates places apart from angles; at small steps they drift "
                "from each other. Take larger steps, or use --set model.linearisation=newton."
            )
        told = integrator_cause(self.scene, self.step)
        return told or (
            f"The integrator is within its limits: a step of {self.step:g} s is too long for the speed of the "
            f"arm or for a sudden load. Try --step {self.step / 10:g}{more_sweeps(self.scene)}."
        )


def more_sweeps(scene: Scene) -> str:
    """Return the offer to sweep as often as it takes, where the scene says how often."""
    fixed = scene.model.linearisation == "newton" and not scene.model.auto
    return ", or --iterations auto" if fixed else ""


def free_watch(scene: Scene, step: float) -> PlanarWatch:
    """Watch a planar scene that may start as fast as it likes."""
    return PlanarWatch(scene, step)


def planar_watch(scene: Scene, step: float) -> PlanarWatch:
    """Watch a planar scene.

    Raises
    ------
    TooLongError
        If it starts too fast for its step.
    """
    base = scene.spatial.base if scene.spatial else None
    rates = (*scene.initial.rates, *([math.hypot(*base.rate)] if base else []))
    fastest = max((abs(rate) for rate in rates), default=0.0)
    most = START_TURN[scene.model.auto or scene.model.sweeps + scene.model.corrections > 1]
    turn = fastest * step
    if turn > most:
        raise TooLongError(
            f"scene '{scene.name}': a link starts at {fastest:g} rad/s and would turn by {turn:.3g} rad in "
            f"one step of {step:g} s, more than a step can follow. Use a step below {most / fastest:.1g} s.",
            reason=f"a link would turn by {turn:.3g} rad in the first one",
            times=turn / most,
        )
    return PlanarWatch(scene, step)

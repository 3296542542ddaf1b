"""Telling that a simulation diverges, and why."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.errors import CheckFailed
from tmm_gen.inputs.signals import Signal
from tmm_gen.reference.assembly import assemble
from tmm_gen.reference.frequency import fastest_mode
from tmm_gen.scene import Scene
from tmm_gen.simulate.too_long import TooLongError

Array = NDArray[np.float64]

_FACTOR = 1e6
"""A motion this many times larger than any that the loads can cause is none."""

_PROBES = 1000
"""Instants at which inputs are looked at to find their largest values."""


class DivergedError(CheckFailed, TooLongError):
    """A simulation left all bounds: the message says when, where, why and what to do."""


class BrokenOffError(TooLongError):
    """A step of a simulation cannot be solved.

    Parameters
    ----------
    cause : str
        When and why, a sentence.
    remedy : str
        What to do.
    """

    def __init__(self, cause: str, remedy: str) -> None:
        super().__init__(f"{cause} {remedy}")
        self.cause = cause


@dataclass(frozen=True)
class Watch:
    """Bounds beyond which a motion has diverged.

    Parameters
    ----------
    scene : Scene
        What is simulated.
    step : float
        s.
    bound : float
        rad; `_FACTOR` times an upper estimate of any angle.
    """

    scene: Scene
    step: float
    bound: float

    def look(self, time: float, angles: Array) -> None:
        """Raise if angles, (n,), are beyond all bounds.

        Raises
        ------
        DivergedError
            With time, station, cause and remedy.
        """
        sizes = np.abs(angles)
        if sizes.max() <= self.bound:  # false for what is no number
            return
        worst = int(np.argmax(np.where(np.isnan(sizes), np.inf, sizes)))
        value = angles[worst]
        reached = f"has reached {value:.1e} rad" if math.isfinite(value) else "is no longer a finite number"
        raise DivergedError(
            f"scene '{self.scene.name}': the simulation has diverged: at t = {time:.6g} s the angle of "
            f"station {worst + 1} {reached}.\n{_cause(self.scene, self.step)}"
        )


def watch(scene: Scene, signals: Mapping[str, Signal], until: float, step: float) -> Watch:
    """Estimate how far a scene can turn at most, and watch for angles far beyond."""
    assembly = assemble(scene)
    times = np.linspace(0.0, until, _PROBES)
    largest = {
        name: float(np.max(np.abs(signal.at(np.concatenate([times, signal.knots])))))
        for name, signal in signals.items()
    }
    torque = sum(abs(i.factor) * largest.get(i.name, 0.0) for i in scene.inputs if i.acts == "torque")
    prescribed = sum(largest.get(i.name, 0.0) for i in scene.inputs if i.acts == "angle")
    start, rate = np.max(np.abs(assembly.angle)), np.max(np.abs(assembly.rate))
    reach = start + rate * until + prescribed + torque * sum(1.0 / j.stiffness for j in scene.joints)
    if assembly.free:
        reach += torque * until**2 / (2.0 * float(np.trace(assembly.mass)))
    turns = np.abs([1.0, *scene.turns])
    geared = (np.max(turns) / np.min(turns)) ** 2  # a torque and what it turns may be on any two shafts
    return Watch(scene, step, _FACTOR * max(float(geared * reach), 1e-300))


def _cause(scene: Scene, step: float) -> str:
    """Say why and what to do."""
    told = integrator_cause(scene, step)
    if told is None and scene.model.sweep == "product":
        told = "Cause: the plain product loses its digits. Use --set model.sweep=riccati."
    return told or (
        f"Its integrator is not to blame: a step of {step:g} s is below the limit of {scene.integrator.name}. "
        "Look for a number in the scene or an input of the wrong size."
    )


def integrator_cause(scene: Scene, step: float) -> str | None:
    """Say why, and what to do, if the step is beyond the integrator's limit of stability."""
    from tmm_gen.derive.integrators.amplification import amplification
    from tmm_gen.derive.integrators.registry import integrator
    from tmm_gen.derive.integrators.stability import stability_limit

    chosen = integrator(scene.integrator.name, **scene.integrator.parameters)
    linear = amplification(chosen.main)
    mode = fastest_mode(scene)
    turn = mode.frequency * step
    zeta = float(f"{mode.damping_ratio:.2g}")
    limit = float(stability_limit(linear, zeta))
    fast = f"highest natural frequency of {mode.frequency:.4g} rad/s"
    damped = f" at its damping ratio of {zeta:g}" if zeta else ""
    unlimited = "an integrator without limit: --set integrator.name=newmark"
    if limit == 0.0:
        return (
            f"Cause: without damping, motion grows with {scene.integrator.name} at any step. "
            f"Choose {unlimited}."
        )
    if turn > limit:
        return (
            f"Cause: step x {fast} = {turn:.3g}, beyond the limit {limit:.3g} of {scene.integrator.name}"
            f"{damped}. Use a step below {_rounded_down(limit / mode.frequency):g} s, or {unlimited}."
        )
    return None


def _rounded_down(value: float) -> float:
    """Return two digits of a positive number, never more than it is."""
    unit = 10.0 ** (math.floor(math.log10(value)) - 1)
    return math.floor(value / unit) * unit

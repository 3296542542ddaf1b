"""States between those that steps lead to.

Angle, rate and acceleration at both ends of a step give a polynomial of fifth degree (Hermite). Where a method keeps
accelerations of its stages instead, as Gauss's methods do, it is the polynomial by which the step itself is defined;
and where accelerations belong to other instants, or are those before a blow, one of third degree. Quaternions follow
their rates by third degree and are made units again. Heat climbs through its values and never falls.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.scene import Scene
from tmm_gen.simulate.stages import StagePolynomial, stage_polynomial

Array = NDArray[np.float64]
States = Mapping[str, Array]
"""By name, (k, ...)."""

_AT_END = 1e-9
"""An instant nearer than this share of a step to its end is that end."""

_PLANES = "xyz"
_QUATERNION = tuple(f"base_quaternion_{part}" for part in "wxyz")
_HEAT = "dissipated"
_MOTIONS = (
    ("angle", "rate", "acceleration"),
    ("hub_angle", "hub_rate", "hub_acceleration"),
    *((f"base_place_{x}", f"base_velocity_{x}", f"base_acceleration_{x}") for x in _PLANES),
)


@dataclass(frozen=True)
class Dense:
    """How states of one kernel are interpolated.

    Parameters
    ----------
    settled : bool
        Whether the accelerations of a state are those that the equations ask at its own instant.
    stages : StagePolynomial or None
        Of steps whose stages are solved at once, where their states keep no other acceleration.
    """

    settled: bool
    stages: StagePolynomial | None

    def at(self, instants: Array, times: Array, states: States, kinked: Array | None = None) -> dict[str, Array]:
        """Return the states at some instants.

        Parameters
        ----------
        instants : array, (r,)
            s, within the times.
        times : array, (k,)
            Of the states, s, increasing.
        states : mapping from str to array, (k, ...)
            By name.
        kinked : array of int, optional
            Numbers of the states from which an input goes on from another value than it had.

        Returns
        -------
        dict from str to array, (r, ...)
        """
        first = np.clip(np.searchsorted(times, instants, side="right") - 1, 0, max(len(times) - 2, 0))
        last = np.minimum(first + 1, len(times) - 1)
        spans = times[last] - times[first]
        shares = np.where(spans > 0.0, (instants - times[first]) / np.where(spans > 0.0, spans, 1.0), 0.0)
        settled = np.full(len(instants), self.settled)
        if kinked is not None:
            settled &= ~np.isin(first, kinked)
        ends = {name: (values[first], values[last]) for name, values in states.items()}
        if "turned" in ends:  # whole turns that are kept apart: all by those of the end
            extra = ends["turned"][0] - ends["turned"][1]
            for name in ("angle", "hub_angle"):
                if name in ends:
                    begun, come = ends[name]
                    ends[name] = (begun + _over(extra, begun), come)
            ends["turned"] = (ends["turned"][1],) * 2
        found = self._moving(shares, spans, ends, settled)
        found |= _turning(shares, spans, ends)
        if _HEAT in ends:
            found[_HEAT] = _climbing(instants, times, states[_HEAT])
        for name, (begun, come) in ends.items():
            if name not in found:
                share = _over(shares, begun)
                found[name] = (1.0 - share) * begun + share * come
        # at an end of a step its state is known better than any polynomial has it
        for near, of in ((shares < _AT_END, 0), (shares > 1.0 - _AT_END, 1)):
            for name, values in found.items():
                values[near] = ends[name][of][near]
        return found

    def _moving(
        self, shares: Array, spans: Array, ends: Mapping[str, tuple[Array, Array]], settled: NDArray[np.bool_]
    ) -> dict[str, Array]:
        """Return what has a rate: all three of places, rates and accelerations that states keep."""
        found: dict[str, Array] = {}
        for names in _MOTIONS:
            place, rate, acceleration = names
            if place not in ends or rate not in ends:
                continue
            if self.stages is not None and place in ("angle", "hub_angle"):
                continue
            cubic = hermite(shares, spans, [ends[place], ends[rate]])
            values = cubic
            if acceleration in ends and np.any(settled):
                quintic = hermite(shares, spans, [ends[name] for name in names])
                values = [
                    np.where(_over(settled, five), five, three)
                    for five, three in zip(quintic, cubic, strict=True)
                ]
            found |= {name: v for name, v in zip(names, values, strict=True) if name in ends}
        if self.stages is not None:
            found |= self._collocated(self.stages, shares, spans, ends)
        return found

    def _collocated(
        self, stages: StagePolynomial, shares: Array, spans: Array, ends: Mapping[str, tuple[Array, Array]]
    ) -> dict[str, Array]:
        """Return the motion of the polynomial that meets the equations at all stages of a step."""
        found: dict[str, Array] = {}
        once, twice = (stages.weights(shares, integrals) for integrals in (1, 2))
        there = np.stack([stages.weights(shares * node) for node in stages.nodes])
        for prefix in stages.prefixes:
            names = stages.names(prefix)
            solved = np.stack([ends[name][1] for name in names], axis=1)
            angle, rate = ends[f"{prefix}angle"][0], ends[f"{prefix}rate"][0]
            h = _over(spans, angle)
            come = np.einsum("rs,rs...->r...", twice, solved)
            found[f"{prefix}angle"] = angle + _over(shares, angle) * h * rate + h**2 * come
            found[f"{prefix}rate"] = rate + h * np.einsum("rs,rs...->r...", once, solved)
            # stages of a step that ends there, along the same polynomial
            found |= {
                name: np.einsum("rs,rs...->r...", weights, solved)
                for name, weights in zip(names, there, strict=True)
            }
        return found


def dense(scene: Scene, states: States) -> Dense:
    """Return how states of a scene's kernel are interpolated.

    Parameters
    ----------
    scene : Scene
        Whose integrator.
    states : mapping
        What the kernel's states hold, by name.
    """
    from tmm_gen.simulate.unsolved import equilibrium  # SymPy comes with it

    instant, between = equilibrium(scene)
    stages = None if "acceleration" in states else stage_polynomial(scene, states)
    return Dense(instant == 1.0 and between is None, stages)


def hermite(shares: Array, spans: Array, ends: list[tuple[Array, Array]]) -> list[Array]:
    """Return value, rate and acceleration of the polynomials through values and derivatives at both ends of steps.

    Parameters
    ----------
    shares : array, (r,)
        Where, in steps from the start of the step.
    spans : array, (r,)
        Lengths of the steps, s.
    ends : list of (array, array), each (r, ...)
        Values and first derivatives at start and end, and second ones for the fifth degree.
    """
    (q0, q1), (v0, v1), *rest = ends
    x, h = _over(shares, q0), _over(spans, q0)
    if rest:
        ((a0, a1),) = rest
        d, e, f = q1 - q0 - h * v0 - 0.5 * h**2 * a0, h * (v1 - v0 - h * a0), h**2 * (a1 - a0)
        c = [q0, h * v0, 0.5 * h**2 * a0, 10.0 * d - 4.0 * e + 0.5 * f, -15.0 * d + 7.0 * e - f, 6.0 * d - 3.0 * e + 0.5 * f]
    else:
        d, e = q1 - q0 - h * v0, h * (v1 - v0)
        c = [q0, h * v0, 3.0 * d - e, e - 2.0 * d]
    found = []
    for derivative in range(3):
        value = np.zeros(np.shape(q0))
        for power in range(len(c) - 1, derivative - 1, -1):
            factor = float(np.prod(np.arange(power - derivative + 1, power + 1)))
            value = value * x + factor * c[power]
        found.append(value / h**derivative)
    return found


def _turning(shares: Array, spans: Array, ends: Mapping[str, tuple[Array, Array]]) -> dict[str, Array]:
    """Return the turn of a base that floats in space."""
    if _QUATERNION[0] not in ends:
        return {}
    quaternion = [np.stack([ends[name][of] for name in _QUATERNION], axis=1) for of in (0, 1)]
    omega = [np.stack([ends[f"base_omega_{x}"][of] for x in _PLANES], axis=1) for of in (0, 1)]
    facing = np.where(np.sum(quaternion[0] * quaternion[1], axis=1) < 0.0, -1.0, 1.0)[:, None]
    quaternion[1] = facing * quaternion[1]
    rates = [_rate(q, w) for q, w in zip(quaternion, omega, strict=True)]
    turned, _, _ = hermite(shares, spans, [(quaternion[0], quaternion[1]), (rates[0], rates[1])])
    turned = turned / np.linalg.norm(turned, axis=1, keepdims=True)
    found = dict(zip(_QUATERNION, turned.T.copy(), strict=True))
    for x in _PLANES:
        name, rate = f"base_omega_{x}", f"base_alpha_{x}"
        if rate in ends:
            found[name] = hermite(shares, spans, [ends[name], ends[rate]])[0]
    return found


def _climbing(instants: Array, times: Array, values: Array) -> Array:
    """Return what only grows between its values at some times, by cubics that keep it so."""
    from scipy.interpolate import PchipInterpolator  # slow to import

    if len(times) < 2:
        return np.full(len(instants), float(values[0]))
    found: Array = PchipInterpolator(times, values)(np.clip(instants, times[0], times[-1]))
    return found


def _rate(quaternion: Array, omega: Array) -> Array:
    """Return how quaternions change, (r, 4), by angular velocities in the turning axes, (r, 3)."""
    scalar, vector = quaternion[:, :1], quaternion[:, 1:]
    along = -np.sum(vector * omega, axis=1, keepdims=True)
    found: Array = 0.5 * np.concatenate([along, scalar * omega + np.cross(vector, omega)], axis=1)
    return found


def _over(values: NDArray[np.generic], like: Array) -> NDArray[np.generic]:
    """Give numbers for each instant as many axes as arrays of them have."""
    return values.reshape(values.shape + (1,) * (np.ndim(like) - 1))

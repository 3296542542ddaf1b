"""States between those that steps lead to.

Angle, rate and acceleration at both ends of a step give a polynomial of fifth degree (Hermite). Where a method keeps
accelerations of its stages instead, as Gauss's methods do, it is the polynomial by which the step itself is defined;
and where accelerations belong to other instants, one of third degree. Steps that were taken in two halves have angles
and rates at three instants, which give one of fifth degree whatever the method. Quaternions follow their derivatives in
the same way and are made units again; heat climbs through its values and never falls.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.reference.spatial_turns import conjugate, product
from tmm_gen.scene import Scene
from tmm_gen.simulate.hermite import along, hermite
from tmm_gen.simulate.stages import HUB, StagePolynomial, stage_polynomial

Array = NDArray[np.float64]
States = Mapping[str, Array]
"""By name, (k, ...)."""

_AT_NODE = 1e-9
"""An instant nearer than this share of a step to one whose state is known is that instant."""

_PLANES = "xyz"
_QUATERNION = tuple(f"base_quaternion_{part}" for part in "wxyz")
_OMEGA = tuple(f"base_omega_{x}" for x in _PLANES)
_ALPHA = tuple(f"base_alpha_{x}" for x in _PLANES)
_HEAT = "dissipated"
_MOTIONS = (
    ("angle", "rate", "acceleration"),
    (f"{HUB}angle", f"{HUB}rate", f"{HUB}acceleration"),
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

    def at(self, instants: Array, times: Array, states: States) -> dict[str, Array]:
        """Return the states at some instants.

        Parameters
        ----------
        instants : array, (r,)
            s, within the times.
        times : array, (k,)
            Of the states, s, increasing.
        states : mapping from str to array, (k, ...)
            By name.

        Returns
        -------
        dict from str to array, (r, ...)
        """
        first = np.clip(np.searchsorted(times, instants, side="right") - 1, 0, max(len(times) - 2, 0))
        step = _Step.of(instants, times, states, [first, np.minimum(first + 1, len(times) - 1)])
        found = {} if self.stages is None else self._collocated(self.stages, step)
        for names in _MOTIONS:
            if names[0] in step.values and names[1] in step.values and names[0] not in found:
                data = names if self.settled and names[2] in step.values else names[:2]
                moving = step.through(data)
                found |= {name: v for name, v in zip(names, moving, strict=True) if name in step.values}
        return step.completed(found, instants, times, states, self._spinning(step))

    def _spinning(self, step: _Step) -> list[Array] | None:
        """Return angular accelerations of a base that floats at both ends of the steps, (r, 3); None where unknown."""
        if self.settled and _ALPHA[0] in step.values:
            return step.gathered(_ALPHA)
        if self.stages is None or _ALPHA[0] not in self.stages.moving:
            return None
        solved = [np.stack([step.values[n][-1] for n in self.stages.names(a)], axis=1) for a in _ALPHA]
        return [
            np.stack([values @ self.stages.weights(end)[0] for values in solved], axis=1)
            for end in (0.0, 1.0)
        ]

    def _collocated(self, stages: StagePolynomial, step: _Step) -> dict[str, Array]:
        """Return the motion of the polynomial that meets the equations at all stages of a step."""
        found: dict[str, Array] = {}
        once, twice = (stages.weights(step.shares, integrals) for integrals in (1, 2))
        there = [stages.weights(step.shares * node) for node in stages.nodes]
        motions = {names[-1]: names[:-1] for names in _MOTIONS}
        for newest in stages.moving:
            names = stages.names(newest)
            solved = np.stack([step.values[name][-1] for name in names], axis=1)
            if newest in motions:  # else it is of a turn, which is no sum of these
                q, v = motions[newest]
                h = along(step.spans, solved[:, 0])
                if v in step.values:  # where a base that floats is, and how it moves, need not be kept
                    found[v] = step.values[v][0] + h * _summed(once, solved)
                if q in step.values:
                    gone = along(step.shares, h) * h * step.values[v][0]
                    found[q] = step.values[q][0] + gone + h**2 * _summed(twice, solved)
            found[newest] = _summed(stages.weights(step.shares), solved)
            # stages of a step that ends there, along the same polynomial
            found |= {name: _summed(w, solved) for name, w in zip(names, there, strict=True)}
        return {name: values for name, values in found.items() if name in step.values}


def halved(instants: Array, times: Array, states: States) -> dict[str, Array]:
    """Return the states at some instants, by both halves of the steps together.

    Parameters
    ----------
    instants : array, (r,)
        s, within the times.
    times : array, (2 k + 1,)
        Of the states, s: a step goes from each even one to the next, the odd ones are in the middle.
    states : mapping from str to array, (2 k + 1, ...)
        By name.
    """
    first = 2 * np.clip(np.searchsorted(times[::2], instants, side="right") - 1, 0, (len(times) - 3) // 2)
    step = _Step.of(instants, times, states, [first, first + 1, first + 2])
    found: dict[str, Array] = {}
    for names in _MOTIONS:
        if names[0] not in step.values:
            continue
        angle, rate, acceleration = step.through(names[:2])
        found |= {
            name: v for name, v in zip(names, (angle, rate, acceleration), strict=True) if name in step.values
        }
        # what is read off accelerations at stages is then read off one that is the same at all of them
        found |= {n: acceleration for n in step.values if n.startswith(f"{names[-1]}_stage")}
    return step.completed(found, instants, times, states)


@dataclass(frozen=True, eq=False)
class _Step:
    """The steps in which instants are, all at once.

    Parameters
    ----------
    shares, spans : array, (r,)
        Where in its step each instant is, in steps from the start, and how long that step is, s.
    values : dict
        States at two or three nodes of the steps, equally far apart, by name; (r, ...) each.
    """

    shares: Array
    spans: Array
    values: dict[str, list[Array]]

    @classmethod
    def of(cls, instants: Array, times: Array, states: States, nodes: list[NDArray[np.int_]]) -> _Step:
        """Gather them by the numbers of the states at their nodes."""
        spans = times[nodes[-1]] - times[nodes[0]]
        still = spans <= 0.0
        shares = np.where(still, 0.0, (instants - times[nodes[0]]) / np.where(still, 1.0, spans))
        values = {name: [found[node] for node in nodes] for name, found in states.items()}
        if "turned" in values:  # whole turns that are kept apart: all by those of the end
            end = values["turned"][-1]
            for name in ("angle", f"{HUB}angle"):
                if name in values:
                    whole = zip(values[name], values["turned"], strict=True)
                    values[name] = [angle + along(turned - end, angle) for angle, turned in whole]
            values["turned"] = [end] * len(nodes)
        return cls(shares, spans, values)

    def through(self, names: Sequence[str]) -> list[Array]:
        """Return value, rate and acceleration of the polynomials through a value and its derivatives at all nodes."""
        return hermite(self.shares, self.spans, [self.values[name] for name in names])

    def completed(
        self,
        found: dict[str, Array],
        instants: Array,
        times: Array,
        states: States,
        alphas: list[Array] | None = None,
    ) -> dict[str, Array]:
        """Return the states with all that does not follow from angles and rates, and those at the nodes as they are.

        Parameters
        ----------
        alphas : list of array, (r, 3), optional
            Angular accelerations at the nodes, of a base that floats.
        """
        found |= self._turning(alphas)
        if _HEAT in states:
            found[_HEAT] = _climbing(instants, times, states[_HEAT])
        for name, values in self.values.items():
            if name not in found:
                share = along(self.shares, values[0])
                found[name] = (1.0 - share) * values[0] + share * values[-1]
        # at a node the state is known better than any polynomial has it
        nodes = np.linspace(0.0, 1.0, len(next(iter(self.values.values()))))
        for number, node in enumerate(nodes):
            near = np.abs(self.shares - node) < _AT_NODE
            for name, array in found.items():
                array[near] = self.values[name][number][near]
        return found

    def gathered(self, names: Sequence[str]) -> list[Array]:
        """Return components at the nodes together, (r, components) each."""
        return [np.stack(parts, axis=1) for parts in zip(*(self.values[n] for n in names), strict=True)]

    def _turning(self, alphas: list[Array] | None) -> dict[str, Array]:
        """Return the turn of a base that floats in space."""
        if _QUATERNION[0] not in self.values:
            return {}
        turns, omegas = self.gathered(_QUATERNION), self.gathered(_OMEGA)
        signs = [np.where(np.sum(turns[0] * turn, axis=1) < 0.0, -1.0, 1.0)[:, None] for turn in turns]
        turns = [sign * turn for sign, turn in zip(signs, turns, strict=True)]
        rates = [_rate(turn, omega) for turn, omega in zip(turns, omegas, strict=True)]
        data = [turns, rates]
        if alphas is not None:
            data.append(
                [
                    _rate(rate, omega) + _rate(turn, alpha)
                    for turn, rate, omega, alpha in zip(turns, rates, omegas, alphas, strict=True)
                ]
            )
        turned, turning, _ = hermite(self.shares, self.spans, data)
        size = np.linalg.norm(turned, axis=1, keepdims=True)
        found = dict(zip(_QUATERNION, (turned / size).T.copy(), strict=True))
        # the angular velocity that turns it so; what changes its length is none
        omega = 2.0 * product(conjugate(turned / size), turning / size)[:, 1:]
        return found | dict(zip(_OMEGA, omega.T, strict=True))


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
    settled = instant == 1.0 and between is None
    return Dense(settled, None if settled else stage_polynomial(scene, states))


def _climbing(instants: Array, times: Array, values: Array) -> Array:
    """Return what only grows between its values at some times, by cubics that keep it so."""
    from scipy.interpolate import PchipInterpolator  # slow to import

    if len(times) < 2:
        return np.full(len(instants), float(values[0]))
    found: Array = PchipInterpolator(times, values)(np.clip(instants, times[0], times[-1]))
    return found


def _rate(quaternion: Array, omega: Array) -> Array:
    """Return how quaternions change, (r, 4), by angular velocities in the turning axes, (r, 3)."""
    return 0.5 * product(quaternion, np.insert(omega, 0, 0.0, axis=1))


def _summed(weights: Array, values: Array) -> Array:
    """Return sums over stages, (r, ...), by weights, (r, s), of values, (r, s, ...)."""
    found: Array = np.einsum("rs,rs...->r...", weights, values)
    return found

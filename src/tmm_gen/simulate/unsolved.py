"""What the sweeps of a planar run leave unsolved, weighed by the energy it gives or takes.

A sweep is one Newton iteration on the exact equations of a step. What it leaves of them is a load that nobody put on
the arm, and its work is energy from nowhere. Whether that matters is the energy criterion of nonlinear finite elements
(K. J. Bathe, Finite Element Procedures, 2nd ed. 2014, section 8.4.4), taken over a whole run: the states that kernels
reach are put into Lagrange's equations, which share nothing with the sweep. Of a step with several stages the last is
looked at.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import sympy as sp
from numpy.typing import NDArray

from tmm_gen.derive.integrators.declaration import KINDS, STEP, Kind, Scheme, past, stage
from tmm_gen.derive.integrators.registry import integrator
from tmm_gen.derive.integrators.relations import UNKNOWN, affine_motion
from tmm_gen.derive.integrators.spectrum import spectrum_of
from tmm_gen.inputs.signals import Signal
from tmm_gen.reference.energy import elastic_energy, gravitational_energy, kinetic_energy
from tmm_gen.reference.floating import about_center
from tmm_gen.reference.planar_arm import Arm
from tmm_gen.scene import Scene
from tmm_gen.simulate.step_error import step_error
from tmm_gen.simulate.stepping import EPSILON

Array = NDArray[np.float64]
State = Mapping[str, Any]

_FIRST, _LATER, _KINKS = 20, 400, 50
"""Steps looked at: as many at the beginning and behind each kink of an input (up to so many kinks), where blows are;
and as many spread over the whole run."""

_KEYS: dict[Kind, str] = {"q": "angle", "v": "rate", "a": "acceleration"}


@dataclass(eq=False)
class Unsolved:
    """Looks at some of the steps of a run.

    Parameters
    ----------
    scene : Scene
        Planar, with the linearisation "newton".
    signals : mapping from str to Signal
        Inputs by name.
    steps : int
        Of the whole run.
    real : {"float64", "float32", "compensated"}
        What the kernel computes in: what rounding leaves is not the sweeps' doing.
    """

    scene: Scene
    signals: Mapping[str, Signal]
    steps: int
    real: str = "float64"
    _looks: list[tuple[int, State, State]] = field(default_factory=list, repr=False)

    def instants(self) -> list[int]:
        """Return the steps to look at, counted from 1, in order."""
        spread = np.linspace(1, self.steps, min(_LATER, self.steps)).round().astype(int)
        kinks = np.unique(np.concatenate([[0.0], *(signal.knots for signal in self.signals.values())]))
        begins = (kinks[:_KINKS] / self.scene.integrator.step).astype(int)
        # from the step before the kink on: what comes after it is not to count for what came before
        behind = (begins[:, None] + np.arange(_FIRST + 1)).ravel()
        found = np.union1d(spread, behind)
        return [int(index) for index in found if 1 <= index <= self.steps]

    def look(self, index: int, before: State, after: State) -> None:
        """Take note of the states before and after a step, counted from 1."""
        self._looks.append((index, before, after))

    def share(self) -> float:
        """Return the work of what is left unsolved, as a share of the energy that moves; zero where nothing does.

        Less than what rounding would leave counts as nothing.
        """
        if not self._looks:
            return 0.0
        arm = Arm(self.scene, self.signals)
        indices = np.array([index for index, _, _ in self._looks])
        power, rounding = np.zeros((2, len(indices)))
        instants = list(self._equilibria(arm, indices))
        for times, motion in instants:
            q, v, a = motion["q"], motion["v"], motion["a"]
            left = arm.residual(times, q, v, a)
            power += np.sum(left * v, axis=1) / len(instants)
            rounding += self._rounded(arm, times, motion) / len(instants)
        spans = np.diff(indices, prepend=0) * self.scene.integrator.step
        work = np.max(np.abs(np.cumsum(power * spans)))
        # signs of rounding errors are at random: they add up like their squares
        floor = float(np.sqrt(np.sum((rounding * spans) ** 2)))
        times, motion = instants[-1]
        start = np.array([[0.0] * arm.first + list(self.scene.initial.angles)])
        q = np.concatenate([start, motion["q"]])
        times = np.concatenate([[0.0], times])
        still = np.zeros_like(q)
        base = about_center(arm, 1, motion["q"], motion["v"], motion["a"])
        moved = float(
            np.max(kinetic_energy(arm, times[1:], motion["q"], motion["v"], base))
            + np.ptp(elastic_energy(arm, times, q))
            + np.ptp(gravitational_energy(arm, q, about_center(arm, 0, q, still, still)))
        )
        return max(0.0, float(work) - floor) / moved if moved > 0.0 else 0.0

    def step_error(self) -> float:
        """Return the error that the step leaves by itself (:func:`tmm_gen.simulate.step_error.step_error`)."""
        if not self._looks:
            return 0.0
        arm = Arm(self.scene, self.signals)
        times = np.array([index for index, _, _ in self._looks]) * self.scene.integrator.step
        ends = [_motion(after, arm.first) for _, _, after in self._looks]
        reached = {kind: np.array([motion[kind] for motion in ends]) for kind in ("q", "v")}
        return step_error(arm, times, reached["q"], reached["v"])

    # -- where equations hold -----------------------------------------------------------------------------------

    def _equilibria(self, arm: Arm, indices: Array) -> Iterator[tuple[Array, dict[Kind, Array]]]:
        """Yield times and motions of the coordinates where steps looked at are in balance."""
        step = self.scene.integrator.step
        coupled = self._coupled_stages(arm)
        if coupled is not None:
            yield (indices - 1 + coupled[0]) * step, _stack(coupled[1])
            return
        ends = ([b for _, b, _ in self._looks], [a for _, _, a in self._looks])
        before, after = ([_motion(state, arm.first) for state in states] for states in ends)
        instant, reached = equilibrium(self.scene)
        if reached is not None:
            found = _stack([reached(*pair) for pair in zip(before, after, strict=True)])
            yield (indices - 1 + instant) * step, found
            return
        # the states themselves; two at a time, since some motions alternate from step to step
        yield np.maximum(indices - 1, 0) * step, _stack(before)
        yield indices * step, _stack(after)

    def _coupled_stages(self, arm: Arm) -> tuple[float, list[dict[Kind, Array]]] | None:
        """Return instant and motions of the last stages of coupled schemes that end on none; their states keep all."""
        scheme = integrator(self.scene.integrator.name, **self.scene.integrator.parameters).main
        if not scheme.coupled or scheme.stages[-1].instant == 1:
            return None
        found = []
        for _, before, after in self._looks:
            stages = [_of(after, arm.first, f"acceleration_stage{k + 1}") for k in range(len(scheme.stages))]
            begun = _motion(before, arm.first)
            found.append(_at_last_stage(scheme, self.scene.integrator.step, begun, np.array(stages)))
        return float(scheme.stages[-1].instant), found

    def _rounded(self, arm: Arm, times: Array, motion: Mapping[Kind, Array]) -> Array:
        """Return the power of what rounding leaves of the equations, (k,), W: a last place of each of their terms."""
        q, v, a = (np.abs(motion[kind]) for kind in KINDS)
        largest = np.maximum(q, np.abs(arm.base_motion(times)[0])[:, None])
        stiffness = np.zeros(q.shape[1])
        stiffness[arm.first :] += 2.0 * arm.joints[0]
        inertial = arm.gathered(arm.masses * arm.walked(a + v**2)) + arm.inertias * a
        terms = stiffness * largest + inertial + arm.weight * arm.moments
        return np.asarray(EPSILON[self.real] * np.sum(v * terms, axis=1))


def equilibrium(
    scene: Scene,
) -> tuple[float, Callable[[Mapping[Kind, Any], Mapping[Kind, Any]], dict[Kind, Any]] | None]:
    """Return where in a step the equations of motion hold last, and how the motion there follows from both its ends.

    Returns
    -------
    instant : float
        From the start of the step, in steps.
    reached : callable or None
        From the motions before and after the step; None where the equations hold at its end.
    """
    scheme = integrator(scene.integrator.name, **scene.integrator.parameters).main
    last = len(scheme.stages)
    if all(sp.sympify(scheme.update[kind]) == stage(kind, last) for kind in KINDS):
        return 1.0, None
    return float(scheme.stages[-1].instant), _collocated(scheme, scene.integrator.step)


def _collocated(
    scheme: Scheme, step: float
) -> Callable[[Mapping[Kind, Any], Mapping[Kind, Any]], dict[Kind, Any]]:
    """Solve the update of a scheme with one stage for the motion at that stage."""
    (unknown,) = sp.solve(sp.sympify(scheme.update["a"]) - UNKNOWN, stage("a", 1))
    motion = affine_motion(scheme, 1, "acceleration")
    earlier = [past(kind) for kind in KINDS]
    functions = {
        kind: sp.lambdify(
            [*earlier, UNKNOWN],
            (motion.offset[kind] + motion.gain[kind] * unknown).subs(STEP, step),
        )
        for kind in KINDS
    }

    def reached(before: Mapping[Kind, Any], after: Mapping[Kind, Any]) -> dict[Kind, Any]:
        return {kind: functions[kind](*(before[k] for k in KINDS), after["a"]) for kind in KINDS}

    return reached


def _at_last_stage(
    scheme: Scheme, step: float, before: Mapping[Kind, Array], stages: Array
) -> dict[Kind, Array]:
    """Return the motion at the last stage of a coupled scheme by the accelerations at all of them, (s, k)."""
    spectrum = spectrum_of(scheme)
    row = {"q": spectrum.squared.row(-1), "v": spectrum.matrix.row(-1)}
    weights = {kind: np.array([float(w) for w in found]) for kind, found in row.items()}
    place = before["q"] + float(spectrum.nodes[-1]) * step * before["v"] + step**2 * weights["q"] @ stages
    return {"q": place, "v": before["v"] + step * weights["v"] @ stages, "a": stages[-1]}


def _motion(state: State, first: int) -> dict[Kind, Array]:
    kept = {
        kind: name for kind, name in _KEYS.items() if name in state and f"{'hub_' * first}{name}" in state
    }
    return {kind: _of(state, first, name) for kind, name in kept.items()}


def _of(state: State, first: int, name: str) -> Array:
    """Return a variable of the state, the hub's first."""
    hub = [state[f"hub_{name}"]] if first else []
    return np.array([*hub, *state[name]], float)


def _stack(motions: list[dict[Kind, Any]]) -> dict[Kind, Array]:
    return {kind: np.array([motion[kind] for motion in motions]) for kind in KINDS}

"""One run by steps of chosen lengths: each step is taken whole and in two halves, and the halves are kept.

What the two leave between them tells the error of the halves by the order of the integrator (L. F. Richardson). It is
measured where runs are compared: how far the ends of links are apart, as a share of how far they have come.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from tmm_gen.scene import Scene
from tmm_gen.simulate.adaptive.kernel import AnyLength, State
from tmm_gen.simulate.adaptive.kinks import Kinks
from tmm_gen.simulate.adaptive.length import Ladder, landing
from tmm_gen.simulate.displacement import STILL, extent, lengths, placed
from tmm_gen.simulate.planar_divergence import TURN
from tmm_gen.simulate.substeps import MOST_TO_TAKE
from tmm_gen.simulate.trace import Trace

Array = NDArray[np.float64]

_SEEN = ("angle", "rate", "turned", "hub_angle", "hub_rate", "base_")
"""What the names of states begin with from which angles are read."""

_BRIEF = 1e-4
"""Length of a step that does not move the arm, by that of one that follows whatever a blow may start."""

_ROUNDED = 8.0
"""Last places that a step may be off by rounding."""

_SHORTEST = 1e-12
"""A step that would be shorter than this share of the run leads nowhere."""


class StuckError(ArithmeticError):
    """No step is short enough: the message says when, and why the last one was refused."""


@dataclass(frozen=True)
class Aim:
    """What one run is to keep to.

    Parameters
    ----------
    error : float
        Most that a step may be wrong by, as a share of the motion.
    order : float
        Of the integrator, as far as that is relied upon.
    way : float
        How far the motion goes, as a former run has shown; 0: as far as it has come so far, in a rough run.
    begin : float
        Length of a step that follows whatever a blow may start, s.
    rounding : float
        The last place of one in the numbers computed with.
    """

    error: float
    order: float
    way: float
    begin: float
    rounding: float = 2.0**-52


@dataclass(eq=False)
class March:
    """All steps of a run.

    Parameters
    ----------
    times : list of float
        Start, and ends of steps, s; each step is two halves.
    came : list of float
        Length of the two halves' steps, s, one for each step.
    angle : list of array, (m,)
        At the same instants as `times`, as a trace has them.
    states : list of mapping
        At the start and behind each half step.
    jumps : list of float
        Instants within the run at which an input jumps, s.
    refused : int
        Steps that were not kept.
    """

    times: list[float] = field(default_factory=list)
    came: list[float] = field(default_factory=list)
    angle: list[Array] = field(default_factory=list)
    states: list[State] = field(default_factory=list)
    jumps: list[float] = field(default_factory=list)
    refused: int = 0

    @property
    def instants(self) -> Array:
        """Of the states, s."""
        ends = np.array(self.times)
        found = np.empty(2 * len(ends) - 1)
        found[::2], found[1::2] = ends, 0.5 * (ends[1:] + ends[:-1])
        return found

    @property
    def stacked(self) -> dict[str, Array]:
        """The states together, (k, ...) by name."""
        return {name: np.array([state[name] for state in self.states], float) for name in self.states[0]}


def march(
    scene: Scene,
    kernel: AnyLength,
    kinks: Kinks,
    given: Mapping[str, Array],
    aim: Aim,
    advance: Callable[[float], None],
) -> March:
    """Take steps up to the end of the run, each as long as its error allows.

    Parameters
    ----------
    scene : Scene
        What moves.
    kernel : AnyLength
        Takes steps.
    kinks : Kinks
        Of the inputs, and the end of the run.
    given : mapping
        What the arm starts from where that is not the scene's.
    aim : Aim
        How long steps may be.
    advance : callable
        Told after each step what share of the run that was.

    Raises
    ------
    StuckError
        If no step is short enough.
    """
    return _Marching(scene, kernel, kinks, aim, advance).run(given)


def again(
    scene: Scene, kernel: AnyLength, kinks: Kinks, given: Mapping[str, Array], aim: Aim, whole: March
) -> Array | None:
    """Take the steps of a run whole, and return the angles at their ends, (k + 1, m); None if that fails."""
    state = kernel.start(kinks.read(np.zeros(1), kinks.next(0.0)), given)
    states = [state]
    came: float | None = None
    try:
        for begin, end, length in zip(whole.times[:-1], whole.times[1:], whole.came, strict=True):
            inputs = kinks.read(begin + length * kernel.instants, kinks.next(begin))
            state, came = kernel.step(state, came, length, inputs), length
            if end in whole.jumps:
                state = _settled(kernel, kinks, aim, state, came, end)
            states.append(state)
    except ArithmeticError:
        return None
    return angles(scene, states)


def _settled(kernel: AnyLength, kinks: Kinks, aim: Aim, state: State, came: float, time: float) -> State:
    """Return a state where an input jumps, with the accelerations behind."""
    inputs = kinks.read(np.full(len(kernel.instants), time), kinks.next(time))
    try:
        return kernel.settled(state, came, _BRIEF * aim.begin, inputs)
    except ArithmeticError:  # the next step tells
        return state


def angles(scene: Scene, states: list[State]) -> Array:
    """Return the angles of hub and links, (k, m), as a trace has them."""
    trace = Trace.empty(scene, len(states))
    seen = [name for name in states[0] if name.startswith(_SEEN)]
    trace.extend({name: np.array([state[name] for state in states]) for name in seen})
    return trace.angle


@dataclass(eq=False)
class _Marching:
    """A run under way; fields as of :func:`march`."""

    scene: Scene
    kernel: AnyLength
    kinks: Kinks
    aim: Aim
    advance: Callable[[float], None]

    def run(self, given: Mapping[str, Array]) -> March:
        kinks, until = self.kinks, self.kinks.until
        state = self.kernel.start(kinks.read(np.zeros(1), kinks.next(0.0)), given)
        found = March([0.0], [], [angles(self.scene, [state])[0]], [state])
        self.start = placed(self.scene, found.angle[0][None])
        self.way = max(self.aim.way, STILL * extent(self.scene) if not self.scene.model.linear else 0.0)
        self.most = MOST_TO_TAKE[self.kernel.stepper.backend] // self.scene.stations
        ladder = Ladder(self.scene.integrator.step, self.aim.order)
        time, came, wanted = 0.0, None, self.aim.begin
        while time < until:
            stop = kinks.next(time)
            length, lands = landing(ladder.rung(wanted), stop - time)
            error, ends = self._tried(state, came, time, length, stop)
            if not (error <= 1.0 or (math.isfinite(error) and self._rough(length))):
                found.refused += 1
                wanted = ladder.refused(length, error)
                self._require(wanted, time, error)
                continue
            assert ends is not None
            time = stop if lands else time + length
            wanted, came, state = ladder.accepted(length, wanted, error), 0.5 * length, ends[1]
            if lands and time < until and kinks.jumps(time):
                wanted = min(wanted, self.aim.begin)
                state = ends[1] = _settled(self.kernel, kinks, self.aim, state, came, time)
                found.jumps.append(time)
            found.times.append(time)
            found.came.append(length)
            found.states += ends
            found.angle.append(self.turned)
            self._room(found)
            self.advance(length / until)
        return found

    def _tried(
        self, state: State, came: float | None, time: float, length: float, stop: float
    ) -> tuple[float, list[State] | None]:
        """Take a step whole and in halves; return its error by what it may be, and the states of the halves."""
        half, instants = 0.5 * length, self.kernel.instants
        try:
            whole = self.kernel.step(state, came, length, self.kinks.read(time + length * instants, stop))
            first = self.kernel.step(state, came, half, self.kinks.read(time + half * instants, stop))
            inputs = self.kinks.read(time + half + half * instants, stop)
            second = self.kernel.step(first, half, half, inputs)
        except ArithmeticError:
            return math.inf, None
        found = angles(self.scene, [state, first, second, whole])
        if not np.max(np.abs(np.diff(found[:3], axis=0)), initial=0.0) <= TURN:
            return math.inf, None
        there = placed(self.scene, found[2:])
        way = max(self.way, float(np.max(lengths(there[:, :1] - self.start))))
        apart = float(np.max(lengths(there[:, 0] - there[:, 1])))
        apart = max(apart - _ROUNDED * self.aim.rounding * float(np.max(np.abs(there))), 0.0)
        error = apart / (2.0**self.aim.order - 1.0)
        if not math.isfinite(error):
            return math.inf, None
        share = error / (way * self.aim.error) if error > 0.0 else 0.0
        if share <= 1.0 or self._rough(length):
            self.way, self.turned = way, found[2]
        return share, [first, second]

    def _rough(self, length: float) -> bool:
        """Return whether a step follows all that vibrates, and no more is asked.

        Whoever has hardly moved yet is wrong by a large share of that, be steps as short as they may.
        """
        return self.aim.way == 0.0 and length <= self.aim.begin * (1.0 + 1e-9)

    def _require(self, length: float, time: float, error: float) -> None:
        if length >= _SHORTEST * self.kinks.until:
            return
        why = "no step can be solved" if math.isinf(error) else "no step is short enough"
        raise StuckError(f"at t = {time:.6g} s {why}")

    def _room(self, found: March) -> None:
        if len(found.states) > self.most:
            faster = "; --backend c takes more" if self.kernel.stepper.backend == "numpy" else ""
            raise StuckError(f"at t = {found.times[-1]:.6g} s it has taken {self.most} steps already{faster}")

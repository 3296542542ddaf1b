"""An arm that takes things and lets them go, and a controller that is told of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from tmm_gen.closed_loop.plant import Plant
from tmm_gen.closed_loop.space_plant import SpacePlant
from tmm_gen.control.arm.arms import arm_of
from tmm_gen.control.command import Command, Flags, Status
from tmm_gen.control.condition import Condition
from tmm_gen.control.goals.course import Course
from tmm_gen.control.laws.rti import RealTimeIteration
from tmm_gen.control.task.problem import ControlProblem
from tmm_gen.onboard.native import EmittedController
from tmm_gen.scene import Scene

Array = NDArray[np.float64]

NOISE = 1.0
"""Standard deviation of the encoders' noise, counts."""


@dataclass(frozen=True)
class Loads:
    """What is at the tip, kg, from which sample on."""

    changes: tuple[tuple[int, float], ...]

    def at(self, sample: int) -> float:
        """Return the mass in a sample."""
        return [mass for since, mass in self.changes if since <= sample][-1]


def loads_of(stops: Sequence[tuple[int, int]], gripper: float, objects: Sequence[float]) -> Loads:
    """Return the loads of a way whose stops are in turn for taking and laying down; they change as the arm sets off."""
    changes = [(0, gripper)]
    for number, (_, last) in enumerate(stops[: 2 * len(objects)]):
        taken = objects[number // 2] if number % 2 == 0 else 0.0
        changes.append((last, gripper + taken))
    return Loads(tuple(changes))


@dataclass(frozen=True, eq=False)
class Unfolding(Course):
    """A course of which nobody is told beyond a stop before the arm is to set off from there.

    Parameters
    ----------
    leaves : tuple of int
        Samples at which it sets off.
    """

    leaves: tuple[int, ...]

    def ahead(self, sample: int, count: int) -> Array:
        """Return the angles of so many samples after one, as far as they are known."""
        known = [leave for leave in self.leaves if leave > sample]
        wanted = sample + 1 + np.arange(count)
        return self.at(np.minimum(wanted, known[0]) if known else wanted)


class CarryingPlant(Plant):
    """An arm whose payload changes, with noise on its encoders.

    Parameters
    ----------
    loads : Loads
        At its tip.
    """

    def __init__(self, scene: Scene, problem: ControlProblem, loads: Loads, seed: int) -> None:
        self.loads = loads
        super().__init__(scene, problem, Condition("empty", "empty", loads.at(0) / payload_of(scene)), seed)

    def laden(self, mass: float) -> Scene:
        """Return the scene of the arm with a mass at its tip, kg."""
        assert self.scene.tip is not None
        return replace(self.scene, tip=self.scene.tip.model_copy(update={"mass": mass}))

    def measured(self) -> Array:
        """Return what the sensors show."""
        shown = super().measured()
        count = 2.0 * np.pi / self.problem.encoders
        shown[: len(count)] += np.round(NOISE * self._random.standard_normal(len(count))) * count
        return shown

    def advance(self, torque: Array) -> Array:
        """Let a sample pass."""
        sample = len(self.states)
        mass = dict(self.loads.changes).get(sample) if sample else None  # the first is there from the start
        if mass is not None:
            self.carry(mass)
        return super().advance(torque)

    def carry(self, mass: float) -> None:
        """Carry another mass at the tip, kg, from now on."""
        self.kernel.prepare({"tip_mass": mass}, self.step)


class CarryingSpacePlant(CarryingPlant, SpacePlant):
    """The same in space."""

    def laden(self, mass: float) -> Scene:
        """Return the scene of the arm whose outermost bodies have a mass, kg."""
        return self.scene.replace(**dict.fromkeys(self.payloads, mass))

    def carry(self, mass: float) -> None:
        """Carry another mass, kg, from now on."""
        self.kernel.prepare(self._changes(self.laden(mass)), self.step)


def payload_of(scene: Scene) -> float:
    """Return the mass at the tip of an arm, in space of its first outermost body, kg."""
    if scene.spatial is None:
        assert scene.tip is not None
        return scene.tip.mass
    return float(next(iter(arm_of(scene).payloads().values())))


def carrying_plant(scene: Scene, problem: ControlProblem, loads: Loads, seed: int) -> CarryingPlant:
    """Return the arm of a scene with changing payload."""
    kind = CarryingPlant if scene.spatial is None else CarryingSpacePlant
    return kind(scene, problem, loads, seed)


class Told:
    """A controller that is told what the arm carries."""

    def __init__(self, controller: EmittedController | RealTimeIteration, loads: Loads) -> None:
        self._controller, self._loads, self._sample = controller, loads, 0

    def reset(self) -> None:
        """Forget all measurements."""
        self._controller.reset()
        self._sample = 0

    def follow(self, angles: Array) -> Status:
        """Take a reference, and the load if it is another one now."""
        mass = dict(self._loads.changes).get(self._sample)
        if mass is not None and self._controller.carry(mass) is not Status.OK:
            raise RuntimeError(f"a payload of {mass} kg was refused")
        self._sample += 1
        return self._controller.follow(angles)

    def prepare(self) -> None:
        """Prepare a sample."""
        self._controller.prepare()

    def command(self, measured: Array, valid: Flags | None = None) -> Command:
        """Return the torques for a measurement."""
        return self._controller.command(measured, valid)

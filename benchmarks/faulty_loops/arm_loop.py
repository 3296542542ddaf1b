"""An emitted controller on an arm of several motors, in a plane or in space, through a case of troubles."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray
from support.carrying import CarryingPlant, Loads, carrying_plant, payload_of

from faulty_loops.arm_cases import HEAVIEST, ArmCase, Trouble
from faulty_loops.cases import ADDED, INVALID, STUCK, VALUE
from tmm_gen.control.arm.arms import arm_of
from tmm_gen.control.arm.motors import motors_of
from tmm_gen.control.bench import Bench
from tmm_gen.control.command import Status
from tmm_gen.control.controllers import BY_NAME
from tmm_gen.control.estimators.kalman import present_sensors
from tmm_gen.control.goals.target import rest_with
from tmm_gen.control.laws.linear_mpc import APPROACH_TIME, LinearMpc
from tmm_gen.onboard.emit import LINEAR, emit_controller
from tmm_gen.onboard.native import FLAGS, EmittedController

Array = NDArray[np.float64]

AFTER = 200
"""Calm samples after the last trouble, and as many more as the arm takes for its way as fast as it can and may turn."""
BRAKING = 50
"""Calm samples in which it is to be brought to a stop: one that flies on is not waited for."""
ARRIVED = 0.02
"""Of each joint off its reference, rad."""


@dataclass
class ArmOutcome:
    """What became of a case.

    Parameters
    ----------
    first_ok : int or None
        Calm samples after the last trouble up to the first that is OK.
    last_other, last_off : int
        Up to the last that is not OK, and up to the last at which a joint is more than `ARRIVED` off.
    way : int
        Samples in which the joints come back from where they were farthest off while the arm was brought to a stop, at
        the rates that they may turn at, or linear controllers bring them near, and with the torques that there are:
        it may have been thrown many turns away.
    outside : int
        Torques that are not finite, or out of the bounds that were in force.
    refused : int
        What was told in the end, could be, and was not taken.
    statuses, answers : Counter
        Of torques; of what was told, by function.
    """

    first_ok: int | None = None
    last_other: int = 0
    last_off: int = 0
    way: int = 0
    outside: int = 0
    refused: int = 0
    statuses: Counter[str] = field(default_factory=Counter)
    answers: Counter[str] = field(default_factory=Counter)

    @property
    def samples(self) -> int:
        """Calm samples that there are."""
        return AFTER + self.way


class ArmLoop:
    """An emitted controller on an arm that is finer than its model.

    Parameters
    ----------
    bench : Bench
        Of the scene.
    controller, real : str
        What is emitted.
    flags : sequence of str
        For the compiler.
    """

    def __init__(self, bench: Bench, controller: str, real: str, flags: Sequence[str] = FLAGS) -> None:
        self.bench, self.problem = bench, bench.problem
        name, files = emit_controller(bench, controller, real)
        sensors = present_sensors(bench.problem)
        self.controller = EmittedController(
            name, files, sensors, real, flags=flags, motors=bench.problem.count
        )
        self.fastest = self.problem.hub_rate
        if controller in LINEAR:
            linear = BY_NAME[controller].make(bench)
            assert isinstance(linear, LinearMpc)
            self.fastest = np.minimum(self.fastest, linear.reach / APPROACH_TIME)
        self.carries = f"{name}_carry(" in files[f"{name}.h"]
        self.payload = payload_of(bench.scene)
        self.number = np.float64 if real == "float64" else np.float32
        self.widest = tuple(self.number(each) for each in bench.problem.torque)
        heaviest = carrying_plant(bench.scene, self.problem, Loads(((0, self.payload),)), seed=0).laden(
            HEAVIEST * self.payload
        )
        largest = np.min(np.abs(self.problem.torque), axis=0)
        self.quickest = largest / motors_of(heaviest).inertia(arm_of(heaviest).mass())

    def run(self, case: ArmCase) -> ArmOutcome:
        """Run a case."""
        plant = carrying_plant(self.bench.scene, self.problem, Loads(((0, self.payload),)), seed=0)
        rest = rest_with(plant.laden(self.payload), np.array(case.start), "initial.angles")
        plant.kernel.initialise(initial_angle=rest.angles, inputs=plant.motors.torques(rest.goal.torque))
        self.controller.reset()
        self.limits, found, carried = self.widest, ArmOutcome(), self.payload
        for _ in range(case.before):
            self._sample(plant, plant.measured(), None, found)
        for trouble in case.troubles:
            if trouble.carried is not None:
                carried = trouble.carried * self.payload
                plant.carry(carried)
            self._tell(trouble, found)
            held = plant.measured()
            for _ in range(trouble.samples):
                self._sample(plant, *self._spoilt(plant.measured(), held, trouble), found)
        self._restore(carried, found)
        since = 0
        while since < found.samples:
            since += 1
            status = self._sample(plant, plant.measured(), None, found)
            if status is Status.OK and found.first_ok is None:
                found.first_ok = since
            if status is not Status.OK:
                found.last_other = since
            off = np.abs(plant.angles()[self.problem.count :] - self.problem.reference)
            if not np.max(off) <= ARRIVED:
                found.last_off = since
            if since <= BRAKING:
                # rigid and stretched out with the most it carries, a motor alone: half the way faster, half slower
                needed = np.maximum(off / self.fastest, 2.0 * np.sqrt(off / self.quickest))
                found.way = max(found.way, math.ceil(np.max(needed) / self.problem.sample_time))
        return found

    def _sample(
        self, plant: CarryingPlant, shown: Array, valid: NDArray[np.bool_] | None, found: ArmOutcome
    ) -> Status:
        """Let a sample pass, every other of them prepared; note what is wrong with its torques."""
        if len(plant.states) % 2:
            self.controller.prepare()
        command = self.controller.command(shown, valid)
        low, high = self.limits
        found.outside += not np.all((command.torque >= low) & (command.torque <= high))
        found.statuses[command.status.name.lower()] += 1
        plant.advance(command.torque)
        return command.status

    def _spoilt(self, shown: Array, held: Array, trouble: Trouble) -> tuple[Array, NDArray[np.bool_]]:
        """Return what faulty encoders show, and which are said to be valid."""
        valid = np.ones(len(shown), bool)
        for motor, (kind, value) in enumerate(trouble.faults):
            if kind == STUCK:
                shown[motor] = held[motor]
            elif kind in (VALUE, INVALID):
                shown[motor], valid[motor] = value, kind != INVALID
            elif kind == ADDED:
                shown[motor] += value
        return shown, valid

    def _tell(self, trouble: Trouble, found: ArmOutcome) -> None:
        """Tell the controller all that a trouble has."""
        controller, problem = self.controller, self.problem
        if trouble.limits is not None:
            shares, widest = np.array(trouble.limits), problem.torque[1]
            if self._noted("limit", controller.limit(*(shares * widest)), found):
                low, high = (self.number(each) for each in shares * widest)
                self.limits = np.maximum(low, self.widest[0]), np.minimum(high, self.widest[1])
        if trouble.reference is not None:
            self._noted("aim", controller.aim(np.array(trouble.reference)), found)
        if trouble.jump is not None:
            at, angles = trouble.jump
            way = np.tile(problem.reference, (problem.horizon, 1))
            way[at:] = angles
            self._noted("follow", controller.follow(way), found)
        if trouble.told is not None and self.carries:
            self._noted("carry", controller.carry(trouble.told * self.payload), found)

    def _restore(self, carried: float, found: ArmOutcome) -> None:
        """Tell the controller what is true, and what the scene says; what is judged by the rest a second time."""
        controller = self.controller
        self.limits = self.widest
        taken = [self._noted("limit", controller.limit(*self.problem.torque), found)]
        if self.carries:
            self._noted("carry", controller.carry(carried), found)
        taken.append(self._noted("aim", controller.aim(self.problem.reference), found))
        if self.carries:
            taken.append(self._noted("carry", controller.carry(carried), found))
        found.refused += not all(taken)

    @staticmethod
    def _noted(what: str, status: Status, found: ArmOutcome) -> bool:
        """Count an answer; return whether it was taken."""
        found.answers[f"{what}_{status.name.lower()}"] += 1
        return status is Status.OK

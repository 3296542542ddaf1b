"""A loop in real time around an emitted controller and an arm in C: what the template asks for, and its files."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tmm_gen.c_language.names import bare_names
from tmm_gen.c_language.real import DOUBLE, Real
from tmm_gen.control.plant.plant_scene import steps_of_a_sample
from tmm_gen.emit.c import emit_kernel
from tmm_gen.emit.templates import render
from tmm_gen.onboard.joint_tables import JointTables
from tmm_gen.onboard.loop_arm import LoopArm
from tmm_gen.onboard.sensing_text import SensingText
from tmm_gen.onboard.tables import number, table
from tmm_gen.onboard.text import ControllerText
from tmm_gen.program.build import build_program

LOOP = "example/loop.c"
"""It has a ``main`` of its own."""

PLANT = "plant"
"""Folder of the arm, which is no part of the controller."""

_SECONDS = 3.0
"""How long it runs."""


@dataclass(frozen=True, eq=False)
class LoopText:
    """What the template asks for of the arm, whose numbers are all double.

    Parameters
    ----------
    arm : LoopArm
        That is controlled.
    sensors : tuple of int
        Which the controller reads of m encoders, m accelerometers and m gauges.
    plant : str
        Prefix of the arm's functions.
    stages : int
        How often a step of it reads its inputs.
    bare_names : tuple of str
        Its inputs and outputs whose members have no prefix.
    """

    arm: LoopArm
    sensors: tuple[int, ...]
    plant: str
    stages: int
    bare_names: tuple[str, ...]

    @property
    def real(self) -> Real:
        """Number type of the arm."""
        return DOUBLE

    @property
    def seconds(self) -> float:
        """How long it runs, s."""
        return _SECONDS

    @property
    def steps(self) -> int:
        """Steps of the arm in a sample."""
        return steps_of_a_sample(self.arm.problem)

    @property
    def late(self) -> int:
        """Steps after which torques act."""
        return round(self.arm.problem.delay * self.steps / self.arm.problem.sample_time)

    @property
    def period(self) -> int:
        """A sample, ns."""
        return round(1e9 * self.arm.problem.sample_time)

    @property
    def tips(self) -> NDArray[np.float64]:
        """Rows that give angles of tips by the kernel's, (m, stations)."""
        return self.arm.motors.tip[:, self._hub :]

    @property
    def midway(self) -> NDArray[np.float64]:
        """Reference at first, (m,), rad."""
        return 0.5 * (self.arm.problem.start + self.arm.problem.reference)

    @property
    def encoders(self) -> list[tuple[str, int]]:
        """Of each motor the angle that its encoder shows, an expression of C, and its counts per revolution."""
        shown = []
        for row in self.arm.motors.hub:
            terms = [(self._angle(int(place)), row[place] > 0.0) for place in np.flatnonzero(row)]
            added = " + ".join(term for term, plus in terms if plus)
            shown.append(added + "".join(f" - {term}" for term, plus in terms if not plus))
        return list(zip(shown, map(int, self.arm.problem.encoders), strict=True))

    @property
    def noises(self) -> list[tuple[int, float]]:
        """Places of sensors behind the encoders, and standard deviations of their noise."""
        spreads = np.concatenate([self.arm.problem.accelerometers, self.arm.problem.gauges])
        count = self.arm.problem.count
        return [(at, float(spreads[each - count])) for at, each in enumerate(self.sensors) if each >= count]

    @property
    def sensing(self) -> SensingText:
        """What they show of an arm whose motors are parts."""
        return SensingText(self.arm.sensing, self.sensors)

    @property
    def arm_joints(self) -> JointTables:
        """Where the joints of an arm in space are."""
        assert self.arm.scene.spatial is not None
        return JointTables.of(self.arm.scene.spatial)

    @property
    def spans(self) -> NDArray[np.float64]:
        """Lengths of the links of an arm in a plane, (n,), m."""
        return self.arm.motors.lengths

    @property
    def _hub(self) -> int:
        """How many of the angles are not among those of the kernel's links."""
        return int(self.arm.motors.on_hub)

    def _angle(self, place: int) -> str:
        return "arm.hub_angle" if place < self._hub else f"arm.angle[{place - self._hub}]"

    def number(self, value: float) -> str:
        """Write a number."""
        return number(value, DOUBLE)

    def numbers(self, values: Iterable[float]) -> str:
        """Write a list of numbers."""
        return ", ".join(self.number(float(value)) for value in values)

    def table(self, name: str, values: ArrayLike, dimension: str) -> str:
        """Write a table."""
        return table(name, values, dimension, DOUBLE)


def loop_files(mpc: ControllerText, arm: LoopArm) -> dict[str, str]:
    """Return the loop and the kernel of its arm, texts by path.

    Parameters
    ----------
    mpc : ControllerText
        Of the controller.
    arm : LoopArm
        What it controls here.
    """
    plant = f"{mpc.name}_plant"
    scene = replace(arm.scene, name=plant)
    program = build_program(scene)
    text = LoopText(
        arm=arm,
        sensors=tuple(mpc.data.sensors),
        plant=plant,
        stages=max(len(instants) for instants in program.stage_instants),
        bare_names=tuple(bare_names(program)),
    )
    kernel = emit_kernel(program, scene)
    context = {"mpc": mpc, "name": mpc.name, "NAME": mpc.NAME, "text": text}
    return {
        **{f"{PLANT}/{path.removeprefix('c/')}": each for path, each in kernel.items()},
        LOOP: render("control/loop.c.jinja", **context),
    }

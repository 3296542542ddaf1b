"""What the templates of a nonlinear MPC by real-time iteration ask for."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from tmm_gen.c_language.names import macros
from tmm_gen.c_language.wrap import statement
from tmm_gen.control.arm.motor_rows import Motor
from tmm_gen.control.laws.rti import AWAY, FAR, FAR_AT_WALLS, MOVING, TURNED
from tmm_gen.control.task.terms import Kind
from tmm_gen.onboard.filter_text import FilterText

AIM_TURNS = 12
AIM_TOLERANCE = {"float64": 1e-9, "float32": 1e-4}


@dataclass(frozen=True, eq=False)
class RtiText(FilterText):
    """What the templates of a real-time iteration ask for.

    Parameters
    ----------
    model : str
        Prefix of the kernel.
    stages : int
        Instants of a step at which inputs are read.
    inputs_of_kernel : tuple of str
        Names of the kernel's, in their order. The C asks for none of them by its name, which a macro may have.
    bare_names : list of str
        Inputs and outputs whose members have no prefix.
    many : int, optional
        Directions beyond which the kernel's slopes are gathered first; never, where there is no such number.
    """

    model: str
    stages: int
    inputs_of_kernel: tuple[str, ...]
    bare_names: list[str]
    many: int | None = None

    @property
    def torques_at(self) -> list[int]:
        """Where the motors' torques are among the kernel's inputs, in numbers."""
        return [self.stages * self.inputs_of_kernel.index(name) for name in self.problem.motors.inputs]

    @property
    def moves(self) -> bool:
        """Whether the reference may be another one at run time."""
        return self.several

    @property
    def carries(self) -> bool:
        """Whether the payload may be another one at run time."""
        return self.moves and self.data.payload is not None

    @property
    def renews(self) -> bool:
        """Whether sensitivities of zero order are found while it runs: where the payload changes or walls are kept."""
        return (self.carries or self.keeps_answers) and not self.full

    @property
    def renewal(self) -> tuple[float, float, float, float]:
        """When they are found anew, rad: see the constants of :mod:`tmm_gen.control.laws.rti`."""
        return MOVING, AWAY, FAR_AT_WALLS if self.walls else FAR, TURNED

    @property
    def keeps_program(self) -> bool:
        """Whether the program's matrices are the controller's, and not those of its target for ever."""
        return self.full or self.renews

    @property
    def inputs_planned(self) -> int:
        """Torques of the program, m N."""
        return self.motors * self.horizon

    @property
    def in_space(self) -> bool:
        """Whether angles are those of joints, each against what it stands on; in a plane all are against the ground."""
        return self.data.weight is not None

    @property
    def behind(self) -> str:
        """Where the angles end that turn with hub ``j``, of those from its own on."""
        return "outer[j] + 1" if self.in_space else f"{macros(self.model)}_STATIONS"

    @property
    def bending(self) -> list[tuple[int, int, str]]:
        """Ranges of angles that no motor turns, and what each is compared with."""
        if not self.in_space:
            return [(m.place + 1, m.end, f"state->angle[{m.place}]") for m in self.problem_motors]
        places = [-1, *(motor.place for motor in self.problem_motors), self.data.motors.tip.shape[1]]
        straight = self.number(0.0)
        return [(a + 1, b, straight) for a, b in pairwise(places) if a + 1 < b]

    def spread(self, motor: int) -> tuple[str, int, int]:
        """Return weights of angles in the tip's of a motor, an array, and from where to where they are not zero."""
        if not self.in_space:
            here = self.problem_motors[motor]
            return "lengths", here.place, here.end
        places = np.flatnonzero(self.data.motors.tip[motor])
        return f"tips[{motor}]", int(places[0]), int(places[-1]) + 1

    def tip_slope(self, output: tuple[str, int], place: int) -> str:
        """Write how a tip of an arm in space, one of the outputs, changes in a lane: a sum that needs no loop."""
        part = "rate" if output[0].endswith("rate") else "angle"
        joints = np.flatnonzero(self.data.motors.tip[output[1]])
        terms = [f"tips[{output[1]}][{j}] * found->{part}[{j}][k]" for j in joints]
        return "\n".join(statement(f"slope[{place}][k] = {' + '.join(terms)};", 3))

    @property
    def rolls_out(self) -> bool:
        """Whether a motion along the last plan is prepared."""
        return True

    @property
    def bounds_angles(self) -> bool:
        """Whether some rows bound more than changes of torques."""
        return any(kind.what != "rate" for kind in self.row_kinds)

    @property
    def aim_turns(self) -> int:
        """Steps of Newton's method that a new reference may take."""
        return AIM_TURNS

    @property
    def aim_tolerance(self) -> float:
        """Change of angles and torques below which the arm is at rest, rad and N m."""
        return AIM_TOLERANCE[self.real.name]

    @property
    def needs_tangents(self) -> bool:
        """Whether the kernel's derivatives are used."""
        return self.full or self.moves

    @property
    def problem_motors(self) -> tuple[Motor, ...]:
        """The motors of the model, with their places among its links."""
        return self.data.motors.each

    @property
    def outputs(self) -> tuple[tuple[str, int], ...]:
        """What is weighed or bounded, of which motor."""
        return self.data.outputs

    @property
    def output_names(self) -> str:
        """The same in words."""
        words = [(name.replace("_", " "), motor) for name, motor in self.outputs if name != "keep"]
        names = self.problem.motors.names
        told = [f"{word} of {names[motor]}" if self.several else word for word, motor in words]
        told += [f"distance of '{keep.frame}' along a normal" for keep in self.problem.keeps]
        return ", ".join(told)

    @property
    def spans(self) -> NDArray[np.float64]:
        """Lengths of the links, (n,), m."""
        return self.data.motors.lengths

    def looked(self, output: tuple[str, int], state: str) -> str:
        """Write an output of a state.

        Parameters
        ----------
        output : (str, int)
            Which, of which motor.
        state : str
            What stands before the state's members.
        """
        if output[0] == "keep":
            return f"along({output[1]}, {state}angle, 0)"
        name, motor = output[0], self.problem_motors[output[1]]
        values = f"{state}{'rate' if name.endswith('rate') else 'angle'}"
        if not self.several:
            stations = f"{macros(self.model)}_STATIONS"
            plain = {"hub": f"{state}hub_angle", "hub_rate": f"{state}hub_rate"}
            return plain.get(name, f"dot(lengths, {values}, {stations})")
        inner = f" - {values}[{motor.host}]" if motor.host >= 0 else ""
        if name.startswith("hub"):
            return " + ".join(f"{values}[{place}]" for place in motor.hub) + inner
        weights, start, stop = self.spread(output[1])
        return f"dot(&{weights}[{start}], &{values}[{start}], {stop - start}){inner}"

    @property
    def weighed(self) -> list[int]:
        """Which of the outputs are weighed."""
        return [place for place, weight in enumerate(self.data.weights) if weight > 0.0]

    @property
    def weight_roots(self) -> NDArray[np.float64]:
        """Roots of their weights."""
        return np.sqrt([self.data.weights[place] for place in self.weighed])

    @property
    def squares(self) -> int:
        """Squares that the cost along the plan and beyond is a sum of, a multiple of four."""
        return -(-(self.horizon * len(self.weighed) + len(self.data.end)) // 4) * 4

    @property
    def sloped_kinds(self) -> list[int]:
        """Of each kind of rows that bounds more than changes of torques, which of the outputs it bounds."""
        return [self.place_of(kind) for kind in self.row_kinds if kind.what != "rate"]

    def sloped_place(self, kind: int) -> int:
        """Return which of these a kind of rows is."""
        return sum(each.what != "rate" for each in self.row_kinds[:kind])

    @property
    def output_weights(self) -> str:
        """Weights of the outputs but for walls, which have none, a list of numbers."""
        return ", ".join(self.number(value) for value in self.data.weights[: self.answered])

    @property
    def output_targets(self) -> str:
        """Targets of the outputs, a list of numbers."""
        return ", ".join(self.number(value) for value in self.data.targets)

    @property
    def row_kinds(self) -> tuple[Kind, ...]:
        """What the rows of the program bound, N each."""
        return self.data.kinds

    def place_of(self, kind: Kind) -> int:
        """Return which of the outputs a kind of rows bounds."""
        return self.outputs.index((kind.what, kind.motor))

    def now(self, kind: Kind) -> str:
        """Write what a kind of rows is in sample i of the plan."""
        if kind.what != "rate":
            return f"seen[i][{self.place_of(kind)}]"
        return f"change[{kind.motor} * SAMPLES + i]" if self.several else "change[i]"

    @property
    def tip_kinds(self) -> list[int]:
        """Which kinds of bounds are those of tips."""
        return [self.motors + k for k, kind in enumerate(self.row_kinds) if kind.what == "tip"]

    @property
    def stopping(self) -> list[float]:
        """Half the angle in which each kind of rows is stopped, negative of rates; see `ProgramData`."""
        stopping, other = self.data.program.stopping, {"keep": 0.0, "hub_rate": -1.0}
        return [other.get(kind.what, float(stopping[kind.motor % len(stopping)])) for kind in self.row_kinds]

    @property
    def answers(self) -> NDArray[np.float64]:
        """Of each output to all inputs of the program."""
        return self.data.answers.reshape(len(self.outputs), -1)

    @property
    def resting(self) -> str:
        """Torque of a motor at the target."""
        if self.moves:
            return "controller->held[j]"
        return "target_torque[j]" if self.several else self.number(self.data.target_torque[0])

    @property
    def less_target(self) -> str:
        """Write that the torque at the target is taken away."""
        return f" - {self.resting}" if self.several else self.less(self.data.target_torque[0])

    @property
    def outer(self) -> str:
        """Where each motor's outer link is, a list."""
        return ", ".join(str(motor.place) for motor in self.problem_motors)

    @property
    def encoders_behind(self) -> bool:
        """Whether an encoder is behind the spring of an elastic gear."""
        return any(motor.hub != (motor.place,) for motor in self.problem_motors)

    @property
    def encoder_at(self) -> str:
        """Where each motor's encoder is, a list."""
        return ", ".join(str(motor.hub[-1]) for motor in self.problem_motors)

    def acting(self, two: bool) -> str:
        """Declare the torques that act in a sample, one pair after the other or the same throughout."""
        if two:
            return "real (*torques)[MOTORS]" if self.several else "const real torques[2]"
        return "const real torque[MOTORS]" if self.several else "real torque"

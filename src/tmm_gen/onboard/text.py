"""What the templates of all controllers ask for."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tmm_gen.c_language.real import Real
from tmm_gen.control.estimators.credible import FARTHEST, JUMP, PATIENCE, PROOF
from tmm_gen.control.quadratic.condensed import BEYOND
from tmm_gen.control.task.problem import ControlProblem
from tmm_gen.onboard.controller_data import ControllerData
from tmm_gen.onboard.head import head
from tmm_gen.onboard.program_data import INFINITE
from tmm_gen.onboard.sensor_words import sensor_words
from tmm_gen.onboard.tables import number, table
from tmm_gen.onboard.tolerances import TOLERANCES, Tolerances


@dataclass(frozen=True, eq=False)
class ControllerText:
    """Numbers, tables and names of a controller in C.

    Parameters
    ----------
    name, title : str
        Prefix of everything; one line.
    problem : ControlProblem
        What it solves.
    kind : str
        In a few words, for the head of its files.
    real : Real
        Number type.
    data : ControllerData
        Tables.
    """

    name: str
    title: str
    problem: ControlProblem
    kind: str
    real: Real
    data: ControllerData

    @property
    def NAME(self) -> str:
        """Prefix of macros: of two names that differ in capitals only, two prefixes."""
        return macro_prefix(self.name)

    @property
    def single(self) -> bool:
        """Whether numbers are ``float``."""
        return self.real.size == 4

    @property
    def patience(self) -> int:
        """After how many samples in a row that went wrong the estimate starts anew."""
        return PATIENCE

    @property
    def jump(self) -> float:
        """By how much the hub may turn in a sample, rad."""
        return JUMP

    @property
    def proof(self) -> float:
        """How far encoders may be off for an estimate to prove itself, of what they may be off at all."""
        return PROOF

    @property
    def farthest(self) -> float:
        """How far from where the scene starts the hub may be, rad."""
        return FARTHEST

    @property
    def beyond(self) -> float:
        """How far beyond a soft bound the arm must be for that to be left out, rad."""
        return BEYOND

    @property
    def largest_surprise(self) -> str:
        """By how much each sensor may be off, a list of numbers."""
        return self.numbers(self.data.credible.surprise[i] for i in self.data.sensors)

    @property
    def moves(self) -> bool:
        """Whether the reference may be another one at run time."""
        return False

    @property
    def carries(self) -> bool:
        """Whether the payload may be another one at run time."""
        return False

    @property
    def approaches(self) -> bool:
        """Whether hubs are brought near where the controller's model is not good."""
        return False

    @property
    def rolls_out(self) -> bool:
        """Whether a motion along the last plan is prepared."""
        return False

    @property
    def far(self) -> bool:
        """Whether other gains of the filter are used far from the target."""
        return False

    @property
    def motors(self) -> int:
        """Number of motors, m."""
        return self.problem.count

    @property
    def several(self) -> bool:
        """Whether motors are parts by name, however many: what is of each is then an array."""
        return not self.problem.motors.on_hub

    @property
    def at(self) -> str:
        """What picks motor ``j`` of an array that has something of each."""
        return "[j]" if self.several else ""

    @property
    def of_motors(self) -> str:
        """The dimension of such an array in a declaration, and nothing of a single number."""
        return f"[{self.NAME}_MOTORS]" if self.several else ""

    @property
    def width(self) -> str:
        """What the number of inputs, m N, is called in the header."""
        return f"{self.NAME}_{'INPUTS' if self.several else 'HORIZON'}"

    @property
    def inputs(self) -> str:
        """What the number of inputs, m N, is called in the source."""
        return "INPUTS" if self.several else "SAMPLES"

    @property
    def motor_columns(self) -> str:
        """Names of the example's columns, two for each motor."""
        return "".join(f"{name}_tip_rad,{name}_torque_Nm," for name in self.problem.motors.names)

    @property
    def braking(self) -> str:
        """Torques of the safe law for hubs that turn by 1 rad/s, N m, as C has them."""
        return ", ".join(self.number(-value) for value in np.atleast_1d(self.data.brake))

    @property
    def braking_told(self) -> str:
        """The same for people."""
        return ", ".join(f"{-value:.5g}" for value in np.atleast_1d(self.data.brake))

    @property
    def horizon(self) -> int:
        """Samples looked ahead."""
        return self.data.program.horizon

    @property
    def rows(self) -> int:
        """Rows of the program besides the bounds of its inputs."""
        return len(self.data.program.rows)

    @property
    def bounds(self) -> int:
        """Bounds and rows."""
        return self.data.program.inputs + self.rows

    @property
    def past(self) -> int:
        """How many torques are remembered."""
        return self.data.memory + 1

    @property
    def tolerances(self) -> Tolerances:
        """Of the solver."""
        return TOLERANCES[self.real.name]

    @property
    def sensor_names(self) -> str:
        """Which sensors there are, in words."""
        return ", ".join(sensor_words(self.problem.motors, i)[0] for i in self.data.sensors)

    @property
    def sensor_units(self) -> str:
        """What they measure, in words."""
        return ", ".join(sensor_words(self.problem.motors, i)[1] for i in self.data.sensors)

    @property
    def changes(self) -> NDArray[np.float64]:
        """Largest changes of the torques in a sample, (m,), N m; infinite as the solver has it."""
        return np.minimum(self.problem.torque_rate * self.problem.sample_time, INFINITE)

    @property
    def changes_bounded(self) -> bool:
        """Whether there is one at all."""
        return bool(np.any(np.isfinite(self.problem.torque_rate)))

    @property
    def rates_bounded(self) -> bool:
        """Whether a hub's rate is: the arm is never too far beyond such a bound to be slowed down."""
        return bool(np.any(np.isfinite(self.problem.hub_rate)))

    @property
    def rated(self) -> list[int]:
        """Motors whose torques change only so fast; their changes are the first rows of the program."""
        return [int(motor) for motor in np.flatnonzero(np.isfinite(self.problem.torque_rate))]

    @property
    def packed(self) -> NDArray[np.float64]:
        """``R^-1``, its rows normalised, the upper triangle row by row."""
        program = self.data.program
        scaled = program.scaling[: program.inputs, None] * program.inverse
        packed: NDArray[np.float64] = scaled[np.triu_indices(program.inputs)]
        return packed

    @property
    def scaled_rows(self) -> NDArray[np.float64]:
        """``A R^-1``, its rows normalised, row by row."""
        program = self.data.program
        scaled: NDArray[np.float64] = program.scaling[program.inputs :, None] * (
            program.rows @ program.inverse
        )
        return scaled.ravel()

    @property
    def kinds(self) -> int:
        """How many kinds of bounds there are: of the torques, and of each kind of row."""
        return self.bounds // self.horizon

    def each_kind(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return one value for each kind of bounds, all of whose samples have the same."""
        return values[:: self.horizon]

    def trimmed(self, values: NDArray[np.float64]) -> tuple[int, NDArray[np.float64]]:
        """Return a vector without the zeros at its ends, and how many the first ones were."""
        places = np.flatnonzero(values)
        first, last = (int(places[0]), int(places[-1])) if len(places) else (0, 0)
        return first, values[first : last + 1]

    def columns(self, values: NDArray[np.float64]) -> int:
        """Return how many columns a matrix has up to the last that is not zero; what is behind makes no difference."""
        places = np.flatnonzero(np.any(values, axis=0))
        return int(places[-1]) + 1 if len(places) else 1

    def narrowed(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return these columns."""
        return values[:, : self.columns(values)]

    def number(self, value: float) -> str:
        """Write a number."""
        return number(value, self.real)

    def less(self, value: float) -> str:
        """Write that a number is taken away; nothing where it is zero."""
        return f" - {self.number(value)}" if value else ""

    def more(self, value: float) -> str:
        """Write that a number is added; nothing where it is zero."""
        return f" + {self.number(value)}" if value else ""

    def numbers(self, values: Iterable[float]) -> str:
        """Write a list of numbers."""
        return ", ".join(self.number(float(value)) for value in values)

    def table(self, name: str, values: ArrayLike, dimension: str) -> str:
        """Write a table."""
        return table(name, values, dimension, self.real)

    def comment(self, lead: str) -> str:
        """Return the head of a file, each line after a lead."""
        told = f"{self.horizon} samples of {self.problem.sample_time:g} s, {self.data.size} states, "
        return head(
            f"{self.name}: {self.title}",
            f"controller: {self.kind}; {told}{self.bounds} bounds and rows",
            self.problem,
            self.real,
            lead,
        )


def macro_prefix(name: str) -> str:
    """Return the prefix of a controller's macros: of two names that differ in capitals only, two prefixes."""
    return name.upper() if name.islower() else name

"""The structs a caller of the kernel owns."""

from __future__ import annotations

from dataclasses import dataclass

from tmm_gen.c_language.names import macros
from tmm_gen.c_language.real import Real
from tmm_gen.program.statements import Program
from tmm_gen.program.variables import Role, Variable

COUNTER = "start_steps_taken"
"""Member of the state that counts start-up steps."""
_COUNTER_SIZE = 4


@dataclass(frozen=True)
class Field:
    """A member.

    Parameters
    ----------
    name, dimension, doc : str
        The name is the variable's, whatever C calls it; ``dimension`` is "" or the brackets behind it.
    numbers : int
        How many it holds.
    """

    name: str
    dimension: str
    doc: str
    numbers: int


@dataclass(frozen=True)
class Struct:
    """A struct of numbers, perhaps with a counter of start-up steps behind them.

    Parameters
    ----------
    name : str
        Behind the kernel's: "params", "model", "state", "inputs" or "outputs".
    doc : str
        One line.
    variables : tuple of Variable
        What it holds, in order.
    fields : tuple of Field
        The same as members of C.
    counter : bool
        Whether it counts start-up steps.
    """

    name: str
    doc: str
    variables: tuple[Variable, ...]
    fields: tuple[Field, ...]
    counter: bool = False

    def size(self, real: Real) -> int:
        """Return its bytes, padding included."""
        numbers = sum(field.numbers for field in self.fields) or 1
        tail = -(-_COUNTER_SIZE // real.size) * real.size if self.counter else 0
        return numbers * (real.number_size if self.holds_pairs(real) else real.size) + tail

    def holds_pairs(self, real: Real) -> bool:
        """Whether its numbers are sums of two."""
        return real.pair and self.name not in ("inputs", "outputs")


def structs_of(program: Program) -> tuple[Struct, ...]:
    """Return the structs of a program's kernel: params, model, state, inputs and outputs."""
    described = (
        ("params", "Physical parameters.", program.parameters),
        ("model", "What prepare() derives from the parameters and the time step.", program.model),
        ("state", "Motion of the arm, and the history its integrator needs.", program.state),
        ("inputs", "What acts on the arm.", program.inputs),
        ("outputs", "What the scene asks to know.", program.outputs),
    )
    return tuple(
        Struct(
            name,
            doc,
            variables,
            tuple(_field(v, program) for v in variables),
            counter=name == "state" and bool(program.startup),
        )
        for name, doc, variables in described
    )


def dimension(variable: Variable, program: Program) -> str:
    """Return the length of an array in brackets, in terms of the kernel's macros; "" for a scalar."""
    if variable.length is None:
        return ""
    prefix = macros(program.name)
    if variable.role is Role.INPUT:
        return f"[{prefix}_STAGES]"
    beyond = variable.length - program.stations
    if beyond not in (0, 1):
        return f"[{variable.length}]"
    return f"[{prefix}_STATIONS + 1]" if beyond else f"[{prefix}_STATIONS]"


def described(variable: Variable) -> str:
    """Return what a variable is, with its unit."""
    unit = "" if variable.unit == "1" else f" [{variable.unit}]"
    return f"{variable.doc or variable.name.replace('_', ' ')}{unit}"


def _field(variable: Variable, program: Program) -> Field:
    return Field(variable.name, dimension(variable, program), described(variable), variable.length or 1)

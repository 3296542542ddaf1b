"""Parameters bound at generation: what prepare would compute, as numbers of the kernel's type.

Every operation is done in that type and in the order in which C does it, so that a bound kernel gives the bits of
one that prepares itself.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import numpy as np

from tmm_gen.c_language.real import Real
from tmm_gen.emit.c import pair
from tmm_gen.emit.expressions import ExpressionPrinter
from tmm_gen.errors import UserError
from tmm_gen.program.statements import Assign, Loop, Mark, Order, Program, Require, Routine
from tmm_gen.program.variables import Ref, Variable

Bound = dict[Variable, tuple[float, ...]]
"""Numbers of each variable; one for a scalar."""


class _PythonPrinter(ExpressionPrinter):
    """Writes expressions in Python, every number of one type, held in lists by the variable's name."""

    def reference(self, ref: Ref) -> str:
        index = f"j + {ref.offset}" if ref.offset is not None else ref.entry or 0
        return f"held[{ref.variable.name!r}][{index}]"

    def literal(self, value: float) -> str:
        return f"real({value!r})"

    def function(self, name: str) -> str:
        return f"np.{name}"


def bind(program: Program, real: Real) -> Bound:
    """Return the parameters, the step and all that prepare derives from them.

    Parameters
    ----------
    program : Program
        Lowered; its defaults are bound.
    real : Real
        Number type.

    Raises
    ------
    UserError
        If a pivot is not positive, or a number is beyond the range of the type.
    """
    number: Any = pair.Pair.of if real.pair else np.float32 if real.size == 4 else np.float64
    held: dict[str, list[Any]] = {}
    for variable in (program.step, *program.parameters):
        default = variable.default
        values = default if isinstance(default, tuple) else (default or 0.0,) * (variable.length or 1)
        held[variable.name] = [number(value if real.pair else real.round(value)) for value in values]
    for variable in program.prepare.written():
        held[variable.name] = [number(0.0)] * (variable.length or 1)
    with np.errstate(all="ignore"):  # looked at below
        exec(
            compile(_python(program.prepare, real), "prepare", "exec"),
            {"np": np, "real": number, "Fraction": Fraction, "held": held, "need": _need, **_PAIR_FUNCTIONS},
        )
    kept = (program.step, *program.parameters, *program.coefficients)
    bound = {v: tuple(float(x) for x in held[v.name]) for v in kept if v.name in held}
    for variable, values in bound.items():
        if not all(map(np.isfinite, values)):
            raise UserError(
                f"{program.name}: {variable.name} is beyond the range of emit.real = '{real.name}'"
            )
    return bound


def _need(value: Any, what: str) -> None:
    value = float(value)
    if not (value > 0 and np.isfinite(value)):
        raise UserError(
            f"no passive arm has these parameters: {what} is {value}, not positive; they cannot be bound"
        )


_PAIR_FUNCTIONS = {
    "plus": pair.plus,
    "minus": pair.minus,
    "opposite": pair.opposite_of,
    "scaled": pair.scaled,
    "times": pair.times,
    "over": pair.over,
}


def _pair_printer() -> pair.PairPrinter:
    plain = _PythonPrinter()
    return pair.PairPrinter(plain.reference, lambda value: f"real({Fraction(value)!r})", repr)


def _python(routine: Routine, real: Real) -> str:
    printer = _pair_printer() if real.pair else _PythonPrinter()

    def line(statement: Assign | Require) -> str:
        value = printer.text(statement.value)
        if isinstance(statement, Require):
            return f"need({value}, {str(statement.value)!r})"
        return f"{printer.text(statement.target)} = {value}"

    lines = []
    for statement in routine.statements():
        if isinstance(statement, Mark):
            raise NotImplementedError("prepare repeats nothing")
        if isinstance(statement, Loop):
            stations = f"range({statement.start}, {statement.stop}, {statement.stride})"
            order = f"reversed({stations})" if statement.order is Order.INWARD else stations
            lines += [f"for j in {order}:", *(f"    {line(inner)}" for inner in statement.body)]
        else:
            lines.append(line(statement))
    return "\n".join(lines) or "pass"

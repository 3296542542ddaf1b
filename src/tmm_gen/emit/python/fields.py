"""Fields of the generated dataclasses and arguments of the generated functions, with their documentation."""

from __future__ import annotations

from dataclasses import dataclass

from tmm_gen.emit.python.lines import listing, prose, text
from tmm_gen.emit.runs import python_items
from tmm_gen.program.variables import Variable

_INDENT = "    "
BATCH = "*batch"
"""The axes of many arms, as NumPy's kernels have them behind all others."""


@dataclass(frozen=True)
class Field:
    """A field or argument.

    Parameters
    ----------
    name : str
        As in the program.
    declaration : str
        The field's declaration in a class.
    doc : str
        Its place in the docstring of a class.
    default : str
        Of an argument.
    """

    name: str
    declaration: str
    doc: str
    default: str = ""


def parameter_field(variable: Variable, axes: str = BATCH) -> Field:
    """Return a field of the physical parameters, with the scene's default."""
    return Field(variable.name, _with_default(variable, "ArrayLike"), _doc(variable, "array_like", axes))


def value_field(variable: Variable, axes: str = BATCH) -> Field:
    """Return a field of the model, the state or the outputs, which has no default."""
    return Field(variable.name, f"{_INDENT}{variable.name}: Array", _doc(variable, "array", axes))


def input_field(variable: Variable, axes: str = BATCH) -> Field:
    """Return a field of the inputs, zero unless it is given."""
    scalar = Variable(variable.name, variable.role, None, variable.doc, variable.unit)
    return Field(
        variable.name, f"{_INDENT}{variable.name}: ArrayLike = 0.0", _doc(scalar, "array_like", axes)
    )


def given_argument(variable: Variable, axes: str = BATCH) -> Field:
    """Return an argument of ``initialise``: its default is a number where all stations are alike."""
    name = variable.name.upper()
    lines = _with_default(variable, "ArrayLike", name, indent="")
    return Field(variable.name, lines, _doc(variable, "number, or array_like", axes), name)


def _with_default(variable: Variable, kind: str, name: str = "", indent: str = _INDENT) -> str:
    default = variable.default
    head = f"{name or variable.name}: {kind} = "
    if isinstance(default, tuple) and (not name or len(set(default)) > 1):
        return text(listing(head, python_items([float(x) for x in default]), indent))
    value = default[0] if isinstance(default, tuple) else default
    if value is None:
        raise ValueError(f"{variable.name} has no default")
    return f"{indent}{head}{float(value)!r}"


def _doc(variable: Variable, kind: str, axes: str) -> str:
    behind = f" {axes}" if axes else ""
    shape = f"({axes})" if variable.length is None else f"({variable.length},{behind})"
    what = _with_unit(variable.doc[:1].upper() + variable.doc[1:], variable.unit)
    return text([f"{_INDENT}{variable.name} : {kind}, shape {shape}", *prose(what, 2 * _INDENT)])


def _with_unit(doc: str, unit: str) -> str:
    return f"{doc}." if unit == "1" else f"{doc} ({unit})."

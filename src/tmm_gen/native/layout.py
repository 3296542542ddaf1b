"""The kernel's structs as ctypes sees them."""

from __future__ import annotations

import ctypes
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.c_language.real import Real
from tmm_gen.emit.c.structs import COUNTER, Struct
from tmm_gen.program.variables import Variable

Value = float | Sequence[float] | NDArray[np.floating[Any]]
"""A number, also one for all elements of an array, or an array."""


class PairStructure(ctypes.Structure):
    """A number that is the sum of two floats."""

    _fields_ = (("high", ctypes.c_float), ("low", ctypes.c_float))

    @classmethod
    def of(cls, value: float) -> PairStructure:
        """Split a number; one that floats are too small for becomes zero, as in any state of floats."""
        with np.errstate(over="ignore", invalid="ignore"):
            high = np.float32(value)
            return cls(float(high), float(np.float32(value - float(high))))

    def __float__(self) -> float:
        """Return the sum, exact in double precision."""
        return float(self.high + self.low)


def structure_of(struct: Struct, real: Real) -> type[ctypes.Structure]:
    """Return the type of a struct, its members in order."""
    number: Any = ctypes.c_double if real.size == 8 else ctypes.c_float
    if struct.holds_pairs(real):
        number = PairStructure
    fields = [(f.name, number if not f.dimension else number * f.numbers) for f in struct.fields]
    if not fields:
        fields.append(("none", number))
    if struct.counter:
        fields.append((COUNTER, ctypes.c_int))
    return type(struct.name.capitalize(), (ctypes.Structure,), {"_fields_": fields})


def require_sizes(name: str, types: Mapping[str, type[ctypes.Structure]], sizes_in_c: Any) -> None:
    """Hold the sizes of structs against the compiler's.

    Parameters
    ----------
    name : str
        The kernel's.
    types : mapping from str to type
        In the order in which the library tells sizes.
    sizes_in_c : ctypes function
        Of a loaded library; fills an array of size_t.

    Raises
    ------
    RuntimeError
        If compiler and ctypes disagree on the layout of a struct.
    """
    sizes = (ctypes.c_size_t * len(types))()
    sizes_in_c(sizes)
    expected = [ctypes.sizeof(kind) for kind in types.values()]
    if list(sizes) != expected:
        raise RuntimeError(f"{name}: structs have {list(sizes)} bytes in C, {expected} in ctypes")


def read(instance: ctypes.Structure, struct: Struct) -> dict[str, Any]:
    """Return the members of a struct: floats, arrays, and the counter if it has one."""
    members = {v.name: _python(getattr(instance, v.name)) for v in struct.variables}
    return members | ({COUNTER: getattr(instance, COUNTER)} if struct.counter else {})


def write(instance: ctypes.Structure, struct: Struct, values: Mapping[str, Value]) -> None:
    """Set members of a struct.

    Raises
    ------
    ValueError
        If it has no member of a name, or an array has another length.
    """
    variables = {v.name: v for v in struct.variables}
    for name, value in values.items():
        if name == COUNTER and struct.counter:
            setattr(instance, COUNTER, int(value))  # type: ignore[arg-type]  # raises what int() does
        elif name in variables:
            setattr(instance, name, element_values(variables[name], value, type(getattr(instance, name))))
        else:
            raise ValueError(f"{struct.name} has no {name!r}; it has: {', '.join(variables) or 'none'}")


def element_values(variable: Variable, value: Value, kind: Any) -> Any:
    """Return a value as a member of a struct or an argument takes it."""
    array = np.asarray(value, dtype=float)
    if variable.length is None:
        if array.ndim:
            raise ValueError(f"{variable.name} is one number, not an array of shape {array.shape}")
        return PairStructure.of(float(array)) if kind is PairStructure else float(array)
    if array.shape not in ((), (variable.length,)):
        raise ValueError(f"{variable.name} has {variable.length} numbers, not the shape {array.shape}")
    numbers = np.broadcast_to(array, variable.length).tolist()
    if getattr(kind, "_type_", None) is PairStructure:
        numbers = [PairStructure.of(number) for number in numbers]
    return kind(*numbers)


def _python(member: Any) -> Any:
    if isinstance(member, float | PairStructure):
        return float(member)
    return np.array([float(number) for number in member], dtype=float)

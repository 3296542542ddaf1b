"""Variables of a program, and the symbols by which expressions refer to them.

A variable is a scalar or an array over stations. Inside a loop over stations its element is a :class:`Ref` with an
offset from the loop's index ``j``; outside, one with a fixed entry. A ``Ref`` is a SymPy symbol, so expressions stay
ordinary SymPy and every pass can rely on that.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from functools import lru_cache

import sympy as sp


class Role(Enum):
    """What a variable is for, which also says when its value is known."""

    STEP = "step"
    """The time step: bound at prepare."""
    PARAMETER = "parameter"
    """Physical parameter: bound at prepare."""
    COEFFICIENT = "coefficient"
    """Computed by prepare, kept in the model."""
    STATE = "state"
    INPUT = "input"
    OUTPUT = "output"
    GIVEN = "given"
    """Argument of initialise: angles and rates to start from."""
    POINT = "point"
    """What a step keeps about itself for its tangents: where it was linearised, and its factors."""
    TANGENT = "tangent"
    """Change of a state variable, along one direction."""
    INPUT_TANGENT = "input_tangent"
    """Change of an input, along one direction."""
    WORK = "work"
    """Scratch array of a routine."""
    LOCAL = "local"
    """Scratch scalar of a routine."""

    @property
    def bound_at_prepare(self) -> bool:
        """Whether the value is known before the first step."""
        return self in (Role.STEP, Role.PARAMETER, Role.COEFFICIENT)


SCRATCH = frozenset({Role.WORK, Role.LOCAL})
"""Roles of variables that no one reads after the routine."""


class Spread(Enum):
    """What the parts of a value that is a vector are of, where stages are solved at once."""

    STAGES = "stages"
    """One part a stage: operations are those of each by itself."""
    SYSTEMS = "systems"
    """Two parts a system of an eigenvalue, real and imaginary: products are those of complex numbers."""


@dataclass(frozen=True)
class Variable:
    """A named quantity.

    Parameters
    ----------
    name : str
        Identifier in every backend.
    role : Role
        Where it lives and when it is known.
    length : int or None
        Number of elements; None for a scalar.
    doc : str
        One line for readers of the generated code.
    unit : str
        SI unit, "1" when dimensionless.
    default : float, tuple of float or None
        The scene's value, for parameters and the step.
    spread : Spread or None
        What each element has parts of, where it is a vector.
    """

    name: str
    role: Role
    length: int | None = None
    doc: str = ""
    unit: str = "1"
    default: float | tuple[float, ...] | None = None
    spread: Spread | None = None

    def __eq__(self, other: object) -> bool:
        """Compare all there is; what is most often compared is itself, or has another name."""
        if self is other:
            return True
        if not isinstance(other, Variable) or self.name != other.name:
            return False
        return self._rest == other._rest

    @property
    def _rest(self) -> tuple[object, ...]:
        return self.role, self.length, self.doc, self.unit, self.default, self.spread

    def __hash__(self) -> int:
        """Hash by name, whose hash is known: long defaults would cost more than collisions."""
        return hash(self.name)

    def at(self, offset: int = 0) -> Ref:
        """Return the element ``j + offset`` of the enclosing loop (the scalar itself if there is no length)."""
        return Ref(self, offset=offset if self.length is not None else None)

    def entry(self, index: int) -> Ref:
        """Return the fixed element ``index`` (the scalar itself if there is no length)."""
        return Ref(self, entry=index if self.length is not None else None)

    @property
    def ref(self) -> Ref:
        """The symbol of a scalar."""
        if self.length is not None:
            raise ValueError(f"{self.name} is an array: use at() or entry()")
        return Ref(self)


class Ref(sp.Symbol):  # type: ignore[misc]  # SymPy has no types
    """A symbol standing for a scalar variable or one element of an array.

    Attributes
    ----------
    variable : Variable
        What it refers to.
    offset : int or None
        Element ``j + offset``, relative to the enclosing loop.
    entry : int or None
        Fixed element.
    """

    variable: Variable
    offset: int | None
    entry: int | None
    _content: tuple[object, ...]

    def __new__(cls, variable: Variable, offset: int | None = None, entry: int | None = None) -> Ref:
        """Make the symbol; equal references are equal symbols."""
        known = _REFS.get((variable, offset, entry))
        if known is not None:
            return known
        name = variable.name
        if offset is not None:
            name += f"[j{offset:+d}]" if offset else "[j]"
        elif entry is not None:
            name += f"[{entry}]"
        symbol: Ref = sp.Symbol.__xnew__(cls, name, real=True)
        symbol.variable, symbol.offset, symbol.entry = variable, offset, entry
        # SymPy caches expressions by equality: a namesake of another program must not be equal
        default = variable.default
        held = hash(default) if isinstance(default, tuple) else default
        symbol._content = (
            name,
            f"{variable.role.value} {variable.length} {held} {variable.doc} {variable.unit} {variable.spread}",
        )
        _REFS[variable, offset, entry] = symbol
        return symbol

    def _hashable_content(self) -> tuple[object, ...]:
        return self._content

    def __getnewargs_ex__(self) -> tuple[tuple[object, ...], dict[str, object]]:
        """Support pickling and copying."""
        return (self.variable, self.offset, self.entry), {}


_REFS: dict[tuple[Variable, int | None, int | None], Ref] = {}
"""Every reference made, so that equal ones are one object and compare at once."""


@lru_cache(maxsize=1 << 14)  # passes ask again and again, and SymPy walks the whole expression each time
def refs_in(expression: sp.Basic) -> frozenset[Ref]:
    """Return the references in an expression."""
    return frozenset(s for s in expression.free_symbols if isinstance(s, Ref))


@lru_cache(maxsize=1 << 14)
def variables_in(expression: sp.Basic) -> frozenset[Variable]:
    """Return the variables in an expression; sets of them take them over without asking for their hashes again."""
    return frozenset(ref.variable for ref in refs_in(expression))


@lru_cache(maxsize=1 << 14)  # a walk asks for the same few at each station
def local(name: str, doc: str = "", unit: str = "1") -> Ref:
    """Return the symbol of a scratch scalar."""
    return Variable(name, Role.LOCAL, doc=doc, unit=unit).ref

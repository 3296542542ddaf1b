"""Values that stand side by side: what of a sweep has several values becomes as many variables, complex ones pairs.

A sweep is written once, with symbols for what differs. Here each lane gets its own copy of what follows from that: the
stages of a step, or the systems of its eigenvalues, of which some are complex. What does not follow from it stays one
value for all, and every loop stays one loop, in which the lanes do not wait for each other. Backends see real scalars
alone.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import sympy as sp

from tmm_gen.program.motion import in_order
from tmm_gen.program.statements import Assign, Loop, Mark, Require, Section, Statement
from tmm_gen.program.variables import Ref, Spread, Variable, local, refs_in

Pair = tuple[sp.Expr, sp.Expr]
"""Real and imaginary part."""
ZERO = sp.Integer(0)


@dataclass(frozen=True)
class Lane:
    """One of the values that stand side by side.

    Parameters
    ----------
    suffix : str
        What names end with.
    words : str
        What descriptions end with.
    phase : tuple of 2 sympy.Expr, optional
        Where values are complex: a pivot over this number has a positive real part where the arm is passive.
    spread : Spread, optional
        Where this one lane stands for several: what its values are vectors of.
    facing : sympy.Expr
        Of vectors of systems: what pivots are multiplied by, so that their real parts are positive.
    """

    suffix: str
    words: str
    phase: Pair | None = None
    spread: Spread | None = None
    facing: sp.Expr = sp.S.One

    def of(self, variable: Variable, *, imaginary: bool = False) -> Variable:
        """Return the variable of this lane, of a complex one either part."""
        if self.spread is not None:
            doc = f"{variable.doc}, {self.words}".lstrip(", ")
            return replace(variable, name=f"{variable.name}{self.suffix}", doc=doc, spread=self.spread)
        part = "" if self.phase is None else "_im" if imaginary else "_re"
        words = "" if self.phase is None else ", imaginary part" if imaginary else ", real part"
        doc = f"{variable.doc}, {self.words}{words}".lstrip(", ")
        return replace(variable, name=f"{variable.name}{self.suffix}{part}", doc=doc)

    def ref(self, ref: Ref) -> Pair:
        """Return what stands for a reference in this lane."""
        real = Ref(self.of(ref.variable), ref.offset, ref.entry)
        if self.phase is None:
            return real, ZERO
        return real, Ref(self.of(ref.variable, imaginary=True), ref.offset, ref.entry)


class SideBySide:
    """Writes sections for several lanes.

    Parameters
    ----------
    lanes : sequence of Lane
    seeds : mapping from Ref to sequence of Pair
        What differs, with its values in each lane; of real lanes the first part counts.
    variables : iterable of Variable
        What differs too, and stands in variables of the lanes that are set elsewhere.
    """

    def __init__(
        self, lanes: Sequence[Lane], seeds: Mapping[Ref, Sequence[Pair]], variables: Iterable[Variable] = ()
    ) -> None:
        self._lanes, self._seeds = tuple(lanes), seeds
        self._differing = set(variables)

    def sections(self, sections: Sequence[Section]) -> list[Section]:
        """Return sections with all lanes in each loop."""
        self._find(sections)
        return [
            replace(s, statements=tuple(y for x in s.statements for y in self._statement(x)))
            for s in sections
        ]

    def _find(self, sections: Sequence[Section]) -> None:
        """Find what differs from lane to lane, through any number of statements."""
        inner = [
            x
            for section in sections
            for s in section.statements
            for x in (s.body if isinstance(s, Loop) else (s,))
            if isinstance(x, Assign)
        ]
        while True:
            found = {x.target.variable for x in inner if self._differs(x.value)} - self._differing
            if not found:
                return
            self._differing |= found

    def _differs(self, value: sp.Expr) -> bool:
        return any(r in self._seeds or r.variable in self._differing for r in refs_in(value))

    def _statement(self, statement: Statement) -> list[Statement]:
        if isinstance(statement, Loop):
            body = tuple(y for x in statement.body for y in self._inner(x))
            return [replace(statement, body=body)]
        if isinstance(statement, Mark):
            return [statement]
        return [*self._inner(statement)]

    def _inner(self, statement: Assign | Require) -> list[Assign | Require]:
        target = statement.target if isinstance(statement, Assign) else None
        if not self._differs(statement.value) and (target is None or target.variable not in self._differing):
            return [statement]
        found: list[Assign | Require] = []
        for index, lane in enumerate(self._lanes):
            split = _Split(self, index, target, found)
            real, imaginary = split(statement.value)
            if target is not None:
                parts = zip(lane.ref(target), (real, imaginary), strict=True)
                # either part may be written by what both were before
                changed = [Assign(ref, v) for ref, v in parts if isinstance(ref, Ref) and ref != v]
                found += in_order(changed)
            elif lane.phase is None:
                found.append(Require(real * lane.facing))
            else:
                cosine, sine = lane.phase
                found.append(Require(cosine * real + sine * imaginary))
        return found

    def pair(self, ref: Ref, lane: int) -> Pair:
        """Return what stands for a reference in a lane."""
        if ref in self._seeds:
            return self._seeds[ref][lane]
        return self._lanes[lane].ref(ref) if ref.variable in self._differing else (ref, ZERO)

    def is_real(self, lane: int) -> bool:
        """Whether all values of a lane are."""
        return self._lanes[lane].phase is None

    def suffix(self, lane: int) -> str:
        """Return what names of a lane end with."""
        return self._lanes[lane].suffix


class _Split:
    """Splits expressions of one lane into real and imaginary part; what is needed twice is named before it.

    Parameters
    ----------
    owner : SideBySide
    lane : int
    target : Ref, optional
        After which such values are called.
    before : list of statements
        What names them is added here.
    """

    def __init__(
        self, owner: SideBySide, lane: int, target: Ref | None, before: list[Assign | Require]
    ) -> None:
        self._owner, self._lane, self._before = owner, lane, before
        self._name = target.variable.name if target is not None else "pivot"
        self._count = 0

    def __call__(self, e: sp.Expr) -> Pair:
        refs = {r: self._owner.pair(r, self._lane) for r in refs_in(e)}
        if self._owner.is_real(self._lane) or all(im == 0 for _, im in refs.values()):
            return e.xreplace({r: re for r, (re, _) in refs.items()}), ZERO
        if isinstance(e, Ref):
            return refs[e]
        if e.is_Add:
            parts = [self(term) for term in e.args]
            return sp.Add(*(re for re, _ in parts)), sp.Add(*(im for _, im in parts))
        if e.is_Mul:
            return self._product([self(factor) for factor in e.args])
        if e.is_Pow and e.exp.is_Integer:
            base = self(e.base)
            if e.exp < 0:
                base = self._inverse(base)
            return self._product([base] * abs(int(e.exp)))
        raise TypeError(f"no way to write {e} by real and imaginary parts")

    def _product(self, factors: list[Pair]) -> Pair:
        real = sp.Mul(*(re for re, im in factors if im == 0))
        pairs = [pair for pair in factors if pair[1] != 0]
        if not pairs:
            return real, ZERO
        found = pairs[0]
        for other in pairs[1:]:
            (a, b), (c, d) = self._named(found), self._named(other)
            found = (a * c - b * d, a * d + b * c)
        return real * found[0], real * found[1]

    def _inverse(self, value: Pair) -> Pair:
        re, im = self._named(value)
        size = self._let(re**2 + im**2, "size")
        # it may vanish by rounding alone, and intervals do not tell that it does not
        self._before.append(Require(size))
        scale = self._let(1 / size, "scale")
        return scale * re, -scale * im

    def _named(self, value: Pair) -> Pair:
        re, im = value
        return (
            re if re.is_Atom or (-re).is_Atom else self._let(re, "re"),
            im if im.is_Atom or (-im).is_Atom else self._let(im, "im"),
        )

    def _let(self, value: sp.Expr, what: str) -> Ref:
        self._count += 1
        number = f"_{self._count}" if self._count > 2 else ""
        name = f"{self._name}{self._owner.suffix(self._lane)}_{what}_part{number}"
        doc = f"part of {self._name.replace('_', ' ')}"
        ref = local(name, doc)
        self._before.append(Assign(ref, value))
        return ref

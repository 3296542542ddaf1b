"""The way out: how each element hands on motion, and how what it hands on answers to the station's unknown."""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from tmm_gen.derive.elements.declaration import Element
from tmm_gen.derive.station.frame import COSINE, INNER, MOUNT, OUTER, SINE, SQUARE, Frame, node, primitive
from tmm_gen.derive.station.law import KINDS, Law, law_of
from tmm_gen.derive.station.lets import Let
from tmm_gen.derive.station.values import Values
from tmm_gen.errors import UserError


@dataclass(frozen=True)
class Passed:
    """An element at its place in a station.

    Parameters
    ----------
    element : Element
        With its parameters written in the row's symbols.
    law : Law
        Its solved equations.
    point : dict from sympy.Symbol to sympy.Expr
        Motion at its ports.
    swings : dict from int to sympy.Expr
        Change per unknown of the acceleration it adds, by coordinate.
    """

    element: Element
    law: Law
    point: dict[sp.Symbol, sp.Expr]
    swings: dict[int, sp.Expr]

    @property
    def constants(self) -> set[sp.Symbol]:
        """The row's symbols for the element's parameters."""
        return set(self.element.parameters)

    def at_point(self, value: sp.Expr) -> sp.Expr:
        """Write a value at the motion of the element's ports."""
        return value if value.is_number else primitive(value.xreplace(self.point))


class Outward:
    """Walks the elements of a station from its inner to its outer side.

    Parameters
    ----------
    elements : tuple of Element
        Inner to outer.
    frame : Frame
        What it is derived for.
    moved : bool
        Whether the first element to give way has been passed: a station's own begins with it, a base has none. Where
        two give way the station has a shaft, which turns between them and has no inertia.
    """

    def __init__(self, elements: tuple[Element, ...], frame: Frame, *, moved: bool = False) -> None:
        self.frame = frame
        self.values = Values({SINE: COSINE})
        self.lets: list[Let] = []
        self.passed: list[Passed] = []
        laws = [law_of(element) for element in elements]
        giving = 0 if moved else sum(law.free is not None for law in laws)
        self._sides = [OUTER, INNER, MOUNT][: giving + 1]
        """Motion between the elements that give way, from the outer side inward."""
        at = self._sides.pop()
        self._at: list[dict[str, sp.Expr]] = [
            dict(at) if c.integrated else {"a": node(c)} for c in frame.coordinates
        ]
        self._name_levers(elements, laws)
        for element, law in zip(elements, laws, strict=True):
            self._pass(element, law)

    @property
    def turning(self) -> Passed | None:
        """What turns the shaft, where there is one: the first of two elements that give way."""
        giving = [passed for passed in self.passed if passed.law.free is not None]
        return giving[0] if len(giving) > 1 else None

    @property
    def nodes(self) -> dict[str, sp.Expr]:
        """Accelerations at the outer side, by coordinate."""
        return {
            c.name: at["a"]
            for c, at in zip(self.frame.coordinates, self._at, strict=True)
            if not c.integrated
        }

    def _name_levers(self, elements: tuple[Element, ...], laws: list[Law]) -> None:
        """Name the lever arms: sine and cosine with the length that comes with them everywhere."""
        lengths: set[sp.Expr] = set()
        for element, law in zip(elements, laws, strict=True):
            angles = {getattr(m, k): OUTER[k] for m in element.inboard.motions for k in KINDS}
            for moved in law.outer.values():
                for term in sp.Add.make_args(primitive(moved["a"].xreplace(angles))):
                    if term.has(SINE, COSINE):
                        motions = {SINE, COSINE, SQUARE, *OUTER.values()}
                        lengths.add(sp.Mul(*(f for f in term.args if not f.is_Number and f not in motions)))
        for length in sorted(lengths, key=str):
            suffix = "" if len(lengths) == 1 else f"_{length}"
            for name, symbol in (("cosine", COSINE), ("sine", SINE)):
                self._let(f"lever_{name}{suffix}", length * symbol, f"length times {name} of the angle", "m")

    def _let(self, name: str, value: sp.Expr, doc: str = "", unit: str = "1") -> sp.Expr:
        before = len(self.values.lets)
        found = self.values.let(name, value, doc, unit)
        self.lets += self.values.lets[before:]
        return found

    def _pass(self, element: Element, law: Law) -> None:
        point: dict[sp.Symbol, sp.Expr] = {}
        for motion, at in zip(element.inboard.motions, self._at, strict=True):
            point |= {getattr(motion, kind): value for kind, value in at.items()}
        swings: dict[int, sp.Expr] = {}
        if law.free is not None:
            side = self._sides.pop()
            point |= {getattr(element.outboard.motions[law.free], k): side[k] for k in KINDS}
            self._at[law.free] = dict(side)
        else:
            swings = self._move(element, law, point)
        self.passed.append(Passed(element, law, point, swings))

    def _move(self, element: Element, law: Law, point: dict[sp.Symbol, sp.Expr]) -> dict[int, sp.Expr]:
        """Add what an element adds to the motion, and name how that answers to the unknown."""
        added: dict[int, sp.Expr] = {}
        for i, coordinate in enumerate(self.frame.coordinates):
            inner = element.inboard.motions[i]
            if coordinate.integrated:
                if law.outer[i]["q"] != inner.q:
                    raise UserError(
                        f"element '{element.name}': it hands on {inner.q} changed and without giving way, which is not "
                        "derived yet. Let it give way there: state its force by a stiffness, like that of teeth."
                    )
                continue
            relative = sp.expand(law.outer[i]["a"] - inner.a)
            if relative != 0:
                added[i] = primitive(relative.xreplace(point))
        if not added:
            return {}
        names = {i: self.frame.coordinates[i].name for i in added}
        if self.frame.followed is None and any(value.has(SQUARE) for value in added.values()):
            self.lets.append(Let(SQUARE, OUTER["v"] ** 2, "square of the rate", "1/s^2"))
        relative_to = {
            i: self._let(
                f"relative_{names[i]}",
                self.frame.settled(value),
                f"acceleration of the outer end against the inner one along {names[i]}",
                "m/s^2",
            )
            for i, value in added.items()
        }
        if self.frame.followed is not None:  # nodes have motions of their own, known before
            for i, name in names.items():
                self._at[i] = {"a": sp.Symbol(f"node_{name}_outer", real=True)}
            turned = {i: self.frame.slope(value, "a") for i, value in added.items()}
            return {i: sp.expand(self.frame.followed * self.values.written(s)) for i, s in turned.items()}
        for i, name in names.items():
            moved = sp.Symbol(f"node_{name}_outer", real=True)
            self.lets.append(
                Let(
                    moved,
                    self._at[i]["a"] + relative_to[i],
                    f"acceleration of the node along {name}",
                    "m/s^2",
                )
            )
            self._at[i] = {"a": moved}
        return self._answers(added, names)

    def _answers(self, added: dict[int, sp.Expr], names: dict[int, str]) -> dict[int, sp.Expr]:
        """Name the change per unknown of what is added, sharing what the coordinates have in common."""
        parts: dict[int, sp.Expr] = dict.fromkeys(added, sp.Integer(0))
        for kind in KINDS:
            slopes = {i: self.frame.settled(self.frame.slope(value, kind)) for i, value in added.items()}
            written = {
                i: sp.expand(self.frame.gains[kind] * self.values.written(s)) for i, s in slopes.items()
            }
            shared = _common(list(written.values()), set(OUTER.values()))
            if shared is not None:
                name = self._let("turning", shared, "change of the rate's square per unknown", "1/s^2")
                written = {i: sp.expand(value / shared) * name for i, value in written.items()}
            parts = {i: parts[i] + written[i] for i in added}
        return {
            i: self._let(
                f"swing_{names[i]}",
                value,
                f"change of the outer end's acceleration along {names[i]} per unknown",
                self.frame.swing_unit,
            )
            for i, value in parts.items()
        }


def _common(values: list[sp.Expr], motions: set[sp.Symbol]) -> sp.Expr | None:
    """Return the product that several values share, if it holds motion and takes arithmetic."""
    if len(values) < 2 or any(v == 0 or v.is_Add for v in values):
        return None
    split = [v.as_coeff_Mul() for v in values]
    shared = set.intersection(*(set(sp.Mul.make_args(rest)) for _, rest in split))
    product = sp.igcd(*(number for number, _ in split)) * sp.Mul(*shared)
    return product if product.free_symbols & motions and not product.is_Atom else None

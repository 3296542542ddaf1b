"""How a linearised sweep follows its own point of linearisation: the same values, differentiated once more.

One Newton iteration solves ``r(z) + A(z) P u = 0`` for the increment ``u`` about the motion ``z``. Its exact derivative
is the solution of ``A P du = -d(r(z) + A(z) P u)|_u``: the same factors, with a right-hand side that is the derivative
of each element's linearised law with ``u`` held at what it was solved to.

Slopes must be taken at the force as predicted, a function of ``z`` alone: were they taken at the force the outer links
have already corrected, ``A`` would depend on its own factors.
"""

from __future__ import annotations

from collections.abc import Mapping

import sympy as sp

from tmm_gen.derive.partial import partial
from tmm_gen.derive.station.frame import OUTER, Frame, force, node, predicted_force
from tmm_gen.derive.station.giving_way import ADMITTANCE, OWN, STIFFNESS, TORQUE
from tmm_gen.derive.station.inward import Inward
from tmm_gen.derive.station.law import KINDS
from tmm_gen.derive.station.lets import Coordinate, Let, Line, Update
from tmm_gen.derive.station.motion import Outward, Passed
from tmm_gen.derive.station.written import cheapest
from tmm_gen.errors import UserError

SOLVED = sp.Symbol("solved_unknown", real=True)
"""Increment of the station's unknown, as solved."""
WORDS = {"q": "angle", "v": "rate", "a": "acceleration"}


def solved_node(coordinate: Coordinate) -> sp.Symbol:
    """Return the acceleration at the inner side as solved."""
    return sp.Symbol(f"solved_node_{coordinate.name}", real=True)


def solved_force(coordinate: Coordinate) -> sp.Symbol:
    """Return the force beyond a place as solved."""
    return sp.Symbol(f"solved_{coordinate.force}", real=True)


def beyond(symbol: sp.Symbol) -> sp.Symbol:
    """Return a node's value at the outer side of the station."""
    return sp.Symbol(f"{symbol.name}_outer", real=True)


class Tangent:
    """Derives the tangent over a station, or over what stands beyond the last.

    Parameters
    ----------
    inward : Inward
        The linearised recursion.
    out : Outward
        Its way out.

    Attributes
    ----------
    keep_out, keep_in : list of Line
        What is computed at the point of linearisation; ``keep_in`` walks in with forces as solved and as predicted.
    outward, inward : list of Line
        On changes: of the nodes' accelerations, predicted and solved, and of the forces.
    """

    def __init__(self, inward: Inward, out: Outward) -> None:
        self.frame: Frame = inward.frame
        self.keep_out: list[Let] = []
        self.keep_in: list[Line] = []
        self.outward: list[Line] = []
        self.inward: list[Line] = []
        self._inward, self._out = inward, out
        self._carried = [c for c in self.frame.coordinates if not c.integrated]
        self._names: set[str] = set()
        self._nodes()
        for passed in reversed(out.passed):
            if passed.law.free is None:
                self._through(passed)
            elif passed is not out.turning:
                self._give_way(passed)

    # -- the way out ---------------------------------------------------------------------------------------

    def _nodes(self) -> None:
        moved_solved: dict[sp.Symbol, sp.Expr] = {}
        moved_predicted: dict[sp.Symbol, sp.Expr] = {}
        for i, c in enumerate(self.frame.coordinates):
            if c.integrated:
                continue
            relative = self._out.values.in_full(self._relative(c))
            swing = sp.Add(*(p.swings.get(i, sp.Integer(0)) for p in self._out.passed))
            solved = relative + SOLVED * self._out.values.in_full(swing)
            for symbol, value, name, moved in (
                (node(c), relative, f"predicted_{c.name}", moved_predicted),
                (solved_node(c), solved, f"solved_{c.name}", moved_solved),
            ):
                change = self._slopes(
                    value, name, f"acceleration of the outer end along {c.name}", self.keep_out
                )
                moved[beyond(symbol)] = symbol + change
        for found in (moved_predicted, moved_solved):
            if found:
                self.outward.append(Update(found))

    def _relative(self, c: Coordinate) -> sp.Expr:
        """Return what the station adds to a node's acceleration."""
        for let in self._out.lets:
            if let.symbol == beyond(node(c)):
                return let.value - node(c)
        return sp.Integer(0)

    def _slopes(self, value: sp.Expr, name: str, doc: str, kept: list[Let] | list[Line]) -> sp.Expr:
        """Return the change of a value with the station's motion."""
        change = sp.Integer(0)
        for kind in KINDS:
            slope = self._kept(
                f"{name}_by_{WORDS[kind]}", self.frame.slope(value, kind), f"{doc} per {WORDS[kind]}", kept
            )
            change += slope * OUTER[kind]
        return change

    def _kept(self, name: str, value: sp.Expr, doc: str, kept: list[Let] | list[Line]) -> sp.Expr:
        """Name a coefficient, unless it is known."""
        written = cheapest(self._out.values.written(value), self._levers)
        if written.is_Atom or (-written).is_Atom:
            return written
        number = 2
        unique = name
        while unique in self._names:
            unique, number = f"{name}_{number}", number + 1
        self._names.add(unique)
        integrated = self.frame.coordinates[self.frame.own]
        if written.has(solved_force(integrated), predicted_force(integrated)):
            raise UserError(
                f"{name}: derivatives of a law that multiplies {integrated.force} are not derived yet. "
                "Set emit.sensitivities = false."
            )
        symbol = sp.Symbol(unique, real=True)
        kept.append(Let(symbol, written, doc))
        return symbol

    @property
    def _levers(self) -> tuple[sp.Symbol, ...]:
        return tuple(let.symbol for let in self._out.lets if let.symbol.name.startswith("lever"))

    # -- the way in ----------------------------------------------------------------------------------------

    def _through(self, passed: Passed) -> None:
        frame, element = self.frame, passed.element
        c = frame.coordinates
        outside = element.outboard.forces
        as_solved = dict(zip(outside, map(solved_force, c), strict=True))
        as_predicted = dict(zip(outside, map(predicted_force, c), strict=True))
        solved_nodes = self._at_solved()
        forces, predicted = {}, {}
        walked: dict[sp.Symbol, sp.Expr] = {}
        walked_predicted: dict[sp.Symbol, sp.Expr] = {}
        for i, coordinate in enumerate(c):
            law = passed.at_point(passed.law.inner[i])
            slope = sp.Add(*(frame.gains[k] * frame.slope(law, k) for k in KINDS)).subs(as_predicted)
            linearised = law.subs(as_solved).subs(solved_nodes, simultaneous=True) + SOLVED * slope
            name, doc = coordinate.force, f"{coordinate.force} at the inner end"
            change = self._slopes(linearised, name, doc, self.keep_in)
            for k, other in enumerate(c):
                through = partial(law, outside[k])
                change += self._out.values.written(through) * force(other)
                by = self._kept(
                    f"{name}_by_predicted_{other.force}",
                    partial(linearised, predicted_force(other)),
                    f"{doc} per predicted {other.force}",
                    self.keep_in,
                )
                change += by * predicted_force(other)
            change += self._by_nodes_and_loads(passed, law, solved_nodes)
            if change != force(coordinate):
                forces[force(coordinate)] = change
            if coordinate.integrated:
                continue
            walked[solved_force(coordinate)] = self._out.values.written(linearised)
            at_predicted = law.subs(as_predicted)
            ahead = self._slopes(at_predicted, f"predicted_{name}", f"predicted {doc}", self.keep_in)
            for k, other in enumerate(c):
                ahead += self._out.values.written(partial(law, outside[k])) * predicted_force(other)
            ahead += self._by_nodes_and_loads(passed, law, {})
            if ahead != predicted_force(coordinate):
                predicted[predicted_force(coordinate)] = ahead
            walked_predicted[predicted_force(coordinate)] = self._out.values.written(at_predicted)
        self._walk(forces, predicted, walked, walked_predicted)

    def _walk(self, *found: Mapping[sp.Symbol, sp.Expr]) -> None:
        forces, predicted, walked, walked_predicted = ({s: v for s, v in f.items() if v != s} for f in found)
        for values, into in ((forces, self.inward), (predicted, self.inward)):
            if values:
                into.append(Update(values))
        for values in (walked, walked_predicted):
            if values:
                self.keep_in.append(Update(values))

    def _at_solved(self) -> dict[sp.Symbol, sp.Expr]:
        """Map predicted accelerations of nodes to those as solved."""
        found: dict[sp.Symbol, sp.Expr] = {}
        for c in self._carried:
            found[node(c)] = solved_node(c)
            found[beyond(node(c))] = beyond(solved_node(c))
        return found

    def _by_nodes_and_loads(
        self, passed: Passed, law: sp.Expr, nodes: Mapping[sp.Symbol, sp.Expr]
    ) -> sp.Expr:
        change = sp.Integer(0)
        for c in self._carried:
            for symbol in (node(c), beyond(node(c))):
                change += self._out.values.written(partial(law, symbol)) * nodes.get(symbol, symbol)
        for symbol in passed.element.inputs:
            change += self._out.values.written(partial(law, symbol)) * symbol
        return change

    def _give_way(self, passed: Passed) -> None:
        """Cross an element that gives way with the factors of the step; its law is linear."""
        frame, own = self.frame, self.frame.own
        c = frame.coordinates
        known = next((let.symbol for let in self._inward.known if let.symbol == TORQUE), sp.Integer(0))
        if passed.law.ratio != 1 or passed.law.inner[own] != 0:
            raise UserError(
                f"element '{passed.element.name}': its inner force is not its outer one, and derivatives of a step "
                "with such an element are not derived yet. Set emit.sensitivities = false."
            )
        lines = (*self._inward.ahead, *self._inward.lines)
        stiff = any(isinstance(line, Let) and line.symbol == STIFFNESS for line in lines)
        bias = force(c[own])
        self.inward.append(
            Let(OWN, ADMITTANCE * (known - bias if frame.sign > 0 else bias - known), "change of the unknown")
        )
        update = {
            force(c[k]): force(c[k]) + column * OWN
            for k, column in zip([i for i in range(len(c)) if i != own], self._inward.columns, strict=True)
        }
        update[bias] = known - frame.sign * STIFFNESS * OWN if stiff else known
        self.inward.append(Update(update))

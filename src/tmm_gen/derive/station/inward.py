"""The way in: how the force beyond a place, affine in the motion there, is carried over each element.

Outboard of an element ``f = S k + e``, with ``k`` the changes of motion a sweep solves for. An element with motion
through it changes ``S`` by congruence, ``A S T + B``; one that gives way in a coordinate by a rank-one update, whose
force row follows from the element's own law. A correction takes ``e`` over the same elements again, at new motion and
with the factors that a sweep has left: pivots, slopes and answers stay.
"""

from __future__ import annotations

from collections.abc import Mapping

import sympy as sp

from tmm_gen.derive.station.frame import RESIDUAL, Frame, change, force, impedance, predicted_force
from tmm_gen.derive.station.law import KINDS
from tmm_gen.derive.station.lets import Let, Line, Pivot, Update
from tmm_gen.derive.station.motion import Outward, Passed
from tmm_gen.derive.station.shaft import TORQUES, Shaft
from tmm_gen.errors import UserError

ZERO, ONE = sp.Integer(0), sp.Integer(1)

ADMITTANCE = sp.Symbol("admittance", real=True)
TRANSMISSION = sp.Symbol("transmission", real=True)
REFLECTION = sp.Symbol("reflection", real=True)
OWN = sp.Symbol("answer_own", real=True)
STIFFNESS = sp.Symbol("joint_impedance", real=True)
PIVOT = sp.Symbol("pivot", real=True)
TORQUE = sp.Symbol("joint_torque", real=True)


class Inward:
    """Walks the elements of a station from its outer to its inner side.

    Parameters
    ----------
    out : Outward
        The same elements on the way out.
    zero : frozenset of sympy.Symbol
        Entries of ``S`` and ``e`` that are known to be zero at the outer side.
    """

    def __init__(self, out: Outward, zero: frozenset[sp.Symbol] = frozenset()) -> None:
        self.frame: Frame = out.frame
        self.arriving = zero
        """What was known to be zero at the outer side."""
        self.lines: list[Line] = []
        self.again: list[Line] = []
        """What a correction repeats: forces alone, with the factors of the sweep."""
        self.ahead: list[Line] = []
        """What known forces need besides motion: of parameters and gains alone."""
        self.known: list[Let] = []
        """Forces of elements that give way, at the point of linearisation."""
        self.answers: list[tuple[Passed, dict[str, sp.Expr]]] = []
        self._out = out
        self.shaft: Shaft | None = None
        c = self.frame.coordinates
        self._s = {
            (i, k): ZERO if impedance(a, b) in zero else impedance(a, b)
            for i, a in enumerate(c)
            for k, b in enumerate(c)
        }
        self._e = {i: ZERO if force(a) in zero else force(a) for i, a in enumerate(c)}
        self._p = {i: ZERO if predicted_force(a) in zero else predicted_force(a) for i, a in enumerate(c)}
        for passed in reversed(out.passed):
            answers: dict[str, sp.Expr] = {}
            if passed.law.free is None:
                self._carry(passed)
            elif passed is not out.turning:
                answers = self._give_way(passed)
            self.answers.append((passed, answers))
        self.answers.reverse()

    @property
    def zero(self) -> frozenset[sp.Symbol]:
        """Entries that are zero at the inner side."""
        c = self.frame.coordinates
        entries = {impedance(c[i], c[k]): value for (i, k), value in self._s.items()}
        entries |= {force(c[i]): value for i, value in self._e.items()}
        entries |= {predicted_force(c[i]): value for i, value in self._p.items()}
        return frozenset(symbol for symbol, value in entries.items() if value == 0)

    # -- elements with motion through them ---------------------------------------------------------------

    def _carry(self, passed: Passed) -> None:
        frame, own = self.frame, self.frame.own
        size = range(len(frame.coordinates))
        column = {
            i: self._s[i, own] + sum((self._s[i, k] * swing for k, swing in passed.swings.items()), ZERO)
            for i in size
        }
        self._set_impedance({(i, own): column[i] for i in size if column[i] != self._s[i, own]})
        outside = passed.element.outboard.forces
        at_bias = dict(zip(outside, (self._e[i] for i in size), strict=True))
        slopes_at = at_bias
        if frame.predicted:
            slopes_at = dict(zip(outside, (self._p[i] for i in size), strict=True))
        impedances: dict[tuple[int, int], sp.Expr] = {}
        forces: dict[int, sp.Expr] = {}
        for i in size:
            law = passed.law.inner[i]
            through = [self._written(passed.at_point(sp.diff(law, f))) for f in outside]
            for k in size:
                value = sum((through[j] * self._s[j, k] for j in size), ZERO)
                if k == own:
                    # slopes by gain, so that a lever arm multiplies what it shares
                    slope = sp.Add(
                        *(
                            frame.gains[kind]
                            * self._written(frame.settled(frame.slope(passed.at_point(law), kind)))
                            for kind in KINDS
                        )
                    )
                    self._require_known(passed, slope, outside[own])
                    value += self._constant_named(passed, slope.subs(slopes_at))
                else:
                    value += self._written(passed.at_point(sp.diff(law, passed.element.inboard.motions[k].a)))
                if value != self._s[i, k]:
                    impedances[i, k] = cheapest(value, self._levers)
            biased = self._written(frame.settled(passed.at_point(law))).subs(at_bias)
            if frame.residual:  # what is no change of a force is in what equations leave over
                biased = sum((through[j] * self._e[j] for j in size), ZERO)
            if biased != self._e[i]:
                forces[i] = cheapest(biased, self._levers)
        at_predicted = dict(zip(outside, (self._p[i] for i in size), strict=True))
        self._set(impedances, forces)
        self._predict(
            [
                cheapest(self._written(frame.settled(passed.at_point(law))).subs(at_predicted), self._levers)
                for law in passed.law.inner
            ]
        )

    def _require_known(self, passed: Passed, slope: sp.Expr, torque: sp.Symbol) -> None:
        """Refuse a law whose slopes multiply what is not carried where residuals are given."""
        if self.frame.residual and slope.has(torque):
            raise UserError(
                f"element '{passed.element.name}': slopes of a law that multiplies {torque} are not derived for stages "
                "that are solved at once. Use an integrator such as 'sdirk4'."
            )

    def _predict(self, forces: list[sp.Expr]) -> None:
        """Carry the force as predicted, where slopes are taken at it."""
        if not self.frame.predicted:
            return
        update: dict[sp.Symbol, sp.Expr] = {}
        for i, (c, value) in enumerate(zip(self.frame.coordinates, forces, strict=True)):
            if self.frame.residual and c.integrated:  # no slope is taken at it
                self._p[i] = ZERO
                continue
            if value != self._p[i] and value != 0:
                update[predicted_force(c)] = value
            self._p[i] = predicted_force(c) if value != 0 else ZERO
        if update:
            self.lines.append(Update(update))

    def _constant_named(self, passed: Passed, slope: sp.Expr) -> sp.Expr:
        """Name the part of a slope that depends on parameters and gains alone, if it takes arithmetic."""
        early = passed.constants | set(self.frame.gains.values())
        constant = sp.Add(
            *(term for term in sp.Add.make_args(sp.expand(slope)) if term.free_symbols <= early)
        )
        if constant == 0 or constant.is_Atom or (-constant).is_Atom:
            return slope
        symbol = sp.Symbol(f"{passed.element.name}_impedance", real=True)
        self.lines.append(
            Let(symbol, constant, "force of its inertia or friction per unknown", self.frame.impedance_unit)
        )
        return sp.expand(slope - constant) + symbol

    @property
    def _levers(self) -> list[sp.Symbol]:
        return [let.symbol for let in self._out.lets if let.symbol.name.startswith("lever")]

    def _written(self, value: sp.Expr) -> sp.Expr:
        return self._out.values.written(value)

    # -- elements that give way ---------------------------------------------------------------------------

    def _give_way(self, passed: Passed) -> dict[str, sp.Expr]:
        """Solve the element's law for the motion beyond it; return what the way out needs of that."""
        frame, own = self.frame, self.frame.own
        sign, names = sp.Integer(frame.sign), [c.name for c in frame.coordinates]
        law, inside = passed.law, passed.element.inboard.motions[own]
        outside = passed.element.outboard.motions[own]
        ratio, besides = law.ratio, law.inner[own]
        of_inner, of_outer = self._gain(law.own, inside), self._gain(law.own, outside)
        more_inner, more_outer = self._gain(besides, inside), self._gain(besides, outside)
        turning, doc = self._out.turning, "torque of each joint at the point of linearisation"
        known = self._known(passed, law.own, TORQUES[1] if turning else TORQUE, doc)
        more = self._known(
            passed, besides, sp.Symbol("inner_torque", real=True), "what acts on its inner side besides"
        )
        load, bias = self._s[own, own], self._e[own]
        stiffness = -sign * of_outer
        if turning is not None:
            self.shaft = self._on_shaft(turning, stiffness, known)
            self.ahead += self.shaft.ahead
            self.known += self.shaft.known(TORQUE, doc)
            stiffness, known = self.shaft.impedance, TORQUE
        if stiffness != 0:
            (self.lines if self.shaft is None else self.ahead).append(
                Let(
                    STIFFNESS, stiffness, "torque of a joint per difference of unknowns", frame.impedance_unit
                )
            )
            stiffness = STIFFNESS
        over = (RESIDUAL if frame.residual else known) - bias
        symmetric = sp.expand(of_inner + ratio * of_outer) == 0
        inner_stiffness = ratio * stiffness if symmetric else sign * of_inner
        self.lines += [
            Let(PIVOT, stiffness + sign * load, "pivot of the joint"),
            Pivot(PIVOT),
            Let(ADMITTANCE, 1 / PIVOT, "inverse pivot of each joint"),
        ]
        answers: dict[str, sp.Expr] = {"own": OWN}
        answer = Let(
            OWN,
            ADMITTANCE * (over if sign > 0 else -over),
            "unknown of a station if its inner side kept its motion",
        )
        self.lines.append(answer)
        self.again.append(answer)
        for k, name in enumerate(names):
            if k != own and self._s[own, k] != 0:
                answers[name] = sp.Symbol(f"answer_{name}", real=True)
                self.lines.append(
                    Let(
                        answers[name],
                        sign * ADMITTANCE * self._s[own, k],
                        f"answer of the unknown to the joint's acceleration along {name}",
                    )
                )
        if inner_stiffness != 0:
            answers["inner"] = TRANSMISSION
            self.lines.append(
                Let(
                    TRANSMISSION,
                    ADMITTANCE * inner_stiffness,
                    "share of motion and torque each joint passes on",
                )
            )
        if frame.predicted or frame.corrected:
            self.columns = {
                sp.Symbol(f"column_{name}", real=True): self._s[k, own]
                for k, name in enumerate(names)
                if k != own
            }
            self.lines += [
                Let(
                    symbol,
                    value,
                    "force per unknown of the link",
                    frame.impedance_unit.replace("kg m^2", "kg m"),
                )
                for symbol, value in self.columns.items()
            ]
        passes = answers.get("inner", ZERO)
        impedances: dict[tuple[int, int], sp.Expr] = {}
        forces: dict[int, sp.Expr] = {}
        for i in range(len(names)):
            if i == own:
                continue
            column = self._s[i, own]
            if frame.corrected and column != 0:
                column = sp.Symbol(f"column_{names[i]}", real=True)
            for k, name in enumerate(names):
                if k == own:
                    impedances[i, k] = column * passes
                elif name in answers:
                    impedances[i, k] = self._s[i, k] - column * answers[name]
            forces[i] = self._e[i] + column * OWN
        for k, name in enumerate(names):
            if k == own:
                impedances[own, own] = ratio * passes * load + more_outer * passes + more_inner
            else:
                back = ratio * sign * stiffness - more_outer
                impedances[own, k] = cheapest(back * answers[name], []) if name in answers else ZERO
        if frame.about == "known":
            forces[own] = self._shares(known, bias, load, stiffness, ratio) + more + more_outer * OWN
        else:
            forces[own] = (more_outer - ratio * sign * stiffness) * OWN
            if not frame.residual:
                forces[own] += ratio * known + more
        self._set(impedances, forces)
        self._predict([ratio * known + more if i == own else self._p[i] for i in range(len(names))])
        return answers

    def _on_shaft(self, turning: Passed, gear: sp.Expr, known: sp.Expr) -> Shaft:
        """Eliminate the shaft between what turns it and its gear."""
        law, outside = turning.law.own, turning.element.outboard.motions[self.frame.own]
        torque = self._known(turning, law, TORQUES[0], "torque on each shaft at the point of linearisation")
        turned = -self.frame.sign * self._gain(law, outside)
        return Shaft((turned, gear), (torque, known), self.frame.sign, self.frame.impedance_unit)

    def _shares(
        self, known: sp.Expr, bias: sp.Expr, load: sp.Expr, stiffness: sp.Expr, ratio: sp.Expr
    ) -> sp.Expr:
        """Pass on the known torque and the force beyond by shares: no digits are lost in a stiff joint."""
        if stiffness == 0:
            return ratio * known
        sign, share = sp.Integer(self.frame.sign), ADMITTANCE * ratio * stiffness
        passes = next((x.symbol for x in self.lines if isinstance(x, Let) and x.value == share), None)
        if passes is None:
            passes = sp.Symbol("passed_share", real=True)
            self.lines.append(Let(passes, share, "share of the force beyond each joint passes on"))
        self.lines.append(
            Let(
                REFLECTION,
                ratio * sign * ADMITTANCE * load,
                "share of its own known torque each joint passes on",
            )
        )
        return passes * bias + REFLECTION * known

    def _gain(self, value: sp.Expr, motion: object) -> sp.Expr:
        return sp.expand(sp.Add(*(self.frame.gains[k] * sp.diff(value, getattr(motion, k)) for k in KINDS)))

    def _known(self, passed: Passed, value: sp.Expr, symbol: sp.Symbol, doc: str) -> sp.Expr:
        at_point = self.frame.settled(passed.at_point(value))
        if at_point == 0:
            return ZERO
        own, element = self.frame.own, passed.element
        inner, outer = (port.motions[own] for port in (element.inboard, element.outboard))
        differences = {k: (passed.point[getattr(inner, k)], passed.point[getattr(outer, k)]) for k in KINDS}
        if not at_point.is_Atom or self.frame.about == "prediction":
            self.known.append(Let(symbol, grouped(at_point, differences), doc, "N m"))
            return symbol
        return at_point

    # -- what is carried ------------------------------------------------------------------------------------

    def _set_impedance(self, values: Mapping[tuple[int, int], sp.Expr]) -> None:
        self._set(values, {})

    def _set(self, impedances: Mapping[tuple[int, int], sp.Expr], forces: Mapping[int, sp.Expr]) -> None:
        c = self.frame.coordinates
        update: dict[sp.Symbol, sp.Expr] = {}
        for i, row in enumerate(c):  # row by row: what a row needs is at hand when it is its turn
            for k, column in enumerate(c):
                if (i, k) in impedances:
                    self._s[i, k] = _changed(impedance(row, column), self._s[i, k], impedances[i, k], update)
            if i in forces:
                self._e[i] = _changed(force(row), self._e[i], forces[i], update)
        if update:
            self.lines.append(Update(update))
        of_forces = {force(row): update[force(row)] for row in c if force(row) in update}
        if of_forces:
            self.again.append(Update(of_forces))


def _changed(symbol: sp.Symbol, old: sp.Expr, new: sp.Expr, update: dict[sp.Symbol, sp.Expr]) -> sp.Expr:
    """Note a new value of what is carried, and return what stands for it."""
    if new == 0:
        return ZERO
    if new != old:
        update[symbol] = new
    return symbol


def grouped(value: sp.Expr, differences: Mapping[str, tuple[sp.Symbol, sp.Symbol]]) -> sp.Expr:
    """Write a law by differences of motion, where it is one: ``k (q_o - q_i)`` instead of two products."""
    value = sp.expand(value)
    found: list[sp.Expr] = []
    for inner, outer in differences.values():
        of_inner, of_outer = value.coeff(inner), value.coeff(outer)
        if of_outer != 0 and sp.expand(of_inner + of_outer) == 0:
            back = of_outer.could_extract_minus_sign()
            difference = inner - outer if back else outer - inner
            found.append(sp.Mul(-of_outer if back else of_outer, difference))
            value = sp.expand(value - of_outer * outer - of_inner * inner)
    return sp.Add(value, *found)


def cheapest(value: sp.Expr, levers: list[sp.Symbol]) -> sp.Expr:
    """Return the way of writing a value that takes the fewest operations."""
    symbols = value.free_symbols
    gains = [s for s in symbols if s.name.startswith("P_")]
    if not gains and len(symbols & set(levers)) < 2:
        return value
    expanded = sp.expand(value)
    written = (
        value,
        expanded,
        sp.factor_terms(value),
        sp.collect(expanded, levers),
        sp.collect(expanded, gains),
        sp.collect(expanded, [*levers, *gains]),
    )
    counts = [operations(e) for e in written]
    fewest = list(dict.fromkeys(e for e, count in zip(written, counts, strict=True) if count == min(counts)))
    return fewest[0] if len(fewest) == 1 else min(fewest, key=lambda e: len(str(e)))


def operations(e: sp.Expr) -> int:
    """Count additions and multiplications as printed; a change of sign is none."""
    if e.is_Atom:
        return 0
    inner = sum(operations(a) for a in e.args)
    if e.is_Mul:
        return inner + len([a for a in e.args if a not in (1, -1)]) - 1
    if e.is_Pow:
        return inner + abs(int(e.exp)) - 1 if e.exp.is_Integer and e.exp > 0 else inner + 1
    return inner + len(e.args) - 1


def back(inward: Inward) -> list[Line]:
    """Return the way out with the answers: the station's unknown, and the changes of its outer node."""
    frame = inward.frame
    unknown, before = sp.symbols("unknown inner_unknown", real=True)
    lines: list[Line] = []
    for passed, answers in inward.answers:
        if answers:
            value = answers["own"] + answers.get("inner", ZERO) * unknown
            for c in frame.coordinates:
                if c.name in answers:
                    value -= answers[c.name] * change(c)
            if inward.shaft is None:
                lines.append(Update({unknown: value}))
            else:
                lines.append(Let(before, unknown, "unknown of what a shaft is mounted on"))
                lines += [Update({unknown: value}), inward.shaft.answer(before, unknown)]
        for i, swing in passed.swings.items():
            moved = change(frame.coordinates[i])
            lines.append(Update({moved: moved + swing * unknown}))
    return lines

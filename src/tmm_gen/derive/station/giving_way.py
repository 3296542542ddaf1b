"""The way in over an element that gives way: a rank-one update, whose force row follows from its own law."""

from __future__ import annotations

import sympy as sp

from tmm_gen.derive.partial import partial
from tmm_gen.derive.station.carried import ZERO, Carried
from tmm_gen.derive.station.frame import RESIDUAL
from tmm_gen.derive.station.law import KINDS
from tmm_gen.derive.station.lets import Let, Line, Pivot
from tmm_gen.derive.station.motion import Passed
from tmm_gen.derive.station.shaft import PASSED, TORQUES, Shaft
from tmm_gen.derive.station.written import cheapest, grouped

ADMITTANCE = sp.Symbol("admittance", real=True)
TRANSMISSION = sp.Symbol("transmission", real=True)
REFLECTION = sp.Symbol("reflection", real=True)
OWN = sp.Symbol("answer_own", real=True)
STIFFNESS = sp.Symbol("joint_impedance", real=True)
PIVOT = sp.Symbol("pivot", real=True)
TORQUE = sp.Symbol("joint_torque", real=True)

_DOC = "torque of each joint at the point of linearisation"


class GivingWay:
    """Solves the law of an element for the motion beyond it, and takes what is carried over it.

    Parameters
    ----------
    passed : Passed
        The element, as the way out passes it.
    carried : Carried
        What changes.
    turning : Passed, optional
        What turns the shaft that its gear sits on, where there is one: both are one element then.
    """

    def __init__(self, passed: Passed, carried: Carried, turning: Passed | None = None) -> None:
        self.ahead: list[Line] = []
        """What known forces need besides motion: of parameters and gains alone."""
        self.known: list[Let] = []
        """Its forces at the point of linearisation; where these are told by what is left over, what shafts do of it."""
        self.answers: dict[str, sp.Expr] = {}
        """What the way out needs of its unknown: how that answers to what."""
        self.columns: dict[sp.Symbol, sp.Expr] = {}
        """Forces per unknown in the other coordinates, where somebody reads them after the sweep."""
        self.shaft: Shaft | None = None
        self._frame, self._passed, self._carried = carried.frame, passed, carried
        self._sign = sp.Integer(self._frame.sign)
        self._names = [c.name for c in self._frame.coordinates]
        # before they change
        own = self._frame.own
        self._load, self._bias = carried.impedances[own, own], carried.forces[own]
        law, inside = passed.law, passed.element.inboard.motions[own]
        outside = passed.element.outboard.motions[own]
        of_inner, of_outer = self._gain(law.own, inside), self._gain(law.own, outside)
        self._besides = self._gain(law.inner[own], inside), self._gain(law.inner[own], outside)
        """Slopes of what acts on its inner side besides its own force, by the motions of both sides."""
        known = self._known(passed, law.own, TORQUES[1] if turning else TORQUE, _DOC)
        more = self._known(
            passed,
            law.inner[own],
            sp.Symbol("inner_torque", real=True),
            "what acts on its inner side besides",
        )
        stiffness = -self._sign * of_outer
        if turning is not None:
            stiffness, known = self._on_shaft(turning, stiffness, known)
        if stiffness != 0:
            doc = "torque of a joint per difference of unknowns"
            (carried.lines if turning is None else self.ahead).append(
                Let(STIFFNESS, stiffness, doc, self._frame.impedance_unit)
            )
            stiffness = STIFFNESS
        symmetric = sp.expand(of_inner + law.ratio * of_outer) == 0
        self._answer(stiffness, known, law.ratio * stiffness if symmetric else self._sign * of_inner)
        if self._frame.predicted or self._frame.corrected:
            self._name_columns()
        self._pass_on(stiffness, known, more)
        if self._frame.residual:
            self.known = self._of_over()

    def _on_shaft(self, turning: Passed, gear: sp.Expr, known: sp.Expr) -> tuple[sp.Expr, sp.Expr]:
        """Eliminate the shaft between what turns it and its gear; return stiffness and torque of both together."""
        law, outside = turning.law.own, turning.element.outboard.motions[self._frame.own]
        torque = self._known(turning, law, TORQUES[0], "torque on each shaft at the point of linearisation")
        turned = -self._frame.sign * self._gain(law, outside)
        self.shaft = Shaft((turned, gear), (torque, known), self._frame.sign, self._frame.impedance_unit)
        self.ahead += self.shaft.ahead
        self.known += self.shaft.known(TORQUE, _DOC)
        return self.shaft.impedance, TORQUE

    def _answer(self, stiffness: sp.Expr, known: sp.Expr, inner_stiffness: sp.Expr) -> None:
        """Solve for the unknown: how it answers to forces and to the motion of the inner side."""
        sign, carried, own = self._sign, self._carried, self._frame.own
        over = (RESIDUAL + self._over if self._frame.residual else known) - self._bias
        carried.lines += [
            Let(PIVOT, stiffness + sign * self._load, "pivot of the joint"),
            Pivot(PIVOT),
            Let(ADMITTANCE, 1 / PIVOT, "inverse pivot of each joint"),
        ]
        self.answers["own"] = OWN
        answer = Let(
            OWN,
            ADMITTANCE * (over if sign > 0 else -over),
            "unknown of a station if its inner side kept its motion",
        )
        carried.lines.append(answer)
        carried.again.append(answer)
        for k, name in enumerate(self._names):
            if k != own and carried.impedances[own, k] != 0:
                self.answers[name] = sp.Symbol(f"answer_{name}", real=True)
                carried.lines.append(
                    Let(
                        self.answers[name],
                        sign * ADMITTANCE * carried.impedances[own, k],
                        f"answer of the unknown to the joint's acceleration along {name}",
                    )
                )
        if inner_stiffness != 0:
            self.answers["inner"] = TRANSMISSION
            carried.lines.append(
                Let(
                    TRANSMISSION,
                    ADMITTANCE * inner_stiffness,
                    "share of motion and torque each joint passes on",
                )
            )

    def _name_columns(self) -> None:
        unit = self._frame.impedance_unit.replace("kg m^2", "kg m")
        self.columns = {
            sp.Symbol(f"column_{name}", real=True): self._carried.impedances[k, self._frame.own]
            for k, name in enumerate(self._names)
            if k != self._frame.own
        }
        self._carried.lines += [
            Let(symbol, value, "force per unknown of the link", unit)
            for symbol, value in self.columns.items()
        ]

    def _pass_on(self, stiffness: sp.Expr, known: sp.Expr, more: sp.Expr) -> None:
        """Update what is carried: what the unknown answers to moves the forces on the inner side."""
        frame, own, sign, carried = self._frame, self._frame.own, self._sign, self._carried
        ratio, (more_inner, more_outer) = self._passed.law.ratio, self._besides
        passes = self.answers.get("inner", ZERO)
        impedances: dict[tuple[int, int], sp.Expr] = {}
        forces: dict[int, sp.Expr] = {}
        for i, of_row in enumerate(self._names):
            if i == own:
                continue
            column = carried.impedances[i, own]
            if frame.corrected and column != 0:
                column = sp.Symbol(f"column_{of_row}", real=True)
            for k, name in enumerate(self._names):
                if k == own:
                    impedances[i, k] = column * passes
                elif name in self.answers:
                    impedances[i, k] = carried.impedances[i, k] - column * self.answers[name]
            forces[i] = carried.forces[i] + column * OWN
        for k, name in enumerate(self._names):
            if k == own:
                impedances[own, own] = ratio * passes * self._load + more_outer * passes + more_inner
            else:
                back = ratio * sign * stiffness - more_outer
                impedances[own, k] = cheapest(back * self.answers[name], ()) if name in self.answers else ZERO
        if frame.about == "known":
            forces[own] = self._shares(known, stiffness) + more + more_outer * OWN
        else:
            forces[own] = (more_outer - ratio * sign * stiffness) * OWN
            forces[own] += ratio * self._over if frame.residual else ratio * known + more
        carried.set(impedances, forces)
        carried.predict(
            [ratio * known + more if i == own else carried.predicted[i] for i in range(len(self._names))]
        )

    def _shares(self, known: sp.Expr, stiffness: sp.Expr) -> sp.Expr:
        """Pass on the known torque and the force beyond by shares: no digits are lost in a stiff joint."""
        ratio, lines = self._passed.law.ratio, self._carried.lines
        if stiffness == 0:
            return ratio * known
        share = ADMITTANCE * ratio * stiffness
        passes = next((x.symbol for x in lines if isinstance(x, Let) and x.value == share), None)
        if passes is None:
            passes = sp.Symbol("passed_share", real=True)
            lines.append(Let(passes, share, "share of the force beyond each joint passes on"))
        lines.append(
            Let(
                REFLECTION,
                ratio * self._sign * ADMITTANCE * self._load,
                "share of its own known torque each joint passes on",
            )
        )
        return passes * self._bias + REFLECTION * known

    def _of_over(self) -> list[Let]:
        """Return what a shaft does where what the equations leave over is given."""
        return self.shaft.over if self.shaft else []

    @property
    def _over(self) -> sp.Expr:
        """Return what a shaft passes on where what the equations leave over is given."""
        return PASSED if self.shaft else ZERO

    def _gain(self, value: sp.Expr, motion: object) -> sp.Expr:
        return sp.expand(sp.Add(*(self._frame.gains[k] * partial(value, getattr(motion, k)) for k in KINDS)))

    def _known(self, passed: Passed, value: sp.Expr, symbol: sp.Symbol, doc: str) -> sp.Expr:
        """Return what stands for a force at the point of linearisation, and name it where it takes arithmetic."""
        at_point = self._frame.settled(passed.at_point(value))
        if at_point == 0:
            return ZERO
        own, element = self._frame.own, passed.element
        inner, outer = (port.motions[own] for port in (element.inboard, element.outboard))
        differences = {k: (passed.point[getattr(inner, k)], passed.point[getattr(outer, k)]) for k in KINDS}
        if not at_point.is_Atom or self._frame.about == "prediction":
            self.known.append(Let(symbol, grouped(at_point, differences), doc, "N m"))
            return symbol
        return at_point

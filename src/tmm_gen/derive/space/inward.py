"""The way in and back: the articulated inertia with joints eliminated one by one, and what each joint then does.

Beyond a section, forces are ``S k + e``: ``k`` is what changes of the section's accelerations, ``e`` what acts if
nothing does. A body adds to both. A joint gives way by its unknown, which its own law (spring, damper, rotor, motor)
determines: one pivot and one rank-one update. What has no mass passes both on, by congruence. The inertial
linearisation, in which angles and rates stand, leaves S symmetric.
"""

from __future__ import annotations

import sympy as sp

from tmm_gen.derive.space.congruence import congruent, entry_name, turned
from tmm_gen.derive.space.declaration import ACCEL, ALPHA, AXES
from tmm_gen.derive.space.equations import PassageEquations, body_equations
from tmm_gen.derive.space.outward import OWN_FORCE, OWN_MOMENT, Outward, body_of, relative_acceleration
from tmm_gen.derive.space.sheet import Sheet
from tmm_gen.derive.station.frame import GAINS
from tmm_gen.derive.station.lets import Let, Line, Pivot, Update

IMPEDANCE = sp.Symbol("joint_impedance", real=True)
"""Of the joint's own law: its torque per unknown."""
TORQUE = sp.Symbol("joint_torque", real=True)
"""What the joint's own law asks for before the sweep."""
ADMITTANCE = sp.Symbol("admittance", real=True)
IMBALANCE = sp.Symbol("imbalance", real=True)
OWN = sp.Symbol("unknown", real=True)
"""The joint's unknown."""
BIAS = sp.Matrix(
    [sp.Symbol(f"bias_{what}_{axis}", real=True) for what in ("force", "moment") for axis in AXES]
)
CHANGE = sp.Matrix(
    [sp.Symbol(f"change_{what}_{axis}", real=True) for what in ("accel", "alpha") for axis in AXES]
)
RELIEF = sp.Symbol("relief", real=True)
"""What the joint does where its section goes on as it did."""
YIELD = sp.Matrix(
    [sp.Symbol(f"yield_{what}_{axis}", real=True) for what in ("accel", "alpha") for axis in AXES]
)
"""What of an acceleration and an angular acceleration of its section the joint takes back, and what of a torque that it
lacks goes into force and moment there: inertias are symmetric."""


def _articulated() -> sp.Matrix:
    matrix = sp.zeros(6, 6)
    for i in range(6):
        for j in range(i, 6):
            name = "mass" if j < 3 else "coupling" if i < 3 else "inertia"
            matrix[i, j] = matrix[j, i] = sp.Symbol(
                f"articulated_{name}_{AXES[i % 3]}{AXES[j % 3]}", real=True
            )
    return matrix


ARTICULATED = _articulated()
CARRIED = (*(ARTICULATED[i, j] for i in range(6) for j in range(i, 6)), *BIAS)
"""What a sweep carries inward."""


class Inertial:
    """Derives one station of a sweep in the inertial linearisation.

    Parameters
    ----------
    out : Outward
        Its way out.
    gain : sympy.Expr
        Acceleration per unknown.
    acting : bool
        Whether bodies take forces; otherwise joints' torques alone act.
    products : bool
        Whether joints turn inertias by plain products; see :func:`~tmm_gen.derive.space.congruence.turned`.

    Attributes
    ----------
    inward : tuple of Line
        Of the first sweep.
    again : tuple of Line
        Of a correction: forces alone, with the factors of the first sweep.
    back : tuple of Line
        Outward, to the joint's unknown.
    """

    inward: tuple[Line, ...]
    again: tuple[Line, ...]
    back: tuple[Line, ...]

    def __init__(
        self, out: Outward, gain: sp.Expr = GAINS["a"], *, acting: bool = True, products: bool = False
    ) -> None:
        self._out, self._gain, self._acting, self._products = out, gain, acting, products
        self._axis = 3 + out.pattern.axis
        self._yield = sp.zeros(6, 1)
        if out.pattern.given:
            self.inward = self.again = ()
            self.back = unchanged(CHANGE)
            return
        self.inward = self._inward()
        self.again = self._again()
        self.back = self._back()

    def _inward(self) -> tuple[Line, ...]:
        sheet, axis, gain = Sheet(), self._axis, self._gain
        own = self._own()
        names = [entry_name("joined", i, j) for i in range(6) for j in range(6)]
        inertia = sp.zeros(6, 6)
        for i in range(6):
            for j in range(i, 6):
                value = own[i, j] + (0 if self._out.pattern.tip else ARTICULATED[i, j])
                inertia[i, j] = inertia[j, i] = sheet.named(names[6 * i + j], value)
        about = inertia[axis, :]
        pivot = gain * about[axis] + IMPEDANCE
        lines: list[Line] = [
            *sheet.lets,
            Pivot(pivot),
            Let(ADMITTANCE, 1 / pivot, "motion of the joint per torque in it"),
        ]
        bias, biased = self._balanced()
        lines += biased
        if self._out.pattern.unyielding:
            return tuple(lines)
        sheet = Sheet()
        self._yield = sp.Matrix([symbol if v != 0 else 0 for symbol, v in zip(YIELD, about, strict=True)])
        lines += [
            Let(symbol, ADMITTANCE * v, "of an acceleration of its section that the joint takes back")
            for symbol, v in zip(YIELD, about, strict=True)
            if v != 0
        ]
        share = sheet.named("share", IMPEDANCE * ADMITTANCE, "of what the joint does not give way by")
        scaled = [sheet.named(f"scaled_{name}", gain * v) for name, v in zip(YIELD, about, strict=True)]
        freed = sp.zeros(6, 6)
        for i in range(6):
            for j in range(i, 6):
                # the joint's own law says what moment it passes on: no small difference of large numbers
                own_law = axis in (i, j)
                value = share * about[i + j - axis] if own_law else inertia[i, j] - self._yield[i] * scaled[j]
                freed[i, j] = freed[j, i] = sheet.named(entry_name("freed", i, j), value)
        for crossing in reversed(self._out.crossings):
            through = through_accelerations(crossing.equations)
            if crossing.equations.forces != through.T:
                raise AssertionError("forces do not pass as power does")
            if crossing is self._out.crossings[-1] and not self._products:  # the joint itself
                freed = turned(sheet, freed, crossing.equations.turn, axis - 3)
            else:
                freed = congruent(sheet, freed, through)
        lines += sheet.lets
        update = {ARTICULATED[i, j]: freed[i, j] for i in range(6) for j in range(i, 6)}
        bias, passed = self._passed(bias)
        return (*lines, *passed, Update({**update, **bias}))

    def _own(self) -> sp.Matrix:
        if not self._out.pattern.massive:
            return sp.zeros(6, 6)
        body = body_equations(body_of(self._out.pattern))
        return sp.Matrix.vstack(body.force, body.moment).jacobian([*ACCEL, *ALPHA])

    def _balanced(self) -> tuple[sp.Matrix, list[Line]]:
        """Return the forces at the joint's outer side, and what torque the joint lacks."""
        sheet = Sheet()
        bias = acting_forces(sheet, self._out, own=self._acting)
        imbalance = Let(IMBALANCE, bias[self._axis] + TORQUE, "torque that the joint lacks", "N m")
        relief = Let(RELIEF, ADMITTANCE * IMBALANCE, "what the joint does by itself", "rad/s^2")
        return bias, [*sheet.lets, imbalance, relief]

    def _passed(self, bias: sp.Matrix) -> tuple[dict[sp.Symbol, sp.Expr], list[Line]]:
        """Return the forces at the station's inner side."""
        sheet, axis = Sheet(), self._axis
        moving = sheet.named("moving", self._gain * IMBALANCE)
        freed = sp.Matrix(
            [
                sheet.named(
                    f"left_{'force' if i < 3 else 'moment'}_{AXES[i % 3]}",
                    IMPEDANCE * RELIEF - TORQUE if i == axis else bias[i] - moving * self._yield[i],
                )
                for i in range(6)
            ]
        )
        *before, first = reversed(self._out.crossings)
        for crossing in before:
            freed = named_forces(sheet, crossing.equations.forces * freed)
        freed = first.equations.forces * freed
        return dict(zip(BIAS, freed, strict=True)), list(sheet.lets)

    def _again(self) -> tuple[Line, ...]:
        bias, lines = self._balanced()
        if self._out.pattern.unyielding:
            return tuple(lines)
        update, passed = self._passed(bias)
        return (*lines, *passed, Update(update))

    def _back(self) -> tuple[Line, ...]:
        pattern, sheet = self._out.pattern, Sheet()
        change = sp.zeros(6, 1) if pattern.unyielding else CHANGE
        for crossing in self._out.crossings:
            moved = through_accelerations(crossing.equations) * change
            change = sp.Matrix(
                [
                    sheet.named(f"moved_{'accel' if i < 3 else 'alpha'}_{AXES[i % 3]}", moved[i])
                    for i in range(6)
                ]
            )
        found = Let(OWN, -RELIEF - (self._yield.T * change)[0], "what the joint does")
        change[self._axis] += self._gain * OWN
        update = {s: v for s, v in zip(CHANGE, change, strict=True) if s != v}
        return (*sheet.lets, found, Update(update))


def unchanged(change: sp.Matrix) -> tuple[Line, ...]:
    """Return the way back over a joint whose motion is given: neither does it anything, nor changes its section."""
    none = sp.Integer(0)
    return (Let(OWN, none, "what the joint does"), Update(dict.fromkeys(change, none)))


def through_accelerations(equations: PassageEquations) -> sp.Matrix:
    """Return the change of accelerations at the outer side per change at the inner one, shape (6, 6)."""
    swing = relative_acceleration(equations.relative).jacobian(ALPHA)
    carried = equations.carried.jacobian(ALPHA)
    return sp.Matrix.vstack(
        sp.Matrix.hstack(equations.turn, swing), sp.Matrix.hstack(sp.zeros(3, 3), carried)
    )


def acting_forces(sheet: Sheet, out: Outward, *, own: bool = True) -> sp.Matrix:
    """Return the forces at the outer side of a station's joint, (6,): its body's own, and what hangs on it.

    Parameters
    ----------
    own : bool
        Whether the body takes any.
    """
    body = [*OWN_FORCE, *OWN_MOMENT] if own and out.pattern.acted else [sp.Integer(0)] * 6
    carried = [0 if out.pattern.tip else symbol for symbol in BIAS]
    return named_forces(
        sheet, sp.Matrix([mine + more for mine, more in zip(body, carried, strict=True)]), "acting"
    )


def named_forces(sheet: Sheet, forces: sp.Matrix, stage: str = "passed") -> sp.Matrix:
    """Return a force and a moment, (6,), by names."""
    names = [f"{stage}_{what}_{axis}" for what in ("force", "moment") for axis in AXES]
    return sp.Matrix([sheet.named(name, value) for name, value in zip(names, forces, strict=True)])

"""The way in and back: the articulated inertia with joints eliminated one by one, and what each joint then does.

Beyond a section, forces are ``S k + e``: ``k`` is what changes of the section's accelerations, ``e`` what acts if
nothing does. A body adds to both. A joint gives way by its unknown, which its own law (spring, damper, rotor, motor)
determines: one pivot and one rank-one update. What has no mass passes both on, by congruence. The inertial
linearisation, in which angles and rates stand, leaves S symmetric.
"""

from __future__ import annotations

import sympy as sp

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
AXIS_INERTIA = sp.Matrix(
    [sp.Symbol(f"axis_{what}_{axis}", real=True) for what in ("coupling", "inertia") for axis in AXES]
)
"""Moment about the joint's axis per acceleration and angular acceleration of its section, before it gives way."""


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

    def __init__(self, out: Outward, gain: sp.Expr = GAINS["a"], *, acting: bool = True) -> None:
        self._out, self._gain, self._acting = out, gain, acting
        self._axis = 3 + out.pattern.axis
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
        names = [_names("joined", i, j) for i in range(6) for j in range(6)]
        inertia = sp.zeros(6, 6)
        for i in range(6):
            for j in range(i, 6):
                value = own[i, j] + (0 if self._out.pattern.tip else ARTICULATED[i, j])
                inertia[i, j] = inertia[j, i] = sheet.named(names[6 * i + j], value)
        about_axis = inertia[axis, :]
        if self._out.pattern.unyielding:  # what it stands on rests
            about_axis = sp.Matrix([[v if k == axis else 0 for k, v in enumerate(about_axis)]])
        lines: list[Line] = [
            *sheet.lets,
            *(
                Let(s, v, "moment about the joint's axis")
                for s, v in zip(AXIS_INERTIA, about_axis, strict=True)
                if v != 0
            ),
        ]
        self._about = sp.Matrix([s if v != 0 else 0 for s, v in zip(AXIS_INERTIA, about_axis, strict=True)])
        about = self._about
        pivot = gain * about[axis] + IMPEDANCE
        lines += [Pivot(pivot), Let(ADMITTANCE, 1 / pivot, "motion of the joint per torque in it")]
        bias, biased = self._balanced()
        lines += biased
        if self._out.pattern.unyielding:
            return tuple(lines)
        sheet = Sheet()
        taken = sheet.named("giving", gain * ADMITTANCE, "what the joint gives way by")
        share = sheet.named("share", IMPEDANCE * ADMITTANCE, "of what the joint does not give way by")
        given = [
            sheet.named(f"given_{'force' if i < 3 else 'moment'}_{AXES[i % 3]}", taken * about[i])
            for i in range(6)
            if i != axis
        ]
        given.insert(axis, sp.Integer(0))
        freed = sp.zeros(6, 6)
        for i in range(6):
            for j in range(i, 6):
                # the joint's own law says what moment it passes on: no small difference of large numbers
                own_law = axis in (i, j)
                value = share * about[i + j - axis] if own_law else inertia[i, j] - given[i] * about[j]
                freed[i, j] = freed[j, i] = sheet.named(_names("freed", i, j), value)
        for crossing in reversed(self._out.crossings):
            through = through_accelerations(crossing.equations)
            if crossing.equations.forces != through.T:
                raise AssertionError("forces do not pass as power does")
            freed = _congruent(sheet, freed, through)
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
        return bias, [*sheet.lets, imbalance]

    def _passed(self, bias: sp.Matrix) -> tuple[dict[sp.Symbol, sp.Expr], list[Line]]:
        """Return the forces at the station's inner side."""
        sheet, axis = Sheet(), self._axis
        relief = sheet.named("relief", ADMITTANCE * IMBALANCE)
        moved = sheet.named("moved", self._gain * relief)
        freed = sp.Matrix(
            [
                sheet.named(
                    f"left_{'force' if i < 3 else 'moment'}_{AXES[i % 3]}",
                    IMPEDANCE * relief - TORQUE if i == axis else bias[i] - moved * self._about[i],
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
        lacking = IMBALANCE + (self._about.T * change)[0]
        found = Let(OWN, -ADMITTANCE * lacking, "what the joint does")
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


def _congruent(sheet: Sheet, inertia: sp.Matrix, through: sp.Matrix) -> sp.Matrix:
    """Return ``through^T inertia through``, named entry by entry."""
    half = inertia * through
    named = sp.Matrix(6, 6, lambda i, j: sheet.named(_names("half", i, j), half[i, j]))
    whole = through.T * named
    found = sp.zeros(6, 6)
    for i in range(6):
        for j in range(i, 6):
            found[i, j] = found[j, i] = sheet.named(_names("passed", i, j), whole[i, j])
    return found


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


def _names(stage: str, i: int, j: int) -> str:
    kind = {
        (True, True): "mass",
        (True, False): "coupling",
        (False, True): "lever",
        (False, False): "inertia",
    }
    return f"{stage}_{kind[i < 3, j < 3]}_{AXES[i % 3]}{AXES[j % 3]}"

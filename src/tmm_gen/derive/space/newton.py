"""The exact linearisation: Newton's own tangent, in which turns, rates and the forces that turn with joints count too.

Changes ``k`` of a section are those of its proper acceleration, its angular acceleration and its angular velocity;
orientations need none, since forces and accelerations are said in axes that turn along. Forces beyond a section change
by ``S k + e``, S of six rows and nine columns, and not symmetric.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

import sympy as sp

from tmm_gen.derive.space.declaration import ACCEL, ALPHA, ANGLE, AXES, OMEGA, RATE
from tmm_gen.derive.space.equations import body_equations, hinge_equations
from tmm_gen.derive.space.inward import ADMITTANCE, BIAS, IMBALANCE, IMPEDANCE, OWN, TORQUE, unchanged
from tmm_gen.derive.space.outward import COSINE, OWN_FORCE, OWN_MOMENT, SINE, Crossing, Outward, body_of
from tmm_gen.derive.space.shared import with_shared
from tmm_gen.derive.space.sheet import Sheet
from tmm_gen.derive.space.turning import HingeTurn
from tmm_gen.derive.station.lets import Let, Line, Pivot, Update

_MOTIONS = ("accel", "alpha", "omega")
_FORCES = ("force", "moment")
COLUMNS = [f"{what}_{axis}" for what in _MOTIONS for axis in AXES]
ROWS = [f"{what}_{axis}" for what in _FORCES for axis in AXES]
CHANGE = sp.Matrix([sp.Symbol(f"change_{name}", real=True) for name in COLUMNS])
SLOPES = sp.Matrix(6, 9, lambda i, j: sp.Symbol(f"{ROWS[i]}_by_{COLUMNS[j]}", real=True))
"""Change of a force per change of a section's motion."""
ABOUT_AXIS = sp.Matrix([sp.Symbol(f"axis_by_{name}", real=True) for name in COLUMNS]).T
"""The row of the moment about the joint's axis, before the joint gives way."""
PUSH = sp.Matrix([sp.Symbol(f"push_{name}", real=True) for name in COLUMNS])
"""Change of a section's motion per unknown of its joint."""
CARRIED = (*SLOPES, *BIAS)


class Newton:
    """Derives one station of an exact sweep; attributes as of :class:`~tmm_gen.derive.space.inward.Inertial`.

    Parameters
    ----------
    out : Outward
        Its way out, with what slopes are taken at kept.
    gains : sequence of 3 sympy.Expr
        Angle, rate and acceleration per unknown.
    """

    def __init__(self, out: Outward, gains: Sequence[sp.Expr]) -> None:
        self._out, self._gains = out, tuple(gains)
        self._axis = 3 + out.pattern.axis
        self.inward: tuple[Line, ...] = ()
        self.back: tuple[Line, ...] = unchanged(CHANGE)
        if out.pattern.given:
            return
        self._push = self._pushed()
        self.inward = self._inward()
        self.back = self._back()

    @property
    def kept(self) -> frozenset[sp.Symbol]:
        """What of the way out is read on the ways in and back."""
        named = {let.symbol for let in self._out.named}
        read: set[sp.Symbol] = set()
        for line in (*self.inward, *self.back):
            values = line.values.values() if isinstance(line, Update) else (line.value,)
            read |= {s for value in values for s in sp.sympify(value).free_symbols}
        return frozenset(named & read)

    def _pushed(self) -> sp.Matrix:
        """Return the change of the section's motion per unknown of its joint."""
        known = self._out.known
        crossing = self._out.crossings[-1]
        equations = hinge_equations(self._out.pattern.axis)
        by_angle, by_rate, by_acceleration = self._gains
        here = _at(crossing)

        def named(vector: sp.Matrix) -> sp.Matrix:
            return vector.applyfunc(lambda value: known(sp.expand(_by_circle(value).xreplace(here))))

        accel = by_angle * named(equations.turn.diff(ANGLE) * ACCEL)
        turning = named(equations.carried.diff(ANGLE)) + named(equations.swung.diff(ANGLE)) * RATE
        swung = named(equations.swung)
        alpha = by_angle * turning + by_rate * swung + by_acceleration * equations.pushed
        omega = by_angle * swung + by_rate * equations.pushed
        return sp.Matrix.vstack(accel, alpha, omega)

    def _inward(self) -> tuple[Line, ...]:
        sheet, axis, out = Sheet(), self._axis, self._out
        own = with_shared(sheet, self._own())
        slopes = sp.Matrix(
            6,
            9,
            lambda i, j: sheet.named(
                f"joined_{ROWS[i]}_by_{COLUMNS[j]}", own[i, j] + (0 if out.pattern.tip else SLOPES[i, j])
            ),
        )
        push = sp.Matrix([s if v != 0 else 0 for s, v in zip(PUSH, self._push, strict=True)])
        about = sp.Matrix([s if v != 0 else 0 for s, v in zip(ABOUT_AXIS, slopes[axis, :], strict=True)]).T
        self._kept_push, self._about = push, about
        lines: list[Line] = [
            Let(s, v, "of the section per unknown of its joint")
            for s, v in zip(PUSH, self._push, strict=True)
            if v != 0
        ]
        lines += sheet.lets
        lines += [
            Let(s, v, "moment about the joint's axis")
            for s, v in zip(ABOUT_AXIS, slopes[axis, :], strict=True)
            if v != 0
        ]
        sheet = Sheet()
        taken = [0 if out.pattern.tip else carried for carried in BIAS]
        own_forces = [*OWN_FORCE, *OWN_MOMENT] if out.pattern.acted else [sp.Integer(0)] * 6
        bias = sp.Matrix(
            [
                sheet.named(f"acting_{name}", mine + other)
                for name, mine, other in zip(ROWS, own_forces, taken, strict=True)
            ]
        )
        given = sp.Matrix([sheet.named(f"given_{ROWS[i]}", (slopes[i, :] * push)[0]) for i in range(6)])
        pivot = sheet.named("pivot", given[axis] + IMPEDANCE)
        lines += sheet.lets
        lines += [
            Pivot(pivot),
            Let(ADMITTANCE, 1 / pivot, "motion of the joint per torque in it"),
            Let(IMBALANCE, bias[axis] + TORQUE, "torque that the joint lacks", "N m"),
        ]
        if out.pattern.unyielding:
            return tuple(lines)
        sheet = Sheet()
        # the forces beyond the joint turn with it
        following = self._gains[0] * (_turning(out.pattern.axis) * bias)
        giving = sp.Matrix(
            [
                sheet.named(f"giving_{ROWS[i]}", ADMITTANCE * (given[i] + following[i])) if i != axis else 0
                for i in range(6)
            ]
        )
        # what a joint passes on about its axis is what its own law says
        share = sheet.named("share", IMPEDANCE * ADMITTANCE)
        freed = sp.Matrix(
            6,
            9,
            lambda i, j: sheet.named(
                f"freed_{ROWS[i]}_by_{COLUMNS[j]}",
                share * about[j] if i == axis else slopes[i, j] - giving[i] * about[j],
            ),
        )
        left = sp.Matrix(
            [
                sheet.named(
                    f"left_{ROWS[i]}",
                    share * IMBALANCE - TORQUE if i == axis else bias[i] - giving[i] * IMBALANCE,
                )
                for i in range(6)
            ]
        )
        for crossing in reversed(out.crossings):
            part, *turned = self._through(sheet, crossing)
            half = sp.Matrix(
                6, 9, lambda i, j, m=freed * part: sheet.named(f"half_{ROWS[i]}_by_{COLUMNS[j]}", m[i, j])
            )
            if turned:
                freed = _turned(HingeTurn(sheet, out.pattern.axis), half)
            else:
                freed = crossing.equations.forces * half
                freed = sp.Matrix(
                    6, 9, lambda i, j, m=freed: sheet.named(f"passed_{ROWS[i]}_by_{COLUMNS[j]}", m[i, j])
                )
            left = crossing.equations.forces * left
            left = sp.Matrix([sheet.named(f"passed_{ROWS[i]}", left[i]) for i in range(6)])
        lines += sheet.lets
        update = dict(zip((*SLOPES, *BIAS), (*freed, *left), strict=True))
        return (*lines, Update({s: v for s, v in update.items() if s != v}))

    def _own(self) -> sp.Matrix:
        """Return the slopes of the forces that the body takes."""
        pattern, out = self._out.pattern, self._out
        if not pattern.massive:
            return sp.zeros(6, 9)
        body = body_equations(body_of(pattern))
        force = body.force + OMEGA.cross(body.momentum)
        moment = body.moment + OMEGA.cross(body.spin)
        slopes = sp.Matrix.vstack(force, moment).jacobian([*ACCEL, *ALPHA, *OMEGA])
        own = dict(zip(OMEGA, out.omega, strict=True))
        rates = sorted(out.omega.free_symbols, key=lambda s: s.name)
        return slopes.applyfunc(lambda value: sp.collect(sp.expand(value.xreplace(own)), rates))

    def _through(self, sheet: Sheet, crossing: Crossing) -> tuple[sp.Matrix, ...]:
        """Return the change of a section's motion at the outer side of an element per change at its inner one.

        As factors, outer first: a hinge's rate acts on what its turn has turned already. Entries that take arithmetic
        are named, since they are used row by row.
        """
        equations = crossing.equations
        relative = equations.relative
        alpha = equations.carried + equations.swung * RATE
        accel = equations.turn * ACCEL + relative.jacobian(OMEGA) * ALPHA + equations.omega.cross(relative)
        whole = sp.Matrix.vstack(accel, alpha, equations.omega).jacobian([*ACCEL, *ALPHA, *OMEGA])
        here = _at(crossing)
        whole = whole.applyfunc(lambda value: sp.factor_terms(sp.expand(value).xreplace(here)))
        if equations.swung.is_zero_matrix:
            return (_named(sheet, with_shared(sheet, whole)),)
        turned = sp.diag(*[equations.turn] * 3)
        # the inverse of a turn is its transpose
        return (whole * turned.T).applyfunc(_on_circle), turned

    def _back(self) -> tuple[Line, ...]:
        pattern, sheet = self._out.pattern, Sheet()
        change = sp.zeros(9, 1) if pattern.unyielding else CHANGE
        for crossing in self._out.crossings:
            for part in reversed(self._through(sheet, crossing)):
                moved = part * change
                change = sp.Matrix([sheet.named(f"moved_{COLUMNS[j]}", moved[j]) for j in range(9)])
        lacking = IMBALANCE + (self._about * change)[0]
        found = Let(OWN, -ADMITTANCE * lacking, "what the joint does")
        change = change + self._kept_push * OWN
        update = {s: v for s, v in zip(CHANGE, change, strict=True) if s != v}
        return (*sheet.lets, found, Update(update))


def _at(crossing: Crossing) -> dict[sp.Symbol, sp.Expr]:
    """Map the motion at an element's inner side to what it is there."""
    return {
        **dict(zip(OMEGA, crossing.omega, strict=True)),
        **dict(zip(ALPHA, crossing.alpha, strict=True)),
        **dict(zip(ACCEL, crossing.accel, strict=True)),
    }


def _turned(turn: HingeTurn, slopes: sp.Matrix) -> sp.Matrix:
    return sp.Matrix.vstack(
        *(
            sp.Matrix.hstack(
                *(
                    turn.block(f"{force}_by_{motion}", slopes[3 * r : 3 * r + 3, 3 * c : 3 * c + 3])
                    for c, motion in enumerate(_MOTIONS)
                )
            )
            for r, force in enumerate(_FORCES)
        )
    )


def _named(sheet: Sheet, through: sp.Matrix) -> sp.Matrix:
    return sp.Matrix(
        9, 9, lambda i, j: sheet.named(f"{COLUMNS[i]}_by_{COLUMNS[j]}", through[i, j], "across the link")
    )


def _on_circle(value: sp.Expr) -> sp.Expr:
    return sp.expand(sp.expand(value).subs(SINE**2, 1 - COSINE**2))


def _by_circle(value: sp.Expr) -> sp.Expr:
    return value.xreplace({sp.sin(ANGLE): SINE, sp.cos(ANGLE): COSINE})


@cache
def _turning(axis: int) -> sp.ImmutableMatrix:
    """Return what a small turn makes of forces that turn with the joint, seen from its outer side."""
    forces = hinge_equations(axis).forces
    return sp.ImmutableMatrix((forces.T * forces.diff(ANGLE)).applyfunc(sp.trigsimp))

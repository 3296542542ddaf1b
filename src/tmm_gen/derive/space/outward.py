"""The way out: exact motion of a section by that of the one before, and the force that its body takes."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import sympy as sp

from tmm_gen.derive.space.declaration import (
    ACCEL,
    ACCELERATION,
    ALPHA,
    ANGLE,
    OMEGA,
    RATE,
    Body,
    offset,
    rigid_body,
    turned,
    vector,
)
from tmm_gen.derive.space.equations import (
    PassageEquations,
    body_equations,
    hinge_equations,
    passage_equations,
)
from tmm_gen.derive.space.pattern import Pattern
from tmm_gen.derive.space.sheet import Sheet
from tmm_gen.derive.station.lets import Let, Line, Update

SINE, COSINE = sp.symbols("sine cosine", real=True)
"""Of the hinge's angle."""
HOST_OMEGA, HOST_ALPHA, HOST_ACCEL = (vector(f"host_{what}") for what in ("omega", "alpha", "accel"))
"""Motion of what a joint stands on, kept where slopes are taken."""
_CIRCLE = {sp.sin(ANGLE): SINE, sp.cos(ANGLE): COSINE}
OWN_FORCE = sp.Matrix(sp.symbols("own_force_x own_force_y own_force_z", real=True))
OWN_MOMENT = sp.Matrix(sp.symbols("own_moment_x own_moment_y own_moment_z", real=True))
"""What the body itself takes."""


@dataclass(frozen=True)
class Crossing:
    """A massless element at one place of the way out.

    Parameters
    ----------
    equations : PassageEquations
        Written by the place's own offset and turn, and by sine and cosine.
    omega, alpha, accel : sympy.Matrix
        Motion at its inner side.
    """

    equations: PassageEquations
    omega: sp.Matrix
    alpha: sp.Matrix
    accel: sp.Matrix


class Outward:
    """Derives the way out over one station.

    Parameters
    ----------
    pattern : Pattern
        Of the station.
    still : bool
        Whether the hinge's acceleration is zero, as it is where a step is predicted without any; one that is given is
        not.
    sloped : bool
        Whether slopes are taken there too: the motion at the inner side gets names, so that it can be kept.

    Attributes
    ----------
    lines : tuple of Line
        Named values, then the update of what is carried.
    crossings : tuple of Crossing
        Inner to outer.
    named : tuple of Let
        The named values among them that stand for motion.
    sheet : Sheet
        With all names.
    omega, alpha, accel : sympy.Matrix
        Motion of the station's own section.
    """

    def __init__(self, pattern: Pattern, *, still: bool, sloped: bool = False) -> None:
        self.pattern, self.sheet, self._sloped = pattern, Sheet(), sloped
        self._acceleration = sp.Integer(0) if still and not pattern.given else ACCELERATION
        self.omega, self.alpha, self.accel = pattern.inner_motion
        copies: list[Let] = []
        if sloped and not pattern.rooted:
            copies = [
                Let(symbol, value, "of what the joint stands on")
                for symbol, value in zip(
                    (*HOST_OMEGA, *HOST_ALPHA, *HOST_ACCEL), (*OMEGA, *ALPHA, *ACCEL), strict=True
                )
            ]
            self.omega, self.alpha, self.accel = HOST_OMEGA, HOST_ALPHA, HOST_ACCEL
        circle = [
            Let(SINE, sp.sin(ANGLE), "sine of the joint's angle"),
            Let(COSINE, sp.cos(ANGLE), "its cosine"),
        ]
        *before, last = passages(pattern)
        self.crossings = (*(self._cross(e, "mount") for e in before), self._cross(last, "own"))
        own = body_force(self.sheet, pattern, self.omega, self.alpha, self.accel, (OWN_FORCE, OWN_MOMENT))
        own = [let for let in own if let.symbol in wanted_forces(pattern)]
        carried = dict(zip((*OMEGA, *ALPHA, *ACCEL), (*self.omega, *self.alpha, *self.accel), strict=True))
        ends = pattern.driven and pattern.tip  # nobody asks how it moves
        update = {s: v for s, v in carried.items() if s != v and not ends}
        self.named = (*circle, *copies, *self.sheet.lets)
        self.lines: tuple[Line, ...] = (*self.named, *own, Update(update))

    def _cross(self, equations: PassageEquations, where: str) -> Crossing:
        found = Crossing(equations, self.omega, self.alpha, self.accel)
        motion = {
            **dict(zip(OMEGA, self.omega, strict=True)),
            **dict(zip(ALPHA, self.alpha, strict=True)),
        }
        sheet = self.sheet

        def here(value: sp.Matrix) -> sp.Matrix:
            return value.xreplace(motion).applyfunc(sp.expand)

        relative = sheet.vector("relative", here(equations.relative), "velocity across the link", "m/s")
        self.omega = sheet.vector(f"{where}_omega", here(equations.omega), "angular velocity", "rad/s")
        swung = known(sheet, here(equations.swung))
        carried = here(equations.carried)
        if self._sloped and where == "own":
            carried = sheet.vector(
                "turned_alpha", carried, "angular acceleration before the joint's own", "rad/s^2"
            )
        alpha = carried + swung * RATE + equations.pushed * self._acceleration
        speeding = relative_acceleration(equations.relative).xreplace(motion)
        accel = equations.turn * self.accel + speeding + self.omega.cross(relative)
        self.alpha = sheet.vector(f"{where}_alpha", alpha, "angular acceleration", "rad/s^2")
        self.accel = sheet.vector(f"{where}_accel", accel, "proper acceleration", "m/s^2")
        return found

    def known(self, value: sp.Expr) -> sp.Expr:
        """Return a value by its name if it has one."""
        return value if (found := self.sheet.known(value)) is None else found


def body_force(
    sheet: Sheet,
    pattern: Pattern,
    omega: sp.Matrix,
    alpha: sp.Matrix,
    accel: sp.Matrix,
    names: tuple[sp.Matrix, sp.Matrix],
) -> list[Let]:
    """Return the force and the moment that a body takes, by the motion of its section; nothing of none.

    Parameters
    ----------
    sheet : Sheet
        Receives what is named on the way; it comes before.
    names : tuple of 2 sympy.Matrix
        Of the force and of the moment.
    """
    if not pattern.massive:
        unit = {**dict.fromkeys(names[0], "N"), **dict.fromkeys(names[1], "N m")} if pattern.loaded else {}
        return [
            Let(symbol, sp.Integer(0), "what acts where nothing has mass", unit[symbol]) for symbol in unit
        ]
    body = body_equations(body_of(pattern))
    motion = {
        **dict(zip(OMEGA, omega, strict=True)),
        **dict(zip(ALPHA, alpha, strict=True)),
        **dict(zip(ACCEL, accel, strict=True)),
    }
    momentum = sheet.vector("momentum", body.momentum.xreplace(motion), "momentum of turning", "kg m/s")
    spin = sheet.vector("spin", body.spin.xreplace(motion), "angular momentum", "kg m^2/s")
    force = body.force.xreplace(motion) + omega.cross(momentum)
    moment = body.moment.xreplace(motion) + omega.cross(spin)
    return [
        Let(symbol, value, doc, unit)
        for symbols, values, doc, unit in (
            (names[0], force, "force that the body takes", "N"),
            (names[1], moment, "moment that the body takes", "N m"),
        )
        for symbol, value in zip(symbols, values, strict=True)
    ]


def wanted_forces(pattern: Pattern) -> frozenset[sp.Symbol]:
    """Return what is asked for of the force and the moment that a body takes.

    Of a joint whose motion is given that is nothing, of one that stands on such a joint what is about its own axis.
    """
    if pattern.given:
        return frozenset()
    return frozenset([OWN_MOMENT[pattern.axis]] if pattern.driven else (*OWN_FORCE, *OWN_MOMENT))


def relative_acceleration(relative: sp.Matrix) -> sp.Matrix:
    """Return the derivative of a relative velocity by its components' time, where it follows the angular velocity."""
    return relative.jacobian(OMEGA) * ALPHA


def known(sheet: Sheet, values: sp.Matrix) -> sp.Matrix:
    """Return components by their names where they have one."""
    return values.applyfunc(lambda value: value if (found := sheet.known(value)) is None else found)


def body_of(pattern: Pattern) -> Body:
    """Return the body of a pattern."""
    return rigid_body(pattern.mass_symbol, pattern.symbols["first_moment"], pattern.inertia_symbols)


_PASSAGES: dict[tuple[object, ...], tuple[PassageEquations, ...]] = {}


def passages(pattern: Pattern) -> tuple[PassageEquations, ...]:
    """Return the massless elements of a station, inner to outer; those that change nothing are left out."""
    key = (pattern.axis, pattern.offset, pattern.turn)
    if key not in _PASSAGES:
        symbols = pattern.symbols
        found = []
        if any(pattern.offset):
            found.append(passage_equations(offset(symbols["offset"])))
        if symbols["turn"] != sp.eye(3):
            found.append(passage_equations(turned(symbols["turn"])))
        found.append(_hinge(pattern.axis))
        _PASSAGES[key] = tuple(found)
    return _PASSAGES[key]


@cache
def _hinge(axis: int) -> PassageEquations:
    return _by_circle(hinge_equations(axis))


def _by_circle(equations: PassageEquations) -> PassageEquations:
    return PassageEquations(**{name: value.xreplace(_CIRCLE) for name, value in vars(equations).items()})

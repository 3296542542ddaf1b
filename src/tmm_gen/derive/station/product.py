"""The plain product of transfer matrices, carried outward (Gholampour 2018, eqs. 2-82, 3-19), for one coordinate.

It multiplies growing and decaying solutions together and loses their difference: digits vanish with every station.
Kept because the thesis uses it.
"""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from tmm_gen.derive.partial import partial
from tmm_gen.derive.station.frame import Frame
from tmm_gen.derive.station.law import KINDS
from tmm_gen.derive.station.lets import Let, Line, Update
from tmm_gen.derive.station.motion import Outward, Passed
from tmm_gen.errors import UserError

MOTION_GAIN, FORCE_GAIN = sp.symbols("motion_gain force_gain", real=True)
"""Unknown and force at a place per unknown of the base."""
MOTION, FORCE = sp.symbols("known_unknown known_torque", real=True)
"""The same if the unknown of the base were zero."""
COMPLIANCE = sp.Symbol("compliance", real=True)


@dataclass(frozen=True)
class Product:
    """What walking out over some elements changes.

    Parameters
    ----------
    gains : tuple of Line
        Of motion and force per unknown of the base.
    known : tuple of Line
        Of what is known of them.
    gives_way : bool
        Whether every element that gives way has an impedance to divide by.
    """

    gains: tuple[Line, ...]
    known: tuple[Line, ...]
    gives_way: bool


def product(out: Outward, known_forces: list[Let]) -> Product:
    """Derive the product over some elements.

    Parameters
    ----------
    known_forces : list of Let
        Named forces of elements that give way, inner to outer.
    """
    gains: list[Line] = []
    known: list[Line] = []
    names = [let.symbol for let in known_forces]
    gives_way = True
    for passed in out.passed:
        if passed.law.free is None:
            _through(passed, out.frame, gains, known)
        else:
            gives_way &= _over(passed, out.frame, names, gains, known)
    return Product(tuple(gains), tuple(known), gives_way)


def _through(passed: Passed, frame: Frame, gains: list[Line], known: list[Line]) -> None:
    """Solve the balance of an element with motion through it for the force at its outer side."""
    own = frame.own
    law, outside = passed.at_point(passed.law.inner[own]), passed.element.outboard.forces[own]
    share = partial(law, outside)
    slope = sp.Add(*(frame.gains[k] * frame.slope(law, k) for k in KINDS))
    rest = frame.settled(law - share * outside)
    if slope != 0 or share != 1:
        gains.append(Update({FORCE_GAIN: (FORCE_GAIN - slope * MOTION_GAIN) / share}))
    if rest != 0 or slope != 0 or share != 1:
        known.append(Update({FORCE: (FORCE - sp.expand(rest) - slope * MOTION) / share}))


def _over(passed: Passed, frame: Frame, names: list[sp.Symbol], gains: list[Line], known: list[Line]) -> bool:
    """Solve the law of an element that gives way for the motion beyond it."""
    own, law = frame.own, passed.law
    inside, outside = passed.element.inboard.motions[own], passed.element.outboard.motions[own]

    def gain(value: sp.Expr, motion: object) -> sp.Expr:
        return sp.expand(sp.Add(*(frame.gains[k] * partial(value, getattr(motion, k)) for k in KINDS)))

    besides = law.inner[own]
    inner = law.ratio * gain(law.own, inside) + gain(besides, inside)
    outer = law.ratio * gain(law.own, outside) + gain(besides, outside)
    if outer == 0:
        return False
    sign = -sp.Integer(frame.sign)
    gains.append(Let(COMPLIANCE, 1 / sp.expand(sign * outer), "inverse joint impedance"))
    at_motion = names.pop(0) if frame.settled(passed.at_point(law.own)) != 0 else sp.Integer(0)
    more = names.pop(0) if frame.settled(passed.at_point(besides)) != 0 else sp.Integer(0)
    share = sp.cancel(-inner / outer)
    gains.append(Update({MOTION_GAIN: share * MOTION_GAIN + sign * COMPLIANCE * FORCE_GAIN}))
    left = FORCE - law.ratio * at_motion - more
    known.append(Update({MOTION: share * MOTION + sign * COMPLIANCE * left}))
    if law.ratio != 1 or besides != 0:
        raise UserError(
            f"element '{passed.element.name}': its inner force is not its outer one, which a plain product of transfer "
            'matrices cannot hand on yet. Set model.sweep = "riccati".'
        )
    return True


__all__ = ["COMPLIANCE", "FORCE", "FORCE_GAIN", "MOTION", "MOTION_GAIN", "Product", "product"]

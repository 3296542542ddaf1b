"""A shaft without inertia, between what turns it and its gear: its unknown is eliminated before the sweep.

The torques at both its sides are one. With impedances ``Z_m`` of what turns it and ``Z_k`` of its gear, what stands
beyond sees ``Z_m Z_k / (Z_m + Z_k)``, and of both known torques the shares that the impedances give them: factors of
parameters and gains alone.
"""

from __future__ import annotations

from dataclasses import dataclass

import sympy as sp

from tmm_gen.derive.station.lets import Let, Line, Pivot, Update

UNKNOWN = sp.Symbol("shaft_unknown", real=True)
OWN = sp.Symbol("shaft_answer", real=True)
TORQUES = sp.symbols("shaft_torque gear_torque", real=True)
"""Of what turns a shaft, and of its gear, at the point of linearisation."""
_IMPEDANCES = sp.symbols("shaft_impedance gear_impedance", real=True)
_SHARES = sp.symbols("mount_share gear_share", real=True)
_PIVOT, _ADMITTANCE = sp.symbols("shaft_pivot shaft_admittance", real=True)
GAP = sp.Symbol("torque_gap", real=True)
"""What is over of the torques on a shaft."""
PASSED = sp.Symbol("passed_gap", real=True)
"""What of it the shaft passes on to both its sides as it gives way."""
_OF = "torque on a shaft per difference of unknowns, of what turns it", "the same of its gear"
_IN = "share of what it is mounted on in a shaft's motion", "share of what its gear turns in a shaft's motion"


@dataclass(frozen=True)
class Shaft:
    """What a sweep needs of a shaft.

    Parameters
    ----------
    laws : tuple of 2 sympy.Expr
        Torque per difference of unknowns, of what turns it and of its gear.
    torques : tuple of 2 sympy.Expr
        Of both at the point of linearisation.
    sign : int
        Of the frame.
    unit : str
        Of torques per unknown.
    """

    laws: tuple[sp.Expr, sp.Expr]
    torques: tuple[sp.Expr, sp.Expr]
    sign: int
    unit: str

    @property
    def ahead(self) -> list[Line]:
        """Its factors, of parameters and gains alone."""
        z = self._named(_IMPEDANCES)
        laws = zip(z, self.laws, _OF, strict=True)
        shares = zip(self._named(_SHARES), z, _IN, strict=True)
        return [
            *(Let(symbol, law, doc, self.unit) for symbol, law, doc in laws if law != 0),
            Let(_PIVOT, sp.Add(*z), "pivot of a shaft", self.unit),
            Pivot(_PIVOT),
            Let(_ADMITTANCE, 1 / _PIVOT, "inverse pivot of a shaft"),
            *(Let(symbol, _ADMITTANCE * own, doc) for symbol, own, doc in shares if own != 0),
        ]

    @property
    def impedance(self) -> sp.Expr:
        """Torque per difference of unknowns of both, one behind the other."""
        return self._named(_SHARES)[1] * self._named(_IMPEDANCES)[0]

    def known(self, torque: sp.Symbol, doc: str) -> list[Let]:
        """Return the torque of both together, and how their difference moves the shaft."""
        return [
            gap(self.torques),
            self._moved,
            Let(torque, self.torques[1] + self._named(_SHARES)[1] * GAP, doc, "N m"),
        ]

    @property
    def over(self) -> list[Let]:
        """Return how what is known to be over moves the shaft, and what of it both together have beside the gear's."""
        doc = "what is over of the torques on a shaft, as it passes it on"
        return [self._moved, Let(PASSED, self._named(_SHARES)[1] * GAP, doc, "N m")]

    @property
    def _moved(self) -> Let:
        doc = "unknown of a shaft if both its sides kept their motion"
        return Let(OWN, self.sign * _ADMITTANCE * GAP, doc)

    def answer(self, inner: sp.Symbol, outer: sp.Symbol) -> Line:
        """Return its unknown by those of both its sides."""
        of_inner, of_outer = self._named(_SHARES)
        return Update({UNKNOWN: OWN + of_inner * inner + of_outer * outer})

    def _named(self, symbols: tuple[sp.Symbol, sp.Symbol]) -> list[sp.Expr]:
        """Return what stands for a value of both sides, zero where a method leaves no torque there."""
        return [symbol if law != 0 else sp.Integer(0) for symbol, law in zip(symbols, self.laws, strict=True)]


def gap(torques: tuple[sp.Expr, sp.Expr]) -> Let:
    """Return what is over of the torques on a shaft.

    Parameters
    ----------
    torques : tuple of 2 sympy.Expr
        Of what turns it, and of its gear.
    """
    return Let(GAP, torques[0] - torques[1], "what is over of the torques on a shaft", "N m")

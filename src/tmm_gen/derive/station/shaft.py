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
SHARES = sp.symbols("mount_share gear_share", real=True)
"""Of what it is mounted on and of what its gear turns, in its own motion."""
OWN = sp.Symbol("shaft_answer", real=True)
TORQUES = sp.symbols("shaft_torque gear_torque", real=True)
"""Of what turns a shaft, and of its gear, at the point of linearisation."""
_MOUNT, _GEAR, _PIVOT, _ADMITTANCE, _GAP = sp.symbols(
    "shaft_impedance gear_impedance shaft_pivot shaft_admittance torque_gap", real=True
)


@dataclass(frozen=True)
class Shaft:
    """What a sweep needs of a shaft.

    Parameters
    ----------
    turned, gear : sympy.Expr
        Torque per difference of unknowns, of what turns it and of its gear.
    torques : tuple of 2 sympy.Expr
        Both at the point of linearisation.
    sign : int
        Of the frame.
    unit : str
        Of the impedances.
    """

    turned: sp.Expr
    gear: sp.Expr
    torques: tuple[sp.Expr, sp.Expr]
    sign: int
    unit: str

    @property
    def ahead(self) -> list[Line]:
        """Its factors, of parameters and gains alone."""
        return [
            Let(_MOUNT, self.turned, "torque on a shaft per difference of unknowns", self.unit),
            Let(_GEAR, self.gear, "torque of a gear per difference of unknowns", self.unit),
            Let(_PIVOT, _MOUNT + _GEAR, "pivot of a shaft", self.unit),
            Pivot(_PIVOT),
            Let(_ADMITTANCE, 1 / _PIVOT, "inverse pivot of a shaft"),
            Let(SHARES[0], _ADMITTANCE * _MOUNT, "share of what it is mounted on in a shaft's motion"),
            Let(SHARES[1], _ADMITTANCE * _GEAR, "share of what its gear turns in a shaft's motion"),
        ]

    @property
    def impedance(self) -> sp.Expr:
        """What stands beyond sees of both, per difference of unknowns."""
        return SHARES[1] * _MOUNT if self.gear != 0 else sp.Integer(0)

    def known(self, torque: sp.Symbol, doc: str) -> list[Let]:
        """Return the torque that both have together, and the shaft's own answer to their difference."""
        drive, gear = self.torques
        return [
            Let(_GAP, drive - gear, "what would turn a shaft if all kept its motion", "N m"),
            Let(OWN, self.sign * _ADMITTANCE * _GAP, "unknown of a shaft if both its sides kept their motion"),
            Let(torque, gear + SHARES[1] * _GAP if self.gear != 0 else gear, doc, "N m"),
        ]

    def answer(self, inner: sp.Symbol, outer: sp.Symbol) -> Line:
        """Return its unknown by those of both its sides."""
        moved = SHARES[0] * inner + SHARES[1] * outer if self.gear != 0 else inner
        return Update({UNKNOWN: OWN + moved})

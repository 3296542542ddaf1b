"""What holds up an arm in space that does not bend, as sums of products that C can compute.

Each hub turns all behind it, and so the place of any body takes its cosine and its sine at most once: what gravity
asks of a motor is a sum of products of 1, the cosine or the sine of each hub's angle. Three angles of each hub tell
these sums.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.arm.arm import ControlledArm

Array = NDArray[np.float64]

_NOTHING = 1e-12
"""Of the largest amount: what rounding leaves of terms there are none of."""


@dataclass(frozen=True)
class Term:
    """A product that is part of a motor's torque.

    Parameters
    ----------
    motor : int
        Which, from 0.
    factors : tuple of int, (m,)
        Of each hub's angle: 0 for 1, 1 for its cosine, 2 for its sine.
    amount : float
        N m.
    more : float
        By which it grows for each kilogram of payload, N m/kg.
    """

    motor: int
    factors: tuple[int, ...]
    amount: float
    more: float = 0.0


@dataclass(frozen=True)
class Weight:
    """Torques that hold an arm that does not bend.

    Parameters
    ----------
    terms : tuple of Term
        None where nothing falls.
    """

    terms: tuple[Term, ...]

    @property
    def amounts(self) -> Array:
        """Of the terms, N m."""
        return np.array([term.amount for term in self.terms])

    @property
    def more(self) -> Array:
        """By which these grow with the payload, N m/kg."""
        return np.array([term.more for term in self.terms])

    @property
    def motors(self) -> list[int]:
        """Which motor each term is for."""
        return [term.motor for term in self.terms]

    def torques(self, hub: Array) -> Array:
        """Return them for hubs somewhere, (m,), rad, N m."""
        values = np.array([np.ones_like(hub), np.cos(hub), np.sin(hub)])
        found = np.zeros(len(hub))
        for term in self.terms:
            found[term.motor] += term.amount * np.prod(values[list(term.factors), range(len(hub))])
        return found

    def beside(self, hub: Array, torque: Array) -> Array:
        """Return what torques are beside these, (m,), N m: what bending and springs of motors take."""
        return np.asarray(torque - self.torques(hub), float)


def weight_of(arm: ControlledArm, heavier: ControlledArm, motors: int) -> Weight:
    """Return what holds up an arm that does not bend.

    Parameters
    ----------
    arm, heavier : ControlledArm
        In space; the same with a kilogram more of payload, or as it is.
    motors : int
        m.
    """
    angles = 2.0 * np.pi * np.arange(3) / 3.0
    hubs = np.array(list(product(angles, repeat=motors)))
    still = np.zeros_like(hubs)
    asked = np.stack([each.rigid_torques(hubs, still, still) for each in (arm, heavier)], axis=-1)
    asked = asked.reshape(*(3,) * motors, motors, 2)
    terms_of = np.linalg.inv(np.column_stack([np.ones(3), np.cos(angles), np.sin(angles)]))
    for axis in range(motors):
        asked = np.moveaxis(np.tensordot(terms_of, asked, (1, axis)), 0, axis)
    least = _NOTHING * float(np.max(np.abs(asked), initial=0.0))
    places = np.argwhere(np.max(np.abs(asked), axis=-1) > least)
    return Weight(
        tuple(
            Term(int(motor), tuple(map(int, at)), float(amount), float(heavy - amount))
            for *at, motor in places
            for amount, heavy in [asked[(*at, motor)]]
        )
    )

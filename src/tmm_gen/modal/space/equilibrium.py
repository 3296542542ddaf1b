"""Where an arm in space comes to rest: by following its descent to the bottom, or near where one looks."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from tmm_gen.errors import UserError
from tmm_gen.modal.equilibrium import not_near
from tmm_gen.modal.search import NEWTON_STEPS
from tmm_gen.modal.space.judged import require_energy, require_numbers
from tmm_gen.modal.space.numbers import ArmNumbers
from tmm_gen.modal.space.springs import SpaceSprings
from tmm_gen.modal.space.still import ROUNDING, Still

Array = NDArray[np.float64]

_STEPS = 500
_LARGEST_TURN = 0.5
_TOLERANCE = 1e-12
_SETTLED = 1e-9
_HALVINGS = 30
_OVERSHOOT = 0.9
_NEAR = 1e-6
_CONVEX = 1e-12
"""Least eigenvalue of the stiffness in scaled angles that counts as convex."""


def descended(numbers: ArmNumbers, given: Mapping[str, float], start: Array, name: str) -> Still:
    """Return the equilibrium that an arm reaches from some angles under gravity and constant inputs.

    Newton's iteration on the torque out of balance, turned into a descent of the potential energy: where the stiffness
    has negative directions it is shifted along the joints' inertia until it has none (Nocedal & Wright 2006, ch. 3.4),
    and steps end before the energy rises. So it is a stable equilibrium, unless the arm starts on an unstable one.

    Parameters
    ----------
    numbers : ArmNumbers
        Of the arm.
    given : mapping from str to float
        Constant inputs by column.
    start : array, (n,)
        Angles to start from, rad.
    name : str
        Of the scene, for the error.

    Raises
    ------
    UserError
        If there is none: a torque turns a joint forever, or what acts has no energy.
    """
    still = require_numbers(Still(numbers, start, given), name)
    before = np.inf
    for _ in range(_STEPS):
        turn = descent(still)
        largest = float(np.max(np.abs(turn)))
        if not np.isfinite(largest):
            break
        size = max(1.0, float(np.max(np.abs(still.angles))))
        # many joints round more: then turns do not become smaller any more
        if largest <= _TOLERANCE * size or (largest <= _SETTLED * size and largest > 0.5 * before):
            return Still(numbers, still.angles + turn, given)
        before = largest
        share = min(1.0, _LARGEST_TURN / largest)
        slope = float(still.unbalanced @ turn)  # of the energy, downward
        for _ in range(_HALVINGS):
            further = Still(numbers, still.angles + share * turn, given)
            if float(further.unbalanced @ turn) >= -_OVERSHOOT * slope or largest < _NEAR:
                break
            share *= 0.5
        still = further
    require_energy(still, name)
    remedies = ["start nearer by [initial] angles"]
    if any(given.values()):
        remedies = ["let no input turn it on and on (smaller values of --input)", *remedies]
    raise UserError(
        f"scene '{name}': no static equilibrium found from its initial angles; {', or '.join(remedies)}"
    )


def stationary(numbers: ArmNumbers, given: Mapping[str, float], angles: Array) -> Still | None:
    """Return the equilibrium near some angles, of whatever kind; None where Newton's iteration finds none."""
    for _ in range(NEWTON_STEPS):
        still = Still(numbers, angles, given)
        springs = SpaceSprings(still)
        # level, say: nothing tells how far to turn
        turn = descent(still) if idly_pushed(still, springs) else given_way(springs, still.unbalanced)
        largest = float(np.max(np.abs(turn)))
        if not np.isfinite(largest):
            return None
        if largest <= _TOLERANCE * max(1.0, float(np.max(np.abs(angles)))):
            return Still(numbers, angles + turn, given)
        angles = angles + min(1.0, _LARGEST_TURN / largest) * turn
    return None


def nearest(numbers: ArmNumbers, given: Mapping[str, float], angles: Array, name: str) -> Still:
    """Return the equilibrium near some angles, one on which the arm falls over too.

    Raises
    ------
    UserError
        If none is found.
    """
    found = stationary(numbers, given, require_numbers(Still(numbers, angles, given), name).angles)
    if found is None:
        raise not_near(name, given)
    return found


def descent(still: Still) -> Array:
    """Return the turn to the minimum of the local energy, or of one made convex, (n,), rad."""
    springs = SpaceSprings(still)
    torque = still.unbalanced
    if not idly_pushed(still, springs) and springs.convex > _CONVEX:
        return given_way(springs, torque)
    inertia = np.diag(still.mass)
    shift = _shift(still, inertia) or float(np.max(np.abs(torque / inertia))) or 1.0
    springs = SpaceSprings(still, shift * inertia)
    while springs.convex <= 0.0:
        shift *= 2.0
        springs = SpaceSprings(still, shift * inertia)
    return given_way(springs, torque)


def idly_pushed(still: Still, springs: SpaceSprings) -> bool:
    """Return whether something pushes along what nothing resists, by more than rounding."""
    pushed = np.abs(springs.idle.T @ still.unbalanced)
    sums = np.abs(springs.idle).T @ still.scale
    return bool(np.any(pushed > ROUNDING * still.numbers.size * sums))


def given_way(springs: SpaceSprings, torque: Array) -> Array:
    """Return the turn that balances a torque, (n,), rad; nothing along what nothing resists."""
    found: Array = springs.angles(springs.signs * springs.loads(torque[:, None]))[:, 0]
    return found


def _shift(still: Still, inertia: Array) -> float:
    """Return how far the stiffness lies below one that is convex, in units of an inertia."""
    root = np.sqrt(inertia)
    matrix = 0.5 * (still.geometric + still.geometric.T) + np.diag(still.numbers.stiffness)
    squares = np.linalg.eigvalsh(matrix / root[:, None] / root)
    least = _CONVEX * float(np.max(np.abs(squares)))
    return max(0.0, -2.0 * float(squares[0])) + 2.0 * least

"""Where a planar arm comes to rest: by following its descent to the bottom, or near where one looks."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from tmm_gen.errors import UserError
from tmm_gen.modal.arm import linear_arm
from tmm_gen.modal.matrices import Matrices, matrices
from tmm_gen.modal.parts import Parts
from tmm_gen.modal.rest import Rest, rest_at, straight
from tmm_gen.modal.search import NEWTON_STEPS
from tmm_gen.modal.springs import springs_of
from tmm_gen.scene import Scene

Array = NDArray[np.float64]
Unbalanced = Callable[[Rest, Matrices], Array]
"""Torque out of balance on each free angle of a configuration."""

_STEPS = 500
_LARGEST_TURN = 0.5
_TOLERANCE = 1e-12
_STATIONARY = 1e-11
_ROUNDING = 1e-9
_HALVINGS = 30
_OVERSHOOT = 0.9
_NEAR = 1e-6
_CONVEX = 1e-12
"""Least generalised eigenvalue of the stiffness, relative to the largest, that counts as convex."""


def equilibrium(
    scene: Scene,
    inputs: Mapping[str, float] | None = None,
    unbalanced: Unbalanced | None = None,
    *,
    start: Array | None = None,
) -> Rest:
    """Return the static equilibrium an arm reaches from its initial angles under gravity and loads.

    Newton's iteration on the torque out of balance, turned into a descent of the potential energy: where the
    stiffness has negative directions it is shifted along the links' inertia until it has none (Nocedal & Wright
    2006, ch. 3.4), and steps end before the energy rises. So it is a stable equilibrium, unless the arm
    starts on an unstable one.

    Parameters
    ----------
    scene : Scene
        Of kind "planar".
    inputs : mapping from str to float, optional
        Constant inputs by name; those not given are zero.
    unbalanced : callable, optional
        Where the torque comes from; by default the elements' equations.
    start : array, optional
        Free angles to descend from, rad; by default those of the scene's start.

    Raises
    ------
    UserError
        If there is none: a torque on a free hub or joint turns the arm forever.
    """
    angles = straight(scene) if start is None else start
    rest, linear, torque = _look(scene, angles, inputs, unbalanced)
    before = np.inf
    for _ in range(_STEPS):
        turn = descent(linear, torque)
        largest = float(np.max(np.abs(turn)))
        size = max(1.0, float(np.max(np.abs(angles))))
        # many links round more: then turns do not become smaller any more
        if largest <= _TOLERANCE * size or (largest <= _ROUNDING * size and largest > 0.5 * before):
            return rest
        before = largest
        share = min(1.0, _LARGEST_TURN / largest)
        slope = float(torque @ turn)  # of the energy, downward
        for _ in range(_HALVINGS):
            rest, linear, torque = _look(scene, angles + share * turn, inputs, unbalanced)
            if float(torque @ turn) >= -_OVERSHOOT * slope or largest < _NEAR:
                break
            share *= 0.5
        angles = angles + share * turn
    remedies = ["start nearer by [initial] angles"]
    if scene.hub:
        remedies = ['hold the base (base.kind = "clamp" or "prescribed")', *remedies]
    elif any((inputs or {}).values()):
        remedies = ["let no input turn it on and on (smaller values of --input)", *remedies]
    raise UserError(
        f"scene '{scene.name}': no static equilibrium found from its initial angles; {', or '.join(remedies)}"
    )


def stationary(scene: Scene, inputs: Mapping[str, float] | None, angles: Array) -> Rest | None:
    """Return the equilibrium near some free angles, of whatever kind; None where Newton's iteration finds none."""
    for _ in range(NEWTON_STEPS):
        rest, linear = looked(scene, inputs, angles)
        springs = springs_of(linear.parts)
        torque = rest.unbalanced
        if springs.rigid:  # level, say: nothing tells how far to turn
            turn = descent(linear, torque)
        else:
            turn = springs.angles(springs.signs * springs.loads(torque[:, None]))[:, 0]
        largest = float(np.max(np.abs(turn)))
        if not np.isfinite(largest):
            return None
        if largest <= _STATIONARY * max(1.0, float(np.max(np.abs(angles)))):
            return rest
        angles = angles + min(1.0, _LARGEST_TURN / largest) * turn
    return None


def nearest(scene: Scene, inputs: Mapping[str, float] | None, angles: Array) -> Rest:
    """Return the equilibrium near some free angles, one on which the arm falls over too.

    Raises
    ------
    UserError
        If none is found.
    """
    found = stationary(scene, inputs, angles)
    if found is None:
        raise not_near(scene.name, inputs)
    return found


def not_near(name: str, inputs: Mapping[str, float] | None) -> UserError:
    """Return the error of a search that found no equilibrium."""
    smaller = "smaller values of --input, or " if any((inputs or {}).values()) else ""
    return UserError(
        f"scene '{name}': no static equilibrium found near the angles of --near; try {smaller}angles of one that "
        "`tmm-gen rest` lists"
    )


def looked(scene: Scene, inputs: Mapping[str, float] | None, angles: Array) -> tuple[Rest, Matrices]:
    """Return an arm held still at some free angles, and its matrices there."""
    rest = rest_at(scene, angles, inputs=inputs)
    return rest, matrices(linear_arm(scene, rest))


def _look(
    scene: Scene, angles: Array, inputs: Mapping[str, float] | None, unbalanced: Unbalanced | None
) -> tuple[Rest, Matrices, Array]:
    rest, linear = looked(scene, inputs, angles)
    return rest, linear, rest.unbalanced if unbalanced is None else unbalanced(rest, linear)


def descent(linear: Matrices, torque: Array) -> Array:
    """Return the turn to the minimum of the local energy, or of one made convex."""
    parts = linear.parts
    springs = springs_of(parts)
    if springs.rigid or springs.negative:
        inertia = parts.diagonal
        ground, shift = parts.ground_stiffness, _shift(parts, inertia) or _pull(torque, inertia)
        while springs.rigid or springs.negative:
            springs = springs_of(replace(parts, ground_stiffness=ground + shift * inertia))
            shift *= 2.0
    found: Array = springs.angles(springs.loads(torque[:, None]))[:, 0]
    return found


def _pull(torque: Array, inertia: Array) -> float:
    """Return a shift that turns the arm by about 1 rad where it has no stiffness at all: rigid links, level."""
    return float(np.max(np.abs(torque / inertia))) or 1.0


def _shift(parts: Parts, inertia: Array) -> float:
    """Return how far the stiffness lies below one that is convex, in units of an inertia."""
    from scipy.linalg import eigvalsh, eigvalsh_tridiagonal  # slow to import

    springs = np.append(0.0, parts.spring) if parts.hub else parts.spring
    root = np.sqrt(inertia)
    if len(parts.free.runs) > 1:
        squares = eigvalsh(parts.held(np.diag(1.0 / root)) / root[:, None])
    else:
        diagonal = (springs + np.append(springs[1:], 0.0) + parts.ground_stiffness) / inertia
        squares = eigvalsh_tridiagonal(diagonal, -springs[1:] / (root[1:] * root[:-1]))
    least = _CONVEX * float(np.max(np.abs(squares)))
    return max(0.0, -2.0 * float(squares[0])) + 2.0 * least

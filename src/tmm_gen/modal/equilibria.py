"""All static equilibria of a planar arm that are found, those on which it would fall over among them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial
from itertools import product

import numpy as np
from numpy.typing import NDArray

from tmm_gen.modal.arm import linear_arm
from tmm_gen.modal.equilibrium import descent, equilibrium
from tmm_gen.modal.held import Held
from tmm_gen.modal.matrices import Matrices, matrices
from tmm_gen.modal.rest import Rest, rest_at, straight
from tmm_gen.modal.search import NEWTON_STEPS, SAME, Found, Search, shared_ways
from tmm_gen.modal.springs import springs_of
from tmm_gen.modal.undamped import undamped_modes
from tmm_gen.scene import Scene

Array = NDArray[np.float64]

_QUADRANTS = (-0.5 * np.pi, 0.5 * np.pi, 0.0, np.pi)
_LARGEST_TURN = 0.5
_TOLERANCE = 1e-11


@dataclass(frozen=True, eq=False, kw_only=True)
class Equilibrium(Held):
    """One static equilibrium.

    Parameters
    ----------
    rest : Rest
        Angles and forces; at joints that turn freely no angle is more than half a turn.
    """

    rest: Rest


Equilibria = Found[Equilibrium]
"""All that were found of a planar arm."""


def free_joints(scene: Scene) -> tuple[int, ...]:
    """Return the joints without a spring, counted from 1, base to tip; 0 is a hub."""
    hinges = (number for number, joint in enumerate(scene.joints, start=1) if joint.stiffness == 0.0)
    return (*([0] if scene.hub else []), *hinges)


def equilibria(
    scene: Scene, inputs: Mapping[str, float] | None = None, advance: Callable[[], None] = lambda: None
) -> Equilibria:
    """Return the static equilibria of an arm under gravity and constant inputs.

    Newton's iteration, which unlike a descent stops on saddles too, from directions in all four quadrants of what
    stands on each free joint; then descents along the fall of each unstable equilibrium that was found.

    Parameters
    ----------
    scene : Scene
        Of kind "planar".
    inputs : mapping from str to float, optional
        Constant inputs by name; those not given are zero.
    advance : callable, optional
        Called at each start.

    Raises
    ------
    UserError
        If there is none, as a torque turns the arm forever.
    """
    return Search(
        descended=lambda start: equilibrium(scene, inputs, start=start),
        starts=_starts(scene),
        stationary=partial(_stationary, scene, inputs),
        judged=partial(_judged, scene, inputs),
        same=_same,
        fall=partial(_fall, scene),
    ).run(advance)


def _starts(scene: Scene) -> Iterator[Array]:
    """Yield configurations in which what stands on each free joint points into each quadrant.

    All quadrants as long as they are few, else up and down; beyond that the rest of the arm goes on straight.
    """
    shape = np.concatenate([np.zeros(1 - scene.hub), straight(scene)])  # of hub or base, then of each link
    pivots = free_joints(scene)
    quadrants, turned = shared_ways(_QUADRANTS, len(pivots))
    for directions in product(quadrants, repeat=turned):
        angles = shape.copy()
        for number, pivot in enumerate(pivots):
            beyond = _beyond(scene, pivot)
            angles[beyond] = shape[beyond] + directions[min(number, turned - 1)] - shape[pivot]
        yield angles[1 - scene.hub :]


def _beyond(scene: Scene, joint: int) -> list[int]:
    """Return the numbers of all links that turn with a joint; the hub itself is 0."""
    turning = {joint}
    for number in range(joint + 1, scene.stations + 1):
        if scene.host(number) in turning:
            turning.add(number)
    return sorted(turning)


def _looked(scene: Scene, inputs: Mapping[str, float] | None, angles: Array) -> tuple[Rest, Matrices]:
    rest = rest_at(scene, angles, inputs=inputs)
    return rest, matrices(linear_arm(scene, rest))


def _stationary(scene: Scene, inputs: Mapping[str, float] | None, angles: Array) -> Rest | None:
    """Return the equilibrium near some angles, of whatever kind; None where there is none."""
    for _ in range(NEWTON_STEPS):
        rest, linear = _looked(scene, inputs, angles)
        springs = springs_of(linear.parts)
        torque = rest.unbalanced
        if springs.rigid:  # level, say: nothing tells how far to turn
            turn = descent(linear, torque)
        else:
            turn = springs.angles(springs.signs * springs.loads(torque[:, None]))[:, 0]
        largest = float(np.max(np.abs(turn)))
        if not np.isfinite(largest):
            return None
        if largest <= _TOLERANCE * max(1.0, float(np.max(np.abs(angles)))):
            return rest
        angles = angles + min(1.0, _LARGEST_TURN / largest) * turn
    return None


def _judged(scene: Scene, inputs: Mapping[str, float] | None, rest: Rest, reached: bool) -> Equilibrium:
    """Return an equilibrium with whole turns at free joints taken off, and how it is held."""
    angles = np.concatenate([[rest.hub], rest.angles])
    for joint in free_joints(scene):
        inner = angles[scene.host(joint)] if joint else 0.0
        turns = (angles[joint] - inner) / (2.0 * np.pi)
        # half a turn is one to the left
        angles[_beyond(scene, joint)] -= 2.0 * np.pi * np.ceil(turns - 0.5 - SAME)
    settled, linear = _looked(scene, inputs, angles[1 - scene.hub :])
    springs = springs_of(linear.parts)
    idle = springs.turned if springs.rigid else np.zeros((len(springs.pivot), 0))
    return Equilibrium(rest=settled, falls=springs.negative, idle=idle, reached=reached)


def _same(one: Equilibrium, other: Equilibrium) -> bool:
    """Return whether two equilibria are one, or differ by a motion that nothing resists."""
    turns = one.rest.free_angles - other.rest.free_angles
    if one.idle.shape == other.idle.shape:
        turns = turns - one.idle @ np.linalg.lstsq(one.idle, turns)[0]
    apart = np.abs(turns - 2.0 * np.pi * np.round(turns / (2.0 * np.pi)))
    return bool(np.all(apart < SAME))


def _fall(scene: Scene, each: Equilibrium) -> tuple[Array, Array]:
    """Return the free angles of an unstable equilibrium, and the shape of its fastest fall."""
    return each.rest.free_angles, undamped_modes(matrices(linear_arm(scene, each.rest)), 1).shapes[:, 0]

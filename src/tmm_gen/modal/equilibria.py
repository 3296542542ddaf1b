"""All static equilibria of a planar arm that are found, those on which it would fall over among them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial
from itertools import product

import numpy as np
from numpy.typing import NDArray

from tmm_gen.modal.arm import linear_arm
from tmm_gen.modal.equilibrium import equilibrium, looked, nearest, stationary
from tmm_gen.modal.held import Held
from tmm_gen.modal.matrices import matrices
from tmm_gen.modal.near import beyond
from tmm_gen.modal.rest import Rest, straight
from tmm_gen.modal.search import SAME, Found, Search, shared_ways
from tmm_gen.modal.springs import springs_of
from tmm_gen.modal.undamped import undamped_modes
from tmm_gen.scene import Scene

Array = NDArray[np.float64]

_QUADRANTS = (-0.5 * np.pi, 0.5 * np.pi, 0.0, np.pi)


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
    scene: Scene,
    inputs: Mapping[str, float] | None = None,
    advance: Callable[[], None] = lambda: None,
    start: Array | None = None,
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
    start : array, optional
        Free angles, rad: the equilibrium near them comes first, in place of that reached from the scene's start.

    Raises
    ------
    UserError
        If there is none, as a torque turns the arm forever; or none is found near `start`.
    """
    return Search(
        descended=lambda angles: equilibrium(scene, inputs, start=angles),
        starts=_starts(scene),
        stationary=partial(stationary, scene, inputs),
        judged=partial(_judged, scene, inputs),
        same=_same,
        fall=partial(_fall, scene),
        near=None if start is None else partial(nearest, scene, inputs, start),
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
            turning = beyond(scene, pivot)
            angles[turning] = shape[turning] + directions[min(number, turned - 1)] - shape[pivot]
        yield angles[1 - scene.hub :]


def _judged(scene: Scene, inputs: Mapping[str, float] | None, rest: Rest, reached: bool) -> Equilibrium:
    """Return an equilibrium with whole turns at free joints taken off, and how it is held."""
    angles = np.concatenate([[rest.hub], rest.angles])
    for joint in free_joints(scene):
        inner = angles[scene.host(joint)] if joint else 0.0
        turns = (angles[joint] - inner) / (2.0 * np.pi)
        # half a turn is one to the left
        angles[beyond(scene, joint)] -= 2.0 * np.pi * np.ceil(turns - 0.5 - SAME)
    settled, linear = looked(scene, inputs, angles[1 - scene.hub :])
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

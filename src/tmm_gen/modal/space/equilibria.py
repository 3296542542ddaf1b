"""All static equilibria of an arm in space that are found, those on which it would fall over among them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from tmm_gen.modal.held import Held
from tmm_gen.modal.search import SAME, Found, Search, shared_ways
from tmm_gen.modal.space.equilibrium import descended, given_way, nearest, stationary
from tmm_gen.modal.space.judged import require_energy, require_inertia
from tmm_gen.modal.space.matrices import space_matrices
from tmm_gen.modal.space.numbers import ArmNumbers
from tmm_gen.modal.space.springs import SpaceSprings
from tmm_gen.modal.space.still import ROUNDING, Still
from tmm_gen.modal.undamped import undamped_modes

Array = NDArray[np.float64]

_WAYS = (0.0, np.pi, -0.5 * np.pi, 0.5 * np.pi)
"""From where what stands on a joint hangs: so, on its head, and level to both sides."""


@dataclass(frozen=True, eq=False, kw_only=True)
class SpaceEquilibrium(Held):
    """One static equilibrium.

    Parameters
    ----------
    rest : Still
        Angles and forces; at joints that turn freely no angle is more than half a turn.
    """

    rest: Still


SpaceEquilibria = Found[SpaceEquilibrium]
"""All that were found of an arm in space."""


def equilibria_in_space(
    numbers: ArmNumbers,
    given: Mapping[str, float],
    name: str,
    advance: Callable[[], None] = lambda: None,
    start: Array | None = None,
) -> SpaceEquilibria:
    """Return the static equilibria of an arm under gravity and constant inputs.

    Newton's iteration, which unlike a descent stops on saddles too, from where what stands on each free joint hangs,
    stands on its head or lies level; then descents along the fall of each unstable equilibrium that was found.

    Parameters
    ----------
    numbers : ArmNumbers
        Of the arm.
    given : mapping from str to float
        Constant inputs by column.
    name : str
        Of the scene, for the error.
    advance : callable, optional
        Called at each start.
    start : array, optional
        Angles of the joints, rad: the equilibrium near them comes first, in place of that reached from the scene's
        start.

    Raises
    ------
    UserError
        If there is none, as a torque turns a joint forever; none is found near `start`; or one that cannot be judged,
        as what acts has no energy.
    """
    return Search(
        descended=lambda angles: descended(numbers, given, numbers.start if angles is None else angles, name),
        starts=_starts(numbers, given),
        stationary=partial(stationary, numbers, given),
        judged=lambda still, reached: _judged(
            require_energy(require_inertia(still, name), name), reached=reached
        ),
        same=_same,
        fall=_fall,
        near=None if start is None else partial(nearest, numbers, given, start, name),
    ).run(advance)


def _starts(numbers: ArmNumbers, given: Mapping[str, float]) -> Iterator[Array]:
    """Yield configurations in which what stands on each free joint points each way; sprung joints are slack.

    Joints are set from the base outward. All four ways as long as they are few, else hanging and standing; beyond that
    the rest of the arm hangs. Where weight and loads do not mind how a joint stands, it stays as it starts.
    """
    minded = _minded(numbers, given)
    ways, turned = shared_ways(_WAYS, len(minded))
    slack = np.where(numbers.stiffness > 0.0, numbers.rest, numbers.start)

    def set_on(angles: Array, number: int) -> Iterator[Array]:
        if number == len(minded):
            yield angles
            return
        joint = minded[number]
        hanging, _ = _hanging(numbers, given, angles, joint)
        for way in ways if number < turned else ways[:1]:
            further = angles.copy()
            further[joint] = hanging + way
            yield from set_on(further, number + 1)

    yield from set_on(slack, 0)


def _minded(numbers: ArmNumbers, given: Mapping[str, float]) -> list[int]:
    """Return the free joints whose angle weight or loads mind, where the arm starts or one of them is turned."""
    slack = np.where(numbers.stiffness > 0.0, numbers.rest, numbers.start)
    looks = [slack]
    for joint in numbers.free.tolist():
        turned = slack.copy()
        turned[joint] += 1.0  # no whole share of a turn, so that nothing vanishes by chance
        looks.append(turned)
    return [
        joint
        for joint in numbers.free.tolist()
        if any(_hanging(numbers, given, look, joint)[1] for look in looks)
    ]


def _hanging(
    numbers: ArmNumbers, given: Mapping[str, float], angles: Array, joint: int
) -> tuple[float, bool]:
    """Return the angle at which what stands on a joint hangs, the other joints as they are, and whether it minds.

    What weight and dead loads do about the joint is a sine of its angle, so three angles tell all.
    """
    needed = []
    for angle in (0.0, 0.5 * np.pi, np.pi):
        turned = angles.copy()
        turned[joint] = angle
        still = Still(numbers, turned, given)
        needed.append(float(still.needed[joint]))
    cosine, sine = 0.5 * (needed[0] - needed[2]), needed[1] - 0.5 * (needed[0] + needed[2])
    minds = float(np.hypot(cosine, sine)) > ROUNDING * numbers.size * float(still.acting[joint])
    return (float(np.arctan2(-cosine, sine)) if minds else float(angles[joint])), minds


def _judged(still: Still, *, reached: bool) -> SpaceEquilibrium:
    """Return an equilibrium with whole turns at free joints taken off, and how it is held."""
    angles, free = still.angles.copy(), still.numbers.free
    # half a turn is one to the left
    angles[free] -= 2.0 * np.pi * np.ceil(angles[free] / (2.0 * np.pi) - 0.5 - SAME)
    settled = Still(still.numbers, angles, still.given)
    # of many turns taken off rounding leaves something
    polished = angles + given_way(SpaceSprings(settled), settled.unbalanced)
    settled = Still(still.numbers, polished, still.given)
    springs = SpaceSprings(settled)
    return SpaceEquilibrium(rest=settled, falls=springs.negative, idle=springs.idle, reached=reached)


def _same(one: SpaceEquilibrium, other: SpaceEquilibrium) -> bool:
    """Return whether two equilibria are one, or differ by a motion that nothing resists.

    Such a motion, and another set of angles by which bodies stand alike, leave springs, all heights and the way in
    which each body sees its weight as they are.
    """
    if one.idle.shape != other.idle.shape:
        return False
    numbers = one.rest.numbers
    turns = one.rest.angles - other.rest.angles
    turns[numbers.free] -= 2.0 * np.pi * np.round(turns[numbers.free] / (2.0 * np.pi))
    if not one.idle.shape[1]:
        return bool(np.all(np.abs(turns) < SAME))
    turns[numbers.free] = 0.0
    heights = (one.rest.heights - other.rest.heights) / numbers.reach
    massive = np.array([joint.body.mass > 0.0 for joint in numbers.arm.joints])
    seen = (one.rest.weight - other.rest.weight)[massive] / (np.linalg.norm(numbers.gravity) or 1.0)
    return all(bool(np.all(np.abs(each) < SAME)) for each in (turns, heights, seen))


def _fall(each: SpaceEquilibrium) -> tuple[Array, Array]:
    """Return the angles of an unstable equilibrium, and the shape of its fastest fall."""
    return each.rest.angles, undamped_modes(space_matrices(each.rest), 1).shapes[:, 0]

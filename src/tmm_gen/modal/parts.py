"""What an arm's matrices are made of: a few numbers for each station, gathered from its elements' matrices.

Joints couple neighbours, gravity and loads act on each angle by itself, and links carry motion outward and forces
inward. So a matrix times a vector takes time in proportion to the stations, and no entry is a difference of large
numbers: stiff springs and soft ones, and the stiffness that gravity gives, stay apart.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import groupby

import numpy as np
from numpy.typing import NDArray

from tmm_gen.modal.arm import GEARED, PIVOT, LinearArm, Placed
from tmm_gen.modal.limbs import Limbs, limbs_of

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Parts:
    """An arm in small motion; free angles are those of a motor's hub, then of the n links.

    Parameters
    ----------
    hub : bool
        Whether the hub's angle is free.
    limbs : Limbs
        On what each link hangs.
    spring, damper : array, (n,)
        Of the joint inboard of each link, N m/rad and N m s/rad.
    ground_stiffness, ground_damping : array, (d,)
        What gravity, loads and bearings add to each free angle alone.
    hub_inertia : float
        kg m^2.
    floating_mass : float
        Of the whole arm where its base floats, kg; else infinite. What moves it as a whole takes no coordinate: the
        base moves so that the centre of mass stays.
    reach : array, (n, p)
        How a link's outer end moves as it turns; ``p`` is 0 in a chain, 2 in the plane.
    inertia : array, (n, p + 1, p + 1)
        Inertia of each link against the motion of its inner end and its turning; symmetric.
    tip : array, (p + 1, p + 1)
        Inertia of the body at the tip; zero where the arm branches.
    rotor : array, (n,)
        Inertia of the motor in each joint, at the joint, kg m^2.
    turn : array, (n,)
        Turns of a joint's outer side per turn of its inner one; 1 without gears, which chains alone have.
    """

    hub: bool
    limbs: Limbs
    spring: Array
    damper: Array
    ground_stiffness: Array
    ground_damping: Array
    hub_inertia: float
    floating_mass: float
    reach: Array
    inertia: Array
    tip: Array
    rotor: Array
    turn: Array

    @property
    def size(self) -> int:
        """Number of free angles, d."""
        return len(self.ground_stiffness)

    @property
    def diagonal(self) -> Array:
        """The diagonal of the mass matrix, (d,)."""
        pulled = self._at_outer_ends(self.inertia[:, :-1, :-1], self.tip[:-1, :-1])
        found = self.inertia[:, -1, -1] + np.einsum("ni,nij,nj->n", self.reach, pulled, self.reach)
        found[-1] += self.tip[-1, -1]
        on_base, *on_links = self.limbs.carried(self.rotor)
        found = found + self.rotor + on_links
        whole = np.append(self.hub_inertia + on_base, found) if self.hub else found
        diagonal: Array = whole - np.sum(self._moments**2, axis=1) / self.floating_mass
        return diagonal

    def base_moved(self, angles: Array) -> Array:
        """Return how a base that floats moves with free angles, (p,); zero where it is held."""
        return -(self._moments.T @ angles) / self.floating_mass

    @cached_property
    def _moments(self) -> Array:
        """Forces on a base held in its place, (d, p), per unit of each angle's acceleration: first moments of mass."""
        place = self.reach.shape[1]
        pulled = self._at_outer_ends(self.inertia[:, :place, :place], self.tip[:place, :place])
        found = self.inertia[:, place, :place] + np.einsum("ni,nij->nj", self.reach, pulled)
        found[-1] += self.tip[place, :place]
        return np.concatenate([np.zeros((1, place)), found]) if self.hub else found

    @cached_property
    def free(self) -> Limbs:
        """On what each free angle hangs."""
        return self.limbs.behind_hub if self.hub else self.limbs

    def _at_outer_ends(self, each: Array, tip: Array) -> Array:
        """Return what the outer end of each link has to move, (n, ...), of what each link needs and the tip."""
        beyond = self.limbs.carried(each)[1:]
        beyond[-1] += tip
        return self.limbs.inward(beyond)

    def twists(self, angles: Array) -> Array:
        """Return how much each joint is twisted, (n, ...)."""
        first = int(self.hub)
        found: Array = angles[first:] - self.turn[:, None] * self.free.inner(angles)[first:]
        return found

    def weighed(self, angles: Array) -> Array:
        """Return the mass matrix times angles, (d, k), given as columns."""
        turned = angles[int(self.hub) :]
        ends = self.limbs.outward(self.reach[:, :, None] * turned[:, None, :])
        motion = np.concatenate([self.limbs.inner(ends), turned[:, None, :]], axis=1)
        force = self.inertia @ motion
        at_tip = self.tip @ np.concatenate([ends[-1], turned[-1:]])
        force[-1, -1] += at_tip[-1]
        pulled = self._at_outer_ends(force[:, :-1], at_tip[:-1])
        torque = force[:, -1] + np.sum(self.reach[:, :, None] * pulled, axis=1)
        moved = np.concatenate([self.hub_inertia * angles[:1], torque]) if self.hub else torque
        moved = moved - self._moments @ (self._moments.T @ angles) / self.floating_mass
        return moved + self._between(self.rotor, np.zeros(self.size), angles) if self.rotor.any() else moved

    def held(self, angles: Array) -> Array:
        """Return the stiffness matrix times angles, (d, k)."""
        return self._between(self.spring, self.ground_stiffness, angles)

    def braked(self, rates: Array) -> Array:
        """Return the damping matrix times rates, (d, k), complex ones too."""
        return self._between(self.damper, self.ground_damping, rates)

    def _between(self, joint: Array, ground: Array, angles: Array) -> Array:
        first = int(self.hub)
        found, torque = ground[:, None] * angles, np.zeros_like(angles)
        torque[first:] = joint[:, None] * self.twists(angles)
        found[first:] += torque[first:]
        torque[first:] *= self.turn[:, None]
        return found - self.free.carried(torque)[1:]


def parts_of(arm: LinearArm) -> Parts:
    """Gather the numbers of an arm's elements.

    Parameters
    ----------
    arm : LinearArm
        Chain, or planar arm about rest.
    """
    n, width = arm.scene.stations, arm.width
    rotor, turn = np.zeros(n), np.array([1.0 / joint.ratio for joint in arm.scene.joints])
    laws, links = np.zeros((n, 2)), np.zeros((3, n, width, width))
    reach = np.zeros((n, width - 1))
    bodies = {0: np.zeros((3, width, width)), n: np.zeros((3, width, width))}
    for placed in (each for each in arm.elements if each.name == PIVOT):
        *law, rotor[placed.station - 1] = placed.values
        laws[placed.station - 1] = law
    for name, alike in _alike([each for each in arm.elements if each.name != PIVOT]):
        functions = arm.functions(alike[0])
        columns = [np.array(column) for column in zip(*(each.values for each in alike), strict=True)]
        at = np.array([each.station for each in alike])
        if name in ("joint", GEARED):
            # of the outer motion per force on the inner side, which is `turn` times that on the outer one
            laws[at - 1] = arm.sign * functions.impedance(columns) / turn[at - 1, None]
            continue
        by_power, carrying, passing = functions.powers(columns)
        # forces enter at the inner end: what the element takes, carried there
        needed = arm.sign * np.linalg.solve(passing, by_power)
        if name == "link":
            links[:, at - 1] += needed
            reach[at - 1] = carrying[:, :-1, -1]
            continue
        for station, body in zip(at.tolist(), np.moveaxis(needed, 1, 0), strict=True):
            bodies[station] += body
    ground = links[:2, :, -1, -1]
    ground[:, -1] += bodies[n][:2, -1, -1]
    if arm.hub:
        ground = np.concatenate([bodies[0][:2, -1:, -1], ground], axis=1)
    return Parts(
        hub=arm.hub,
        limbs=limbs_of(arm.scene),
        spring=laws[:, 0],
        damper=laws[:, 1],
        ground_stiffness=ground[0],
        ground_damping=ground[1],
        hub_inertia=float(bodies[0][2, -1, -1]),
        floating_mass=float(links[2, :, 0, 0].sum() + bodies[0][2, 0, 0] + bodies[n][2, 0, 0])
        if arm.free[0] and width > 1
        else np.inf,
        reach=reach,
        inertia=0.5 * (links[2] + links[2].transpose(0, 2, 1)),  # symmetric but for rounding
        tip=bodies[n][2],
        rotor=rotor,
        turn=turn,
    )


def _alike(elements: Sequence[Placed]) -> Iterator[tuple[str, list[Placed]]]:
    """Yield elements of one type together: each is computed for all of them at once."""
    for name, found in groupby(sorted(elements, key=lambda each: each.name), key=lambda each: each.name):
        yield name, list(found)

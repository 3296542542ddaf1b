"""Joints that come again and again in one order: where a row repeats, its code is a loop."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass, replace

from tmm_gen.derive.space.pattern import Pattern
from tmm_gen.scene.spatial.arm import Revolute, RigidBody, SpatialArm, Turn

LONGEST = 6
"""Joints of a cell and its mirror image, in a beam that bends both ways and twists."""

_PAIRS = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))


@dataclass(frozen=True)
class Run:
    """Stations of the same patterns in turn.

    Parameters
    ----------
    start : int
        Index of the first, from 0.
    patterns : tuple of Pattern
        Of the stations that are repeated.
    times : int
        How often.
    """

    start: int
    patterns: tuple[Pattern, ...]
    times: int

    @property
    def stop(self) -> int:
        """Index behind the last."""
        return self.start + self.times * len(self.patterns)

    @property
    def single(self) -> bool:
        """Whether it is one station."""
        return self.stop - self.start == 1


@dataclass(frozen=True)
class StationTree:
    """The stations of an arm and how they hang together.

    Parameters
    ----------
    arm : SpatialArm
    marked : frozenset of int
        Indices of stations that something is read off, or acts on: they stand in no run.
    shafts : frozenset of int
        Indices of stations that walks pass over, as they have neither mass nor place of their own.
    """

    arm: SpatialArm
    marked: frozenset[int] = frozenset()
    shafts: frozenset[int] = frozenset()

    @property
    def stations(self) -> int:
        """Number of joints."""
        return len(self.arm.joints)

    def host(self, index: int) -> int:
        """Return the index of the station that one stands on, -1 for the base."""
        return self.arm.joints[index].host - 1

    def carried(self, index: int) -> tuple[int, ...]:
        """Return the stations that stand on one; -1 is the base."""
        return tuple(k for k in range(self.stations) if self.host(k) == index and k not in self.shafts)

    def before(self, index: int) -> int:
        """Return the index of the station that walks visit before one; -1 before the first."""
        return index - 2 if index - 1 in self.shafts else index - 1

    def geared(self, index: int) -> bool:
        """Whether a station turns by the sum of its own angle and that of a shaft before it."""
        return index - 1 in self.shafts

    @property
    def stretches(self) -> list[tuple[int, int]]:
        """Where stations follow each other without a shaft among them, as (start, stop)."""
        bounds = [-1, *sorted(self.shafts), self.stations]
        found = [(before + 1, after) for before, after in itertools.pairwise(bounds)]
        return [(start, stop) for start, stop in found if start < stop]

    def forks(self, index: int) -> bool:
        """Whether more than one station stands on one."""
        return len(self.carried(index)) > 1

    def given(self, index: int) -> bool:
        """Whether the motion of a station is given; that of the base, -1, is not."""
        return index >= 0 and bool(self.arm.joints[index].given)

    def inward_of(self, index: int) -> frozenset[int]:
        """Return the stations between the base and one, itself among them."""
        found = []
        while index >= 0:
            found.append(index)
            index = self.host(index)
        return frozenset(found)

    def pattern(self, index: int) -> Pattern:
        """Return what of a station is there."""
        joint = self.arm.joints[index]
        rests = joint.host == 0 and self.arm.base is None
        moved = tuple(item is not None for item in self.arm.along) if rests else ()
        falls = tuple(g != 0.0 or m for g, m in zip(self.arm.gravity, moved, strict=True)) if rests else ()
        found = pattern_of(joint, falls, tip=not self.carried(index))
        loaded = not found.massive and index in self._loaded
        driven = self.given(self.host(index))
        return replace(found, moved=moved, given=bool(joint.given), driven=driven, loaded=loaded)

    @property
    def _loaded(self) -> frozenset[int]:
        """Indices of stations that forces or moments act on."""
        return frozenset(i.frame.joint - 1 for i in self.arm.inputs if i.frame is not None)

    def runs(self) -> tuple[Run, ...]:
        """Return all stations as runs, base to tips, without shafts."""
        patterns = [self.pattern(k) for k in range(self.stations)]
        keys = [(p, joint.turn) for p, joint in zip(patterns, self.arm.joints, strict=True)]
        alone = [self._alone(k) for k in range(self.stations)]
        found: list[Run] = []
        at = 0
        while at < self.stations:
            if at in self.shafts:
                at += 1
                continue
            length, times = (1, 1) if alone[at] else _repeated(keys, alone, at)
            found.append(Run(at, tuple(patterns[at : at + length]), times))
            at = found[-1].stop
        return tuple(found)

    def _alone(self, index: int) -> bool:
        """Whether a station begins or ends a branch, or is looked at by itself."""
        host = self.host(index)
        follows = host == index - 1 and host >= 0 and index not in self.shafts
        return not follows or len(self.carried(index)) != 1 or index in self.marked


def _repeated(keys: Sequence[tuple[Pattern, Turn]], alone: Sequence[bool], at: int) -> tuple[int, int]:
    """Return how many stations from one on repeat, and how often; (1, 1) where none does."""
    best = (1, 1)
    for length in range(1, LONGEST + 1):
        block = tuple(keys[at : at + length])
        times = 0
        while (
            len(block) == length
            and tuple(keys[at + times * length : at + (times + 1) * length]) == block
            and not any(alone[at + times * length : at + (times + 1) * length])
        ):
            times += 1
        if times > 1 and length * times > best[0] * best[1]:
            best = (length, times)
    return best


def pattern_of(joint: Revolute, falls: tuple[bool, ...], *, tip: bool) -> Pattern:
    """Return what of a joint and its body is there."""
    own = body_pattern(joint.body)
    return replace(
        own,
        axis=joint.axis,
        offset=tuple(r != 0.0 for r in joint.at),
        turn=tuple(tuple(_structural(entry) for entry in row) for row in joint.turn),
        falls=falls,
        tip=tip,
    )


def body_pattern(body: RigidBody) -> Pattern:
    """Return what of a body is there, on no joint."""
    return Pattern(
        axis=0,
        offset=(False, False, False),
        turn=tuple(tuple(int(i == j) for j in range(3)) for i in range(3)),
        mass=body.mass != 0.0,
        first_moment=tuple(body.mass * c != 0.0 for c in body.center),
        inertia=tuple(
            _inertia_there(body, i, j, entry) for (i, j), entry in zip(_PAIRS, body.inertia, strict=True)
        ),
    )


def _structural(entry: float) -> int | None:
    return int(entry) if entry in (0.0, 1.0, -1.0) else None


def _inertia_there(body: RigidBody, i: int, j: int, about_center: float) -> bool:
    """Whether an entry of the inertia about the joint's point is there: its own, or that of a mass off the point."""
    center, mass = body.center, body.mass
    if about_center != 0.0:
        return True
    if i == j:
        return any(mass * center[k] != 0.0 for k in range(3) if k != i)
    return mass * center[i] * center[j] != 0.0

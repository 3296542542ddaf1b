"""Sums along an arm that may branch, limb by limb: an arm without branches is one limb."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from tmm_gen.scene import Scene

Numbers = TypeVar("Numbers", bound=NDArray[Any])


@dataclass(frozen=True)
class Limbs:
    """What hangs on what.

    Parameters
    ----------
    hosts : tuple of int, (n,)
        Number of the link, counted from 1, on whose outer end each one hangs; 0 for the base. A link's own number is
        larger, and what it carries, near and far, comes right behind it.
    """

    hosts: tuple[int, ...]

    @cached_property
    def runs(self) -> tuple[tuple[int, int, int], ...]:
        """Links that each carry the next: index of the first, index behind the last, index of the host or -1."""
        begins = [k for k, host in enumerate(self.hosts) if k == 0 or host != k]
        ends = [*begins[1:], len(self.hosts)]
        return tuple((a, b, self.hosts[a] - 1) for a, b in zip(begins, ends, strict=True))

    @property
    def behind_hub(self) -> Limbs:
        """The same on a hub, which counts as the first link."""
        return Limbs((0, *(host + 1 for host in self.hosts)))

    def inner(self, values: Numbers) -> Numbers:
        """Return each one's value at its host, (n, ...); zero at the base."""
        padded: Any = np.concatenate([np.zeros_like(values[:1]), values])
        found: Numbers = padded[list(self.hosts)]
        return found

    def carried(self, values: Numbers) -> Numbers:
        """Sum values over what hangs right on each, (n, ...) to (n + 1, ...): on the base first."""
        found: Any = np.zeros((len(values) + 1, *values.shape[1:]), values.dtype)
        for start, stop, host in self.runs:
            found[start + 1 : stop] = values[start + 1 : stop]
            found[host + 1] += values[start]
        summed: Numbers = found
        return summed

    def outward(self, values: Numbers) -> Numbers:
        """Sum values from the base to each, itself included, (n, ...)."""
        found: Any = np.empty_like(values)
        for start, stop, host in self.runs:
            found[start:stop] = np.cumsum(values[start:stop], axis=0)
            if host >= 0:
                found[start:stop] += found[host]
        summed: Numbers = found
        return summed

    def inward(self, values: Numbers) -> Numbers:
        """Sum values of each and all that it carries, (n, ...)."""
        found: Any = values.copy()
        for start, stop, host in reversed(self.runs):
            found[start:stop] = np.cumsum(found[start:stop][::-1], axis=0)[::-1]
            if host >= 0:
                found[host] += found[start]
        summed: Numbers = found
        return summed


def limbs_of(scene: Scene) -> Limbs:
    """Return what hangs on what in a scene."""
    return Limbs(tuple(scene.host(joint) for joint in range(1, scene.stations + 1)))

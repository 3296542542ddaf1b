"""Where the nodes of an arm are: the base, and the outer end of each link."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tmm_gen.scene import Scene

Array = NDArray[np.float64]


def node_places(scene: Scene, angles: Array) -> tuple[Array, Array]:
    """Return the places of base and outer ends, (k, n + 1) along x and along y, m, from angles of the links, (k, n)."""
    found = []
    for along in (np.cos(angles), np.sin(angles)):
        places = np.zeros((len(angles), scene.stations + 1))
        if not scene.hosts:  # one line: the same sums in the same order
            np.cumsum([link.length for link in scene.links] * along, axis=1, out=places[:, 1:])
            found.append(places)
            continue
        for number, link in enumerate(scene.links, start=1):
            places[:, number] = places[:, scene.host(number)] + link.length * along[:, number - 1]
        found.append(places)
    return found[0], found[1]


def ends(scene: Scene) -> tuple[int, ...]:
    """Return the numbers of the links that carry nothing."""
    hosts = {scene.host(number) for number in range(1, scene.stations + 1)}
    return tuple(number for number in range(1, scene.stations + 1) if number not in hosts)


def outline(scene: Scene, places: Array) -> Array:
    """Return places, (..., n + 1), in the order of a line along the arm: a gap, NaN, where a branch begins anew."""
    order = [0]
    gaps = []
    for number in range(1, scene.stations + 1):
        host = scene.host(number)
        if host != number - 1:
            gaps.append(len(order))
            order += [0, host]
        order.append(number)
    found: Array = places[..., order].copy()
    found[..., gaps] = np.nan
    return found

"""A chain as a linear system: in coordinates whose squares are energies, or in its slowest modes.

In such coordinates it has no large numbers however stiff it is: undamped, its motion is a rotation. Nothing here comes
from `derive` or `program`.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from tmm_gen.reference.assembly import twists
from tmm_gen.scene import Scene, station_of

Array = NDArray[np.float64]

DENSE = 200
"""Coordinates up to which all modes are looked at together, with whatever damping."""

MODES = 100
"""Slowest ones that are looked at beyond, each with what damping leaves it alone."""


@dataclass(frozen=True, eq=False)
class Linear:
    """``x' = A x + B u + C u'`` in independent blocks; angles are ``q = R x + D u``.

    Parameters
    ----------
    system : array, (b, s, s)
        1/s.
    load, load_rate : array, (b, s, inputs)
        What inputs and their rates do.
    angles : array, (b, m, s)
        From states to the angles of hub and links, summed over blocks.
    through : array, (m, inputs)
        What inputs are of the angles at once (a prescribed base).
    start : array, (b, s)
        State at the beginning, if all inputs were zero.
    begun : array, (b, s, inputs)
        What inputs at the beginning add to it.
    """

    system: Array
    load: Array
    load_rate: Array
    angles: Array
    through: Array
    start: Array
    begun: Array


@dataclass(frozen=True, eq=False)
class _Referred:
    """A chain as its base's shaft sees it: hub and links, (m,), joints, (n,), loads of inputs, (m, inputs)."""

    inertia: Array
    stiffness: Array
    damping: Array
    hub_damping: float
    load: Array
    base: Array
    angle: Array
    rate: Array

    @property
    def hub(self) -> int:
        """1 where it stands on a hub, else 0."""
        return len(self.inertia) - len(self.stiffness)


def linear_chain(scene: Scene) -> Linear:
    """Return a chain in coordinates whose squares are energies, or in its slowest modes.

    Inertias, springs and loads are referred to the base's shaft: there all turns count alike.
    """
    hub = scene.hub
    n = scene.stations
    turns = np.array([1.0] * hub + list(scene.turns))
    inertia = np.array([scene.base.inertia] * hub + [link.inertia for link in scene.links]) / turns**2
    stiffness, damping = (
        np.array([getattr(j, name) for j in scene.joints]) / turns[hub:] ** 2
        for name in ("stiffness", "damping")
    )
    load = np.zeros((n + hub, len(scene.inputs)))
    base = np.zeros(len(scene.inputs))
    for k, item in enumerate(scene.inputs):
        if item.acts == "angle":
            base[k] = 1.0
        else:
            at = station_of(item.at, n) - 1 + hub
            load[at, k] = item.factor / turns[at]
    start = (
        turns * np.array([0.0] * hub + list(scene.initial.angles)),
        turns * np.array([0.0] * hub + list(scene.initial.rates)),
    )
    chain = _Referred(inertia, stiffness, damping, scene.base.damping, load, base, *start)
    found = _whole(chain, twists(scene)) if n + hub <= DENSE or scene.hosts else _modal(chain)
    return replace(found, angles=found.angles / turns[:, None], through=found.through / turns[:, None])


def _whole(chain: _Referred, bend: Array) -> Linear:
    """Return one block: bends of the joints, rates, and the angle of a hub, scaled to roots of energies."""
    inertia, stiffness, damping = chain.inertia, chain.stiffness, chain.damping
    load, base, hub = chain.load, chain.base, chain.hub
    m, n = len(inertia), len(stiffness)
    root, scale = np.sqrt(inertia), np.where(stiffness > 0.0, np.sqrt(stiffness), 1.0)
    held = bend.sum(axis=1)[:, None] * base  # of joints on a base that is no coordinate
    spread = bend / root  # from scaled rates to rates of bending
    ground = np.zeros((m, m))
    if hub:
        ground[0, 0] = chain.hub_damping / inertia[0]
    size = n + m + hub
    system = np.zeros((size, size))
    rates = slice(n, n + m)
    system[:n, rates] = scale[:, None] * spread
    system[rates, :n] = -(spread.T * (stiffness / scale))
    system[rates, rates] = -(spread.T * damping) @ spread - ground
    if hub:
        system[-1, n] = 1.0 / root[0]
    push, push_rate = np.zeros((size, len(base))), np.zeros((size, len(base)))
    push[rates] = load / root[:, None]
    push_rate[:n] = -scale[:, None] * held
    push_rate[rates] = (spread.T * damping) @ held
    read = np.zeros((m, size))
    read[hub:, :n] = np.linalg.inv(bend[:, hub:]) / scale
    if hub:
        read[:, -1] = 1.0
    first = np.concatenate([scale * (bend @ chain.angle), root * chain.rate, chain.angle[:hub]])
    begun = np.zeros_like(push)
    begun[:n] = -scale[:, None] * held
    through = np.outer(np.ones(m), base)
    return Linear(system[None], push[None], push_rate[None], read[None], through, first[None], begun[None])


def _modal(chain: _Referred) -> Linear:
    """Return the slowest modes, a block each."""
    from scipy.linalg import eigh_tridiagonal

    inertia, stiffness, damping = chain.inertia, chain.stiffness, chain.damping
    load, base, hub, m = chain.load, chain.base, chain.hub, len(inertia)
    root = np.sqrt(inertia)
    squares, shapes = eigh_tridiagonal(
        *_tridiagonal(stiffness, inertia, hub), select="i", select_range=(0, MODES - 1)
    )
    squares = np.maximum(squares, 0.0)
    if hub:
        squares[0] = 0.0  # it turns as a whole
    bends = np.diff(shapes / root[:, None], axis=0, prepend=np.zeros((1 - hub, MODES)))
    damped = np.sum(damping[:, None] * bends**2, axis=0)
    if hub:
        damped += chain.hub_damping * (shapes[0] / root[0]) ** 2
    system = np.zeros((MODES, 2, 2))
    system[:, 0, 1], system[:, 1, 0], system[:, 1, 1] = 1.0, -squares, -damped
    pulled = shapes.T @ (load / root[:, None])
    prescribed = (shapes[0] / root[0])[:, None] * base
    push, push_rate = np.zeros((MODES, 2, len(base))), np.zeros((MODES, 2, len(base)))
    push[:, 1] = pulled + stiffness[0] * prescribed
    push_rate[:, 1] = damping[0] * prescribed
    read = np.zeros((MODES, m, 2))
    read[:, :, 0] = (shapes / root[:, None]).T
    start = np.stack([shapes.T @ (root * chain.angle), shapes.T @ (root * chain.rate)], axis=1)
    return Linear(system, push, push_rate, read, np.zeros((m, len(base))), start, np.zeros_like(push))


def _tridiagonal(stiffness: Array, inertia: Array, hub: int) -> tuple[Array, Array]:
    inner = np.concatenate([np.zeros(hub), stiffness])
    outer = np.append(stiffness if hub else stiffness[1:], 0.0)
    between = stiffness if hub else stiffness[1:]
    return (inner + outer) / inertia, -between / np.sqrt(inertia[1:] * inertia[:-1])

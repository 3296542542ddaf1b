"""The motion that a chain would have, at many instants: what steps of a simulation are held against.

During a step the inputs are polynomials, and the motion follows from the matrix exponential. In coordinates whose
squares are energies it has no large numbers however stiff the chain (undamped, it is a rotation). Long chains are
looked at in their slowest modes. Nothing here comes from `derive` or `program`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

from tmm_gen.inputs.profiles import Chirp
from tmm_gen.inputs.signals import Constant, Harmonic, Signal
from tmm_gen.reference.assembly import twists
from tmm_gen.scene import Scene, station_of

Array = NDArray[np.float64]

DENSE = 200
"""Coordinates up to which all modes are looked at together, with whatever damping."""

MODES = 100
"""Slowest ones that are looked at beyond, each with what damping leaves it alone."""

_DEGREE = 3
_NODES, _WEIGHTS = legendre.leggauss(_DEGREE + 1)
_CHUNK = 4096
_LEAST_STEPS, _FINEST = 2000, 4000
"""Pieces of time in all over which inputs are cubics, and most of them in a step."""

_SWING = 0.5
"""Radians of a harmonic input in such a piece."""


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


def exact_angles(scene: Scene, signals: Mapping[str, Signal], step: float, indices: Array) -> Array:
    """Return the angles of hub and links behind some numbers of steps, (k, m), rad.

    Parameters
    ----------
    scene : Scene
        Of kind "chain".
    signals : mapping from str to Signal
        All its inputs by name.
    step : float
        s.
    indices : array, (k,)
        Whole numbers from 0 on, equally far apart.
    """
    linear = linear_chain(scene)
    ordered = [signals[item.name] for item in scene.inputs]
    stride = round(float(indices[1] - indices[0])) if len(indices) > 1 else 1
    at_rest = all(isinstance(s, Constant) for s in ordered)
    # a few long steps may hold many kinks and swings of an input, which no cubic is
    total = (len(indices) - 1) * stride
    swing = max((_fastest(s) for s in ordered), default=0.0) * step / _SWING
    finer = min(_FINEST, max(1, math.ceil(_LEAST_STEPS / max(total, 1)), math.ceil(swing)))
    h, per = (step * stride, 1) if at_rest else (step / finer, stride * finer)
    transition, response = _transition(linear, h)
    found = np.empty((len(indices), len(linear.through)))
    values = np.array([float(s.at(0.0)) for s in ordered])
    state = linear.start + linear.begun @ values
    found[0] = _read(linear, state) + linear.through @ values
    total = (len(indices) - 1) * per
    for first in range(0, total, _CHUNK):
        count = min(_CHUNK, total - first)
        pushed, ends = _pushed(response, ordered, h, first, count)
        for k in range(count):
            state = (
                np.einsum("bij,bj->bi", transition, state) if len(transition) > 1 else state @ transition[0].T
            )
            state = state + pushed[k]
            if (first + k + 1) % per == 0:
                place = (first + k + 1) // per
                found[place] = _read(linear, state) + linear.through @ ends[k]
    return found


def _fastest(signal: Signal) -> float:
    """Return the highest angular frequency an input swings at by itself, rad/s."""
    if isinstance(signal, Chirp):
        return 2.0 * math.pi * max(signal.first, signal.last)
    return signal.frequency if isinstance(signal, Harmonic) else 0.0


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
    if n + hub <= DENSE or scene.hosts:
        found = _whole(inertia, stiffness, damping, scene.base.damping, load, base, *start, twists(scene))
    else:
        found = _modal(inertia, stiffness, damping, scene.base.damping, load, base, *start)
    return replace(found, angles=found.angles / turns[:, None], through=found.through / turns[:, None])


def _whole(
    inertia: Array,
    stiffness: Array,
    damping: Array,
    hub_damping: float,
    load: Array,
    base: Array,
    angle: Array,
    rate: Array,
    bend: Array,
) -> Linear:
    """Return one block: bends of the joints, rates, and the angle of a hub, scaled to roots of energies."""
    m, n = len(inertia), len(stiffness)
    hub = m - n
    root, scale = np.sqrt(inertia), np.where(stiffness > 0.0, np.sqrt(stiffness), 1.0)
    held = bend.sum(axis=1)[:, None] * base  # of joints on a base that is no coordinate
    spread = bend / root  # from scaled rates to rates of bending
    ground = np.zeros((m, m))
    if hub:
        ground[0, 0] = hub_damping / inertia[0]
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
    first = np.concatenate([scale * (bend @ angle), root * rate, angle[:hub]])
    begun = np.zeros_like(push)
    begun[:n] = -scale[:, None] * held
    through = np.outer(np.ones(m), base)
    return Linear(system[None], push[None], push_rate[None], read[None], through, first[None], begun[None])


def _modal(
    inertia: Array,
    stiffness: Array,
    damping: Array,
    hub_damping: float,
    load: Array,
    base: Array,
    angle: Array,
    rate: Array,
) -> Linear:
    """Return the slowest modes, a block each."""
    from scipy.linalg import eigh_tridiagonal

    m, n = len(inertia), len(stiffness)
    hub = m - n
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
        damped += hub_damping * (shapes[0] / root[0]) ** 2
    system = np.zeros((MODES, 2, 2))
    system[:, 0, 1], system[:, 1, 0], system[:, 1, 1] = 1.0, -squares, -damped
    pulled = shapes.T @ (load / root[:, None])
    prescribed = (shapes[0] / root[0])[:, None] * base
    push, push_rate = np.zeros((MODES, 2, len(base))), np.zeros((MODES, 2, len(base)))
    push[:, 1] = pulled + stiffness[0] * prescribed
    push_rate[:, 1] = damping[0] * prescribed
    read = np.zeros((MODES, m, 2))
    read[:, :, 0] = (shapes / root[:, None]).T
    start = np.stack([shapes.T @ (root * angle), shapes.T @ (root * rate)], axis=1)
    return Linear(system, push, push_rate, read, np.zeros((m, len(base))), start, np.zeros_like(push))


def _tridiagonal(stiffness: Array, inertia: Array, hub: int) -> tuple[Array, Array]:
    inner = np.concatenate([np.zeros(hub), stiffness])
    outer = np.append(stiffness if hub else stiffness[1:], 0.0)
    between = stiffness if hub else stiffness[1:]
    return (inner + outer) / inertia, -between / np.sqrt(inertia[1:] * inertia[:-1])


def _transition(linear: Linear, h: float) -> tuple[Array, Array]:
    """Return what becomes of a state in a step, and the answer to each power of time of each input.

    Returns
    -------
    transition : array, (b, s, s)
    response : array, (b, s, inputs, powers)
        To ``(t / h)^p`` of an input during the step.
    """
    from scipy.linalg import expm

    blocks, size, inputs = linear.load.shape
    powers = _DEGREE + 1
    whole = np.zeros((blocks, size + inputs * powers, size + inputs * powers))
    whole[:, :size, :size] = linear.system * h
    for k in range(inputs):
        at = size + k * powers
        whole[:, :size, at] = linear.load[:, :, k] * h
        whole[:, :size, at + 1] = linear.load_rate[:, :, k]
        for power in range(_DEGREE):  # derivatives of the input by t / h
            whole[:, at + power, at + power + 1] = 1.0
    found = expm(whole)
    factorials = np.cumprod([1.0, *range(1, powers)])
    answers = found[:, :size, size:].reshape(blocks, size, inputs, powers) * factorials
    return found[:, :size, :size], answers


def _pushed(response: Array, signals: list[Signal], h: float, first: int, count: int) -> tuple[Array, Array]:
    """Return what inputs add to the states over some steps, (count, b, s), and their values at the ends."""
    blocks, size, inputs, _ = response.shape
    pushed, ends = np.zeros((count, blocks, size)), np.zeros((count, inputs))
    for k, signal in enumerate(signals):
        pushed += np.einsum("cp,bsp->cbs", _projected(signal, h, first, count), response[:, :, k])
        ends[:, k] = signal.at(h * (first + 1 + np.arange(count)))
    return pushed, ends


def _projected(signal: Signal, h: float, first: int, count: int) -> Array:
    """Return a cubic for each step that is as near to an input as can be, coefficients of ``(t / h)^p``, (count, 4).

    Its mean over the step is the input's even where that has kinks within.
    """
    begin = h * (first + np.arange(count))
    values = np.asarray(signal.at(begin[:, None] + h * 0.5 * (1.0 + _NODES)), float)
    series = np.stack(
        [
            (2 * p + 1) / 2.0 * values @ (_WEIGHTS * legendre.legval(_NODES, np.eye(_DEGREE + 1)[p]))
            for p in range(_DEGREE + 1)
        ],
        axis=1,
    )
    knots = signal.knots[(signal.knots > begin[0]) & (signal.knots < begin[-1] + h)]
    for index in np.unique((knots / h).astype(int) - first):
        if 0 <= index < count:
            inside = knots[(knots > begin[index]) & (knots < begin[index] + h)]
            series[index] = _piecewise(signal, begin[index], h, inside)
    return series @ _MONOMIALS


def _piecewise(signal: Signal, begin: float, h: float, knots: Array) -> Array:
    """Return the Legendre series of an input over a step with kinks."""
    edges = np.concatenate([[0.0], (knots - begin) / h, [1.0]])
    half = 0.5 * np.diff(edges)[:, None]
    places = edges[:-1, None] + half * (1.0 + _NODES)
    values = np.asarray(signal.at(begin + h * places), float)
    basis = legendre.legvander(2.0 * places - 1.0, _DEGREE)
    return np.asarray(
        (2 * np.arange(_DEGREE + 1) + 1) * np.einsum("kn,kn,knp->p", half * _WEIGHTS, values, basis)
    )


def _monomials() -> Array:
    """Return the rows that take Legendre series on [-1, 1] to powers of ``(x + 1) / 2``."""
    rows = np.zeros((_DEGREE + 1, _DEGREE + 1))
    for p in range(_DEGREE + 1):
        plain = np.polynomial.Polynomial(legendre.leg2poly(np.eye(_DEGREE + 1)[p]))
        moved = plain(np.polynomial.Polynomial([-1.0, 2.0])).coef
        rows[p, : len(moved)] = moved
    return rows


_MONOMIALS = _monomials()


def _read(linear: Linear, state: Array) -> Array:
    return np.asarray(np.einsum("bms,bs->m", linear.angles, state))

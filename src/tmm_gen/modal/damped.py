"""Poles of the damped arm: one quadratic for each mode where damping leaves modes apart, else a projection.

Coupled modes are sought in the space of the lowest undamped ones. What that space leaves unbalanced bends the arm, and
the bends are added to it until nothing is left: the residual says how well each pole is known.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.errors import UserError
from tmm_gen.modal.linear import Linear, Resistance
from tmm_gen.modal.pairs import Pair, paired, quadratic
from tmm_gen.modal.undamped import DENSE, undamped_modes

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]

_NOTHING = 1e-12
"""Share of a direction that is there already, as nothing new."""

_KNOWN = 1e-10
"""Relative error of a pole that is good enough."""

_ROUNDS = 12
_POLISHED = 4
_MOST_POLISHED = 150
"""Size of the projected matrices up to which each pole is polished."""

_NEAR = 1e-3
"""Relative distance within which polishing may move a pole: further away lies another."""

_OWN = 0.9
"""Share that an undamped mode, and those as fast as it, must have of a damped one that it gives its shape to."""

_AS_FAST = 0.01
"""Relative distance of frequencies of undamped modes that even light damping may mix."""


@dataclass(frozen=True, eq=False)
class Damped:
    """Two poles for each of the lowest modes.

    Parameters
    ----------
    pairs : list of (complex, complex)
        1/s; a conjugate pair, or two real poles, the slower one first. Their products do not fall.
    shapes : array, (d, m)
        Of the undamped modes that they grow out of, or their own where damping mixes those: the real part at the phase
        where it is largest, of two real poles that of the slower one.
    grown : list of (int or None)
        Number of the undamped mode, counted from 0, whose shape each has; None where it has its own.
    bounds : array, (m,)
        Estimated relative error of each pair, from residuals.
    """

    pairs: list[Pair]
    shapes: Array
    grown: list[int | None]
    bounds: Array


@dataclass(frozen=True, eq=False)
class _Found:
    """The lowest pairs in a space.

    Parameters
    ----------
    pairs : list of (complex, complex)
        The lowest first.
    numbers : array of int, (m,)
        Of the undamped modes they were given to.
    bounds : array, (m,)
        Of their relative errors.
    shapes : list of (array or None)
        Their own, (d,), where damping mixes undamped modes.
    bends : array, (d, k)
        What the space does not balance.
    """

    pairs: list[Pair]
    numbers: NDArray[np.intp]
    bounds: Array
    shapes: list[Array | None]
    bends: Array


def damped_modes(linear: Linear, count: int | None = None) -> Damped:
    """Return the poles of the lowest modes.

    Parameters
    ----------
    linear : Linear
        Of an arm in small motion.
    count : int, optional
        How many modes; all by default.
    """
    time = linear.damping_time
    if time is not None:
        modes = undamped_modes(linear, count)
        pairs = [quadratic(square, time * square) for square in modes.squares.tolist()]
        return Damped(pairs, modes.shapes, list(range(len(pairs))), modes.bounds)
    size = linear.parts.size
    wanted = size if count is None else min(count, size)
    # damping may make any undamped mode one of the slowest: of small arms all are looked at
    basis = undamped_modes(linear, size if size <= DENSE else min(size, 2 * wanted + 20))
    springs = linear.springs
    shapes = basis.shapes
    found = _projected(linear, springs, shapes, wanted)
    for _ in range(_ROUNDS):
        worst = float(np.max(found.bounds, initial=0.0))
        if worst <= _KNOWN or shapes.shape[1] == size:
            break
        shapes = _widened(linear, shapes, found.bends)
        better = _projected(linear, springs, shapes, wanted)
        if float(np.max(better.bounds)) > 0.5 * worst:  # rounding is all that is left
            break
        found = better
    chosen, grown, bounds = [], [], []
    for number, own, bound in zip(found.numbers.tolist(), found.shapes, found.bounds.tolist(), strict=True):
        known = own is None and number < len(basis.squares)
        grown.append(number if known else None)
        chosen.append(basis.shapes[:, number] if own is None else own)
        bounds.append(max(bound, float(basis.bounds[number])) if known else bound)
    return Damped(found.pairs, np.stack(chosen, axis=1), grown, np.array(bounds))


def _projected(linear: Linear, springs: Resistance, shapes: Array, wanted: int) -> _Found:
    """Return the lowest pairs in a space."""
    from scipy.linalg import eigh  # slow to import

    bends = springs.bends(shapes)
    bends[springs.loose] = 0.0
    stiffness = bends.T @ (springs.signs * bends)
    damping = shapes.T @ linear.parts.braked(shapes)
    if not (np.all(np.isfinite(stiffness)) and np.all(np.isfinite(damping))):
        raise UserError(
            "the arm's masses and springs lie too far apart for double precision: its frequencies leave the range of "
            "numbers. Look for a mass, inertia or stiffness that is far too small or large."
        )
    squares, turned = eigh(0.5 * (stiffness + stiffness.T))
    loose = np.argsort(np.abs(squares))[: len(springs.loose)]
    squares[loose] = 0.0
    stiffness, damping = np.diag(squares), turned.T @ (0.5 * (damping + damping.T)) @ turned
    guesses = [quadratic(*each) for each in zip(squares.tolist(), np.diag(damping).tolist(), strict=True)]
    every = paired(stiffness, damping, guesses, loose)
    order = np.argsort([(one * other).real for one, other in every], kind="stable")[:wanted]
    errors, missing = np.zeros(len(order)), []
    polished: list[Pair] = []
    own: list[Array | None] = []
    for k, number in enumerate(order.tolist()):
        pair = every[number]
        if len(squares) > _MOST_POLISHED:
            polished.append(pair)
            own.append(None)
            continue
        both, vectors = [], []
        for pole in pair[:1] if pair[0].imag else pair:
            if pole == 0.0:
                both.append(pole)
                vectors.append(np.eye(len(squares), dtype=complex)[number])
                continue
            better, vector = _polish(stiffness, damping, pole)
            both.append(better)
            vectors.append(vector)
            shape = shapes @ (turned @ vector)
            slope = abs(better * (2.0 * better * (vector @ vector) + vector @ damping @ vector))
            left = _left(linear, springs, shape, better)
            errors[k] = max(errors[k], float(np.linalg.norm(left)) * _weight(springs, shape, slope))
            missing += [left.real, left.imag] if better.imag else [left.real]
        polished.append((both[0], both[0].conjugate()) if pair[0].imag else (both[0], both[1]))
        alike = _alike(squares, number, vectors[0])
        own.append(None if alike else shapes @ (turned @ _at_its_largest(vectors[0])))
    found = np.array(missing).T if missing else np.zeros((len(shapes), 0))
    return _Found(polished, order, errors, own, springs.angles(springs.signs * found))


def _alike(squares: Array, number: int, vector: Complex) -> bool:
    """Return whether a damped mode moves as the undamped one does, or as those as fast as it together."""
    rates = np.sqrt(np.abs(squares))
    near = (np.abs(rates - rates[number]) <= _AS_FAST * rates[number]) & (squares * squares[number] >= 0.0)
    shares = np.abs(vector) ** 2
    return bool(np.sum(shares[near]) >= _OWN * np.sum(shares))


def _at_its_largest(vector: Complex) -> Array:
    """Return the real part at the phase where it is largest, in coordinates of unit mass."""
    return np.asarray((vector * np.exp(-0.5j * np.angle(vector @ vector))).real, float)


def _left(linear: Linear, springs: Resistance, shape: Complex, pole: complex) -> Complex:
    """Return what is out of balance in a damped mode, on the scaled bends."""
    both = np.stack([shape.real, shape.imag], axis=1)
    moved, braked = (springs.loads(part) @ [1.0, 1j] for part in _acting(linear, both))
    held = springs.bends(both) @ [1.0, 1j] * springs.signs[:, 0]
    left: Complex = np.asarray(pole**2 * moved + pole * braked + held, complex)
    left[springs.loose] = 0.0
    return left


def _acting(linear: Linear, shapes: Array) -> tuple[Array, Array]:
    return linear.parts.weighed(shapes), linear.parts.braked(shapes)


def _weight(springs: Resistance, shape: Complex, slope: float) -> float:
    """Return what turns a residual into a relative error of the pole.

    The residual moves it by ``r / (2 |b|)``; a motion that dampers hold, not springs, has hardly any bends ``b``, and
    ``s`` times the slope of its quadratic form says more: ``r |b| / slope``.
    """
    bends = springs.bends(np.stack([shape.real, shape.imag], axis=1))
    bends[springs.loose] = 0.0
    size = float(np.linalg.norm(bends))
    return min(0.5 / size, size / slope) if size > 0.0 and slope > 0.0 else 0.0


def _widened(linear: Linear, shapes: Array, more: Array) -> Array:
    """Return a basis of unit mass matrix that contains more angles too."""
    for _ in range(2):  # twice is enough against rounding
        more = more - shapes @ (shapes.T @ linear.parts.weighed(more))
        lengths = np.sqrt(np.sum(more * linear.parts.weighed(more), axis=0))
        more = more[:, lengths > 0.0] / lengths[lengths > 0.0]
    inner = more.T @ linear.parts.weighed(more)
    sizes, turned = np.linalg.eigh(0.5 * (inner + inner.T))
    kept = sizes > _NOTHING  # directions that are there already add nothing
    room = len(shapes) - shapes.shape[1]
    added = (more @ (turned[:, kept] / np.sqrt(sizes[kept])))[:, ::-1][:, :room]
    added = added - shapes @ (shapes.T @ linear.parts.weighed(added))
    return np.concatenate([shapes, added], axis=1)


def _polish(stiffness: Array, damping: Array, pole: complex) -> tuple[complex, Complex]:
    """Return a pole of ``s^2 + C s + K`` nearby and its vector, by Rayleigh's quotient of a symmetric matrix."""
    unit = np.eye(len(stiffness))
    start = np.linalg.svd(pole**2 * unit + pole * damping + stiffness)[2][-1].conj()
    vector, best = np.asarray(start, complex), pole
    for _ in range(_POLISHED):
        a, b, c = vector @ vector, vector @ damping @ vector, vector @ stiffness @ vector
        if a == 0.0:
            break
        root = np.sqrt(b * b / a**2 - 4.0 * c / a + 0j)
        nearest = min((0.5 * (-b / a + root), 0.5 * (-b / a - root)), key=lambda s: abs(s - best))
        if abs(nearest - pole) > _NEAR * abs(pole):
            break
        best = complex(nearest.real, nearest.imag if pole.imag else 0.0)
        try:
            vector = np.linalg.solve(best**2 * unit + best * damping + stiffness, vector)
        except np.linalg.LinAlgError:
            break
        vector = vector / np.linalg.norm(vector)
    return best, vector

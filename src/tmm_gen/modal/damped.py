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
from tmm_gen.modal.undamped import Undamped, undamped_modes

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
Pair = tuple[complex, complex]

_NOTHING = 1e-12
"""Share of the largest damping that counts as none; of a direction that is there already, as nothing new."""

_KNOWN = 1e-10
"""Relative error of a pole that is good enough."""

_ROUNDS = 12
_POLISHED = 4
_MOST_POLISHED = 150
"""Size of the projected matrices up to which each pole is polished."""

_NEAR = 1e-3
"""Relative distance within which polishing may move a pole: further away lies another."""


@dataclass(frozen=True, eq=False)
class Damped:
    """Two poles for each of the lowest undamped modes.

    Parameters
    ----------
    pairs : list of (complex, complex)
        1/s; a conjugate pair, or two real poles, the slower one first.
    undamped : Undamped
        The modes they grow out of.
    bounds : array, (m,)
        Estimated relative error of each pair, from residuals.
    """

    pairs: list[Pair]
    undamped: Undamped
    bounds: Array


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
        return Damped(pairs, modes, modes.bounds)
    size = linear.parts.size
    wanted = size if count is None else min(count, size)
    basis = undamped_modes(linear, min(size, 2 * wanted + 20))
    lowest = Undamped(basis.squares[:wanted], basis.shapes[:, :wanted], basis.bounds[:wanted])
    springs = linear.springs
    shapes = basis.shapes
    pairs, bounds, bends = _projected(linear, springs, shapes, wanted)
    for _ in range(_ROUNDS):
        worst = float(np.max(bounds, initial=0.0))
        if worst <= _KNOWN or shapes.shape[1] == size:
            break
        shapes = _widened(linear, shapes, bends)
        found, errors, bends = _projected(linear, springs, shapes, wanted)
        if float(np.max(errors)) > 0.5 * worst:  # rounding is all that is left
            break
        pairs, bounds = found, errors
    return Damped(pairs, lowest, np.maximum(bounds, lowest.bounds))


def quadratic(square: float, twice: float) -> Pair:
    """Return the roots of ``s^2 + twice s + square``, without cancellation."""
    half = 0.5 * twice
    root = np.sqrt(complex(half * half - square))
    large = -(half + root) if half >= 0.0 else -(half - root)
    if large == 0.0:
        return 0j, 0j
    if root.imag != 0.0:
        return complex(-half, abs(root.imag)), complex(-half, -abs(root.imag))
    return complex(square / large), complex(large)


def _projected(
    linear: Linear, springs: Resistance, shapes: Array, wanted: int
) -> tuple[list[Pair], Array, Array]:
    """Return the poles in a space, their errors, and the bends that the space does not balance."""
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
    pairs = _paired(stiffness, damping, guesses, _still(damping, loose))[:wanted]
    errors, missing = np.zeros(wanted), []
    polished: list[Pair] = []
    for k, pair in enumerate(pairs):
        if len(squares) > _MOST_POLISHED:
            polished.append(pair)
            continue
        both = []
        for pole in pair[:1] if pair[0].imag else pair:
            if pole == 0.0:
                both.append(pole)
                continue
            better, vector = _polish(stiffness, damping, pole)
            both.append(better)
            shape = shapes @ (turned @ vector)
            slope = abs(better * (2.0 * better * (vector @ vector) + vector @ damping @ vector))
            left = _left(linear, springs, shape, better)
            errors[k] = max(errors[k], float(np.linalg.norm(left)) * _weight(springs, shape, slope))
            missing += [left.real, left.imag] if better.imag else [left.real]
        polished.append((both[0], both[0].conjugate()) if pair[0].imag else (both[0], both[1]))
    found = np.array(missing).T if missing else np.zeros((len(shapes), 0))
    return polished, errors, springs.angles(springs.signs * found)


def _still(damping: Array, loose: NDArray[np.intp]) -> int:
    """Return how many poles are exactly zero.

    One for each motion that no spring resists, as where it stands does not matter; two where no damper does either.
    """
    if len(loose) == 0:
        return 0
    braked = np.linalg.eigvalsh(damping[np.ix_(loose, loose)])
    least = _NOTHING * float(np.max(np.abs(damping)))
    return 2 * len(loose) - int(np.sum(np.abs(braked) > least))


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


def _paired(stiffness: Array, damping: Array, guesses: list[Pair], still: int) -> list[Pair]:
    """Give each undamped mode the two poles that belong to it."""
    from scipy.linalg import eig
    from scipy.optimize import linear_sum_assignment

    size = len(stiffness)
    system = np.zeros((2 * size, 2 * size))
    system[:size, size:] = np.eye(size)
    system[size:, :size], system[size:, size:] = -stiffness, -damping
    poles = eig(system, right=False)
    poles[np.argsort(np.abs(poles))[:still]] = 0.0
    wanted = np.array([pole for pair in guesses for pole in pair])
    _, order = linear_sum_assignment(_apart(wanted, poles))
    matched = poles[order].reshape(-1, 2)
    if np.any(np.abs(matched[:, 0] - matched[:, 1].conj()) * (np.abs(matched.imag).max(axis=1) > 0.0)):
        matched = _whole_pairs(poles, np.array(guesses))
    return [_conjugates(complex(one), complex(other)) for one, other in matched]


def _apart(wanted: Complex, poles: Complex) -> Array:
    """Return how far poles lie from those wanted, relatively: slow ones are told apart as well as fast ones."""
    scale = np.maximum(np.abs(poles)[None, :], np.abs(wanted)[:, None])
    distance = np.abs(wanted[:, None] - poles[None, :])
    return np.divide(distance, scale, out=np.zeros_like(distance), where=scale > 0.0)


def _whole_pairs(poles: Complex, guesses: Complex) -> Complex:
    """Give modes conjugate pairs first, as damping couples them so much that the nearest poles are none."""
    from scipy.optimize import linear_sum_assignment

    found = np.zeros_like(guesses)
    upper, real = poles[poles.imag > 0.0], poles[poles.imag == 0.0]
    modes, order = linear_sum_assignment(_apart(guesses[:, 0], upper))
    found[modes, 0], found[modes, 1] = upper[order], upper[order].conj()
    left = np.setdiff1d(np.arange(len(guesses)), modes)
    _, order = linear_sum_assignment(_apart(guesses[left].ravel(), real))
    found[left] = real[order].reshape(-1, 2)
    return found


def _conjugates(one: complex, other: complex) -> Pair:
    """Order a pair: the pole with positive imaginary part, or the slower one, first."""
    first = one.imag > other.imag if one.imag != other.imag else abs(one) <= abs(other)
    return (one, other) if first else (other, one)


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

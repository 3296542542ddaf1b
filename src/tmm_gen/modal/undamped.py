"""Undamped modes by what gives way, not by what holds: the lowest ones keep their digits.

The squares of an arm's frequencies span as many decades as the fourth power of its number of links. Rounding of the
stiffest part would hide the slowest mode, so modes are found from the compliance, whose largest eigenvalues they are.
Each comes with a bound of its error from its residual.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.modal.linear import Linear, Resistance

Array = NDArray[np.float64]

DENSE = 60
"""Free angles up to which, or where a third of all modes is asked for, all modes are found at once."""

_MOST_DENSE = 2000
"""Free angles up to which all modes are found where a few alone are not known well enough."""

KNOWN = 1e-8
"""Bound of an error that is good enough."""

_JACOBI = 60
"""Free angles up to which singular values are found to relative accuracy, whatever the ratios of stiffness."""


@dataclass(frozen=True, eq=False)
class Undamped:
    """Modes without damping, the lowest first.

    Parameters
    ----------
    squares : array, (m,)
        Of the angular frequencies, rad^2/s^2; exactly zero where the arm turns as a whole, negative where it falls.
    shapes : array, (d, m)
        Orthonormal with respect to the mass matrix.
    bounds : array, (m,)
        On the relative error of each frequency, from its residual.
    """

    squares: Array
    shapes: Array
    bounds: Array


def undamped_modes(linear: Linear, count: int | None = None) -> Undamped:
    """Return the lowest modes.

    Parameters
    ----------
    linear : Linear
        Of an arm in small motion.
    count : int, optional
        How many; all by default.
    """
    springs = linear.springs
    size = linear.parts.size
    wanted = size if count is None else min(count, size)
    turning = _turning(linear, springs)
    sought = wanted - turning.shape[1]
    few = size > DENSE and 3 * (sought + springs.negative) < size
    found = _sorted(linear, springs, turning, sought, few)
    if few and size <= _MOST_DENSE and np.max(found.bounds, initial=0.0) > KNOWN:
        # one very soft joint hides the others from an iteration on the whole
        found = _sorted(linear, springs, turning, sought, few=False)
    return found


def _sorted(linear: Linear, springs: Resistance, turning: Array, sought: int, few: bool) -> Undamped:
    """Return the lowest modes, those of the arm as a whole at their place."""
    squares, shapes = np.zeros(0), np.zeros((linear.parts.size, 0))
    if sought > 0:
        arm = (linear, springs, turning)
        squares, shapes = _lowest(*arm, sought) if few else _all(*arm)
        order = np.argsort(squares)[:sought]
        squares, shapes = squares[order], shapes[:, order]
    place = int(np.sum(squares < 0.0))
    squares = np.insert(squares, place, np.zeros(turning.shape[1]))
    shapes = np.concatenate([shapes[:, :place], turning, shapes[:, place:]], axis=1)
    return Undamped(squares, shapes, _bounds(linear, springs, squares, shapes))


def _turning(linear: Linear, springs: Resistance) -> Array:
    """Return the motions without resistance, of unit mass, (d, r): the arm as a whole, or all beyond a free joint."""
    from scipy.linalg import cholesky, solve_triangular  # slow to import

    if not springs.rigid:
        return np.zeros((linear.parts.size, 0))
    whole = springs.turned
    root = cholesky(whole.T @ linear.parts.weighed(whole))
    return np.asarray(solve_triangular(root, whole.T, trans="T").T, float)


def _lowest(linear: Linear, springs: Resistance, turning: Array, count: int) -> tuple[Array, Array]:
    """Find a few modes by Lanczos's iteration on the compliance, in time proportional to the stations."""
    from scipy.sparse.linalg import LinearOperator, eigsh  # slow to import

    parts, size = linear.parts, linear.parts.size
    moved = parts.weighed(turning)

    def softened(torques: Array) -> Array:
        torques = np.asarray(torques, float).reshape(size, -1)
        torques = torques - moved @ (turning.T @ torques)
        angles = springs.angles(springs.signs * springs.loads(torques))
        found: Array = angles - turning @ (moved.T @ angles)
        return found

    def operator(function: Callable[[Array], Array]) -> object:
        return LinearOperator((size, size), matvec=function, matmat=function, dtype=float)

    def column(function: Callable[[Array], Array]) -> Callable[[Array], Array]:
        return lambda vector: function(np.asarray(vector, float).reshape(size, -1))

    start = np.random.default_rng(0).standard_normal((size, 1))  # the same each time
    start = softened(parts.weighed(start))[:, 0]
    number = count + springs.negative
    while True:
        squares, shapes = eigsh(
            operator(column(parts.held)),
            number,
            M=operator(column(parts.weighed)),
            sigma=0.0,
            OPinv=operator(softened),
            which="LM",
            v0=start,
            ncv=min(size - 1, max(2 * number + 20, 40)),
        )
        if np.sum(squares < 0.0) >= springs.negative:
            return squares, shapes
        number *= 2  # those that fall over fast are not among the slowest
        if 3 * number >= size:
            return _all(linear, springs, turning)


def _all(linear: Linear, springs: Resistance, turning: Array) -> tuple[Array, Array]:
    """Find all modes from dense matrices; those of the arm as a whole left out."""
    from scipy.linalg import cholesky, eigh, qr, svd  # slow to import
    from scipy.linalg.lapack import dgejsv

    first, loose = turning.shape[1], springs.loose
    size = linear.parts.size
    bends = springs.angles(np.delete(np.eye(size), loose, axis=1))
    bends = bends - turning @ (linear.parts.weighed(turning).T @ bends)
    root = cholesky(linear.mass)
    factor = root @ bends
    if springs.negative == 0:
        # squares of the periods are those of the singular values: half as many decades as eigenvalues
        if size <= _JACOBI:
            sizes, _, right, work, _, info = dgejsv(factor, joba=0, jobu=3, jobv=0, jobp=1)
            sizes = sizes * (work[0] / work[1])
            if info != 0:
                raise ArithmeticError(f"singular values of an arm's compliance did not converge ({info})")
        else:
            _, sizes, rows = svd(factor, full_matrices=False)
            right = rows.T
        return 1.0 / sizes**2, bends @ right / sizes
    signs = np.delete(springs.signs, loose, axis=0)
    if first:  # what turns as a whole has no part in the others, and would be eigenvalues of rounding
        factor = qr(root @ turning)[0][:, first:].T @ factor
    values, vectors = eigh(factor @ (signs * factor.T))
    soft = 1.0 / values
    shapes = bends @ (signs * (factor.T @ vectors)) * soft
    order = np.argsort(soft)
    soft, shapes = soft[order], shapes[:, order]
    stiff, others = eigh(linear.stiffness, linear.mass)
    whole = springs.negative + np.arange(first)  # between those that fall over and those that swing
    stiff, others = np.delete(stiff, whole), np.delete(others, whole, axis=1)
    low = np.abs(soft) <= np.sqrt(np.min(np.abs(soft)) * np.max(np.abs(stiff)))
    return np.where(low, soft, stiff), np.where(low, shapes, others)


def _bounds(linear: Linear, springs: Resistance, squares: Array, shapes: Array) -> Array:
    """Return how far each frequency may be off, relatively, by the residual of its shape.

    For a symmetric matrix an eigenvalue lies no further away than the residual is large (Parlett 1998, *The Symmetric
    Eigenvalue Problem*, ch. 4). The matrix is the compliance in scaled bends, in which stiff parts weigh little.
    """
    bends = springs.bends(shapes)
    bends[springs.loose] = 0.0
    left = springs.signs * bends - squares * springs.loads(linear.parts.weighed(shapes))
    sizes = np.linalg.norm(bends, axis=0)
    errors = np.divide(0.5 * np.linalg.norm(left, axis=0), sizes, out=np.zeros_like(sizes), where=sizes > 0.0)
    found: Array = np.where(squares == 0.0, 0.0, errors)
    return found

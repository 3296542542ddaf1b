"""Independent motions of a uniform beam at a frequency: waves and edge deflections, or series where it is low."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tmm_gen.modal.beam.member import Complex, Member

Array = NDArray[np.float64]

_SERIES_RADIUS = 1.0
"""Largest ``|p|`` at which the transfer matrix is summed as a series; beyond, exponentials are far apart."""

_SERIES_TERMS = 32

_GROWING = 0.5
"""Growth over the beam from which a solution is measured from its outboard end."""


def solutions(member: Member, s: ArrayLike) -> tuple[Complex, Complex]:
    """Return four independent motions of the beam: the state at both ends of each.

    At high frequencies they are waves and edge deflections, each no larger than one of its own units; at low
    ones they start from the unit states at the inboard end.

    Parameters
    ----------
    member : Member
        The beam.
    s : array_like, (f,)
        Laplace variable, 1/s.

    Returns
    -------
    inboard, outboard : array, (f, 4, 4)
        Columns ``(w, psi, M, V)``: m, rad, N m, N.
    """
    points = np.atleast_1d(np.asarray(s, complex))
    inboard, outboard = inside(member, points, np.array([0.0, 1.0]))
    return inboard, outboard


def inside(member: Member, s: Complex, at: Array) -> Complex:
    """Return the same motions at places along the beam, 0 inboard to 1 outboard, (k, f, 4, 4)."""
    bending = member.bending_stiffness * (1.0 + member.damping_time * s)
    ones = np.ones(len(s))
    units = [member.length * ones, ones, bending / member.length, bending / member.length**2]
    scaled: Complex = dimensionless(member, s, at) * np.stack(units, axis=1)[None, :, :, None]
    return scaled


def dimensionless(member: Member, s: Complex, at: Array) -> Complex:
    """Return them in units of the beam: its length, and forces that bend it by about one, (k, f, 4, 4)."""
    p = member.frequency_number(s)
    found = np.empty((len(at), len(p), 4, 4), complex)
    slow = np.abs(p) < _SERIES_RADIUS
    for place, target in zip(at, found, strict=True):
        if np.any(slow):
            target[slow] = _series(member, p[slow], float(place))
        if not np.all(slow):
            target[~slow] = _waves(member, p[~slow], float(place))
    return found


def _waves(member: Member, p: Complex, at: float) -> Complex:
    """Return the dimensionless states of the four exponentials at one place, (f, 4, 4)."""
    roots = np.sqrt(wave_squares(member, p))
    # one choice of sign on both sides of the imaginary axis of s, so that the solutions are smooth there
    sign = np.where(np.abs(roots.imag) > np.abs(roots.real), roots.imag, roots.real)
    roots = np.where(sign < 0.0, -roots, roots)
    numbers = np.concatenate([roots, -roots])
    shape = _shape_function()(numbers, p[None, :], member.rotary, member.shear)
    states = np.stack([np.broadcast_to(np.asarray(part, complex), numbers.shape) for part in shape])
    # what grows outward is measured from the outboard end, so that nothing overflows
    states = states * np.exp(numbers * np.where(numbers.real > _GROWING, at - 1.0, at))
    ordered: Complex = states.transpose(2, 0, 1)
    return ordered


def wave_squares(member: Member, p: Complex) -> Complex:
    """Return ``kappa^2`` of both kinds of waves, (2, f); the second one travels at any frequency."""
    first, second = _square_functions()(p, member.rotary, member.shear)
    # their product is known better than the smaller of them, which cancels
    larger = np.where(np.abs(first) > np.abs(second), first, second)
    product = p + p * p * member.rotary * member.shear
    with np.errstate(divide="ignore", invalid="ignore"):
        smaller = np.where(larger == 0.0, 0.0, product / larger)
    swap = np.abs(first) > np.abs(second)
    squares: Complex = np.stack([np.where(swap, larger, smaller), np.where(swap, smaller, larger)])
    return squares


def _series(member: Member, p: Complex, at: float) -> Complex:
    """Return the dimensionless transfer matrix from the inboard end to a place, (f, 4, 4)."""
    matrix = np.zeros((len(p), 4, 4), complex)
    entries = _system_function()(p, member.rotary, member.shear)
    for row in range(4):
        for column in range(4):
            matrix[:, row, column] = entries[row][column]
    matrix *= at
    term = np.broadcast_to(np.eye(4, dtype=complex), matrix.shape)
    total = term.copy()
    for k in range(1, _SERIES_TERMS):
        term = term @ matrix / k
        total += term
    return total


@cache
def _symbols() -> Any:
    from tmm_gen.derive.elements import beam

    return beam


@cache
def _shape_function() -> Any:
    import sympy as sp

    beam = _symbols()
    return sp.lambdify(
        (beam.WAVE, beam.FREQUENCY, beam.ROTARY, beam.SHEAR), list(beam.waves().shape), "numpy"
    )


@cache
def _square_functions() -> Any:
    import sympy as sp

    beam = _symbols()
    # SymPy's sqrt of a complex array is NumPy's, whose branch does not matter: both squares are wanted
    return sp.lambdify((beam.FREQUENCY, beam.ROTARY, beam.SHEAR), list(beam.waves().squares), "numpy")


@cache
def _system_function() -> Any:
    import sympy as sp

    beam = _symbols()
    return sp.lambdify((beam.FREQUENCY, beam.ROTARY, beam.SHEAR), beam.system_matrix().tolist(), "numpy")

"""A uniform beam between two nodes: its exact dynamic stiffness, and its count of clamped modes."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

Complex = NDArray[np.complex128]
Array = NDArray[np.float64]
Integers = NDArray[np.int64]

_SERIES_RADIUS = 1.0
"""Largest ``|p|`` at which the transfer matrix is summed as a series; beyond, exponentials are far apart."""

_SERIES_TERMS = 32

_GROWING = 0.5
"""Growth over the beam from which a solution is measured from its outboard end."""


@dataclass(frozen=True)
class Member:
    """A uniform beam.

    Parameters
    ----------
    length : float
        m.
    bending_stiffness : float
        E I, N m^2.
    mass_per_length : float
        rho A, kg/m.
    rotary_inertia : float
        rho I per length, kg m; zero for Euler and Bernoulli.
    shear_compliance : float
        1 / (kappa G A), 1/N; zero for Euler and Bernoulli.
    damping_time : float
        Stiffness-proportional (Kelvin-Voigt) damping, s: ``E I (1 + damping_time s)``, and the shear
        stiffness likewise.
    """

    length: float
    bending_stiffness: float
    mass_per_length: float
    rotary_inertia: float = 0.0
    shear_compliance: float = 0.0
    damping_time: float = 0.0

    @property
    def rotary(self) -> float:
        """Rotary inertia over mass and length squared, dimensionless."""
        return self.rotary_inertia / (self.mass_per_length * self.length**2)

    @property
    def shear(self) -> float:
        """Shear compliance times bending stiffness over length squared, dimensionless."""
        return self.shear_compliance * self.bending_stiffness / self.length**2

    @property
    def unit_frequency(self) -> float:
        """``sqrt(E I / (rho A L^4))``, rad/s: frequencies are ``lambda^2`` of these."""
        return float(np.sqrt(self.bending_stiffness / self.mass_per_length)) / self.length**2

    def frequency_number(self, s: Complex) -> Complex:
        """Return ``p = rho A L^4 s^2 / (E I (1 + damping_time s))``."""
        p: Complex = (s / self.unit_frequency) ** 2 / (1.0 + self.damping_time * s)
        return p

    def undamped(self) -> Member:
        """Return the same beam without damping."""
        return Member(
            self.length,
            self.bending_stiffness,
            self.mass_per_length,
            self.rotary_inertia,
            self.shear_compliance,
        )


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
    scaled: Complex = _dimensionless(member, s, at) * np.stack(units, axis=1)[None, :, :, None]
    return scaled


def _dimensionless(member: Member, s: Complex, at: Array) -> Complex:
    p = member.frequency_number(s)
    found = np.empty((len(at), len(p), 4, 4), complex)
    slow = np.abs(p) < _SERIES_RADIUS
    for place, target in zip(at, found, strict=True):
        if np.any(slow):
            target[slow] = _series(member, p[slow], float(place))
        if not np.all(slow):
            target[~slow] = _waves(member, p[~slow], float(place))
    return found


def dynamic_stiffness(member: Member, s: ArrayLike) -> Complex:
    """Return the forces at both ends that move them harmonically by one.

    Forces and motions are ordered ``(w, psi)`` of the inboard, then of the outboard end; forces are those on
    the beam.

    Parameters
    ----------
    member : Member
        The beam.
    s : array_like, (f,)
        Laplace variable, 1/s; ``1j * omega`` for steady vibration.

    Returns
    -------
    array, (f, 4, 4)
        N/m, N, N m/rad. Infinite at natural frequencies of the beam clamped at both ends.
    """
    inboard, outboard = solutions(member, s)
    motions = np.concatenate([inboard[:, :2], outboard[:, :2]], axis=1)
    forces = np.concatenate([-inboard[:, 3:1:-1], outboard[:, 3:1:-1]], axis=1)
    # every motion is scaled to its own size: the solver sees numbers alike
    size = np.max(np.abs(motions), axis=1, keepdims=True)
    motions, forces = motions / size, forces / size
    found: Complex = np.linalg.solve(motions.transpose(0, 2, 1), forces.transpose(0, 2, 1)).transpose(0, 2, 1)
    symmetric: Complex = 0.5 * (found + found.transpose(0, 2, 1))  # but for rounding
    return symmetric


@dataclass(frozen=True, eq=False)
class Hanging:
    """A beam seen from its inboard end, ``f`` times: what it carries, how it gives way.

    With motions ``d = (w, psi)`` and forces ``(V, M)`` on the beam,

        d_out = carry d_in + compliance f_out        f_in = inertia d_in - carry^T f_out

    The stiffer the beam, the smaller its compliance; its inertia stays. In a stiffness, the sum of both, the
    inertia of a stiff beam drowns.

    Parameters
    ----------
    inertia, carry, compliance : array, (f, 2, 2)
        Real, for undamped harmonic motion; the first and the last symmetric.
    """

    inertia: Array
    carry: Array
    compliance: Array


def hanging(member: Member, omega: Array) -> Hanging:
    """Return an undamped beam as seen from its inboard end, in harmonic motion.

    Parameters
    ----------
    member : Member
        The beam; its damping is left out.
    omega : array, (f,)
        rad/s, positive.
    """
    s = np.asarray(1j * omega, complex)
    inboard, outboard = _dimensionless(member.undamped(), s, np.array([0.0, 1.0]))
    known = np.concatenate([inboard[:, :2], outboard[:, 3:1:-1]], axis=1)
    sought = np.concatenate([-inboard[:, 3:1:-1], outboard[:, :2]], axis=1)
    size = np.max(np.abs(known), axis=1, keepdims=True)
    known, sought = known / size, sought / size
    found = np.linalg.solve(known.transpose(0, 2, 1), sought.transpose(0, 2, 1)).transpose(0, 2, 1).real
    motions = np.array([member.length, 1.0])
    forces = member.bending_stiffness / member.length / np.array([member.length, 1.0])
    inertia = found[:, :2, :2] * (forces[:, None] / motions)
    compliance = found[:, 2:, 2:] * (motions[:, None] / forces)
    return Hanging(
        0.5 * (inertia + inertia.transpose(0, 2, 1)),  # symmetric but for rounding
        found[:, 2:, :2] * (motions[:, None] / motions),
        0.5 * (compliance + compliance.transpose(0, 2, 1)),
    )


def clamped_count(member: Member, omega: ArrayLike) -> Integers:
    """Return how many natural frequencies the beam, clamped at both ends, has below each frequency.

    A beam on two supports has modes ``sin(n pi x / L)``, counted by its wave numbers; holding its ends'
    angles adds the negative eigenvalues of the stiffness against them (Wittrick & Williams 1971, Q. J. Mech.
    Appl. Math. 24, 263-284).

    Parameters
    ----------
    member : Member
        The beam.
    omega : array_like, (f,)
        rad/s, positive.
    """
    still = member.undamped()
    points = np.atleast_1d(np.asarray(omega, float))
    angles = dynamic_stiffness(still, 1j * points)[:, 1::2, 1::2].real
    negative = np.sum(np.linalg.eigvalsh(angles) < 0.0, axis=-1)
    counted: Integers = supported_count(still, points) - negative
    return counted


def supported_count(member: Member, omega: ArrayLike) -> Integers:
    """Return how many natural frequencies of the beam on two supports lie below each frequency, undamped.

    Of the two kinds of waves, the second one travels only above the cut-off frequency of shear; its mode of
    infinite length, pure shear, is counted too.
    """
    points = np.atleast_1d(np.asarray(omega, float))
    squares = _wave_squares(member, member.frequency_number(1j * points)).real
    waves = np.floor(np.sqrt(np.maximum(-squares, 0.0)) / np.pi).astype(np.int64)
    counted: Integers = waves[1] + np.where(squares[0] < 0.0, waves[0] + 1, 0)
    return counted


def _waves(member: Member, p: Complex, at: float) -> Complex:
    """Return the dimensionless states of the four exponentials at one place, (f, 4, 4)."""
    roots = np.sqrt(_wave_squares(member, p))
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


def _wave_squares(member: Member, p: Complex) -> Complex:
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

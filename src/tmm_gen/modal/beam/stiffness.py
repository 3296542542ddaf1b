"""The exact dynamic stiffness of a uniform beam, and its count of clamped modes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tmm_gen.modal.beam.member import Complex, Member
from tmm_gen.modal.beam.motions import dimensionless, solutions, wave_squares

Array = NDArray[np.float64]
Integers = NDArray[np.int64]


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
class SeenInboard:
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


def seen_inboard(member: Member, omega: Array) -> SeenInboard:
    """Return an undamped beam as seen from its inboard end, in harmonic motion.

    Parameters
    ----------
    member : Member
        The beam; its damping is left out.
    omega : array, (f,)
        rad/s, positive.
    """
    s = np.asarray(1j * omega, complex)
    inboard, outboard = dimensionless(member.undamped(), s, np.array([0.0, 1.0]))
    known = np.concatenate([inboard[:, :2], outboard[:, 3:1:-1]], axis=1)
    sought = np.concatenate([-inboard[:, 3:1:-1], outboard[:, :2]], axis=1)
    size = np.max(np.abs(known), axis=1, keepdims=True)
    known, sought = known / size, sought / size
    found = np.linalg.solve(known.transpose(0, 2, 1), sought.transpose(0, 2, 1)).transpose(0, 2, 1).real
    motions = np.array([member.length, 1.0])
    forces = member.bending_stiffness / member.length / np.array([member.length, 1.0])
    inertia = found[:, :2, :2] * (forces[:, None] / motions)
    compliance = found[:, 2:, 2:] * (motions[:, None] / forces)
    return SeenInboard(
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
    squares = wave_squares(member, member.frequency_number(1j * points)).real
    waves = np.floor(np.sqrt(np.maximum(-squares, 0.0)) / np.pi).astype(np.int64)
    counted: Integers = waves[1] + np.where(squares[0] < 0.0, waves[0] + 1, 0)
    return counted

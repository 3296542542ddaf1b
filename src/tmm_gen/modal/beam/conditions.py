"""The conditions at base, joints and tip as one matrix without poles: its null vectors are the modes."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tmm_gen.modal.beam.arm import BeamArm
from tmm_gen.modal.beam.motions import solutions

Complex = NDArray[np.complex128]

_ITERATIONS = 40
_TOLERANCE = 1e-15
_DIFFERENCE = 1e-5


def conditions(arm: BeamArm, s: ArrayLike) -> Complex:
    """Return what the amplitudes of all beams have to meet: ``conditions @ amplitudes = 0`` in a mode.

    Where the dynamic stiffness has poles next to its roots (a slender beam's free and clamped tip differ by
    ``exp(-beta L)``), this matrix has the roots alone.

    Parameters
    ----------
    arm : BeamArm
        With m members.
    s : array_like, (f,)
        Laplace variable, 1/s.

    Returns
    -------
    array, (f, 4 m, 4 m)
        Four columns for each member, see :func:`~tmm_gen.modal.beam.motions.solutions`.
    """
    points = np.atleast_1d(np.asarray(s, complex))
    ends = [solutions(member, points) for member in arm.members]
    size = 4 * len(ends)
    found = np.zeros((len(points), size, size), complex)
    w, psi, moment, shear = range(4)
    first = ends[0][0]
    found[:, 0, :4] = first[:, w]
    found[:, 1, :4] = first[:, psi]
    if arm.base.turns:
        hub = arm.base.inertia * points**2 + arm.base.damping * points + arm.base.stiffness
        found[:, 1, :4] = first[:, moment] - hub[:, None] * first[:, psi]
    row = 2
    for k, body in enumerate(arm.bodies):
        here, there = slice(4 * k, 4 * k + 4), slice(4 * k + 4, 4 * k + 8)
        outer = ends[k][1]
        last = k + 1 == len(ends)
        # what accelerates the body leaves the beam's end; what is left acts on the next beam
        found[:, row, here] = outer[:, shear] + (body.mass * points**2)[:, None] * outer[:, w]
        found[:, row + 1, here] = outer[:, moment] + (body.inertia * points**2)[:, None] * outer[:, psi]
        if last:
            break
        inner = ends[k + 1][0]
        found[:, row, there] = -inner[:, shear]
        found[:, row + 1, there] = -inner[:, moment]
        found[:, row + 2, here], found[:, row + 2, there] = outer[:, w], -inner[:, w]
        if body.joint_stiffness is None:
            found[:, row + 3, here], found[:, row + 3, there] = outer[:, psi], -inner[:, psi]
        else:
            member = arm.members[k + 1]
            spring = body.joint_stiffness + body.joint_damping * points
            scale = np.abs(spring) + member.bending_stiffness / member.length  # a rigid joint stays a number
            joint, share = (spring / scale)[:, None], (1.0 / scale)[:, None]
            found[:, row + 3, here] = joint * outer[:, psi]
            found[:, row + 3, there] = share * inner[:, moment] - joint * inner[:, psi]
        row += 4
    return found


def refine(arm: BeamArm, s: complex) -> complex:
    """Return the root of the conditions next to a point.

    Newton's iteration on ``u^H C(s) v`` with the singular vectors of the smallest singular value (Ruhe 1973,
    SIAM J. Numer. Anal. 10, 674-689).

    Parameters
    ----------
    arm : BeamArm
        Damped or not.
    s : complex
        1/s, near a root and not zero.
    """
    best, last = s, np.inf
    with np.errstate(all="ignore"):  # what is no number ends the search
        for _ in range(_ITERATIONS):
            step = _DIFFERENCE * abs(s)
            near, behind, ahead = conditions(arm, np.array([s, s - step, s + step]))
            slopes = (ahead - behind) / (2.0 * step)
            rows, columns = _balance(near)
            balanced = rows[:, None] * near * columns
            if not (np.all(np.isfinite(balanced)) and np.all(np.isfinite(slopes))):
                return complex(np.nan, np.nan)
            left, _, right = np.linalg.svd(balanced)
            one, other = left[:, -1].conj() * rows, columns * right[-1].conj()
            change = complex(np.divide(one @ near @ other, one @ slopes @ other))
            s -= change
            if not np.isfinite(s):
                return complex(np.nan, np.nan)
            if abs(change) < last:
                best, last = s, abs(change)
            if abs(change) <= _TOLERANCE * abs(s):
                break
    return best


def amplitudes(arm: BeamArm, s: complex) -> Complex:
    """Return the amplitudes of the mode at a root, (members, 4)."""
    matrix = conditions(arm, np.array([s]))[0]
    rows, columns = _balance(matrix)
    _, _, right = np.linalg.svd(rows[:, None] * matrix * columns)
    found: Complex = (columns * right[-1].conj()).reshape(-1, 4)
    return found


def _balance(matrix: Complex) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return factors of rows and columns that make the largest entry of each about one."""
    rows, columns = np.ones(len(matrix)), np.ones(len(matrix))
    for _ in range(3):
        scaled = np.abs(rows[:, None] * matrix * columns)
        rows = rows / np.sqrt(_largest(scaled, 1))
        columns = columns / np.sqrt(_largest(scaled, 0))
    return rows, columns


def _largest(scaled: NDArray[np.float64], axis: int) -> NDArray[np.float64]:
    found = np.max(scaled, axis=axis)
    return np.where(found > 0.0, found, 1.0)

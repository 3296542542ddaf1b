"""How long to simulate where the user does not say: a few periods of the slowest swing."""

from __future__ import annotations

import math

import numpy as np

from tmm_gen.reference.planar_linear import vibration
from tmm_gen.scene import Scene

_PERIODS = 5
STANDARD_GRAVITY = 9.81
_NICE = (1.0, 1.5, 2.0, 3.0, 5.0, 7.0, 10.0)


def default_duration(scene: Scene) -> float:
    """Return a round number of seconds that covers some periods of the lowest natural frequency."""
    if not scene.model.linear:
        return _round_up(_PERIODS * 2.0 * math.pi / _slowest(scene))
    return _round_up(_PERIODS * 2.0 * math.pi / slowest_swing(scene))


def _slowest(scene: Scene) -> float:
    """Return the lowest frequency at which a planar arm bends, or swings in gravity behind free joints, rad/s."""
    frequencies = vibration(scene).frequencies
    found = [float(w) for w in frequencies[frequencies > 0.0][:1]]
    if any(joint.stiffness == 0.0 for joint in scene.joints):
        gravity = scene.model.gravity or 0.0
        # without gravity nothing sets a time: as if there were some
        found.append(math.sqrt((gravity or STANDARD_GRAVITY) / scene.reach))
    return min(found)


def slowest_swing(scene: Scene) -> float:
    """Return the lowest natural frequency of a chain that is not that of turning as a whole, rad/s.

    It is a singular value of ``M^-1/2 B^T K^1/2``, with ``B`` from angles to twists: an eigenvalue of a tridiagonal
    matrix without diagonal, which bisection finds to full relative accuracy (Demmel & Kahan 1990, SIAM J. Sci. Stat.
    Comput. 11, 873-912), whatever the ratios of stiffness.
    """
    from scipy.linalg import eigh_tridiagonal  # slow to import

    turning = scene.hub
    inertia = np.array([scene.base.inertia] * turning + [link.inertia for link in scene.links])
    spring = np.array([joint.stiffness for joint in scene.joints])
    inner = np.sqrt(spring[1 - turning :] / inertia[:-1])
    outer = np.sqrt(spring / inertia[turning:])
    beside = np.empty(len(inner) + len(outer))
    beside[turning::2], beside[1 - turning :: 2] = outer, inner
    place = len(spring) + turning  # after as many negative ones, and a zero where the chain turns
    found = eigh_tridiagonal(
        np.zeros(len(beside) + 1),
        beside,
        eigvals_only=True,
        select="i",
        select_range=(place, place),
        tol=np.finfo(float).tiny,
    )
    return float(found[0])


def _round_up(value: float) -> float:
    decade = 10.0 ** math.floor(math.log10(value))
    return next(float(f"{nice * decade:.3g}") for nice in _NICE if nice * decade >= value * (1.0 - 1e-9))

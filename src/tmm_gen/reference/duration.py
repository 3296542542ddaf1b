"""How long to simulate where the user does not say: a few periods of the slowest swing."""

from __future__ import annotations

import math

import numpy as np

from tmm_gen.reference.assembly import twists
from tmm_gen.reference.planar_linear import vibration
from tmm_gen.reference.spatial_linear import vibrations
from tmm_gen.scene import Scene

_PERIODS = 5
STANDARD_GRAVITY = 9.81
_STILL = 1e-6
"""Of frequencies of an arm in space, as a share of the highest: what is below is a free joint's, and no vibration."""
_NICE = (1.0, 1.5, 2.0, 3.0, 5.0, 7.0, 10.0)


def default_duration(scene: Scene) -> float:
    """Return a round number of seconds that covers some periods of the lowest natural frequency."""
    return _round_up(_PERIODS * 2.0 * math.pi / _slowest(scene))


def slowest_vibration(scene: Scene) -> float | None:
    """Return the lowest frequency at which springs give way, rad/s; None of an arm without a spring.

    A planar arm is taken as straight and without weight, one in space as it starts, without weight.
    """
    if scene.model.linear:
        return slowest_swing(scene)
    if scene.spatial is not None:
        found, _ = vibrations(scene.spatial)
        return next((float(w) for w in found if w > _STILL * found[-1]), None)
    frequencies = vibration(scene).frequencies
    return next((float(w) for w in frequencies if w > 0.0), None)


def _slowest(scene: Scene) -> float:
    """Return the lowest frequency at which an arm bends, or swings in gravity behind free joints, rad/s."""
    bends = slowest_vibration(scene)
    found = [] if bends is None else [bends]
    length = scene.reach
    joints = scene.spatial.joints if scene.spatial else scene.joints
    if not found or (length > 0.0 and any(joint.stiffness == 0.0 for joint in joints)):
        gravity = math.hypot(*scene.spatial.gravity) if scene.spatial else scene.model.gravity
        # without gravity nothing sets a time: as if there were some
        found.append(math.sqrt((gravity or STANDARD_GRAVITY) / (length or 1.0)))
    return min(found)


def slowest_swing(scene: Scene) -> float:
    """Return the lowest natural frequency of a chain that is not that of turning as a whole, rad/s.

    It is a singular value of ``M^-1/2 B^T K^1/2``, with ``B`` from angles to twists: an eigenvalue of a tridiagonal
    matrix without diagonal, which bisection finds to full relative accuracy (Demmel & Kahan 1990, SIAM J. Sci. Stat.
    Comput. 11, 873-912), whatever the ratios of stiffness.
    """
    from scipy.linalg import eigh_tridiagonal, svd  # slow to import

    turning = scene.hub
    inertia = np.array([scene.base.inertia] * turning + [link.inertia for link in scene.links])
    spring = np.array([joint.stiffness for joint in scene.joints])
    turns = np.array(scene.turns)  # all seen from the base's shaft
    inertia[turning:] /= turns**2
    spring /= turns**2
    if scene.hosts:
        return float(svd(np.sqrt(spring)[:, None] * twists(scene) / np.sqrt(inertia), compute_uv=False)[-1])
    inner_side = np.sqrt(spring[1 - turning :] / inertia[:-1])
    outer_side = np.sqrt(spring / inertia[turning:])
    beside = np.empty(len(inner_side) + len(outer_side))
    beside[turning::2], beside[1 - turning :: 2] = outer_side, inner_side
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

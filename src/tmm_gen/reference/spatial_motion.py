"""The motion of an arm in space over time, to about ten digits.

By collocation, whose steps no stiff joint limits; for long motions of soft arms too it is quicker than explicit methods
are at as many digits.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from tmm_gen.inputs.signals import Signal
from tmm_gen.reference.collocation import Trajectory, integrate
from tmm_gen.reference.spatial_afloat import AfloatArm
from tmm_gen.reference.spatial_arm import WorldArm
from tmm_gen.reference.spatial_given import GivenJoints, given
from tmm_gen.scene.spatial.arm import SpatialArm

Array = NDArray[np.float64]
Signals = Mapping[str, Signal]


def motion(
    arm: SpatialArm, signals: Signals, times: Array, tolerance: float = 1e-11
) -> tuple[Array, Array, Array]:
    """Return angles, rates and accelerations at some instants, (k, n) each, in rad, rad/s, rad/s^2.

    Of an arm whose base floats, these are the coordinates of :class:`tmm_gen.reference.spatial_afloat.AfloatArm`.

    Parameters
    ----------
    arm : SpatialArm
    signals : mapping from str to Signal
        Inputs by column; those not given are zero.
    times : array, (k,)
        Instants, s, increasing, from 0 on; at least one.
    tolerance : float
        See :func:`tmm_gen.reference.collocation.integrate`.

    Raises
    ------
    ReferenceError
        If the equations cannot be integrated.
    """
    times = np.asarray(times, float)
    q, v, _ = trajectory(arm, signals, max(float(times[-1]), 1e-9), tolerance).at(times)
    return completed(arm, signals, times, q, v)


def completed(
    arm: SpatialArm, signals: Signals, times: Array, q: Array, v: Array
) -> tuple[Array, Array, Array]:
    """Return a motion with what is given of it, and its accelerations, (k, n) each; see :func:`motion`."""
    told = GivenJoints(arm, signals)
    q, v = told.settled(times, q, v)
    world = _world(arm)
    if not told.of:
        return q, v, world.forward_dynamics(q, v, given(arm, signals, times))
    # linear in accelerations: one step of Newton's method from none of them
    a = np.zeros_like(q)
    inputs = given(arm, signals, times)
    lacking = told.lacking(times, a, np.asarray(world.inverse_dynamics(q, v, a, inputs), np.float64))
    tangent = told.slopes(*_Slopes(world, signals, told)(times, q, v, a))[2]
    found = np.linalg.solve(tangent, -lacking[..., None])[..., 0]
    return q, v, np.asarray(found, np.float64)


def _world(arm: SpatialArm) -> WorldArm | AfloatArm:
    return WorldArm(arm) if arm.base is None else AfloatArm(arm)


def trajectory(arm: SpatialArm, signals: Signals, until: float, tolerance: float = 1e-11) -> Trajectory:
    """Return the motion from where the arm starts as polynomials.

    Parameters
    ----------
    arm : SpatialArm
    signals : mapping from str to Signal
        Inputs by column; those not given are zero.
    until : float
        s, from 0.
    tolerance : float
        See :func:`tmm_gen.reference.collocation.integrate`.

    Raises
    ------
    ReferenceError
        If the equations cannot be integrated.
    """
    world, told = _world(arm), GivenJoints(arm, signals)

    def residual(at: Array, q: Array, v: Array, a: Array) -> Array:
        lacking = np.asarray(world.inverse_dynamics(q, v, a, given(arm, signals, at)), np.float64)
        return told.lacking(at, a, lacking)

    knots = np.unique(np.concatenate([[0.0, until], *(signal.knots for signal in signals.values())]))
    breaks = knots[(knots >= 0.0) & (knots <= until)]
    slopes = _Slopes(world, signals, told)
    begun = told.settled(np.zeros(()), *start(arm))
    return integrate(residual, slopes, *begun, breaks, tolerance)


class _Slopes:
    """Derivatives of the equations for collocation: those by angles and rates of one instant hold over a step.

    Newton's method so takes a few iterations more, and each is far cheaper; what it converges to is the same.
    """

    def __init__(self, world: WorldArm | AfloatArm, signals: Signals, told: GivenJoints) -> None:
        self._world, self._signals, self._told = world, signals, told
        self._of, self._held = (np.inf, np.inf), (np.empty(0), np.empty(0))

    def __call__(self, at: Array, q: Array, v: Array, a: Array) -> tuple[Array, Array, Array]:
        of = (float(at[0]), float(at[-1]))
        if of != self._of:
            middle = len(at) // 2
            inputs = given(self._world.arm, self._signals, at[middle])
            self._of, self._held = of, self._world.tangents(q[middle], v[middle], a[middle], inputs)
        by_q, by_v = (np.broadcast_to(tangent, (len(at), *tangent.shape)) for tangent in self._held)
        if isinstance(self._world, AfloatArm):
            return by_q, by_v, self._world.mass_matrix(q, v, {})
        return self._told.slopes(by_q, by_v, self._world.mass_matrix(q))


def start(arm: SpatialArm) -> tuple[Array, Array]:
    """Return the angles and rates at the start, (n,) each; of a base that floats, all coordinates."""
    if arm.base is not None:
        return AfloatArm(arm).start()
    return np.array([joint.angle for joint in arm.joints]), np.array([joint.rate for joint in arm.joints])

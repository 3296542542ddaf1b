"""The motion of an arm in space over time, to about ten digits.

By SciPy's explicit method of order 8 where the arm's fastest vibration allows that, and by collocation, whose steps no
stiff joint limits, where it does not.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from tmm_gen.inputs.signals import Signal
from tmm_gen.reference.collocation import ReferenceError, integrate
from tmm_gen.reference.spatial_arm import WorldArm
from tmm_gen.scene.spatial.arm import SpatialArm

Array = NDArray[np.float64]
Signals = Mapping[str, Signal]

_EXPLICIT = 3000.0
"""Radians of the fastest vibration, or decays, up to which the explicit method is the quicker one."""


def motion(
    arm: SpatialArm, signals: Signals, times: Array, tolerance: float = 1e-11
) -> tuple[Array, Array, Array]:
    """Return angles, rates and accelerations at some instants, (k, n) each, in rad, rad/s, rad/s^2.

    Parameters
    ----------
    arm : SpatialArm
    signals : mapping from str to Signal
        Inputs by column; those not given are zero.
    times : array, (k,)
        Instants, s, increasing, from 0 on; at least one.
    tolerance : float
        Of the explicit method relative and in rad; of collocation as
        :func:`tmm_gen.reference.collocation.integrate` has it.

    Raises
    ------
    ReferenceError
        If the equations cannot be integrated.
    """
    times = np.asarray(times, float)
    if pace(arm) * float(times[-1]) <= _EXPLICIT:
        q, v = explicit(arm, signals, times, tolerance)
    else:
        q, v = implicit(arm, signals, times, tolerance)
    return q, v, WorldArm(arm).forward_dynamics(q, v, given(signals, times))


def given(signals: Signals, times: Array) -> dict[str, Array]:
    """Return the values of inputs at instants, by column."""
    return {name: signal.at(times) for name, signal in signals.items()}


def pace(arm: SpatialArm) -> float:
    """Return the fastest rate of the arm where it starts, 1/s: of vibrations, decays or rotations."""
    world = WorldArm(arm)
    q, v = _start(arm)
    mass = world.mass_matrix(q)
    by_q, by_v = world.tangents(q, v, np.zeros_like(q), {})
    n = len(q)
    slope = np.block([[np.zeros((n, n)), np.eye(n)], [-np.linalg.solve(mass, np.hstack([by_q, by_v]))]])
    return float(np.max(np.abs(np.linalg.eigvals(slope))))


def explicit(
    arm: SpatialArm, signals: Signals, times: Array, tolerance: float = 1e-11
) -> tuple[Array, Array]:
    """Return angles and rates at some instants by SciPy's explicit method of order 8; arguments as of `motion`."""
    from scipy.integrate import solve_ivp  # slow to import

    world = WorldArm(arm)
    n = len(arm.joints)

    def slope(time: float, state: Array) -> Array:
        at = {name: float(signal.at(time)) for name, signal in signals.items()}
        with np.errstate(all="ignore"):
            return np.concatenate([state[n:], world.forward_dynamics(state[:n], state[n:], at)])

    state = np.concatenate(_start(arm))
    found = np.empty((len(times), 2 * n))
    breaks = _breaks(signals, times)
    found[times <= 0.0] = state
    for begin, end in zip(breaks[:-1].tolist(), breaks[1:].tolist(), strict=True):
        inside = (times > begin) & (times <= end)
        wanted = np.append(times[inside & (times < end)], end)
        solved = solve_ivp(
            slope, (begin, end), state, method="DOP853", rtol=tolerance, atol=tolerance, t_eval=wanted
        )
        if not solved.success:
            raise ReferenceError(
                f"the reference cannot pass t = {solved.t[-1] if len(solved.t) else begin:g} s"
            )
        state = solved.y[:, -1]
        found[inside] = solved.y.T[: np.count_nonzero(inside)]
    return found[:, :n], found[:, n:]


def implicit(
    arm: SpatialArm, signals: Signals, times: Array, tolerance: float = 1e-11
) -> tuple[Array, Array]:
    """Return angles and rates at some instants by collocation; arguments as of `motion`."""
    world = WorldArm(arm)

    def residual(at: Array, q: Array, v: Array, a: Array) -> Array:
        return np.asarray(world.inverse_dynamics(q, v, a, given(signals, at)), np.float64)

    def slopes(at: Array, q: Array, v: Array, a: Array) -> tuple[Array, Array, Array]:
        return *world.tangents(q, v, a, given(signals, at)), world.mass_matrix(q)

    trajectory = integrate(residual, slopes, *_start(arm), _breaks(signals, times), tolerance)
    q, v, _ = trajectory.at(times)
    return q, v


def _start(arm: SpatialArm) -> tuple[Array, Array]:
    """Return the angles and rates at the start, (n,) each."""
    return np.array([joint.angle for joint in arm.joints]), np.array([joint.rate for joint in arm.joints])


def _breaks(signals: Signals, times: Array) -> Array:
    """Return the start, the instants at which a piece of some input begins, and the end."""
    until = max(float(times[-1]), 1e-9)
    knots = np.unique(np.concatenate([[0.0, until], *(signal.knots for signal in signals.values())]))
    return knots[(knots >= 0.0) & (knots <= until)]

"""The exact response of a scene: of a chain under simple inputs, the matrix exponential of its assembled matrices.

With the inputs and their rates as further states (``u'' = -w^2 u`` on each piece), the response at the
next instant is a matrix times the state at the last: right to rounding at any sampling, for inputs that
are constant, linear in between or harmonic (Moler & Van Loan 2003, SIAM Review 45, method 3, and their
remark on inhomogeneous systems). Under other inputs it is right to about eleven digits, by collocation.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from tmm_gen.inputs.signals import Constant, Harmonic, Signal
from tmm_gen.reference.assembly import Assembly, assemble
from tmm_gen.reference.collocation import integrate
from tmm_gen.reference.planar_reference import planar_response
from tmm_gen.reference.spatial_reference import spatial_response
from tmm_gen.scene import Scene

Array = NDArray[np.float64]

_SAME_STEP = 1e-9
"""Intervals that differ by less, relatively, share one exponential: they differ by rounding only."""


def exact_response(scene: Scene, signals: Mapping[str, Signal], times: Array) -> dict[str, Array]:
    """Return the exact outputs of a scene; those of arms to about ten digits.

    Parameters
    ----------
    scene : Scene
        Of any kind.
    signals : mapping from str to Signal
        Inputs by name, in space by column; those not given are zero. Where a prescribed angle is a table, straight in
        between, its rate jumps at the knots and its acceleration is reported as zero.
    times : array, (k,)
        Instants, s, increasing, from 0 on; at least one.

    Returns
    -------
    dict from str to array, (k,)
        Outputs by name, vectors as ``NAME_x`` and ``NAME_y``, in space by column.

    Raises
    ------
    ReferenceError
        If the equations of an arm cannot be integrated.
    """
    if scene.spatial is not None:
        return spatial_response(scene.spatial, signals, times)
    if not scene.model.linear:
        return planar_response(scene, signals, times)
    assembly = assemble(scene)
    ordered = [signals.get(name, Constant(0.0)) for name in assembly.inputs]
    times = np.asarray(times, float)
    simple = [signal for signal in ordered if isinstance(signal, Harmonic)]
    outputs = (
        _outputs(assembly, simple, times)
        if len(simple) == len(ordered)
        else _collocated(assembly, ordered, times)
    )
    return dict(zip(assembly.outputs, outputs, strict=True))


def _collocated(assembly: Assembly, signals: list[Signal], times: Array) -> Array:
    """Return the outputs under any inputs, (outputs, k)."""

    def inputs(at: Array, which: str) -> Array:
        """Return values or derivatives of all inputs, (k, inputs)."""
        return np.stack([np.broadcast_to(getattr(s, which)(at), at.shape) for s in signals], axis=1)

    def residual(at: Array, q: Array, v: Array, a: Array) -> Array:
        load: Array = inputs(at, "at") @ assembly.load.T + inputs(at, "slope") @ assembly.load_rate.T
        return a @ assembly.mass + v @ assembly.damping + q @ assembly.stiffness - load

    def slopes(at: Array, q: Array, v: Array, a: Array) -> tuple[Array, Array, Array]:
        def each(matrix: Array) -> Array:
            return np.broadcast_to(matrix, (len(at), *matrix.shape))

        return each(assembly.stiffness), each(assembly.damping), each(assembly.mass)

    until = max(float(times[-1]), 1e-9)
    knots = np.unique(np.concatenate([[0.0, until], *(signal.knots for signal in signals)]))
    breaks = knots[(knots >= 0.0) & (knots <= until)]
    q, v, a = integrate(residual, slopes, assembly.angle, assembly.rate, breaks).at(times)
    found: Array = (
        assembly.from_angle @ q.T
        + assembly.from_rate @ v.T
        + assembly.from_acceleration @ a.T
        + assembly.from_input @ inputs(times, "at").T
        + assembly.from_input_rate @ inputs(times, "slope").T
        + assembly.from_input_acceleration @ inputs(times, "curvature").T
    )
    return found


def _outputs(assembly: Assembly, signals: list[Harmonic], times: Array) -> Array:
    """Return the outputs, (outputs, k)."""
    system, read = _augmented(assembly, signals)
    m, inputs = len(assembly.mass), len(signals)
    state = np.concatenate([assembly.angle, assembly.rate, np.zeros(2 * inputs)])
    breaks = _breaks(signals, times)
    visits = np.unique(np.concatenate([times, breaks]))
    exponentials = _Exponentials(system)
    found = np.zeros((len(assembly.outputs), len(times)))
    now, column = 0.0, 0
    sampled, breaking = set(times.tolist()), set(breaks.tolist())
    for visit in visits.tolist():
        if visit > now:
            state = exponentials.over(visit - now) @ state
            now = visit
        if visit in breaking:  # start each piece from its own values, not from carried ones
            state[2 * m : 2 * m + inputs] = [float(signal.at(visit)) for signal in signals]
            state[2 * m + inputs :] = [float(signal.slope(visit)) for signal in signals]
        if visit in sampled:
            found[:, column] = read @ state
            column += 1
    return found


def _breaks(signals: Sequence[Signal], times: Array) -> Array:
    """Return the instants at which a piece of some input begins, moved to the sample they mean, if any."""
    knots = np.unique(np.concatenate([[0.0], *(signal.knots for signal in signals)]))
    knots = knots[(knots >= 0.0) & (knots <= times[-1])]
    nearest = times[np.argmin(np.abs(times[None, :] - knots[:, None]), axis=1)]
    snapped: Array = np.where(np.isclose(nearest, knots, rtol=1e-12, atol=0.0), nearest, knots)
    return snapped


def _augmented(assembly: Assembly, signals: list[Harmonic]) -> tuple[Array, Array]:
    """Return the system matrix of ``[q, q', u, u']`` and the matrix that reads the outputs off it."""
    m, inputs = len(assembly.mass), len(signals)
    inverse = 1.0 / np.diag(assembly.mass)[:, None]
    acceleration = np.hstack(
        [
            -inverse * assembly.stiffness,
            -inverse * assembly.damping,
            inverse * assembly.load,
            inverse * assembly.load_rate,
        ]
    )
    size = 2 * (m + inputs)
    system = np.zeros((size, size))
    system[:m, m : 2 * m] = np.eye(m)
    system[m : 2 * m] = acceleration
    system[2 * m : 2 * m + inputs, 2 * m + inputs :] = np.eye(inputs)
    squares = np.array([signal.frequency**2 for signal in signals])
    system[2 * m + inputs :, 2 * m : 2 * m + inputs] = -np.diag(squares)
    from_input = assembly.from_input - assembly.from_input_acceleration * squares
    read = np.hstack([assembly.from_angle, assembly.from_rate, from_input, assembly.from_input_rate])
    return system, read + assembly.from_acceleration @ acceleration


class _Exponentials:
    """Matrix exponentials by interval, each computed once."""

    def __init__(self, system: Array) -> None:
        self._system = system
        self._found: list[tuple[float, Array]] = []

    def over(self, interval: float) -> Array:
        from scipy.linalg import expm  # slow to import

        for known, exponential in self._found:
            if abs(known - interval) <= _SAME_STEP * known:
                return exponential
        made: Array = expm(self._system * interval)
        self._found.append((interval, made))
        return made

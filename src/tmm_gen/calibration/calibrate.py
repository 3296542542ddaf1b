"""Fits numbers of a scene to a recorded response, and says how sure they are."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from tmm_gen.calibration.fit import MAD, Fit, sorted_out
from tmm_gen.calibration.fitted_keys import (
    changes,
    default_keys,
    number_of,
    refuse_overlaps,
    replaced,
)
from tmm_gen.calibration.outcome import Calibration, Fitted
from tmm_gen.calibration.telling import Told
from tmm_gen.calibration.uncertainty import deviations
from tmm_gen.errors import CheckFailed, UserError
from tmm_gen.inputs.clock import starts_of
from tmm_gen.inputs.signals import Signal
from tmm_gen.scene import Scene

__all__ = ["MOST_MISFIT", "Calibration", "Fitted", "Loss", "calibrate"]

Array = NDArray[np.float64]
Loss = Literal["linear", "huber"]

MOST_MISFIT = 0.5
"""What may be left, as a share of the record's standard deviation: more, and the model does not follow it."""

_SCAN = np.geomspace(0.25, 4.0, 25)
"""Factors of a parameter tried before the fit: the response is not convex in a frequency."""

_FARTHEST = float(np.log(1e4))
"""Of a fitted number from the given one, in logarithms."""

_HUBER = 1.345
"""Remains beyond so many standard deviations lose weight: 95 % as efficient as least squares where all are normal."""

_ROUNDS = 3
"""Fits by Huber's loss, each with the standard deviation that the one before left."""


def calibrate(
    scene: Scene,
    record: Mapping[str, Signal],
    keys: Sequence[str] | None = None,
    *,
    start: float | None = None,
    loss: Loss = "linear",
    most_misfit: float = MOST_MISFIT,
) -> Calibration:
    """Fit numbers of a scene to a record, by least squares on their logarithms.

    Outputs are simulated with the scene's kernel from its initial state under the recorded inputs, and compared at
    the recorded instants, each relative to its own standard deviation. For how sure the numbers are, see
    :mod:`tmm_gen.calibration.uncertainty`.

    Parameters
    ----------
    scene : Scene
        To start from.
    record : mapping from str to Signal
        Inputs and, as tables, at least one output by name; inputs without a record are zero. All tables have one
        clock, in seconds.
    keys : sequence of str, optional
        Dotted keys of positive numbers in the scene, parts by name, or ``stiffness`` and ``damping`` for factors of all
        springs and dampers; see :func:`default_keys`.
    start : float, optional
        When, on that clock, the arm was in the scene's initial state; see :func:`tmm_gen.inputs.clock.starts_of`.
    loss : {"linear", "huber"}
        Least squares, or Huber's loss, by which samples that are far off count as if they were less so.
    most_misfit : float
        What may be left, as a share of the record's standard deviation.

    Raises
    ------
    CheckFailed
        If more than `most_misfit` is left.
    UserError
        If nothing recorded is an output, the clocks do not fit, a key is no positive number, or the record does not
        tell keys apart.
    """
    chosen = tuple(keys or default_keys(scene))
    given = np.array([number_of(scene, key) for key in chosen])
    refuse_overlaps(scene, chosen)
    inputs, outputs = sorted_out(scene, record)
    starts = starts_of(outputs, inputs) if start is None else (start,)
    fits = [Fit(scene, record, chosen, given, each, robust=loss == "huber") for each in starts]
    tried = [(fit, *_solved(fit, each, loss)) for fit in fits for each in _starts(fit)]
    fit, logarithms, reach = min(tried, key=lambda each: _size(each[0].remains(each[1]), each[2]))
    before = fit.remains(np.zeros(len(chosen)))
    left = fit.remains(logarithms)
    jacobian = _jacobian(fit, logarithms)
    normal = _normal(jacobian, left, reach)
    absent = _absent(scene, record)
    if absent and not np.any(normal):
        raise UserError(f"{scene.source.origin}: nothing that is fitted makes a difference.{absent}")
    told = Told.of(normal)
    if len(told.apart) < len(chosen):
        # where a fit ends along what the record does not tell is chance: shares are those beside the given numbers
        near = told.near_given(logarithms)
        beside = Told.of(_normal(_jacobian(fit, near), fit.remains(near), reach))
        told = beside if len(beside.apart) < len(chosen) else told
        raise UserError(
            f"{scene.source.origin}: the record does not tell {' and '.join(chosen)} apart. {told.remedy(chosen)}"
            f"{absent if told.unseen else ''}"
        )
    misfit = _size(left, reach)
    if not misfit < most_misfit:
        raise CheckFailed(_unlike(scene, fit, misfit, most_misfit, loss) + absent)
    if (far := np.abs(logarithms) > 0.99 * _FARTHEST).any():
        raise CheckFailed(
            f"{scene.source.origin}: '{chosen[int(np.argmax(far))]}' leaves all bounds: the record asks for a value "
            "ten thousand times larger or smaller than the scene's. Correct the scene first, or fit other keys only."
        )
    spread, correlation = deviations(jacobian, left, fit.instants, reach)
    values = given * np.exp(logarithms)
    changed = changes(scene, dict(zip(chosen, values.tolist(), strict=True)))
    return Calibration(
        scene=replaced(scene, changed),
        changes=changed,
        found=tuple(
            Fitted(key, float(old), float(new), float(new * deviation))
            for key, old, new, deviation in zip(chosen, given, values, spread, strict=True)
        ),
        correlation=correlation,
        misfit_before=_size(before, reach),
        misfit=misfit,
        samples=len(left),
        outliers=int(np.sum(np.abs(left) > reach)),
        start=fit.start,
    )


def _starts(fit: Fit) -> list[Array]:
    """Return logarithms to start from: the first number scanned, and all of them, each with those before it.

    Neither leads to the right valley always where springs stand in series: the better end of both counts.
    """
    at = np.zeros(len(fit.keys))
    found = []
    for k in range(len(at)):
        tried = [at + np.log(factor) * np.eye(len(at))[k] for factor in _SCAN]
        # what is far off counts no more than what is three deviations off, whatever the loss: this is but a start
        at = min(tried, key=lambda each: _size(fit.remains(each), 3.0))
        found.append(at)
    return found if len(found) < 2 else [found[0], found[-1]]


def _solved(fit: Fit, start: Array, loss: Loss) -> tuple[Array, float]:
    """Return the fitted logarithms, and beyond what remains lost weight."""
    from scipy.optimize import least_squares  # slow to import

    reach = np.inf
    for _ in range(_ROUNDS if loss == "huber" else 1):
        if loss == "huber":
            noise = MAD * float(np.median(np.abs(fit.remains(start))))
            reach = max(_HUBER * noise, 1e-9)
        start = least_squares(
            fit.remains,
            start,
            bounds=(-_FARTHEST, _FARTHEST),
            x_scale="jac",
            xtol=1e-10,
            ftol=1e-12,
            loss=loss,
            f_scale=reach if np.isfinite(reach) else 1.0,
        ).x
    return start, reach


def _jacobian(fit: Fit, logarithms: Array) -> Array:
    """Return the Jacobian of what remains, by central differences."""
    nudge = 1e-5
    columns = []
    for k in range(len(logarithms)):
        beside = nudge * np.eye(len(logarithms))[k]
        columns.append((fit.remains(logarithms + beside) - fit.remains(logarithms - beside)) / (2.0 * nudge))
    return np.array(columns).T


def _normal(jacobian: Array, remains: Array, reach: float) -> Array:
    """Return the matrix of the normal equations, of what has not lost weight."""
    weighed = jacobian[np.abs(remains) <= reach]
    return np.asarray(weighed.T @ weighed, float)


def _size(remains: Array, reach: float) -> float:
    """Return the root mean square, of what lost weight no more than it counts."""
    return float(np.sqrt(np.mean(np.clip(remains, -reach, reach) ** 2)))


def _absent(scene: Scene, record: Mapping[str, Signal]) -> str:
    """Say which inputs the record leaves out; nothing where it has them all."""
    names = [item.name for item in scene.inputs if item.name not in record]
    if not names:
        return ""
    return (
        f" Inputs without a record are zero: the record has no column {' or '.join(names)}. Say what acted, for "
        f"example --input {names[0]}=1."
    )


def _unlike(scene: Scene, fit: Fit, misfit: float, most: float, loss: Loss) -> str:
    """Say that no numbers make the model follow the record, and what it may be."""
    robust = (
        "" if loss == "huber" else " Where single samples are wrong, --loss huber gives them less weight."
    )
    return (
        f"{scene.source.origin}: the model does not follow the record: {100 * misfit:.3g} % of its standard deviation "
        f"is left, {100 * most:.3g} % is allowed (--max-misfit). Taken was: the arm starts at {fit.start:g} s of the "
        f"clock, and moves for {fit.until:.4g} s. Check the clock (--start, --time-unit), the inputs, units and signs "
        f"of the columns, and the scene's initial state.{robust}"
    )

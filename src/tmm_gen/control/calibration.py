"""Fits numbers of a scene to a recorded response, and says how sure they are."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.errors import UserError
from tmm_gen.measure.prescribed import Derivative, kernel_signals
from tmm_gen.measure.signals import Signal, Table
from tmm_gen.native import NativeKernel, compile_kernel
from tmm_gen.program.build import build_program
from tmm_gen.scene import Scene
from tmm_gen.scene.problem import Path

Array = NDArray[np.float64]

STIFFNESS, DAMPING = "stiffness", "damping"
"""Stand for all joints of a scene without a beam: a common factor."""

_SCAN = np.geomspace(0.25, 4.0, 25)
"""Factors of the first parameter tried before the fit: the response is not convex in a frequency."""
_FLAT = 1e12
"""Condition number of the normal equations beyond which the record does not tell the parameters apart."""


@dataclass(frozen=True)
class Found:
    """A fitted number.

    Parameters
    ----------
    key : str
        In the scene, dotted.
    given, value : float
        Before and after.
    deviation : float
        Standard deviation of ``value``, from the covariance of the fit.
    """

    key: str
    given: float
    value: float
    deviation: float

    @property
    def interval(self) -> tuple[float, float]:
        """95 % confidence interval, of a normal distribution of the logarithm."""
        spread = float(np.exp(1.96 * self.deviation / self.value))
        return self.value / spread, self.value * spread


@dataclass(frozen=True, eq=False)
class Calibration:
    """The outcome of a fit.

    Parameters
    ----------
    scene : Scene
        With the fitted numbers.
    changes : mapping from path to float
        What changed in its file.
    found : tuple of Found
        One for each.
    correlation : array, (p, p)
        Of the fitted numbers' logarithms.
    misfit_before, misfit : float
        Root mean square of what the model is off, relative to the record's standard deviation.
    samples : int
        Numbers compared.
    """

    scene: Scene
    changes: Mapping[Path, float]
    found: tuple[Found, ...]
    correlation: Array
    misfit_before: float
    misfit: float
    samples: int


def default_keys(scene: Scene) -> tuple[str, ...]:
    """Return what is fitted unless told otherwise: stiffness and damping."""
    if scene.beam is None:
        return STIFFNESS, DAMPING
    damped = ("beam.damping_time",) if scene.beam.damping_time else ()
    return ("beam.bending_stiffness", *damped)


def calibrate(scene: Scene, record: Mapping[str, Signal], keys: Sequence[str] | None = None) -> Calibration:
    """Fit numbers of a scene to a record, by least squares on their logarithms.

    Outputs are simulated with the scene's kernel from its initial state under the recorded inputs, and compared at
    the recorded instants, each relative to its own standard deviation. The covariance is that of a linearised fit,
    ``s^2 (J'J)^-1`` with ``s^2`` the variance of what remains; remains are taken to be independent.

    Parameters
    ----------
    scene : Scene
        To start from.
    record : mapping from str to Signal
        Inputs and, as tables, at least one output by name; inputs without a record are zero.
    keys : sequence of str, optional
        Dotted keys of positive numbers in the scene, or ``stiffness`` and ``damping`` for factors of all joints; see
        :func:`default_keys`.

    Raises
    ------
    UserError
        If nothing recorded is an output, a key is no positive number, or the record does not tell keys apart.
    """
    from scipy.optimize import least_squares  # slow to import

    chosen = tuple(keys or default_keys(scene))
    given = np.array([_value(scene, key) for key in chosen])
    fit = _Fit(scene, record, chosen, given)
    start = np.zeros(len(chosen))
    costs = []
    for factor in _SCAN:
        costs.append(float(np.sum(fit.remains(np.array([np.log(factor), *start[1:]])) ** 2)))
    start[0] = float(np.log(_SCAN[int(np.argmin(costs))]))
    solved = least_squares(fit.remains, start, x_scale="jac", xtol=1e-10, ftol=1e-12)
    normal = solved.jac.T @ solved.jac
    diagonal = np.sqrt(np.diag(normal))
    if np.any(diagonal == 0.0) or np.linalg.cond(normal / np.outer(diagonal, diagonal)) > _FLAT:
        raise UserError(
            f"{scene.source.origin}: the record does not tell {' and '.join(chosen)} apart. "
            "Fit fewer keys, or record a livelier motion."
        )
    samples = len(solved.fun)
    variance = float(solved.fun @ solved.fun) / max(samples - len(chosen), 1)
    covariance = variance * np.linalg.inv(normal)
    deviations = np.sqrt(np.diag(covariance))
    values = given * np.exp(solved.x)
    changes = _changes(scene, dict(zip(chosen, values.tolist(), strict=True)))
    before = fit.remains(np.zeros(len(chosen)))
    return Calibration(
        scene=_replaced(scene, changes),
        changes=changes,
        found=tuple(
            Found(key, float(old), float(new), float(new * deviation))
            for key, old, new, deviation in zip(chosen, given, values, deviations, strict=True)
        ),
        correlation=covariance / np.outer(deviations, deviations),
        misfit_before=float(np.sqrt(np.mean(before**2))),
        misfit=float(np.sqrt(np.mean(solved.fun**2))),
        samples=samples,
    )


class _Fit:
    """Simulates a scene with changed numbers, on one compiled kernel."""

    def __init__(self, scene: Scene, record: Mapping[str, Signal], keys: Sequence[str], given: Array) -> None:
        self.scene, self.keys, self.given = scene, keys, given
        # links and joints that are alike share a number in the kernel; those to be fitted apart must not
        apart = {
            key: value * (1.01 + 0.01 * k) for k, (key, value) in enumerate(zip(keys, given, strict=True))
        }
        unlike = _replaced(scene, _changes(scene, apart))
        self.kernel: NativeKernel = compile_kernel(build_program(unlike), unlike)
        inputs = {item.name for item in scene.inputs}
        self.signals: dict[str, Signal] = {name: record[name] for name in record if name in inputs}
        self.outputs = {
            variable.name: column
            for variable in self.kernel.program.outputs
            if isinstance(column := record.get(variable.name), Table)
        }
        if not self.outputs:
            known = ", ".join(variable.name for variable in self.kernel.program.outputs)
            raise UserError(
                f"{scene.source.origin}: the record has none of the outputs {known}. Add a column."
            )
        self.scales = {name: float(np.std(table.values)) or 1.0 for name, table in self.outputs.items()}
        self.until = max(float(table.times[-1]) for table in self.outputs.values())

    def remains(self, logarithms: Array) -> Array:
        """Return what the model is off at the recorded instants, relative to the record's standard deviation."""
        values = dict(zip(self.keys, (self.given * np.exp(logarithms)).tolist(), strict=True))
        known = parameters_of(_replaced(self.scene, _changes(self.scene, values)))
        parameters = {
            v.name: known[v.name] if v.length or np.ndim(known[v.name]) == 0 else known[v.name][0]
            for v in self.kernel.program.parameters
            if v.name in known
        }
        signals = {name: _caller(signal) for name, signal in kernel_signals(self.scene, self.signals).items()}
        step = self.scene.integrator.step
        times, found = self.kernel.simulate(self.until + step, signals, parameters)
        return np.concatenate(
            [
                (np.interp(table.times, times, found[name]) - table.values) / self.scales[name]
                for name, table in self.outputs.items()
            ]
        )


def parameters_of(scene: Scene) -> dict[str, Any]:
    """Return the physical parameters of a scene by their names in a kernel."""
    joints, links = scene.joints, scene.links
    found: dict[str, Any] = {
        "stiffness": [joint.stiffness for joint in joints],
        "damping": [joint.damping for joint in joints],
        "inertia": [link.inertia for link in links],
        "mass": [link.mass for link in links],
        "length": [link.length for link in links],
        "center": [link.center for link in links],
        "gravity": scene.model.gravity or 0.0,
        "hub_inertia": scene.base.inertia,
        "hub_damping": scene.base.damping,
    }
    if scene.tip is not None:
        found |= {"tip_mass": scene.tip.mass, "tip_inertia": scene.tip.inertia}
    return found


def _caller(signal: Signal | Derivative) -> Any:
    return lambda time: float(signal.at(time))


def _value(scene: Scene, key: str) -> float:
    """Return a number of the scene, 1 for a factor of all joints.

    Raises
    ------
    UserError
        If there is none, or it is not positive.
    """
    if key in (STIFFNESS, DAMPING):
        return 1.0
    value: Any = scene.source.data
    for part in key.split("."):
        try:
            value = value[int(part) - 1] if part.isdecimal() else value[part]
        except (KeyError, IndexError, TypeError):
            raise UserError(
                f"{scene.source.origin}: has no number '{key}' to fit. "
                "Name a key of the file, tables counted from 1: beam.bending_stiffness, joint.1.stiffness."
            ) from None
    if isinstance(value, bool) or not isinstance(value, int | float) or value <= 0:
        raise UserError(f"{scene.source.origin}: '{key}' is {value!r}; only a positive number can be fitted.")
    return float(value)


def _changes(scene: Scene, values: Mapping[str, float]) -> dict[Path, float]:
    """Return the new numbers by their places in the file."""
    found: dict[Path, float] = {}
    for key, value in values.items():
        if key not in (STIFFNESS, DAMPING):
            found[tuple(int(part) - 1 if part.isdecimal() else part for part in key.split("."))] = value
            continue
        entries: Any = scene.source.data.get("joint", ())
        for number, entry in enumerate(entries):
            if key in entry:
                found["joint", number, key] = value * float(entry[key])
    return found


def _replaced(scene: Scene, changes: Mapping[Path, float]) -> Scene:
    """Return the scene with new numbers."""
    keys = {
        ".".join(str(part + 1) if isinstance(part, int) else part for part in path): value
        for path, value in changes.items()
    }
    return scene.replace(**keys)

"""What single precision costs: the C kernel in ``float`` beside itself in ``double``, and how that grows with time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.native import compile_kernel
from tmm_gen.native.differences import with_derivatives
from tmm_gen.native.series import Sampled, Series
from tmm_gen.program.build import build_program
from tmm_gen.scene import Scene

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class SingleError:
    """Difference between single and double precision in one output.

    Parameters
    ----------
    output : str
        Its name.
    peak : float
        Largest value in double precision, in the output's unit; what the others are relative to.
    largest : float
        Largest difference over the peak.
    times : array, (k,)
        Middles of the windows, s.
    windows : array, (k,)
        Root mean square of the difference over the peak, in windows of equal length.
    """

    output: str
    peak: float
    largest: float
    times: Array
    windows: Array

    @property
    def growth(self) -> float:
        """Exponent of time with which the error grows: 0 stays, 0.5 is a random walk, 1 a drift, negative dies out.

        Fitted to the logarithms of the windows but the first tenth.
        """
        behind = slice(len(self.windows) // 10, None)
        floor = np.finfo(float).tiny
        logs = np.log(np.maximum(self.windows[behind], floor))
        return float(np.polyfit(np.log(self.times[behind]), logs, 1)[0])


def single_precision(
    scene: Scene, signals: Mapping[str, Sampled], steps: int, windows: int = 20
) -> tuple[SingleError, ...]:
    """Run a scene's C kernel in single and in double precision and compare its outputs.

    Parameters
    ----------
    scene : Scene
        At its own step; ``emit.real`` does not matter, ``emit.compensated`` tells how single precision is used.
    signals : mapping from str to callable
        Inputs by name, from instants (s) to values; those not named are zero. Both kernels get them rounded to single
        precision, as what a kernel is handed is none of its errors.
    steps : int
        How many.
    windows : int
        Into which the run is divided.

    Raises
    ------
    UserError
        If a number of the scene is out of the range of ``float``, or there is no compiler.
    ArithmeticError
        If the motion leaves the range of the number type.
    """
    program = build_program(scene)
    step = scene.integrator.step
    # rates of a prescribed base are those of the angle as it is, not of its last digits
    acting = with_derivatives(program, signals, step)
    rounded = {name: _rounded(signal) for name, signal in acting.items()}
    double, single = (
        Series(compile_kernel(program, _free_of_bounds(scene, real)), rounded, steps, step).run()
        for real in ("float64", "float32")
    )
    return tuple(_compared(name, double[name], single[name], step, windows) for name in double)


def _rounded(signal: Sampled) -> Sampled:
    return lambda times: signal(times).astype(np.float32).astype(float)


def _free_of_bounds(scene: Scene, real: str) -> Scene:
    """Return a scene of a number type, without the box that a proof needs."""
    changes: dict[str, object] = {"emit.real": real}
    if real == "float64" and scene.emit.compensated:
        changes["emit.compensated"] = False
    if scene.emit.box is not None:
        changes["emit.box"] = None
    return scene.replace(**changes)


def _compared(name: str, double: Array, single: Array, step: float, windows: int) -> SingleError:
    peak = float(np.max(np.abs(double)))
    error = np.abs(single - double) / (peak or 1.0)
    parts = np.array_split(error[1:], windows)
    times = step * np.cumsum([len(part) for part in parts]) - 0.5 * step * np.array([len(p) for p in parts])
    squares = np.array([np.sqrt(np.mean(part**2)) for part in parts])
    return SingleError(name, peak, float(np.max(error)), times, squares)

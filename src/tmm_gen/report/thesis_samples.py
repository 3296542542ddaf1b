"""The two samples of Gholampour (2018) with the five integrators of the thesis: kernels, figures, errors."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.inputs.signals import Constant
from tmm_gen.native.python_module import import_package
from tmm_gen.native.timing import by_turns
from tmm_gen.reference.assembly import assemble
from tmm_gen.reference.reference import exact_response
from tmm_gen.resources import scenes_dir
from tmm_gen.scene import Scene, load_scene
from tmm_gen.simulate.metrics import largest_error, rms_error, step_figures

Array = NDArray[np.float64]

SAMPLES = {"thesis2": 20.0, "thesis10": 80.0}
"""Scenes, and how long to run them, s."""

INTEGRATORS: dict[str, dict[str, float]] = {
    "fox_euler": {},
    "newmark": {"beta": 0.25},
    "wilson": {"theta": 1.4},
    "houbolt": {},
    "zhou": {},
}
"""Those of the thesis, with their parameters."""

THESIS_STEP = 0.1
"""s; the step at which the thesis's curves are reproduced."""

LOAD = {"tip_torque": 1.0}


@dataclass(frozen=True, eq=False)
class Curve:
    """A tip angle over time.

    Parameters
    ----------
    time, tip : array, (k,)
        s, rad.
    error : array, (k,)
        Deviation from the exact response, relative to the static deflection.
    """

    time: Array
    tip: Array
    error: Array


@dataclass(frozen=True, eq=False)
class Sample:
    """One scene: the exact response, and the curves at the thesis's step by integrator.

    Parameters
    ----------
    scene : Scene
        As in the file.
    static : float
        Static deflection of the tip, rad.
    exact : Curve
        Finely sampled.
    curves : dict from str to Curve
        By integrator; "printed" is the proposed method with the coefficients of table 3-8 as printed.
    """

    scene: Scene
    static: float
    exact: Curve
    curves: dict[str, Curve]


@dataclass(frozen=True, eq=False)
class ThesisSamples:
    """Everything the demonstration shows.

    Parameters
    ----------
    rows : list of dict
        One for each scene and integrator, and the method as printed.
    samples : list of Sample
        For the picture.
    kernels : dict from path to str
        Generated files, by path inside the output folder.
    timers : list of callable
        One for each compiled kernel, in the order of the rows: measures the nanoseconds of a step.
    """

    rows: list[dict[str, object]]
    samples: list[Sample]
    kernels: dict[Path, str]
    timers: list[Callable[[], float]] = field(default_factory=list)


def run_thesis_samples(advance: Callable[[float, str], None]) -> ThesisSamples:
    """Build, run, compile and compare everything.

    Parameters
    ----------
    advance : callable
        Called with the number of kernels done and what comes next.

    Raises
    ------
    UserError
        If there is no C compiler.
    """
    demo = ThesisSamples([], [], {})
    for name, duration in SAMPLES.items():
        scene = load_scene(scenes_dir() / f"{name}.toml")
        static = float(assemble(scene).static(np.array([1.0]))[0])
        fine = np.linspace(0.0, duration, 2001)
        tip = exact_response(scene, _signals(), fine)["tip"]
        sample = Sample(scene, static, Curve(fine, tip, np.zeros_like(fine)), {})
        for method, parameters in INTEGRATORS.items():
            advance(0, f"{name} with {method}")
            changes = {f"integrator.{key}": value for key, value in parameters.items()}
            chosen = scene.replace(**{"integrator.name": method, **changes})
            _one(demo, sample, chosen, duration)
            advance(1, f"{name} with {method}")
        demo.samples.append(sample)
    advance(0, "measuring times")
    # all kernels by turns: rows measured one after the other tell how busy the machine was
    for row, cost in zip(demo.rows, by_turns(dict(enumerate(demo.timers))).values(), strict=True):
        row["ns_per_step"], row["ns_spread"] = cost.ns_per_step, cost.spread
    demo.rows.extend(_as_printed(demo.samples[0]))
    return demo


def _one(demo: ThesisSamples, sample: Sample, scene: Scene, duration: float) -> None:
    """Build one kernel, run it in NumPy and in C, add its row, its files and its curve."""
    from tmm_gen.emit.c import emit_c
    from tmm_gen.emit.casadi import emit_casadi
    from tmm_gen.emit.numpy import emit_numpy
    from tmm_gen.native import compile_kernel
    from tmm_gen.program.build import build_program
    from tmm_gen.program.count import count_routine

    program = build_program(scene)
    numpy_files = emit_numpy(program, scene)
    folder = Path("kernels", scene.integrator.name, scene.name)
    files = {**numpy_files, **emit_c(program, scene), **emit_casadi(program, scene)}
    demo.kernels.update({folder / path: text for path, text in files.items()})
    module = import_package(numpy_files, scene.name)
    found = module.simulate(duration, LOAD)
    exact = exact_response(scene, _signals(), found.times)["tip"]
    tip = found.outputs["tip"]
    kernel = compile_kernel(program, scene)
    _, native = kernel.simulate(duration, LOAD)
    row = _figures(sample, scene.integrator.name, scene.integrator.step, found.times, tip, exact)
    row["c_against_numpy"] = largest_error(native["tip"], tip, sample.static)
    demo.timers.append(kernel.timer(LOAD))
    row["operations_per_station"] = count_routine(program.main).total / scene.stations
    demo.rows.append(row)
    coarse = module.simulate(duration, LOAD, step=THESIS_STEP)
    sample.curves[scene.integrator.name] = _curve(sample, coarse.times, coarse.outputs["tip"])


def _as_printed(sample: Sample) -> Iterator[dict[str, object]]:
    """Yield the proposed method as derived, and with the coefficients that the thesis prints."""
    from tmm_gen.thesis.errata import headline

    printed = headline(THESIS_STEP).printed.tip
    sample.curves["printed"] = _curve(sample, _instants(len(printed)), printed)
    for name, shown in (("zhou", "zhou"), ("printed", "zhou as printed")):
        curve = sample.curves[name]
        exact = curve.tip - curve.error * sample.static
        yield _figures(sample, shown, THESIS_STEP, curve.time, curve.tip, exact)


def _figures(
    sample: Sample, integrator: str, step: float, time: Array, tip: Array, exact: Array
) -> dict[str, Any]:
    figures = step_figures(time, tip, sample.static)
    return {
        "scene": sample.scene.name,
        "integrator": integrator,
        "step": step,
        "error": rms_error(tip, exact, sample.static),
        "peak": figures.peak,
        "exact_peak": float(np.max(sample.exact.tip)),
        "settling_time": figures.settling_time,
    }


def _curve(sample: Sample, time: Array, tip: Array) -> Curve:
    exact = exact_response(sample.scene, _signals(), time)["tip"]
    return Curve(time, tip, (tip - exact) / sample.static)


def _instants(count: int) -> Array:
    return np.arange(count, dtype=float) * THESIS_STEP


def _signals() -> dict[str, Constant]:
    return {name: Constant(value) for name, value in LOAD.items()}

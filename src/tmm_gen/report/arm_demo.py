"""An arm of two flexible beams lifts its payload: what each integrator's accuracy costs in C, and the motion itself."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from tmm_gen.inputs.waveforms import Smooth
from tmm_gen.native import NativeKernel, compile_kernel
from tmm_gen.native.timing import by_turns
from tmm_gen.package.texts import emit_package
from tmm_gen.program.build import build_program
from tmm_gen.reference.planar_reference import planar_response
from tmm_gen.resources import scenes_dir
from tmm_gen.scene import Scene, load_scene
from tmm_gen.simulate.run import simulate
from tmm_gen.simulate.simulation import Simulation

Array = NDArray[np.float64]

SCENE = "elbow"
TORQUES = {"shoulder_torque": Smooth(0.0, 0.085, 0.3), "elbow_torque": Smooth(0.0, 0.04, 0.5)}
"""N m of the motors themselves: enough to lift the payload."""

DURATION = 1.0
"""s."""

STEPS = {
    "newmark": (1e-2, 5e-3, 2e-3, 1e-3, 5e-4, 2e-4),
    "sdirk4": (4e-2, 2e-2, 1e-2, 5e-3, 2.5e-3),
    "radau3": (4e-2, 2e-2, 1e-2, 5e-3, 2.5e-3),
}
"""By integrator, s; all divide the instants at which errors are taken."""

INSTANTS = 25
"""At which the payload's place is compared, spread over the motion."""

_TOLERANCE = 1e-7
"""Of the reference, whose equations are written without the generator; a hundredth of it changes the twelfth digit."""


@dataclass(frozen=True)
class Point:
    """What one integrator does at one step.

    Parameters
    ----------
    integrator : str
        Name.
    step : float
        s.
    error : float
        Largest distance of the payload from its true place, mm.
    step_time : float
        Time of a step in compiled C, µs.
    time : float
        Time of a second of motion in compiled C, ms.
    """

    integrator: str
    step: float
    error: float
    step_time: float
    time: float

    @property
    def faster(self) -> float:
        """How many times faster than the arm itself."""
        return 1e3 / self.time


@dataclass(frozen=True, eq=False)
class ArmDemo:
    """Everything the demonstration shows.

    Parameters
    ----------
    scene : Scene
        The arm.
    simulation : Simulation
        Its motion, as the scene's own integrator finds it.
    points : list of Point
        By integrator, the longest step first.
    files : dict from path to str
        Generated package, by path inside the output folder.
    """

    scene: Scene
    simulation: Simulation
    points: list[Point]
    files: dict[Path, str]

    def times_for(self, error: float) -> dict[str, float]:
        """Return how long a second of motion takes each integrator with steps that err by so much.

        Between the steps tried, error and time follow a power of each other.

        Parameters
        ----------
        error : float
            mm.

        Returns
        -------
        dict from str to float
            ms, the least first; without integrators that were not tried both above and below that error.
        """
        found: dict[str, float] = {}
        for name in dict.fromkeys(point.integrator for point in self.points):
            own = sorted((p.error, p.time) for p in self.points if p.integrator == name)
            errors, times = np.log(np.array(own)).T
            if errors[0] <= np.log(error) <= errors[-1]:
                found[name] = float(np.exp(np.interp(np.log(error), errors, times)))
        return dict(sorted(found.items(), key=lambda item: item[1]))


def run_arm_demo(advance: Callable[[float, str], None]) -> ArmDemo:
    """Build, compile, run and time everything.

    Parameters
    ----------
    advance : callable
        Called with the number of kernels done and what comes next.

    Raises
    ------
    UserError
        If there is no C compiler.
    """
    scene = load_scene(scenes_dir() / f"{SCENE}.toml")
    advance(0, f"building {SCENE}")
    package = {Path("generated", SCENE, path): text for path, text in emit_package(scene).items()}
    kernels: dict[str, NativeKernel] = {}
    for method in STEPS:
        advance(1, f"compiling {SCENE} with {method}")
        chosen = scene.replace(**{"integrator.name": method})
        kernels[method] = compile_kernel(build_program(chosen), chosen)
    advance(1, "simulating")
    simulation = simulate(scene, TORQUES, DURATION, "c", trace=True)
    instants: Array = DURATION / INSTANTS * np.arange(1, INSTANTS + 1, dtype=float)
    found = planar_response(scene, TORQUES, instants, _TOLERANCE)
    truth = np.array([found[f"payload_{axis}"] for axis in "xy"])
    errors = {
        (method, step): 1e3 * float(np.max(np.linalg.norm(_places(kernel, step) - truth, axis=0)))
        for method, kernel in kernels.items()
        for step in STEPS[method]
    }
    advance(1, "measuring times")
    costs = by_turns({method: kernel.timer() for method, kernel in kernels.items()})
    points = [
        Point(method, step, error, 1e-3 * costs[method].ns_per_step, 1e-6 * costs[method].ns_per_step / step)
        for (method, step), error in errors.items()
    ]
    return ArmDemo(scene, simulation, points, package)


def _places(kernel: NativeKernel, step: float) -> Array:
    """Return where the payload is at the instants of comparison, (2, INSTANTS), m."""
    torques = {name: _called(torque) for name, torque in TORQUES.items()}
    _, outputs = kernel.simulate(DURATION, torques, step=step)
    every = round(DURATION / INSTANTS / step)
    return np.array([outputs[f"payload_{axis}"][every::every] for axis in "xy"])


def _called(torque: Smooth) -> Callable[[float], float]:
    return lambda time: float(torque.at(time))

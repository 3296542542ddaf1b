"""A run against the exact response, and against the same run in C."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.inputs.signals import Constant, Signal, Sine
from tmm_gen.native.python_module import numpy_module
from tmm_gen.reference.duration import default_duration
from tmm_gen.reference.reference import exact_response
from tmm_gen.scene import Input, Scene
from tmm_gen.scene.signal import PRESCRIBED
from tmm_gen.simulate.metrics import largest_error, rms_error
from tmm_gen.simulate.run import simulate
from tmm_gen.simulate.simulation import Simulation
from tmm_gen.verify.check_row import CheckRow
from tmm_gen.verify.lasting import broken_off, too_coarse
from tmm_gen.verify.spatial_order import swings, turned_alike
from tmm_gen.verify.unbroken import BREAKS, unless_broken

Array = NDArray[np.float64]

RUN = {"float64": 1e-9, "float32": 1e-3}
"""Relative difference allowed between backends over a whole run, in which differences add up."""

ERROR = 0.05
"""RMS error over a run, relative to the peak, beyond which a step is too coarse for its scene."""

_LONGEST_RUN = 2000
"""Steps of a run, unless one slow period takes fewer."""

_SWING = 2.0
"""rad/s of a prescribed base."""

OF_RUN = "error_against_exact"
"""The comparison whose cause says most where several have one."""


def unit_inputs(scene: Scene) -> dict[str, Signal]:
    """Return a constant 1 for every input, of motors at the joint; a prescribed base swings from there.

    What an arm in space can bear differs by decades from joint to joint: there, inputs are as large as it is heavy.
    """
    if scene.spatial is not None:
        return swings(scene.spatial)
    swing = Sine(1.0, _SWING, math.pi / 2.0)
    return {i.name: swing if i.acts in PRESCRIBED else Constant(_unit(scene, i)) for i in scene.inputs}


def _unit(scene: Scene, item: Input) -> float:
    drives = item.acts == "drive" and isinstance(item.at, int)
    return 1.0 / scene.joints[int(item.at) - 1].gear if drives else 1.0


def _at_base_angle(scene: Scene) -> Scene:
    """Return a scene whose links stand along a prescribed base at the start."""
    if not scene.prescribed:
        return scene
    return scene.replace(initial={"angles": 1.0, "rates": 0.0})


@dataclass(frozen=True, eq=False)
class WholeRun:
    """A run, to be compared with the exact response and with the same run in C."""

    scene: Scene
    loads: Mapping[str, Signal]
    duration: float
    module: ModuleType
    kernel: Any

    @classmethod
    def of(cls, scene: Scene, module: ModuleType, kernel: Any, loads: Mapping[str, Signal]) -> WholeRun:
        """Return the run of a scene; kernels are made anew where they start elsewhere by themselves."""
        duration = min(default_duration(scene) / 5, _LONGEST_RUN * scene.integrator.step)
        started = _at_base_angle(scene)
        if started is not scene:
            from tmm_gen.native import compile_kernel
            from tmm_gen.program.build import build_program

            program = build_program(started)
            module = numpy_module(started, program)
            kernel = compile_kernel(program, started) if kernel is not None else None
        return cls(started, {**unit_inputs(scene), **loads}, duration, module, kernel)

    @property
    def _told(self) -> str:
        if self.loads != unit_inputs(self.scene):
            return "the inputs given"
        return "sines as large as the arm is heavy" if self.scene.spatial is not None else "unit inputs"

    def rows(self) -> list[CheckRow]:
        """Return both comparisons; the first alone where there is nothing to compare C with."""
        try:
            found, exact, scale = self._compared(self.scene, self.loads)
        except BREAKS as error:
            why = broken_off(self.scene, error)
            return [CheckRow(OF_RUN, math.inf, ERROR, "the run broke off", why)]
        worst = max(exact, key=lambda name: rms_error(found.outputs[name], exact[name], scale[name]))
        apart = rms_error(found.outputs[worst], exact[worst], scale[worst])
        rows = [
            CheckRow(
                OF_RUN,
                apart,
                ERROR,
                f"RMS error of {worst} over {found.time[-1]:.3g} s under {self._told}, relative to its peak",
                "" if apart <= ERROR else too_coarse(self.scene),
            )
        ]
        if self.kernel is None:
            return rows
        check, bound = "c_run_against_numpy", RUN[self.scene.emit.real]
        return [
            *rows,
            unless_broken(self.scene, check, bound, lambda: self._native(check, bound, found, scale)),
        ]

    def scaled(self, factor: float) -> dict[str, Signal]:
        """Return the loads, forces and torques multiplied by a factor where they are constant."""
        angles = {item.name for item in self.scene.inputs if item.acts in PRESCRIBED}
        return {
            name: Constant(factor * signal.value)
            if isinstance(signal, Constant) and name not in angles
            else signal
            for name, signal in self.loads.items()
        }

    def holds(self, other: Scene, factor: float) -> bool:
        """Whether a run of the same duration with another step is near the exact response, loads being scaled."""
        scene = self.scene.replace(**{"integrator.step": other.integrator.step})
        try:
            found, exact, scale = self._compared(scene, self.scaled(factor))
        except BREAKS:
            return False
        return all(rms_error(found.outputs[name], exact[name], scale[name]) <= ERROR for name in exact)

    def _compared(
        self, scene: Scene, loads: Mapping[str, Signal]
    ) -> tuple[Simulation, dict[str, Array], dict[str, float]]:
        """Return a run, the exact outputs at its instants, and the peaks of these."""
        found = simulate(scene, loads, self.duration, kernel=self.module, judge=False, fixed=True)
        exact = exact_response(scene, loads, found.time)
        if scene.spatial is not None:
            exact = turned_alike(scene.spatial, exact, found.outputs)
        return found, exact, {name: float(np.max(np.abs(values))) or 1.0 for name, values in exact.items()}

    def _native(self, check: str, bound: float, found: Simulation, scale: Mapping[str, float]) -> CheckRow:
        native = simulate(
            self.scene, self.loads, self.duration, "c", kernel=self.kernel, judge=False, fixed=True
        )
        return CheckRow(
            check,
            max(largest_error(native.outputs[k], found.outputs[k], scale[k]) for k in scale),
            bound,
            f"largest difference over the same {found.steps} steps, relative to the peak",
        )

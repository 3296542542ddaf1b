"""The arm controllers are tried on: more links, another integrator, friction, delay, sensors that round and rustle."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.condition import Condition
from tmm_gen.control.prediction import fine_scene
from tmm_gen.control.problem import ControlProblem
from tmm_gen.native import NativeKernel, compile_kernel
from tmm_gen.program.build import build_program
from tmm_gen.scene import Scene

Array = NDArray[np.float64]

PLANT_LINKS = 20
PLANT_INTEGRATOR = "sdirk4"
PLANT_STEP = 1e-3
"""s; rounded down to a whole fraction of the sample time."""
SLIP = 5e-3
"""Rate at which Coulomb friction has reached 76 % of its value, rad/s."""

OUTPUTS = [
    {"name": "hub", "at": "base", "of": "angle"},
    {"name": "last", "at": "tip", "of": "angle"},
    {"name": "tip", "at": "tip", "of": "position"},
    {"name": "tip_acceleration", "at": "tip", "of": "acceleration"},
    {"name": "root", "at": "base", "of": "torque"},
]


def plant_scene(scene: Scene, condition: Condition) -> Scene:
    """Return the arm of a condition, finer than the scene's and integrated by another method."""
    gravity = (scene.model.gravity or 0.0) + condition.gravity
    changes: dict[str, object] = {
        "name": "plant",
        "output": OUTPUTS,
        "integrator.name": PLANT_INTEGRATOR,
        "integrator.step": PLANT_STEP,
        "control": None,
        "emit": {"backends": ["c"]},
    }
    if gravity:
        changes["model.gravity"] = gravity
    return fine_scene(scene.replace(**changes), PLANT_LINKS)


@cache
def plant_kernel(scene: Scene) -> NativeKernel:
    """Return the compiled kernel of a plant's scene; one for all its plants."""
    return compile_kernel(build_program(scene), scene)


class Plant:
    """An arm in motion, sampled.

    Parameters
    ----------
    scene : Scene
        What the user described.
    problem : ControlProblem
        Sample time, sensors, delay.
    condition : Condition
        In what the arm differs from it.
    seed : int
        Of the sensors' noise.

    Attributes
    ----------
    states : list of dict
        The kernel's state at the start of each sample so far.
    """

    def __init__(self, scene: Scene, problem: ControlProblem, condition: Condition, seed: int = 0) -> None:
        self.scene = plant_scene(scene, condition)
        self.problem, self.condition = problem, condition
        self.kernel = plant_kernel(self.scene)
        self.substeps = max(1, int(np.ceil(problem.sample_time / PLANT_STEP - 1e-9)))
        self.step = problem.sample_time / self.substeps
        self.states: list[dict[str, Any]] = []
        self._late = round((problem.delay + condition.delay) / self.step)
        self._random = np.random.default_rng(seed)
        self._torques = [0.0] * self._late
        self._gravity = self.scene.model.gravity or 0.0
        # a sample's steps in one call of C: that is most of the time a closed loop takes
        types = self.kernel.types
        self._inputs = (types["inputs"] * self.substeps)()
        self._outputs = (types["outputs"] * self.substeps)()
        field: Any = getattr(types["inputs"], problem.input_name)
        first, last = field.offset // 8, (field.offset + field.size) // 8
        self._driven = _numbers(self._inputs)[:, first:last]
        names = [variable.name for variable in self.kernel.program.outputs]
        seen = _numbers(self._outputs)
        self._seen = [seen[:, names.index(name)] for name in ("tip_x", "tip_y", "hub")]
        self._start()

    def _start(self) -> None:
        defaults = {v.name: v.default for v in self.kernel.program.parameters}
        changes = {}
        if self.condition.payload != 1.0 and "tip_mass" in defaults:
            changes["tip_mass"] = np.multiply(self.condition.payload, np.asarray(defaults["tip_mass"], float))
        if self.condition.stiffness != 1.0:
            for name in ("stiffness", "damping"):
                if name in defaults:
                    changes[name] = np.multiply(self.condition.stiffness, np.asarray(defaults[name], float))
        self.kernel.prepare(changes, self.step)
        self.kernel.initialise()

    def restart(self, bend: Array, rate: float) -> None:
        """Start anew, bent and moving.

        Parameters
        ----------
        bend : array, (k,)
            Angles of the links from base to tip, at k places spread evenly over them, rad.
        rate : float
            Of all links, rad/s.
        """
        count = self.scene.stations
        angles = np.interp(np.linspace(0.0, 1.0, count), np.linspace(0.0, 1.0, len(bend)), bend)
        self.kernel.initialise(initial_angle=angles, initial_rate=np.full(count, rate))

    def measured(self) -> Array:
        """Return what the sensors show, (3,): NaN where there is none."""
        sensors, noise, out = self.problem.sensors, self.condition.noise, self.kernel.output()
        count = 2.0 * np.pi / sensors.encoder
        angle = out["last"]
        across = -out["tip_acceleration_x"] * np.sin(angle)
        across += (out["tip_acceleration_y"] + self._gravity) * np.cos(angle)
        shown = np.array([np.round(out["hub"] / count) * count, np.nan, np.nan])
        rustle = noise * self._random.standard_normal(2)
        if sensors.accelerometer is not None:
            shown[1] = across + sensors.accelerometer * rustle[0]
        if sensors.strain is not None:
            shown[2] = out["root"] + sensors.strain * rustle[1]
        return shown

    def advance(self, torque: float) -> Array:
        """Let a sample pass under a torque chosen now.

        Parameters
        ----------
        torque : float
            N m; acts after the delay.

        Returns
        -------
        array, (substeps, 2)
            Polar angle of the tip and hub angle after each step, rad.
        """
        self.states.append(self.kernel.state)
        self._torques += [torque] * self.substeps
        acting, self._torques = self._torques[: self.substeps], self._torques[self.substeps :]
        if self.condition.friction:
            return np.array([self._rubbed(each) for each in acting])
        self._driven[:] = np.array(acting)[:, None]  # one number for each of a step's stages
        self.kernel.run(self._inputs, self._outputs)
        across, up, hub = self._seen
        return np.column_stack([np.arctan2(up, across), hub])

    def _rubbed(self, torque: float) -> Array:
        """Take one step under a torque, less friction; return the angles after it."""
        rate = self.kernel.state["hub_rate"]
        rubbing = self.condition.friction * float(np.tanh(rate / SLIP))
        self.kernel.step({self.problem.input_name: torque - rubbing})
        return self.angles()

    def angles(self) -> Array:
        """Return polar angle of the tip and hub angle, (2,), rad."""
        out = self.kernel.output()
        return np.array([np.arctan2(out["tip_y"], out["tip_x"]), out["hub"]])


def _numbers(structs: Any) -> Array:
    """Return the numbers of an array of structs as a view of its memory, a row for each."""
    return np.frombuffer(structs).reshape(len(structs), -1)

"""The arm controllers are tried on: more links, another integrator, friction, delay, sensors that round and rustle."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.arm.arms import arm_of
from tmm_gen.control.arm.motors import motors_of
from tmm_gen.control.arm.payload_body import beside_payload
from tmm_gen.control.condition import Condition
from tmm_gen.control.goals.target import rest_with
from tmm_gen.control.plant.plant_scene import plant_scene, steps_of_a_sample
from tmm_gen.control.sensors.sensing import Sensing, sites_of
from tmm_gen.control.task.problem import ControlProblem
from tmm_gen.native import NativeKernel, compile_kernel
from tmm_gen.program.build import build_program
from tmm_gen.scene import Scene

Array = NDArray[np.float64]

SLIP = 5e-3
"""Rate of a hub at which Coulomb friction has reached 76 % of its value, rad/s."""


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
    payloads : dict from str to float
        Masses that are the payload, kg, by their keys in the scene.
    states : list of dict
        The kernel's state at the start of each sample so far.
    """

    def __init__(self, scene: Scene, problem: ControlProblem, condition: Condition, seed: int = 0) -> None:
        self.scene = plant_scene(scene, condition)
        self.problem, self.condition = problem, condition
        self.motors = motors_of(self.scene)
        self.payloads = arm_of(scene).payloads()  # of the user's scene, which says which body it is
        self._others = beside_payload(scene)
        self.kernel = plant_kernel(self.scene)
        self.substeps = steps_of_a_sample(problem)
        self.step = problem.sample_time / self.substeps
        self.states: list[dict[str, Any]] = []
        self._late = round((problem.delay + condition.delay) / self.step)
        self._random = np.random.default_rng(seed)
        self._gravity = self.scene.model.gravity or 0.0
        # a sample's steps in one call of C: that is most of the time a closed loop takes
        types = self.kernel.types
        self._inputs = (types["inputs"] * self.substeps)()
        self._outputs = (types["outputs"] * self.substeps)()
        numbers = _numbers(self._inputs)
        fields: list[Any] = [getattr(types["inputs"], name) for name in self.motors.inputs]
        self._driven = [numbers[:, each.offset // 8 : (each.offset + each.size) // 8] for each in fields]
        self._names = [variable.name for variable in self.kernel.program.outputs]
        self._seen = _numbers(self._outputs)
        self.goal, torque = self._start()
        self._torques = [torque] * self._late
        if not self.motors.on_hub:
            sites = sites_of(scene, motors_of(scene), problem)
            self._sensing = Sensing.of(self.scene, self.motors, problem, sites)

    def _start(self) -> tuple[Array, Array]:
        """Set the arm where it starts; return polar angles of tips to reach, and the torques that act at first."""
        defaults = {v.name: v.default for v in self.kernel.program.parameters}
        changes = {}
        if self.condition.payload != 1.0 and "tip_mass" in defaults:
            changes["tip_mass"] = self._laden(np.asarray(defaults["tip_mass"], float))
        if self.condition.stiffness != 1.0:
            for name in ("stiffness", "damping"):
                if name in defaults:
                    changes[name] = np.multiply(self.condition.stiffness, np.asarray(defaults[name], float))
        self.kernel.prepare(changes, self.step)
        if self.motors.on_hub:
            self.kernel.initialise()
            return self.problem.reference, np.zeros(self.motors.count)
        # held at rest by its motors; what is to be reached is where it rests with its joints at the reference
        arm = self._as_it_is()
        target = rest_with(arm, self.problem.reference, "control.reference")
        start = rest_with(arm, self.problem.start, "initial.angles")
        self.kernel.initialise(initial_angle=start.angles, inputs=self.motors.torques(start.goal.torque))
        goal = []
        for motor in self.motors.each:
            carried = slice(motor.place, motor.end)
            lengths, angles = self.motors.lengths[carried], target.angles[carried]
            chord = np.arctan2(lengths @ np.sin(angles), lengths @ np.cos(angles))
            goal.append(chord - (target.angles[motor.host] if motor.host >= 0 else 0.0))
        return np.array(goal), start.goal.torque

    def _as_it_is(self) -> Scene:
        """Return the scene of the arm under its condition, for its rest."""
        stiff, tip = self.condition.stiffness, self.scene.tip
        joints = [
            joint.model_copy(update={"stiffness": stiff * joint.stiffness}) for joint in self.scene.joints
        ]
        loaded = tip and tip.model_copy(update={"mass": float(self._laden(tip.mass))})
        return replace(self.scene, joints=tuple(joints), tip=loaded)

    def _laden(self, mass: Array | float) -> Array:
        """Return the mass at the tip of an arm in a plane under its condition, kg."""
        return np.asarray(self.condition.payload * (mass - self._others) + self._others, float)

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
        """Return what the sensors show, (3 m,): NaN where there is none."""
        motors, step = self.motors, 2.0 * np.pi / self.problem.encoders
        state, out = self.kernel.state, self.kernel.output()
        # before a gear that gives way, where motors have their encoders
        hubs = self._hubs(out) if motors.on_hub else motors.hub @ state["angle"]
        behind = self._felt(out) if motors.on_hub else self._sensing.values(*self._motion(state))
        rustle = self.condition.noise * self._random.standard_normal(2 * motors.count)
        # NaN as noise where there is no such sensor
        spreads = np.concatenate([self.problem.accelerometers, self.problem.gauges])
        return np.concatenate([np.round(hubs / step) * step, behind + spreads * rustle])

    def _felt(self, out: Mapping[str, Any]) -> Array:
        """Return what accelerometer and strain gauge of an arm on a hub show without noise."""
        angle = out["last"]
        across = -out["tip_acceleration_x"] * np.sin(angle)
        across += (out["tip_acceleration_y"] + self._gravity) * np.cos(angle)
        return np.array([across, out["root"]])

    @staticmethod
    def _motion(state: Mapping[str, Any]) -> tuple[Array, Array, Array]:
        return state["angle"], state["rate"], state["acceleration"]

    def advance(self, torque: Array) -> Array:
        """Let a sample pass under torques chosen now.

        Parameters
        ----------
        torque : array, (m,)
            N m; act after the delay.

        Returns
        -------
        array, (substeps, 2 m)
            Polar angles of the tips against what carries their motors, then hub angles, after each step, rad.
        """
        acting = self._acting(torque)
        if self.condition.friction:
            return np.array([self._rubbed(each) for each in acting])
        self._drive(acting)
        self.kernel.run(self._inputs, self._outputs)
        return self._angles(dict(zip(self._names, self._seen.T, strict=True)))

    def _acting(self, torque: Array) -> list[Array]:
        """Begin a sample in which torques are chosen; return those that act in its steps."""
        self.states.append(self.kernel.state)
        self._torques += [torque] * self.substeps
        acting, self._torques = self._torques[: self.substeps], self._torques[self.substeps :]
        return acting

    def _drive(self, acting: list[Array]) -> None:
        """Write down what acts in the steps of a sample."""
        for driven, each in zip(self._driven, np.array(acting).T, strict=True):
            driven[:] = each[:, None]  # one number for each of a step's stages

    def _rubbed(self, torque: Array) -> Array:
        """Take one step under torques, less friction; return the angles after it."""
        state = self.kernel.state
        rates = np.array([*([state["hub_rate"]] if self.scene.hub else []), *state["rate"]])
        rubbing = self.condition.friction * np.tanh(self.motors.hub @ rates / SLIP) / self.motors.gears
        self.kernel.step(self.motors.torques(torque - rubbing))
        return self.angles()

    def angles(self) -> Array:
        """Return polar angles of the tips and hub angles, (2 m,), rad."""
        return self._angles(self.kernel.output())

    def _hubs(self, out: Mapping[str, Any]) -> Array:
        names = ["hub"] if self.motors.on_hub else [f"hub_{name}" for name in self.motors.names]
        return np.array([out[name] for name in names])

    def _angles(self, out: Mapping[str, Any]) -> Array:
        """Return polar angles of the tips and hub angles, (2 m,) or (steps, 2 m), of numbers or arrays by name."""
        tips = []
        for name in self.motors.names:
            tip, root = ("tip", "") if self.motors.on_hub else (f"tip_{name}", f"root_{name}")
            across, up = (out[f"{tip}_{axis}"] - out.get(f"{root}_{axis}", 0.0) for axis in "xy")
            tips.append(np.arctan2(up, across) - out.get(f"turned_{name}", 0.0))
        return np.array([*tips, *self._hubs(out)]).T


def _numbers(structs: Any) -> Array:
    """Return the numbers of an array of structs as a view of its memory, a row for each."""
    return np.frombuffer(structs).reshape(len(structs), -1)

"""The arm in space that controllers are tried on: more cells, another integrator, delay, encoders that round."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.closed_loop.plant import Plant
from tmm_gen.control.arm.space_motors import space_motors
from tmm_gen.control.condition import Condition
from tmm_gen.control.goals.target import rest_with
from tmm_gen.control.task.problem import ControlProblem
from tmm_gen.derive.integrators.registry import integrator
from tmm_gen.program.space.layout import layout_of
from tmm_gen.scene import Scene

Array = NDArray[np.float64]


class SpacePlant(Plant):
    """An arm in space in motion, sampled; see :class:`~tmm_gen.closed_loop.plant.Plant`.

    Tips are what controllers take for them, of the arm as it is (:mod:`tmm_gen.control.arm.space_motors`).

    Attributes
    ----------
    resting : array, (d,)
        Angles of the joints where it rests with its hubs at the reference, rad.
    """

    resting: Array

    def __init__(self, scene: Scene, problem: ControlProblem, condition: Condition, seed: int = 0) -> None:
        super().__init__(scene, problem, condition, seed)
        kind = self.kernel.types["state"]
        angle = kind.angle
        shared: Any = (kind * self.substeps)()
        self._reached = shared
        numbers = np.frombuffer(shared).reshape(self.substeps, -1)
        self._reached_angles = numbers[:, angle.offset // 8 : (angle.offset + angle.size) // 8]

    def _start(self) -> tuple[Array, Array]:
        """Set the arm where it starts; return angles of tips to reach, and the torques that act at first."""
        self.motors = space_motors(self.scene, self.problem.reference)
        arm = self._as_it_is()
        self.kernel.prepare(self._changes(arm), self.step)
        target = rest_with(arm, self.problem.reference, "control.reference")
        self.resting = target.angles
        start = rest_with(arm, self.problem.start, "initial.angles")
        self.kernel.initialise(initial_angle=start.angles, inputs=self.motors.torques(start.goal.torque))
        return self.motors.tip @ target.angles, start.goal.torque

    def _as_it_is(self) -> Scene:
        """Return the scene of the arm under its condition."""
        scene, stiff, payload = self.scene, self.condition.stiffness, self.condition.payload
        if payload != 1.0:
            scene = scene.replace(**{key: payload * mass for key, mass in self.payloads.items()})
        assert scene.spatial is not None
        joints = tuple(
            replace(joint, stiffness=stiff * joint.stiffness, damping=stiff * joint.damping)
            if joint.stiffness
            else joint
            for joint in scene.spatial.joints
        )
        return replace(scene, spatial=replace(scene.spatial, joints=joints))

    def _changes(self, arm: Scene) -> dict[str, float | tuple[float, ...]]:
        """Return the kernel's parameters that are other than its defaults, of the arm under its condition."""
        assert arm.spatial is not None
        method = integrator(arm.integrator.name, **arm.integrator.parameters)
        layout = layout_of(arm.spatial, arm.name, arm.title, method, self.step)
        defaults = {variable.name: variable.default for variable in self.kernel.program.parameters}
        found = ((name, variable.default) for name, variable in layout.parameters.items())
        return {
            name: value
            for name, value in found
            if value is not None and name in defaults and value != defaults[name]
        }

    def advance(self, torque: Array) -> Array:
        """Let a sample pass under torques chosen now; return the angles after each step, (substeps, 2 m), rad."""
        acting = self._acting(torque)
        if self.condition.friction:
            return np.array([self._rubbed(each) for each in acting])
        self._drive(acting)
        _, status = self.kernel.record(self._inputs, self._outputs, self._reached)
        self.kernel.raise_for(status)
        return self._angles_of(self._reached_angles)

    def angles(self) -> Array:
        """Return angles of tips and hubs, (2 m,), rad."""
        return self._angles_of(self.kernel.state["angle"])

    def _angles_of(self, joints: Array) -> Array:
        """Return angles of tips and hubs, (..., 2 m), of all joints, (..., d), rad."""
        return np.concatenate([joints @ self.motors.tip.T, joints @ self.motors.hub.T], axis=-1)


def plant_of(scene: Scene, problem: ControlProblem, condition: Condition, seed: int = 0) -> Plant:
    """Return the arm of a scene that controllers are tried on; see :class:`~tmm_gen.closed_loop.plant.Plant`."""
    kind = Plant if scene.spatial is None else SpacePlant
    return kind(scene, problem, condition, seed)

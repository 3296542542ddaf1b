"""What several controllers of a scene share: models are derived and linearised once."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.arm.arms import arm_of
from tmm_gen.control.arm.motors import motors_of
from tmm_gen.control.condition import Condition
from tmm_gen.control.goals.course import Course, course_of
from tmm_gen.control.prediction.linear import LinearModel
from tmm_gen.control.prediction.links import links_model
from tmm_gen.control.prediction.modes import modes_model
from tmm_gen.control.prediction.prediction import prediction_scene
from tmm_gen.control.prediction.step_model import StepModel
from tmm_gen.control.task.problem import ControlProblem, control_problem
from tmm_gen.scene import Scene

Array = NDArray[np.float64]

_MODELS = ("step", "links", "modes", "inertia", "course")


@dataclass(frozen=True, eq=False)
class Bench:
    """A scene's control problem and its models.

    Parameters
    ----------
    scene : Scene
        With ``[control]``.
    problem : ControlProblem
        Of the scene, perhaps with other weights.
    """

    scene: Scene
    problem: ControlProblem

    @classmethod
    def of(cls, scene: Scene) -> Bench:
        """Return the bench of a scene.

        Raises
        ------
        UserError
            If it has no ``[control]``.
        """
        return cls(scene, control_problem(scene))

    def told(self, condition: Condition) -> Bench:
        """Return the bench of those who know a condition's gravity and delay, which are no secrets."""
        scene = self.scene
        if condition.gravity:
            scene = scene.replace(**{"model.gravity": arm_of(scene).falling(condition.gravity)})
        if scene is self.scene and not condition.delay:
            return self
        return Bench(scene, replace(self.problem, delay=self.problem.delay + condition.delay))

    def retuned(self, scene: Scene) -> Bench:
        """Return the bench of the same arm with other weights, estimator, baselines or payload to reckon with.

        Models there are already are shared, unless they reckon with another payload.
        """
        payloads = {
            (each.control.payload, each.control.payload_body) if each.control else (1.0, None)
            for each in (self.scene, scene)
        }
        return self._sharing(scene, control_problem(scene)) if len(payloads) == 1 else Bench.of(scene)

    def with_problem(self, problem: ControlProblem) -> Bench:
        """Return the bench with another problem of the same sample time, horizon, substeps, delay and reference.

        Models are made here, once for all.
        """
        for name in _MODELS:
            getattr(self, name)
        return self._sharing(self.scene, problem)

    def _sharing(self, scene: Scene, problem: ControlProblem) -> Bench:
        """Return a bench with the models that have been made here."""
        other = Bench(scene, problem)
        for name in _MODELS:
            if name in self.__dict__:
                model = self.__dict__[name]
                other.__dict__[name] = model.with_problem(problem) if isinstance(model, StepModel) else model
        return other

    @property
    def follows(self) -> bool:
        """Whether a trajectory is to be followed."""
        return self.scene.control is not None and self.scene.control.trajectory is not None

    @property
    def assumed(self) -> Scene:
        """The scene controllers reckon with: with the payload of ``[control]``."""
        scene = self.scene
        if scene.control is None or scene.control.payload == 1.0:
            return scene
        factor = scene.control.payload
        return scene.replace(**{key: factor * mass for key, mass in arm_of(scene).payloads().items()})

    @cached_property
    def step(self) -> StepModel:
        """The generated step, calibrated on the first frequency."""
        return StepModel(prediction_scene(self.assumed), self.problem)

    @cached_property
    def links(self) -> LinearModel:
        """The generated step, linearised."""
        return links_model(self.step)

    @cached_property
    def modes(self) -> LinearModel:
        """First modes of the fine arm."""
        return modes_model(self.assumed, self.problem)

    @cached_property
    def course(self) -> Course | None:
        """What is to be followed, sample by sample; None where there is a reference alone."""
        return course_of(self.assumed, self.problem)

    @cached_property
    def inertia(self) -> Array:
        """What each motor turns, (m,), by its own torque, kg m^2: the arm as its scene starts, straight on a hub."""
        return motors_of(self.assumed).inertia(arm_of(self.assumed).mass())

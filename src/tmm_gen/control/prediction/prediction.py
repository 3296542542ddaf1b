"""The scenes behind a control problem: the model a controller predicts with, and a finer arm."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.arm.motors import motors_of
from tmm_gen.control.prediction.stepped_frequency import model_frequency
from tmm_gen.errors import UserError
from tmm_gen.scene import Scene
from tmm_gen.scene.beam import beam_links
from tmm_gen.scene.station import Link

Array = NDArray[np.float64]

FINE_LINKS = 40
"""Links of the arm whose modes a prediction by modes takes."""

SENSORS = [
    {"name": "hub", "at": "base", "of": "angle"},
    {"name": "tip_acceleration", "at": "tip", "of": "acceleration"},
    {"name": "root", "at": "base", "of": "torque"},
]
"""Outputs of every kernel that predicts an arm on a hub."""


def prediction_scene(scene: Scene, calibrate: bool = True) -> Scene:
    """Return the scene a controller predicts with: kernel step, sensors as outputs, first frequencies set right.

    A beam cut into few links vibrates too slowly, and a long step slows it down further. The spring at the hub and
    the others are scaled, each by a factor, so that the first two natural frequencies of the straight arm on its
    free hub are those of the continuous beam *when stepped*. Damping stays proportional to stiffness.
    A step with corrections has no exact derivatives: predictions sweep alone. Neither is done in space.

    Parameters
    ----------
    scene : Scene
        With ``[control]``.
    calibrate : bool
        Whether to set frequencies right.

    Raises
    ------
    UserError
        If the scene's integrator solves all its stages at once.
    """
    control = scene.control
    assert control is not None
    if scene.coupled:
        raise UserError(
            f"scene '{scene.name}': a controller predicts with exact derivatives of a step, which are not derived yet "
            f"where all stages are solved at once ('{scene.integrator.name}'); use an integrator such as 'newmark'"
        )
    step = control.sample_time / control.substeps
    outputs = (
        SENSORS
        if scene.base.turns
        else [{"name": f"{name}_angle", "at": name, "of": "angle"} for name in motors_of(scene).names]
    )
    changes: dict[str, object] = {"output": outputs, "integrator.step": step}
    changes["emit.compensated"] = False  # derivatives are not
    if scene.spatial is not None:
        # CasADi differentiates a step as it is, corrections and all
        return scene.replace(**changes)
    changes |= {
        "emit.sensitivities": True,
        "emit.trigonometry": None,
        "emit.batch": None,
    }  # by the library's sines
    changes["model.corrections"] = None
    if calibrate and scene.beam is not None:
        first, others = spring_factors(scene, step)
        joints, more = scene.joints, scene.stations - 1
        changes["beam"] = None
        changes["joint"] = [_scaled(joints[0], first)]
        if more:
            changes["joint"] = [_scaled(joints[0], first), *(_scaled(joint, others) for joint in joints[1:])]
        changes["link"] = [
            {"mass": link.mass, "length": link.length, "inertia": link.inertia} for link in scene.links
        ]
    return scene.replace(**changes)


def _scaled(joint: object, factor: float) -> dict[str, float]:
    return {key: factor * float(getattr(joint, key)) for key in ("stiffness", "damping")}


def spring_factors(scene: Scene, step: float) -> tuple[float, float]:
    """Return by what to multiply the first spring and the others; see :func:`prediction_scene`.

    Parameters
    ----------
    scene : Scene
        With a beam, on a motor.
    step : float
        Of the integrator, s.
    """
    from scipy.linalg import eigvalsh
    from scipy.optimize import least_squares

    from tmm_gen.modal.arm import linear_arm
    from tmm_gen.modal.beam import natural_frequencies
    from tmm_gen.modal.discretised import continuous
    from tmm_gen.modal.matrices import matrices

    beam = continuous(scene)
    assert beam is not None
    count = min(2, scene.stations)
    exact = natural_frequencies(beam, count + 1)[1:]
    goal = np.array([model_frequency(scene.integrator, step, float(each)) for each in exact])
    mass = matrices(linear_arm(scene)).mass
    twist = np.eye(scene.stations, scene.stations + 1, k=1) - np.eye(scene.stations, scene.stations + 1)
    springs = [joint.stiffness * np.outer(row, row) for joint, row in zip(scene.joints, twist, strict=True)]
    root, beyond = springs[0], np.sum(springs[1:], axis=0) if count > 1 else np.zeros_like(mass)

    def off(logarithms: Array) -> Array:
        first, others = np.exp(logarithms[0]), np.exp(logarithms[-1])
        squares = eigvalsh(first * root + others * beyond, mass)
        return np.asarray(np.sqrt(np.maximum(squares[1 : count + 1], 0.0)) / goal - 1.0, float)

    found = least_squares(off, np.zeros(count), xtol=1e-14, ftol=1e-14, gtol=1e-14)
    return float(np.exp(found.x[0])), float(np.exp(found.x[-1]))


def fine_scene(scene: Scene, links: int = FINE_LINKS) -> Scene:
    """Return the scene with its beams cut into at least so many links together; a scene without beam as it is."""
    if scene.beam is None:
        entries: Any = scene.source.data.get("beam", [])
        own = {entry["name"]: entry.get("links", 0) for entry in entries}
        beams = list(own)
        if not beams:
            return scene
        each = -(-links // len(beams))
        return scene.replace(**{f"beam.{name}.links": max(own[name], each) for name in beams})
    if scene.beam.links >= links:
        return scene
    changes: dict[str, object] = {"beam.links": links}
    for key in ("angles", "rates"):
        values = getattr(scene.initial, key)
        if any(value != values[0] for value in values):
            finer = beam_links(scene.beam.model_copy(update={"links": links}))
            changes[f"initial.{key}"] = np.interp(_middles(finer), _middles(scene.links), values).tolist()
    return scene.replace(**changes)


def _middles(links: Sequence[Link]) -> Array:
    """Return the places of the middles of links along a straight arm, (n,), m."""
    lengths = np.array([link.length for link in links])
    return np.cumsum(lengths) - lengths / 2.0

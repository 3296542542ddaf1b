"""Scenes: what a user says about an arm, read from TOML and checked.

>>> from tmm_gen.scene import load_scene
>>> scene = load_scene("scenes/thesis2.toml")  # doctest: +SKIP
"""

from __future__ import annotations

from tmm_gen.scene.beam import Beam, Tip
from tmm_gen.scene.emit import Budget, Emit
from tmm_gen.scene.initial import Initial
from tmm_gen.scene.integrator import INTEGRATOR_NAMES, METHODS, Integrator
from tmm_gen.scene.load import load_scene, parse_scene, scene_from
from tmm_gen.scene.model import Base, Model
from tmm_gen.scene.problem import Problem, SceneError
from tmm_gen.scene.scene import Scene
from tmm_gen.scene.signal import Input, Output, station_of
from tmm_gen.scene.station import Joint, Link

__all__ = [
    "INTEGRATOR_NAMES",
    "METHODS",
    "Base",
    "Beam",
    "Budget",
    "Emit",
    "Initial",
    "Input",
    "Integrator",
    "Joint",
    "Link",
    "Model",
    "Output",
    "Problem",
    "Scene",
    "SceneError",
    "Tip",
    "load_scene",
    "parse_scene",
    "scene_from",
    "station_of",
]

"""MuJoCo models."""

from __future__ import annotations

from tmm_gen.export.mjcf.model import KEYFRAME, MujocoModel, mujoco_model

__all__ = ["KEYFRAME", "MujocoModel", "mujoco_model"]

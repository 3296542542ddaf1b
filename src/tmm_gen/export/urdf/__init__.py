"""URDF models."""

from __future__ import annotations

from tmm_gen.export.urdf.model import UrdfModel, urdf_model

__all__ = ["UrdfModel", "urdf_model"]

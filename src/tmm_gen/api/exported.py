"""The same arm for other tools, by the ending of a file."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from tmm_gen.api.picture import target_of
from tmm_gen.errors import UserError
from tmm_gen.export.fmu import fmu
from tmm_gen.export.mjcf import mujoco_model
from tmm_gen.export.urdf import urdf_model
from tmm_gen.files import write_whole
from tmm_gen.scene import Scene

__all__ = ["Exported", "exported"]

_VERSIONS = (2, 3)


@dataclass(frozen=True)
class Exported:
    """A file for another tool.

    Parameters
    ----------
    file : Path
        Where it is.
    left_out : tuple of str
        What of the arm the tool cannot have, in sentences.
    """

    file: Path
    left_out: tuple[str, ...] = ()


def exported(scene: Scene, file: object, fmi: object, cc: str) -> Exported:
    """Write a scene for another tool; arguments as of :meth:`tmm_gen.Arm.export`."""
    target = target_of(file, (".fmu", ".xml", ".urdf"))
    if target.suffix.lower() == ".fmu":
        version = next((each for each in _VERSIONS if each == fmi), None)
        if version is None:
            raise UserError(f"fmi: must be 2 or 3, not {fmi!r}.")
        write_whole(target, fmu(scene, 3 if version == 3 else 2, cc))
        return Exported(target)
    model = mujoco_model(scene) if target.suffix.lower() == ".xml" else urdf_model(scene)
    write_whole(target, model.text)
    return Exported(target, model.left_out)

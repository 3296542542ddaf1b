"""The way that a CSV file tells: joint angles, or where a part is to be and how it is to stand, sample by sample."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.goals.reach import Somewhere
from tmm_gen.control.task.problem import ControlProblem
from tmm_gen.control.task.sample_count import require_countable
from tmm_gen.control.task.where import where
from tmm_gen.errors import UserError
from tmm_gen.inputs.curve import through
from tmm_gen.inputs.given import read_tables
from tmm_gen.inputs.signals import Table
from tmm_gen.scene import Scene
from tmm_gen.scene.trajectory import Trajectory

Array = NDArray[np.float64]

_SPACE = ("_qw", "_qx", "_qy", "_qz")


@dataclass(frozen=True, eq=False)
class FileWay:
    """What a file tells.

    Parameters
    ----------
    instants : array, (k,)
        Of all samples from time zero to its last row, s.
    told : array, (k, c)
        Joint angles, rad; or of a part its position, m, and if asked for its angle, rad, or in space its quaternion.
    frame : str or None
        Name of that part.
    axes : int
        How many of the columns are its position.
    """

    instants: Array
    told: Array
    frame: str | None
    axes: int

    def places(self) -> Iterator[Somewhere]:
        """Yield where the part is to be at each sample."""
        assert self.frame is not None
        for position, facing in zip(self.told[:, : self.axes], self.told[:, self.axes :], strict=True):
            yield Somewhere(self.frame, position, facing if facing.size else None)


def file_way(scene: Scene, problem: ControlProblem, way: Trajectory, path: Path) -> FileWay:
    """Read the file of a scene's trajectory; cubic between its rows, and after the last it stays.

    Raises
    ------
    UserError
        If it cannot be read, takes too many samples, or has a quaternion of zeros.
    """
    plane = scene.spatial is None
    axes = "xy" if plane else "xyz"
    names = problem.motors.names if way.frame is None else tuple(f"{way.frame}_{axis}" for axis in axes)
    if way.orientation:
        names += tuple(f"{way.frame}{part}" for part in (("_angle",) if plane else _SPACE))
    read = read_tables(path, names, what=f"{where(scene, 'control.trajectory.file')}: ").values()
    tables = [table for table in read if isinstance(table, Table)]
    if way.orientation:
        tables[len(axes) :] = _steady(tables[len(axes) :], path)
    last = float(tables[0].times[-1])
    require_countable(scene, last, problem.sample_time)
    count = int(np.ceil(last / problem.sample_time - 1e-9)) + 1
    instants = problem.sample_time * np.arange(count, dtype=float)
    told = np.column_stack([through(table).at(np.minimum(instants, last)) for table in tables])
    return FileWay(instants, told, way.frame, len(axes))


def _steady(tables: list[Table], path: Path) -> list[Table]:
    """Return columns of an orientation without jumps of what is one orientation: whole turns, signs of quaternions."""
    if len(tables) == 1:
        (angle,) = tables
        return [replace(angle, values=np.unwrap(angle.values))]
    rows = np.column_stack([table.values for table in tables])
    lengths = np.linalg.norm(rows, axis=1)
    if not np.all(lengths):
        at = int(np.argmin(lengths))
        raise UserError(
            f"{path}:{tables[0].lines[at]}: the quaternion of zeros is no orientation. Write for example "
            "1,0,0,0 for one that is not turned."
        )
    rows /= lengths[:, None]
    turned_over = np.einsum("ij,ij->i", rows[1:], rows[:-1]) < 0.0
    rows[1:] *= np.cumprod(np.where(turned_over, -1.0, 1.0))[:, None]
    return [replace(table, values=values) for table, values in zip(tables, rows.T, strict=True)]

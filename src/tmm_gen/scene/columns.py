"""Outputs as columns: one for each number a scene reports, vectors taken apart."""

from __future__ import annotations

from dataclasses import dataclass

from tmm_gen.scene.quantity import Quantity
from tmm_gen.scene.scene import Scene
from tmm_gen.scene.signal import Output


@dataclass(frozen=True)
class OutputColumn:
    """One number of an output.

    Parameters
    ----------
    name : str
        That of the output, with ``_x`` or ``_y`` for a vector: as in CSV files and generated kernels.
    quantity : Quantity
        What it is, with its unit.
    what : str
        In words.
    """

    name: str
    quantity: Quantity
    what: str

    @property
    def unit(self) -> str:
        """SI."""
        return self.quantity.unit


def output_columns(scene: Scene) -> tuple[OutputColumn, ...]:
    """Return the columns of a scene's outputs, in its order."""
    return tuple(column for output in scene.outputs for column in columns_of(scene, output))


def columns_of(scene: Scene, output: Output) -> tuple[OutputColumn, ...]:
    """Return the columns of one output."""
    quantity = scene.quantity(output)
    what = (
        f"{output.of.replace('_', ' ')} {'of' if quantity.of_arm else 'at'} {place(output.at, output.part)}"
    )
    names = quantity.columns(output.name)
    ends = [f", {part}" for part in quantity.components] or [""]
    return tuple(OutputColumn(name, quantity, what + end) for name, end in zip(names, ends, strict=True))


def place(at: str | int, part: str = "") -> str:
    """Return a place in words: a part by its name where there is one."""
    if part:
        return f"'{part}'"
    return f"station {at}" if isinstance(at, int) else f"the {at}"

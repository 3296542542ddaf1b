"""Outputs as columns: one for each number a scene reports, vectors taken apart."""

from __future__ import annotations

from dataclasses import dataclass

from tmm_gen.scene import Output, Scene
from tmm_gen.scene.quantity import quantities

QUANTITIES = {
    "rad": "angle",
    "rad/s": "rate",
    "rad/s^2": "acceleration",
    "N m": "torque",
    "m": "position",
    "m/s": "velocity",
    "m/s^2": "acceleration",
    "N": "force",
    "J": "energy",
}


@dataclass(frozen=True)
class OutputColumn:
    """One number of an output.

    Parameters
    ----------
    name : str
        That of the output, with ``_x`` or ``_y`` for a vector: as in CSV files and generated kernels.
    unit : str
        SI.
    what : str
        In words.
    """

    name: str
    unit: str
    what: str


def output_columns(scene: Scene) -> tuple[OutputColumn, ...]:
    """Return the columns of a scene's outputs, in its order."""
    return tuple(column for output in scene.outputs for column in _columns(output, scene.model.kind))


def _columns(output: Output, kind: str) -> tuple[OutputColumn, ...]:
    place = f"station {output.at}" if isinstance(output.at, int) else f"the {output.at}"
    if output.part:
        place = f"'{output.part}'"
    what = f"{output.of.replace('_', ' ')} {'of' if output.at == 'arm' else 'at'} {place}"
    quantity = quantities(kind)[output.of]
    if not quantity.vector:
        return (OutputColumn(output.name, quantity.unit, what),)
    return tuple(OutputColumn(f"{output.name}_{axis}", quantity.unit, f"{what}, {axis}") for axis in "xy")

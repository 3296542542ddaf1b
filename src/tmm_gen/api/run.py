"""A simulation's outcome: outputs over time, figures, how good it is."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.api.frames import pandas
from tmm_gen.api.guard import guarded
from tmm_gen.api.html import html_table
from tmm_gen.api.picture import Picture, target_of
from tmm_gen.api.wording import in_python
from tmm_gen.errors import UserError
from tmm_gen.files import write_whole
from tmm_gen.scene.columns import output_columns
from tmm_gen.scene.quantity import INPUT_UNITS
from tmm_gen.simulate.simulation import Simulation
from tmm_gen.simulate.trust import divided, share, trusted

__all__ = ["Run"]

Array = NDArray[np.float64]

_COLUMNS = {
    "output": "output",
    "what": "",
    "unit": "unit",
    "final": "final",
    "rest": "at rest",
    "peak": "peak",
    "peak_time": "at (s)",
    "overshoot_percent": "overshoot (%)",
    "settling_time": "within 2 % after (s)",
}


@dataclass(frozen=True, eq=False, repr=False)
class Run:
    """An arm over time.

    ``run["payload"]`` is an output, (k + 1,), or (k + 1, components) of a vector; ``run["payload_x"]`` is one
    component. Both can be read as attributes too: ``run.payload``.

    Parameters
    ----------
    simulation : Simulation
        What was found.
    """

    simulation: Simulation

    @property
    def time(self) -> Array:
        """Instants, s, (k + 1,), from 0 on."""
        return self.simulation.time

    @property
    def outputs(self) -> dict[str, Array]:
        """Outputs by column, (k + 1,) each."""
        return dict(self.simulation.outputs)

    @property
    def inputs(self) -> dict[str, Array]:
        """Inputs at the same instants, (k + 1,) each."""
        return dict(self.simulation.inputs)

    @property
    def units(self) -> dict[str, str]:
        """Units by column of outputs and inputs, SI."""
        scene = self.simulation.scene
        found = {column.name: column.unit for column in output_columns(scene)}
        return found | {item.name: INPUT_UNITS[item.acts] for item in scene.inputs}

    @property
    def figures(self) -> list[dict[str, object]]:
        """What ``tmm-gen run`` prints of each column: final value, peak and when, overshoot, settling time."""
        return list(self.simulation.rows())

    @property
    def final(self) -> dict[str, float]:
        """The last value of each column."""
        return {name: float(values[-1]) for name, values in self.simulation.outputs.items()}

    @property
    def accuracy(self) -> float | None:
        """Estimated error as a share of the motion."""
        found = self.simulation.accuracy
        return None if found is None else found.error

    @property
    def energy_imbalance(self) -> float | None:
        """Largest gap between work, energy and heat, as a share of the energy that moved; None where it is unknown."""
        return self.simulation.imbalance

    @property
    def facts(self) -> Mapping[str, object]:
        """All that is known of the run as a whole, by the keys of ``tmm-gen run --json``."""
        return self.simulation.facts()

    @property
    def statement(self) -> str:
        """How good the run is, from what that is known, and what else is to be said, in sentences."""
        simulation, said = self.simulation, []
        if simulation.substeps.count > 1:
            said.append(divided(simulation))
        if not simulation.still:
            said.append(trusted(simulation))
        elif simulation.scene.inputs:
            said.append(f"nothing moves, as all inputs are zero: try {simulation.scene.inputs[0].name}=1")
        return in_python("\n".join([*(words for words in said if words), *simulation.notes]))

    @guarded
    def plot(self, file: str | PathLike[str] | None = None) -> Picture:
        """Draw inputs, outputs and, where it has a shape, the arm; write the picture if a file is named."""
        from tmm_gen.report.plots import response_figure

        return Picture(response_figure(self.simulation), self._title, file)

    @guarded
    def animate(self, file: str | PathLike[str]) -> Path:
        """Write the arm in motion as a GIF or as an HTML page, by the file's ending; return where."""
        if self.simulation.scene.model.linear:
            raise UserError("animate: a chain has no shape to show. Use plot().")
        from tmm_gen.report.moving import moving

        target = target_of(file, (".gif", ".html"))
        write_whole(target, moving(self.simulation, target.suffix[1:].lower()))
        return target

    @guarded
    def csv(self, file: str | PathLike[str] | None = None, *, inputs: bool = False) -> str:
        """Return outputs over time as CSV, with every digit; write it if a file is named.

        With `inputs` these are columns too, before the outputs: a record that :meth:`tmm_gen.Arm.calibrate` reads.
        """
        text = self.simulation.csv(inputs)
        if file is not None:
            write_whole(target_of(file, (".csv",)), text)
        return text

    @guarded
    def to_pandas(self) -> Any:
        """Return the outputs as a data frame of pandas, which must be installed, by time in seconds."""
        pd = pandas()
        return pd.DataFrame(self.outputs, index=pd.Index(self.time, name="time"))

    @guarded
    def __getitem__(self, name: str) -> Array:
        """Return an output by its name, or one of its columns."""
        found = self._find(name)
        if found is None:
            names = [*self._vectors, *self.simulation.outputs]
            near = get_close_matches(str(name), names, n=1)
            remedy = f"Did you mean {near[0]!r}?" if near else f"There are {', '.join(dict.fromkeys(names))}."
            raise UserError(f"the run has no output {name!r}. {remedy}")
        return found

    def __getattr__(self, name: str) -> Array:
        """Return an output by its name, or one of its columns."""
        found = None if name.startswith("_") or name == "simulation" else self._find(name)
        if found is None:
            raise AttributeError(f"a run has no attribute {name!r}, and its scene no output of this name")
        return found

    def __dir__(self) -> list[str]:
        """Offer the outputs too."""
        return [*super().__dir__(), *self._vectors, *self.simulation.outputs]

    def _find(self, name: object) -> Array | None:
        columns = self._vectors.get(name) if isinstance(name, str) else None
        if columns is not None:
            return np.stack([self.simulation.outputs[column] for column in columns], axis=1)
        return self.simulation.outputs.get(name) if isinstance(name, str) else None

    @property
    def _vectors(self) -> dict[str, tuple[str, ...]]:
        scene = self.simulation.scene
        read = ((item.name, scene.quantity(item)) for item in scene.outputs)
        vectors = {name: quantity.columns(name) for name, quantity in read if quantity.components}
        if scene.spatial is not None:  # its scene counts every component as an output
            vectors |= {item.name: item.columns for item in scene.spatial.outputs if len(item.columns) > 1}
        return vectors

    @property
    def _title(self) -> str:
        simulation = self.simulation
        step = simulation.scene.integrator
        return (
            f"{simulation.scene.name}, {simulation.time[-1]:g} s in {simulation.steps} steps by {step.name}"
        )

    def __repr__(self) -> str:
        """Say what was simulated, and how good it is."""
        known = "" if self.accuracy is None else f", accurate to {share(self.accuracy)}"
        known = ", nothing moves" if self.simulation.still else known
        return f"<Run of {self._title}: {', '.join(self.simulation.outputs)}{known}>"

    def _repr_html_(self) -> str:
        rows = self.figures
        told = {key: head for key, head in _COLUMNS.items() if any(row[key] is not None for row in rows)}
        return html_table(self._title, told, rows, self.statement.splitlines())

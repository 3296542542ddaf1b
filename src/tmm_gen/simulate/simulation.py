"""What a simulation leaves, and its files."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from tmm_gen.scene import Scene
from tmm_gen.scene.columns import OutputColumn, output_columns
from tmm_gen.simulate.accuracy import Accuracy
from tmm_gen.simulate.adaptive.chosen import Chosen
from tmm_gen.simulate.metrics import step_figures
from tmm_gen.simulate.substeps import Substeps
from tmm_gen.simulate.trace import Trace

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Simulation:
    """Outputs over time.

    Parameters
    ----------
    scene : Scene
        What was simulated, with the step that was used.
    backend : str
        "numpy" or "c".
    time : array, (k + 1,)
        Instants, s, from 0 on.
    outputs : dict from str to array, (k + 1,)
        By name, in the order of the scene; vectors as ``NAME_x`` and ``NAME_y``.
    inputs : dict from str to array, (k + 1,)
        The inputs at the same instants.
    rest : dict from str to float, optional
        The outputs once all motion has died out; None where it need not come to rest, or is not known.
    trace : Trace, optional
        The motion of all links, where it was asked for.
    imbalance : float, optional
        Where the motion of all links is known: largest difference between work done and energy gained and
        dissipated, as a share of the energy that moved.
    unsolved : float, optional
        Of a planar arm: work of what the sweeps left unsolved, as a share of the energy that moved.
    step_error : float, optional
        Of a planar arm: error that the step leaves by itself (:func:`tmm_gen.simulate.step_error.step_error`).
    notes : tuple of str
        How tables of a prescribed base were followed, where that is not plain.
    accuracy : Accuracy, optional
        What is known of the error, where that was asked for.
    sweeps_per_step : float, optional
        On average, where the kernel sweeps as often as it takes; of each substep where a step is divided.
    substeps : Substeps
        Into how many each step was divided, and why; figures of the error are of the run in substeps, outputs are at
        the ends of steps.
    chosen : Chosen, optional
        What steps were chosen, where the scene has a tolerance; rows are between them.
    taken : int, optional
        Steps taken, where rows are not at their ends.
    """

    scene: Scene
    backend: str
    time: Array
    outputs: dict[str, Array]
    inputs: dict[str, Array]
    rest: dict[str, float] | None
    trace: Trace | None = None
    imbalance: float | None = None
    unsolved: float | None = None
    step_error: float | None = None
    notes: tuple[str, ...] = ()
    accuracy: Accuracy | None = None
    sweeps_per_step: float | None = None
    substeps: Substeps = field(default_factory=Substeps)
    chosen: Chosen | None = None
    taken: int | None = None

    @property
    def steps(self) -> int:
        """Number of steps taken."""
        if self.chosen is not None:
            return self.chosen.steps
        return len(self.time) - 1 if self.taken is None else self.taken

    @property
    def still(self) -> bool:
        """Whether nothing happens: no input, no motion."""
        acts = any(np.any(values) for values in self.inputs.values()) or any(self.scene.initial.rates)
        return not acts and not any(np.any(values != values[0]) for values in self.outputs.values())

    def csv(self, inputs: bool = False) -> str:
        """Return a table of outputs over time with 17 significant digits: every bit of a double.

        Parameters
        ----------
        inputs : bool
            Whether inputs are columns too, before the outputs: then it is a record that a calibration reads.
        """
        columns_by_name = {"time": self.time, **(self.inputs if inputs else {}), **self.outputs}
        lines = [",".join(columns_by_name)]
        columns = [values.tolist() for values in columns_by_name.values()]
        lines += [",".join(f"{value:.17g}" for value in row) for row in zip(*columns, strict=True)]
        return "\n".join(lines) + "\n"

    def facts(self) -> dict[str, object]:
        """Return what is known of the run as a whole, by key."""
        accuracy, chosen = self.accuracy, self.chosen
        return {
            "scene": self.scene.name,
            "integrator": self.scene.integrator.name,
            "backend": self.backend,
            "step": self.scene.integrator.step,
            "steps": self.steps,
            "substeps": self.substeps.count,
            "substeps_since": 0.0,
            "every": float(self.time[1]),
            "tolerance": chosen and chosen.tolerance,
            "refused_steps": chosen and chosen.refused,
            "smallest_step": chosen and chosen.smallest,
            "largest_step": chosen and chosen.largest,
            "prepared": chosen and chosen.prepared,
            "runs": chosen and chosen.runs,
            "until": float(self.time[-1]),
            "accuracy": accuracy and accuracy.error,
            "sensitivity": accuracy and accuracy.sensitivity,
            "sweeps_per_step": self.sweeps_per_step,
            "energy_imbalance": self.imbalance,
            "unsolved": self.unsolved,
            "step_error": self.step_error,
            "notes": list(self.notes),
        }

    def rows(self) -> Iterator[dict[str, object]]:
        """Yield one row of figures for each column of the outputs."""
        for column in output_columns(self.scene):
            yield self._row(column)

    def _row(self, column: OutputColumn) -> dict[str, object]:
        values = self.outputs[column.name]
        largest = int(np.argmax(np.abs(values)))
        row: dict[str, object] = {
            "output": column.name,
            "what": column.what,
            "unit": column.unit,
            "final": float(values[-1]),
            "rest": None,
            "peak": float(values[largest]),
            "peak_time": float(self.time[largest]),
            "overshoot_percent": None,
            "settling_time": None,
        }
        if self.rest is not None and column.name in self.rest:
            figures = step_figures(self.time, values, self.rest[column.name])
            row["rest"] = figures.final
            row["settling_time"] = figures.settling_time
            if figures.start != figures.final:
                row["overshoot_percent"] = 100.0 * figures.overshoot
        return row

"""How an output answers an input at each frequency."""

from __future__ import annotations

from dataclasses import dataclass
from os import PathLike

import numpy as np
from numpy.typing import NDArray

from tmm_gen.api.guard import guarded
from tmm_gen.api.html import html_table
from tmm_gen.api.picture import Picture, target_of
from tmm_gen.files import write_whole
from tmm_gen.modal.answer import Answer

__all__ = ["Response"]

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


@dataclass(frozen=True, eq=False, repr=False)
class Response:
    """One output for one input.

    Parameters
    ----------
    answer : Answer
        What was found.
    """

    answer: Answer

    @property
    def hertz(self) -> Array:
        """Frequencies, Hz, (f,)."""
        return self.answer.hertz

    @property
    def response(self) -> dict[str, Complex]:
        """Answer to a unit of the input by column of the output, complex, (f,) each."""
        return dict(self.answer.parts)

    @property
    def unit(self) -> str:
        """Of the magnitude."""
        return self.answer.unit

    @property
    def resonances(self) -> list[dict[str, object]]:
        """The modes within the band, with magnitude and phase at each."""
        return self.answer.rows

    @guarded
    def plot(self, file: str | PathLike[str] | None = None) -> Picture:
        """Draw magnitude and phase, of a vector those of its largest component; write them if a file is named."""
        from tmm_gen.modal.picture import bode_figure

        return Picture(bode_figure(self.answer), self._title, file)

    @guarded
    def csv(self, file: str | PathLike[str] | None = None) -> str:
        """Return it as CSV, with every digit; write it if a file is named."""
        text = self.answer.csv()
        if file is not None:
            write_whole(target_of(file, (".csv",)), text)
        return text

    @property
    def _title(self) -> str:
        return f"{self.answer.scene.name}: {self.answer.read.name} for {self.answer.given.name}"

    def __repr__(self) -> str:
        """Say what answers what, and where."""
        return f"<Response of {self._title}, {self.hertz[0]:.4g} to {self.hertz[-1]:.4g} Hz>"

    def _repr_html_(self) -> str:
        columns = {"mode": "mode", "frequency_hz": "resonance (Hz)", "damping_ratio": "damping ratio"}
        for name in self.answer.told:
            suffix = name.removeprefix(self.answer.read.name)
            columns[f"magnitude{suffix}"] = f"magnitude {suffix[1:]} ({self.unit})"
            columns[f"phase{suffix}_deg"] = f"phase {suffix[1:]} (°)"
        return html_table(self._title, columns, self.resonances)

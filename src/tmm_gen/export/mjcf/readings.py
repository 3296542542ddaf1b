"""How the outputs of a scene are read off the sensors of its MuJoCo model."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True)
class Reading:
    """One number of an output: a sum of sensor components and a constant.

    Parameters
    ----------
    name : str
        Column of the output, with ``_x`` or ``_y`` for a vector.
    terms : tuple of (str, int, float)
        Sensor, component from 0, factor.
    constant : float
        Added to the sum.
    """

    name: str
    terms: tuple[tuple[str, int, float], ...]
    constant: float = 0.0

    def value(self, sensor: Callable[[str], list[float]]) -> float:
        """Return the number.

        Parameters
        ----------
        sensor : callable
            Returns the data of a sensor by its name.
        """
        return self.constant + sum(factor * sensor(name)[component] for name, component, factor in self.terms)

    def __str__(self) -> str:
        """Return the sum in words, such as ``tip_x = tip[0]``."""
        parts = [
            f"{'' if factor == 1 else '-' if factor == -1 else f'{factor:g} '}{name}[{component}]"
            for name, component, factor in self.terms
        ]
        if self.constant:
            parts.append(f"{self.constant:g}")
        return f"{self.name} = {' + '.join(parts).replace('+ -', '- ')}"

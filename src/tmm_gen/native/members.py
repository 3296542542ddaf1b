"""The members of one struct as arrays: for callers who read and write states at every step."""

from __future__ import annotations

import ctypes
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.native.layout import PairStructure

Array = NDArray[np.float64]


class Members:
    """Views of a struct's memory.

    Parameters
    ----------
    instance : ctypes.Structure
        Must live as long as this.
    """

    def __init__(self, instance: ctypes.Structure) -> None:
        memory: Any = instance
        whole: Any = np.frombuffer(memory, np.dtype(type(instance)))
        self._views: dict[str, Any] = {name: whole[name] for name in whole.dtype.names or ()}
        fields: Any = type(instance)._fields_
        self._pairs = {name for name, member in fields if getattr(member, "_type_", member) is PairStructure}

    def read(self) -> dict[str, Array]:
        """Return copies of all members as doubles, numbers and (n,); sums of two are summed up."""
        return {
            name: (view["high"].astype(float) + view["low"])[0] if name in self._pairs else view[0] * 1.0
            for name, view in self._views.items()
        }

    def write(self, values: Mapping[str, Any]) -> None:
        """Set members, (n,) or (1, n); what is single precision is rounded here."""
        for name, value in values.items():
            view = self._views[name]
            if name in self._pairs:
                with np.errstate(over="ignore", invalid="ignore"):
                    view["high"] = value
                    view["low"] = value - view["high"].astype(float)
            else:
                view[...] = value

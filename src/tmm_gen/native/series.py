"""Many steps of a compiled kernel in one call, with inputs and outputs as arrays."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.native.differences import with_derivatives
from tmm_gen.native.kernel import NativeKernel
from tmm_gen.native.layout import Value

Array = NDArray[np.float64]

Sampled = Callable[[Array], Array]
"""An input: values at instants (s), of the same shape."""


class Series:
    """A run of a kernel, its inputs sampled beforehand, so that nothing but compiled C works while it lasts.

    Parameters
    ----------
    kernel : NativeKernel
        Several series may share it: each run overwrites its model and state.
    signals : mapping from str to callable
        Inputs by name, from instants to values; those not named are zero, but rate and acceleration of a prescribed
        angle are its derivatives.
    steps : int
        How many; positive.
    step : float
        s.

    """

    def __init__(self, kernel: NativeKernel, signals: Mapping[str, Sampled], steps: int, step: float) -> None:
        self.kernel = kernel
        self.step = step
        self.steps = steps
        self._inputs: Any = (kernel.types["inputs"] * steps)()
        self._outputs: Any = (kernel.types["outputs"] * steps)()
        acting = with_derivatives(kernel.program, signals, step)
        self._first = {name: float(signal(np.zeros(1))[0]) for name, signal in acting.items()}
        self._fill(acting)

    def start(self, params: Mapping[str, Value] | None = None) -> None:
        """Prepare the kernel for the step, and go to the scene's initial motion.

        Parameters
        ----------
        params : mapping from str, optional
            Physical parameters that differ from the scene's.

        Raises
        ------
        ValueError
            If the step is not positive.
        VanishingPivotError
            If a pivot is not positive at this step.
        FloatingPointError
            If an input is not finite.
        """
        self.kernel.prepare(params, self.step)
        self.kernel.initialise(dict(self._first))

    def run(self, params: Mapping[str, Value] | None = None) -> dict[str, Array]:
        """Start anew and take all steps.

        Parameters
        ----------
        params : mapping from str, optional
            As for :meth:`start`.

        Returns
        -------
        dict from str to array, (steps + 1,)
            Outputs by name, the first at the start.

        Raises
        ------
        ValueError
            As :meth:`start`.
        ArithmeticError
            As :meth:`start`; or if the motion is not finite (NonFiniteStateError), out of range
            (OutOfRangeError), or takes a pivot to zero.
        """
        self.start(params)
        first = self.kernel.output()
        self.kernel.run(self._inputs, self._outputs)
        found = self._table(self._outputs)
        return {
            variable.name: np.concatenate([[first[variable.name]], found[:, column].astype(float)])
            for column, variable in enumerate(self.kernel.program.outputs)
        }

    def seconds(self) -> float:
        """Return how long all steps keep the processor busy, outputs included, s.

        Time of this thread alone: on a busy machine what others get of the processor is none of it.

        Raises
        ------
        ValueError, ArithmeticError
            As :meth:`run`.
        """
        self.start()
        begun = time.thread_time()
        self.kernel.run(self._inputs, self._outputs)
        return time.thread_time() - begun

    def _fill(self, signals: Mapping[str, Sampled]) -> None:
        """Sample the inputs at the instants of each step's stages."""
        table, column = self._table(self._inputs), 0
        instants = self.kernel.program.stage_instants
        begins = np.arange(self.steps, dtype=float)
        for variable in self.kernel.program.inputs:
            width = variable.length or 1
            if (signal := signals.get(variable.name)) is not None:
                for stage in range(width):
                    table[:, column + stage] = signal((begins + _instant(instants[-1], stage)) * self.step)
                    for early, own in enumerate(instants[: min(len(instants) - 1, self.steps)]):
                        at = np.array([(early + _instant(own, stage)) * self.step])
                        table[early, column + stage] = signal(at)[0]
            column += width

    def _table(self, structs: Any) -> NDArray[Any]:
        """Return structs of numbers as a table, one row each."""
        kind = np.float64 if self.kernel.real == "float64" else np.float32
        return np.frombuffer(structs, dtype=kind).reshape(self.steps, -1)


def _instant(instants: tuple[float, ...], stage: int) -> float:
    """Return the instant of a stage in steps; a start-up step may have fewer stages, and repeats its last."""
    return instants[min(stage, len(instants) - 1)]

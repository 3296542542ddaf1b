"""A compiled kernel, with the interface of the generated NumPy module."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.native.differences import with_derivatives
from tmm_gen.native.layout import Value, element_values, read, write
from tmm_gen.native.library import Library
from tmm_gen.native.sampling import Signal, stage_inputs, value_at
from tmm_gen.program.statements import Program

Array = NDArray[np.float64]

_MEASURED_SECONDS = 5e-3
"""Least duration of one timed repetition."""


class NativeKernel:
    """One arm in compiled C: a model and a state, and the functions that work on them.

    Parameters
    ----------
    program : Program
        What was emitted.
    library : Library
        What was compiled.
    """

    def __init__(self, program: Program, library: Library) -> None:
        self.program = program
        self.real = library.real.name
        self._library = library
        self._params, self._model, self._state, self._inputs, self._outputs = (
            kind() for kind in library.types.values()
        )
        for unwritten in (self._model, self._state, self._outputs):  # whose zeros a caller's memory has not
            ctypes.memset(ctypes.byref(unwritten), 0xFF, ctypes.sizeof(unwritten))
        self._step = self._default_step
        library.call("default_params", self._params)

    def another(self) -> NativeKernel:
        """Return another arm of the same code, with a model and a state of its own that are not prepared yet."""
        return NativeKernel(self.program, self._library)

    # -- phases -------------------------------------------------------------------------------

    def prepare(self, params: Mapping[str, Value] | None = None, step: float | None = None) -> None:
        """Compute what depends on parameters and step alone.

        Parameters
        ----------
        params : mapping from str, optional
            Parameters that differ from the scene's.
        step : float, optional
            Time step (s), by default the scene's.

        Raises
        ------
        FloatingPointError
            If a parameter is not finite.
        ValueError
            If the step is not positive, or a parameter has another name or length.
        VanishingPivotError
            If a pivot is not positive.
        """
        self._library.call("default_params", self._params)
        write(self._params, self._library.structs["params"], params or {})
        self._step = self._default_step if step is None else float(step)
        self._library.call("prepare", self._model, self._params, self._step)

    def initialise(self, inputs: Mapping[str, Value] | None = None, **given: Value) -> None:
        """Start from the scene's initial motion or a given one, with the parameters of :meth:`prepare`.

        Parameters
        ----------
        inputs : mapping from str, optional
            What acts at the initial instant; inputs not named are zero.
        **given : float or array_like
            ``initial_angle`` and ``initial_rate``, where they differ from the scene's.

        Raises
        ------
        FloatingPointError
            If an argument is not finite.
        ValueError
            If there is no such argument, or it has another length.
        """
        names = [v.name for v in self.program.given]
        if unknown := sorted(set(given) - set(names)):
            raise ValueError(f"initialise takes no {', '.join(unknown)}; it takes {', '.join(names)}")
        arrays = []
        for variable in self.program.given:
            value = given.get(variable.name, variable.default or 0.0)
            arrays.append(element_values(variable, value, self._library.number_array(variable.length or 1)))
        self._apply(inputs)
        extra = (self._step,) if self.program.step in self.program.initialise.read() else ()
        self._library.call("initialise", self._state, self._params, *arrays, self._inputs, *extra)

    def step(self, inputs: Mapping[str, Value] | None = None) -> None:
        """Advance the state by one step.

        Parameters
        ----------
        inputs : mapping from str, optional
            Numbers, held over the step, or one for each of its stages; inputs not named are zero.

        Raises
        ------
        FloatingPointError
            If an input is not finite (the state is then as it was).
        NonFiniteStateError
            If the new state is not.
        """
        self._apply(inputs)
        self.step_as_written()

    def step_as_written(self) -> None:
        """Advance the state by one step, with whatever stands in :attr:`memory`; raises as :meth:`step`."""
        self._library.call("step", self._model, self._state, self._inputs)

    def output(self) -> dict[str, float]:
        """Return the outputs of the present state, by name."""
        self._library.call("output", self._model, self._state, self._outputs)
        return read(self._outputs, self._library.structs["outputs"])

    def run(self, inputs: Any, outputs: Any) -> None:
        """Take as many steps as there are structs of inputs, and fill as many of outputs.

        Raises
        ------
        FloatingPointError
            As :meth:`step`.
        """
        self._library.run(self._model, self._state, inputs, outputs)

    def record(self, inputs: Any, outputs: Any, states: Any) -> tuple[int, int]:
        """Do the same, and keep the states; see :meth:`Library.record`."""
        return self._library.record(self._model, self._state, inputs, outputs, states)

    def raise_for(self, status: int) -> None:
        """Raise what a status of :meth:`record` stands for."""
        self._library.raise_for(status, "step")

    @property
    def memory(self) -> Mapping[str, ctypes.Structure]:
        """The arm's own "state" and "inputs", to be read and written in place."""
        return {"state": self._state, "inputs": self._inputs}

    @property
    def types(self) -> Mapping[str, type[ctypes.Structure]]:
        """Structs of the kernel as ctypes has them: "params", "model", "state", "inputs", "outputs"."""
        return self._library.types

    # -- state --------------------------------------------------------------------------------

    @property
    def state(self) -> dict[str, Any]:
        """Copy of the state: numbers and arrays by name, and the count of start-up steps if there are any."""
        return read(self._state, self._library.structs["state"])

    @state.setter
    def state(self, values: Mapping[str, Value]) -> None:
        write(self._state, self._library.structs["state"], values)

    @property
    def model(self) -> dict[str, Any]:
        """Copy of the model."""
        return read(self._model, self._library.structs["model"])

    # -- many steps ---------------------------------------------------------------------------

    def simulate(
        self,
        duration: float,
        inputs: Mapping[str, Signal] | None = None,
        params: Mapping[str, Value] | None = None,
        step: float | None = None,
        **given: Value,
    ) -> tuple[Array, dict[str, Array]]:
        """Simulate from time zero in whole steps.

        Parameters
        ----------
        duration : float
            Time to simulate (s); the last instant is the last whole step within it.
        inputs : mapping from str
            Constants or functions of time; inputs not named are zero, but rate and acceleration of a prescribed
            angle that is a function are its derivatives.
        params, step, **given
            As for :meth:`prepare` and :meth:`initialise`.

        Returns
        -------
        times : array, shape (steps + 1,)
            Instants (s).
        outputs : dict from str to array, shape (steps + 1,)
            Outputs at these instants.

        Raises
        ------
        FloatingPointError, ValueError, VanishingPivotError
            As :meth:`prepare`, :meth:`initialise` and :meth:`step` do.
        """
        signals: dict[str, Any] = dict(inputs or {})
        if unknown := sorted(set(signals) - {v.name for v in self.program.inputs}):
            known = ", ".join(v.name for v in self.program.inputs) or "none"
            raise ValueError(f"no input is named {', '.join(unknown)}; there are: {known}")
        if not 0.0 <= duration < np.inf:
            raise ValueError(f"duration must be a time, not {duration!r}")
        self.prepare(params, step)
        signals = with_derivatives(self.program, signals, self._step)
        self.initialise({name: value_at(signal, 0.0) for name, signal in signals.items()}, **given)
        steps = int(np.floor(duration / self._step * (1.0 + 1e-12)))
        rows = [self.output(), *self.advance(signals, 0, steps)]
        outputs = {v.name: np.array([row[v.name] for row in rows]) for v in self.program.outputs}
        return np.arange(steps + 1, dtype=float) * self._step, outputs

    def advance(self, signals: Mapping[str, Signal], taken: int, steps: int) -> list[dict[str, float]]:
        """Take some steps from the present state.

        Parameters
        ----------
        signals : mapping from str
            Constants or functions of time; inputs not named are zero.
        taken : int
            Steps taken before, from time zero.
        steps : int
            How many to take.

        Returns
        -------
        list of dict from str to float
            Outputs after each step.

        Raises
        ------
        FloatingPointError, ArithmeticError
            As :meth:`step`.
        """
        series, results = ((self._library.types[which] * steps)() for which in ("inputs", "outputs"))
        for index in range(steps):
            write(
                series[index],
                self._library.structs["inputs"],
                stage_inputs(self.program, signals, self._step, taken + index),
            )
        self._library.run(self._model, self._state, series, results)
        return [read(result, self._library.structs["outputs"]) for result in results]

    def timer(self, inputs: Mapping[str, Value] | None = None) -> Callable[[], float]:
        """Return a function that measures once how long a step takes, in nanoseconds.

        It is a loop of compiled C from the scene's initial motion. Time is that of the thread: what
        others get of a busy processor is none of it.

        Parameters
        ----------
        inputs : mapping from str, optional
            What acts, constantly.

        Raises
        ------
        NonFiniteStateError
            If the motion grows beyond all bounds, so that a step cannot be repeated.
        """
        self.prepare()
        steps = 1000
        while (seconds := self._seconds(inputs, steps)) < _MEASURED_SECONDS:
            steps = int(steps * max(2.0, min(10.0, 1.2 * _MEASURED_SECONDS / max(seconds, 1e-9))))
        return lambda: 1e9 / steps * self._seconds(inputs, steps)

    def _seconds(self, inputs: Mapping[str, Value] | None, steps: int) -> float:
        self.initialise(inputs)
        return self._library.seconds(self._model, self._state, self._inputs, steps)

    def _apply(self, inputs: Mapping[str, Value] | None) -> None:
        zero: dict[str, Value] = {v.name: 0.0 for v in self.program.inputs}
        write(self._inputs, self._library.structs["inputs"], {**zero, **(inputs or {})})

    @property
    def _default_step(self) -> float:
        assert isinstance(self.program.step.default, float)
        return self.program.step.default

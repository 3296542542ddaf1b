"""A generated kernel, in NumPy or in C, that steps from any state by any length."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from tmm_gen.native.members import Members
from tmm_gen.simulate.stages import StagePolynomial
from tmm_gen.simulate.stepping import Stepper

Array = NDArray[np.float64]
State = Mapping[str, Any]
"""Numbers and arrays over stations by name, as kernels have them."""

_ACCELERATIONS = ("acceleration", "hub_acceleration", "base_acceleration", "base_alpha")
"""What the names of accelerations in a state begin with."""

_MOST_MIXED = 0.5
"""Of old accelerations in new ones; methods that settle at all have no more."""

_DIGITS = 12
"""Lengths that agree in so many digits share what is prepared for them."""


class Prepared(Protocol):
    """What is kept of a kernel for one length of steps."""

    def step(self, state: State, inputs: Mapping[str, Array]) -> State:
        """Return the state a step later; inputs are those at the instants of the stages, (stages,)."""

    def outputs(self, states: Mapping[str, Array]) -> dict[str, Array]:
        """Return the outputs of many states, (r, ...) by name: (r,) each."""


@dataclass(eq=False)
class AnyLength:
    """Takes steps of any length by one kernel, and keeps what it has prepared for each.

    Parameters
    ----------
    stepper : Stepper
        Has the kernel.
    parameters : mapping from str to float
        Where they differ from the scene's.
    stages : StagePolynomial or None
        How values at the stages of the last step become those of a step of another length; None where states have none.
    """

    stepper: Stepper
    parameters: Mapping[str, float]
    stages: StagePolynomial | None = None
    _prepared: dict[float, Prepared] = field(default_factory=dict, repr=False)

    @property
    def instants(self) -> Array:
        """Instants of the stages at which inputs are read, in steps from the start of the step, (stages,)."""
        if self.stepper.backend == "c":
            return np.array(self.stepper.kernel.program.stage_instants[-1])
        return np.array(self.stepper.kernel.STAGE_INSTANTS[-1])

    @property
    def lengths(self) -> int:
        """How many lengths were prepared."""
        return len(self._prepared)

    def start(self, inputs: Mapping[str, Array], given: Mapping[str, Array]) -> State:
        """Return the state at the beginning, under inputs at that instant; `given` as kernels take it."""
        if self.stepper.backend == "c":
            kernel = self.stepper.kernel
            kernel.prepare(self.parameters)
            kernel.initialise({name: float(values[0]) for name, values in inputs.items()}, **given)
            begun: dict[str, Any] = kernel.state
            return begun
        module = self.stepper.kernel
        values = module.Input(**{name: float(found[0]) for name, found in inputs.items()})
        started: dict[str, Any] = vars(module.initialise(module.Params(**self.parameters), values, **given))
        return started

    def step(self, state: State, came: float | None, length: float, inputs: Mapping[str, Array]) -> State:
        """Return the state a step later.

        Parameters
        ----------
        state : mapping
            Where it begins.
        came : float or None
            Length of the step that led there, s; None at the start.
        length : float
            s.
        inputs : mapping from str to array, (stages,)
            At the instants of the stages.

        Raises
        ------
        ArithmeticError
            As the kernel does.
        """
        if self.stages is not None and came is not None and came != length:
            ratio = length / came
            state = {**state, **self.stages.over(state, 1.0 - ratio, ratio)}
        return self.prepared(length).step(state, inputs)

    def settled(self, state: State, came: float | None, brief: float, inputs: Mapping[str, Array]) -> State:
        """Return a state with the accelerations that inputs ask for which have just jumped.

        A step next to nothing long does not move the arm, and leaves new accelerations. Where it mixes them with the
        old ones, a second step shows by how much.
        """
        first = self.step(state, came, brief, inputs)
        second = self.step(first, brief, brief, inputs)
        moved = [name for name in state if name.startswith(_ACCELERATIONS)]
        apart, again = (
            np.concatenate([np.ravel(np.subtract(b[name], a[name])) for name in moved] or [np.zeros(0)])
            for a, b in ((state, first), (first, second))
        )
        square = float(apart @ apart)
        mixed = float(apart @ again) / square if square > 0.0 else 0.0
        share = 1.0 / (1.0 - min(mixed, _MOST_MIXED))
        there = {name: np.add(state[name], share * np.subtract(first[name], state[name])) for name in moved}
        return {**state, **there}

    def prepared(self, length: float) -> Prepared:
        """Return what is kept for a length of steps."""
        key = float(f"{length:.{_DIGITS}g}")
        if key not in self._prepared:
            make = _Native if self.stepper.backend == "c" else _Numpy
            self._prepared[key] = make.of(self.stepper.kernel, self.parameters, length)
        return self._prepared[key]


@dataclass(frozen=True, eq=False)
class _Numpy:
    module: Any
    model: Any

    @classmethod
    def of(cls, module: Any, parameters: Mapping[str, float], length: float) -> _Numpy:
        return cls(module, module.prepare(module.Params(**parameters), step=length))

    def step(self, state: State, inputs: Mapping[str, Array]) -> State:
        module = self.module
        columns = {name: values.tolist() for name, values in inputs.items()}
        count = len(module.STAGE_INSTANTS[-1])
        stages = [module.Input(**{name: values[k] for name, values in columns.items()}) for k in range(count)]
        given = stages if count > 1 else stages[0]
        found: dict[str, Any] = vars(module.step(self.model, module.State(**state), given))
        return found

    def outputs(self, states: Mapping[str, Array]) -> dict[str, Array]:
        batch = {name: np.moveaxis(values, 0, -1) for name, values in states.items()}
        count = len(next(iter(states.values())))
        found = vars(self.module.output(self.model, self.module.State(**batch)))
        return {name: np.broadcast_to(np.asarray(value, float), (count,)) for name, value in found.items()}


@dataclass(frozen=True, eq=False)
class _Native:
    kernel: Any
    state: Members
    inputs: Members

    @classmethod
    def of(cls, kernel: Any, parameters: Mapping[str, float], length: float) -> _Native:
        own = kernel.another()
        own.prepare(parameters, step=length)
        return cls(own, Members(own.memory["state"]), Members(own.memory["inputs"]))

    def step(self, state: State, inputs: Mapping[str, Array]) -> State:
        self.state.write(state)
        self.inputs.write(inputs)
        self.kernel.step_as_written()
        return self.state.read()

    def outputs(self, states: Mapping[str, Array]) -> dict[str, Array]:
        rows = []
        for k in range(len(next(iter(states.values())))):
            self.state.write({name: values[k] for name, values in states.items()})
            rows.append(self.kernel.output())
        return {name: np.array([row[name] for row in rows]) for name in rows[0]}

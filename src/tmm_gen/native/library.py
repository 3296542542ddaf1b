"""A loaded library: its structs, its functions, and its statuses as exceptions."""

from __future__ import annotations

import ctypes
from typing import Any

from tmm_gen.c_language.real import Real
from tmm_gen.emit.c.structs import structs_of
from tmm_gen.native.layout import PairStructure, require_sizes, structure_of
from tmm_gen.program.evaluate import VanishingPivotError
from tmm_gen.program.statements import Program


class NonFiniteStateError(FloatingPointError):
    """The motion has outgrown the number type."""


class OutOfRangeError(NonFiniteStateError):
    """An angle or an intermediate result has left the range of the kernel; its state is as it was."""


class Library:
    """Kernel and harness of one program.

    Parameters
    ----------
    program : Program
        What was emitted.
    real : Real
        Number type.
    handle : ctypes.CDLL
        The shared library.

    Raises
    ------
    RuntimeError
        If compiler and ctypes disagree on the layout of the structs.
    """

    def __init__(self, program: Program, real: Real, handle: ctypes.CDLL) -> None:
        self.name = program.name
        self.real = real
        self.number: Any = ctypes.c_double if real.size == 8 else ctypes.c_float
        self.structs = {struct.name: struct for struct in structs_of(program)}
        self.types = {name: structure_of(struct, real) for name, struct in self.structs.items()}
        self._handle = handle
        require_sizes(self.name, self.types, handle.harness_sizes)
        handle.harness_seconds.restype = ctypes.c_double
        self._function("output").restype = None
        self._function("default_params").restype = None

    def number_array(self, length: int) -> Any:
        """Return the type of an array of numbers."""
        return self.number * length

    def call(self, function: str, *arguments: Any) -> None:
        """Call a function of the kernel.

        Parameters
        ----------
        function : str
            Name behind the kernel's.
        *arguments
            Structs and arrays, which are passed by reference, and floats.

        Raises
        ------
        FloatingPointError, ValueError, VanishingPivotError
            If it returns another status than success.
        """
        self.raise_for(self._function(function)(*map(self._passed, arguments)), function)

    def run(self, model: Any, state: Any, inputs: Any, outputs: Any) -> None:
        """Take as many steps as there are inputs, and keep the outputs after each.

        Raises
        ------
        FloatingPointError
            If a step fails.
        """
        done = ctypes.c_long()
        passed = map(self._passed, (model, state, inputs, outputs))
        status = self._handle.harness_run(*passed, ctypes.c_long(len(inputs)), ctypes.byref(done))
        self.raise_for(status, f"step {done.value + 1}")

    def record(self, model: Any, state: Any, inputs: Any, outputs: Any, states: Any) -> tuple[int, int]:
        """Take as many steps as there are inputs, and keep outputs and states after each.

        Returns
        -------
        done, status : int
            Steps that succeeded, and the status of the one that did not (:meth:`raise_for`); that one's state is kept
            too. Zero where all did.
        """
        done = ctypes.c_long()
        passed = map(self._passed, (model, state, inputs, outputs, states))
        status: int = self._handle.harness_record(*passed, ctypes.c_long(len(inputs)), ctypes.byref(done))
        return done.value, status

    def seconds(self, model: Any, state: Any, inputs: Any, steps: int) -> float:
        """Return how long a number of steps takes with constant inputs.

        Raises
        ------
        NonFiniteStateError
            If one of them fails.
        """
        passed = map(self._passed, (model, state, inputs))
        seconds: float = self._handle.harness_seconds(*passed, ctypes.c_long(steps))
        if seconds < 0:
            raise NonFiniteStateError(f"{self.name}: the motion grows beyond all bounds")
        return seconds

    def _function(self, name: str) -> Any:
        return getattr(self._handle, f"{self.name}_{name}")

    def _passed(self, argument: Any) -> Any:
        if isinstance(argument, float):  # the time step
            return PairStructure.of(argument) if self.real.pair else self.number(argument)
        return ctypes.byref(argument)

    def raise_for(self, status: int | None, where: str) -> None:
        """Raise what a status stands for; success is nothing."""
        what = f"{self.name}, {where}"
        if status == 1:
            raise FloatingPointError(f"{what}: an argument is not finite")
        if status == 2:
            raise ValueError(f"{what}: the time step must be a positive number")
        if status == 3:
            raise VanishingPivotError(f"{what}: a pivot is not positive; check parameters and step")
        if status == 5:
            raise OutOfRangeError(f"{what}: an angle or an intermediate result is out of range")
        if status == 6:
            raise ValueError(f"{what}: a pointer is NULL")
        if status == 7:
            raise FloatingPointError(
                f"{what}: parameters or step are too large or too small for the number type"
            )
        if status == 4:
            raise NonFiniteStateError(f"{what}: the motion has outgrown the number type")

"""A compiled step with its exact first derivatives, on plain arrays."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tmm_gen.c_language.names import macros
from tmm_gen.c_language.real import REALS
from tmm_gen.emit.c import emit_kernel
from tmm_gen.emit.templates import render
from tmm_gen.native.compiler import FLAGS, compile_library
from tmm_gen.native.library import Library
from tmm_gen.program.statements import Program
from tmm_gen.scene import Scene

Array = NDArray[np.float64]


class NativeSensitivities:
    """``step_with_sensitivities`` of one program, with the parameters of its scene.

    Columns are in the order of the program: state as ``STATE_NAMES`` of the CasADi model, inputs one after the other,
    each with all its stages.

    Parameters
    ----------
    program : Program
        Built for a scene with ``emit.sensitivities``.
    scene : Scene
        Gives the number type.
    step : float, optional
        Time step (s), by default the scene's.
    cc, flags
        Compiler and options.

    Raises
    ------
    ValueError
        If the program has no sensitivities.
    UserError
        If there is no such compiler, or it refuses the sources.
    """

    def __init__(
        self,
        program: Program,
        scene: Scene,
        step: float | None = None,
        cc: str = "gcc",
        flags: Sequence[str] = FLAGS,
    ) -> None:
        if program.sensitivities is None:
            raise ValueError(f"{program.name} has no sensitivities: set emit.sensitivities")
        files = emit_kernel(program, scene)
        files["c/kernel-harness.c"] = render("c/harness.c.jinja", name=program.name)
        files["c/lanes.c"] = (
            f'#include "{program.name}_sensitivities.h"\n\n'
            f"int lanes(void);\nint lanes(void)\n{{\n    return {macros(program.name)}_LANES;\n}}\n"
        )
        handle = ctypes.CDLL(str(compile_library(files, cc, flags)))
        self._library = Library(program, REALS[scene.emit.real], handle)
        self._program, self._handle = program, handle
        self._function: Any = getattr(handle, f"{program.name}_step_with_sensitivities")
        self._lanes = int(handle.lanes())
        self._number = np.float64 if scene.emit.real == "float64" else np.float32
        params, self._model = self._library.types["params"](), self._library.types["model"]()
        self._library.call("default_params", params)
        default = program.step.default
        assert isinstance(default, float)
        self._library.call("prepare", self._model, params, default if step is None else float(step))
        self.states = sum(v.length or 1 for v in program.state)
        self.inputs = sum(v.length or 1 for v in program.inputs)

    def step(
        self, state: ArrayLike, inputs: ArrayLike, d_state: ArrayLike, d_inputs: ArrayLike
    ) -> tuple[Array, Array]:
        """Advance a state by one step, and changes with it.

        Parameters
        ----------
        state, inputs : array_like, (nx,) and (nu,)
            Motion before the step, and what acts.
        d_state, d_inputs : array_like, (nx, m) and (nu, m)
            Their changes along m directions.

        Returns
        -------
        state : array, (nx,)
        d_state : array, (nx, m)
            After the step.

        Raises
        ------
        FloatingPointError, VanishingPivotError
            If an input or the new state is not finite, or the step cannot be solved.
        """
        after, acting = np.array(state, self._number), self._acting(inputs)
        changes = self._blocks(d_state, self.states)
        causes = self._blocks(d_inputs, max(self.inputs, 1))
        status = self._function(
            ctypes.byref(self._model),
            *(a.ctypes.data_as(ctypes.c_void_p) for a in (after, acting, causes, changes)),
            ctypes.c_int(len(changes)),
        )
        self._library.raise_for(status, "step_with_sensitivities")
        return after.astype(float), self._columns(changes, np.shape(d_state)[1])

    def carried(self, state: ArrayLike, inputs: ArrayLike, d_state: ArrayLike, d_inputs: ArrayLike) -> Array:
        """Carry changes over a step by its gathered slopes.

        Parameters
        ----------
        state, inputs, d_state, d_inputs : array_like
            As of `step`.

        Returns
        -------
        array, (nx, m)
            Changes of the state after the step.

        Raises
        ------
        FloatingPointError, VanishingPivotError
            If an input or the new state is not finite, or the step cannot be solved.
        """
        name, sensitivities = self._program.name, self._program.sensitivities
        assert sensitivities is not None
        assert sensitivities.reduced is not None
        follows = len(sensitivities.reduced.predicted) * self._program.stations + self.inputs
        point = np.zeros(sum(v.length or 1 for v in sensitivities.point), self._number)
        gathered = np.full((self._program.stations, follows), np.nan, self._number)
        changes, causes = self._blocks(d_state, self.states), self._blocks(d_inputs, self.inputs)
        model = ctypes.byref(self._model)

        def call(function: str, *arrays: NDArray[Any]) -> int:
            pointers = (a.ctypes.data_as(ctypes.c_void_p) for a in arrays)
            return int(getattr(self._handle, f"{name}_{function}")(model, *pointers))

        status = call("linearise", np.array(state, self._number), self._acting(inputs), point)
        self._library.raise_for(status, "linearise")
        call("gather", point, gathered)
        for cause, change in zip(causes, changes, strict=True):
            call("carry", gathered, cause, change)
        return self._columns(changes, np.shape(d_state)[1])

    def _acting(self, inputs: ArrayLike) -> NDArray[Any]:
        return np.ascontiguousarray(np.append(np.asarray(inputs), [] if self.inputs else [0.0]), self._number)

    def _columns(self, changes: NDArray[Any], count: int) -> Array:
        """Return the first directions of blocks of lanes, (nx, m)."""
        return np.asarray(changes.transpose(1, 0, 2).reshape(self.states, -1)[:, :count], float)

    def _blocks(self, columns: ArrayLike, rows: int) -> NDArray[Any]:
        """Return columns in blocks of lanes, (blocks, rows, lanes), the last filled with zeros."""
        given = np.atleast_2d(np.asarray(columns, float))
        count = given.shape[1]
        blocks = -(-count // self._lanes)
        padded = np.zeros((rows, blocks * self._lanes), self._number)
        padded[: len(given), :count] = given
        return np.ascontiguousarray(padded.reshape(rows, blocks, self._lanes).transpose(1, 0, 2))

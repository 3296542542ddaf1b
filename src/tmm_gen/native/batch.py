"""Many arms of one scene in compiled C, side by side in vector registers, shared among threads."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tmm_gen.c_language.real import Real, real_of
from tmm_gen.emit.c import emit_c_batch
from tmm_gen.emit.c.structs import structs_of
from tmm_gen.emit.templates import render
from tmm_gen.native.compiler import FLAGS, compile_library
from tmm_gen.native.differences import with_derivatives
from tmm_gen.native.layout import require_sizes, structure_of
from tmm_gen.native.machine import machine, machine_flags, processors
from tmm_gen.native.many import Numbers, arm_count, by_arm, columns, numbers, require_known, whole
from tmm_gen.native.many_inputs import Signal, at_start, sampled, signal_structs
from tmm_gen.native.shares import shared
from tmm_gen.program.statements import Program
from tmm_gen.program.variables import Variable
from tmm_gen.scene import Scene


@dataclass(frozen=True)
class BatchRun:
    """What became of many arms.

    Parameters
    ----------
    times : array, shape (kept,)
        Instants (s).
    outputs : dict from str to array, shape (kept, arms)
        Outputs at these instants, NaN where an arm was refused before.
    status : array of int, shape (arms,)
        0 for an arm that came through, otherwise an index of :data:`tmm_gen.emit.numpy.batch.STATUSES`.
    """

    times: NDArray[np.float64]
    outputs: dict[str, Numbers]
    status: NDArray[np.intc]

    def __repr__(self) -> str:
        """Return how many arms, instants and outputs there are."""
        ended = f", {np.count_nonzero(self.status)} refused" if self.status.any() else ""
        names = ", ".join(self.outputs)
        return f"BatchRun({self.status.size} arms{ended}, {self.times.size} instants, outputs: {names})"


def compile_batch(
    program: Program, scene: Scene, cc: str = "gcc", flags: Sequence[str] | None = None
) -> NativeBatch:
    """Emit a program as C for many arms, compile it and load it.

    Parameters
    ----------
    program : Program
        As built for the scene.
    scene : Scene
        Gives the number type and, by ``emit.batch``, how many arms go side by side.
    cc : str
        Compiler that understands gcc's options.
    flags : sequence of str, optional
        Options besides ``-std=c99``; by default optimised for this machine, without fused multiply-add.

    Raises
    ------
    UserError
        If there is no such compiler, or it refuses the sources.
    ValueError
        If the scene asks for no batch.
    """
    harness = render("c/batch_harness.c.jinja", name=program.name)
    files = {**emit_c_batch(program, scene), "c/batch-harness.c": harness}
    if flags is None:
        flags = ("-O3", *FLAGS[1:], *machine_flags(cc))
        files["machine.txt"] = machine(cc)  # so that a library is found again only where its instructions are
    handle = ctypes.CDLL(str(compile_library(files, cc, flags)))
    return NativeBatch(program, real_of(scene.emit), handle)


class NativeBatch:
    """Many arms of one scene.

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
        self.program = program
        self._handle = handle
        self._real: Any = np.float32 if real.size == 4 else np.float64
        self._structs = {struct.name: struct for struct in structs_of(program)}
        self._types = {name: structure_of(struct, real) for name, struct in self._structs.items()}
        require_sizes(program.name, self._types, handle.batch_sizes)
        self._start, self._run = (
            getattr(handle, f"{program.name}_{what}_batch") for what in ("start", "run")
        )
        self._start.restype = self._run.restype = ctypes.c_long

    @property
    def parameters(self) -> dict[str, NDArray[np.float64]]:
        """The scene's parameters by name, as a start for drawing others: shape () or (stations,)."""
        return {v.name: np.asarray(v.default, dtype=float) for v in self.program.parameters}

    def simulate(
        self,
        duration: float,
        inputs: Mapping[str, Signal] | None = None,
        params: Mapping[str, ArrayLike] | None = None,
        step: float | None = None,
        *,
        arms: int | None = None,
        every: int = 1,
        threads: int | None = None,
        **given: ArrayLike,
    ) -> BatchRun:
        """Simulate all arms from time zero in whole steps.

        Parameters
        ----------
        duration : float
            Time to simulate (s); the last instant is the last whole step within it.
        inputs : mapping from str, optional
            What acts: a number, an array of shape (arms,), one of shape (steps, arms) or (steps, 1) held over each
            step, or a function of time (s) that gives one of the first two. Inputs not named are zero, but rate and
            acceleration of a prescribed angle that is a function are its derivatives.
        params : mapping from str, optional
            Parameters that differ from the scene's: a number or an array of shape (arms,); those with one value per
            station: a number or an array of shape (stations,), the same for all arms, (1, arms) or (stations, arms).
        step : float, optional
            Time step (s), by default the scene's.
        arms : int, optional
            How many; by default as many as some array has.
        every : int
            Outputs are kept at the start and after each so many steps.
        threads : int, optional
            That share the work; by default as many as this process has processors.
        **given : array_like
            ``initial_angle`` and ``initial_rate``, where they differ from the scene's, of shape (stations,) or
            (stations, arms).

        Returns
        -------
        BatchRun
            Instants, outputs, and what became of each arm: one that is refused does not stop the others.

        Raises
        ------
        ValueError
            If a name is unknown, a shape does not fit, or a number is out of its range.
        """
        step = float(self.program.step.default) if step is None else float(step)  # type: ignore[arg-type]  # a number
        if not (0.0 <= duration < np.inf and 0.0 < step < np.inf):
            raise ValueError(f"duration and step must be times, not {duration!r} and {step!r}")
        every = whole("every", every)
        threads = processors() if threads is None else whole("threads", threads)
        program, values = self.program, {**(params or {}), **given}
        signals = with_derivatives(program, dict(inputs or {}), step)
        require_known(signals, program.inputs, "inputs")
        require_known(params or {}, program.parameters, "parameters")
        require_known(given, program.given, "arguments of the start")
        steps = int(np.floor(duration / step * (1.0 + 1e-12)))
        series = {
            name: sampled(program, name, signal, steps, step, self._real) for name, signal in signals.items()
        }
        count = arm_count(arms, (*program.parameters, *program.given), values, series)
        first = {name: at_start(name, signals[name], array, count) for name, array in series.items()}
        kept = np.empty((steps // every + 1, len(program.outputs), count), dtype=self._real)
        status = np.zeros(count, dtype=np.intc)
        begin = self._beginning(count, values, step, first)
        signals_in_c = signal_structs(program, series)
        models, states = (
            np.zeros((count, ctypes.sizeof(self._types[which])), np.uint8) for which in ("model", "state")
        )

        def run(first: int, end: int) -> None:
            here, length = slice(first, end), ctypes.c_long(end - first)
            own = (_pointer(models[here]), _pointer(states[here]), _pointer(status[here]))
            none_lost = self._start(ctypes.c_long(0), length, *begin(here), *own) == 0
            begun = status[here].copy()
            lost = begun != 0
            if not lost.all():
                if not none_lost:  # what could not start has another's place
                    sound = first + int(np.argmin(lost))
                    models[here][lost], states[here][lost] = models[sound], states[sound]
                lengths = map(ctypes.c_long, (count, first, end, steps, every))
                outcome = (_pointer(kept), _pointer(status))
                self._run(*lengths, _pointer(models), _pointer(states), *signals_in_c, *outcome)
            if not none_lost:
                status[here][lost], kept[..., here][..., lost] = begun[lost], np.nan

        shared(run, count, threads)
        outputs = {v.name: kept[:, index] for index, v in enumerate(program.outputs)}
        return BatchRun(np.arange(kept.shape[0]) * (every * step), outputs, status)

    def _beginning(
        self, arms: int, values: Mapping[str, ArrayLike], step: float, first: Mapping[str, Numbers]
    ) -> Callable[[slice], tuple[Any, ...]]:
        """Return what gives, for some of the arms, what they are prepared and started from, as arguments of C."""
        default = self._types["params"]()
        self._handle.batch_defaults(ctypes.byref(default))
        usual = np.frombuffer(bytes(default), dtype=self._real)
        given = [v if v.name in values else None for v in self.program.given]
        rows = {
            v.name: by_arm(v, values[v.name], arms)
            for v in (*self._structs["params"].variables, *given)
            if v is not None and v.name in values
        }
        number: Any = ctypes.c_float if self._real is np.float32 else ctypes.c_double
        width = ctypes.sizeof(self._types["inputs"])

        def begin(here: slice) -> tuple[Any, ...]:
            def of(variable: Variable) -> Numbers:
                return numbers(variable.name, rows[variable.name][here], self._real)

            count = here.stop - here.start
            params = np.tile(usual, (count, 1))
            for variable, place in columns(self._structs["params"]):
                if variable.name in rows:
                    params[:, place] = of(variable)
            inputs = np.zeros((count, width), np.uint8).view(self._real)
            for variable, place in columns(self._structs["inputs"]):
                if variable.name in first:
                    inputs[:, place] = first[variable.name][here, None]
            starts = (None if v is None else _pointer(np.ascontiguousarray(of(v))) for v in given)
            return _pointer(params), number(step), *starts, _pointer(inputs)

        return begin


def _pointer(array: NDArray[Any]) -> Any:
    """Return where an array's numbers are; the array lives as long as what is returned."""
    return array.ctypes.data_as(ctypes.c_void_p)

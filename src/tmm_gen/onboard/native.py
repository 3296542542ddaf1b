"""An emitted controller, compiled on this machine, with the interface of the others."""

from __future__ import annotations

import ctypes
import subprocess
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.command import Command, Flags, Status
from tmm_gen.emit.templates import render
from tmm_gen.errors import UserError
from tmm_gen.onboard.folder import library_sources
from tmm_gen.onboard.text import macro_prefix
from tmm_gen.scratch import scratch_folder

Array = NDArray[np.float64]

STATUSES = (
    Status.OK,
    Status.MEASUREMENT,
    Status.ESTIMATE,
    Status.REDUCED,
    Status.RELAXED,
    Status.NOT_FINITE,
    Status.ITERATIONS,
    Status.INFEASIBLE,
    Status.MISSING,
)
"""By their number in C."""
FLAGS = ("-O3", "-ffp-contract=off")


@dataclass(frozen=True, eq=False)
class Series:
    """What a controller did with a series of measurements: torques, (samples, m), all else (samples,).

    Processor times are those before each measurement and from it to the torques, s.
    """

    torques: Array
    statuses: tuple[Status, ...]
    iterations: NDArray[np.int64]
    prepared: Array
    commanded: Array

    @property
    def seconds(self) -> Array:
        """Processor time of whole samples, s."""
        return self.prepared + self.commanded


class EmittedController:
    """An emitted controller in compiled C.

    Parameters
    ----------
    name : str
        Prefix of its functions.
    files : mapping of str to str
        As emitted.
    sensors : sequence of int
        Which it reads of m encoders, m accelerometers and m strain gauges.
    real : {"float64", "float32"}
        Its number type.
    cc, flags
        Compiler and options.
    motors : int
        m.

    Raises
    ------
    UserError
        If there is no such compiler, or it refuses the sources.
    """

    def __init__(
        self,
        name: str,
        files: Mapping[str, str],
        sensors: Sequence[int],
        real: str = "float64",
        cc: str = "gcc",
        flags: Sequence[str] = FLAGS,
        motors: int = 1,
    ) -> None:
        self.name, self.sensors, self.motors = name, list(sensors), motors
        self._several = f"{macro_prefix(name)}_MOTORS" in files[f"{name}.h"]
        self._number: Any = ctypes.c_double if real == "float64" else ctypes.c_float
        with scratch_folder() as folder:
            self._library = ctypes.CDLL(str(_compiled(folder, name, files, cc, flags, motors)))
        self._library.harness_size.restype = ctypes.c_size_t
        self.bytes = int(self._library.harness_size())
        self._memory = ctypes.create_string_buffer(self.bytes + 64)
        self.reset()

    def reset(self) -> None:
        """Forget all measurements."""
        getattr(self._library, f"{self.name}_reset")(self._aligned())

    def aim(self, reference: Array) -> Status:
        """Take another reference, (m,), rad; of a controller that can."""
        values = (self._number * self.motors)(*map(float, reference))
        return STATUSES[int(getattr(self._library, f"{self.name}_aim")(self._aligned(), values))]

    def follow(self, angles: Array) -> Status:
        """Take a reference that moves, (N, m), rad; of a controller that can."""
        values = (self._number * angles.size)(*map(float, angles.ravel()))
        return STATUSES[int(getattr(self._library, f"{self.name}_follow")(self._aligned(), values))]

    def limit(self, lower: Array, upper: Array) -> Status:
        """Take other bounds of the torques, (m,) each, N m."""
        ends = [(self._number * self.motors)(*map(float, each)) for each in (lower, upper)]
        given = ends if self._several else [self._number(each[0]) for each in ends]
        return STATUSES[int(getattr(self._library, f"{self.name}_limit")(self._aligned(), *given))]

    def carry(self, payload: float) -> Status:
        """Take another payload, kg; of a controller that can."""
        return STATUSES[
            int(getattr(self._library, f"{self.name}_carry")(self._aligned(), self._number(payload)))
        ]

    def prepare(self) -> None:
        """Do what needs no measurement; see :class:`~tmm_gen.control.command.Controller`."""
        getattr(self._library, f"{self.name}_prepare")(self._aligned())

    def command(self, measured: Array, valid: Flags | None = None) -> Command:
        """Return the torques for a measurement; see :class:`~tmm_gen.control.command.Controller`."""
        flags = None if valid is None else np.asarray(valid)[None]
        found = self.run(np.asarray(measured, float)[None], flags, prepare=False)
        return Command(found.torques[0], found.statuses[0], int(found.iterations[0]))

    def run(self, measured: Array, valid: Flags | None = None, prepare: bool = True) -> Series:
        """Hand in a series of measurements, (samples, 3 m), and keep what comes out of each.

        Time includes nothing but the controller's own. Which are valid is said in the same shape, or all are. Samples
        are prepared before their measurements, or left to themselves.
        """
        with np.errstate(over="ignore"):  # what a float cannot hold is infinite
            seen = np.ascontiguousarray(np.asarray(measured, float)[:, self.sensors], self._number)
        count = len(seen)
        torques = np.zeros((count, self.motors), self._number)
        statuses, iterations = np.zeros(count, np.intc), np.zeros(count, np.intc)
        prepared, commanded = np.zeros(count), np.zeros(count)
        flags = None if valid is None else np.ascontiguousarray(valid[:, self.sensors], np.intc)
        self._library.harness_run(
            self._aligned(),
            seen.ctypes.data_as(ctypes.c_void_p),
            None if flags is None else flags.ctypes.data_as(ctypes.c_void_p),
            ctypes.c_long(count),
            ctypes.c_int(prepare),
            *(
                array.ctypes.data_as(ctypes.c_void_p)
                for array in (torques, statuses, iterations, prepared, commanded)
            ),
        )
        kinds = tuple(STATUSES[int(status)] for status in statuses)
        return Series(torques.astype(float), kinds, iterations.astype(np.int64), prepared, commanded)

    def _aligned(self) -> Any:
        address = ctypes.addressof(self._memory)
        return ctypes.c_void_p(address + -address % 64)


def _compiled(
    folder: Path, name: str, files: Mapping[str, str], cc: str, flags: Sequence[str], motors: int
) -> Path:
    harness = {
        "harness.c": render("control/harness.c.jinja", name=name, NAME=macro_prefix(name), motors=motors)
    }
    for path, text in {**files, **harness}.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_text(text)
    sources = library_sources({**files, **harness})
    command = [
        cc,
        "-std=c99",
        "-fPIC",
        "-shared",
        *flags,
        "-I.",
        *sources,
        "-o",
        "controller.so",
        "-lm",
    ]
    try:
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    except FileNotFoundError as error:
        raise UserError(f"the C compiler '{cc}' was not found; install one, or name another") from error
    if done.returncode != 0:
        raise UserError(f"'{' '.join(command)}' failed:\n{done.stderr.strip()}")
    return folder / "controller.so"

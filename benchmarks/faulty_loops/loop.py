"""An emitted controller and an arm in one library: a closed loop in one call."""

from __future__ import annotations

import ctypes
import subprocess
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from faulty_loops.cases import Case
from tmm_gen.control.bench import Bench
from tmm_gen.control.estimators.kalman import present_sensors
from tmm_gen.control.plant.plant_scene import OUTPUTS
from tmm_gen.emit.c import emit_kernel
from tmm_gen.onboard.emit import emit_controller
from tmm_gen.onboard.folder import library_sources
from tmm_gen.onboard.native import STATUSES
from tmm_gen.onboard.text import macro_prefix
from tmm_gen.program.build import build_program

FLAGS = ("-O2", "-ffp-contract=off")
SUBSTEPS = 16
"""Steps of the arm in a sample: four times as many as the controller thinks of."""
AFTER = 500
"""True samples after the last wrong one."""
_SOURCE = Path(__file__).with_name("loop.c")


class _Given(ctypes.Structure):
    _fields_ = (
        *((name, ctypes.c_double) for name in ("start", "target", "low", "high", "gravity")),
        *((name, ctypes.c_int) for name in ("before", "faults", "after", "substeps")),
    )


class _Found(ctypes.Structure):
    _fields_ = (
        *((name, ctypes.c_int) for name in ("first_ok", "last_other", "last_off", "outside")),
        ("counts", ctypes.c_int * len(STATUSES)),
        ("late", ctypes.c_int * len(STATUSES)),
        ("tip", ctypes.c_double),
    )


@dataclass(frozen=True)
class Outcome:
    """What became of a case.

    Parameters
    ----------
    recovery : float
        From the last wrong sample to the first that is OK, s; infinite if there is none.
    calm : float
        To the last that is not OK, s.
    arrival : float
        To the last at which the tip is more than 0.02 rad off, s; infinite if that is the last of all.
    outside : int
        Torques that are not finite or out of their bounds.
    statuses, late : dict of str to int
        How often each status but OK was given; and later than a second after the last wrong sample.
    """

    recovery: float
    calm: float
    arrival: float
    outside: int
    statuses: dict[str, int]
    late: dict[str, int]


class FaultyLoop:
    """An emitted controller on an arm: the scene's, in steps a quarter as long.

    Parameters
    ----------
    bench : Bench
        Of the scene.
    controller, real : str
        What is emitted.
    flags : sequence of str
        For the compiler.
    """

    def __init__(self, bench: Bench, controller: str, real: str, flags: Sequence[str] = FLAGS) -> None:
        self.problem = bench.problem
        self.gravity = bench.scene.model.gravity or 0.0
        self.sensors = present_sensors(bench.problem)
        name, files = emit_controller(bench, controller, real)
        scene = bench.scene.replace(
            name="plant", output=OUTPUTS, control=None, **{"emit.real": "float64", "emit.backends": ["c"]}
        )
        kernel = emit_kernel(build_program(scene), scene)
        plant = {path.removeprefix("c/"): text for path, text in kernel.items()}
        loop = _SOURCE.read_text().replace("CONTROLLER__", f"{name}_").replace("CONTROLLER_.h", f"{name}.h")
        loop = loop.replace("CONTROLLER_", f"{macro_prefix(name)}_")
        with tempfile.TemporaryDirectory(prefix="tmm-gen-") as scratch:
            every = {**files, **plant, "loop.c": loop}
            for path, text in every.items():
                target = Path(scratch, path)
                target.parent.mkdir(parents=True, exist_ok=True)
                target.write_text(text)
            sources = [*library_sources(files), "plant.c", "loop.c"]
            command = ["gcc", "-std=c99", "-fPIC", "-shared", *flags, "-I.", *sources, "-lm", "-o", "l.so"]
            subprocess.run(command, cwd=scratch, check=True)
            self._library = ctypes.CDLL(str(Path(scratch, "l.so")))

    def run(self, case: Case) -> Outcome:
        """Run a case."""
        kinds = np.zeros((case.faults + 1, 3), np.intc)
        values = np.zeros((case.faults + 1, 3))
        at = 0
        for spell in case.spells:
            kinds[at : at + spell.samples], values[at : at + spell.samples] = spell.kinds, spell.values
            at += spell.samples
        low, high = (float(bound[0]) for bound in self.problem.torque)
        given = _Given(
            case.start,
            float(self.problem.reference[0]),
            low,
            high,
            self.gravity,
            case.before,
            case.faults,
            AFTER,
            SUBSTEPS,
        )
        sensors = (ctypes.c_int * len(self.sensors))(*self.sensors)
        found = _Found()
        pointers = (array.ctypes.data_as(ctypes.c_void_p) for array in (kinds, values))
        code = self._library.run_loop(ctypes.byref(given), *pointers, sensors, ctypes.byref(found))
        if code:
            raise RuntimeError(f"the arm itself cannot be simulated ({code}): {case}")
        period = self.problem.sample_time
        return Outcome(
            recovery=found.first_ok * period if found.first_ok > 0 else np.inf,
            calm=found.last_other * period,
            arrival=found.last_off * period if found.last_off < AFTER else np.inf,
            outside=found.outside,
            statuses=_named(found.counts),
            late=_named(found.late),
        )


def _named(counts: Sequence[int]) -> dict[str, int]:
    return {s.name.lower(): n for s, n in zip(STATUSES[1:], counts[1:], strict=True) if n}

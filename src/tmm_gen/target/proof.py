"""Proof by abstract interpretation that a kernel has no run-time fault within its scene's box (Frama-C EVA).

EVA follows all states of the box at once through the very code that is emitted: an index that may leave its array, a
division that may be by zero, a number that may be read before it is written or become infinite raises an alarm. No
alarm is a proof (Buehler, "EVA, an evolved value analysis for Frama-C", Rennes, 2017).
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import PurePosixPath

from tmm_gen.c_language.names import macros, member
from tmm_gen.emit.c import emit_kernel
from tmm_gen.emit.c.box import Box, box_of
from tmm_gen.emit.c.kernel import Kernel
from tmm_gen.emit.c.structs import dimension
from tmm_gen.emit.templates import render
from tmm_gen.errors import UserError
from tmm_gen.program.build import build_program
from tmm_gen.program.variables import Variable
from tmm_gen.scene import Scene
from tmm_gen.scratch import scratch_folder
from tmm_gen.target.tools import attempt, need

FLAT, IN_SPACE = "100", "0"
"""Pieces that intervals are cut in. A sweep in space has so many products that cutting takes long, and what
it hands from joint to joint is bounded on the way."""
PATIENCE = 600.0
"""How long EVA may take, s: arms of a dozen joints in space take half a minute."""
OPTIONS = (
    *("-machdep", "gcc_x86_64", "-eva", "-main", "eva_main", "-eva-precision", "3"),
    *("-eva-auto-loop-unroll", "64", "-warn-special-float", "non-finite"),
    *("-eva-split-return", "full", "-eva-subdivide-non-linear"),
)
"""Precision 3; loops over stations unrolled; statuses kept apart; no infinity and no NaN; intervals cut in pieces where
a number occurs in an expression more than once."""
_ALARM = re.compile(
    r"^\[eva:alarm\] (\S+?):(\d+): Warning:\s*\n?\s*(.*?)(?=^\[|^  *-{5}|\Z)", re.MULTILINE | re.DOTALL
)
_REACHED = re.compile(r"Frama_C_show_each_(\w+):\s*\{([^}]*)\}")


@dataclass(frozen=True)
class Alarm:
    """A fault that could not be excluded.

    Parameters
    ----------
    file : str
        Emitted source.
    line : int
        In it.
    text : str
        What EVA says.
    """

    file: str
    line: int
    text: str


@dataclass(frozen=True)
class Proof:
    """What EVA found.

    Parameters
    ----------
    alarms : tuple of Alarm
        None if the kernel is proved.
    reached : str
        Statements reached and all statements, in words.
    box : dict from str to (float, float)
        What holds for inputs and state.
    """

    alarms: tuple[Alarm, ...]
    reached: str
    box: dict[str, tuple[float, float]]

    @property
    def proved(self) -> bool:
        """Whether no fault is possible."""
        return not self.alarms


def prove(scene: Scene) -> Proof:
    """Analyse a scene's kernel for everything its box allows.

    Parameters
    ----------
    scene : Scene
        With ``[emit.box]``.

    Raises
    ------
    UserError
        If the box is missing or lacks a key, Frama-C is missing, or it does not get through.
    """
    program = build_program(scene)
    box = box_of(scene)
    place = f"{scene.source.origin}: [emit.box]"
    if box is None:
        raise UserError(
            f"{place}: is missing: what is to be proved holds for inputs and states within bounds. "
            "Write for example `angles = [-3.0, 3.0]`, `rates = [-10.0, 10.0]`, `accelerations = [-1e3, 1e3]`, and "
            "bounds for each input by its name."
        )
    if missing := box.missing(program):
        raise UserError(
            f"{place}: bounds of {', '.join(missing)} are missing; write for example `{missing[0]} = [-1.0, 1.0]`"
        )
    kernel = Kernel.of(program, scene)
    files = {**emit_kernel(program, scene), "proof.c": driver(kernel, box)}
    found = analyse(files, scene.name, FLAT if scene.spatial is None else IN_SPACE)
    return Proof(found[0], found[1], dict(box.bounds))


def driver(kernel: Kernel, box: Box) -> str:
    """Write the program that calls a kernel with everything a box allows."""
    program, literal = kernel.program, kernel.real.literal

    def bounds(variable: Variable) -> tuple[str, str]:
        low, high = box.of(variable)
        return literal(low), literal(high)

    def members(variables: tuple[Variable, ...]) -> list[tuple[str, str, str, str]]:
        return [(member(v, program.name), dimension(v, program), *bounds(v)) for v in variables]

    step = box.bounds.get("step")
    return render(
        "target/proof.c.jinja",
        kernel=kernel,
        name=program.name,
        interval="Frama_C_float_interval" if kernel.real.size == 4 else "Frama_C_double_interval",
        step=f"{'any_pair' if kernel.real.pair else 'any'}({literal(step[0])}, {literal(step[1])})"
        if step
        else f"{macros(program.name)}_STEP",
        zero=literal(0.0),
        inputs=members(program.inputs),
        state=members(program.state),
        given=[(v.name, dimension(v, program), bounds(v)) for v in program.given],
        startup=len(program.startup),
    )


def analyse(files: dict[str, str], name: str, pieces: str = FLAT) -> tuple[tuple[Alarm, ...], str]:
    """Run EVA on a kernel and its driver.

    Parameters
    ----------
    files : dict from str to str
        Header, source and driver by path.
    name : str
        Of the kernel.
    pieces : str
        That intervals are cut in.

    Returns
    -------
    alarms : tuple of Alarm
        Each once.
    coverage : str
        What EVA says about statements reached.

    Raises
    ------
    UserError
        If Frama-C is missing or fails, or never gets to the end of a step (so that its silence would mean nothing).
    """
    program = need("frama-c", "frama-c-base")
    with scratch_folder() as folder:
        names = [PurePosixPath(path).name for path in files]
        for short, text in zip(names, files.values(), strict=True):
            (folder / short).write_text(text, encoding="utf-8")
        sources = sorted(short for short in names if short.endswith(".c"))
        done = attempt([program, *OPTIONS, pieces, *sources], folder, PATIENCE)
    said = done.stdout
    if done.returncode != 0:
        raise UserError(
            f"frama-c failed on {name} ({done.returncode}):\n{(said + done.stderr).strip()[-2000:]}"
        )
    alarms = {
        Alarm(file, int(line), " ".join(text.split())): None for file, line, text in _ALARM.findall(said)
    }
    counted = re.search(r"(\d+) alarms? generated by the analysis", said)
    if counted is None or (int(counted[1]) > 0) != bool(alarms):
        raise UserError(f"frama-c's summary was not understood:\n{said[-1000:]}")
    statuses = dict(_REACHED.findall(said))
    if not alarms and "0" not in [status.strip() for status in statuses.get("step", "").split(";")]:
        raise UserError(f"frama-c found no way through a step of {name}: {statuses or said[-500:]}")
    reached = re.search(r"(\d+ statements reached \(out of \d+\))", said)
    return tuple(alarms), reached[1] if reached else ""

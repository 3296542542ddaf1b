"""A step of the emitted C beside one that somebody has written by hand, on arms that fall.

    python benchmarks/hand_written.py --update

`peers/hand_written.c` is the same step by the same kind of sweep, without any check. Both by gcc -O3 -march=native,
by turns, thread time, ratios within a round, their median. `--update` writes the table into docs/planar.md.
"""

from __future__ import annotations

import argparse
import ctypes
import statistics
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from peers.joint_arm import pointer
from support.marks import renewed
from time_to_error import FLAGS, USUAL, arm

from tmm_gen.files import write_whole
from tmm_gen.native import compile_kernel
from tmm_gen.native.compiler import compile_library
from tmm_gen.program.build import build_program
from tmm_gen.scene import Scene

Array = NDArray[np.float64]

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "planar.md"
SOURCE = Path(__file__).with_name("peers") / "hand_written.c"
LINKS = (10, 50)
ROUNDS = 41
_STEPS = 2000


class _Arm(ctypes.Structure):
    _fields_ = [
        (name, ctypes.c_double)
        for name in ("length", "mass", "inertia", "stiffness", "damping", "gravity", "tip", "step")
    ]


@dataclass(frozen=True)
class Motion:
    """Angles, rates and accelerations of the links, changed in place."""

    angles: Array
    rates: Array
    accelerations: Array


class HandWritten:
    """The step somebody has written.

    Parameters
    ----------
    scene : Scene
        A clamped arm of :func:`time_to_error.arm`.
    """

    def __init__(self, scene: Scene) -> None:
        link, joint = scene.links[0], scene.joints[0]
        numbers = (link.length, link.mass, link.inertia, joint.stiffness, joint.damping)
        self._arm = _Arm(*numbers, scene.model.gravity, USUAL.tip, scene.integrator.step)
        flags = (*FLAGS, f"-DLINKS={scene.stations}")
        self._handle = ctypes.CDLL(str(compile_library({"hand.c": SOURCE.read_text()}, "gcc", flags)))
        self._handle.hand_seconds.restype = ctypes.c_double

    def advance(self, motion: Motion, steps: int) -> float:
        """Take so many steps; return the seconds they took."""
        arrays = map(pointer, (motion.angles, motion.rates, motion.accelerations))
        return float(self._handle.hand_seconds(ctypes.byref(self._arm), *arrays, ctypes.c_long(steps)))


def started(scene: Scene) -> Motion:
    """Return a motion that begins where the kernel's does."""
    kernel = compile_kernel(build_program(scene), scene, flags=FLAGS)
    kernel.prepare()
    kernel.initialise()
    state = kernel.state
    return Motion(*(np.array(state[name], float) for name in ("angle", "rate", "acceleration")))


def measured(links: int, rounds: int) -> tuple[float, float, float]:
    """Return nanoseconds of a step by hand per link, and ratios of the small and of the fast emitted code to it."""
    scenes = [arm("gravity", links, "newmark", "1", favour) for favour in ("size", "speed")]
    timers = [compile_kernel(build_program(scene), scene, flags=FLAGS).timer() for scene in scenes]
    by_hand = HandWritten(scenes[0])
    times = []
    for _ in range(rounds):
        motion = started(scenes[0])
        times.append((1e9 / _STEPS * by_hand.advance(motion, _STEPS), *(timer() for timer in timers)))
    small, fast = (statistics.median(row[k] / row[0] for row in times) for k in (1, 2))
    return statistics.median(row[0] for row in times) / links, small, fast


def main() -> None:
    """Measure and print, and write the page."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--rounds", type=int, default=ROUNDS)
    parser.add_argument("--update", action="store_true", help="write the table into docs/planar.md")
    given = parser.parse_args()
    lines = ["| links | by hand, ns per link and step | small code | fast code |", "|---:|---:|---:|---:|"]
    for links in LINKS:
        ns, small, fast = measured(links, given.rounds)
        lines.append(f"| {links} | {ns:.0f} | {small:.2f} | {fast:.2f} |")
        print(lines[-1], flush=True)
    if given.update:
        write_whole(PAGE, renewed(PAGE.read_text(), "\n".join(lines), "hand_written.py"))
        print(f"updated {PAGE}")


if __name__ == "__main__":
    main()

"""What sweeps and corrections of planar arms are worth: time to an accuracy, for Newmark and sdirk4.

    python benchmarks/corrections.py --update

Two arms of 1 m, 1 kg/m and a first clamped frequency of 2 Hz, springs EI/l at every joint, damped in 2 ms: one let go
horizontally with 0.4 kg at its tip, one on a hub of 0.1 kg m^2 that a motor turns to and, from half a second, fro.
The error is the largest of the tip at 0.1, 0.2 ... 1 s, against sdirk4 with two sweeps at 5000 steps a second. A way's
time is that of the fewest steps that keep an accuracy, by the thread's clock, in turns with the others; ratios to
Newmark's with one sweep are formed within a round, then their median is taken. Where the torque turns round, Newmark's
two steps that share the instant take the mean of both. `--update` writes the table into docs/planar.md.
"""

from __future__ import annotations

import argparse
import math
import statistics
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from support.marks import renewed

from tmm_gen.errors import UserError
from tmm_gen.files import write_whole
from tmm_gen.native import NativeKernel, compile_kernel
from tmm_gen.program.build import build_program
from tmm_gen.program.count import count_routine
from tmm_gen.scene import parse_scene

Array = NDArray[np.float64]

PAGE = Path(__file__).resolve().parents[1] / "docs" / "planar.md"
RATES = (20, 30, 40, 60, 80, 120, 160, 240, 320, 480, 640, 960, 1280, 1920, 2560)
"""Steps a second that are tried: a tenth of a second is a whole number of them."""
FINEST = 5000
BOUNDS = (1e-2, 1e-3, 1e-5)
"""Errors of the tip, m."""
LINKS = (10, 50)
WAYS = {
    "newmark, one sweep": ("newmark", 1, 0),
    "newmark, two sweeps": ("newmark", 2, 0),
    "newmark, one sweep and one correction": ("newmark", 1, 1),
    "newmark, one sweep and two corrections": ("newmark", 1, 2),
    "sdirk4, one sweep": ("sdirk4", 1, 0),
    "sdirk4, two sweeps": ("sdirk4", 2, 0),
    "sdirk4, one sweep and one correction": ("sdirk4", 1, 1),
}
FIRST = next(iter(WAYS))
FIRST_ROOT = 1.875104068711961
"""Of 1 + cos x cosh x: the first bending mode of a clamped beam."""
STIFFNESS = (2.0 * math.pi * 2.0 / FIRST_ROOT**2) ** 2

ARM = """
name = "arm"
[model]
kind = "planar"
iterations = {iterations}
corrections = {corrections}
{gravity}
[integrator]
name = "{integrator}"
step = 1e-3
[base]
{base}
[beam]
length = 1.0
bending_stiffness = {stiffness!r}
mass_per_length = 1.0
links = {links}
springs = "uniform"
damping_time = 0.002
{more}
[[output]]
name = "tip"
at = "tip"
of = "position"
"""


@dataclass(frozen=True)
class Arm:
    """An arm and what acts on it.

    Parameters
    ----------
    gravity, base, more : str
        What differs in its scene.
    torque : float
        Of the motor, N m.
    """

    gravity: str
    base: str
    more: str
    torque: float = 0.0

    def kernel(self, links: int, integrator: str, iterations: int, corrections: int) -> NativeKernel:
        """Compile its kernel."""
        text = ARM.format(
            gravity=self.gravity,
            base=self.base,
            more=self.more,
            stiffness=STIFFNESS,
            links=links,
            integrator=integrator,
            iterations=iterations,
            corrections=corrections,
        )
        scene = parse_scene(text)
        return compile_kernel(build_program(scene), scene)

    def tips(self, kernel: NativeKernel, rate: int) -> Array:
        """Return the tip's places at ten instants of a second, shape (2, 10)."""
        shared = len(kernel.program.stage_instants[-1]) == 1

        def torque(time: float) -> float:
            if abs(time - 0.5) < 1e-9:
                return 0.0 if shared else self.torque
            return self.torque if time < 0.5 else -self.torque

        signals = {"torque": torque} if self.torque else {}
        _, outputs = kernel.simulate(1.0, signals, step=1.0 / rate)
        return np.array([outputs[name][rate // 10 :: rate // 10] for name in ("tip_x", "tip_y")])


ARMS = {
    "gravity": Arm("gravity = 9.81", 'kind = "clamp"', "[tip]\nmass = 0.4"),
    "motor": Arm(
        "",
        'kind = "motor"\ninertia = 0.1',
        '[[input]]\nname = "torque"\nat = "base"\nacts = "torque"',
        4.0 * (0.1 + 1.0 / 3.0),
    ),
}


def errors(arm: Arm, kernel: NativeKernel, exact: Array) -> dict[int, float]:
    """Return the error at each number of steps a second; infinite where a step fails."""
    found = {}
    for rate in RATES:
        try:
            off = arm.tips(kernel, rate) - exact
            found[rate] = float(np.max(np.hypot(*off)))
        except (UserError, ArithmeticError, ValueError):
            found[rate] = math.inf
    return found


def fewest(found: dict[int, float], bound: float) -> float:
    """Return the fewest steps a second from which on all keep a bound."""
    good = math.inf
    for rate in reversed(RATES):
        if not found[rate] <= bound:
            break
        good = rate
    return good


@dataclass(frozen=True)
class Way:
    """What a way of solving costs.

    Parameters
    ----------
    operations, time : float
        Of a step, over those of the first way.
    steps : list of float
        Fewest steps a second to each bound.
    """

    operations: float
    time: float
    steps: list[float]


def measured(arm: Arm, links: int, rounds: int) -> dict[str, Way]:
    """Measure all ways."""
    exact = arm.tips(arm.kernel(links, "sdirk4", 2, 0), FINEST)
    kernels = {way: arm.kernel(links, *counts) for way, counts in WAYS.items()}
    steps = {}
    for way, kernel in kernels.items():
        off = errors(arm, kernel, exact)
        steps[way] = [fewest(off, bound) for bound in BOUNDS]
    timers = {way: kernel.timer() for way, kernel in kernels.items()}
    times = [{way: timer() for way, timer in timers.items()} for _ in range(rounds)]
    operations = {way: count_routine(kernel.program.main).total for way, kernel in kernels.items()}
    return {
        way: Way(
            operations[way] / operations[FIRST],
            statistics.median(each[way] / each[FIRST] for each in times),
            steps[way],
        )
        for way in WAYS
    }


def table_of(name: str, links: int, found: dict[str, Way]) -> str:
    """Return a table: what each way takes to each bound, over what the first takes."""
    bounds = " | ".join(f"steps/s to {bound:g} m | time" for bound in BOUNDS)
    rows = [
        f"| {name}, {links} links | operations | time a step | {bounds} |",
        "|---" * (3 + 2 * len(BOUNDS)) + "|",
    ]
    for label, way in found.items():
        cells = [label, f"{way.operations:.2f}", f"{way.time:.2f}"]
        for own, first in zip(way.steps, found[FIRST].steps, strict=True):
            cells += [f"{own:g}" if own < math.inf else "-"]
            cells += [f"{way.time * own / first:.2f}" if max(own, first) < math.inf else "-"]
        rows.append(f"| {' | '.join(cells)} |")
    return "\n".join(rows)


def main() -> None:
    """Measure, print, and renew the page."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--rounds", type=int, default=15)
    parser.add_argument("--update", action="store_true", help="write the tables into docs/planar.md")
    given = parser.parse_args()
    tables = []
    for name, arm in ARMS.items():
        for links in LINKS:
            tables.append(table_of(name, links, measured(arm, links, given.rounds)))
            print(tables[-1], flush=True)
    if given.update:
        write_whole(PAGE, renewed(PAGE.read_text(), "\n\n".join(tables), Path(__file__).name))


if __name__ == "__main__":
    main()

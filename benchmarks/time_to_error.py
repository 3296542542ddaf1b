"""Time to an error: kernels of coupled and of other stages on arms under gravity and under a motor, in one run.

    python benchmarks/time_to_error.py --links 10 50

Arms of 1 m and 1 kg with a first clamped frequency of 2 Hz and a damping time of 2 ms, cut into links with a spring at
every joint. Gravity: clamped, 0.4 kg at the tip, let go horizontally. Motor: a hub of 0.1 kg m^2 under a torque that
swings the arm for half a second and takes the swing back. Error: the largest of the tip's place at 0.1, 0.2 ... 1 s
against Lagrange's equations. For each integrator the fewest steps with the wanted error are sought, and the time of
that run is taken in turns with the others (thread time, median of ratios; gcc -O3 -march=native,
own sines, `favour = "speed"`).
"""

from __future__ import annotations

import argparse
import math
import statistics
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tmm_gen.native import NativeKernel, compile_kernel
from tmm_gen.native.recording import record
from tmm_gen.program.build import build_program
from tmm_gen.reference.planar_reference import planar_response
from tmm_gen.scene import Scene, parse_scene

Array = NDArray[np.float64]

INTEGRATORS = ("sdirk4", "radau2", "radau3", "gauss2", "gauss3", "newmark")
BESIDE = "sdirk4"
"""What others are compared with."""
CHECKPOINTS = 0.1 * np.arange(1, 11)
ROUNDS = 15
MOST_STEPS = 40_000
FLAGS = ("-O3", "-march=native")
FIRST_CLAMPED = 1.8751040687119611
"""Root of ``cos x cosh x = -1``."""

ARM = """
name = "arm"
model = {{ kind = "planar", gravity = {gravity}, iterations = {iterations} }}
integrator = {{ name = "{integrator}", step = 1e-3 }}
emit = {{ backends = ["c"], trigonometry = "own", favour = "{favour}" }}
base = {base}
{tip}
[[joint]]
stiffness = {stiffness!r}
damping = {damping!r}
repeat = {links}
[[link]]
length = {length!r}
mass = {mass!r}
inertia = {inertia!r}
repeat = {links}
{motor}
[[output]]
name = "tip"
at = "tip"
of = "position"
"""
MOTOR = '[[input]]\nname = "motor"\nat = "base"\nacts = "torque"'


def arm(kind: str, links: int, integrator: str, iterations: str = '"auto"', favour: str = "speed") -> Scene:
    """Return a scene under "gravity" or under a "motor"."""
    bending = (2.0 * math.pi * 2.0 / FIRST_CLAMPED**2) ** 2
    length, stiffness = 1.0 / links, bending * links
    falls = kind == "gravity"
    text = ARM.format(
        gravity="9.81" if falls else "0.0",
        iterations=iterations,
        integrator=integrator,
        favour=favour,
        base='{ kind = "clamp" }' if falls else '{ kind = "motor", inertia = 0.1 }',
        tip="tip = { mass = 0.4 }" if falls else "",
        stiffness=stiffness,
        damping=2e-3 * stiffness,
        links=links,
        length=length,
        mass=length,
        inertia=length**3 / 12.0,
        motor="" if falls else MOTOR,
    )
    return parse_scene(text.replace("gravity = 0.0, ", ""))


@dataclass(frozen=True)
class Swing:
    """A torque that changes its sign once.

    Parameters
    ----------
    size : float
        N m.
    until : float
        s.
    """

    size: float = 4.0 * (0.1 + 1.0 / 3.0)
    until: float = 0.5

    @property
    def knots(self) -> Array:
        """Where it changes."""
        return np.array([self.until])

    @property
    def ends(self) -> float:
        """It stays from there on."""
        return self.until

    def at(self, time: ArrayLike) -> Array:
        """Return values."""
        return np.where(np.asarray(time, float) < self.until, self.size, -self.size)

    def slope(self, time: ArrayLike) -> Array:
        """Return zeros."""
        return np.zeros(np.shape(time))

    curvature = slope


@dataclass(frozen=True)
class Run:
    """A kernel on its arm.

    Parameters
    ----------
    kernel : NativeKernel
    torques : Swing or None
    exact : array, (10, 2)
        The tip at the checkpoints, m.
    """

    kernel: NativeKernel
    torques: Swing | None
    exact: Array

    def prepared(self, per_interval: int) -> Callable[[], Array]:
        """Return what takes one second in so many steps between checkpoints, and yields the tip after each step."""
        steps, h = 10 * per_interval, 0.1 / per_interval
        self.kernel.prepare(step=h)
        stages = len(self.kernel.program.stage_instants[-1])
        inputs: dict[str, Array] = {}
        if self.torques is not None:
            # a torque that changes between steps is one value all through a step
            values = self.torques.at(h * (np.arange(steps) + 0.5))
            inputs["motor"] = values if stages == 1 else np.repeat(values[:, None], stages, axis=1)
        first = {name: float(values.flat[0]) for name, values in inputs.items()}

        def run() -> Array:
            self.kernel.initialise(first)
            found = record(self.kernel, inputs, steps)
            if found.failed is not None:
                return np.full((steps, 2), np.inf)
            return np.column_stack([found.outputs["tip_x"], found.outputs["tip_y"]])

        return run

    def error(self, per_interval: int) -> float:
        """Return the largest error at the checkpoints, m."""
        places = self.prepared(per_interval)()[per_interval - 1 :: per_interval]
        return float(np.max(np.linalg.norm(places - self.exact, axis=1)))

    def fewest(self, wanted: float) -> int | None:
        """Return the fewest steps between checkpoints with a wanted error."""
        low, high = 0, 1
        while not self.error(high) <= wanted:
            low, high = high, 2 * high
            if 10 * high > MOST_STEPS:
                return None
        while high - low > max(1, high // 100):
            middle = (low + high) // 2
            low, high = (low, middle) if self.error(middle) <= wanted else (middle, high)
        return high

    def timer(self, per_interval: int) -> Callable[[], float]:
        """Return what measures the steps of one second, s of this thread.

        The arm moves on and on, under a small torque where there is one: steps of any length cost the same.
        """
        measured = self.kernel.timer({} if self.torques is None else {"motor": 0.05})
        return lambda: measured() * 10 * per_interval * 1e-9


def measure(kind: str, links: int, integrators: tuple[str, ...], wanted: float) -> list[dict[str, object]]:
    """Return one row for each integrator."""
    signal = None if kind == "gravity" else Swing()
    scene = arm(kind, links, BESIDE)
    given = {} if signal is None else {"motor": signal}
    response = planar_response(scene, given, np.concatenate([[0.0], CHECKPOINTS]))
    exact = np.column_stack([response["tip_x"], response["tip_y"]])[1:]
    runs = {}
    for name in integrators:
        named = arm(kind, links, name)
        runs[name] = Run(compile_kernel(build_program(named), named, flags=FLAGS), signal, exact)
    fewest = {name: run.fewest(wanted) for name, run in runs.items()}
    timers = {name: runs[name].timer(count) for name, count in fewest.items() if count is not None}
    times: dict[str, list[float]] = {name: [] for name in timers}
    for _ in range(ROUNDS):
        for name, timer in timers.items():
            times[name].append(timer())
    rows: list[dict[str, object]] = []
    for name, count in fewest.items():
        if count is None:
            rows.append({"arm": f"{kind} {links}", "integrator": name, "steps": "-"})
            continue
        ratio = statistics.median(a / b for a, b in zip(times[name], times[BESIDE], strict=True))
        seconds = statistics.median(times[name])
        rows.append(
            {
                "arm": f"{kind} {links}",
                "integrator": name,
                "steps": 10 * count,
                "error": f"{runs[name].error(count):.1e}",
                "ms": f"{1e3 * seconds:.3f}",
                "ns per link and step": f"{1e9 * seconds / (10 * count * links):.1f}",
                f"time / {BESIDE}": f"{ratio:.2f}",
            }
        )
    return rows


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--links", type=int, nargs="+", default=[10, 50])
    parser.add_argument("--error", type=float, default=1e-6, help="of the tip, m")
    parser.add_argument("--integrators", nargs="+", default=list(INTEGRATORS))
    options = parser.parse_args()
    names = tuple(dict.fromkeys([BESIDE, *options.integrators]))
    rows = [
        row
        for kind in ("gravity", "motor")
        for links in options.links
        for row in measure(kind, links, names, options.error)
    ]
    keys = list(rows[0])
    print("| " + " | ".join(keys) + " |\n|" + "---|" * len(keys))
    for row in rows:
        print("| " + " | ".join(str(row.get(key, "-")) for key in keys) + " |")


if __name__ == "__main__":
    main()

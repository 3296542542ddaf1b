"""Time to an error: kernels of coupled and of other stages on arms under gravity and under a motor, in one run.

    python benchmarks/time_to_error.py --links 10 50
    python benchmarks/time_to_error.py --update

Arms of 1 m and 1 kg with a first clamped frequency of 2 Hz and a damping time of 2 ms, cut into links with a spring at
every joint. Gravity: clamped, 0.4 kg at the tip, let go horizontally. Motor: a hub of 0.1 kg m^2 under a torque that
swings the arm for half a second and takes the swing back. Error: the largest of the tip's place at 0.1, 0.2 ... 1 s
against Lagrange's equations. For each integrator the fewest steps with the wanted error are sought, and the time of
that run is taken in turns with the others (thread time, median of ratios; gcc -O3 -march=native,
own sines, `favour = "speed"`). `--peers` puts beside them what CasADi writes in C for articulated bodies, with a step
of Newmark's (generalised-alpha that damps nothing) and one of Runge and Kutta's about it; `--held-out` takes arms that
nothing was ever chosen by. `gauss3:1` asks for `gauss3` with one iteration a step. `--update` writes what the best of
`radau3` and `gauss3:1` takes beside them on all arms into docs/integrators.md.
"""

from __future__ import annotations

import argparse
import math
import statistics
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray
from support.marks import renewed

from tmm_gen.files import write_whole
from tmm_gen.native import NativeKernel, compile_kernel
from tmm_gen.native.recording import record
from tmm_gen.program.build import build_program
from tmm_gen.reference.planar_reference import planar_response
from tmm_gen.scene import Scene, parse_scene

Array = NDArray[np.float64]

INTEGRATORS = ("sdirk4", "radau2", "radau3", "gauss2", "gauss3", "newmark")
OURS = ("radau3", "gauss3:1")
"""Of which the page has the quicker one."""
BESIDE = "sdirk4"
"""What others are compared with."""
ALL_LINKS = (2, 5, 10, 20, 50, 100)
ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "integrators.md"
CHECKPOINTS = 0.1 * np.arange(1, 11, dtype=float)
ROUNDS = 15
MOST_STEPS = 40_000
FLAGS = ("-O3", "-march=native", "-ffp-contract=fast")
"""As gcc itself takes -O3 -march=native without a standard to keep to, and as peers are compiled."""
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


@dataclass(frozen=True)
class Make:
    """What an arm is like, of 1 m and 1 kg.

    Parameters
    ----------
    frequency : float
        The first one if its base is clamped, Hz.
    damping : float
        Damping over stiffness of its joints, s.
    tip, hub : float
        Under gravity, kg; with a motor, kg m^2.
    """

    frequency: float = 2.0
    damping: float = 2e-3
    tip: float = 0.4
    hub: float = 0.1


USUAL = Make()
HELD_OUT = (
    ("gravity", 16, Make(frequency=3.3, damping=7e-4, tip=0.15)),
    ("gravity", 35, Make(frequency=1.4, damping=5e-3, tip=0.9)),
    ("motor", 8, Make(frequency=4.1, damping=1e-3, hub=0.03)),
    ("motor", 64, Make(frequency=1.7, damping=3e-3, hub=0.5)),
)
"""Drawn when all was settled, to see whether anything had been fitted to the arms above."""


def arm(
    kind: str,
    links: int,
    integrator: str,
    iterations: str = '"auto"',
    favour: str = "speed",
    make: Make = USUAL,
) -> Scene:
    """Return a scene under "gravity" or under a "motor"."""
    bending = (2.0 * math.pi * make.frequency / FIRST_CLAMPED**2) ** 2
    length, stiffness = 1.0 / links, bending * links
    falls = kind == "gravity"
    text = ARM.format(
        gravity="9.81" if falls else "0.0",
        iterations=iterations,
        integrator=integrator,
        favour=favour,
        base='{ kind = "clamp" }' if falls else f'{{ kind = "motor", inertia = {make.hub!r} }}',
        tip=f"tip = {{ mass = {make.tip!r} }}" if falls else "",
        stiffness=stiffness,
        damping=make.damping * stiffness,
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

    size: float = 4.0 * (USUAL.hub + 1.0 / 3.0)
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

    def timer(self, per_interval: int) -> Callable[[], float]:
        """Return what measures the steps of one second, s of this thread.

        The arm moves on and on, under a small torque where there is one: steps of any length cost the same.
        """
        measured = self.kernel.timer({} if self.torques is None else {"motor": 0.05})
        return lambda: measured() * 10 * per_interval * 1e-9


class Stepping(Protocol):
    """Somebody's steps of equal length."""

    def error(self, per_interval: int) -> float:
        """Return the largest error at the checkpoints, m, with so many steps between them."""
        ...

    def timer(self, per_interval: int) -> Callable[[], float]:
        """Return what measures the steps of one second, s of this thread."""
        ...


def fewest(steps: Stepping, wanted: float) -> int | None:
    """Return the fewest steps between checkpoints with a wanted error."""
    low, high = 0, 1
    while not steps.error(high) <= wanted:
        low, high = high, 2 * high
        if 10 * high > MOST_STEPS:
            return None
    while high - low > max(1, high // 100):
        middle = (low + high) // 2
        low, high = (low, middle) if steps.error(middle) <= wanted else (middle, high)
    return high


def peers(scene: Scene, signal: Swing | None, exact: Array) -> dict[str, Stepping]:
    """Return steps about what CasADi writes for articulated bodies, by name."""
    from peers.any_step import AnyStep
    from peers.articulated import step_function
    from peers.joint_arm import joint_arm
    from peers.planar_solvers import rk4_function

    jointed = joint_arm(scene)

    def torque(time: float) -> Array:
        return np.zeros(0) if signal is None else np.array([signal.at(time)], float)

    return {
        "peer: Newmark": AnyStep(jointed, torque, step_function, 3, exact),
        "peer: RK4": AnyStep(jointed, torque, rk4_function, 2, exact),
    }


def measure(
    kind: str, links: int, integrators: tuple[str, ...], wanted: float, make: Make, *, beside_peers: bool
) -> list[dict[str, object]]:
    """Return one row for each integrator."""
    signal = None if kind == "gravity" else Swing(4.0 * (make.hub + 1.0 / 3.0))
    scene = arm(kind, links, BESIDE, make=make)
    given = {} if signal is None else {"motor": signal}
    response = planar_response(scene, given, np.concatenate([[0.0], CHECKPOINTS]))
    exact = np.column_stack([response["tip_x"], response["tip_y"]])[1:]
    runs: dict[str, Stepping] = {}
    for name in integrators:
        method, _, iterations = name.partition(":")
        named = arm(kind, links, method, iterations or '"auto"', make=make)
        runs[name] = Run(compile_kernel(build_program(named), named, flags=FLAGS), signal, exact)
    if beside_peers:
        runs |= peers(scene, signal, exact)
    counts = {name: fewest(run, wanted) for name, run in runs.items()}
    timers = {name: runs[name].timer(count) for name, count in counts.items() if count is not None}
    times: dict[str, list[float]] = {name: [] for name in timers}
    for _ in range(ROUNDS):
        for name, timer in timers.items():
            times[name].append(timer())
    best = min(
        (
            (statistics.median(t), name)
            for name, t in times.items()
            if name.startswith("peer") == beside_peers
        ),
        default=(math.nan, "none"),
    )
    rows: list[dict[str, object]] = []
    for name, count in counts.items():
        row: dict[str, object] = {"arm": f"{kind} {links}", "integrator": name, "steps": "-"}
        rows.append(row)
        if count is None:
            continue
        seconds = statistics.median(times[name])
        row |= {
            "steps": 10 * count,
            "error": f"{runs[name].error(count):.1e}",
            "ms": f"{1e3 * seconds:.3f}",
            "ns per link and step": f"{1e9 * seconds / (10 * count * links):.1f}",
            f"time / {BESIDE}": _over(times[name], times[BESIDE]),
        }
        if beside_peers:
            row["time / best peer"] = _over(times[name], times[best[1]])
    return rows


def _over(times: list[float], others: list[float]) -> str:
    return f"{statistics.median(a / b for a, b in zip(times, others, strict=True)):.3f}"


def beside(rows: Sequence[dict[str, object]], words: str) -> str:
    """Return a line of the page: what the quicker of ours takes on an arm, and who is the best of the others."""
    named, key = {str(row["integrator"]): row for row in rows}, "time / best peer"
    (best,) = (name for name, row in named.items() if row.get(key) == "1.000")
    name = min((name for name in OURS if key in named[name]), key=lambda name: float(str(named[name][key])))
    ours, (method, _, iterations) = named[name], name.partition(":")
    counted = {"": "", "1": ", 1 iteration"}[iterations]
    steps = f"{ours['steps']} ({named[BESIDE]['steps']}, {named[best]['steps']})"
    peer = best.removeprefix("peer: ")
    times = f"{ours['ms']} | {ours[f'time / {BESIDE}']} | {named['radau3'][key]} | {ours[key]}"
    return f"| {words} | `{method}`{counted} | {steps} | {times} | {peer} |"


def update() -> None:
    """Measure all arms beside peers, and write the page."""
    arms = [(kind, links, USUAL) for kind in ("gravity", "motor") for links in ALL_LINKS]
    lines = [
        f"| arm, links | ours | steps (`{BESIDE}`, best peer) | ms | over `{BESIDE}` | `radau3` over best peer "
        "| ours over best peer | who |",
        "|---|---|---|---:|---:|---:|---:|---|",
    ]
    for kind, links, make in (*arms, *HELD_OUT):
        rows = measure(kind, links, (BESIDE, *OURS), 1e-6, make, beside_peers=True)
        lines.append(beside(rows, f"{kind}, {links}" if make == USUAL else f"held out: {kind}, {links}"))
        print(lines[-1], flush=True)
    write_whole(PAGE, renewed(PAGE.read_text(), "\n".join(lines), "time_to_error.py"))
    print(f"updated {PAGE}")


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--links", type=int, nargs="+", default=[10, 50])
    parser.add_argument("--error", type=float, default=1e-6, help="of the tip, m")
    parser.add_argument("--integrators", nargs="+", default=list(INTEGRATORS))
    parser.add_argument("--kinds", nargs="+", default=["gravity", "motor"])
    parser.add_argument("--peers", action="store_true", help="beside other people's steps too")
    parser.add_argument("--held-out", action="store_true", help="arms that nothing was chosen by")
    parser.add_argument(
        "--update", action="store_true", help="write docs/integrators.md, whatever else is asked"
    )
    options = parser.parse_args()
    if options.update:
        update()
        return
    names = tuple(dict.fromkeys([BESIDE, *options.integrators]))
    usual = tuple((kind, links, USUAL) for kind in options.kinds for links in options.links)
    keys: list[str] = []
    for kind, links, make in HELD_OUT if options.held_out else usual:
        for row in measure(kind, links, names, options.error, make, beside_peers=options.peers):
            if not keys:
                keys = list(row)
                print("| " + " | ".join(keys) + " |\n|" + "---|" * len(keys))
            print("| " + " | ".join(str(row.get(key, "-")) for key in keys) + " |", flush=True)


if __name__ == "__main__":
    main()

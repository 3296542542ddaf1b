"""Random smooth plans of a prescribed base, given as tables with rows every 10 ms: how far rate and torque are off.

    python benchmarks/prescribed.py --plans 200

Each plan is a sum of smooth ways and sines of random size, length and frequency. Kernels run at 1 ms; the reference is
the plan itself and the exact response to it, by collocation of Lagrange's equations or of the chain's.
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tmm_gen.inputs.signals import Signal, Sine, Table
from tmm_gen.inputs.waveforms import Smooth
from tmm_gen.native import compile_kernel
from tmm_gen.native.series import Series
from tmm_gen.program.build import build_program
from tmm_gen.reference.reference import exact_response
from tmm_gen.scene import Scene, parse_scene
from tmm_gen.simulate.prescribed import kernel_signals

Array = NDArray[np.float64]

UNTIL, ROWS, STEP = 1.0, 1e-2, 1e-3
ARM = """
name = "told"
[model]
kind = "{kind}"
{iterations}
[integrator]
name = "newmark"
step = 1e-3
[base]
kind = "prescribed"
{links}
[[input]]
name = "turn"
at = "base"
acts = "angle"
[[output]]
name = "rate"
at = "base"
of = "{rate}"
[[output]]
name = "torque"
at = "base"
of = "torque"
"""
BEAM = (
    '[beam]\nlength = 1.0\nbending_stiffness = 3.2\nmass_per_length = 0.5\nlinks = 5\nsprings = "half-clamp"\n'
    "damping_time = 0.002"
)
CHAIN = "[[joint]]\nstiffness = 30.0\ndamping = 0.06\nrepeat = 5\n[[link]]\ninertia = 0.01\nrepeat = 5"
SCENES = {
    "planar": parse_scene(ARM.format(kind="planar", iterations="iterations = 2", links=BEAM, rate="rate")),
    "chain": parse_scene(ARM.format(kind="chain", iterations="", links=CHAIN, rate="velocity")),
}


@dataclass(frozen=True)
class Sum:
    """Several motions at once."""

    parts: tuple[Signal, ...]

    @property
    def knots(self) -> Array:
        """All knots."""
        return np.unique(np.concatenate([part.knots for part in self.parts]))

    @property
    def ends(self) -> float:
        """The last end."""
        return max(part.ends for part in self.parts)

    def at(self, time: ArrayLike) -> Array:
        """Return the sum of the values."""
        total: Array = np.sum([part.at(time) for part in self.parts], axis=0)
        return total

    def slope(self, time: ArrayLike) -> Array:
        """Return the sum of the rates."""
        total: Array = np.sum([part.slope(time) for part in self.parts], axis=0)
        return total

    def curvature(self, time: ArrayLike) -> Array:
        """Return the sum of the accelerations."""
        total: Array = np.sum([part.curvature(time) for part in self.parts], axis=0)
        return total


def plan(random: np.random.Generator) -> Sum:
    """Return a random plan that starts at zero."""
    ways = [
        Smooth(0.0, random.uniform(-1.5, 1.5), random.uniform(0.2, 0.6), random.uniform(0.0, 0.4))
        for _ in range(random.integers(1, 4))
    ]
    sines = [Sine(random.uniform(0.0, 0.3), random.uniform(1.0, 12.0)) for _ in range(random.integers(0, 3))]
    return Sum((*ways, *sines))


def errors(scene: Scene, kernel: Series, exact: dict[str, Array]) -> dict[str, float]:
    """Return the largest errors of a run, as shares of the largest values."""
    found = kernel.run()
    return {
        name: float(np.max(np.abs(found[name] - exact[name])) / np.max(np.abs(exact[name]))) for name in exact
    }


def main() -> None:
    """Measure and print."""
    options = argparse.ArgumentParser()
    options.add_argument("--plans", type=int, default=200)
    options.add_argument("--seed", type=int, default=0)
    asked = options.parse_args()
    steps = round(UNTIL / STEP)
    for kind, scene in SCENES.items():
        random = np.random.default_rng(asked.seed)
        kernel = compile_kernel(build_program(scene), scene)
        rows: list[tuple[float, ...]] = []
        for _ in range(asked.plans):
            whole = plan(random)
            times = np.arange(0.0, UNTIL + 0.5 * ROWS, ROWS)
            instants = STEP * np.arange(steps + 1, dtype=float)
            exact = exact_response(scene, {"turn": whole}, instants)
            row: list[float] = []
            for signal in (whole, Table(times, whole.at(times))):
                acting = {name: s.at for name, s in kernel_signals(scene, {"turn": signal}).items()}
                off = errors(scene, Series(kernel, acting, steps, STEP), exact)
                row += [off["rate"], off["torque"]]
            rows.append(tuple(row))
        worst, middle = np.max(rows, axis=0), np.median(rows, axis=0)
        for place, what in enumerate(("rate, plan", "torque, plan", "rate, table", "torque, table")):
            print(
                f"{kind:7s} {what:14s} worst {worst[place]:.1e}, median {middle[place]:.1e} of {asked.plans} plans"
            )


if __name__ == "__main__":
    main()

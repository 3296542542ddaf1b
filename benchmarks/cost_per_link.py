"""What a link costs: nanoseconds and operations per link and step of the emitted C, from 2 to 1000 links.

Newmark, one iteration, double. The growth exponent is the slope of log(time per step) over log(links).
"""

from __future__ import annotations

import argparse
import csv
import math
from pathlib import Path

from tmm_gen.native import compile_kernel
from tmm_gen.native.timing import by_turns
from tmm_gen.program.build import build_program
from tmm_gen.program.count import count_routine
from tmm_gen.scene import Scene, parse_scene

LINKS = (2, 5, 10, 20, 50, 100, 200, 500, 1000)


def arm(links: int) -> Scene:
    """Return a slender arm with a free hub and a tip mass."""
    return parse_scene(f"""
        name = "arm"
        [model]
        kind = "planar"
        gravity = 9.81
        [integrator]
        name = "newmark"
        step = 1e-4
        [base]
        kind = "motor"
        inertia = 0.05
        [beam]
        length = 1.0
        bending_stiffness = 12.0
        mass_per_length = 0.4
        links = {links}
        springs = "half-clamp"
        damping_time = 1e-3
        [tip]
        mass = 0.1
        [[input]]
        name = "hub_torque"
        at = "base"
        acts = "torque"
        [[output]]
        name = "tip"
        at = "tip"
        of = "position"
    """)


def measure(links: int) -> tuple[float, float]:
    """Return nanoseconds per step and operations per link, its share of the whole step."""
    scene = arm(links)
    program = build_program(scene)
    kernel = compile_kernel(program, scene)
    cost = by_turns({links: kernel.timer({"hub_torque": 0.0})})[links]
    return cost.ns_per_step, count_routine(program.main).total / links


def slope(times: dict[int, float]) -> float:
    """Return the least-squares slope of log time over log links."""
    xs = [math.log(n) for n in times]
    ys = [math.log(t) for t in times.values()]
    mx, my = sum(xs) / len(xs), sum(ys) / len(ys)
    return sum((x - mx) * (y - my) for x, y in zip(xs, ys, strict=True)) / sum((x - mx) ** 2 for x in xs)


def main() -> None:
    """Measure, print a table and write it as CSV."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("out/bench"))
    out = parser.parse_args().out
    out.mkdir(parents=True, exist_ok=True)
    times: dict[int, float] = {}
    rows = []
    print(f"{'links':>6} {'ns per step':>12} {'ns per link':>12} {'operations per link':>20}")
    for links in LINKS:
        nanoseconds, operations = measure(links)
        times[links] = nanoseconds
        rows.append((links, nanoseconds, nanoseconds / links, operations))
        print(f"{links:>6} {nanoseconds:>12.0f} {nanoseconds / links:>12.1f} {operations:>20.1f}")
    print(f"growth exponent from {LINKS[0]} to {LINKS[-1]} links: {slope(times):.3f}")
    with (out / "cost_per_link.csv").open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(("links", "ns_per_step", "ns_per_link", "operations_per_link"))
        writer.writerows(rows)


if __name__ == "__main__":
    main()

"""Try chains over the whole range of the usual and the unusual: right, refused, diverged as predicted, or wrong?

Links 1 to 100 000, ratios of stiffness and of inertia 1e-12 to 1e12, steps of 1e-9 to 10 first periods, both number
types, both sweeps: the grid with Newmark's integrator; with all others, draws at random (always the same ones); then
whole periods in up to ten million steps. Exits with 1 if anything is wrong. Planar arms: extremes_planar.py.
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import asdict
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
from extremes_of_chains.chains import WRONG, judge_all
from extremes_of_chains.endurance import ENDURED, endure
from extremes_of_chains.extreme import ChainExtreme
from extremes_of_chains.extremes_picture import extremes_picture

from tmm_gen.cli.console import Column, progress, table
from tmm_gen.csv_text import csv_text
from tmm_gen.files import write_whole
from tmm_gen.scene.integrator import METHODS

RATIOS = (1e-12, 1e-6, 1.0, 1e6, 1e12)
STEPS = (1e-9, 1e-6, 1e-3, 0.1, 1.0, 10.0)
KERNELS: tuple[dict[str, Any], ...] = tuple(
    {"real": real, "sweep": sweep, "unknown": unknown}
    for sweep, unknown in (("riccati", "acceleration"), ("riccati", "increment"), ("product", "acceleration"))
    for real in ("float64", "float32")
)
GRID: dict[int, tuple[tuple[float, ...], tuple[float, ...]]] = {
    1: ((1.0,), STEPS),
    2: (RATIOS, STEPS),
    3: (RATIOS, STEPS),
    10: (RATIOS, STEPS),
    100: (RATIOS, STEPS),
    1000: ((1e-12, 1.0, 1e12), STEPS),
    10_000: ((1.0, 1e6), (1e-9, 1e-3, 10.0)),
    100_000: ((1.0,), (1e-9, 1e-3, 10.0)),
}
"""By links: ratios of stiffness and of inertia, and steps. The longer the chain, the fewer."""


def grid(integrator: str = "newmark", most: int = 100_000) -> Iterator[ChainExtreme]:
    """Yield the extremes of the grid."""
    for links, (ratios, steps) in GRID.items():
        if links > most:
            continue
        for stiffness, inertia, step, kernel in product(ratios, ratios, steps, KERNELS):
            if links == 100_000 and kernel["unknown"] != "acceleration":
                continue  # each kernel of this length takes half a minute to compile
            yield ChainExtreme(
                links,
                stiffness,
                inertia,
                step,
                integrator=integrator,
                **kernel,
            )


def at_random(count: int) -> Iterator[ChainExtreme]:
    """Yield extremes drawn at random, as many for each integrator."""
    random = np.random.default_rng(0)
    for method in METHODS:
        for _ in range(count):
            kernel = KERNELS[random.integers(len(KERNELS))]
            if method.explicit_at == {}:
                kernel = {**kernel, "unknown": "acceleration"}
            if method.coupled:
                kernel = {**kernel, "unknown": "acceleration", "sweep": "riccati"}
            yield ChainExtreme(
                links=int(random.choice([1, 2, 3, 10, 30])),
                stiffness_ratio=float(10.0 ** random.uniform(-12, 12)),
                inertia_ratio=float(10.0 ** random.uniform(-12, 12)),
                step=float(10.0 ** random.uniform(-9, 1)),
                damping=float(random.choice([0.0, 1e-6, 1e-2, 1.0])),
                integrator=method.name,
                start=random.choice(["loaded", "released"]),
                pattern=random.choice(["halves", "alternating", "graded"]),
                **kernel,
            )


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--out", type=Path, default=Path("out/bench"))
    parser.add_argument("--random", type=int, default=60, help="how many draws for each integrator")
    parser.add_argument("--most", type=int, default=100_000, help="links of the longest chain")
    given = parser.parse_args()
    tried = [*grid(most=given.most), *at_random(given.random)]
    for name in ("zhou", "zhai"):
        tried += [e for e in grid(name, 10) if e.links == 10 and e.unknown == "acceleration"]
    rows, judged = [], []
    with progress("trying extremes", total=len(tried)) as advance:
        for extreme, verdict in judge_all(tried, lambda count: advance(count)):
            judged.append((extreme, verdict))
            rows.append({**asdict(extreme), **asdict(verdict)})
    show(rows)
    with progress("whole periods", total=len(ENDURED)) as advance:
        endured = [asdict(endure(each, lambda: advance(1))) for each in ENDURED]
    table(
        endured,
        ["links", "real", "unknown", "steps", Column("error", form=".1e"), "status"],
        title="a whole period, let go",
    )
    write_whole(given.out / "extremes.csv", csv_text(rows))
    write_whole(given.out / "extremes_periods.csv", csv_text(endured))
    write_whole(given.out / "extremes.png", extremes_picture(judged, KERNELS, STEPS))
    for name in ("extremes.csv", "extremes_periods.csv", "extremes.png"):
        print(f"wrote {given.out / name}")
    return int(any(row["status"] == WRONG for row in (*rows, *endured)))


def show(rows: list[dict[str, object]]) -> None:
    """Print how many extremes ended how, by kernel and by integrator, and all that are wrong."""
    for keys in (("real", "sweep", "unknown"), ("integrator",), ("links",)):
        counted = Counter((tuple(row[key] for key in keys), row["status"]) for row in rows)
        lines = [
            {**dict(zip(keys, group, strict=True)), **{s: counted[group, s] for s in statuses(rows)}}
            for group in dict.fromkeys(group for group, _ in counted)
        ]
        table(lines, [*keys, *statuses(rows)])
    for row in [row for row in rows if row["status"] == WRONG][:20]:
        print({key: value for key, value in row.items() if value != getattr(ChainExtreme(), key, None)})


def statuses(rows: list[dict[str, object]]) -> list[str]:
    """Return the statuses that occur, as text."""
    return [str(status) for status in dict.fromkeys(row["status"] for row in rows)]


if __name__ == "__main__":
    sys.exit(main())

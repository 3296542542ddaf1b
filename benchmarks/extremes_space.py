"""Try arms in space over the whole range of the usual and the unusual: right, refused or wrong?

Cells 1 to 500, EI and GJ over ten decades, thin to stubby, payloads to 1e4 times the arm's mass, steps of 1e-5 to 0.1
of the first period, rotation up to 100 revolutions per second: each alone, and combinations at random (the same ones
for a seed). Runs correct as often as it takes and divide steps that are too long. Exits with 1 if any is wrong: if its
error is more than five times what the run says.
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np
from extremes_of_arms.rods import Rod, judge

from tmm_gen.cli.console import Column, progress, table
from tmm_gen.csv_text import csv_text
from tmm_gen.files import write_whole

ALONE: dict[str, tuple[Any, ...]] = {
    "cells": (1, 2, 3, 5, 10, 20, 50, 100, 200, 500),
    "stiffness": tuple(10.0**k for k in range(-5, 6)),
    "across": (1e-2, 0.1, 1.0, 10.0, 100.0),
    "twist": tuple(10.0**k for k in range(-5, 6)),
    "radius": (1e-4, 1e-3, 1e-2, 0.1, 0.3),
    "payload": (1e-4, 1e-2, 1.0, 1e2, 1e4),
    "step": (1e-5, 1e-4, 1e-3, 1e-2, 0.1),
    "revolutions": (0.1, 1.0, 10.0, 100.0),
}
_FEW: dict[str, tuple[Any, ...]] = {
    **ALONE,
    "cells": (1, 2, 3, 5, 20),
    "revolutions": (0.0, 0.0, 0.1, 1.0, 10.0, 100.0),
}


def extremes(at_random: int, seed: int = 0) -> Iterator[Rod]:
    """Yield the extremes to try."""
    for name, values in ALONE.items():
        for value in values:
            yield Rod(**{name: value})
    random = np.random.default_rng(seed)
    for _ in range(at_random):
        yield Rod(**{name: values[random.integers(len(values))] for name, values in _FEW.items()})


def main() -> int:
    """Print what became of each."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--out", type=Path, default=Path("out/bench"))
    parser.add_argument("--random", type=int, default=200, help="how many combinations at random")
    parser.add_argument("--seed", type=int, default=0, help="of these combinations")
    parser.add_argument("--only-random", action="store_true", help="leave out what is extreme alone")
    parser.add_argument("--seconds", type=float, default=20.0, help="for a run, and for its reference")
    given = parser.parse_args()
    tried = list(extremes(given.random, given.seed))
    if given.only_random:
        tried = tried[len(tried) - given.random :]
    rows = []
    with progress("trying extremes", total=len(tried)) as advance:
        for rod in tried:
            rows.append({**asdict(rod), **asdict(judge(rod, given.seconds))})
            advance(1)
    columns: list[Column | str] = [
        *("cells", Column("stiffness", "EI", ".0e"), Column("across", form=".0e")),
        *(Column("twist", "GJ / EI", ".0e"), Column("radius", form=".0e")),
        *(Column("payload", "payload / arm", ".0e"), Column("step", "step / period", ".0e")),
        *(Column("revolutions", "rev/s", "g"), Column("status"), Column("error", form=".1e")),
        *(Column("accuracy", "says", ".1e"), Column("sweeps", form=".2g"), "substeps"),
        Column("said", form=lambda text: str(text).partition("\n")[0][:60]),
    ]
    counts = Counter(row["status"] for row in rows)
    table(rows, columns, title=", ".join(f"{count} {status}" for status, count in sorted(counts.items())))
    write_whole(given.out / "extremes_space.csv", csv_text(rows))
    print(f"wrote {given.out / 'extremes_space.csv'}")
    return int(counts["wrong"] > 0)


if __name__ == "__main__":
    sys.exit(main())

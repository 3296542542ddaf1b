"""Try planar arms over the whole range of the usual and the unusual: right, refused or wrong?

Links 1 to 1000, EI over ten decades, links of point mass to stubby, tip masses to 1e4 times the arm's, steps of 1e-6 to
0.1 of the first period, rotation up to 100 revolutions per second: each alone, and combinations at random (the same
ones for a seed). Runs sweep as often as it takes and divide steps that are too long. What is refused for its error is
judged at its own step too, as if it had not been. Exits with 1 if any is wrong: if its error is more than
five times what the run says.
"""

from __future__ import annotations

import argparse
import math
import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np
from extremes_of_arms.arms import Extreme, judge
from extremes_of_arms.verdict import Verdict

from tmm_gen.cli.console import Column, progress, table
from tmm_gen.csv_text import csv_text
from tmm_gen.files import write_whole

ALONE: dict[str, tuple[Any, ...]] = {
    "links": (1, 2, 3, 5, 10, 20, 50, 60, 100, 200, 500, 1000),
    "stiffness": tuple(10.0**k for k in range(-5, 6)),
    "slenderness": (1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0),
    "tip_ratio": (0.0, 1e-2, 1.0, 1e2, 1e4),
    "step": (1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1),
    "revolutions": (0.1, 1.0, 10.0, 100.0),
}

_FIGURES = (
    "error",
    "bound",
    "accuracy",
    "sensitivity",
    "sweeps",
    "unsolved",
    "step_error",
    "imbalance",
    "substeps",
)


def extremes(at_random: int, seed: int = 0) -> Iterator[Extreme]:
    """Yield the extremes to try."""
    for name, values in ALONE.items():
        for value in values:
            yield Extreme(**{name: value})
    random = np.random.default_rng(seed)
    few = {**ALONE, "links": (1, 2, 5, 20, 50), "revolutions": (0.0, 0.0, 0.1, 1.0, 10.0, 100.0)}
    for _ in range(at_random):
        drawn = {name: values[random.integers(len(values))] for name, values in few.items()}
        yield Extreme(**drawn)


def anyway(extreme: Extreme, verdict: Verdict, seconds: float) -> Verdict:
    """Return what an extreme refused for its error, or for what sweeps left, would have become at the scene's step."""
    judged = any(words in verdict.said for words in ("the error is", "left loads unsolved"))
    return judge(extreme, refuse=False, seconds=seconds) if judged else verdict


def cause(verdict: Verdict) -> str:
    """Say in a word what an extreme was refused for."""
    words = {"link starts at": "start", "the error is": "error", "left loads": "sweeps", "pivot": "pivot"}
    return next((short for text, short in words.items() if text in verdict.said), "other")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--out", type=Path, default=Path("out/bench"))
    parser.add_argument("--random", type=int, default=60, help="how many combinations at random")
    parser.add_argument("--seed", type=int, default=0, help="of these combinations")
    parser.add_argument("--only-random", action="store_true", help="leave out what is extreme alone")
    parser.add_argument("--skip", type=int, default=0, help="leave out so many at the beginning of all")
    parser.add_argument("--seconds", type=float, default=math.inf, help="for a run, and for its reference")
    given = parser.parse_args()
    tried = list(extremes(given.random, given.seed))
    if given.only_random:
        tried = tried[len(tried) - given.random :]
    tried = tried[given.skip :]
    rows = []
    with progress("trying extremes", total=len(tried)) as advance:
        for extreme in tried:
            verdict = judge(extreme, seconds=given.seconds)
            real = anyway(extreme, verdict, given.seconds)
            found = {
                **asdict(verdict),
                **{name: getattr(real, name) for name in _FIGURES},
                "anyway": real.status,
            }
            rows.append(
                {**asdict(extreme), **found, "cause": cause(verdict) if verdict.status == "refused" else ""}
            )
            advance(1)
    columns: list[Column | str] = [
        *("links", Column("stiffness", "EI", ".0e"), Column("slenderness", form=".0e")),
        *(Column("tip_ratio", "tip / arm", ".0e"), Column("step", "step / period", ".0e")),
        *(Column("revolutions", "rev/s", "g"), Column("status"), Column("error", form=".1e")),
        *(
            Column("accuracy", "says", ".1e"),
            Column("unsolved", form=".1e"),
            Column("sweeps", form=".2g"),
            "substeps",
        ),
        *(Column("step_error", "step", ".1e"), "anyway", "cause"),
        Column("said", form=lambda text: str(text).partition("\n")[0][:60]),
    ]
    counts = Counter(row["status"] for row in rows)
    causes = Counter(row["cause"] for row in rows if row["cause"])
    said = ", ".join(f"{count} {status}" for status, count in sorted(counts.items()))
    more = ", ".join(f"{count} for {what}" for what, count in sorted(causes.items()))
    table(rows, columns, title=f"{said}; refused: {more}" if more else said)
    write_whole(given.out / "extremes_planar.csv", csv_text(rows))
    print(f"wrote {given.out / 'extremes_planar.csv'}")
    return int(counts["wrong"] > 0)


if __name__ == "__main__":
    sys.exit(main())

"""Emitted controllers whose sensors fail in every way for up to 50 samples in a row: do all come back?

    python benchmarks/controller_faults.py [--cases 2000] [--controller rti ...] [--real float64 ...] [--out out/bench]

Each case puts the arm at rest anywhere within half a turn either way, resets the controller, and gives it true samples,
then wrong ones (stuck, lost, not finite, absurd, off by turns, off by anything, each sensor for itself), then true ones
again for 10 s. Required is OK within one second, an arm that arrives (0.02 rad), and a torque that never leaves its
bounds. hypothesis draws the cases; exits with 1 if one fails.
"""

from __future__ import annotations

import argparse
import json
import math
import sys
from collections import Counter
from pathlib import Path

from faulty_loops.cases import Case, cases
from faulty_loops.drawing import outcomes_of
from faulty_loops.loop import FaultyLoop, Outcome

from tmm_gen.cli.console import plain, table
from tmm_gen.control.bench import Bench
from tmm_gen.files import write_whole
from tmm_gen.onboard.emit import EMITTED
from tmm_gen.scene import load_scene

ROOT = Path(__file__).resolve().parents[1]
WITHIN = 1.0
"""s, in which OK must return."""


def outcomes(loop: FaultyLoop, count: int, number: int = 0) -> list[tuple[Case, Outcome]]:
    """Run as many cases as are asked for."""
    return outcomes_of(cases(), loop.run, count, number)


def failed(outcome: Outcome) -> bool:
    """Return whether a case ended as none must."""
    return (
        outcome.recovery > WITHIN or bool(outcome.late) or math.isinf(outcome.arrival) or outcome.outside > 0
    )


def row(controller: str, real: str, found: list[tuple[Case, Outcome]]) -> dict[str, object]:
    """Return a row of the table."""
    statuses: Counter[str] = Counter()
    late: Counter[str] = Counter()
    for _, outcome in found:
        statuses.update(outcome.statuses)
        late.update(outcome.late)
    results = [outcome for _, outcome in found]
    return {
        "controller": controller,
        "real": real,
        "cases": len(found),
        "latched": sum(result.recovery > WITHIN for result in results),
        "not_ok_later": sum(bool(result.late) for result in results),
        "not_arrived": sum(math.isinf(result.arrival) for result in results),
        "out_of_bounds": sum(result.outside > 0 for result in results),
        "worst_ok_s": max(result.recovery for result in results),
        "worst_calm_s": max(result.calm for result in results),
        "worst_arrival_s": max(result.arrival for result in results),
        "statuses": dict(statuses),
        "late": dict(late),
    }


def main() -> int:
    """Print a table; return 1 if a case failed."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--cases", type=int, default=2000)
    parser.add_argument("--controller", action="append", choices=EMITTED)
    parser.add_argument("--real", action="append", choices=["float64", "float32"])
    parser.add_argument("--scene", type=Path, default=ROOT / "scenes" / "swing.toml")
    parser.add_argument("--out", type=Path, default=Path("out/bench"))
    asked = parser.parse_args()
    bench = Bench.of(load_scene(asked.scene))
    rows, bad = [], []
    for controller in asked.controller or EMITTED:
        for real in asked.real or ("float64", "float32"):
            found = outcomes(FaultyLoop(bench, controller, real), asked.cases)
            rows.append(row(controller, real, found))
            bad += [(controller, real, case, outcome) for case, outcome in found if failed(outcome)]
            print(rows[-1], file=sys.stderr, flush=True)
    table(rows, [key for key in rows[0] if key not in ("statuses", "late")])
    for each in bad[:20]:
        print(*each)
    asked.out.mkdir(parents=True, exist_ok=True)
    write_whole(asked.out / "controller_faults.json", json.dumps(plain(rows), indent=1) + "\n")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())

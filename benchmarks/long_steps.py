"""Try chains with steps from a thousandth of the first period to ten: is each run as right as it says, or refused?

All integrators, both number types, loads that are constant, harmonic or tables, compared with the matrix exponential.
Exits with 1 if any is wrong. Planar arms: extremes_planar.py.
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from dataclasses import asdict
from pathlib import Path

from extremes_of_chains.long_steps import judge, long_steps

from tmm_gen.cli.console import progress, table
from tmm_gen.csv_text import csv_text
from tmm_gen.files import write_whole


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--out", type=Path, default=Path("out/bench"))
    parser.add_argument("--count", type=int, default=3000, help="how many chains")
    parser.add_argument("--seed", type=int, default=0)
    given = parser.parse_args()
    rows: list[dict[str, object]] = []
    with progress("trying steps", total=given.count) as advance:
        for tried in long_steps(given.count, given.seed):
            outcome = judge(tried)
            rows.append(
                {
                    **asdict(tried.chain),
                    "periods": tried.periods,
                    "torque": repr(tried.torque),
                    **asdict(outcome),
                }
            )
            advance(1)
    counted = Counter((row["integrator"], row["status"]) for row in rows)
    table(
        [
            {
                "integrator": name,
                **{status: counted[name, status] for status in ("right", "refused", "wrong")},
            }
            for name in sorted({str(row["integrator"]) for row in rows})
        ],
        ["integrator", "right", "refused", "wrong"],
    )
    for row in [row for row in rows if row["status"] == "wrong"][:20]:
        print(row)
    total = Counter(row["status"] for row in rows)
    print(", ".join(f"{count} {status}" for status, count in sorted(total.items(), key=str)))
    write_whole(given.out / "long_steps.csv", csv_text(rows))
    return int(total["wrong"] > 0)


if __name__ == "__main__":
    sys.exit(main())

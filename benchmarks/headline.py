"""Reproduce the headline of Gholampour (2018): the proposed method settles in 3 s, the others in more than 10 s.

Prints the figures of docs/headline.md and draws docs/figures/headline.png (into --out).
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from thesis.headline_picture import headline_picture
from thesis.headline_response import OTHERS, STEPS, HeadlineRow, exact_settling_time, headline_rows

from tmm_gen.cli.console import Column, progress, table
from tmm_gen.csv_text import csv_text
from tmm_gen.files import write_whole


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--out", type=Path, default=Path("out/bench"))
    given = parser.parse_args()
    with progress("running the sample", total=len(STEPS)) as advance:
        found = headline_rows(advance=lambda: advance(1))
    rows = [flat(row) for row in found]
    columns = [Column(name, name.replace("_", " "), ".3g" if name == "step" else ".2f") for name in rows[0]]
    table(
        rows,
        columns,
        title=f"settles within 5 % after (s); the exact response: {exact_settling_time():.2f} s",
    )
    write_whole(given.out / "headline.csv", csv_text(rows))
    write_whole(given.out / "headline.png", headline_picture(found))
    for name in ("headline.csv", "headline.png"):
        print(f"wrote {given.out / name}")
    return 0


def flat(row: HeadlineRow) -> dict[str, object]:
    """Return settling times as one row of a table."""
    return {
        "step": row.step,
        "as_printed": row.printed.settling_time,
        "as_derived": row.derived.settling_time,
        **{name: row.others[name].settling_time for name in OTHERS},
        "times_lighter": row.lightness,
        "exact_of_lighter_arm": row.lighter_settling_time,
    }


if __name__ == "__main__":
    sys.exit(main())

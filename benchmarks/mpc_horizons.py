"""Whether condensing everything pays with long horizons: emitted C beside a solver that condenses nothing.

    python benchmarks/mpc_horizons.py [--out out/bench] [--update]

The arm of `mpc_space_speed.py` with 13 joints, beside its wall and without, and more and more samples of 20 ms looked
ahead. CasADi's sqpmethod with hpipm keeps the states of all stages as variables and factorises stage by stage, so that
its time grows with the number of samples; in ours all torques act on all later samples, and time grows with its square,
where the quadratic program is factorised with its third power. What condenses in part is between the two. Times and
ratios as in that benchmark. `--update` renews docs/mpc-speed.md.
"""

from __future__ import annotations

import argparse
import json
import os
from collections.abc import Sequence
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

from mpc_solvers.page import DERIVATIVES
from mpc_space_speed import PAGE, WALLED, Rows, measure
from support.marks import renewed

from tmm_gen.cli.console import plain, progress
from tmm_gen.files import write_whole

HORIZONS = (31, 46, 62, 93)
JOINTS, SAMPLES = 13, 40
SPARSE = "CasADi sqpmethod + hpipm, C"


def section(rows: Rows) -> str:
    """Return the page's table."""
    lines = [
        "| wall | samples ahead | `rti` (µs) | `rti-zero` (µs) | hpipm (µs) | hpipm over `rti` | over `rti-zero` |",
        "|---:|---:|---:|---:|---:|---:|---:|",
    ]
    cases = dict.fromkeys((bool(row["walled"]), int(str(row["horizon"]))) for row in rows)
    for walled, horizon in cases:
        found = {row["solver"]: row for row in rows if (row["walled"], row["horizon"]) == (walled, horizon)}
        times = [float(str(found[name]["median_us"])) for name in ("`rti`, C", "`rti-zero`, C", SPARSE)]
        ratios = [float(str(found[SPARSE][key])) for key in ("over_full", "over_zero")]
        cells = [*(f"{each:.0f}" for each in times), *(f"{each:.3g}" for each in ratios)]
        lines.append(f"| {'yes' if walled else 'no'} | {horizon} | {' | '.join(cells)} |")
    return "\n".join(lines)


def measured(horizons: Sequence[int]) -> Rows:
    """Return the rows of all horizons, with a wall and without."""
    found: Rows = []
    with progress("measuring", total=2 * len(horizons)) as advance:
        for walled in WALLED:
            for horizon in horizons:
                changes = {"control.horizon": horizon}
                rows = measure(JOINTS, walled, [SPARSE], SAMPLES, advance, judged=False, **changes)
                found += [{**row, "horizon": horizon} for row in rows if row["solver"] != DERIVATIVES]
    return found


def main() -> None:
    """Measure, print, keep, and renew the page if told to."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--horizons", type=int, nargs="*", default=HORIZONS)
    parser.add_argument("--out", type=Path, default=Path("out/bench"))
    parser.add_argument("--update", action="store_true", help=f"renew {PAGE.name}")
    given = parser.parse_args()
    rows = measured(given.horizons)
    print(section(rows))
    given.out.mkdir(parents=True, exist_ok=True)
    write_whole(given.out / "mpc_horizons.json", json.dumps(plain(rows), indent=1, allow_nan=False) + "\n")
    if given.update:
        write_whole(PAGE, renewed(PAGE.read_text(encoding="utf-8"), section(rows), Path(__file__).name))
        print(f"wrote {PAGE}")


if __name__ == "__main__":
    main()

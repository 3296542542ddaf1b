"""Closed loops of the swing: every controller under every condition, and 1000 drawn at random.

    python benchmarks/mpc_closed_loop.py [--seed 0] [--seeds 10] [--loops 1000] [--out out/bench] [--update]

What is shown of each controller and condition is the worst of ten noises. What can be emitted runs as compiled C;
real-time iteration, whose filter is another there, also as it is, with its extended Kalman filter. Full nonlinear MPC
gets one noise.

The random loops change payload, stiffness, friction, delay, noise and the initial motion, tighten bounds until
they cannot all be kept, and let sensors fail. No torque may be non-finite or out of its bounds; failures to settle
are counted. `--update` renews docs/mpc.md and its figure.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import sys
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

from support.marks import renewed
from support.mpc_random_loops import RandomOutcome, draw, run_case

from tmm_gen.cli.console import Column, plain, progress, table
from tmm_gen.closed_loop.compare import compare, worst
from tmm_gen.closed_loop.pictures import comparison_picture
from tmm_gen.control.bench import Bench
from tmm_gen.control.condition import CONDITIONS
from tmm_gen.control.controllers import BY_NAME, CONTROLLERS
from tmm_gen.control.plant.differing import conditions_of
from tmm_gen.files import write_tree_whole, write_whole
from tmm_gen.onboard.emit import EMITTED
from tmm_gen.scene import load_scene

ROOT = Path(__file__).parents[1]
SCENE = ROOT / "scenes" / "swing.toml"
PAGE = ROOT / "docs" / "mpc.md"
FIGURE = ROOT / "docs" / "figures" / "mpc.png"
DRAWN = ("pd", "lqr", "mpc-modes"), ("nominal", "payload", "delay")
"""Controllers and conditions of the figure."""
SLOW = "nmpc"
"""Gets one noise: it takes seconds for a loop."""

Rows = list[dict[str, object]]


def group(outcome: RandomOutcome) -> str:
    """Return what made a loop hard, if anything."""
    case = outcome.case
    if case.tight:
        return "bounds that exclude the reference"
    if case.dropouts:
        return "failing sensors"
    if case.torque < 2.0 or (case.torque_rate or 1e9) < 40.0:
        return "a weak or slow motor"
    if case.condition.delay > 0.0:
        return "a delay nobody knows of"
    return "payload, stiffness, friction, noise, motion only"


def random_loops(bench: Bench, loops: int) -> Rows:
    """Run the random loops; return a row for each controller and group."""
    counted: dict[tuple[str, str], Counter[str]] = {}
    with progress("random loops", total=loops) as advance:
        for number in range(loops):
            outcome = run_case(bench, draw(number))
            counts = counted.setdefault((group(outcome), outcome.case.controller), Counter())
            counts["loops"] += 1
            counts["out_of_bounds"] += not outcome.within
            counts["not_settled"] += outcome.figures.settling is None
            counts["with_fallback"] += outcome.loop.fallbacks > 0
            counts["fallbacks"] += outcome.loop.fallbacks
            advance()
    keys = ("loops", "out_of_bounds", "not_settled", "with_fallback", "fallbacks")
    return [
        {"group": name, "controller": controller, **{key: counts[key] for key in keys}}
        for (name, controller), counts in sorted(counted.items())
    ]


def conditions(bench: Bench, seeds: Sequence[int]) -> Rows:
    """Return the worst figures of every controller under every condition; a row for each."""
    runs = [(kind, True) for kind in CONTROLLERS if kind.default] + [(BY_NAME["rti"], False)]
    runs += [(kind, False) for kind in CONTROLLERS if not kind.default]
    rows: Rows = []
    with progress("conditions", total=len(runs) * len(conditions_of(bench.scene))) as advance:
        for kind, compiled in runs:
            for case in conditions_of(bench.scene):
                tried = seeds[:1] if kind.name == SLOW else seeds
                figures = worst(bench, kind, case, tried, compiled=compiled)
                assert figures.overshoot is not None
                rows.append(
                    {
                        "controller": kind.name,
                        "condition": case.name,
                        "compiled": compiled and kind.name in EMITTED,
                        "settling_s": figures.settling,
                        "overshoot_percent": 100.0 * figures.overshoot,
                        "residual_mrad": 1e3 * figures.residual,
                        "offset_mrad": 1e3 * figures.offset,
                        "fallbacks": figures.fallbacks,
                    }
                )
                advance(1, f"{kind.title}, {case.title}")
    return rows


def section(trials: Rows, loops: Rows) -> str:
    """Return what the page says of both: a table and what was counted."""
    tried = {row["condition"] for row in trials}
    titles = [case.title for case in CONDITIONS if case.name in tried]
    lines = ["| controller | " + " | ".join(titles) + " |", "|---" * (1 + len(titles)) + "|"]
    for name, compiled in dict.fromkeys((row["controller"], row["compiled"]) for row in trials):
        both = name in EMITTED and not compiled
        cells = [_cell(row) for row in trials if (row["controller"], row["compiled"]) == (name, compiled)]
        note = ", extended Kalman filter" if both else ", one noise" if name == SLOW else ""
        lines.append(f"| `{name}`{note} | {' | '.join(cells)} |")
    model = [row for row in loops if not str(row["controller"]).startswith("pd")]
    counts = [
        f"{_sum(rows, 'not_settled')} of {_sum(rows, 'loops')} loops with {what}"
        for rows, what in ((model, "a model"), ([row for row in loops if row not in model], "PD"))
    ]
    bad = _sum(loops, "out_of_bounds") or "none"
    said = (
        f"Of {_sum(loops, 'loops')} loops drawn at random {bad} gave a torque that was not finite or out of its "
        f"bounds; {' and '.join(counts)} did not settle to 0.5 % in 2.5 s."
    )
    return "\n".join([*lines, "", said])


def _cell(row: dict[str, object]) -> str:
    """Return settling, rounded up (s) / overshoot (%) / residual (mrad)."""
    settling, residual = row["settling_s"], float(str(row["residual_mrad"]))
    when = "-" if settling is None else f"{math.ceil(100.0 * float(str(settling)) - 1e-6) / 100.0:.2f}"
    left = f"{residual:.2f}" if residual < 9.995 else f"{residual:.0f}"
    return f"{when} / {float(str(row['overshoot_percent'])):.1f} / {left}"


def _sum(rows: Rows, key: str) -> int:
    return sum(int(str(row[key])) for row in rows)


def main() -> int:
    """Print both tables; return 1 if a torque left its bounds."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--seed", type=int, default=0, help="of the first noise")
    parser.add_argument("--seeds", type=int, default=10, help="noises")
    parser.add_argument("--loops", type=int, default=1000, help="loops drawn at random")
    parser.add_argument("--out", type=Path, default=Path("out/bench"))
    parser.add_argument("--update", action="store_true", help=f"renew {PAGE.name} and its figure")
    given = parser.parse_args()
    bench = Bench.of(load_scene(SCENE))
    trials = conditions(bench, range(given.seed, given.seed + given.seeds))
    columns: list[Column | str] = [
        "controller",
        "condition",
        Column("compiled", "as C"),
        Column("settling_s", "settles (s)", ".3f"),
        Column("overshoot_percent", "overshoot (%)", ".2f"),
        Column("residual_mrad", "residual (mrad)", ".2f"),
        Column("offset_mrad", "offset (mrad)", ".2f"),
        "fallbacks",
    ]
    table(trials, columns, title=f"worst of {given.seeds} noises")
    loops = random_loops(bench, given.loops)
    counted = ["loops", "out_of_bounds", "not_settled", "with_fallback", "fallbacks"]
    table(loops, ["group", "controller", *counted])
    results = given.out / "mpc_closed_loop.json"
    given.out.mkdir(parents=True, exist_ok=True)
    write_whole(results, json.dumps(plain({"trials": trials, "random": loops}), indent=1) + "\n")
    print(f"wrote {results}")
    if given.update:
        kinds, cases = DRAWN
        shown = compare(
            bench,
            [BY_NAME[name] for name in kinds],
            [case for case in CONDITIONS if case.name in cases],
            compiled=True,
        )
        text = renewed(PAGE.read_text(), section(trials, loops), Path(__file__).name)
        write_tree_whole({PAGE: text, FIGURE: comparison_picture([*shown], bench.problem)})
        print(f"wrote {PAGE} and {FIGURE}")
    out = _sum(loops, "out_of_bounds")
    print(f"{given.loops} loops, {out} with a torque that was not finite or out of its bounds")
    return 1 if out else 0


if __name__ == "__main__":
    sys.exit(main())

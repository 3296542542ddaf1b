"""Closed loops of the swing: every controller under every condition, and 1000 drawn at random.

    python benchmarks/mpc_closed_loop.py [--loops 1000] [--out FILE.json]

The random loops change payload, stiffness, friction, delay, noise and the initial motion, tighten bounds until
they cannot all be kept, and let sensors fail. No torque may be non-finite or out of its bounds; failures to settle
are counted.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections import Counter
from pathlib import Path

from tmm_gen.cli.console import Column, plain, progress, table
from tmm_gen.control.bench import Bench
from tmm_gen.control.compare import compare
from tmm_gen.control.condition import CONDITIONS
from tmm_gen.control.controllers import CONTROLLERS
from tmm_gen.control.robustness import RandomOutcome, draw, run_case
from tmm_gen.scene import load_scene

SCENE = Path(__file__).parents[1] / "scenes" / "swing.toml"


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


def random_loops(bench: Bench, loops: int) -> list[dict[str, object]]:
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


def main() -> int:
    """Print both tables; return 1 if a torque left its bounds."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--loops", type=int, default=1000)
    parser.add_argument("--out", type=Path)
    arguments = parser.parse_args()
    bench = Bench.of(load_scene(SCENE))
    kinds = [kind for kind in CONTROLLERS if kind.default]
    trials = [trial.row() for trial in compare(bench, kinds, CONDITIONS, compiled=True)]
    columns = [
        "controller",
        "condition",
        Column("settling_s", "settles (s)", ".3f"),
        Column("overshoot_percent", "overshoot (%)", ".2f"),
        Column("residual_mrad", "residual (mrad)", ".2f"),
        Column("offset_mrad", "offset (mrad)", ".2f"),
        Column("solve_us_median", "solve (us)", ".0f"),
    ]
    table(trials, columns)
    loops = random_loops(bench, arguments.loops)
    table(
        loops, ["group", "controller", "loops", "out_of_bounds", "not_settled", "with_fallback", "fallbacks"]
    )
    if arguments.out:
        arguments.out.write_text(json.dumps(plain({"trials": trials, "random": loops}), indent=2))
    out = sum(int(str(row["out_of_bounds"])) for row in loops)
    print(f"{arguments.loops} loops, {out} with a torque that was not finite or out of its bounds")
    return 1 if out else 0


if __name__ == "__main__":
    sys.exit(main())

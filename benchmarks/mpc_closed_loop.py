"""Closed loops of the swing: every controller under every condition, and 1000 drawn at random.

    python benchmarks/mpc_closed_loop.py [--seeds 10] [--loops 1000] [--out FILE.json]

What is shown of each controller and condition is the worst of ten noises, seeds 0 to 9. What can be emitted runs as
compiled C; real-time iteration, whose filter is another there, under the first two conditions also as it is.

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
from tmm_gen.control.compare import worst
from tmm_gen.control.condition import CONDITIONS
from tmm_gen.control.controllers import BY_NAME, CONTROLLERS
from tmm_gen.control.emitted.emit import EMITTED
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


def conditions(bench: Bench, seeds: int) -> list[dict[str, object]]:
    """Return the worst figures of every controller under every condition; a row for each."""
    kinds = [kind for kind in CONTROLLERS if kind.default]
    wanted = [(kind, case, True) for case in CONDITIONS for kind in kinds]
    wanted += [(BY_NAME["rti"], case, False) for case in CONDITIONS[:2]]
    rows: list[dict[str, object]] = []
    with progress("conditions", total=len(wanted)) as advance:
        for kind, case, compiled in wanted:
            figures = worst(bench, kind, case, range(seeds), compiled=compiled)
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
            advance()
    return rows


def main() -> int:
    """Print both tables; return 1 if a torque left its bounds."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, default=10)
    parser.add_argument("--loops", type=int, default=1000)
    parser.add_argument("--out", type=Path)
    arguments = parser.parse_args()
    bench = Bench.of(load_scene(SCENE))
    trials = conditions(bench, arguments.seeds)
    columns = [
        "controller",
        "condition",
        Column("compiled", "as C"),
        Column("settling_s", "settles (s)", ".3f"),
        Column("overshoot_percent", "overshoot (%)", ".2f"),
        Column("residual_mrad", "residual (mrad)", ".2f"),
        Column("offset_mrad", "offset (mrad)", ".2f"),
        "fallbacks",
    ]
    table(trials, columns, title=f"worst of {arguments.seeds} noises")
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

"""Emitted controllers of arms with several motors, told and shown all that is wrong for a second: do all come back?

    python benchmarks/arm_faults.py [--cases 300] [--scene scenes/elbow.toml] [--controller rti] [--real float32]

For up to 50 samples encoders are stuck, lost, absurd or off by turns; the reference jumps, or is to be followed with a
jump; bounds of torques are crossed, not finite or too narrow to hold the arm; payloads come and go, told or not, or
told wrongly. Arms in space stand at angles that suit the three joints of examples/space/wall3.toml; linear controllers
are tried without walls. Then sensors are true again, and the controller is told the scene's bounds and reference and
the payload there is. Required is OK within one second, an arm that arrives (0.02 rad) within four, nothing but OK from
then on or from one second on, and at all times a torque within the bounds in force. Encoders that lie for a second
throw an arm many turns away: it is to arrive within four seconds more than it takes for this way as fast as its joints
may turn, where that is bounded, or a linear controller brings it near at rates of its own, and as fast as its motors
could turn it if it were stiff. hypothesis draws the cases; exits with 1 if one fails.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
from collections import Counter
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

from faulty_loops.arm_cases import ArmCase, arm_cases
from faulty_loops.arm_loop import AFTER, ArmLoop, ArmOutcome
from faulty_loops.drawing import outcomes_of

from tmm_gen.cli.console import plain, table
from tmm_gen.control.bench import Bench
from tmm_gen.files import write_whole
from tmm_gen.onboard.emit import EMITTED, LINEAR
from tmm_gen.scene import load_scene

ROOT = Path(__file__).resolve().parents[1]
WITHIN = 1.0
"""s, in which OK must return."""
RANGES = {2: ((-0.5, 1.2), (-1.6, 0.5)), 3: ((-1.5, 1.5), (-0.8, 0.4), (0.2, 1.4))}
"""Joint angles that arms start at and are sent to, by how many motors they have, rad."""
Found = list[tuple[ArmCase, ArmOutcome]]


def outcomes(loop: ArmLoop, count: int, number: int = 0) -> Found:
    """Run as many cases as are asked for."""
    return outcomes_of(arm_cases(RANGES[loop.problem.count]), loop.run, count, number)


def failed(outcome: ArmOutcome, period: float) -> bool:
    """Return whether a case ended as none must."""
    return (
        latched(outcome, period)
        or outcome.last_off == outcome.samples
        or outcome.outside > 0
        or outcome.refused > 0
    )


def latched(outcome: ArmOutcome, period: float) -> bool:
    """Return whether a case has no OK within a second, or something else later although the arm has arrived."""
    if outcome.first_ok is None or outcome.first_ok * period > WITHIN:
        return True
    return outcome.last_other * period > WITHIN and outcome.last_other > outcome.last_off


def row(controller: str, real: str, found: Found, period: float) -> dict[str, object]:
    """Return a row of the table."""
    statuses: Counter[str] = Counter()
    answers: Counter[str] = Counter()
    for _, outcome in found:
        statuses.update(outcome.statuses)
        answers.update(outcome.answers)
    results = [outcome for _, outcome in found]
    return {
        "controller": controller,
        "real": real,
        "cases": len(found),
        "latched": sum(latched(each, period) for each in results),
        "not_arrived": sum(each.last_off == each.samples for each in results),
        "out_of_bounds": sum(each.outside > 0 for each in results),
        "refused": sum(each.refused > 0 for each in results),
        "worst_ok_s": period * max(each.first_ok or AFTER for each in results),
        "late": sum(each.last_other * period > WITHIN for each in results),
        "worst_calm_s": period * max(each.last_other for each in results),
        "worst_arrival_s": period * max(each.last_off for each in results),
        "worst_arrival_less_way_s": period * max(each.last_off - each.way for each in results),
        "statuses": dict(statuses),
        "answers": dict(answers),
    }


def main() -> int:
    """Print a table; return 1 if a case failed."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--cases", type=int, default=300)
    parser.add_argument("--controller", action="append", choices=EMITTED)
    parser.add_argument("--real", action="append", choices=["float64", "float32"])
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--scene", type=Path, default=ROOT / "scenes" / "elbow.toml")
    parser.add_argument("--out", type=Path, default=Path("out/bench"))
    asked = parser.parse_args()
    scene = load_scene(asked.scene)
    period, rows, bad = Bench.of(scene).problem.sample_time, [], []
    for controller in asked.controller or ("rti",):
        # linear ones keep no walls
        bench = Bench.of(scene.replace(**{"control.keep": None}) if controller in LINEAR else scene)
        for real in asked.real or ("float64", "float32"):
            found = outcomes(ArmLoop(bench, controller, real), asked.cases, asked.seed)
            rows.append(row(controller, real, found, period))
            bad += [(controller, real, *each) for each in found if failed(each[1], period)]
            print(rows[-1], file=sys.stderr, flush=True)
    table(rows, [key for key in rows[0] if key not in ("statuses", "answers")])
    for each in bad[:20]:
        print(*each)
    asked.out.mkdir(parents=True, exist_ok=True)
    write_whole(asked.out / f"arm_faults_{scene.name}.json", json.dumps(plain(rows), indent=1) + "\n")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())

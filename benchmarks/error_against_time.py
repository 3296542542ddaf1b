"""Error against time: one falling arm, ours and other people's solvers, and many arms at once, in one run.

    python benchmarks/error_against_time.py --update

The arm of `time_to_error.py` under gravity: 1 m, 1 kg, a first frequency of 2 Hz, cut into links; clamped, 0.4 kg at
the tip, let go horizontally, for a second. Error: the largest of the tip's place at 0.1, 0.2 ... 1 s against
Lagrange's equations. Everybody in turns, one thread, processor time, medians of rounds; gcc -O3 -march=native for all
C. tmm-gen with `favour = "speed"` and own sines; its many arms are 64 to 4096 in vectors of 8, on one core. Peers: a
step of Newmark's and one of Runge and Kutta's about CasADi's articulated-body C, MuJoCo, CVODES by way of CasADi with
compiled equations and exact Jacobians, SciPy on CasADi's equations. Writes data (JSON) and the figure; `--update` those
of docs/speed.md, and its table.
"""

from __future__ import annotations

import argparse
import json
import statistics
from pathlib import Path

import numpy as np
from against_time.contenders import LANES, Contender, contenders, useful
from against_time.page import told
from against_time.picture import Curve, curves_of, speed_picture
from support.marks import renewed
from time_to_error import CHECKPOINTS, arm

from tmm_gen.cli.console import progress
from tmm_gen.files import write_whole
from tmm_gen.reference.planar_reference import planar_response

ROOT = Path(__file__).resolve().parents[1]
DATA = Path(__file__).with_suffix(".json")
PAGE = ROOT / "docs" / "speed.md"
FIGURE = ROOT / "docs" / "figures" / "speed.png"
ROUNDS = 7


def measured(links: int, rounds: int) -> list[Curve]:
    """Return what everybody's settings leave and take."""
    scene = arm("gravity", links, "newmark")
    response = planar_response(scene, {}, np.concatenate([[0.0], CHECKPOINTS]))
    truth = np.column_stack([response["tip_x"], response["tip_y"]])[1:]
    pairs: list[tuple[Contender, float, float]] = []
    everybody = contenders(links, truth)
    with progress("errors", total=len(everybody)) as advance:
        for each in everybody:
            advance(0, doing=each.name)
            pairs += [(each, setting, error) for setting, error in useful(each)]
            advance()
    times: list[list[float]] = [[] for _ in pairs]
    with progress("times", total=rounds) as advance:
        for _ in range(rounds):
            for found, (each, setting, _) in zip(times, pairs, strict=True):
                found.append(each.seconds(setting))
            advance()
    return curves_of(
        (each.panel, each.name, setting, error, statistics.median(found))
        for found, (each, setting, error) in zip(times, pairs, strict=True)
    )


def main() -> None:
    """Measure, print, write."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--out", type=Path, default=Path("out/bench"))
    parser.add_argument("--links", type=int, default=10)
    parser.add_argument("--rounds", type=int, default=ROUNDS)
    parser.add_argument("--from", dest="data", type=Path, help="draw and tell this file instead of measuring")
    parser.add_argument("--update", action="store_true", help="write docs/speed.md, its figure and its data")
    given = parser.parse_args()
    if given.data is None:
        curves, links = measured(given.links, given.rounds), given.links
        given.out.mkdir(parents=True, exist_ok=True)
        data = {
            "links": links,
            "rounds": given.rounds,
            "lanes": LANES,
            "curves": [curve.values() for curve in curves],
        }
        write_whole(DATA if given.update else given.out / "error_against_time.json", json.dumps(data) + "\n")
    else:
        data = json.loads(given.data.read_text())
        curves, links = [Curve(**values) for values in data["curves"]], data["links"]
    print(told(curves))
    write_whole(FIGURE if given.update else given.out / "speed.png", speed_picture(curves, links))
    if given.update:
        write_whole(PAGE, renewed(PAGE.read_text(), told(curves), "error_against_time.py"))
        print(f"updated {PAGE} and {FIGURE}")


if __name__ == "__main__":
    main()

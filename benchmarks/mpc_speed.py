"""Time of one sample of nonlinear and linear MPC: emitted C beside do-mpc, CasADi's sqpmethod with hpipm and with qrqp.

    python benchmarks/mpc_speed.py --out out/bench --update

The task: swing a flexible arm by one radian, 30 samples of 20 ms, torque within 3 N m, soft bounds on hub and tip with
slacks of their own at each stage; the model is one Newmark step per sample. All solve the same problem with the same
generated step at the same states: those of a closed loop of the full real-time iteration on the model itself. A sample
is rollout, linearisation, condensing and quadratic program, on one thread; the estimator is timed with the emitted
controllers, which contain it, and with no other. Every solver starts from its own last solution. Time is the
processor's for the one thread that computes, so that other work on the machine does not count; emitted controllers are
timed before and after the others of as many links.

The others get what is fastest for them: the step in coordinates of two thirds the size, Jacobians and Hessians put
together from those of one stage, their functions as compiled C, buffers instead of conversions (`mpc_solvers/`). One
row shows do-mpc as its documentation sets it up. What is compiled is kept by content: the first run takes longer, and
`--compile` does nothing else. `--update` renews the page and its figure from what is measured, or, with `--read`, from
the results of an earlier run.
"""

from __future__ import annotations

import argparse
import json
import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import casadi as ca
import numpy as np
from mpc_solvers.do_mpc_controller import DoMpc
from mpc_solvers.motion import Motion
from mpc_solvers.page import section
from mpc_solvers.record import Converged, Solver, emitted, record, time_emitted, time_other
from mpc_solvers.sequential import Sequential
from mpc_solvers.stage import Stage
from mpc_solvers.task import arm
from support.marks import renewed

from tmm_gen.cli.console import Column, plain, progress, table
from tmm_gen.control.bench import Bench
from tmm_gen.control.command import Controller
from tmm_gen.control.estimators.extended_kalman import NonlinearFilter
from tmm_gen.csv_text import csv_text
from tmm_gen.files import write_tree_whole, write_whole
from tmm_gen.style import PALETTE, figure, picture, style

ROOT = Path(__file__).resolve().parents[1]
PAGE, FIGURE = ROOT / "docs" / "mpc-speed.md", ROOT / "docs" / "figures" / "mpc-speed.png"
LINKS = (2, 5, 10, 20)
COSTS = (5, 10)
GROWTH = (2, 5, 10, 20, 50)
DURATION = 2.5
REPEATS = 16
COSTED = 50
EMITTED = {"rti": "full RTI, C", "rti-zero": "zero-order RTI, C", "mpc-links": "linear MPC, links, C"}


@dataclass(frozen=True)
class Other:
    """A solver to compare with: how it is made, and by links how many samples it is given, else the whole loop."""

    make: Callable[[Stage], Solver]
    samples: Mapping[int, int] = field(default_factory=dict)


OTHERS = {
    "CasADi sqpmethod + hpipm": Other(lambda stage: Sequential(stage, "hpipm", whole=False)),
    "CasADi sqpmethod + hpipm, C": Other(lambda stage: Sequential(stage, "hpipm", whole=True)),
    "CasADi sqpmethod + qrqp, C": Other(lambda stage: Sequential(stage, "qrqp", whole=True)),
    "do-mpc (IPOPT)": Other(lambda stage: DoMpc(stage, tuned=False), {10: 60, 20: 20}),
    "do-mpc (IPOPT), tuned, C": Other(lambda stage: DoMpc(stage, tuned=True)),
}


def outputs(bench: Bench) -> dict[str, np.ndarray]:
    """Return the rows that give tip, hub and their rates from a state of the kernel."""
    step, found = bench.step, {}
    for name, rows in (("tip", step.motors.tip), ("hub", step.motors.hub)):
        found[name], found[f"{name}_rate"] = (step.rows(rows, what)[0] for what in ("angle", "rate"))
    return found


# -- measuring --------------------------------------------------------------------------------------------------


def measure(links: int, others: bool, most: int, advance: Callable[..., None]) -> list[dict[str, object]]:
    """Return a row for each solver.

    Parameters
    ----------
    links : int
        Of the model.
    others : bool
        Whether to compare with `OTHERS`.
    most : int
        Samples to give them at most.
    advance : callable
        Of a progress bar that goes one for these links.
    """
    bench = Bench.of(arm(links))
    made = {kind: emitted(bench, kind) for kind in EMITTED}
    seen = record(bench, made["rti"], DURATION)
    first = {kind: time_emitted(controller, seen, REPEATS // 2) for kind, controller in made.items()}
    share = 1.0 / (1 + len(OTHERS) * others)
    advance(share, f"{links} links: emitted C")
    found: dict[str, tuple[np.ndarray, np.ndarray]] = {}
    if others:
        stage = Stage(Motion(bench))
        for name, other in OTHERS.items():
            found[name] = time_other(other.make(stage), seen, min(most, other.samples.get(links, most)))
            advance(share, f"{links} links: {name}")
    again = {kind: time_emitted(controller, seen, REPEATS // 2)[0] for kind, controller in made.items()}
    own = {
        EMITTED[kind]: (np.median(np.concatenate([seconds, again[kind]]), axis=0), torques)
        for kind, (seconds, torques) in first.items()
    }
    return rows_of(links, {**own, **found}, seen.torques)


def rows_of(
    links: int, times: dict[str, tuple[np.ndarray, np.ndarray]], torques: np.ndarray
) -> list[dict[str, object]]:
    """Return what is shown of seconds and torques by solver, those of full RTI among them."""
    full, zero = (float(np.median(times[EMITTED[kind]][0])) for kind in ("rti", "rti-zero"))
    return [
        {
            "links": links,
            "solver": name,
            "median_us": 1e6 * float(np.median(seconds)),
            "p99_us": 1e6 * float(np.percentile(seconds, 99)),
            "p99_over_median": float(np.percentile(seconds, 99) / np.median(seconds)),
            "over_full": float(np.median(seconds)) / full,
            "over_zero": float(np.median(seconds)) / zero,
            "torque_off": float(np.abs(found - torques[: len(found)]).max()),
            "samples": len(seconds),
        }
        for name, (seconds, found) in times.items()
    ]


def compile_all(counts: Sequence[int], compared: Sequence[int]) -> None:
    """Compile what will be measured, so that it is found compiled."""
    with progress("compiling", total=len(counts)) as advance:
        for links in counts:
            bench = Bench.of(arm(links))
            names = list(OTHERS) if links in compared else []
            for name in names:
                advance(0.0, f"{links} links: {name}")
                OTHERS[name].make(Stage(Motion(bench)))
                advance(1.0 / len(names))
            if not names:
                advance(1.0)


def costs(links: int) -> list[dict[str, object]]:
    """Return what a closed loop on the model costs, by emitted controllers and by converged SQP."""
    bench = Bench.of(arm(links))
    converged = Converged(bench.step, bench.links, bench.inertia)
    converged.estimator = NonlinearFilter(bench.step, bench.links)
    found = {"converged SQP": closed_loop_cost(bench, converged)}
    for kind in EMITTED:
        found[EMITTED[kind]] = closed_loop_cost(bench, emitted(bench, kind))
    right = found["converged SQP"]
    return [
        {"links": links, "solver": name, "cost": cost, "more": cost / right - 1.0}
        for name, cost in found.items()
    ]


def closed_loop_cost(bench: Bench, controller: Controller) -> float:
    """Return the sum of the problem's own cost along a closed loop on the model."""
    step, goal, rows = bench.step, bench.links.goal, outputs(bench)
    weights = {name: float(value[0]) for name, value in vars(bench.problem.weights).items()}
    bounds = {kind.what: kind for kind in bench.problem.kinds(goal)}
    targets = {"tip": float(goal.tip[0]), "hub": float(goal.hub[0])}
    controller.reset()
    past, state, cost = np.zeros((step.delay.memory + 1, 1)), step.initial(), 0.0
    for _ in range(COSTED):
        torque = controller.command(np.array(step.sensors(state)).ravel()).torque
        past = np.vstack([past[1:], torque])
        state = np.array(step.sample(state, np.hstack(step.delay.pair(past)))).ravel()
        seen = {name: float(row @ state) for name, row in rows.items()}
        beyond = max(0.0, seen["tip"] - bounds["tip"].high)
        out = max(0.0, seen["hub"] - bounds["hub"].high, bounds["hub"].low - seen["hub"])
        cost += 0.5 * sum(weights[k] * (v - targets.get(k, 0.0)) ** 2 for k, v in seen.items())
        change = float(past[-1, 0] - past[-2, 0])
        cost += 0.5 * (weights["torque"] * float(torque[0]) ** 2 + weights["torque_step"] * change**2)
        cost += 0.5 * (weights["overshoot"] * beyond**2 + weights["hub_bound"] * out**2)
    return cost


def growth(rows: list[dict[str, object]]) -> list[dict[str, object]]:
    """Return the slope of log time over log links for each emitted controller."""
    found = []
    for name in EMITTED.values():
        points = {int(str(r["links"])): float(str(r["median_us"])) for r in rows if r["solver"] == name}
        if len(points) < 2:
            continue
        x, y = np.log(list(points)), np.log(list(points.values()))
        found.append({"solver": name, "exponent": float(np.polyfit(x, y, 1)[0]), "links": len(points)})
    return found


def draw(rows: list[dict[str, object]], path: Path) -> None:
    """Draw the time of a sample over the number of links."""
    with style():
        made, axes = figure(8.4, 4.6)
        solvers = dict.fromkeys(str(row["solver"]) for row in rows)
        for name, colour in zip(solvers, PALETTE, strict=False):
            points = [(int(str(r["links"])), float(str(r["median_us"]))) for r in rows if r["solver"] == name]
            own = name in EMITTED.values()
            axes.loglog(
                *zip(*points, strict=True), "o-" if own else "s--", color=colour, label=name, markersize=4
            )
        axes.set(xlabel="links of the model", ylabel="processor time of a sample (µs)")
        axes.set_xticks(GROWTH, [str(n) for n in GROWTH], minor=False)
        axes.minorticks_off()
        axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
        write_whole(path, picture(made, "png"))


def parsed() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--out", type=Path, default=Path("out/bench"))
    parser.add_argument(
        "--links", type=int, nargs="*", default=LINKS, help="links at which to compare solvers"
    )
    parser.add_argument("--growth", type=int, nargs="*", default=GROWTH, help="links of emitted controllers")
    parser.add_argument("--costs", type=int, nargs="*", default=COSTS, help="links at which to compare loops")
    parser.add_argument("--samples", type=int, default=1000, help="samples to give to other solvers at most")
    parser.add_argument("--compile", action="store_true", help="compile the other solvers, measure nothing")
    parser.add_argument("--read", action="store_true", help="measure nothing: take the results in --out")
    parser.add_argument("--update", action="store_true", help=f"renew {PAGE.name} and its figure")
    return parser.parse_args()


def measured(given: argparse.Namespace) -> dict[str, list[dict[str, object]]]:
    """Measure, and keep the results as they come."""
    rows: list[dict[str, object]] = []
    compared = [row for links in given.costs for row in costs(links)]
    counts = sorted({*given.links, *given.growth})
    with progress("measuring", total=len(counts)) as advance:
        for links in counts:
            rows += measure(links, links in given.links, given.samples, advance)
            write_whole(given.out / "mpc_speed.csv", csv_text(rows))
    return {"rows": rows, "growth": growth(rows), "costs": compared}


def main() -> None:
    """Measure, print tables, write them as CSV and JSON, and renew the page if told to."""
    given = parsed()
    if hasattr(ca.GlobalOptions, "setNumpyMode"):  # from CasADi 3.8 on
        ca.GlobalOptions.setNumpyMode(-1)
    if given.compile:
        compile_all(sorted({*given.links}), given.links)
        return
    results = given.out / "mpc_speed.json"
    found = json.loads(results.read_text()) if given.read else measured(given)
    columns: list[Column | str] = [
        "links",
        "solver",
        Column("median_us", "median (µs)", ".1f"),
        Column("p99_us", "99 % (µs)", ".1f"),
        Column("p99_over_median", "99 % / median", ".2f"),
        Column("over_full", "times full RTI", ".1f"),
        Column("over_zero", "times zero order", ".1f"),
        Column("torque_off", "torque off by (N m)", ".0e"),
        "samples",
    ]
    table(found["rows"], columns, title="one sample of MPC, one thread")
    table(found["growth"], ["solver", Column("exponent", "grows as links to the", ".2f")], title="growth")
    shown: list[Column | str] = [
        "links",
        "solver",
        Column("cost", form=".8f"),
        Column("more", "more than converged", ".1e"),
    ]
    table(found["costs"], shown, title="closed loop on the model")
    given.out.mkdir(parents=True, exist_ok=True)
    draw(found["rows"], given.out / "mpc_speed.png")
    write_tree_whole(
        {
            results: json.dumps(plain(found), indent=1, allow_nan=False) + "\n",
            given.out / "mpc_speed.csv": csv_text(found["rows"]),
            given.out / "mpc_speed_growth.csv": csv_text(found["growth"]),
            given.out / "mpc_cost.csv": csv_text(found["costs"]),
        }
    )
    print(f"wrote {results} and CSV files beside it")
    if given.update:
        text = section(found["rows"], found["growth"], found["costs"])
        picture = (given.out / "mpc_speed.png").read_bytes()
        write_tree_whole({PAGE: renewed(PAGE.read_text(), text, Path(__file__).name), FIGURE: picture})
        print(f"wrote {PAGE} and {FIGURE}")


if __name__ == "__main__":
    main()

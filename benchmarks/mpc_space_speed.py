"""Time of one sample of nonlinear MPC of arms in space: emitted C beside CasADi's sqpmethod, fatrop and do-mpc.

    python benchmarks/mpc_space_speed.py --out out/bench --update

The arm is that of `examples/space/wall3.toml`, its links of other numbers of cells, up to its wall; and the same
without the wall. All solve the same problem (cost, bounds of torques, soft ones of
rates, the wall by a slack per stage, horizon) with the same generated step, whose derivatives are the step's own
tangents, at the same states: those of a closed loop of `rti` on the model itself. Every solver starts from its own last
solution. What each answers is compared with our own iteration, repeated until it converges.

Time is the processor's for the one thread that computes, and emitted controllers, estimator included, are timed anew
before and after each of the others: ratios are those to what is measured beside them. What is compiled is kept by
content: the first run takes longer, and `--compile` does nothing else. `--update` renews the page from what is
measured, or, with `--read`, from the results of an earlier run.
"""

from __future__ import annotations

import argparse
import json
import os
import time
from collections.abc import Callable, Sequence
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import casadi as ca
import numpy as np
from mpc_solvers.compiled import compiled
from mpc_solvers.interior import Fatrop
from mpc_solvers.motion import Motion
from mpc_solvers.page import DERIVATIVES, space_section
from mpc_solvers.record import Converged, Record, emitted, record, time_emitted, time_other
from mpc_solvers.stage import Stage
from mpc_solvers.task import arm_in_space
from mpc_speed import OTHERS, Other
from support.marks import renewed

from tmm_gen.cli.console import Column, plain, progress, table
from tmm_gen.control.bench import Bench
from tmm_gen.files import write_whole

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "mpc-speed.md"
CELLS = {13: (3, 2), 23: (5, 5)}
"""Of both links, by the number of joints: each cell is two, the motors are three."""
DURATION = 2.0
REPEATS = 4
SETTLED = 3
"""Samples after which a controller that iterates once in each has made up for starting from nothing."""
KINDS = ("rti", "rti-zero")
"""What is emitted."""
WALLED = (True, False)
SAMPLES: dict[str, dict[int, int]] = {
    "CasADi sqpmethod + hpipm": {23: 0},
    "CasADi sqpmethod + hpipm, C": {},
    "CasADi sqpmethod + qrqp, C": {13: 8, 23: 0},
    "do-mpc (IPOPT)": {13: 12, 23: 0},
    "do-mpc (IPOPT), tuned, C": {13: 12, 23: 0},
}
"""What the others are given, by joints, else the whole loop: with 23 joints only what is fastest with 13."""
IN_SPACE = {"CasADi fatrop, C": Other(Fatrop)}
IN_SPACE |= {name: Other(OTHERS[name].make, samples) for name, samples in SAMPLES.items()}
WITHOUT_WALL = ("CasADi sqpmethod + hpipm, C", "CasADi fatrop, C")
"""What is given the arm without wall too: the fastest beside it."""

Rows = list[dict[str, object]]


def right(bench: Bench, seen: Record) -> np.ndarray:
    """Return the torques of our own iteration, repeated until it converges, at a record's samples, (samples, m)."""
    solver, found = Converged(bench.step, bench.links, bench.inertia), []
    for state, disturbance, last in zip(seen.states, seen.disturbances, seen.last, strict=True):
        found.append(solver.converged(state, disturbance, last).torque.copy())
        solver.shift()
    return np.array(found)


def derivatives(stage: Stage, seen: Record) -> float:
    """Return how long the compiled derivatives of all stages take the others, once, s."""
    motion = stage.motion
    function = compiled(stage.rows_slopes, stage.linked)
    buffer, call = function.buffer()
    inputs = np.zeros(motion.inputs)
    inputs[: motion.motors] = seen.torques[0]
    given = [motion.start(seen.states[0], seen.last[0]), inputs, seen.disturbances[0].copy()]
    found = [np.zeros(function.nnz_out(k)) for k in range(function.n_out())]
    for k, values in enumerate(given):
        buffer.set_arg(k, values.data)
    for k, values in enumerate(found):
        buffer.set_res(k, values.data)
    seconds = []
    for _ in range(50):
        begin = time.thread_time()
        for _ in range(motion.problem.horizon):
            call()
        seconds.append(time.thread_time() - begin)
    return float(np.median(seconds))


def measure(
    joints: int,
    walled: bool,
    names: Sequence[str],
    most: int,
    advance: Callable[..., None],
    judged: bool = True,
    **changes: object,
) -> Rows:
    """Return a row for each solver.

    Parameters
    ----------
    joints : int
        Of the arm, one of `CELLS`.
    walled : bool
        Whether it stands beside its wall.
    names : sequence of str
        Of the others.
    most : int
        Samples to give them at most.
    advance : callable
        Of a progress bar that goes one for these joints.
    judged : bool
        Whether torques are compared with an iteration that converges, which takes long with long horizons; else with
        those of `rti`.
    changes
        Of the scene, by their paths.
    """
    bench = Bench.of(arm_in_space(CELLS[joints], walled, **changes))
    made = {kind: emitted(bench, kind) for kind in KINDS}
    seen = record(bench, made["rti"], DURATION)
    wanted = right(bench, seen) if judged else seen.torques
    stage = Stage(Motion(bench), apart=True)

    def own() -> dict[str, tuple[np.ndarray, np.ndarray]]:
        return {kind: time_emitted(controller, seen, REPEATS) for kind, controller in made.items()}

    turns = [own()]
    shown = {"joints": joints, "walled": walled}
    others: Rows = []
    for name in names:
        advance(1.0 / len(names), f"{joints} joints: {name}")
        count = min(most, IN_SPACE[name].samples.get(joints, most))
        if not count:
            continue
        seconds, torques = time_other(IN_SPACE[name].make(stage), seen, count)
        turns.append(own())
        beside = {kind: _median([turn[kind][0] for turn in turns[-2:]]) for kind in made}
        others.append({**shown, "solver": name, **_figures(seconds, torques, wanted, beside)})
    found: Rows = []
    beside = {kind: _median([turn[kind][0] for turn in turns]) for kind in made}
    for kind in made:
        every = np.median(np.concatenate([turn[kind][0] for turn in turns]), axis=0)
        figures = _figures(every, turns[0][kind][1], wanted, beside)
        found.append({**shown, "solver": f"`{kind}`, C", **figures})
    once = {**shown, "solver": DERIVATIVES, "median_us": 1e6 * derivatives(stage, seen)}
    return [*found, *others, once] if names else found


def _median(runs: Sequence[np.ndarray]) -> float:
    """Return the median over samples of those over repetitions, (repetitions, samples) each, s."""
    return float(np.median(np.median(np.concatenate(runs), axis=0)))


def _figures(
    seconds: np.ndarray, torques: np.ndarray, wanted: np.ndarray, beside: dict[str, float]
) -> dict[str, object]:
    median, late = float(np.median(seconds)), float(np.percentile(seconds, 99))
    off = np.abs(torques - wanted[: len(torques)])[SETTLED:]
    return {
        "median_us": 1e6 * median,
        "p99_us": 1e6 * late,
        "p99_over_median": late / median,
        "over_full": median / beside["rti"],
        "over_zero": median / beside["rti-zero"],
        "torque_off": float(off.max()) if off.size else None,
        "samples": len(seconds),
    }


def parsed() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--out", type=Path, default=Path("out/bench"))
    parser.add_argument(
        "--joints",
        type=int,
        nargs="*",
        default=tuple(CELLS),
        choices=tuple(CELLS),
        help="of the arms to measure; results of others in --out stay",
    )
    parser.add_argument("--others", nargs="*", default=tuple(IN_SPACE), choices=tuple(IN_SPACE))
    parser.add_argument("--samples", type=int, default=1000, help="samples to give to other solvers at most")
    parser.add_argument("--compile", action="store_true", help="compile the other solvers, measure nothing")
    parser.add_argument("--read", action="store_true", help="measure nothing: take the results in --out")
    parser.add_argument("--update", action="store_true", help=f"renew {PAGE.name}")
    return parser.parse_args()


def asked(names: Sequence[str], walled: bool) -> list[str]:
    """Return those of the others that are given the arm beside its wall, or without."""
    return [name for name in names if walled or name in WITHOUT_WALL]


def compile_all(joints: Sequence[int], names: Sequence[str]) -> None:
    """Compile what will be measured, so that it is found compiled."""
    with progress("compiling", total=2 * len(joints)) as advance:
        for count in joints:
            for walled in WALLED:
                stage = Stage(Motion(Bench.of(arm_in_space(CELLS[count], walled))), apart=True)
                for name in asked(names, walled):
                    advance(1.0 / len(asked(names, walled)), f"{count} joints: {name}")
                    if IN_SPACE[name].samples.get(count, 1):
                        IN_SPACE[name].make(stage)


def measured(given: argparse.Namespace, results: Path) -> Rows:
    """Measure, and keep the results as they come, beside those of other numbers of joints of earlier runs."""
    before: Rows = json.loads(results.read_text()) if results.exists() else []
    rows = [row for row in before if row["joints"] not in given.joints]
    with progress("measuring", total=2 * len(given.joints)) as advance:
        for joints in given.joints:
            for walled in WALLED:
                rows += measure(joints, walled, asked(given.others, walled), given.samples, advance)
                write_whole(results, json.dumps(plain(rows), indent=1, allow_nan=False) + "\n")
    return sorted(rows, key=lambda row: int(str(row["joints"])))


def main() -> None:
    """Measure, print the table, write it as JSON, and renew the page if told to."""
    given = parsed()
    if hasattr(ca.GlobalOptions, "setNumpyMode"):  # from CasADi 3.8 on
        ca.GlobalOptions.setNumpyMode(-1)
    if given.compile:
        compile_all(given.joints, given.others)
        return
    given.out.mkdir(parents=True, exist_ok=True)
    results = given.out / "mpc_space_speed.json"
    rows = json.loads(results.read_text()) if given.read else measured(given, results)
    columns: list[Column | str] = [
        "joints",
        "walled",
        "solver",
        Column("median_us", "median (µs)", ".0f"),
        Column("p99_over_median", "99 % / median", ".2f"),
        Column("over_full", "times rti", ".1f"),
        Column("over_zero", "times rti-zero", ".1f"),
        Column("torque_off", "torque off by (N m)", ".0e"),
        "samples",
    ]
    table(rows, columns, title="one sample of MPC in space, one thread")
    if given.update:
        write_whole(PAGE, renewed(PAGE.read_text(encoding="utf-8"), space_section(rows), Path(__file__).name))
        print(f"wrote {PAGE}")


if __name__ == "__main__":
    main()

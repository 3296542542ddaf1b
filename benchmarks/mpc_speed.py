"""Time of one sample of nonlinear and linear MPC: emitted C beside do-mpc, CasADi's sqpmethod with hpipm and with qrqp.

    python benchmarks/mpc_speed.py --out out/bench

The task: swing a flexible arm by one radian, 30 samples of 20 ms, torque within 3 N m, soft bounds on hub and tip with
slacks of their own at each stage; the model is one Newmark step per sample. All solve the same problem with the same
generated step at the same states: those of a closed loop of the full real-time iteration on the model itself. A sample
is rollout, linearisation, condensing and quadratic program, on one thread; the estimator is timed with the emitted
controllers, which contain it, and with no other. Every solver starts from its own last solution. Time is the
processor's for the one thread that computes, so that other work on the machine does not count.
"""

from __future__ import annotations

import argparse
import contextlib
import io
import os
import subprocess
import tempfile
import time
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import casadi as ca
import numpy as np

from tmm_gen.cli.console import Column, progress, table
from tmm_gen.control.bench import Bench
from tmm_gen.control.command import Command, Controller
from tmm_gen.control.emitted.emit import emit_controller
from tmm_gen.control.emitted.native import EmittedController
from tmm_gen.control.extended_kalman import NonlinearFilter
from tmm_gen.control.rti import RealTimeIteration
from tmm_gen.files import write_whole
from tmm_gen.measure.rows import csv_text
from tmm_gen.scene import Scene, load_scene

LINKS = (2, 5, 10, 20)
COSTS = (5,)
GROWTH = (2, 5, 10, 20, 50)
DURATION = 2.5
REPEATS = 15
MOST_ITERATIONS = 8
COSTED = 50
FLAGS = ("-O3", "-march=native", "-ffp-contract=off")
SWING = Path(__file__).resolve().parents[1] / "scenes" / "swing.toml"
WEIGHTS = {
    **{"tip": 1.0, "hub": 0.2, "tip_rate": 0.02, "torque": 1e-3, "torque_step": 5e-3, "terminal": 10.0},
    **{"overshoot": 1e3, "hub_bound": 1e3},
}
EMITTED = {"rti": "full RTI, C", "rti-zero": "zero-order RTI, C", "mpc-links": "linear MPC, links, C"}

QP_OPTIONS: dict[str, dict[str, Any]] = {
    "qrqp": {"print_iter": False, "print_header": False, "print_info": False, "print_time": False},
    # with its own tolerances and infinities it takes ten times as many iterations
    "hpipm": {
        "inf": 1e5,
        "hpipm": {"iter_max": 100, "mu0": 10.0, **{f"res_{k}_max": 1e-6 for k in "gbdm"}},
    },
}
MOST_LINKS_EXPANDED = 2
"""Beyond, gcc takes minutes for the unrolled code of all stages, and calls of one stage's are compiled."""

Solver = Callable[[np.ndarray, float, float], float]
"""From state, last torque and disturbance to the torque."""


def arm(links: int) -> Scene:
    """Return the task with so many links, one step of the kernel per sample."""
    changes = {
        "beam.links": links,
        "control.substeps": 1,
        "integrator.step": 0.02,
        "control.weights": WEIGHTS,
    }
    # Newmark's step answers half a step late: with a delay of as much, inputs need no correction
    return load_scene(SWING).replace(**changes, **{"control.delay": 0.01})


# -- the same problem for others --------------------------------------------------------------------------------


@dataclass
class Staged:
    """Multiple shooting, stage by stage: x with the last torque, then torque and slacks."""

    problem: dict[str, Any]
    low: np.ndarray
    high: np.ndarray
    low_rows: np.ndarray
    high_rows: np.ndarray
    size: int
    width: int


def outputs(bench: Bench) -> dict[str, np.ndarray]:
    step = bench.step
    return {
        "tip": step.mean_row("angle"),
        "tip_rate": step.mean_row("rate"),
        "hub": step.hub_row("angle"),
        "hub_rate": step.hub_row("rate"),
    }


def stage_cost(bench: Bench, x: Any) -> Any:
    weights, rows = bench.problem.weights, outputs(bench)
    targets = {
        "tip": bench.problem.reference,
        "hub": bench.links.target_hub,
        "tip_rate": 0.0,
        "hub_rate": 0.0,
    }
    return sum(getattr(weights, k) * (ca.dot(ca.DM(row), x) - targets[k]) ** 2 for k, row in rows.items())


def staged(bench: Bench) -> Staged:
    problem, weights, size = bench.problem, bench.problem.weights, bench.step.size
    count, rows_of = problem.horizon, outputs(bench)
    x = [ca.MX.sym(f"x{k}", size + 1) for k in range(count + 1)]
    u = [ca.MX.sym(f"u{k}", 3) for k in range(count)]
    disturbance = ca.MX.sym("d")
    advance = bench.step.sample
    rows: list[Any] = []
    low_rows: list[float] = []
    high_rows: list[float] = []
    cost: Any = 0.0
    for k in range(count):
        after = advance(x[k][:size], ca.vertcat(x[k][size], u[k][0]) + disturbance)
        rows.append(ca.vertcat(after, u[k][0]) - x[k + 1])
        low_rows += [0.0] * (size + 1)
        high_rows += [0.0] * (size + 1)
        cost += 0.5 * weights.torque * (u[k][0] + disturbance) ** 2
        cost += 0.5 * weights.torque_step * (u[k][0] - x[k][size]) ** 2
        cost += 0.5 * (weights.overshoot * u[k][1] ** 2 + weights.hub_bound * u[k][2] ** 2)
        cost += 0.5 * (weights.terminal if k == count - 1 else 1.0) * stage_cost(bench, x[k + 1][:size])
        tip, hub = (ca.dot(ca.DM(rows_of[name]), after) for name in ("tip", "hub"))
        assert problem.tip is not None
        assert problem.hub is not None
        rows += [tip - u[k][1], hub - u[k][2], hub + u[k][2]]
        low_rows += [-np.inf, -np.inf, problem.hub[0]]
        high_rows += [problem.tip[1], problem.hub[1], np.inf]
    width = size + 4
    low, high = np.full((count, width), -np.inf), np.full((count, width), np.inf)
    low[:, size + 1], high[:, size + 1] = problem.torque
    variables = [part for pair in zip(x, u, strict=False) for part in pair] + [x[-1]]
    free = np.full(size + 1, np.inf)
    return Staged(
        {"x": ca.vertcat(*variables), "f": cost, "g": ca.vertcat(*rows), "p": disturbance},
        np.concatenate([low.ravel(), -free]),
        np.concatenate([high.ravel(), free]),
        np.array(low_rows),
        np.array(high_rows),
        size,
        width,
    )


def sequential(bench: Bench, qpsol: str, compiled: bool) -> Solver:
    """Return one Gauss-Newton iteration of CasADi's sqpmethod per sample."""
    stages = staged(bench)
    nlp = stages.problem
    hessian = ca.Function(
        "hess_lag",
        [nlp["x"], nlp["p"], ca.MX.sym("lam_f"), ca.MX.sym("lam_g", nlp["g"].numel())],
        [ca.hessian(nlp["f"], nlp["x"])[0]],
        ["x", "p", "lam_f", "lam_g"],
        ["hess_gamma_x_x"],
    )
    options = {
        "qpsol": qpsol,
        "qpsol_options": {"error_on_fail": False, **QP_OPTIONS[qpsol]},
        "expand": not compiled or bench.scene.stations <= MOST_LINKS_EXPANDED,
        "max_iter": 1,
        "max_iter_ls": 0,
        "print_header": False,
        "print_iteration": False,
        "print_status": False,
        "print_time": False,
        "error_on_fail": False,
        "hess_lag": hessian,
        "min_iter": 1,
    }
    solver = ca.nlpsol("nmpc", "sqpmethod", nlp, options)
    if compiled:
        solver = external(solver)
    point: np.ndarray | None = None
    multipliers: dict[str, Any] = {}

    def solve(state: np.ndarray, last: float, disturbance: float) -> float:
        nonlocal point, multipliers
        start = np.append(state, last)
        if point is None:
            point = np.concatenate([np.tile(np.append(start, [0.0] * 3), bench.problem.horizon), start])
        low, high = stages.low.copy(), stages.high.copy()
        low[: stages.size + 1] = high[: stages.size + 1] = start
        found = solver(
            x0=point,
            p=disturbance,
            lbx=low,
            ubx=high,
            lbg=stages.low_rows,
            ubg=stages.high_rows,
            **multipliers,
        )
        point = np.array(found["x"]).ravel()
        torque = float(point[stages.size + 1])
        point = np.concatenate([point[stages.width :], point[-stages.width :]])[: len(point)]
        multipliers = {"lam_x0": found["lam_x"], "lam_g0": found["lam_g"]}
        return torque

    return solve


def external(solver: Any) -> Any:
    """Write a solver as C and compile it."""
    folder = Path(tempfile.mkdtemp(prefix="tmm-gen-"))
    generator = ca.CodeGenerator("nmpc.c")
    generator.add(solver)
    generator.generate(str(folder) + "/")
    command = ["gcc", "-O1", "-march=native", "-shared", "-fPIC", "nmpc.c", "-o", "nmpc.so", "-lm"]
    subprocess.run(command, cwd=folder, check=True)
    return ca.external("nmpc", str(folder / "nmpc.so"))


def do_mpc_solver(bench: Bench) -> Solver:
    """Return do-mpc with IPOPT."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        import do_mpc

    problem, weights, size = bench.problem, bench.problem.weights, bench.step.size
    model = do_mpc.model.Model("discrete", "SX")
    x = model.set_variable("_x", "x", shape=(size, 1))
    last = model.set_variable("_x", "last")
    u = model.set_variable("_u", "u")
    disturbance = model.set_variable("_p", "d")
    model.set_rhs("x", bench.step.sample(x, ca.vertcat(last, u) + disturbance))
    model.set_rhs("last", u)
    model.setup()
    mpc = do_mpc.controller.MPC(model)
    mpc.set_param(
        n_horizon=problem.horizon,
        t_step=problem.sample_time,
        n_robust=0,
        store_full_solution=False,
        nlpsol_opts={"ipopt.print_level": 0, "ipopt.sb": "yes", "print_time": 0},
    )
    cost = 0.5 * stage_cost(bench, x)
    running = (
        cost + 0.5 * weights.torque * (u + disturbance) ** 2 + 0.5 * weights.torque_step * (u - last) ** 2
    )
    mpc.set_objective(mterm=weights.terminal * cost, lterm=running)
    mpc.set_rterm(u=0.0)
    mpc.bounds["lower", "_u", "u"], mpc.bounds["upper", "_u", "u"] = problem.torque
    rows = outputs(bench)
    tip, hub = ca.dot(ca.DM(rows["tip"]), x), ca.dot(ca.DM(rows["hub"]), x)
    assert problem.tip is not None
    assert problem.hub is not None
    for name, value, bound, weight in (
        ("tip", tip, problem.tip[1], weights.overshoot),
        ("hub_high", hub, problem.hub[1], weights.hub_bound),
        ("hub_low", -hub, -problem.hub[0], weights.hub_bound),
    ):
        mpc.set_nl_cons(name, value, ub=bound, soft_constraint=True, penalty_term_cons=weight)
    template = mpc.get_p_template(1)
    mpc.set_p_fun(lambda _: template)
    mpc.setup()
    first = True

    def solve(state: np.ndarray, before: float, disturbed: float) -> float:
        nonlocal first
        template["_p", 0, "d"] = disturbed
        start = np.append(state, before)
        if first:
            mpc.x0 = start
            mpc.u0 = before
            mpc.set_initial_guess()
            first = False
        with contextlib.redirect_stdout(io.StringIO()):
            return float(mpc.make_step(start[:, None])[0, 0])

    return solve


# -- measuring --------------------------------------------------------------------------------------------------


@dataclass
class Record:
    """A closed loop: what was measured, and estimates with last torques for those without an estimator."""

    measured: np.ndarray
    states: np.ndarray
    last: np.ndarray
    disturbances: np.ndarray


def emitted(bench: Bench, controller: str) -> EmittedController:
    name, files = emit_controller(bench, controller)
    sensors = [i for i, on in enumerate((True, bench.problem.sensors.accelerometer is not None, False)) if on]
    return EmittedController(name, files, sensors, flags=FLAGS)


def record(bench: Bench, controller: EmittedController) -> Record:
    """Run the closed loop on the model itself, without noise; estimates are those of the same filter in Python."""
    step = bench.step
    controller.reset()
    samples = round(DURATION / bench.problem.sample_time)
    observer = NonlinearFilter(step, bench.links)
    past = np.zeros(step.delay.memory + 1)
    state = step.initial()
    rows: list[tuple[np.ndarray, np.ndarray, float, float]] = []
    for _ in range(samples):
        seen = np.array(step.sensors(state)).ravel()
        observer.correct(seen)
        rows.append((seen, observer.estimate[:-1].copy(), float(past[-1]), float(observer.estimate[-1])))
        torque = controller.command(seen).torque
        past = np.append(past[1:], torque)
        observer.advance(step.delay.pair(past), step.delay.end(past))
        state = np.array(step.sample(state, np.array(step.delay.pair(past)))).ravel()
    measured, states, last, disturbed = zip(*rows, strict=True)
    return Record(np.array(measured), np.array(states), np.array(last), np.array(disturbed))


def seconds_emitted(controller: EmittedController, seen: Record) -> np.ndarray:
    """Return the time of each sample, the median over repetitions of the whole loop."""
    runs = []
    for _ in range(REPEATS):
        controller.reset()
        runs.append(controller.run(seen.measured).seconds)
    return np.median(runs, axis=0)


def seconds_other(solver: Solver, seen: Record, count: int) -> np.ndarray:
    """Return the time of each of the first samples."""
    found = []
    for k in range(min(count, len(seen.last))):
        begin = time.thread_time()
        solver(seen.states[k], float(seen.last[k]), float(seen.disturbances[k]))
        found.append(time.thread_time() - begin)
    return np.array(found)


def measure(links: int, others: bool, advance: Callable[..., None]) -> list[dict[str, object]]:
    bench = Bench.of(arm(links))
    made = {kind: emitted(bench, kind) for kind in EMITTED}
    seen = record(bench, made["rti"])
    times = {EMITTED[kind]: seconds_emitted(controller, seen) for kind, controller in made.items()}
    advance(0.2, f"{links} links: emitted C")
    if others:
        makers: dict[str, tuple[Callable[[], Solver], int]] = {
            "CasADi sqpmethod + hpipm": (lambda: sequential(bench, "hpipm", False), 60),
            "CasADi sqpmethod + qrqp, C": (lambda: sequential(bench, "qrqp", True), 40),
            "do-mpc (IPOPT)": (lambda: do_mpc_solver(bench), 20 if links < 10 else 4),
        }
        for name, (make, count) in makers.items():
            times[name] = seconds_other(make(), seen, count)
            advance(0.2, f"{links} links: {name}")
    full = float(np.median(times[EMITTED["rti"]]))
    zero = float(np.median(times[EMITTED["rti-zero"]]))
    return [
        {
            "links": links,
            "solver": name,
            "median_us": 1e6 * float(np.median(values)),
            "p99_us": 1e6 * float(np.percentile(values, 99)),
            "p99_over_median": float(np.percentile(values, 99) / np.median(values)),
            "over_full": float(np.median(values)) / full,
            "over_zero": float(np.median(values)) / zero,
        }
        for name, values in times.items()
    ]


class Converged(RealTimeIteration):
    """Sequential quadratic programming to convergence at every sample: the same iteration, repeated."""

    def decide(self, state: np.ndarray, disturbance: float, last: float) -> Command:
        command = super().decide(state, disturbance, last)
        for _ in range(MOST_ITERATIONS):
            before = self._plan.copy()
            self._plan = np.append(before[:1], before[:-1])  # what is shifted again becomes the plan as it is
            command = super().decide(state, disturbance, last)
            if np.abs(self._plan - before).max() < 1e-7:
                break
        return command


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
    step, problem, weights = bench.step, bench.problem, bench.problem.weights
    rows = outputs(bench)
    controller.reset()
    past, state, cost = np.zeros(step.delay.memory + 1), step.initial(), 0.0
    for _ in range(COSTED):
        torque = controller.command(np.array(step.sensors(state)).ravel()).torque
        past = np.append(past[1:], torque)
        state = np.array(step.sample(state, np.array(step.delay.pair(past)))).ravel()
        seen = {name: float(row @ state) for name, row in rows.items()}
        assert problem.tip is not None
        assert problem.hub is not None
        beyond = max(0.0, seen["tip"] - problem.tip[1])
        out = max(0.0, seen["hub"] - problem.hub[1], problem.hub[0] - seen["hub"])
        targets = {"tip": problem.reference, "hub": bench.links.target_hub}
        cost += 0.5 * sum(getattr(weights, k) * (v - targets.get(k, 0.0)) ** 2 for k, v in seen.items())
        cost += 0.5 * (weights.torque * torque**2 + weights.torque_step * (past[-1] - past[-2]) ** 2)
        cost += 0.5 * (weights.overshoot * beyond**2 + weights.hub_bound * out**2)
    return cost


def growth(rows: list[dict[str, object]]) -> list[dict[str, object]]:
    """Return the slope of log time over log links for each emitted controller."""
    found = []
    for name in EMITTED.values():
        points = {int(str(r["links"])): float(str(r["median_us"])) for r in rows if r["solver"] == name}
        x, y = np.log(list(points)), np.log(list(points.values()))
        found.append({"solver": name, "exponent": float(np.polyfit(x, y, 1)[0]), "links": len(points)})
    return found


def draw(rows: list[dict[str, object]], path: Path) -> None:
    """Draw the time of a sample over the number of links."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot as plt

    figure, axes = plt.subplots(figsize=(7.0, 4.2), layout="constrained")
    for name in dict.fromkeys(str(row["solver"]) for row in rows):
        points = [(int(str(r["links"])), float(str(r["median_us"]))) for r in rows if r["solver"] == name]
        own = name in EMITTED.values()
        axes.loglog(*zip(*points, strict=True), "o-" if own else "s--", label=name, markersize=4)
    axes.set(xlabel="links of the model", ylabel="processor time of a sample (us)")
    axes.set_xticks(GROWTH, [str(n) for n in GROWTH], minor=False)
    axes.minorticks_off()
    axes.grid(alpha=0.3)
    axes.legend(fontsize=8, loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False)
    figure.savefig(path, dpi=130)
    plt.close(figure)


def main() -> None:
    """Measure, print tables and write them as CSV."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--out", type=Path, default=Path("out/bench"))
    parser.add_argument("--links", type=int, nargs="*", default=LINKS)
    parser.add_argument("--growth", type=int, nargs="*", default=GROWTH)
    parser.add_argument(
        "--costs", type=int, nargs="*", default=COSTS, help="links at which to compare closed loops"
    )
    given = parser.parse_args()
    ca.GlobalOptions.setNumpyMode(-1)
    rows: list[dict[str, object]] = []
    counts = sorted({*given.links, *given.growth})
    with progress("measuring", total=len(counts)) as advance:
        for links in counts:
            rows += measure(links, links in given.links, advance)
            write_whole(given.out / "mpc_speed.csv", csv_text(rows))
    columns = [
        "links",
        "solver",
        Column("median_us", "median (us)", ".1f"),
        Column("p99_us", "99 % (us)", ".1f"),
        Column("p99_over_median", "99 % / median", ".2f"),
        Column("over_full", "times full RTI", ".1f"),
        Column("over_zero", "times zero order", ".1f"),
    ]
    table(rows, columns, title="one sample of MPC, one thread")
    slopes = growth(rows)
    table(slopes, ["solver", Column("exponent", "grows as links to the", ".2f")], title="growth")
    write_whole(given.out / "mpc_speed_growth.csv", csv_text(slopes))
    draw(rows, given.out / "mpc_speed.png")
    compared = [row for links in given.costs for row in costs(links)]
    columns = ["links", "solver", Column("cost", form=".8f"), Column("more", "more than converged", ".1e")]
    table(compared, columns, title="closed loop on the model")
    write_whole(given.out / "mpc_cost.csv", csv_text(compared))
    print(f"wrote {given.out / 'mpc_speed.csv'}, mpc_speed_growth.csv and mpc_cost.csv")


if __name__ == "__main__":
    main()

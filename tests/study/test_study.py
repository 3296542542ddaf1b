"""Errors are those an independent calculation finds; what fails is a row like any other."""

from __future__ import annotations

import json

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tmm_gen.errors import UserError
from tmm_gen.reference.assembly import assemble
from tmm_gen.scene import Scene
from tmm_gen.simulate.run import simulate
from tmm_gen.study.excitation import Excitation, excitation
from tmm_gen.study.findings import by_family, chosen_sentence, equal_steps, findings
from tmm_gen.study.grid import Axes, configurations
from tmm_gen.study.outcome import Outcome
from tmm_gen.study.references import References
from tmm_gen.study.study import Study, run_study


def test_time_error_is_what_scipy_and_numpy_find(chain: Scene, chain_study: Study) -> None:
    """Other kernel (NumPy), other reference (DOP853 on assembled matrices), every step looked at."""
    assembly = assemble(chain)
    load = chain_study.excitation.signals["torque"]

    def slope(time: float, y: np.ndarray) -> np.ndarray:
        q, v = y[:2], y[2:]
        forces = assembly.load @ [float(load.at(time))] - assembly.stiffness @ q - assembly.damping @ v
        return np.concatenate([v, forces / np.diag(assembly.mass)])

    exact = solve_ivp(
        slope, (0.0, 5.0), np.zeros(4), method="DOP853", rtol=1e-12, atol=1e-14, dense_output=True
    )
    compared = 0
    for point in chain_study.points:
        family = point.configuration.family
        if not point.finished or family.real != "float64" or point.configuration.step == 0.8:
            continue
        run = simulate(point.configuration.apply(chain), chain_study.excitation.signals, 5.0, "numpy")
        apart = np.abs(run.outputs["tip"] - exact.sol(run.time)[1])
        travel = float(np.max(np.abs(exact.sol(np.linspace(0, 5, 2001))[1])))
        assert point.result.error == pytest.approx(float(np.max(apart)) / travel, rel=1e-3, abs=1e-11)
        compared += 1
    assert compared >= 8


def test_orders_show(chain_study: Study) -> None:
    for name, order in (("newmark", 2.0), ("sdirk4", 4.0)):
        points = next(
            points
            for family, points in by_family(chain_study.points)
            if (family.integrator, family.real) == (name, "float64")
        )
        fine = [p.result.error for p in points if p.configuration.step in (0.1, 0.05, 0.025, 0.0125)]
        slopes = np.log2(np.array(fine[:-1], float) / np.array(fine[1:], float))
        assert slopes == pytest.approx([order] * 3, abs=0.15)


def test_what_fails_is_a_row(chain_study: Study) -> None:
    rows = {(p.configuration.family.label, p.configuration.step): p.result for p in chain_study.points}
    assert rows["newmark", 10.0].outcome is Outcome.REFUSED
    assert "longer than the whole time" in rows["newmark", 10.0].reason
    assert rows["zhai", 0.8].outcome is Outcome.DIVERGED
    assert rows["zhai", 0.8].error is None
    assert rows["newmark", 0.1].outcome is Outcome.FINISHED
    for point in chain_study.points:
        json.dumps(point.values(), allow_nan=False)


def test_unknown_not_suited_to_an_integrator_is_refused(chain: Scene) -> None:
    scene = chain.replace(**{"model.unknown": "displacement"})
    grid = configurations(scene, Axes(integrators=("zhai", "newmark"), steps=(0.01,)), 1.0)
    study = run_study(scene, excitation(scene, until=1.0), grid, rounds=0)
    outcomes = {p.configuration.family.integrator: p.result.outcome for p in study.points}
    assert outcomes == {"zhai": Outcome.REFUSED, "newmark": Outcome.FINISHED}


def test_an_output_that_stays_where_it_is_tells_nothing(arm: Scene) -> None:
    loss = [{"name": "loss", "at": "arm", "of": "dissipated_energy"}]
    scene = arm.replace(**{"output": loss, "beam.damping_time": None})
    grid = configurations(scene, Axes(integrators=("newmark",), steps=(0.01,)), 0.1)
    with pytest.raises(UserError, match=r"'loss' does not move in 0\.1 s"):
        run_study(scene, excitation(scene, until=0.1), grid, rounds=0)


def test_float32_has_a_floor(chain_study: Study) -> None:
    rows = {(p.configuration.family.label, p.configuration.step): p.result for p in chain_study.points}
    single, double = rows["sdirk4, float32", 0.0125], rows["sdirk4", 0.0125]
    assert single.error is not None
    assert double.error is not None
    assert double.error < 1e-7 < single.error < 1e-4
    assert single.state_bytes == (double.state_bytes or 0) // 2


def test_counts_and_costs(chain_study: Study) -> None:
    for point in chain_study.points:
        if not point.finished:
            continue
        result = point.result
        assert 0 < (result.operations or 0) < 1000
        assert 0 < (result.code_bytes or 0) < 20_000
        assert point.cost is not None
        assert point.cost.rounds == 3
        assert point.ns_per_second == pytest.approx(point.cost.ns_per_step / point.configuration.step)
    finished = [p for p in chain_study.points if p.finished]
    by_name = {p.configuration.family.label: p.cost.ns_per_step for p in finished if p.cost}
    assert by_name["sdirk4"] > by_name["newmark"]  # five sweeps against one: more than twice the time


def test_steps_of_a_tolerance_stand_beside_equal_ones(chain: Scene) -> None:
    went = excitation(chain, until=5.0)
    axes = Axes(integrators=("newmark", "houbolt"), steps=(0.1, 0.01, 0.001))
    told: list[str] = []
    study = run_study(
        chain,
        went,
        configurations(chain, axes, 5.0),
        rounds=0,
        tolerances=(1e-2, 1e-3),
        advance=lambda _, doing: told.append(doing),
    )
    coarse, fine, none = study.chosen
    for run in (coarse, fine):
        assert run.claimed is not None
        assert run.error is not None
        assert run.claimed <= run.tolerance
        assert run.error <= 2.0 * run.tolerance  # of this output, not of all links
        assert f"newmark by a tolerance of {run.tolerance:g}" in told
    # second order: the equal steps found by interpolation are as accurate
    count = equal_steps(study, fine)
    assert count is not None
    again = simulate(chain.replace(**{"integrator.step": 5.0 / count}), went.signals, 5.0)
    exact = References(chain, went).of(None).at(again.time)
    error = np.max(np.abs(again.outputs["tip"] - exact[0])) / study.travel
    assert error == pytest.approx(fine.error, rel=0.05)
    assert (none.family.integrator, none.steps) == ("houbolt", None)
    assert "reads instants a step apart" in chosen_sentence(study, none)


def test_backends_agree_and_links_are_an_error_of_their_own(arm_study: Study) -> None:
    rows = {(p.configuration.family, p.configuration.step): p.result for p in arm_study.points}
    for (family, step), result in rows.items():
        if family.backend == "numpy":
            other = next(
                r
                for (f, s), r in rows.items()
                if s == step
                and f.backend == "c"
                and (f.integrator, f.links) == (family.integrator, family.links)
            )
            assert result.error == pytest.approx(other.error, rel=1e-6)
            assert result.code_bytes is None
    few, more = (arm_study.modelling[n] for n in (3, 6))
    assert few.order == pytest.approx(2.0, abs=0.2)
    assert few.error > 3.0 * more.error > 0.0
    point = next(p for p in arm_study.points if p.finished)
    assert arm_study.varies_links
    assert arm_study.error(point) == (point.result.error or 0.0) + few.error


def test_modelling_error_is_the_distance_to_many_links(arm: Scene, arm_study: Study) -> None:
    """Against 30 links, which leave a twenty-fifth of the error of six."""
    from tmm_gen.reference.planar_reference import planar_response

    times = np.linspace(0.0, 0.5, 101)
    many, few = (
        np.array(
            [planar_response(arm.replace(**{"beam.links": n}), {}, times, 1e-8)[f"tip_{x}"] for x in "xy"]
        )
        for n in (30, 6)
    )
    apart = float(np.max(np.linalg.norm(few - many, axis=0))) / arm_study.travel
    assert arm_study.modelling[6].error == pytest.approx(apart, rel=0.08)


def test_findings_name_the_cheapest(chain_study: Study) -> None:
    for finding in findings(chain_study, (1e-2, 1e-4, 1e-6)):
        names = [way.family.label for way in finding.ways]
        assert len(names) == len(set(names))
        assert [way.cost for way in finding.ways] == sorted(way.cost for way in finding.ways)
    tight = findings(chain_study, (1e-7,))[0]
    assert tight.ways[0].family.integrator == "sdirk4"
    assert "Newmark's method does not get there" in tight.sentence()
    nobody = findings(chain_study, (1e-30,))[0]
    assert nobody.ways == ()
    assert nobody.sentence() == "At an error of 1e-30 nothing gets there."


def test_interpolated_steps_are_true(chain: Scene, chain_excitation: Excitation, chain_study: Study) -> None:
    """Newmark's way to 1e-3, computed: its error is 1e-3."""
    way = next(w for w in findings(chain_study, (1e-3,))[0].ways if w.family.integrator == "newmark")
    grid = configurations(chain, Axes(integrators=("newmark",), steps=(way.step,)), 5.0)
    point = run_study(chain, chain_excitation, grid[:1], rounds=0).points[0]
    assert point.result.error == pytest.approx(1e-3, rel=0.05)

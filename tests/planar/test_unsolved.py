"""What sweeps leave unsolved is weighed rightly: for every integrator and base, by the energy it makes."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from extremes_of_arms.arms import Extreme

from tmm_gen.derive.integrators.registry import names
from tmm_gen.inputs.signals import Constant, Table
from tmm_gen.scene import Scene, load_scene
from tmm_gen.simulate.run import simulate
from tmm_gen.simulate.tolerance import UnsolvedError, tolerance
from tmm_gen.simulate.unsolved import Unsolved

pytestmark = pytest.mark.compiler

ARM2 = load_scene(Path(__file__).resolve().parents[2] / "scenes" / "arm2.toml")


def left(scene: Scene, until: float, signals: dict[str, Any] | None = None) -> float:
    if scene.model.auto:
        scene = scene.replace(**{"model.iterations": 1})
    found = simulate(scene, signals or {}, until, "c", refuse=False, judge=False).unsolved
    assert found is not None
    return found


@pytest.mark.parametrize("name", [name for name in names() if name != "zhai"])
def test_a_second_sweep_leaves_next_to_nothing_whatever_the_integrator(name: str) -> None:
    """Had the place where its equations hold been wrong, the rest would not go; zhai is explicit and leaves none."""
    scene = ARM2.replace(**{"integrator": {"name": name, "step": 4e-3}})
    one = left(scene, 0.5)
    assert 1e-12 < one < 1e-7
    assert left(scene.replace(**{"model.iterations": 2}), 0.5) < 1e-4 * one


@pytest.mark.parametrize("base", ["clamp", "motor", "prescribed"])
def test_every_base(base: str, unlike: Callable[..., Scene], swinging: Any) -> None:
    scene = unlike(base, step=5e-3)
    one = left(scene, 0.3, swinging(scene))
    assert one > 1e-5
    assert left(scene.replace(**{"model.iterations": 2}), 0.3, swinging(scene)) < 1e-3 * one


def test_it_is_the_energy_that_comes_from_nowhere() -> None:
    """Where the step itself loses next to none, the balance of energies, from other formulas, says the same."""
    scene = Extreme(links=100, iterations=1).scene()
    run = simulate(scene, {}, 500 * scene.integrator.step, "c", trace=True, refuse=False, judge=False)
    assert run.unsolved is not None
    assert run.unsolved > 1e-4
    assert run.imbalance == pytest.approx(run.unsolved, rel=0.02)


FINE = Extreme(links=20, stiffness=1e4, slenderness=1e-3, tip_ratio=1.0, revolutions=0.1, iterations=1)
LONG = Extreme(step=0.04, iterations=1)


@pytest.mark.parametrize(
    ("extreme", "why"),
    [(FINE, "the step's own error explains but"), (LONG, "more than the 0.0001 that any step may leave")],
    ids=["where the step is fine", "where it is long"],
)
def test_what_is_refused_passes_by_each_remedy_that_is_named(extreme: Extreme, why: str) -> None:
    scene = extreme.scene()
    until = extreme.steps * scene.integrator.step
    with pytest.raises(UnsolvedError) as refusal:
        simulate(scene, {}, until, "c")
    said = str(refusal.value)
    assert why in said
    accepted = said.partition("--set model.unsolved=")[2].removesuffix(".")
    assert "--iterations auto;" in said
    assert f"--step {scene.integrator.step / 10:g};" in said
    for remedy in (
        {"model.iterations": "auto"},
        {"integrator.step": scene.integrator.step / 10},
        {"model.unsolved": float(accepted)},
    ):
        simulate(scene.replace(**remedy), {}, until, "c")


def test_both_figures_are_in_the_result() -> None:
    """Whether it is refused or not; the step's error is about the first mode's, late by (w h)^2 / 12."""
    scene = FINE.scene()
    run = simulate(scene, {}, FINE.steps * scene.integrator.step, "c", refuse=False, judge=False)
    assert run.unsolved is not None
    assert run.step_error is not None
    assert run.unsolved > tolerance(scene, run.step_error)
    half_a_swing = Extreme()
    scene = half_a_swing.scene()
    run = simulate(scene, {}, half_a_swing.steps * scene.integrator.step, "c")
    assert run.step_error == pytest.approx((2.0 * np.pi * 1e-3) ** 2 / 12.0, rel=1.5)


def test_rounding_is_no_fault_of_the_sweeps() -> None:
    single = ARM2.replace(**{"emit.real": "float32"})
    assert left(single, 1.0) == 0.0
    # sums of two leave room to see what the sweeps do
    double = left(ARM2.replace(**{"integrator.step": 4e-3}), 0.5)
    both = {"emit.compensated": True, "emit.trigonometry": "own", "integrator.step": 4e-3}
    assert left(single.replace(**both), 0.5) == pytest.approx(double, rel=0.1)


def test_what_follows_a_kink_of_an_input_is_looked_at() -> None:
    torque = Table(np.array([0.0, 30.001, 30.002, 60.0]), np.array([0.0, 0.0, 5.0, 5.0]))
    steps = Unsolved(ARM2, {"hub_torque": torque, "other": Constant(1.0)}, 60_000).instants()
    assert set(range(1, 21)) | set(range(30_001, 30_021)) <= set(steps)
    assert len(steps) < 600
    assert steps[-1] == 60_000


def test_a_run_of_a_single_step_is_looked_at() -> None:
    assert left(ARM2, 1e-3) < 1e-9

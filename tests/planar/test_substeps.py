"""Steps that are too long for the motion are divided by `run`, and by nobody else."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from extremes_of_arms.arms import Extreme, judge
from extremes_of_arms.verdict import SAYS

from tmm_gen.cli import main
from tmm_gen.errors import UserError
from tmm_gen.reference.planar_reference import planar_response
from tmm_gen.scene import Scene
from tmm_gen.simulate.run import simulate
from tmm_gen.simulate.simulation import Simulation
from tmm_gen.simulate.stepping import Backend, Stepper
from tmm_gen.simulate.substeps import MOST_TO_TAKE, SUBSTEPS, divided
from tmm_gen.simulate.tolerance import InaccurateError
from tmm_gen.simulate.too_long import TooLongError

LONG = {"integrator.step": 0.1}

LET_GO = """
name = "let_go"
[model]
kind = "planar"
gravity = 4.9
[integrator]
name = "newmark"
step = 0.1
[base]
kind = "clamp"
[beam]
length = 1.0
bending_stiffness = 1.6
mass_per_length = 0.5
links = 2
damping_time = 0.002
[[output]]
name = "tip"
at = "tip"
of = "position"
"""


def off(run: Simulation) -> float:
    """Return the error of the tip, as a share of how far it goes."""
    exact = planar_response(run.scene, {}, run.time)
    apart = np.hypot(*(run.outputs[name] - exact[name] for name in exact))
    moved = np.hypot(*(values - values[0] for values in exact.values()))
    return float(np.max(apart) / np.max(moved))


@pytest.mark.compiler
def test_right_in_both_backends_with_rows_at_the_scenes_step(falling: Callable[..., Scene]) -> None:
    scene = falling(2, **LONG)
    with pytest.raises(InaccurateError) as refusal:
        simulate(scene, {}, 2.0, "c")
    runs = [simulate(scene, {}, 2.0, backend, substeps=True) for backend in ("numpy", "c")]
    for run in runs:
        assert run.scene is scene
        np.testing.assert_array_equal(run.time, 0.1 * np.arange(21))
        assert run.substeps.count in SUBSTEPS
        assert run.substeps.because == refusal.value.reason
        assert run.accuracy is not None
        assert off(run) <= SAYS * run.accuracy.error <= SAYS * 0.05
    assert runs[0].substeps == runs[1].substeps
    for name, values in runs[0].outputs.items():
        np.testing.assert_allclose(values, runs[1].outputs[name], rtol=0, atol=1e-9)


@pytest.mark.compiler
@pytest.mark.parametrize(("backend", "integrator"), [("numpy", "newmark"), ("c", "sdirk4"), ("c", "houbolt")])
def test_the_same_bits_as_a_run_at_that_step(
    backend: Any, integrator: str, unlike: Callable[..., Scene], swinging: Any
) -> None:
    """One, three stages, and start-up steps; every kind of load, read at the substeps' own stages."""
    scene = unlike("motor", 2, integrator=integrator, step=0.1)
    signals = swinging(scene)
    kernel = Stepper.of(scene, backend).kernel
    run = simulate(scene, signals, 0.5, backend, kernel=kernel, substeps=True, trace=True)
    count = run.substeps.count
    assert count > 1
    used = scene.replace(**{"integrator.step": 0.1 / count})
    finer = simulate(used, signals, 0.5, backend, kernel=kernel, trace=True)
    assert run.accuracy == finer.accuracy
    assert run.imbalance == finer.imbalance
    assert run.unsolved == finer.unsolved
    for name, values in finer.outputs.items():
        np.testing.assert_array_equal(run.outputs[name], values[::count])
    assert run.trace is not None
    assert finer.trace is not None
    np.testing.assert_array_equal(run.trace.angle, finer.trace.angle[::count])
    assert run.trace.count == len(run.time)


@pytest.mark.compiler
def test_a_step_that_will_do_is_taken_whole(falling: Callable[..., Scene]) -> None:
    run = simulate(falling(2), {}, 0.2, "c", substeps=True)
    assert run.substeps.count == 1
    assert not run.substeps.because


@pytest.mark.long
@pytest.mark.compiler
def test_a_start_too_fast_for_the_step() -> None:
    fast = Extreme(revolutions=100.0, step=0.01)
    refused = judge(fast, substeps=False)
    assert refused.status == "refused"
    assert "Use a step below" in refused.said
    verdict = judge(fast)
    assert verdict.status == "right", verdict
    assert verdict.substeps > 1


@pytest.mark.compiler
def test_a_number_of_sweeps_keeps_the_refusal(falling: Callable[..., Scene]) -> None:
    with pytest.raises(InaccurateError):
        simulate(falling(2, **LONG, **{"model.iterations": 2}), {}, 2.0, "c", substeps=True)


def test_the_least_that_may_do_is_tried_first_and_the_refusal_says_what_was(
    falling: Callable[..., Scene],
) -> None:
    def refused(times: float, mended: int, steps: int = 10, backend: Backend = "c") -> tuple[list[int], str]:
        tried: list[int] = []

        def attempt(scene: Scene, count: int) -> int:
            assert scene.integrator.step == 0.1 / count
            tried.append(count)
            if count < mended:
                raise TooLongError(f"not {count}.", times=times / count)
            return count

        try:
            divided(falling(2, **LONG), steps, backend, attempt, lambda count: None)
        except TooLongError as error:
            return tried, str(error)
        return tried, ""

    assert refused(1.0, 16) == ([1, 4, 16], "")
    assert refused(10.0, 16) == ([1, 16], "")
    assert refused(1e6, 256) == ([1, 256], "")
    assert refused(1.0, 1000) == (
        [1, 4, 16, 64, 256],
        "not 256.\nSo it is with 4, 16, 64 and 256 substeps per step of 0.1 s, the last of which this was said of.",
    )
    some, none = (MOST_TO_TAKE["c"] // (2 * most) for most in (20, 3))
    tried, said = refused(100.0, 1000, some)
    assert tried == [1, 16]
    assert said.endswith("said of, and more than 20 substeps per step are too many to take.")
    tried, said = refused(1.0, 1000, none)
    assert tried == [1]
    assert said == "not 1.\nSubsteps might do, but even 4 per step are too many to take."
    tried, said = refused(1.0, 1000, some, "numpy")
    assert tried == [1]
    assert said.endswith("too many to take; --backend c takes more.")


def test_what_shorter_steps_do_not_mend_is_refused_at_once(falling: Callable[..., Scene]) -> None:
    tried = []

    def attempt(_scene: Scene, count: int) -> None:
        tried.append(count)
        raise UserError("an angle that jumps")

    with pytest.raises(UserError, match="jumps"):
        divided(falling(2), 10, "c", attempt, lambda count: None)
    assert tried == [1]


@pytest.mark.compiler
def test_progress_goes_back_and_ends_at_the_steps(falling: Callable[..., Scene]) -> None:
    told: list[tuple[float, str | None]] = []
    run = simulate(
        falling(2, **LONG), {}, 2.0, "c", lambda count, doing=None: told.append((count, doing)), substeps=True
    )
    back = [(count, doing) for count, doing in told if doing]
    assert back
    assert back[-1][1] == f"falling: the step is too long, {run.substeps.count} substeps each"
    assert all(count < 0.0 for count, _ in back)
    assert sum(count for count, _ in told) == pytest.approx(run.steps + 1.0 / run.substeps.count)


@pytest.mark.compiler
class TestCommand:
    @pytest.fixture
    def told(self, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Callable[..., tuple[int, str]]:
        file = tmp_path / "let_go.toml"
        file.write_text(LET_GO)

        def told(*options: str) -> tuple[int, str]:
            code = main(["run", str(file), "--until", "2", "--backend", "c", *options])
            captured = capsys.readouterr()
            return code, captured.out + captured.err

        return told

    def test_says_so_and_why(self, told: Callable[..., tuple[int, str]], tmp_path: Path) -> None:
        code, said = told("--csv", str(tmp_path / "out.csv"))
        assert code == 0, said
        assert "2 s in 20 steps of 0.1 s by newmark" in said
        assert " substeps per step: at the scene's step of 0.1 s the error would be about " in said
        assert "(which --step 0.1 refuses)" in said
        assert len((tmp_path / "out.csv").read_text().splitlines()) == 22

    def test_json(self, told: Callable[..., tuple[int, str]]) -> None:
        code, said = told("--json")
        assert code == 0, said
        found = json.loads(said)
        assert found["substeps"] in SUBSTEPS
        assert found["substeps_since"] == 0.0
        assert (found["step"], found["steps"]) == (0.1, 20)
        whole = json.loads(told("--json", "--step", "0.001")[1])
        assert whole["substeps"] == 1

    @pytest.mark.parametrize(
        "asked", [("--step", "0.1"), ("--set", "integrator.step=0.1"), ("--iterations", "2")]
    )
    def test_what_is_asked_for_stays(
        self, asked: tuple[str, ...], told: Callable[..., tuple[int, str]]
    ) -> None:
        code, said = told(*asked)
        assert code == 1
        assert "more than the 5 % that a run may have" in said
        assert "substeps" not in said

    def test_the_remedies_of_the_last_refusal_work(self, told: Callable[..., tuple[int, str]]) -> None:
        code, said = told("--set", "model.accuracy=1e-9")
        assert code == 1
        assert "256 substeps per step of 0.1 s" in said
        step = said.partition("--step ")[2].partition(";")[0]
        accepted = said.partition("model.accuracy=")[2].partition(".\n")[0]
        assert float(step) < 0.1 / 256
        code, said = told("--set", f"model.accuracy={accepted}", "--json")
        assert code == 0, said
        assert json.loads(said)["substeps"] == 256


@pytest.mark.compiler
def test_arms_drawn_at_random_are_right_or_refused() -> None:
    random = np.random.default_rng(7)
    counts = []
    for _ in range(8):
        verdict = judge(
            Extreme(
                links=int(random.choice([1, 2, 5])),
                stiffness=float(10.0 ** random.uniform(-3, 3)),
                slenderness=float(10.0 ** random.uniform(-2, 1)),
                tip_ratio=float(random.choice([0.0, 1.0, 100.0])),
                step=float(10.0 ** random.uniform(-2, -1)),
                revolutions=float(random.choice([0.0, 0.1, 1.0])),
            )
        )
        assert verdict.status != "wrong", verdict
        counts.append(verdict.substeps)
    assert sum(count > 1 for count in counts) >= 4

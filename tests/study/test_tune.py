"""What `tune` claims is what an independent run finds; what it cannot do, it says."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from tmm_gen.errors import UserError
from tmm_gen.inputs.waveforms import Step
from tmm_gen.reference.reference import exact_response
from tmm_gen.scene import Scene, load_scene, parse_scene
from tmm_gen.simulate.run import simulate
from tmm_gen.study.bounds import ErrorBound
from tmm_gen.study.by_tolerance import require_desktop
from tmm_gen.study.configuration import Configuration, Family, own
from tmm_gen.study.excitation import Excitation, columns, excitation
from tmm_gen.study.explain import explained, remarks, tuned_text
from tmm_gen.study.grid import Axes
from tmm_gen.study.outcome import Outcome, Result
from tmm_gen.study.rewrite import rewritten
from tmm_gen.study.search import longest_step, rounded_down
from tmm_gen.study.tune import Tuning, tune

SCENES = Path(__file__).resolve().parents[2] / "scenes"
RELATIVE = ErrorBound(1e-3, "")


def claimed(tuning: Tuning) -> float:
    assert tuning.verified is not None
    return tuning.verified.error


@pytest.mark.parametrize(
    ("name", "until", "integrators"),
    [
        ("thesis10", 20.0, ("newmark", "sdirk4")),
        ("fall10", 1.0, ("newmark", "bathe")),
        ("arm2", 0.5, ("newmark",)),
    ],
)
def test_claimed_error_is_found_by_another_run(name: str, until: float, integrators: tuple[str, ...]) -> None:
    """From the written file alone, with the NumPy kernel, at every step."""
    path = SCENES / f"{name}.toml"
    scene = load_scene(path)
    went = excitation(scene, until=until)
    tuning = tune(scene, went, RELATIVE, 1.0, Axes(integrators=integrators), rounds=1)
    assert tuning.chosen is not None
    assert tuning.verified is not None
    accepted = tuning.verified.accepted
    text = rewritten(path.read_text(), scene, tuning.chosen.configuration, remarks(tuning), accepted)
    written = parse_scene(text)
    run = simulate(written, went.signals, until, "numpy")
    times = run.time[run.time <= until * (1 + 1e-9)]
    exact = exact_response(written, went.signals, times)
    names = columns(written, went.output)
    true = np.array([exact[column] for column in names])
    found = np.array([run.outputs[column][: len(times)] for column in names])
    travel = np.max(np.linalg.norm(true - true[:, :1], axis=0))
    error = float(np.max(np.linalg.norm(found - true, axis=0)) / travel)
    assert error <= 1.001e-3
    assert claimed(tuning) == pytest.approx(error, rel=0.05)
    assert error > 5e-4  # it does not pay for accuracy that nobody asked for


def test_the_cheapest_wins_and_is_explained(chain: Scene) -> None:
    went = excitation(chain, until=5.0)
    axes = Axes(integrators=("newmark", "houbolt", "sdirk4"))
    tuning = tune(chain, went, ErrorBound(1e-5, ""), 1.0, axes, rounds=3)
    assert tuning.chosen is not None
    costs = [point.ns_per_second or 0.0 for point in tuning.candidates]
    assert tuning.chosen.configuration.family.integrator == "sdirk4"
    assert costs == sorted(costs)
    text = " ".join(explained(tuning))
    for part in (
        "sdirk4 with steps of",
        "Longer steps will not do",
        "Next comes newmark",
        "The scene as it was",
    ):
        assert part in text


def test_nothing_is_fast_enough(chain: Scene) -> None:
    went = excitation(chain, until=5.0)
    tuning = tune(chain, went, RELATIVE, 1e-12, Axes(integrators=("newmark",)), rounds=1)
    assert tuning.chosen is None
    text = " ".join(explained(tuning))
    assert "Nearest: newmark" in text
    assert "times the time allowed" in text


def test_nothing_is_accurate_enough(chain: Scene) -> None:
    went = excitation(chain, until=1.0)
    axes = Axes(integrators=("newmark",), reals=("float32",))
    tuning = tune(chain, went, ErrorBound(1e-13, ""), 1.0, axes, rounds=1)
    assert tuning.chosen is None
    assert tuning.candidates == ()
    text = " ".join(explained(tuning))
    assert "whatever it costs" in text
    assert "Nearest: newmark, float32" in text


def test_links_are_chosen_too(arm: Scene) -> None:
    went = excitation(arm, until=0.3)
    axes = Axes(integrators=("newmark",))
    tuning = tune(arm, went, ErrorBound(0.05, ""), 1.0, axes, auto_links=True, rounds=1)
    assert tuning.chosen is not None
    links = tuning.chosen.configuration.family.links
    modelling = tuning.chosen.result.modelling_error
    assert links is not None
    assert modelling is not None
    assert modelling + claimed(tuning) <= 0.05
    # against a beam of many links, by another reference
    from tmm_gen.reference.planar_reference import planar_response

    many = arm.replace(**{"beam.links": 8 * links})
    run = simulate(tuning.chosen.configuration.apply(arm), went.signals, 0.3, "numpy")
    times = run.time[run.time <= 0.3]
    exact = planar_response(many, {}, times, 1e-8)
    apart = np.hypot(*(run.outputs[f"tip_{x}"][: len(times)] - exact[f"tip_{x}"] for x in "xy"))
    assert float(np.max(apart)) / tuning.travel <= 0.05


def test_links_of_a_chain_cannot_be_chosen(chain: Scene) -> None:
    with pytest.raises(UserError, match="takes a \\[beam\\]"):
        tune(chain, excitation(chain, until=1.0), RELATIVE, 1.0, Axes(), auto_links=True)


def test_a_budget_excludes(chain: Scene) -> None:
    def allowance(configuration: Configuration) -> str | None:
        return "too large" if configuration.family.integrator == "sdirk4" else None

    went = excitation(chain, until=5.0)
    axes = Axes(integrators=("newmark", "sdirk4"))
    tuning = tune(chain, went, ErrorBound(1e-5, ""), 1.0, axes, allowance=allowance, rounds=3)  # type: ignore[arg-type]
    assert tuning.chosen is not None
    assert tuning.chosen.configuration.family.integrator == "newmark"
    assert "sdirk4 would be cheaper but does not fit the budget: too large." in explained(tuning)


FAMILY = Family("newmark", None, None, 1, "float64", "c")


def test_search_finds_the_crossing_of_a_known_error() -> None:
    def evaluate(configuration: Configuration) -> Result:
        if configuration.step > 0.2:
            return Result(Outcome.DIVERGED)
        return Result(Outcome.FINISHED, error=configuration.step**2)

    found = longest_step(FAMILY, 1e-4, 40.0, evaluate)
    assert found is not None
    assert found.good
    assert 0.0095 <= found.configuration.step <= 0.01
    assert found.beyond is not None
    assert 0.01 < found.beyond[0].step < 0.0105


def test_search_is_not_fooled_by_one_good_step() -> None:
    def evaluate(configuration: Configuration) -> Result:
        lucky = 0.2 < configuration.step < 0.3
        return Result(Outcome.FINISHED, error=0.0 if lucky else configuration.step**2)

    found = longest_step(FAMILY, 1e-4, 40.0, evaluate)
    assert found is not None
    assert found.configuration.step <= 0.01


def test_search_gives_up_what_never_finishes() -> None:
    assert longest_step(FAMILY, 1e-4, 40.0, lambda _: Result(Outcome.REFUSED)) is None


@pytest.mark.parametrize(("step", "neat"), [(0.0123, 0.012), (0.01, 0.01), (9.99e-7, 9.9e-7), (123.0, 120.0)])
def test_rounding_down(step: float, neat: float) -> None:
    assert rounded_down(step) == neat


def test_a_rewritten_scene_keeps_what_the_user_wrote(chain: Scene) -> None:
    from .conftest import CHAIN

    family = Family("sdirk4", None, None, 1, "float32", "c")
    text = rewritten(CHAIN, chain, Configuration(family, 0.3), ["why"])
    assert text.startswith("# why\n#\n")
    assert "step = 0.3  # a step" in text
    assert "beta" not in text
    assert '[emit]\nreal = "float32"' in text
    kept = [line for line in CHAIN.splitlines() if not line.startswith(("beta", "step", 'name = "newmark'))]
    assert [line for line in text.splitlines() if line in kept and line] == [line for line in kept if line]


def test_a_rewritten_scene_takes_the_steps_that_were_tuned(chain: Scene) -> None:
    from .conftest import CHAIN

    steady = CHAIN.replace("step = 0.02", "tolerance = 1e-6\nstep = 0.02")
    text = rewritten(steady, parse_scene(steady), Configuration(own(chain).family, 0.3), ["why"])
    assert "tolerance" not in text
    assert "beta = 0.25" in text


def test_a_rewritten_scene_accepts_what_its_sweeps_leave(arm: Scene) -> None:
    """Else `run` would refuse what `tune` has verified."""
    from .conftest import ARM

    configuration = Configuration(Family("newmark", 3, "newton", 1, "float64", "c"), 0.05)
    assert "unsolved" not in rewritten(ARM, arm, configuration, [])
    text = rewritten(ARM, arm, configuration, [], 4e-4)
    assert parse_scene(text).model.unsolved == 4e-4


@pytest.fixture(scope="module")
def jumping(chain: Scene) -> Excitation:
    """A push that ends within a step costs equal steps their order; by a tolerance steps end there."""
    return excitation(chain, {item.name: Step(1.0, 0.0, 0.51377) for item in chain.inputs}, until=1.0)


@pytest.mark.compiler
def test_tolerances_are_tried_where_asked_for(chain: Scene, jumping: Excitation) -> None:
    from .conftest import CHAIN

    axes = Axes(integrators=("sdirk4", "houbolt"))
    tuning = tune(chain, jumping, RELATIVE, 10.0, axes, rounds=1, tolerances=True)
    (each,) = tuning.by_tolerance  # houbolt's steps cannot change on the way
    run = each.run
    assert run.family.integrator == "sdirk4"
    assert run.tolerance <= 1e-3
    assert run.error is not None
    assert run.error <= 1e-3
    assert each.ns_per_second > 0.0
    # which of both is cheaper is the machine's to say; each may be dearer than the other by so much
    assert tuning.verified is not None
    equal = replace(tuning.verified, ns_per_second=0.5 * each.ns_per_second)
    assert replace(tuning, verified=equal).cheaper is None
    equal = replace(tuning.verified, ns_per_second=2.0 * each.ns_per_second)
    dear = replace(tuning, verified=equal)
    assert dear.cheaper is each
    first, second = explained(dear)[:2]
    assert first.startswith(f"sdirk4 by a tolerance of {run.tolerance:g}: {run.steps} steps, from ")
    assert second.startswith("Of equal steps, ")
    alone = replace(tuning, chosen=None, verified=None)
    assert alone.found
    assert not replace(alone, max_time=0.5e-9 * each.ns_per_second).found
    written = parse_scene(tuned_text(dear, CHAIN))
    assert written == chain.replace(**{"integrator.name": "sdirk4", "integrator.tolerance": run.tolerance})
    # what is written does by NumPy what was claimed
    found = simulate(written, jumping.signals, 1.0, "numpy")
    exact = exact_response(written, jumping.signals, found.time)
    names = columns(written, jumping.output)
    off = [float(np.max(np.abs(found.outputs[name] - exact[name]))) / tuning.travel for name in names]
    assert max(off) == pytest.approx(run.error, rel=0.05)


@pytest.mark.parametrize(
    ("changes", "target", "auto_links", "told"),
    [
        ({}, "cortex-m4", False, "Leave out --target"),
        ({"emit.budget": {"flash": 1000}}, None, False, "is for a controller"),
        ({}, None, True, "leave out --links"),
    ],
)
def test_tolerances_are_for_computers(
    chain: Scene, changes: dict[str, object], target: str | None, auto_links: bool, told: str
) -> None:
    with pytest.raises(UserError, match=told):
        require_desktop(chain.replace(**changes), target, auto_links=auto_links)
    require_desktop(chain, None, auto_links=False)

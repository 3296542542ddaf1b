"""Studies of arms in space: errors against the reference, loads of the arm's size, cells and corrections varied."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest
from support.spatial.boom import BOOM
from support.spatial.moving import AFLOAT, TABLE
from support.spatial.palm import PALM

from tmm_gen.cli import main
from tmm_gen.inputs.signals import Constant
from tmm_gen.reference.spatial_arm import WorldArm
from tmm_gen.reference.spatial_reference import spatial_response
from tmm_gen.scene import Scene, load_scene, parse_scene
from tmm_gen.study.cells import cuts
from tmm_gen.study.configuration import Configuration, own
from tmm_gen.study.excitation import Excitation, excitation
from tmm_gen.study.grid import Axes, configurations, families
from tmm_gen.study.modelling import depends_on_links, modelling_errors
from tmm_gen.study.rewrite import rewritten
from tmm_gen.study.study import Study, run_study
from tmm_gen.study.truth import find_truth

pytestmark = pytest.mark.compiler

UNTIL = 0.4


@pytest.fixture(scope="module")
def palm() -> Scene:
    """A heavy arm on a spring, and a light finger on a joint that nothing holds."""
    return parse_scene(PALM, "palm.toml")


@pytest.fixture(scope="module")
def study(palm: Scene) -> Study:
    axes = Axes(("newmark",), steps=(8e-3, 4e-3, 2e-3), iterations=(1, 2), reals=("float64", "float32"))
    return run_study(palm, went(palm), configurations(palm, axes, UNTIL), rounds=0)


def went(scene: Scene) -> Excitation:
    return excitation(scene, until=UNTIL)


def test_a_free_joint_gets_a_load_of_what_it_carries(palm: Scene) -> None:
    """And not one of the arm's whole inertia; what it turns goes on all the time as the first half swing sends it."""
    found = went(palm)
    assert found.output == "nail"
    assert set(found.signals) == {"twist", "push_x", "push_y", "push_z"}
    nail, frequency = 5e-6 + 0.02 * 0.025**2, found.signals["twist"].frequency
    passed = frequency * UNTIL
    turn = found.signals["twist"].amplitude / (nail * frequency**2) * (passed - np.sin(passed))
    assert 0.25 < turn < 1.1  # of a radian together; amplitudes have one digit
    amplitudes = [signal.amplitude for name, signal in found.signals.items() if name != "twist"]
    assert amplitudes == [amplitudes[0]] * 3
    assert found.told(palm)[0].startswith("twist: ")


def test_loads_turn_the_arm_by_about_a_radian(palm: Scene) -> None:
    """By the reference's own motion, which knows nothing of how loads were chosen."""
    assert palm.spatial is not None
    found = went(palm)
    times = np.linspace(0.0, UNTIL, 81)
    response = spatial_response(palm.spatial, found.signals, times)
    assert 0.0 < float(np.ptp(response["root"])) < 1.5
    turned = find_truth(palm, found).trajectory
    assert turned is not None
    q, _, _ = turned.at(times)
    # pushes along the finger act across it as soon as it turns, and hold it back: less than in small motion
    assert 0.15 < float(np.max(np.abs(q))) < 1.4
    assert np.all(np.isfinite(WorldArm(palm.spatial).mass_matrix(q[-1])))


@pytest.mark.parametrize("text", [AFLOAT, TABLE], ids=["floats", "prescribed"])
def test_bases_that_move_are_studied_too(text: str) -> None:
    """Of second order against the reference, under loads that move the arm by about its own size."""
    scene = parse_scene(text)
    found = excitation(scene, until=0.3)
    loads = configurations(scene, Axes(("newmark",), steps=(4e-3, 2e-3)), 0.3)
    points = run_study(scene, found, loads, rounds=0).points
    coarse, fine = (next(p.error for p in points if p.configuration.step == step) for step in (4e-3, 2e-3))
    assert coarse / fine == pytest.approx(4.0, rel=0.1)
    values = find_truth(scene, found).at(np.linspace(0.0, 0.3, 31))
    assert 0.02 < float(np.max(np.ptp(values, axis=1))) < 2.0


def test_a_force_through_all_axes_is_no_absurd_one() -> None:
    """At the hinge's own point it turns nothing but by rounding."""
    scene = parse_scene(TABLE.replace('at = "tip", acts = "force"', 'at = "load", acts = "force"'))
    signals = excitation(scene).signals
    assert [getattr(signals[f"push_{axis}"], "amplitude", None) for axis in "xyz"] == [1.0] * 3


def errors(study: Study, iterations: int, real: str = "float64") -> Mapping[float, float]:
    return {
        p.configuration.step: p.result.error
        for p in study.points
        if (p.configuration.family.iterations, p.configuration.family.real) == (iterations, real)
        and p.result.error is not None
    }


def test_errors_fall_with_the_square_of_the_step(study: Study) -> None:
    for iterations in (1, 2):
        found = errors(study, iterations)
        assert len(found) == 3
        assert np.log2(found[4e-3] / found[2e-3]) == pytest.approx(2.0, abs=0.25)
    double, single = errors(study, 2)[2e-3], errors(study, 2, "float32")[2e-3]
    assert 0.0 < abs(double - single) < 1e-3


def test_a_correction_costs_what_explain_counts(study: Study) -> None:
    counts = {p.configuration.family.iterations: p.result.operations for p in study.points}
    assert counts[1] is not None
    assert counts[2] is not None
    assert counts[1] < counts[2] < 2 * counts[1]


def test_rounds_are_those_that_suit_each_integrator(palm: Scene) -> None:
    axes = Axes(integrators=("newmark", "sdirk4"), linearisations=("inertial", "newton"))
    usual = {(f.integrator, f.linearisation): f.iterations for f in families(palm, axes)}
    assert usual == {
        ("newmark", "inertial"): 2,
        ("newmark", "newton"): 1,
        ("sdirk4", "inertial"): 3,
        ("sdirk4", "newton"): 1,
    }
    for family in families(palm, axes):
        made = Configuration(family, 1e-3).apply(palm)
        assert (made.model.sweeps, made.model.linearisation) == (family.iterations, family.linearisation)
    given = palm.replace(**{"model.iterations": 4})
    assert {f.iterations for f in families(given, axes)} == {4}


def test_cells_of_all_beams_are_varied() -> None:
    scene = parse_scene(BOOM, "boom.toml")
    assert own(scene).family.links == 1
    assert cuts(scene, 3) == {"beam.rod.links": (1, 3)}
    chosen = Configuration(families(scene, Axes(integrators=("newmark",), links=(3,)))[0], 1e-3)
    made = parse_scene(rewritten(BOOM, scene, chosen, ["cut anew"]))
    assert made.spatial is not None
    assert scene.spatial is not None
    assert len(made.spatial.joints) == len(scene.spatial.joints) + 2 * 3
    assert made.integrator.step == 1e-3


def test_cells_are_an_error_of_their_own() -> None:
    """Which falls with the square of their number; the limit is extrapolated from references."""
    short = BOOM.replace("links = 1", "links = 2").replace("length = 0.5", "length = 0.3")
    scene = parse_scene(short, "boom.toml")
    gone = excitation(scene, {"push_x": Constant(0.0), "torque": Constant(0.01)}, until=0.02)
    assert depends_on_links(scene, gone)
    found = modelling_errors([2], lambda n: find_truth(scene.replace(**{"beam.rod.links": n}), gone))
    assert found[12].error < found[6].error < found[3].error < found[2].error
    assert found[2].order == pytest.approx(2.0, abs=0.5)


def test_beams_of_different_cells_stay_as_they_are() -> None:
    tail = '[[beam]]\nname = "tail"\non = "rod"\nlength = 0.1\nlinks = 2\n'
    more = tail + "bending_stiffness = 1.0\nmass_per_length = 0.1\n"
    scene = parse_scene(BOOM.replace("[[body]]", more + "[[body]]", 1))
    assert own(scene).family.links is None
    assert {f.links for f in families(scene, Axes(integrators=("newmark",), links=(2, 3)))} == {2, 3}


def test_tune_writes_the_scene_it_has_chosen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("palm.toml").write_text(PALM)
    bounds = ["--max-error", "1e-2", "--max-time", "1s", "--until", str(UNTIL)]
    assert (
        main(["tune", "palm.toml", *bounds, "--integrators", "newmark", "--out", "best.toml", "--json"]) == 0
    )
    told = json.loads(capsys.readouterr().out)
    tuned = load_scene(Path("best.toml"))
    assert tuned.spatial is not None
    assert tuned.integrator.step != 2e-3
    axes = Axes(integrators=("newmark",), steps=(tuned.integrator.step,))
    again = run_study(tuned, went(tuned), configurations(tuned, axes, UNTIL), rounds=0)
    assert again.points[0].result.error is not None
    assert again.points[0].result.error <= 1e-2
    assert told["scene"] == "palm"


def test_trade_shows_what_costs_least(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("palm.toml").write_text(PALM)
    words = ["--integrators", "newmark", "--steps", "8e-3,4e-3", "--until", str(UNTIL), "--rounds", "1"]
    assert main(["trade", "palm.toml", *words, "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["output"] == "nail"
    assert [row["outcome"] for row in told["rows"]] == ["finished"] * 3

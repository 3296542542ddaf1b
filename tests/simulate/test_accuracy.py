"""A run of a chain says how wrong it is, and is refused where that is too much: whatever the step, load and backend."""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import pytest
from extremes_of_chains.long_steps import SAYS, judge, long_steps

from tmm_gen.cli import main
from tmm_gen.reference.reference import exact_response
from tmm_gen.scene import Scene, parse_scene
from tmm_gen.simulate.run import simulate
from tmm_gen.simulate.tolerance import InaccurateError

TWO = """
name = "two"
[model]
kind = "chain"
[integrator]
name = "{integrator}"
step = {step}
[base]
kind = "clamp"
[[joint]]
stiffness = 40.0
repeat = 2
[[link]]
inertia = 0.01
repeat = 2
[[output]]
name = "tip"
at = "tip"
of = "angle"
[[output]]
name = "inner"
at = 1
of = "angle"
[initial]
angles = 1.0
[emit]
real = "{real}"
"""
"""Let go from 1 rad; 0.01 s is a sixteenth of the period."""


def two(step: float, integrator: str = "newmark", real: str = "float64") -> Scene:
    return parse_scene(TWO.format(step=step, integrator=integrator, real=real))


@pytest.mark.compiler
def test_chains_drawn_at_random_are_as_right_as_they_say_or_refused() -> None:
    drawn = [
        t
        for t in long_steps(600, seed=7)
        if t.chain.links == 2 and t.chain.integrator in ("newmark", "sdirk4")
    ]
    found = [judge(each) for each in drawn]
    assert [outcome for outcome in found if outcome.status == "wrong"] == []
    assert sum(outcome.status == "right" for outcome in found) >= 5
    assert sum("the error is" in outcome.why for outcome in found) >= 5


@pytest.mark.parametrize("backend", ["numpy", pytest.param("c", marks=pytest.mark.compiler)])
@pytest.mark.parametrize("integrator", ["newmark", "houbolt", "sdirk2"])
def test_what_a_run_says_is_its_error(integrator: str, backend: str) -> None:
    scene = two(5e-4, integrator)
    run = simulate(scene, {}, 0.3, backend)
    exact = exact_response(scene, {}, run.time)
    off = max(np.max(np.abs(run.outputs[name] - values)) for name, values in exact.items())
    error = off / max(np.max(np.abs(values - values[0])) for values in exact.values())
    assert run.accuracy is not None
    assert run.accuracy.error == pytest.approx(error, rel=0.05)
    assert run.accuracy.sensitivity is None


@pytest.mark.parametrize("backend", ["numpy", pytest.param("c", marks=pytest.mark.compiler)])
@pytest.mark.parametrize("times", [10, 100])
def test_steps_that_are_too_long_are_refused(times: int, backend: str) -> None:
    with pytest.raises(InaccurateError):
        simulate(two(1e-3 * times), {}, 1.0, backend)


@pytest.mark.compiler
@pytest.mark.parametrize("more", [{"real": "float32"}, {"integrator": "bathe"}, {"integrator": "zhai"}])
def test_in_single_precision_and_with_any_integrator(more: dict[str, str]) -> None:
    simulate(two(2e-4, **more), {}, 0.3, "c")
    with pytest.raises(InaccurateError):
        simulate(two(1.5e-2, **more), {}, 0.6, "c")


def test_a_load_faster_than_the_steps_is_no_rest() -> None:
    """Sampled at its own period it seems not to be there."""
    from tmm_gen.inputs.signals import Sine

    scene = two(1e-2).replace(
        initial={"angles": 0.0}, input=[{"name": "push", "at": "tip", "acts": "torque"}]
    )
    with pytest.raises(InaccurateError):
        simulate(scene, {"push": Sine(1.0, 2.0 * np.pi / 1e-2)}, 1.0)


def test_each_remedy_that_is_named_works(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    scene, target = tmp_path / "two.toml", tmp_path / "motion.csv"
    scene.write_text(TWO.format(step=4e-3, integrator="newmark", real="float64"))
    given = ["run", str(scene), "--until", "1", "--csv", str(target)]
    assert main(given) == 1
    said = capsys.readouterr().err
    assert "Traceback" not in said
    assert not target.exists()
    remedies = re.findall(r"--step \S+(?=;)|--until \S+(?=;)|--set \S+(?=\.\n)", said)
    assert [remedy.split()[0] for remedy in remedies] == ["--step", "--until", "--set"], said
    for remedy in remedies:
        assert main([*given, *remedy.split()]) == 0, remedy
        capsys.readouterr()


def test_the_line_and_the_json(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    scene = tmp_path / "two.toml"
    scene.write_text(TWO.format(step=2e-4, integrator="newmark", real="float64"))
    assert main(["run", str(scene), "--until", "0.3"]) == 0
    assert re.search(r"\naccurate to about \d\S* (% )?of the motion", capsys.readouterr().out)
    assert main(["run", str(scene), "--until", "0.3", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert 0.0 < found["accuracy"] < 0.05
    assert found["sensitivity"] is None
    assert found["sweeps_per_step"] is None


def test_what_is_promised_is_stated() -> None:
    assert SAYS < 2.0

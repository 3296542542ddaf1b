"""No scene ends in a traceback: a sample of what benchmarks/fuzz_scenes.py tries in large numbers."""

from __future__ import annotations

import tomllib
from pathlib import Path

import pytest
from support.scene_fuzz import attempt, mutated, toml

from tmm_gen.cli import main
from tmm_gen.resources import scenes_dir
from tmm_gen.scene import SceneError, parse_scene

DOCUMENTS = [tomllib.loads(path.read_text()) for path in sorted(scenes_dir().glob("*.toml"))]


def test_every_changed_scene_is_read_or_refused_in_words() -> None:
    refused = [found for seed in range(200) if (found := _refusal(toml(mutated(DOCUMENTS, seed))))]
    assert 10 < len(refused) < 190
    assert all(error.problems for error in refused)
    assert not any("\n" in str(problem) for error in refused for problem in error.problems)


def _refusal(text: str) -> SceneError | None:
    try:
        parse_scene(text)
    except SceneError as error:
        return error
    return None


def test_the_same_seed_gives_the_same_scene() -> None:
    assert toml(mutated(DOCUMENTS, 7)) == toml(mutated(DOCUMENTS, 7))
    assert len({toml(mutated(DOCUMENTS, seed)) for seed in range(20)}) > 15


def test_a_defect_is_told_from_an_answer() -> None:
    assert attempt(lambda: 2, 5).result == "2"
    found = attempt(lambda: 1 // 0, 5)
    assert (found.result, found.where.rpartition(" ")[2]) == ("traceback", "zero")


SMALL = """name = "small"
model = {{kind = "chain"}}
integrator = {{name = "newmark", step = {step}, beta = {beta}, gamma = {gamma}}}
base = {{kind = "clamp"}}
joint = [{{stiffness = {stiffness}, damping = 5.0}}, {{stiffness = 20.0}}]
link = [{{inertia = 5.0}}, {{inertia = {inertia}}}]
input = [{{name = "tip_torque", at = "tip", acts = "torque"}}]
output = [{{name = "tip", at = "tip", of = "angle"}}]
"""
USUAL = {"step": "0.01", "beta": "0.25", "gamma": "0.5", "stiffness": "20.0", "inertia": "5.0"}


@pytest.mark.parametrize(
    "change",
    [
        {"gamma": "5e-324"},
        {"beta": "1e-320"},
        {"stiffness": "1e-300"},
        {"stiffness": "1e300", "step": "1e300"},
        {"inertia": "1e-320", "step": "1e160"},
    ],
    ids=str,
)
@pytest.mark.parametrize("command", ["build", "modes"])
@pytest.mark.filterwarnings("ignore::RuntimeWarning")  # the program itself shows none
def test_absurd_numbers_are_taken_or_refused_on_one_line(
    change: dict[str, str],
    command: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("small.toml").write_text(SMALL.format(**{**USUAL, **change}))
    code = main([command, "small.toml"])
    said = "".join(
        line for line in capsys.readouterr().err.splitlines(keepends=True) if not line.startswith("hint: ")
    )
    assert code in (0, 2)
    assert said.count("\n") == (0 if code == 0 else 1)

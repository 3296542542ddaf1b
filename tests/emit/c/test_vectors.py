"""Test vectors: every arm that can take a step has them, whatever its size, and their text does not grow."""

from __future__ import annotations

import random
import sys
from pathlib import Path

import pytest

from tmm_gen.cli import main
from tmm_gen.emit.c import emit_c, emit_kernel
from tmm_gen.emit.c.kernel import Kernel
from tmm_gen.emit.c.vectors import vectors
from tmm_gen.emit.runs import python_items, runs
from tmm_gen.emit.seal import WITHOUT_MOTION
from tmm_gen.program.build import build_program
from tmm_gen.scene import Scene, load_scene
from tmm_gen.verify.host_test import run_host_test

SCENES = Path(__file__).resolve().parents[3] / "scenes"


def _arm(links: int, **changes: object) -> Scene:
    return load_scene(SCENES / "swing.toml").replace(**{"beam.links": links, **changes})


def _texts(scene: Scene) -> dict[str, str]:
    return emit_kernel(build_program(scene), scene)


def test_the_text_does_not_grow_with_the_arm() -> None:
    small, large = (sum(map(len, _texts(_arm(links)).values())) for links in (100, 500))
    assert large < 1.02 * small


@pytest.mark.parametrize("seed", range(2))
def test_arms_of_many_links_have_vectors_that_their_kernel_keeps(seed: int) -> None:
    draw = random.Random(seed)
    scene = _arm(
        draw.randrange(60, 110),
        **{
            "beam.bending_stiffness": 10 ** draw.uniform(-1, 4),
            "integrator.step": 10 ** draw.uniform(-4, -2),
            "emit.real": draw.choice(("float64", "float32")),
            "model.gravity": draw.choice((0.0, 9.81)),
        },
    )
    program = build_program(scene)
    failures, said = run_host_test(program, scene)
    assert not failures, said
    assert WITHOUT_MOTION not in said


def test_arms_at_rest_grow_into_their_motion() -> None:
    scene = _arm(100)
    program = build_program(scene)
    found = vectors(Kernel.of(program, scene))
    assert found is not None
    assert not found.origin.bent
    last = {expected.what: float(expected.value) for expected in found.steps[-1].outputs}
    assert last["hub"] != 0.0


def test_what_cannot_have_vectors_is_built_and_says_so(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    text = (SCENES / "thesis2.toml").read_text().replace("inertia = 5.0", "inertia = 4.0", 1)
    Path("light.toml").write_text(text.replace('"thesis2"', '"light"'))
    scene = load_scene("light.toml")
    monkeypatch.setattr(sys.modules["tmm_gen.emit.c.vectors"], "_solvable", lambda *_: False)
    assert WITHOUT_MOTION in emit_c(build_program(scene), scene)["c/test_light.c"]
    assert main(["build", "light.toml"]) == 0
    assert "light: the C's test holds no motion" in capsys.readouterr().out
    failures, said = run_host_test(build_program(scene), scene)
    assert not failures, said
    assert WITHOUT_MOTION in said


def test_runs_are_for_long_arrays_of_few_values() -> None:
    values = [2.0, *[1.0] * 199]
    found = runs(values)
    assert found is not None
    assert [value for run in found for value in [run.value] * (run.stop - run.start)] == values
    assert runs([1.0] * 10) is None
    assert runs([float(k) for k in range(200)]) is None
    assert python_items(values) == ["2.0", "*(1.0,) * 199"]

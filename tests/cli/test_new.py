"""`tmm-gen new`."""

from __future__ import annotations

import subprocess
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from tmm_gen.cli import main
from tmm_gen.closed_loop.compare import compare
from tmm_gen.control.bench import Bench
from tmm_gen.control.condition import CONDITIONS
from tmm_gen.control.controllers import BY_NAME
from tmm_gen.onboard.emit import usual_controller
from tmm_gen.scene import load_scene

Call = Callable[..., subprocess.CompletedProcess[str]]


def test_writes_a_scene_that_loads(tmm_gen: Call, tmp_path: Path) -> None:
    done = tmm_gen("new", "arm10")
    assert (done.returncode, done.stderr) == (0, "")
    path = tmp_path / "scenes" / "arm10.toml"
    assert str(path.relative_to(tmp_path)) in done.stdout
    assert load_scene(path).name == "arm10"


@pytest.mark.parametrize("kind", ["chain", "planar"])
def test_kind_and_folder(tmp_path: Path, kind: str) -> None:
    assert main(["new", "arm", "--kind", kind, "--out", str(tmp_path / "a" / "b")]) == 0
    assert load_scene(tmp_path / "a" / "b" / "arm.toml").model.kind == kind


def test_does_not_overwrite_unless_forced(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "arm.toml"
    path.write_text("mine")
    assert main(["new", "arm", "--out", str(tmp_path)]) == 2
    assert "--force" in capsys.readouterr().err
    assert path.read_text() == "mine"
    assert main(["new", "arm", "--out", str(tmp_path), "--force"]) == 0
    assert load_scene(path).name == "arm"
    assert [item.name for item in tmp_path.iterdir()] == ["arm.toml"]


@pytest.mark.parametrize(
    ("name", "remedy"),
    [("my arm", "'my_arm'?"), ("arm.toml", "'arm'?"), ("class", "'class_1'"), ("math", "another")],
)
def test_bad_names(tmp_path: Path, capsys: pytest.CaptureFixture[str], name: str, remedy: str) -> None:
    assert main(["new", name, "--out", str(tmp_path)]) == 2
    assert remedy in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_a_folder_in_the_way(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "arm.toml").mkdir()
    assert main(["new", "arm", "--out", str(tmp_path), "--force"]) == 2
    assert "directory" in capsys.readouterr().err


def test_a_file_where_the_folder_should_be(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "scenes").write_text("")
    assert main(["new", "arm", "--out", str(tmp_path / "scenes")]) == 2
    assert "scenes" in capsys.readouterr().err
    assert main(["new", "arm", "--out", str(tmp_path / "scenes" / "below")]) == 2
    assert "Traceback" not in capsys.readouterr().err


@pytest.mark.compiler
def test_an_arm_of_motors_is_controlled_as_it_stands(tmp_path: Path) -> None:
    """By predictive control, in Python and as C that compiles as it lies; nothing is bounded but torques."""
    assert main(["new", "arm", "--kind", "planar", "--motors", "2", "--control", "--out", str(tmp_path)]) == 0
    scene = load_scene(tmp_path / "arm.toml").replace(**{"beam.arm1.links": 1, "beam.arm2.links": 1})
    bench = Bench.of(scene)
    for kind, compiled in (("rti", False), (usual_controller(bench), True)):
        (trial,) = compare(bench, [BY_NAME[kind]], CONDITIONS[:1], 1.5, compiled=compiled)
        assert trial.figures.fallbacks == 0
        assert np.allclose(trial.loop.tip[-1], trial.loop.goal, atol=5e-3)

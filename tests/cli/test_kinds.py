"""What a new arm in space is, and functions that do not serve arms in space."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from tmm_gen.cli import main
from tmm_gen.derive.integrators.registry import integrator
from tmm_gen.errors import UserError
from tmm_gen.modal.arm import linear_arm
from tmm_gen.modal.rest import rest_at, straight
from tmm_gen.row.scene import row_of
from tmm_gen.scene import Scene, parse_scene
from tmm_gen.scene.template import template

FUNCTIONS: dict[str, Callable[[Scene], object]] = {
    "row": lambda scene: row_of(scene, integrator("newmark")),
    "modes": linear_arm,
    "rest": lambda scene: rest_at(scene, straight(scene)),
}


@pytest.mark.parametrize("name", FUNCTIONS)
def test_functions_that_do_not_say_so(name: str) -> None:
    scene = parse_scene(template("crane", "spatial"), "crane.toml")
    with pytest.raises(UserError, match=r"^crane\.toml: .* do not serve arms in space yet"):
        FUNCTIONS[name](scene)


def test_new_writes_an_arm_in_space(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["new", "crane", "--kind", "spatial"]) == 0
    assert "wrote scenes/crane.toml" in capsys.readouterr().out
    made = parse_scene(Path("scenes/crane.toml").read_text())
    assert made.spatial is not None
    assert [item.name for item in made.spatial.inputs] == ["yaw_torque", "shoulder_torque", "push"]
    for option in (["--control"], ["--motors", "2"]):
        assert main(["new", "other", "--kind", "spatial", *option]) == 2
        assert "add --kind planar" in capsys.readouterr().err.lower()

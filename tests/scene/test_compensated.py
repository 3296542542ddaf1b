"""``emit.compensated``: where it is of no use, a scene is refused."""

from __future__ import annotations

from typing import Any

import pytest

from tmm_gen.resources import scenes_dir
from tmm_gen.scene import Scene, SceneError, load_scene

SUMS = {"emit.real": "float32", "emit.compensated": True}


def scene(name: str, **changes: Any) -> Scene:
    return load_scene(scenes_dir() / f"{name}.toml").replace(**changes)


def test_a_chain_and_an_arm_may_have_it() -> None:
    assert scene("hundred", **SUMS).emit.compensated
    assert scene("swing", **SUMS, **{"emit.trigonometry": "own"}).emit.compensated


def test_absent_it_changes_no_digest() -> None:
    assert scene("hundred", **{"emit.compensated": False}).digest == scene("hundred").digest


@pytest.mark.parametrize(
    ("name", "changes", "message", "remedy"),
    [
        ("hundred", {"emit.compensated": True}, "emit.real is float64", 'real = "float32"'),
        ("hundred", {**SUMS, "emit.sensitivities": True}, "exclude each other", "Remove one"),
        ("swing", SUMS, "sines", 'trigonometry = "own"'),
        ("hundred", {**SUMS, "emit.backends": ["numpy"]}, "not emitted", 'Add "c"'),
    ],
)
def test_refusals_name_key_and_remedy(name: str, changes: dict[str, Any], message: str, remedy: str) -> None:
    with pytest.raises(SceneError) as raised:
        scene(name, **changes)
    found = [problem for problem in raised.value.problems if problem.key == "emit.compensated"]
    assert len(found) == 1
    assert message in found[0].message
    assert remedy in found[0].remedy

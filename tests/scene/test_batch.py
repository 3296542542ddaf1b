"""``emit.batch``: where many arms cannot go side by side, a scene is refused."""

from __future__ import annotations

from typing import Any

import pytest

from tmm_gen.resources import scenes_dir
from tmm_gen.scene import Scene, SceneError, load_scene


def scene(name: str, **changes: Any) -> Scene:
    return load_scene(scenes_dir() / f"{name}.toml").replace(**changes)


def test_a_chain_and_an_arm_may_have_it() -> None:
    assert scene("thesis10", **{"emit.batch": 8}).emit.batch == 8
    assert scene("swing", **{"emit.batch": 4, "emit.trigonometry": "own"}).emit.batch == 4


@pytest.mark.parametrize(
    ("name", "changes", "message", "remedy"),
    [
        ("thesis10", {"emit.batch": 5}, "not one of the choices", "4, 8, 16"),
        ("thesis10", {"emit.batch": 8, "emit.parameters": "bound"}, "bound", 'parameters = "free"'),
        ("hundred", {"emit.batch": 8, "emit.real": "float32", "emit.compensated": True}, "exclude", "Remove one"),
        ("thesis10", {"emit.batch": 16}, "wider than any", "batch = 8"),
        ("swing", {"emit.batch": 8}, "sines", 'trigonometry = "own"'),
        ("thesis10", {"emit.batch": 8, "emit.backends": ["numpy"]}, "not emitted", 'Add "c"'),
    ],
)  # fmt: skip
def test_refusals_name_key_and_remedy(name: str, changes: dict[str, Any], message: str, remedy: str) -> None:
    with pytest.raises(SceneError) as raised:
        scene(name, **changes)
    found = [problem for problem in raised.value.problems if problem.key == "emit.batch"]
    assert len(found) == 1
    assert message in found[0].message
    assert remedy in found[0].remedy

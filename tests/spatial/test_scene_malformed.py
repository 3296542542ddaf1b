"""Any value of an arm in space replaced by any other, any key left out: a scene or problems, and no more."""

from __future__ import annotations

import copy
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from tmm_gen.explain.hints import hints
from tmm_gen.scene import SceneError
from tmm_gen.scene.check import check_data
from tmm_gen.scene.problem import Problem
from tmm_gen.scene.source import Source
from tmm_gen.scene.template import template

FOLDER = Path(__file__).parents[2] / "examples" / "space"
TEXTS = {path.stem: path.read_text() for path in sorted(FOLDER.glob("*.toml"))} | {
    "crane": template("crane", "spatial")
}
JUNK: tuple[Any, ...] = (
    *(True, 0, -1, 3, 10**400, 0.0, -0.5, 5e-324, 1e308, float("inf"), float("nan")),
    *("", "x", "base", "arm", "yaw", [], [0, 0, 0], [1, 2], [0, 0, float("nan")], [1e308, -1e308, 1e308]),
    *([1, 1, 1, 5, 0, 0], ["x"], {}, {"x": 1}, [{}], [{"name": "yaw"}]),
)


def places(data: Any, path: tuple[str | int, ...] = ()) -> Iterator[tuple[str | int, ...]]:
    items = data.items() if isinstance(data, dict) else enumerate(data) if isinstance(data, list) else ()
    for key, value in items:
        yield (*path, key)
        yield from places(value, (*path, key))


def put(data: Any, path: tuple[str | int, ...], value: Any) -> Any:
    changed = copy.deepcopy(data)
    place = changed
    for part in path[:-1]:
        place = place[part]
    if value is None:
        del place[path[-1]]
    else:
        place[path[-1]] = value
    return changed


def read(data: dict[str, Any]) -> tuple[Problem, ...]:
    """Return the problems of a scene; none for a good one, whose content and hints can be told."""
    try:
        scene = check_data(Source("a.toml", data, {}, check_data))
    except SceneError as error:
        return error.problems
    assert len(scene.digest) == 64
    assert all("a.toml:" in hint for hint in hints(scene))
    return ()


@pytest.mark.parametrize("name", TEXTS)
def test_junk(name: str) -> None:
    data = tomllib.loads(TEXTS[name])
    assert read(data) == ()
    told = set()
    for number, path in enumerate(places(data)):
        for k, value in enumerate((None, *JUNK)):
            if (number + k) % 5 == 0:  # a fifth of all, each path and each value among them
                for problem in read(put(data, path, value)):
                    told.add(str(problem))
                    assert problem.key
                    assert problem.message
                    assert problem.remedy.endswith((".", "?"))
    assert len(told) > 60

"""Worked examples in JAX: a swing is improved by its gradient; many arms are an environment to learn in."""

from __future__ import annotations

import importlib.util
import json
import os
import re
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest

from tmm_gen.cli import main

jax: Any = pytest.importorskip("jax") if not os.environ.get("CI") else __import__("jax")

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs" / "jax.md").read_text()


@pytest.fixture(scope="module", autouse=True)
def _package(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    folder = tmp_path_factory.mktemp("arms")
    assert main(["build", str(ROOT / "examples" / "jax" / "arm.toml"), "--out", str(folder)]) == 0
    before = jax.config.jax_enable_x64
    sys.path.insert(0, str(folder))
    yield
    sys.path.remove(str(folder))
    for name in [name for name in sys.modules if name.partition(".")[0] == "arm"]:
        del sys.modules[name]
    jax.config.update("jax_enable_x64", before)


def example(path: str) -> ModuleType:
    spec = importlib.util.spec_from_file_location(Path(path).stem, ROOT / "examples" / path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_a_swing_is_improved_by_its_gradient(capsys: pytest.CaptureFixture[str]) -> None:
    example("jax/swing.py").main(turns=8)
    said = capsys.readouterr().out
    for name in ("torque", "softness"):
        found = re.search(rf"^by {name} 3: (\S+), by differences (\S+)$", said, re.MULTILINE)
        assert found
        assert float(found[1]) == pytest.approx(float(found[2]), abs=2e-6)
        assert abs(float(found[1])) > 1e-3
    costs = re.search(r"^cost (\S+) before, (\S+) after", said, re.MULTILINE)
    assert costs
    assert float(costs[2]) < 0.5 * float(costs[1])


def test_an_environment_of_arms_no_two_of_which_are_alike() -> None:
    """As Gymnasium's vector environments: shapes, seeds, time limits, a new episode after each end."""
    env = example("rl/arm_env.py").ArmEnv(3, seconds=0.1)
    first, info = env.reset(seed=4)
    assert first.shape == (3, *env.observation_shape)
    assert info == {}
    episodes = []
    for _ in range(2):
        again, _ = env.reset(seed=4)
        np.testing.assert_array_equal(first, again)
        episodes.append([env.step(np.full((3, 1), 0.5)) for _ in range(7)])
    for one, other in zip(*episodes, strict=True):
        for a, b in zip(one[:4], other[:4], strict=True):
            np.testing.assert_array_equal(a, b)
    seen, rewards, terminated, truncated, _ = zip(*episodes[0], strict=True)
    assert len({float(x) for x in seen[3][:, 2]}) == 3
    assert not np.any(terminated)
    assert [bool(each.all()) for each in truncated] == [k == 4 for k in range(7)]
    assert (rewards[5] == 0.0).all()
    np.testing.assert_allclose(seen[5], first, atol=1e-6)
    assert len({round(float(x), 9) for x in (*seen[3][:, 2], *seen[6][:, 2])}) == 6


def test_the_page_on_learning(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(ROOT / "examples" / "rl"))
    (snippet,) = re.findall(r"```python\n(.*?)```", (ROOT / "docs" / "learning.md").read_text(), re.DOTALL)
    names: dict[str, Any] = {}
    exec(snippet, names)
    assert capsys.readouterr().out.startswith("(1000, 6) -")
    hub = names["seen"][:, 0]
    assert hub.min() > 0.1  # all arms are on their way
    assert np.ptp(hub) > 1e-3  # and no two alike


def test_check_compares_it_with_numpy(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    scene = tmp_path / "thesis2.toml"
    text = (ROOT / "scenes" / "thesis2.toml").read_text()
    scene.write_text(text + '\n[emit]\nbackends = ["jax"]\n')
    assert main(["check", str(scene), "--json"]) == 0
    (row,) = [
        row for row in json.loads(capsys.readouterr().out)["rows"] if row["check"] == "numpy_against_jax"
    ]
    assert 0.0 <= row["value"] <= row["bound"] == 1e-13


def test_the_page() -> None:
    (snippet,) = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)
    printed: list[str] = []
    exec(snippet.replace("scenes/", f"{ROOT}/scenes/"), {"print": printed.append})
    assert [re.sub(r"-?\d\.\d+", "N", line) for line in printed] == [
        "tip at N rad; N rad more for each kg m^2",
        "1000 arms: from N to N rad",
    ]
    value, slope, low, high = (float(x) for line in printed for x in re.findall(r"-?\d\.\d{4}", line))
    assert low < value < high
    assert abs(slope) > 1e-3

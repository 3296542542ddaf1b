"""`tmm-gen stability` and `tmm-gen explain`: tables, JSON, pictures and exit codes."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tmm_gen.cli import main
from tmm_gen.scene import INTEGRATOR_NAMES

SCENES = Path(__file__).resolve().parents[2] / "scenes"


def test_json_has_every_integrator_and_plot_draws(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    picture = tmp_path / "map.png"
    scene = str(SCENES / "thesis2.toml")
    assert main(["stability", scene, "--cells", "6", "--map", "mixed", "--plot", str(picture), "--json"]) == 0
    assert picture.read_bytes().startswith(b"\x89PNG")
    found = json.loads(capsys.readouterr().out)
    rows = {row["integrator"]: row for row in found["rows"]}
    assert sorted(rows) == sorted(INTEGRATOR_NAMES)
    assert rows["newmark"]["unconditionally_stable"]
    assert rows["newmark"]["limit"] is None
    assert rows["zhai"]["limit"] == 2.0
    assert rows["zhai"]["margin"] == pytest.approx(rows["zhai"]["largest_step"] / found["step"])
    assert found["omega_step"] == pytest.approx(found["highest_frequency"] * found["step"])
    assert found["maps"][0]["integrator"] == "mixed"
    assert found["maps"][0]["cells"] == 24
    assert found["maps"][0]["cells_that_differ"] == 0


@pytest.mark.parametrize(
    "words",
    [["--map", "euler"], ["--plot", "map.gif"], ["--cells", "0", "--plot", "map.png"], ["--cells", "-1"]],
)
def test_bad_usage(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["stability", str(SCENES / "thesis2.toml"), *words]) == 2
    assert capsys.readouterr().err


def test_explain_as_json(capsys: pytest.CaptureFixture[str]) -> None:
    assert (
        main(
            [
                "explain",
                str(SCENES / "thesis2.toml"),
                "--set",
                "joint.1.damping=0",
                "--set",
                "joint.2.damping=0",
                "--json",
            ]
        )
        == 0
    )
    found = json.loads(capsys.readouterr().out)
    assert found["stations"] == 2
    assert found["operations_per_step"] > 0
    assert {row["status"] for row in found["rows"]} == {"left out"}


def test_a_missing_scene_is_no_traceback(capsys: pytest.CaptureFixture[str]) -> None:
    for command in ("stability", "explain"):
        assert main([command, "nowhere.toml"]) == 2
        assert "nowhere.toml" in capsys.readouterr().err

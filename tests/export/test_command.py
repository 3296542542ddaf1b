"""`tmm-gen export`: files, report, JSON, and what it refuses."""

from __future__ import annotations

import json
from pathlib import Path

import fmpy
import mujoco
import pytest

from tmm_gen.cli import main

SCENES = Path(__file__).resolve().parents[2] / "scenes"
THESIS = str(SCENES / "thesis10.toml")

pytestmark = pytest.mark.compiler


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_a_unit_is_written_and_runs(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["export", THESIS, "--to", "fmu"]) == 0
    assert "wrote thesis10.fmu: FMI 2.0" in capsys.readouterr().out
    assert fmpy.read_model_description("thesis10.fmu").fmiVersion == "2.0"
    assert len(fmpy.simulate_fmu("thesis10.fmu", stop_time=0.1)) == 11


def test_json_and_version_three(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["export", THESIS, "--to", "fmu", "--fmi", "3", "--out", "made/it.fmu", "--json"]) == 0
    facts = json.loads(capsys.readouterr().out)
    assert facts["file"] == "made/it.fmu"
    assert (facts["fmi"], facts["step"], facts["real"]) == ("3.0", 0.01, "float64")
    assert facts["bytes"] == Path("made/it.fmu").stat().st_size
    assert fmpy.read_model_description("made/it.fmu").fmiVersion == "3.0"


def test_a_mujoco_model_is_written(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["export", THESIS, "--to", "mjcf", "--json"]) == 0
    facts = json.loads(capsys.readouterr().out)
    model = mujoco.MjModel.from_xml_path("thesis10.xml")
    assert model.opt.timestep == facts["timestep"] == 0.01
    assert [output["name"] for output in facts["outputs"]] == ["tip", "base_torque"]
    assert main(["export", THESIS, "--to", "mjcf"]) == 0
    assert "base_torque = 20 base_torque_spring[0] + 5 base_torque_damper[0]" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("words", "what"),
    [
        (["--to", "mjcf", "--fmi", "2"], "--to fmu only"),
        (["--to", "fmu", "--out", "it.xml"], "must end in .fmu"),
        (["--to", "fmu", "--out", "."], "directory"),
        (["--to", "fmu", "--cc", "no-such-compiler"], "no-such-compiler"),
        (["--to", "fmu", "--fmi", "1"], "'1' is not one of"),
        ([], "--to"),
    ],
)
def test_refusals_write_nothing(
    words: list[str], what: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["export", THESIS, *words]) == 2
    shown = capsys.readouterr()
    assert what in shown.err
    assert "Traceback" not in shown.err
    assert list(folder.iterdir()) == []


def test_sums_of_two_are_not_for_units() -> None:
    """A unit's parameters are single numbers: it would be less exact than the scene asks."""
    from tmm_gen.errors import UserError
    from tmm_gen.export.fmu import fmu
    from tmm_gen.resources import scenes_dir
    from tmm_gen.scene import load_scene

    scene = load_scene(scenes_dir() / "thesis2.toml")
    with pytest.raises(UserError, match=r'emit\.compensated = true: .*real = "float64"'):
        fmu(scene.replace(**{"emit.real": "float32", "emit.compensated": True}))

"""Malformed scenes: every command answers with exit code 2, file, line and key, and writes nothing."""

from __future__ import annotations

import warnings
from pathlib import Path

import pytest

from tmm_gen.cli import main

SCENE = """\
name = "arm"

[model]
kind = "chain"

[integrator]
name = "newmark"
step = 0.01

[base]
kind = "clamp"

[[joint]]
stiffness = 20.0
damping = 0.5

[[link]]
inertia = 1.0

[[input]]
name = "tip_torque"
at = "tip"
acts = "torque"

[[output]]
name = "tip"
at = "tip"
of = "angle"
"""

MALFORMED = {
    "unknown key": ("stiffness = 20.0", "stifness = 20.0", ":14: joint[1].stifness:"),
    "missing key": ("step = 0.01", "", ":6: integrator.step:"),
    "missing table": ('[base]\nkind = "clamp"\n', "", "base"),
    "unknown table": ("[[output]]", "[[outputs]]", ":25: outputs:"),
    "not toml": ("[model]", "[model", ":3:"),
    "key twice": ("inertia = 1.0", "inertia = 1.0\ninertia = 2.0", ":19:"),
    "text for a number": ("stiffness = 20.0", 'stiffness = "20"', ":14: joint[1].stiffness:"),
    "negative inertia": ("inertia = 1.0", "inertia = -1.0", ":18: link[1].inertia:"),
    "zero stiffness": ("stiffness = 20.0", "stiffness = 0.0", ":14: joint[1].stiffness:"),
    "negative damping": ("damping = 0.5", "damping = -0.5", ":15: joint[1].damping:"),
    "infinite number": ("stiffness = 20.0", "stiffness = inf", ":14: joint[1].stiffness:"),
    "zero step": ("step = 0.01", "step = 0.0", ":8: integrator.step:"),
    "unknown integrator": ('"newmark"', '"newmrk"', ":7: integrator.name:"),
    "parameter of another": ("step = 0.01", "step = 0.01\nrho_inf = 0.5", ":9: integrator.rho_inf:"),
    "parameter out of range": ("step = 0.01", "step = 0.01\nbeta = 7.0", ":9: integrator.beta:"),
    "unknown base": ('kind = "clamp"', 'kind = "clamped"', ":11: base.kind:"),
    "hub without a motor": ('kind = "clamp"', 'kind = "clamp"\ninertia = 1.0', ":12: base.inertia:"),
    "motor without inertia": ('kind = "clamp"', 'kind = "motor"', "base.inertia"),
    "joint without link": ("[[link]]\ninertia = 1.0\n", "", "link"),
    "input that acts nowhere": ('at = "tip"\nacts', "at = 7\nacts", ":22: input[1].at:"),
    "output of nothing": ('of = "angle"', 'of = "temperature"', ":28: output[1].of:"),
    "name of two": ('name = "tip"\n', 'name = "tip_torque"\n', ":26: output[1].name:"),
    "name that is none": ('name = "arm"', 'name = "my arm"', ":1: name:"),
    "explicit with displacements": (
        'kind = "chain"',
        'kind = "chain"\nunknown = "displacement"\n[integrator]\nname = "zhai"\nstep = 0.01\n[unused]',
        ":",
    ),
}

COMMANDS = ("run", "check", "build")


@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize("case", MALFORMED)
def test_malformed_scene(
    case: str,
    command: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    old, new, said = MALFORMED[case]
    assert SCENE.count(old) >= 1
    scene = tmp_path / "arm.toml"
    scene.write_text(SCENE.replace(old, new, 1), encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    assert main([command, "arm.toml"]) == 2
    shown = capsys.readouterr()
    assert shown.out == ""
    assert "Traceback" not in shown.err
    assert shown.err.startswith("error: arm.toml:")
    assert said in shown.err
    assert [path.name for path in tmp_path.iterdir()] == ["arm.toml"]


def test_the_scene_itself_is_good(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "arm.toml").write_text(SCENE)
    monkeypatch.chdir(tmp_path)
    assert main(["run", "arm.toml", "--until", "0.1"]) == 0
    assert capsys.readouterr().err == ""


@pytest.mark.parametrize("command", ["modes", "stability"])
@pytest.mark.parametrize("damping", [1e300, 3e306])
def test_numbers_beyond_all_bounds_end_in_one_line(
    command: str, damping: float, capsys: pytest.CaptureFixture[str], repository: Path, tmp_path: Path
) -> None:
    """What NumPy and SciPy refuse in words of their own is no defect."""
    scene = tmp_path / "thesis2.toml"
    text = (repository / "scenes" / "thesis2.toml").read_text()
    scene.write_text(text.replace("damping = 5.0", f"damping = {damping}", 1))
    assert scene.read_text() != text
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        assert main([command, str(scene)]) == 2
    assert "leave the range of floating point" in capsys.readouterr().err

"""`tmm-gen mpc`, `tmm-gen calibrate` and `tmm-gen new --control`."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Callable
from contextlib import nullcontext
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from tmm_gen.cli import main
from tmm_gen.control.bench import Bench
from tmm_gen.errors import UserError
from tmm_gen.onboard.emit import _require_digits
from tmm_gen.scene import load_scene

pytestmark = pytest.mark.compiler

Call = Callable[..., subprocess.CompletedProcess[str]]
KEYS = {
    "controller",
    "condition",
    "settling_s",
    "overshoot_percent",
    "residual_mrad",
    "solve_us_median",
    "solve_us_max",
}


def test_a_new_scene_is_controlled(tmm_gen: Call, tmp_path: Path) -> None:
    made = tmm_gen("new", "crane", "--kind", "planar", "--control")
    assert made.returncode == 0, made.stderr
    assert "tmm-gen mpc" in made.stdout
    done = tmm_gen(
        "mpc", "scenes/crane.toml", "--controller", "mpc-modes", "--controller", "pd", "--condition", "nominal",
        "--until", "1.5", "--plot", "a.png", "--animate", "a.gif", "--json",
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    shown = json.loads(done.stdout)
    assert [row["controller"] for row in shown["rows"]] == ["pd", "mpc-modes"]
    assert all(set(row) >= KEYS for row in shown["rows"])
    assert shown["rows"][1]["settling_s"] < 0.85
    assert (tmp_path / "a.png").read_bytes().startswith(b"\x89PNG")
    assert (tmp_path / "a.gif").read_bytes().startswith(b"GIF8")


def test_a_controller_is_written_in_c(tmm_gen: Call, tmp_path: Path, repository: Path) -> None:
    done = tmm_gen("mpc", repository / "scenes" / "swing.toml", "--emit", "controller", "--json")
    assert done.returncode == 0, done.stderr
    shown = json.loads(done.stdout)
    assert (tmp_path / "controller" / f"{shown['name']}.h").is_file()
    assert (tmp_path / "controller" / "daqp" / "LICENSE").is_file()
    assert (tmp_path / "controller" / "example" / "example.c").is_file()


def test_a_folder_that_has_a_controller_is_refused_before_the_work(
    tmp_path: Path, repository: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "CMakeLists.txt").write_text("mine")
    monkeypatch.setattr(Bench, "of", lambda _: pytest.fail("work was begun"))
    assert main(["mpc", str(repository / "scenes" / "swing.toml"), "--emit", "."]) == 2
    assert "--emit .: there is a CMakeLists.txt already." in capsys.readouterr().err
    assert (tmp_path / "CMakeLists.txt").read_text() == "mine"


def test_a_controller_takes_the_place_of_another(
    tmp_path: Path, repository: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Nothing of the former one is left to be compiled with it; what the user put there stays, whatever its name."""
    monkeypatch.chdir(tmp_path)
    words = ["mpc", str(repository / "scenes" / "swing.toml"), "--emit", "made", "--json"]
    assert main([*words, "--name", "first"]) == 0
    first = {path.relative_to(tmp_path) for path in Path("made").resolve().rglob("*") if path.is_file()}
    mine = {
        "made/first_use.c": "/**\n * first: mine\n */\n",
        "made/plant/motor.h": "",
        "made/notes.txt": "Written by",
    }
    for path, text in mine.items():
        Path(path).write_text(text)
    capsys.readouterr()
    Path("made/CMakeLists.txt").unlink()
    Path("made/example/example.c").unlink()
    assert main([*words, "--name", "second"]) == 2
    assert "--emit made: has first.c of another controller" in capsys.readouterr().err
    assert not Path("made/second.c").exists()
    assert main([*words, "--name", "second", "--force"]) == 0
    removed = {Path(each) for each in json.loads(capsys.readouterr().out)["removed"]}
    assert removed == {path for path in first if "first" in path.name}
    assert len(removed) >= 4
    left = {path.relative_to(tmp_path) for path in Path("made").resolve().rglob("*") if path.is_file()}
    renamed = {path.with_name(path.name.replace("first", "second")) for path in first}
    assert left == renamed | {Path(each) for each in mine}
    assert all(Path(path).read_text() == text for path, text in mine.items())
    assert main([*words, "--name", "second", "--force"]) == 0
    assert json.loads(capsys.readouterr().out)["removed"] == []


def test_single_precision_is_refused_where_it_leaves_no_digit_of_torques(repository: Path) -> None:
    bench: Any = SimpleNamespace(scene=load_scene(repository / "scenes" / "swing.toml"))
    for spread, real, refused in ((1e9, "float32", True), (1e9, "float64", False), (1e6, "float32", False)):
        condensed: Any = SimpleNamespace(input_hessian=np.diag([1.0, spread]))
        with pytest.raises(UserError, match="some 119 times as large") if refused else nullcontext():
            _require_digits(bench, condensed, real)


def test_a_controller_can_have_a_name_of_its_own(tmm_gen: Call, tmp_path: Path, repository: Path) -> None:
    scene = repository / "scenes" / "swing.toml"
    done = tmm_gen("mpc", scene, "--emit", "fast", "--name", "fast", "--real", "float32")
    assert done.returncode == 0, done.stderr
    assert "fast_reset" in (tmp_path / "fast" / "fast.h").read_text()
    refused = tmm_gen("mpc", scene, "--emit", "other", "--name", "stdio")
    assert refused.returncode == 2
    assert "--name stdio" in refused.stderr
    assert not (tmp_path / "other").exists()


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["scenes/arm10.toml"], "has no [control]"),
        (["scenes/thesis2.toml"], "has nothing that controllers turn"),
        (["scenes/fall10.toml"], "has nothing that controllers turn"),
        (["scenes/gripper.toml"], "has no [control]"),
        (["scenes/elbow.toml", "--tune", "mpc", "--out", "new.toml"], "control.payload: cannot be rewritten"),
        (["scenes/swing.toml", "--controller", "mcp"], "There are pd, pd-zv"),
        (
            ["scenes/swing.toml", "--controller", "rti", "--emit", "x", "--name", "swing"],
            "the arm's own functions",
        ),
        (["scenes/swing.toml", "--emit", "x", "--name", "daqp"], "the solver's files"),
        (["scenes/swing.toml", "--condition", "payloads"], "Did you mean payload?"),
        (["scenes/swing.toml", "--controller", "pd", "--emit", "x"], "cannot write pd"),
        (["scenes/swing.toml", "--until", "-1"], "positive"),
        (["scenes/swing.toml", "--animate", "x.mp4"], ".gif"),
        (["scenes/swing.toml", "--tune", "pdd"], "Did you mean pd? There are mpc, lqr, pd"),
        (["scenes/swing.toml", "--tune", "pd", "--evaluations", "3"], "3 is not in the range"),
    ],
)
def test_what_cannot_be_done_is_said(
    repository: Path,
    words: list[str],
    message: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(repository)
    assert main(["mpc", *words]) == 2
    said = capsys.readouterr().err
    assert message in said
    assert "Traceback" not in said


def test_the_list_shows_what_there_is(tmm_gen: Call, repository: Path) -> None:
    done = tmm_gen("mpc", "scenes/swing.toml", "--list", "--json", cwd=repository)
    assert done.returncode == 0, done.stderr
    rows = json.loads(done.stdout)["rows"]
    assert {"controller", "condition", "tunable"} == {row["what"] for row in rows}
    assert {"rti", "payload"} <= {row["name"] for row in rows}


def test_a_chain_gets_no_controller(tmm_gen: Call) -> None:
    done = tmm_gen("new", "shaft", "--control")
    assert done.returncode == 2
    assert "--kind planar" in done.stderr


def test_a_record_is_fitted_from_the_command_line(tmm_gen: Call, tmp_path: Path, repository: Path) -> None:
    """The record comes from `tmm-gen run` on a softer arm."""
    scene = repository / "scenes" / "swing.toml"
    rows = ["time,hub_torque", *(f"{0.1 * k},{(-1.0) ** k}" for k in range(13))]
    (tmp_path / "torque.csv").write_text("\n".join(rows) + "\n")
    made = tmm_gen(
        "run", scene, "--set", "beam.bending_stiffness=9.0", "--input", "torque.csv", "--until", "1.2",
        "--csv", "out.csv",
    )  # fmt: skip
    assert made.returncode == 0, made.stderr
    outputs = (tmp_path / "out.csv").read_text().splitlines()
    step = 5e-3
    torques = [_between(k * step) for k in range(len(outputs) - 1)]
    joined = [
        outputs[0] + ",hub_torque",
        *(f"{row},{u}" for row, u in zip(outputs[1:], torques, strict=True)),
    ]
    (tmp_path / "record.csv").write_text("\n".join(joined) + "\n")
    done = tmm_gen("calibrate", scene, "record.csv", "--out", "fitted.toml", "--json")
    assert done.returncode == 0, done.stderr
    found = {row["key"]: row for row in json.loads(done.stdout)["rows"]}
    assert found["beam.bending_stiffness"]["value"] == pytest.approx(9.0, rel=1e-3)
    assert (
        "bending_stiffness = 9.0" in (tmp_path / "fitted.toml").read_text()
        or "8.99" in (tmp_path / "fitted.toml").read_text()
    )
    assert tmm_gen("calibrate", scene, "torque.csv").returncode == 2
    missing = tmm_gen("calibrate", scene, "none.csv")
    assert missing.returncode == 2
    assert "no such file" in missing.stderr


def _between(time: float) -> float:
    """The torque of the file: linear between plus and minus one every tenth of a second."""
    k = int(time / 0.1 + 1e-9)
    share = time / 0.1 - k
    return (-1.0) ** k * (1.0 - 2.0 * share)

"""`tmm-gen run`: figures, files, inputs, changed scenes; and what it refuses."""

from __future__ import annotations

import csv
import json
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from tmm_gen.cli import main
from tmm_gen.inputs.signals import Constant, Table
from tmm_gen.reference.reference import exact_response
from tmm_gen.scene import load_scene

SCENES = Path(__file__).resolve().parents[2] / "scenes"
THESIS2 = str(SCENES / "thesis2.toml")


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Run in an empty folder."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


def succeed(*words: str, capsys: pytest.CaptureFixture[str]) -> str:
    assert main(["run", *words]) == 0
    shown = capsys.readouterr()
    assert shown.err == ""
    return shown.out


def refuse(*words: str, capsys: pytest.CaptureFixture[str]) -> str:
    assert main(["run", *words]) == 2
    shown = capsys.readouterr()
    assert shown.out == ""
    assert "Traceback" not in shown.err
    return shown.err


def read_csv(path: Path) -> dict[str, np.ndarray]:
    with path.open(newline="") as file:
        header, *rows = csv.reader(file)
    return dict(zip(header, np.array(rows, dtype=float).T, strict=True))


def test_without_inputs_it_says_what_to_try(capsys: pytest.CaptureFixture[str]) -> None:
    shown = succeed(THESIS2, capsys=capsys)
    assert "30 s in 3000 steps of 0.01 s by newmark" in shown
    assert "nothing moves, as all inputs are zero: try --input tip_torque=1" in shown
    assert not list(Path().iterdir())


def test_the_table_has_the_figures_of_the_thesis_sample(capsys: pytest.CaptureFixture[str]) -> None:
    shown = succeed(THESIS2, "--until", "40", "--input", "tip_torque=1", "--json", capsys=capsys)
    found = json.loads(shown)
    assert found["steps"] == 4000
    tip, base = found["rows"]
    assert (tip["output"], tip["unit"], base["unit"]) == ("tip", "rad", "N m")
    assert tip["rest"] == pytest.approx(0.1)
    exact = exact_response(load_scene(THESIS2), {"tip_torque": Constant(1.0)}, np.linspace(0, 40, 4001))
    assert tip["peak"] == pytest.approx(exact["tip"].max(), rel=1e-4)
    assert tip["overshoot_percent"] == pytest.approx(1000 * (exact["tip"].max() - 0.1), rel=1e-3)
    outside = np.flatnonzero(np.abs(exact["tip"] - 0.1) > 0.002)
    assert tip["settling_time"] == pytest.approx(0.01 * (outside[-1] + 1), abs=0.011)


@pytest.mark.parametrize("backend", ["numpy", "c"])
def test_csv_has_17_digits_and_follows_the_exact_response(
    backend: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (folder / "torque.csv").write_text("time,tip_torque\n0,0\n1,2\n1.5,-1\n")
    words = ["--until", "3", "--step", "0.005", "--input", "torque.csv", "--csv", "deep/out.csv"]
    shown = succeed(THESIS2, *words, "--backend", backend, capsys=capsys)
    assert "wrote deep/out.csv" in shown
    columns = read_csv(folder / "deep" / "out.csv")
    assert list(columns) == ["time", "tip", "base_torque"]
    np.testing.assert_array_equal(columns["time"], 0.005 * np.arange(601))
    load = Table(np.array([0.0, 1.0, 1.5]), np.array([0.0, 2.0, -1.0]))
    exact = exact_response(load_scene(THESIS2), {"tip_torque": load}, columns["time"])
    for name, values in exact.items():
        np.testing.assert_allclose(columns[name], values, rtol=0, atol=1e-4 * np.abs(values).max())
    text = (folder / "deep" / "out.csv").read_text().splitlines()
    assert all(f"{float(cell):.17g}" == cell for line in text[1:] for cell in line.split(","))


@pytest.mark.compiler
def test_a_run_with_its_inputs_is_a_record(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The stiffness that made it is found again, from the file alone."""
    arm = [str(SCENES / "swing.toml"), "--set", "beam.links=1"]
    words = ["--until", "0.4", "--input", "hub_torque=sine:1:2", "--set", "beam.bending_stiffness=15"]
    succeed(*arm, *words, "--csv", "record.csv", "--with-inputs", capsys=capsys)
    columns = read_csv(folder / "record.csv")
    assert list(columns) == ["time", "hub_torque", "tip_x", "tip_y", "hub"]
    np.testing.assert_allclose(columns["hub_torque"], np.sin(4.0 * np.pi * columns["time"]), atol=1e-15)
    (folder / "one.toml").write_text(Path(arm[0]).read_text().replace("links = 5", "links = 1"))
    assert load_scene(folder / "one.toml").stations == 1
    assert main(["calibrate", "one.toml", "record.csv", "--fit", "beam.bending_stiffness", "--json"]) == 0
    (found,) = json.loads(capsys.readouterr().out)["rows"]
    assert found["given"] == 12.0
    assert found["value"] == pytest.approx(15.0, rel=1e-6)
    (folder / "record.csv").write_text((folder / "record.csv").read_text().replace("tip_y", "tipy", 1))
    assert main(["calibrate", "one.toml", "record.csv", "--fit", "beam.bending_stiffness"]) == 0
    told = capsys.readouterr().out
    assert (
        "'tipy' is neither an input nor an output of the scene and was not read: did you mean 'tip_y'?"
        in told
    )
    said = refuse(*arm, "--with-inputs", capsys=capsys)
    assert "--with-inputs: adds columns to what --csv writes. Add --csv FILE." in said


def test_the_last_step_reaches_the_end(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    succeed(THESIS2, "--until", "0.025", "--csv", "out.csv", capsys=capsys)
    np.testing.assert_allclose(read_csv(folder / "out.csv")["time"], [0, 0.01, 0.02, 0.03])


@pytest.mark.parametrize(
    ("words", "written"), [(["--plot"], "thesis2.png"), (["--plot", "p/a.svg"], "p/a.svg")]
)
def test_a_picture(words: list[str], written: str, folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    succeed(THESIS2, "--until", "1", "--input", "tip_torque=1", *words, capsys=capsys)
    content = (folder / written).read_bytes()
    assert content.startswith(b"\x89PNG" if written.endswith("png") else b"<?xml")
    succeed(THESIS2, "--until", "1", "--input", "tip_torque=1", *words, capsys=capsys)
    assert (folder / written).read_bytes() == content


def test_keys_of_the_scene_can_be_set(capsys: pytest.CaptureFixture[str]) -> None:
    changes = [
        "--set",
        "integrator.name=sdirk4",
        "--set",
        "joint.2.stiffness=40.0",
        "--set",
        'title="Stiffer"',
    ]
    shown = succeed(
        THESIS2, *changes, "--step", "0.1", "--until", "60", "--input", "tip_torque=1", capsys=capsys
    )
    assert "Stiffer: 60 s in 600 steps of 0.1 s by sdirk4" in shown
    assert "0.075" in shown


@pytest.mark.parametrize("scene", ["thesis10", "drivetrain", "hundred"])
def test_the_example_scenes_run(scene: str, capsys: pytest.CaptureFixture[str]) -> None:
    loaded = load_scene(SCENES / f"{scene}.toml")
    given = [f"--input={item.name}=1" for item in loaded.inputs]
    found = json.loads(
        succeed(str(SCENES / f"{scene}.toml"), "--until", "0.1", *given, "--json", capsys=capsys)
    )
    assert [row["output"] for row in found["rows"]] == [item.name for item in loaded.outputs]
    assert any(row["peak"] != 0.0 for row in found["rows"])


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--until", "0"], "must be a positive number of seconds"),
        (["--until", "nan"], "must be a positive number of seconds"),
        (["--step", "-1"], "must be a positive number of seconds"),
        (["--step", "fast"], "is not a valid float"),
        (["--input", "tip_torqe=1"], "Did you mean tip_torque?"),
        (["--input", "none.csv"], "none.csv: no such file"),
        (["--set", "integrator.step"], "is not KEY=VALUE"),
        (["--set", "integrator.name=newmrk"], "'newmark'?"),
        (["--set", "joint.7.stiffness=1"], "joint[7]"),
        (["--set", "joint.1.stiffness=-1"], "must be greater than 0"),
        (["--plot", "picture.gif"], "must end in .png, .svg, .pdf"),
        (["--csv", "."], "is a directory"),
        (["--backend", "rust"], "'rust' is not one of"),
        (["--until", "1e9"], "takes 100000000000 steps, more than 20000000"),
        (["--step", "1e-300"], "more than 20000000. Simulate a shorter time"),
        (["--step", "1e-320"], "so short that a part of it is no number any more (got 1e-320). Write for"),
        (
            ["--step", "1e-200", "--until", "1e-199", "--set", "model.unknown=displacement"],
            "what it adds is rounded off. Use a step above",
        ),
    ],
)
def test_bad_usage(words: list[str], said: str, folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert said in refuse(THESIS2, *words, capsys=capsys)
    assert not list(folder.iterdir())


def test_a_scene_that_is_not_there(capsys: pytest.CaptureFixture[str]) -> None:
    assert "no such file" in refuse("thesis3.toml", capsys=capsys)


@pytest.mark.parametrize("backend", ["numpy", "c"])
def test_divergence_is_explained(backend: str, folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = [
        "--set",
        "integrator.name=zhai",
        "--step",
        "0.006",
        "--input",
        "tip_torque=1",
        "--csv",
        "out.csv",
    ]
    assert main(["run", str(SCENES / "hundred.toml"), *words, "--backend", backend]) == 1
    shown = capsys.readouterr()
    assert shown.out == ""
    assert "has diverged: at t = 0.12 s the angle of station 96 has reached" in shown.err
    assert "step x highest natural frequency of 400 rad/s = 2.4, beyond the limit 1.96 of zhai" in shown.err
    assert "Use a step below 0.0049 s" in shown.err
    assert not list(folder.iterdir())


def test_the_remedy_against_divergence_works(capsys: pytest.CaptureFixture[str]) -> None:
    words = ["--set", "integrator.name=zhai", "--step", "0.0048", "--input", "tip_torque=1", "--until", "3"]
    succeed(str(SCENES / "hundred.toml"), *words, capsys=capsys)


def test_the_unsafe_product_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    said = refuse(str(SCENES / "thesis10.toml"), "--set", "model.sweep=product", capsys=capsys)
    assert "up to 5 stations at a step of 0.01 s" in said
    assert 'sweep = "riccati"' in said


FALLING = """
name = "falling"
[model]
kind = "planar"
gravity = 9.81
[integrator]
name = "newmark"
step = {step}
[base]
kind = "clamp"
[beam]
length = 1.0
bending_stiffness = 1.0
mass_per_length = 0.5
links = 3
[[output]]
name = "tip"
at = "tip"
of = "position"
[[output]]
name = "motion"
at = "arm"
of = "kinetic_energy"
"""


@pytest.mark.parametrize("backend", ["numpy", pytest.param("c", marks=pytest.mark.compiler)])
def test_a_planar_run_says_how_far_it_is_to_be_trusted(
    backend: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    scene = folder / "falling.toml"
    scene.write_text(FALLING.format(step="5e-3"))
    given = [str(scene), "--until", "1", "--backend", backend]
    said = succeed(*given, capsys=capsys)
    assert re.search(
        r"\naccurate to about \S+ (% )?of the motion \(the step errs by \S+ per radian; sweeps", said
    )
    assert "work, energy and heat balance to" in said
    found = json.loads(succeed(*given, "--json", capsys=capsys))
    assert 0.0 < found["unsolved"] < 1e-6
    assert found["unsolved"] < found["step_error"] < 1e-3
    assert 1e-6 < found["accuracy"] < 1e-2
    assert found["energy_imbalance"] < 1e-4
    assert 1.0 <= found["sensitivity"] < 100.0
    assert 1.0 <= found["sweeps_per_step"] < 3.0
    fixed = json.loads(succeed(*given, "--json", "--iterations", "2", capsys=capsys))
    assert fixed["sweeps_per_step"] is None


@pytest.mark.parametrize("backend", ["numpy", pytest.param("c", marks=pytest.mark.compiler)])
def test_what_sweeps_have_not_solved_is_refused_and_leaves_no_file(
    backend: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    scene, target = folder / "falling.toml", folder / "motion.csv"
    scene.write_text(FALLING.format(step="0.04"))
    given = [
        "run",
        str(scene),
        "--until",
        "1",
        "--backend",
        backend,
        "--csv",
        str(target),
        "--iterations",
        "1",
    ]
    assert main(given) == 1
    said = capsys.readouterr().err
    assert "one sweep per stage left loads unsolved whose work is" in said
    assert not target.exists()
    # each of the remedies it names is one
    for remedy in ("--iterations auto", "--step 0.004", "model.unsolved="):
        assert remedy in said
    accepted = said.partition("--set model.unsolved=")[2].split()[0].rstrip(".")
    for more in (
        ["--set", f"model.unsolved={accepted}"],
        ["--iterations", "auto"],
        ["--step", "0.004"],
    ):
        assert main([*given, *more]) == 0, more
        capsys.readouterr()
    assert target.exists()


@pytest.mark.parametrize("sweeps", ["auto", "3"])
def test_long_steps_are_refused_however_often_they_sweep(
    sweeps: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    scene, target = folder / "falling.toml", folder / "motion.csv"
    scene.write_text(FALLING.format(step="0.1"))
    given = ["run", str(scene), "--until", "2", "--csv", str(target), "--iterations", sweeps, "--step", "0.1"]
    assert main(given) == 1
    said = capsys.readouterr().err
    assert "% of the motion, more than the 5 % that a run may have" in said
    assert not target.exists()
    remedies = re.findall(r"--step \S+(?=;)|--until \S+(?=;)|--set \S+(?=\.\n)", said)
    assert {remedy.split()[0] for remedy in remedies} >= {"--step", "--set"}
    for remedy in remedies:
        assert main([*given, *remedy.split()]) == 0, remedy
        capsys.readouterr()


def test_columns_that_say_nothing_are_left_out(capsys: pytest.CaptureFixture[str]) -> None:
    scenes = {name: str(SCENES / f"{name}.toml") for name in ("arm2", "fall10")}
    spun = succeed(scenes["arm2"], "--until", "0.05", capsys=capsys)
    assert "at rest" not in spun
    assert "overshoot" not in spun
    hanging = succeed(scenes["fall10"], "--until", "0.5", capsys=capsys)
    assert "at rest" in hanging
    assert "-0.222991" in hanging


def test_no_warning_of_a_library_reaches_the_terminal(folder: Path) -> None:
    scene = folder / "falling.toml"
    scene.write_text(FALLING.format(step="5e-3"))
    words = [
        sys.executable,
        "-W",
        "always",
        "-m",
        "tmm_gen",
        "run",
        str(scene),
        "--until",
        "0.2",
        "--plot",
        "a.png",
    ]
    ended = subprocess.run(words, cwd=folder, capture_output=True, text=True, check=False)
    assert (ended.returncode, ended.stderr) == (0, "")


def test_an_arm_that_stands_and_one_that_turns_steadily(capsys: pytest.CaptureFixture[str]) -> None:
    """Outputs of both are constant."""
    swing = str(SCENES / "swing.toml")
    assert main(["run", swing, "--until", "0.1"]) == 0
    assert "nothing moves, as all inputs are zero: try --input hub_torque=1" in capsys.readouterr().out
    turning = ["--set", "initial.rates=0.5", "--set", 'output=[{name="turn", at="base", of="rate"}]']
    assert (
        main(["run", str(SCENES / "arm2.toml"), "--until", "0.1", "--set", "base.damping=0", *turning]) == 0
    )
    assert "nothing moves" not in capsys.readouterr().out


def test_an_input_without_a_value(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["run", str(SCENES / "thesis2.toml"), "--input", "tip_torque"]) == 2
    said = capsys.readouterr().err
    assert "--input tip_torque: has no value. Write for example --input tip_torque=1.5." in said
    assert main(["run", str(SCENES / "thesis2.toml"), "--until", "1", "--input", "tip_torque=1.5"]) == 0


def test_rows_at_any_instant_are_drawn(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = [
        str(SCENES / "arm2.toml"),
        "--until",
        "0.05",
        "--plot",
        "a.png",
        "--animate",
        "a.gif",
        "--csv",
        "a.csv",
    ]
    for more, rows in ((["--every", "20ms"], 3), (["--every", "0.7ms"], 72), (["--tolerance", "1e-3"], None)):
        assert main(["run", *words, *more]) == 0, capsys.readouterr().err
        assert rows is None or len((folder / "a.csv").read_text().splitlines()) == rows + 1
        assert (folder / "a.png").read_bytes().startswith(b"\x89PNG")


def test_steps_by_a_tolerance(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (folder / "torque.csv").write_text("time,tip_torque\n0,0\n1,2\n1.237,-1\n")
    words = [THESIS2, "--until", "2", "--input", "torque.csv", "--tolerance", "1e-4", "--every", "20ms"]
    found = json.loads(succeed(*words, "--csv", "out.csv", "--json", capsys=capsys))
    assert found["tolerance"] == 1e-4
    assert found["every"] == pytest.approx(0.02)
    assert 0.0 < found["smallest_step"] <= found["largest_step"]
    assert found["steps"] * found["smallest_step"] <= 2.0 <= found["steps"] * found["largest_step"]
    assert found["refused_steps"] >= 0
    assert found["accuracy"] <= 1e-4
    rows = read_csv(folder / "out.csv")
    np.testing.assert_allclose(rows["time"], 0.02 * np.arange(101), atol=1e-15)
    load = {"tip_torque": Table(np.array([0.0, 1.0, 1.237]), np.array([0.0, 2.0, -1.0]))}
    exact = exact_response(load_scene(THESIS2), load, rows["time"])
    assert np.max(np.abs(rows["tip"] - exact["tip"])) <= 1.5e-4 * np.max(np.abs(exact["tip"]))
    shown = " ".join(succeed(*words, capsys=capsys).split())
    assert "steps as its tolerance asks by newmark" in shown
    assert (
        f"chose {found['steps']} steps for a tolerance of 0.0001: from {found['smallest_step']:.3g} to"
        in shown
    )


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--tolerance", "1"], "must be between 1e-10 and 0.05"),
        (["--every", "soon"], "must be a positive time, such as 1ms"),
        (["--every", "-1s"], "must be a positive time, such as 1ms"),
        (["--every", "2s"], "leave none within 1 s"),
        (["--tolerance", "1e-4", "--set", "integrator.name=houbolt"], "does not go with houbolt"),
    ],
)
def test_tolerances_and_rows_that_cannot_be(
    words: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert said in refuse(THESIS2, "--until", "1", *words, capsys=capsys)

"""Rest, modes, responses, checks, packages and sweeps from Python are those of the command line."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import tmm_gen as tg
from tmm_gen.api.wording import in_python
from tmm_gen.cli import main


@pytest.fixture
def told(rod: tg.Arm, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Callable[..., dict[str, object]]:
    """Return what a command says of the rod, as JSON."""
    file = rod.save(tmp_path / "rod.toml")

    def command(name: str, *words: str) -> dict[str, object]:
        assert main([name, str(file), *words, "--json"]) == 0
        found: dict[str, object] = json.loads(capsys.readouterr().out)
        return found

    return command


def test_modes(rod: tg.Arm, told: Callable[..., dict[str, list[dict[str, float]]]]) -> None:
    found = rod.modes(2, push=0.5)
    rows = told("modes", "--count", "2", "--input", "push=0.5")["rows"]
    assert (
        [mode.hertz for mode in found] == found.frequencies.tolist() == [row["frequency_hz"] for row in rows]
    )
    assert found.damping_ratios.tolist() == [row["damping_ratio"] for row in rows]
    assert found.rows[0]["exact_hz"] == rows[0]["exact_hz"]
    assert len(found) == 2
    assert found.stable
    assert repr(found).endswith(" Hz>")
    assert "continuous beam (Hz)" in found._repr_html_()
    assert found.plot().figure.axes
    assert not rod.modes(1, near={"hub": 3.1}).stable


def test_rest(rod: tg.Arm, told: Callable[..., dict[str, list[dict[str, object]]]]) -> None:
    found = rod.rest()
    rows = told("rest")["rows"]
    assert [each.state for each in found] == [row["state"] for row in rows]
    assert found[0].ends["tip"] == pytest.approx([0.0, -1.0])
    assert found[1].angles["hub" if "hub" in found[1].angles else "joint 1"] == pytest.approx(
        rows[1]["joints"][0]["angle"]  # type: ignore[index]
    )
    assert repr(found) == "<2 equilibria of rod: stable, reached from the start; falls over>"
    assert "looked for from" in found._repr_html_()
    assert len(found.plot().figure.axes) == 2


def test_in_space(probe: tg.Arm) -> None:
    assert probe.modes().frequencies[-1] > 0.1
    assert "what moves, by energy" in probe.modes()._repr_html_()
    assert probe.rest()[0].angles["boom"] == pytest.approx(0.0)
    assert probe.frequency("thrust_z", "weight", points=3).response["weight_z"].shape == (3,)


def test_frequency(rod: tg.Arm, told: Callable[..., object], tmp_path: Path) -> None:
    found = rod.frequency("hub_torque", "tip", low=0.2, high=20.0, points=50)
    band = ["--low", "0.2", "--high", "20", "--points", "50"]
    told("frequency", "--from", "hub_torque", "--to", "tip", *band, "--csv", str(tmp_path / "f.csv"))
    assert found.csv() == (tmp_path / "f.csv").read_text()
    assert repr(found) == "<Response of rod: tip for hub_torque, 0.2 to 20 Hz>"
    assert found.unit == "m per N m"
    assert np.iscomplexobj(found.response["tip_y"])
    assert "resonance (Hz)" in found._repr_html_()
    assert len(found.plot().figure.axes) == 2


def test_how_few_links(rod: tg.Arm, told: Callable[..., dict[str, object]]) -> None:
    found = rod.links_for(0.05, 8.0)
    assert found.links == told("frequency", "--links-for", "0.05", "--band", "8")["links"]
    assert repr(found).startswith(f"<{found.links} links: ")


def test_check(shafts: tg.Arm, tmp_path: Path, said: Callable[..., list[dict[str, float]]]) -> None:
    arm = shafts.with_(emit__backends=["numpy", "casadi"])
    found = arm.check(brake=0.5)
    rows = said("check", arm.save(tmp_path / "shafts.toml"), "--input", "brake=0.5")
    assert [row.value for row in found.rows] == [row["value"] for row in rows]
    assert found
    assert found.rows[0].check == "numpy_against_casadi"
    assert repr(found) == f"<Check of shafts: everything holds, {len(found.rows)} comparisons>"
    assert "numpy against casadi" in found._repr_html_()
    with pytest.raises(tg.UserError, match="drive: a prescribed base is moved by the check itself"):
        shafts.check(drive=1.0)


def test_build_and_casadi(shafts: tg.Arm, tmp_path: Path) -> None:
    built = shafts.build(tmp_path)
    assert (tmp_path / "shafts" / "kernel.py").is_file()
    assert repr(built) == f"<{tmp_path / 'shafts'}: built, {len(built.written)} files written>"
    assert shafts.build(tmp_path).state == "up to date"
    # what is there is what the command would write
    assert main(["build", str(shafts.save(tmp_path / "shafts.toml")), "--out", str(tmp_path), "--check"]) == 0
    with (tmp_path / "shafts" / "kernel.py").open("a") as file:
        file.write("# mine\n")
    with pytest.raises(tg.UserError, match=r"edited by hand .* or lose it with force=True"):
        shafts.build(tmp_path)
    assert shafts.build(tmp_path, force=True).written == ("kernel.py",)
    assert shafts.casadi().step_function().name() == "shafts_step"
    assert shafts.casadi() is shafts.casadi()


def test_export(rod: tg.Arm, tmp_path: Path) -> None:
    made = rod.export(tmp_path / "rod.xml")
    assert "</mujoco>" in made.file.read_text()
    assert isinstance(made.left_out, tuple)
    theirs = tmp_path / "theirs.xml"
    assert main(["export", str(rod.save(tmp_path / "rod.toml")), "--to", "mjcf", "--out", str(theirs)]) == 0
    assert made.file.read_text() == theirs.read_text()
    for call, words in (
        (lambda: rod.export("rod.zip"), "must end in .fmu or .xml or .urdf"),
        (lambda: rod.export("rod.fmu", fmi=4), "fmi: must be 2 or 3, not 4"),  # type: ignore[arg-type]
        (lambda: rod.export(tmp_path / "rod.urdf"), "space"),
    ):
        with pytest.raises(tg.UserError, match=words):
            call()


def test_a_chain_has_no_rest(shafts: tg.Arm) -> None:
    with pytest.raises(tg.UserError, match=r"a chain has no weight .* simulate\(\) shows that"):
        shafts.rest()
    with pytest.raises(tg.UserError, match="its modes do not depend on loads"):
        shafts.modes(brake=1.0)
    with pytest.raises(tg.UserError, match="is the same about any rest"):
        shafts.linearise({"joint 1": 0.1})


def test_sweeps(rod: tg.Arm) -> None:
    found = tg.sweep(
        rod,
        lambda arm: arm.scene.stations * arm.scene.beam.length,
        beam__links=[1, 3],
        beam__length=(1.0, 2.0),
    )
    assert found.array.tolist() == [[1.0, 2.0], [3.0, 6.0]]
    assert found.points[1] == {"beam.links": 1, "beam.length": 2.0}
    assert repr(found) == "<Sweep of rod: 2 beam.links by 2 beam.length>"
    kept = tg.sweep(rod, lambda arm: arm.scene.stations, {"beam.links": [0, 1]}, keep_refused=True)
    assert np.isnan(kept.array).tolist() == [True, False]
    assert "must be at least 1 (got 0)" in str(kept.refusals[0])
    assert "must be at least 1" in kept._repr_html_()
    runs = tg.sweep(rod, lambda arm: arm, beam__links=range(1, 3))
    assert runs.array[1] == rod


@pytest.mark.parametrize(
    ("ask", "words"),
    [
        (lambda arm: tg.sweep(arm, len), "has nothing to change"),
        (lambda arm: tg.sweep(3, len, x=[1]), "takes an arm, as load"),
        (lambda arm: tg.sweep(arm, 3, beam__links=[1]), "takes a function of an arm"),
        (lambda arm: tg.sweep(arm, len, beam__links=3), "must be given several values"),
        (lambda arm: tg.sweep(arm, len, beam__links=[]), "has no values"),
        (lambda arm: tg.sweep(arm, str, beam__links=[0]), "must be at least 1"),
        (lambda arm: arm.modes(0), "count: must be a whole number from 1, not 0"),
        (lambda arm: arm.modes(push=[1.0, 2.0]), r"push: \[1.0, 2.0\] is not a finite number"),
        (lambda arm: arm.modes(near={"wrist": 1.0}), "has no joint 'wrist'; there are hub, joint 1"),
        (lambda arm: arm.rest(near={"hub": "up"}), r'near=\{"hub": "up"\}: write near=\{JOINT: ANGLE\}'),
        (lambda arm: arm.rest(near=0.5), "near: must be a mapping from joints to angles"),
        (lambda arm: arm.frequency("pull"), 'source="pull": no such name; choose from push, hub_torque'),
        (lambda arm: arm.frequency(target="moving"), 'target="moving": no such name; choose from tip, root'),
        (lambda arm: arm.frequency(low=5.0, high=1.0), "low: 5 must be less than high, 1"),
        (lambda arm: arm.frequency(low=1e9), "is empty. Give both low and high"),
        (lambda arm: arm.links_for(0.0, 1.0), "error: must be a positive number, not 0.0"),
        (lambda arm: arm.links_for(1e-9, 50.0), r"links_for\(1e-09, 50\): .* are not enough .* Ask for less"),
        (
            lambda arm: tg.load("scenes/elbow.toml").links_for(0.1, 5.0),
            r"links_for\(\) does not cut yet.* modes\(\) says",
        ),
        (lambda arm: arm.frequency(points=1), "points: must be a whole number from 2"),
    ],
)
def test_refusals(rod: tg.Arm, ask: Callable[[tg.Arm], object], words: str) -> None:
    with pytest.raises(tg.UserError, match=words):
        ask(rod)


@pytest.mark.parametrize(
    ("said", "in_words"),
    [
        ("Try a smaller step, --step 0.001; or look", "Try a smaller step, step=0.001; or look"),
        ("shorter time (--until) or larger steps (--step).", "shorter time (until) or larger steps (step)."),
        ("Use --set model.linearisation=newton.", 'Use with_(model__linearisation="newton").'),
        ("--set initial.angles=0.5, or use", "with_(initial__angles=0.5), or use"),
        ("a smooth way, --input base=smooth:0:1:0.8s.", 'a smooth way, base="smooth:0:1:0.8s".'),
        ("for example --near elbow=0.5.", 'for example near={"elbow": 0.5}.'),
        ("--near joint 1=0.5: is", 'near={"joint 1": 0.5}: is'),
        ("with --backend c.", 'with backend="c".'),
        ("give both --low and --high.", "give both low and high."),
        ("`tmm-gen new NAME` writes one", "`tmm-gen new NAME` writes one"),
    ],
)
def test_options_are_arguments(said: str, in_words: str) -> None:
    assert in_python(said) == in_words
    assert in_python(in_words) == in_words  # what is said twice is said once

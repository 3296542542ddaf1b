"""`tmm-gen trade`: what it prints, writes and refuses."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import pytest

from tmm_gen.cli import main

SCENES = Path(__file__).resolve().parents[2] / "scenes"
THESIS2 = str(SCENES / "thesis2.toml")
QUICK = ("--integrators", "newmark,sdirk4", "--steps", "0.5,0.25,0.1", "--until", "5", "--rounds", "2")


def answer(capsys: pytest.CaptureFixture[str], *words: str) -> dict[str, object]:
    assert main(["trade", *words, "--json"]) == 0
    found: dict[str, object] = json.loads(capsys.readouterr().out)
    return found


def test_json_has_every_configuration(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    file, store = tmp_path / "all.csv", tmp_path / "s.sqlite"
    found = answer(capsys, THESIS2, *QUICK, "--csv", str(file), "--store", str(store))
    rows = found["rows"]
    assert isinstance(rows, list)
    assert len(rows) == 2 * 3 + 1  # and the scene itself
    for row in rows:
        assert row["outcome"] == "finished"
        assert 0.0 < row["error"] < 0.5
        assert row["ns_per_simulated_second"] == pytest.approx(row["ns_per_step"] / row["step"])
        assert row["modelling_error"] is None
    assert any(row["pareto"] for row in rows)
    assert found["excitation"] == [
        "tip_torque: 10 sin(1.885 t)"
    ]  # both springs turn by a radian under 10 N m
    assert [each["error"] for each in found["findings"]] == [1e-2, 1e-4, 1e-6]  # type: ignore[attr-defined]
    with file.open() as lines:
        kept = list(csv.DictReader(lines))
    assert [float(row["error"]) for row in kept] == [row["error"] for row in rows]
    # the second time nothing is computed: results are in the store
    assert [row["error"] for row in answer(capsys, THESIS2, *QUICK, "--store", str(store))["rows"]] == [  # type: ignore[attr-defined]
        row["error"] for row in rows
    ]


def test_table_shows_the_front_and_says_who_wins(capsys: pytest.CaptureFixture[str]) -> None:
    words = (
        "--integrators",
        "newmark,zhai",
        "--steps",
        "0.5,0.1,0.05,0.025",
        "--until",
        "5",
        "--rounds",
        "0",
    )
    assert main(["trade", THESIS2, *words, "--tolerances", "1e-3"]) == 0
    out = capsys.readouterr().out
    assert "By a tolerance of 0.001 newmark takes " in out
    assert "By a tolerance of 0.001 zhai has no run: " in out
    assert "At an error of 0.0001, newmark is the cheapest, with steps of 0.012 s." in out
    assert "At an error of 1e-06 nothing gets there." in out
    assert "9 configurations: 8 finished, 1 diverged." in out
    assert main(["trade", THESIS2, *words, "--all"]) == 0
    assert capsys.readouterr().out.count("│") > out.count("│")


def test_given_inputs_move_the_arm(capsys: pytest.CaptureFixture[str]) -> None:
    found = answer(capsys, THESIS2, *QUICK, "--input", "tip_torque=1")
    assert found["excitation"] == ["tip_torque: 1, constant"]


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--integrators", "simpson"), "--integrators simpson: no such integrator; there are fox_euler"),
        (("--steps", "0.1,0"), "'0' is no positive number"),
        (("--links", "5"), "has no [beam] to cut into links"),
        (("--links", "many"), "'many' is no positive whole number"),
        (("--iterations", "2"), "a chain is linear"),
        (("--corrections", "1"), "--corrections: a chain is linear, nothing is iterated. Leave that out."),
        (("--corrections", "-1"), "is no whole number from 0"),
        (("--reals", "float16"), "'float16' is none of float64, float32"),
        (("--output", "elbow"), "no such output; choose from tip"),
        (("--input", "tip_torque=0"), "nothing moves"),
        (("--workers", "2", "--scheduler", "tcp://h:1"), "give one of them"),
        (("--until", "-3"), "must be a positive number"),
        (("--until", "1e-300"), "simulate between 1e-12 and 1e+12 s"),
    ],
)
def test_bad_usage(capsys: pytest.CaptureFixture[str], words: tuple[str, ...], message: str) -> None:
    assert main(["trade", THESIS2, *words]) == 2
    assert message in " ".join(capsys.readouterr().err.split())


def test_store_that_is_none(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    notes = tmp_path / "notes.txt"
    notes.write_text("mine\n" * 500)
    assert main(["trade", THESIS2, *QUICK, "--store", str(notes)]) == 2
    assert "cannot be used" in capsys.readouterr().err
    assert notes.read_text() == "mine\n" * 500


def test_nothing_to_draw(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    target = tmp_path / "page.html"
    words = ("--integrators", "newmark", "--steps", "5", "--until", "5e-3", "--report", str(target))
    assert main(["trade", THESIS2, *words]) == 1
    assert "no configuration finished" in capsys.readouterr().err
    assert not target.exists()

"""Inputs as a user gives them: what is understood, and what is refused with file, line and remedy."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tmm_gen.errors import UserError
from tmm_gen.inputs.given import read_inputs
from tmm_gen.inputs.signals import Constant

NAMES = ("hub_torque", "tip_torque")
BOTH = "time,hub_torque,tip_torque\n0,1,10\n1,2,20\n3,0,20\n"


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_numbers_are_constant() -> None:
    found = read_inputs(["hub_torque=-1.5e-3"], NAMES)
    assert found == {"hub_torque": Constant(-1.5e-3)}


def test_a_file_gives_every_input(folder: Path) -> None:
    (folder / "u.csv").write_text(BOTH)
    found = read_inputs(["u.csv"], NAMES)
    np.testing.assert_allclose(found["hub_torque"].at([-1.0, 0.0, 0.5, 2.0, 3.0, 9.0]), [1, 1, 1.5, 1, 0, 0])
    np.testing.assert_allclose(found["tip_torque"].at([0.25, 100.0]), [12.5, 20.0])


def test_a_number_may_stand_for_a_column(folder: Path) -> None:
    (folder / "u.csv").write_text("time, tip_torque ,measured\r\n0, 1 ,x\r\n\r\n1,2,y\r\n")
    found = read_inputs(["u.csv", "hub_torque=4"], NAMES)
    assert found["hub_torque"] == Constant(4.0)
    assert found["tip_torque"].at(0.5) == 1.5


@pytest.mark.parametrize("heading", ["hub_torque", "torque (N m)"])
def test_one_column_by_name_or_alone(heading: str, folder: Path) -> None:
    (folder / "torque.csv").write_text(f"\ufefftime,{heading}\n0,3\n", encoding="utf-8")
    assert read_inputs(["hub_torque=torque.csv"], NAMES)["hub_torque"].at(7.0) == 3.0


def test_a_name_with_an_equals_sign_may_be_a_file(folder: Path) -> None:
    (folder / "gain=2.csv").write_text(BOTH)
    assert set(read_inputs(["gain=2.csv"], NAMES)) == set(NAMES)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        (["hub_torqe=1"], "--input hub_torqe=1: the scene has no input 'hub_torqe'. Did you mean hub_torq"),
        (["zzz=1"], "Its inputs are hub_torque, tip_torque."),
        (["hub_torque=1", "hub_torque=2"], "'hub_torque' is given twice"),
        (["hub_torque=fast"], "'fast' is neither a number nor a CSV file nor a profile. Write for example --input"),
        (["hub_torque="], "'' is neither"),
        (["hub_torque=nan"], "nan is not finite"),
        (["hub_torque=missing.csv"], "missing.csv: no such file"),
        (["missing.csv"], "missing.csv: no such file"),
        (["hub_torque=1", "tip_torque=2", "missing.csv"], "every input is given already"),
    ],
)  # fmt: skip
def test_bad_arguments(given: list[str], said: str, folder: Path) -> None:
    with pytest.raises(UserError) as caught:
        read_inputs(given, NAMES)
    assert said in str(caught.value)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "u.csv: is empty. Its first line names the columns: time,hub_torque,tip_torque."),
        ("time,hub_torque,tip_torque\n", "u.csv: has no rows"),
        ("t,hub_torque,tip_torque\n0,1,2\n", "u.csv:1: has no column 'time'. It has t, hub_torque"),
        ("time,hub_torque\n0,1\n", "u.csv:1: has no column 'tip_torque'"),
        ("time;hub_torque;tip_torque\n0;1;2\n", "Separate columns by commas."),
        ("time,hub_torque,hub_torque\n0,1,2\n", "u.csv:1: two columns are named 'hub_torque'"),
        (BOTH + "3,1,1\n", "u.csv:5: time: 3.0 does not follow 3.0. Sort the rows"),
        (BOTH + "2,1,1\n", "u.csv:5: time: 2.0 does not follow 3.0"),
        (BOTH + "4,1\n", "u.csv:5: has 2 values where the first line names 3 columns"),
        (BOTH + "4,1,two\n", "u.csv:5: tip_torque: 'two' is not a finite number"),
        (BOTH + "\n4,inf,1\n", "u.csv:6: hub_torque: 'inf' is not a finite number"),
    ],
)  # fmt: skip
def test_bad_files(text: str, said: str, folder: Path) -> None:
    (folder / "u.csv").write_text(text)
    with pytest.raises(UserError) as caught:
        read_inputs(["u.csv"], NAMES)
    assert said in str(caught.value)


def test_a_file_that_is_no_text(folder: Path) -> None:
    (folder / "u.csv").write_bytes(b"time,hub_torque,tip_torque\n\xff\xfe,1,2\n")
    with pytest.raises(UserError, match="is not UTF-8 text"):
        read_inputs(["u.csv"], NAMES)


def test_a_scene_without_inputs() -> None:
    with pytest.raises(UserError, match="has no inputs"):
        read_inputs(["a=1"], ())

"""Clocks of tables: where the motion starts, and inputs that a simulation would not see."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tmm_gen.cli import main
from tmm_gen.errors import UserError
from tmm_gen.inputs.clock import from_start, refuse_other_clock, starts_of
from tmm_gen.inputs.curve import through
from tmm_gen.inputs.given import read_tables
from tmm_gen.inputs.signals import Constant, Table
from tmm_gen.study.rise import Rise

SCENE = Path(__file__).resolve().parents[2] / "scenes" / "thesis2.toml"


def rows(first: float, last: float, count: int = 50) -> Table:
    return Table(np.linspace(first, last, count), np.ones(count))


@given(first=st.floats(-1e3, 2e9), span=st.floats(0.5, 100.0))
def test_the_motion_starts_where_the_clock_does(first: float, span: float) -> None:
    outputs = {"tip": rows(first, first + span)}
    interval = span / 49
    if 0.0 < first < 0.99 * span and first > 1.51 * interval:
        with pytest.raises(UserError, match="--start"):
            starts_of(outputs, {})
    elif first < 0.0 or first > 1.01 * span:
        assert starts_of(outputs, {}) == (first,)
        assert from_start(outputs, first)["tip"].knots[0] == 0.0
    elif 0.0 <= first < 1.49 * interval:
        assert set(starts_of(outputs, {})) == {0.0, first}


def test_inputs_on_the_same_clock_say_more() -> None:
    assert starts_of({"tip": rows(0.5, 2.0)}, {"u": rows(0.0, 1.0)}) == (0.0,)
    assert starts_of({"tip": rows(100.0, 101.0)}, {"u": rows(0.0, 1.0)}) == (100.0,)
    assert starts_of({"tip": rows(100.0, 101.0)}, {"u": Constant(1.0)}) == (100.0,)


@given(first=st.floats(-1e10, 1e10), span=st.floats(1e-3, 1e10), until=st.floats(1e-3, 1e3))
def test_a_simulation_sees_its_inputs(first: float, span: float, until: float) -> None:
    """Refused is just what would be one constant for all of the simulation."""
    table = Table(np.array([first, first + span]), np.array([1.0, 2.0]))
    seen = np.unique(table.at(np.linspace(0.0, until, 500)))
    if first + span < 0.0 or first >= until:
        assert len(seen) == 1
        with pytest.raises(UserError, match="Subtract the first instant"):
            refuse_other_clock({"u": table}, until)
    else:
        refuse_other_clock(
            {"u": table, "v": Constant(1.0), "w": Table(table.times[:1], table.values[:1])}, until
        )


@pytest.mark.parametrize("start", [100.0, 1.764e9, -1e3])
def test_run_refuses_a_clock_it_would_not_see(
    start: float, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    load = tmp_path / "u.csv"
    load.write_text(f"time,tip_torque\n{start:.1f},1\n{start + 1:.1f},0\n")
    assert main(["run", str(SCENE), "--until", "2", "--input", str(load)]) == 2
    assert "Subtract the first instant from the column `time`" in capsys.readouterr().err


def test_empty_cells_are_missing_samples(tmp_path: Path) -> None:
    path = tmp_path / "r.csv"
    path.write_text("time,a,b\n0,1,\n1,,2\n2,nan,3\n3,4, \n")
    found = read_tables(path, ("a", "b"), gaps=True)
    assert found["a"].times.tolist() == [0.0, 3.0]
    assert found["b"].values.tolist() == [2.0, 3.0]
    with pytest.raises(UserError, match=r"r\.csv:2: b: '' is not a finite number"):
        read_tables(path, ("a", "b"))
    path.write_text("time,a,b\n0,1,\n1,2,\n")
    with pytest.raises(UserError, match="the column 'b' is empty"):
        read_tables(path, ("a", "b"), gaps=True)


def test_what_cannot_be_moved_is_refused() -> None:
    """A smooth rise has instants of its own: left where it is, it would act at another time."""
    rise = Rise(1.0, 2.0)
    assert from_start({"u": rise}, 0.0) == {"u": rise}
    with pytest.raises(UserError, match="cannot be put on another clock"):
        from_start({"u": rise}, 5.0)


def test_a_motion_in_pieces_is_the_same_on_another_clock() -> None:
    times = np.array([100.0, 100.1, 100.2, 100.35, 100.5, 100.6, 100.7])
    curve = through(Table(1e3 * times, np.sin(3.0 * times)))
    moved = from_start({"base": curve}, 100.0, 1e-3)["base"]
    inside = np.linspace(0.0, 0.69, 50)
    there = 1e3 * (inside + 100.0)
    np.testing.assert_allclose(moved.at(inside), curve.at(there), rtol=1e-9)
    np.testing.assert_allclose(moved.slope(inside), 1e3 * curve.slope(there), rtol=1e-6, atol=1e-9)
    np.testing.assert_allclose(moved.curvature(inside), 1e6 * curve.curvature(there), rtol=1e-5, atol=1e-6)
    with pytest.raises(UserError, match="so that it would see none of them"):
        refuse_other_clock({"base": through(Table(times, np.sin(times)))}, 10.0)

"""Whatever clock a record has: the number that made it, or a refusal in words; never another number."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tmm_gen.calibration.calibrate import Calibration, calibrate
from tmm_gen.cli import main
from tmm_gen.errors import UserError
from tmm_gen.inputs.signals import Table
from tmm_gen.native import compile_kernel
from tmm_gen.native.series import Series
from tmm_gen.program.build import build_program
from tmm_gen.scene import Scene

pytestmark = pytest.mark.compiler

TRUTH = 9.0
KEY = "beam.bending_stiffness"
UNTIL = 1.0


def torque(time: np.ndarray) -> np.ndarray:
    return np.interp(time, [0.0, 0.2, 0.4, 0.6, 0.8], [1.0, 1.0, -1.0, 1.0, 0.0])


@pytest.fixture(scope="module")
def small(swing: Scene) -> Scene:
    return swing.replace(**{"beam.links": 2, "integrator.step": 2e-3})


@pytest.fixture(scope="module")
def record(small: Scene) -> dict[str, Table]:
    """The arm that is to be found, recorded without noise."""
    truth = small.replace(**{KEY: TRUTH})
    kernel = compile_kernel(build_program(truth), truth)
    steps, step = round(UNTIL / 2e-3), 2e-3
    outputs = Series(kernel, {"hub_torque": torque}, steps, step).run()
    times = step * np.arange(steps + 1)
    found = {name: Table(times, outputs[name]) for name in ("hub", "tip_x", "tip_y")}
    return {**found, "hub_torque": Table(times, torque(times))}


def on(clock: dict[str, Table], start: float, scale: float = 1.0) -> dict[str, Table]:
    return {name: Table(scale * table.times + start, table.values) for name, table in clock.items()}


def is_right(done: Calibration) -> None:
    (found,) = done.found
    assert found.value == pytest.approx(TRUTH, rel=2e-3)
    assert found.interval[0] <= found.value <= found.interval[1]


starts = st.one_of(
    st.just(0.0),
    st.floats(-5.0, 5.0),
    st.floats(0.0, 0.01),
    st.floats(1.0, 1e5),
    st.floats(1.6e9, 1.9e9),
)


@pytest.mark.long
@settings(max_examples=15, deadline=None, suppress_health_check=list(HealthCheck))
@given(start=starts, unit=st.sampled_from([1.0, 1e3, 1e6, 1e9, 1.0 / 60.0]), seed=st.integers(0, 1000))
def test_any_clock_gives_the_number_or_a_refusal(
    small: Scene, record: dict[str, Table], start: float, unit: float, seed: int
) -> None:
    """Clocks start anywhere, count other units than seconds; rows are missing, cells are empty."""
    random = np.random.default_rng(seed)
    table = record["hub"].times
    kept = random.random(len(table)) < random.uniform(0.3, 1.0)
    kept[0] = True
    begin = random.uniform(0.1, 0.9)
    gap = (table > begin) & (table < begin + random.uniform(0.0, 0.3)) & (table > 0.0)
    thinned = {}
    for name, column in record.items():
        empty = random.random(len(table)) < (0.3 if name != "hub_torque" else 0.0)
        empty[0] = False
        # the torque is what it is in a gap too, or nobody could tell what the arm did
        rows = kept & ~empty & ~(gap & (name != "hub_torque"))
        thinned[name] = Table(column.times[rows], column.values[rows])
    thinned["hub_torque"] = record["hub_torque"]
    try:
        done = calibrate(small, on(thinned, start * unit, unit), [KEY])
    except UserError as error:
        said = str(error)
        assert "clock" in said or "--start" in said
        assert (
            unit != 1.0 or 0.0 < start <= UNTIL
        )  # what counts seconds is refused where zero may be meant only
        return
    assert unit == 1.0
    is_right(done)


def test_the_start_can_be_said(small: Scene, record: dict[str, Table]) -> None:
    later = {name: Table(t.times[100:], t.values[100:]) for name, t in record.items() if name != "hub_torque"}
    with pytest.raises(UserError, match=r"--start 0\.2 or --start 0\."):
        calibrate(small, {**later, "hub_torque": Table(*_rows(record["hub_torque"], 100))}, [KEY])
    is_right(calibrate(small, {**later, "hub_torque": record["hub_torque"]}, [KEY]))  # the torque begins at 0
    is_right(calibrate(small, on(record, 0.5), [KEY], start=0.5))


def _rows(table: Table, first: int) -> tuple[np.ndarray, np.ndarray]:
    return table.times[first:], table.values[first:]


def test_inputs_on_another_clock_are_refused(small: Scene, record: dict[str, Table]) -> None:
    outputs = {name: table for name, table in record.items() if name != "hub_torque"}
    for start in (100.0, -50.0, 1.764e9):
        with pytest.raises(UserError, match="their clocks differ"):
            calibrate(small, {**on(outputs, start), "hub_torque": record["hub_torque"]}, [KEY])
    late = Table(record["hub_torque"].times[50:], record["hub_torque"].values[50:])
    with pytest.raises(UserError, match="what acted before is not known"):
        calibrate(small, {**outputs, "hub_torque": late}, [KEY])


def test_a_model_that_does_not_follow_fails(
    swing: Scene, record: dict[str, Table], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The torque's sign is wrong: nothing makes the arm swing the other way."""
    path = tmp_path / "r.csv"
    times = record["hub"].times
    _write(path, times, {"hub": record["hub"].values, "hub_torque": -torque(times)})
    scene = tmp_path / "swing.toml"
    scene.write_text(Path(swing.source.origin).read_text())
    assert main(["calibrate", str(scene), str(path), "--fit", KEY]) == 1
    said = capsys.readouterr().err
    assert said.startswith("error:")
    assert "does not follow the record" in said
    assert len(said.splitlines()) == 1
    _write(path, 1e3 * times, {"hub": record["hub"].values})
    assert main(["calibrate", str(scene), str(path), "--input", "hub_torque=1", "--fit", KEY]) == 2
    assert "--time-unit ms" in capsys.readouterr().err


def _write(path: Path, times: np.ndarray, columns: dict[str, np.ndarray]) -> None:
    rows = np.column_stack([times, *columns.values()])
    lines = [",".join(["time", *columns]), *(",".join(map(repr, row)) for row in rows.tolist())]
    path.write_text("\n".join(lines) + "\n")


def test_empty_cells_and_units_from_files(
    swing: Scene, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """As a user does it: a record in milliseconds of Unix time, cells empty, one column of words."""
    made = str(tmp_path / "made.csv")
    scene = swing.source.origin
    load = tmp_path / "u.csv"
    load.write_text("time,hub_torque\n0,1\n0.2,1\n0.4,-1\n0.6,1\n0.8,0\n")
    assert (
        main(["run", scene, "--set", f"{KEY}=10.5", "--input", str(load), "--until", "1", "--csv", made]) == 0
    )
    header, *rows = Path(made).read_text().splitlines()
    random = np.random.default_rng(3)
    lines = [header + ",remark"]
    for row in rows:
        time, *cells = row.split(",")
        holed = [cell if random.random() < 0.7 else random.choice(["", " ", "NaN"]) for cell in cells]
        lines.append(",".join([f"{1e3 * float(time) + 1.764e12:.3f}", *holed, "fine"]))
    Path(made).write_text("\n".join(lines) + "\n")
    head, *u = load.read_text().splitlines()
    moved = [f"{1e3 * float(r.split(',')[0]) + 1.764e12:.3f},{r.split(',')[1]}" for r in u]
    load.write_text("\n".join([head, *moved]) + "\n")
    capsys.readouterr()
    words = ["calibrate", scene, made, "--input", str(load), "--time-unit", "ms", "--fit", KEY]
    assert main(words) == 0
    said = capsys.readouterr()
    assert "10.5" in said.out
    assert "the arm starts at 1764000000 s" in said.out
    assert said.err == ""


def test_single_wrong_samples(small: Scene, record: dict[str, Table]) -> None:
    """One sample in fifty is far off, by up to twenty times all that moves: Huber's loss does not mind."""
    random = np.random.default_rng(11)
    spoilt = dict(record)
    for name in ("hub", "tip_x", "tip_y"):
        values = record[name].values + 1e-3 * random.standard_normal(len(record[name].values))
        wrong = random.random(len(values)) < 0.02
        values[wrong] += random.uniform(-20.0, 20.0, int(wrong.sum()))
        spoilt[name] = Table(record[name].times, values)
    with pytest.raises(UserError, match="--loss huber"):
        calibrate(small, spoilt, [KEY])
    done = calibrate(small, spoilt, [KEY], loss="huber")
    (found,) = done.found
    assert done.outliers >= 20
    assert abs(found.value - TRUTH) < 4.0 * found.deviation
    assert found.deviation < 0.02 * TRUTH


@pytest.mark.long
def test_intervals_hold_the_truth_under_jitter(small: Scene, record: dict[str, Table]) -> None:
    """The clock of each row is off by up to 4 ms, of all outputs at once; there is little other noise."""
    held, narrow = 0, 0
    runs = 20
    for seed in range(runs):
        random = np.random.default_rng(seed)
        times = record["hub"].times[::5]
        taken = np.clip(times + random.uniform(-4e-3, 4e-3, len(times)), 0.0, UNTIL)
        jittered = {
            name: Table(
                times, np.interp(taken, table.times, table.values) + 1e-4 * random.standard_normal(len(times))
            )
            for name, table in record.items()
            if name != "hub_torque"
        }
        (found,) = calibrate(small, {**jittered, "hub_torque": record["hub_torque"]}, [KEY]).found
        low, high = found.interval
        held += low <= TRUTH <= high
        narrow += found.deviation < 0.1 * TRUTH
    assert held >= 0.85 * runs
    assert narrow == runs


def test_a_record_without_noise_warns_of_nothing(small: Scene, record: dict[str, Table]) -> None:
    """NumPy's warnings are errors in the tests."""
    still = small.replace(**{KEY: TRUTH})
    done = calibrate(still, record, [KEY])
    is_right(done)
    assert np.all(np.isfinite(done.correlation))
    assert done.misfit < 1e-9

"""Numbers of `[control]` with which nothing can be solved are named: file, line, key, value, and what serves."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tmm_gen.cli import main
from tmm_gen.control.bench import Bench
from tmm_gen.control.estimators.extended_kalman import NonlinearFilter
from tmm_gen.control.task.extremes import UnsolvableError
from tmm_gen.scene import parse_scene

FILE = Path(__file__).resolve().parents[2] / "scenes" / "elbow.toml"


def small(key: str, value: str) -> str:
    """Return the arm with two motors, few cells and a short horizon, one number of its control as given."""
    text = re.sub(r"(?m)^links = \d+", "links = 1", FILE.read_text())
    text = re.sub(r"(?m)^horizon = \d+", "horizon = 8", text)
    table, _, name = key.rpartition(".")
    head, body = text.split(f"[{table}]", 1)
    if re.search(rf"(?m)^{name} = .*", body.split("\n[")[0]):
        body = re.sub(rf"(?m)^{name} = [^#\n]*", f"{name} = {value} ", body, count=1)
    else:
        body = body.replace("\n", f"\n{name} = {value}\n", 1)
    return f"{head}[{table}]{body}"


@pytest.mark.parametrize(
    ("key", "value", "controller"),
    [
        ("control.sample_time", "1e30", "mpc-modes"),
        ("control.weights.tip", "1e300", "mpc-modes"),
        ("control.weights.hub_rate", "1e30", "mpc-modes"),
        ("control.weights.torque", "{ shoulder = 1e300, elbow = 1.0 }", "mpc-modes"),
        ("control.weights.torque_step", "1e300", "rti-zero"),
    ],
)
def test_the_number_that_is_extreme_is_named(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    key: str,
    value: str,
    controller: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    text = small(key, value)
    Path("arm.toml").write_text(text)
    words = ["mpc", "arm.toml", "--controller", controller, "--condition", "nominal", "--until", "0.04"]
    assert main(words) == 2
    said = capsys.readouterr().err
    number = re.search(r"1e-?\d+", value)
    assert number is not None
    line = next(i for i, each in enumerate(text.split("\n"), 1) if number[0] in each)
    found = re.search(
        rf"arm\.toml:{line}: {key}(\.shoulder)?: with this the numbers of the controller leave", said
    )
    assert found is not None, said
    assert f"(got {float(number[0]):g}). Write one nearer to " in said
    usual = said.rpartition("Write one nearer to ")[2].strip().rstrip(".")
    Path("arm.toml").write_text(text.replace(number[0], usual))
    assert main(words) == 0


def test_steps_too_long_for_any_filter_are_named_and_the_remedy_serves() -> None:
    text = re.sub(r"(?m)^substeps = \d+", "substeps = 1", FILE.read_text())
    scene = parse_scene(text, "elbow.toml")
    line = text[: text.index("substeps = 1")].count("\n") + 1
    bench = Bench.of(scene)
    with pytest.raises(
        UnsolvableError, match=rf"elbow\.toml:{line}: control\.substeps: .* 0\.02 s \(got 1\)"
    ) as found:
        NonlinearFilter(bench.step, bench.links)
    (more,) = re.findall(r"such as (\d+)", str(found.value))
    better = Bench.of(scene.replace(**{"control.substeps": int(more)}))
    NonlinearFilter(better.step, better.links)


@pytest.mark.parametrize("pose", ["", "[[control.trajectory.pose]]\nangles = -0.05\nduration = 1.0\n"])
def test_more_samples_than_can_be_kept_are_told_by_their_time(
    pose: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """In a loop as on a way; the line is that of the key."""
    text = re.sub(r"(?m)^sample_time = \S+", "sample_time = 1e-9", FILE.read_text()) + pose
    (tmp_path / "elbow.toml").write_text(text)
    line = text[: text.index("sample_time")].count("\n") + 1
    words = ["mpc", str(tmp_path / "elbow.toml"), "--controller", "pd", "--condition", "nominal"]
    assert main([*words, "--until", "2"]) == 2
    told = capsys.readouterr().err
    assert f"elbow.toml:{line}: control.sample_time: makes {'1' if pose else '2'}e+09 samples" in told
    assert "Write a longer one" in told

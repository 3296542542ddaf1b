"""The README's snippets run as they stand, Python and C say the same, and its figures are those measured."""

from __future__ import annotations

import json
import re
import subprocess
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).parents[2]
TEXT = (ROOT / "README.md").read_text()
FLAGS = ["-std=c99", "-Wall", "-Wextra", "-Werror"]


def blocks(language: str) -> list[str]:
    return re.findall(rf"```{language}\n(.*?)```", TEXT, re.DOTALL)


def vector(text: str) -> list[float]:
    return [float(number) for number in text.strip().strip("[]").split()]


def test_python_and_c_say_where_the_tip_is(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    for folder in ("scenes", "generated"):
        (tmp_path / folder).symlink_to(ROOT / folder)
    monkeypatch.chdir(tmp_path)
    interface, _ = blocks("python")
    exec(interface, {})
    printed = capsys.readouterr().out.splitlines()
    assert printed[0].startswith("<Run of swing, 1 s in 200 steps by newmark: tip_x, tip_y, hub, accurate")
    assert (tmp_path / "swing.png").is_file()
    assert (tmp_path / "packages" / "swing" / "c" / "swing.c").is_file()
    (source,) = blocks("c")
    (tmp_path / "main.c").write_text(source)
    compiling, running = re.findall(r"^\$ (gcc.*|\./.*)$", TEXT, re.MULTILINE)
    subprocess.run([*compiling.split(), *FLAGS], check=True)
    done = subprocess.run([running], capture_output=True, text=True, check=True)
    assert vector(done.stdout) == pytest.approx(vector(printed[1]), abs=2e-8)
    assert np.hypot(*vector(printed[1])) > 0.9


def test_casadi(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(ROOT))
    _, optimiser = blocks("python")
    names: dict[str, object] = {}
    exec(optimiser, names)
    x, y = (np.array(names[name]).ravel() for name in ("x_next", "y"))
    assert np.isfinite([*x, *y]).all()
    assert y[0] == pytest.approx(1.0, abs=1e-3)  # the arm of 1 m has hardly begun to turn


def test_figures_are_those_measured() -> None:
    """Figures that depend on the code are compared with what measured them; the demonstration's is one run's."""
    board = json.loads((ROOT / "benchmarks" / "embedded.json").read_text())["arm10 float32 free cortex-m4f"]
    figures = (board[f"{name}"] for name in ("instructions_per_step", "code_bytes", "ram_bytes"))
    assert "{} instructions, {} bytes of code, {} bytes of memory".format(*figures) in TEXT
    (link,) = set(re.findall(r"(\d+) operations a step", TEXT))
    header = (ROOT / "generated" / "elbow" / "c" / "elbow.h").read_text()
    (counted,) = re.findall(r"operations of a step: \d+, ([\d.]+) per station", header)
    assert float(link) == round(float(counted))
    speed = (ROOT / "docs" / "mpc-speed.md").read_text()
    own, other = (
        float(re.search(rf"^\| 5 \| {re.escape(name)} \| ([\d.]+) \|", speed, re.MULTILINE)[1])  # type: ignore[index]
        for name in ("full RTI, C", "CasADi sqpmethod + hpipm, C")
    )
    assert f"{own:.0f} µs for a torque, {other / own:.0f} times faster" in TEXT
    tried = (ROOT / "docs" / "reliability.md").read_text()
    arms = re.findall(
        r"^\| (?:planar arms: 1 to 50 links|arms in space: a beam).*?\| (\d+) \| (.*?) \|",
        tried,
        re.MULTILINE,
    )
    assert len(arms) == 2
    assert f"{sum(int(count) for count, _ in arms)} arms at the extremes" in TEXT
    assert all(" 0 wrong" in result for _, result in arms)

"""The page on many arms at once: what it prints is what comes out."""

from __future__ import annotations

import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tmm_gen.cli import main

pytestmark = pytest.mark.compiler

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs" / "batch.md").read_text()
SNIPPETS = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)
SESSION = re.findall(r"^\$ (.*)$\n((?:[^$`].*\n)*)", PAGE, re.MULTILINE)


def test_commands(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    shutil.copytree(ROOT / "examples" / "batch", tmp_path / "examples" / "batch")
    monkeypatch.chdir(tmp_path)
    (build, _), (compiler, _), (program, printed) = SESSION
    assert main(shlex.split(build)[1:]) == 0
    subprocess.run(shlex.split(compiler), check=True)
    done = subprocess.run([program], capture_output=True, text=True, check=True)
    assert done.stdout == printed


def test_the_package(tmp_path: Path) -> None:
    scene = str(ROOT / "examples" / "batch" / "scatter.toml")
    assert main(["build", scene, "--out", str(tmp_path)]) == 0
    command = [sys.executable, "-c", SNIPPETS[0]]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True)
    found = re.fullmatch(r"10000 arms, 0 refused: y (\S+) m, scatter (\S+) mm\n", done.stdout)
    told = re.search(r"^y (\S+) m, scatter \S+ mm$", PAGE, re.MULTILINE)
    assert found
    assert told
    assert float(found[1]) == pytest.approx(float(told[1]), abs=5e-4)  # other arms, as likely
    assert 2.0 < float(found[2]) < 4.5


def test_gpu(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    if not os.environ.get("CI"):
        pytest.importorskip("nvidia.cuda_nvrtc")
    monkeypatch.chdir(ROOT)
    exec(SNIPPETS[2], {})
    registers = re.fullmatch(r"(\d+) registers, 0 bytes spilled\n", capsys.readouterr().out)
    told = re.search(r"(\d+) registers a thread for `thesis10`", PAGE)
    assert registers
    assert told
    assert int(registers[1]) == pytest.approx(int(told[1]), rel=0.25)  # as NVRTC's version has it


def test_python() -> None:
    snippet = SNIPPETS[1]
    done = subprocess.run(
        [sys.executable, "-c", snippet], cwd=ROOT, capture_output=True, text=True, check=True
    )
    first, second = done.stdout.splitlines()
    assert first == "BatchRun(10000 arms, 7 instants, outputs: tool_x, tool_y)"
    told = re.search(r"^y (\S+) m, scatter \S+ mm$", PAGE, re.MULTILINE)
    found = re.fullmatch(r"y (\S+) m, scatter (\S+) mm", second)
    assert told
    assert found
    assert float(found[1]) == pytest.approx(float(told[1]), abs=5e-4)  # other arms, as likely
    assert 2.0 < float(found[2]) < 4.5

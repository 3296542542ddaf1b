"""The page from a URDF to a controller in C: its commands run, and its loop comes to where it says."""

from __future__ import annotations

import re
import shlex
import shutil
import subprocess
from pathlib import Path

import pytest

from tmm_gen.cli import main

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs" / "control-arm.md").read_text()


def blocks(language: str) -> list[str]:
    return re.findall(rf"```{language}\n(.*?)```", PAGE, re.DOTALL)


LATE = 2
"""What the loop in real time says if the machine let it wait for more than a sample."""


NUMBER = re.compile(r"-?\d[\d.]*")


def in_form(output: str) -> list[str]:
    """Return what the loop in real time prints, without numbers and how it is scheduled."""
    lines = (line.partition(", scheduled")[0] for line in output.splitlines())
    return [" ".join(NUMBER.sub("0", line).split()) for line in lines]


def tips(output: str) -> list[float]:
    """Return the angles of tips that it prints."""
    return [float(angle) for angle in re.findall(r"^tip of .*: (\S+) rad", output, re.MULTILINE)]


@pytest.mark.compiler
def test_from_a_urdf_to_a_loop_in_c(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    shutil.copytree(ROOT / "examples" / "urdf", tmp_path / "examples" / "urdf")
    monkeypatch.chdir(tmp_path)
    flexibility, control = blocks("toml")
    (program,) = blocks("c")
    Path("soft.flex.toml").write_text(flexibility)
    Path("loop.c").write_text(program)
    lines = [line for block in blocks("console") for line in block.splitlines()]
    for line in lines:
        command = line.removeprefix("$ ")
        if command.startswith("tmm-gen"):
            assert main(shlex.split(command)[1:]) == 0
        elif command == "./real_time":
            real_time = subprocess.run(command, capture_output=True, text=True, check=False)
            # how late it wakes is the machine's; the arm arrives
            assert real_time.returncode in (0, LATE), real_time.stdout
            (shown,) = blocks("text")
            assert in_form(real_time.stdout) == in_form(shown)
            assert tips(real_time.stdout) == pytest.approx(tips(shown), abs=2e-4)
        elif line != command:
            done = subprocess.run(command, shell=True, capture_output=True, text=True, check=False)
            assert (done.returncode, done.stderr) == (0, "")
        else:
            assert done.stdout == f"{line}\n"
        if "import" in command:
            with Path("picker.toml").open("a") as scene:
                scene.write(f"\n{control}")
    sources = [path for path in Path("controller").rglob("*.c") if "daqp" not in path.parts]
    assert len(sources) == 6
    assert not any(re.search(r"\b[mc]alloc\b", path.read_text()) for path in sources)

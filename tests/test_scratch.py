"""Scratch is made exclusively, and what killed runs left is removed by the next one."""

from __future__ import annotations

import errno
import os
import random
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tmm_gen.errors import UserError
from tmm_gen.files import write_whole
from tmm_gen.scratch import new_file, scratch_folder, scratch_name, sweep

SCENE = Path(__file__).resolve().parents[1] / "scenes" / "thesis2.toml"


def _dead_name() -> str:
    """Return the name of scratch of a process that has ended."""
    with subprocess.Popen([sys.executable, "-c", ""]) as process:
        process.wait()
    return scratch_name().replace(f"-{os.getpid()}-", f"-{process.pid}-")


def test_scratch_of_the_living_stays_and_of_the_dead_goes(tmp_path: Path) -> None:
    dead = _dead_name()
    (tmp_path / dead).mkdir()
    (tmp_path / dead / "kernel.c").write_text("left")
    (tmp_path / scratch_name()).write_text("in use")
    (tmp_path / ".tmm-gen-notes.tmp").write_text("the user's")
    sweep(tmp_path)
    assert not (tmp_path / dead).exists()
    assert len(list(tmp_path.iterdir())) == 2


@pytest.mark.parametrize("elsewhere", [False, True])
def test_a_full_disk_is_named_with_what_helps(tmp_path: Path, *, elsewhere: bool) -> None:
    full = OSError(errno.ENOSPC, "No space left on device", *(["/a/b"] if elsewhere else []))
    with pytest.raises(OSError if elsewhere else UserError) as caught, scratch_folder(tmp_path):
        raise full
    if not elsewhere:
        assert str(caught.value).startswith(
            f"{tmp_path}: No space left on device, and scratch is written there."
        )
    assert not list(tmp_path.iterdir())


def test_writing_removes_what_killed_runs_left(tmp_path: Path) -> None:
    (tmp_path / _dead_name()).write_text("half")
    write_whole(tmp_path / "a.csv", "whole")
    assert [path.name for path in tmp_path.iterdir()] == ["a.csv"]


def test_names_cannot_be_foreseen_nor_taken(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert len({scratch_name() for _ in range(1000)}) == 1000
    monkeypatch.setattr("tmm_gen.scratch.scratch_name", lambda: "taken")
    (tmp_path / "victim").write_text("precious")
    (tmp_path / "taken").symlink_to("victim")
    with pytest.raises(FileExistsError):
        new_file(tmp_path)
    assert (tmp_path / "victim").read_text() == "precious"


def test_a_scratch_folder_goes_with_its_block(tmp_path: Path) -> None:
    with scratch_folder(tmp_path) as folder:
        assert folder.stat().st_mode & 0o77 == 0
        (folder / "x").write_text("x")
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("number", "code", "said"),
    [
        (signal.SIGINT, 130, "error: interrupted\n"),
        (signal.SIGTERM, 143, "error: told to end\n"),
        (signal.SIGKILL, -9, ""),
    ],
    ids=str,
)
def test_a_run_that_is_ended_leaves_nothing_half_written(
    number: int, code: int, said: str, tmp_path: Path
) -> None:
    words = ["run", str(SCENE), "--until", "100000", "--input", "tip_torque=1", "--csv", "out.csv"]
    # tests that run in the background of a script inherit that interrupts are ignored
    started = [
        sys.executable,
        "-c",
        "import signal, sys; signal.signal(signal.SIGINT, signal.default_int_handler); "
        "from tmm_gen.cli import main; print('on', flush=True); sys.exit(main())",
    ]
    (tmp_path / "out.csv").write_text("")
    with subprocess.Popen(
        [*started, *words], cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as process:
        assert process.stdout is not None
        process.stdout.readline()
        time.sleep(random.Random(number).uniform(0.3, 0.6))
        process.send_signal(number)
        _, err = process.communicate(timeout=120)
    assert (process.returncode, err) == (code, said)
    assert (tmp_path / "out.csv").read_text() == ""

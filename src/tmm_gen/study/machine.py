"""On what machine times were measured."""

from __future__ import annotations

import os
import platform
import subprocess
from contextlib import suppress
from pathlib import Path


def machine() -> str:
    """Return processor, number of its cores and compiler, in one line."""
    return f"{_processor()}, {os.cpu_count() or 1} cores, {_compiler()}"


def _processor() -> str:
    with suppress(OSError):
        for line in Path("/proc/cpuinfo").read_text(encoding="utf-8", errors="replace").splitlines():
            if line.startswith("model name"):
                return line.partition(":")[2].strip()
    return platform.processor() or platform.machine()


def _compiler() -> str:
    with suppress(OSError):
        done = subprocess.run(["gcc", "--version"], capture_output=True, text=True, check=False)
        if done.returncode == 0:
            return done.stdout.splitlines()[0].strip()
    return "no gcc"

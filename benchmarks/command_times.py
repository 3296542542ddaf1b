"""What each command takes: cold, with an empty cache and nothing compiled, and warm, the same once more.

Every command runs in a process of its own, in a new folder; `build` the second time in the same one. CPU time is its
own and that of what it calls, compilers and browsers too; it changes little where others work on the machine, wall time
does. ``--update`` writes the table into docs/performance.md.
"""

from __future__ import annotations

import argparse
import csv
import os
import shlex
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

from support.marks import renewed

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "performance.md"

COMMANDS = (
    "new crane --kind planar",
    "import examples/urdf/picker.urdf --flex examples/urdf/picker.flex.toml --out picker.toml",
    "keys beam",
    "schema",
    "explain scenes/arm10.toml",
    "build scenes/arm10.toml --out packages",
    "check scenes/arm10.toml",
    "run scenes/arm10.toml --until 2 --input hub_torque=4",
    "run scenes/arm10.toml --until 2 --input hub_torque=4 --plot",
    "run scenes/arm10.toml --until 2 --input hub_torque=4 --animate arm10.html",
    "run examples/space/arm6.toml --until 0.2",
    "rest scenes/elbow.toml --input shoulder_torque=0.02",
    "modes scenes/arm10.toml",
    "modes scenes/arm10.toml --plot",
    "frequency scenes/arm10.toml --from hub_torque --to tip",
    "integrators",
    "stability scenes/thesis10.toml",
    "trade scenes/thesis10.toml --integrators newmark,sdirk4",
    "tune scenes/thesis10.toml --integrators newmark,sdirk4 --max-error 1e-4 --max-time 1ms",
    "export scenes/arm10.toml --to mjcf --out arm10.xml",
    "export scenes/arm10.toml --to fmu --out arm10.fmu",
    "mpc scenes/swing.toml --controller lqr --controller mpc-modes --condition nominal",
    "mpc scenes/elbow.toml --controller rti-zero --emit controller",
    "playground scenes/arm10.toml --out arm10.html",
    "errata",
)
"""Of each command one or more; `calibrate` takes a record, and `demo` is the README's."""

IMPORTS = 9
"""Runs, of which the least counts."""


@dataclass(frozen=True)
class Spent:
    """Seconds.

    Parameters
    ----------
    cpu, wall : float
        Of all processors together, and by the clock.
    """

    cpu: float
    wall: float


def spent(words: list[str], folder: Path, cache: Path) -> Spent:
    """Run a command.

    Raises
    ------
    RuntimeError
        If it fails.
    """
    environment = {**os.environ, "XDG_CACHE_HOME": str(cache), "MPLCONFIGDIR": str(cache / "matplotlib")}
    begin = time.perf_counter()
    with tempfile.TemporaryFile() as said:
        process = subprocess.Popen(words, cwd=folder, env=environment, stdout=said, stderr=said)
        _, status, usage = os.wait4(process.pid, 0)
        wall = time.perf_counter() - begin
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode:
            said.seek(0)
            raise RuntimeError(f"{shlex.join(words)} ended with {process.returncode}: {said.read().decode()}")
    return Spent(usage.ru_utime + usage.ru_stime, wall)


def measured(command: str) -> tuple[Spent, Spent]:
    """Return what a command takes cold and warm."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "cache").mkdir()
        words = [sys.executable, "-m", "tmm_gen", *shlex.split(command)]
        both = []
        for place in (folder / "cold", folder / ("cold" if command.startswith("build ") else "warm")):
            place.mkdir(exist_ok=True)
            for linked in ("scenes", "examples"):
                if not command.startswith("new ") and not (place / linked).exists():
                    (place / linked).symlink_to(ROOT / linked)
            both.append(spent(words, place, folder / "cache"))
    return both[0], both[1]


def import_time(folder: Path) -> float:
    """Return what ``import tmm_gen`` adds to a Python that imports nothing, s of CPU: the least of several."""

    def least(program: str) -> float:
        words = [sys.executable, "-c", program]
        return min(spent(words, folder, folder).cpu for _ in range(IMPORTS))

    return least("import tmm_gen") - least("pass")


def table(rows: dict[str, tuple[Spent, Spent]], importing: float, load: float) -> str:
    """Write the table of the page."""
    lines = [
        f"`import tmm_gen` takes {importing:.3f} s. Load of the machine when the table was begun, of "
        f"{os.cpu_count()} processors: {load:.1f}.",
        "",
        "| `tmm-gen` ... | cold, CPU (s) | wall (s) | warm, CPU (s) | wall (s) |",
        "|---|---:|---:|---:|---:|",
    ]
    for command, (cold, warm) in rows.items():
        cells = " | ".join(f"{x:.1f}" for x in (cold.cpu, cold.wall, warm.cpu, warm.wall))
        lines.append(f"| `{command}` | {cells} |")
    return "\n".join(lines)


def main() -> None:
    """Measure all commands, print the table and write it as a CSV; with ``--update`` also into the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("out/bench"))
    parser.add_argument("--update", action="store_true", help="write the table into docs/performance.md")
    options = parser.parse_args()
    load = os.getloadavg()[0]
    with tempfile.TemporaryDirectory() as folder:
        importing = import_time(Path(folder))
    rows = {}
    for command in COMMANDS:
        rows[command] = measured(command)
        cold, warm = rows[command]
        print(f"{command}: {cold.cpu:.1f} s cold, {warm.cpu:.1f} s warm", flush=True)
    text = table(rows, importing, load)
    print(text)
    options.out.mkdir(parents=True, exist_ok=True)
    with (options.out / "command_times.csv").open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["command", "cold_cpu_s", "cold_wall_s", "warm_cpu_s", "warm_wall_s"])
        writer.writerows([name, c.cpu, c.wall, w.cpu, w.wall] for name, (c, w) in rows.items())
    if options.update:
        PAGE.write_text(renewed(PAGE.read_text(), text, "command_times.py"))


if __name__ == "__main__":
    main()

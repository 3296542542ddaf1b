"""Every command on every arm of docs/arms.md: does it answer, and where it refuses, in what words?

    python benchmarks/every_command.py [--scene elbow] [--out out/every]

Each command runs in a process of its own, in a new folder, on a copy of the scene; what it prints is kept there. Only
refusals that are listed here, with their words, pass. It takes some 15 minutes of one processor.
"""

from __future__ import annotations

import argparse
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]

LIBRARY_SINES = ("--set", "emit.trigonometry=libm", "--set", "emit.parameters=free")
"""What sensitivities go with."""


@dataclass(frozen=True)
class Case:
    """A scene, and what moves it.

    Parameters
    ----------
    inputs : tuple of str
        As ``--input`` has them.
    until : str
        s.
    near : str
        A joint and an angle near which to look for an equilibrium; empty where none is a joint's to find.
    gentle : tuple of str
        Inputs of ``check`` where 1 of each is too much.
    box : str
        Bounds of the state that ``--prove`` wants besides those of every arm.
    """

    inputs: tuple[str, ...]
    until: str
    near: str = ""
    gentle: tuple[str, ...] = ()
    box: str = ""


CASES = {
    "elbow": Case(
        ("shoulder_torque=smooth:0:0.085:0.3s", "elbow_torque=smooth:0:0.04:0.5s"), "1", "elbow=1.4"
    ),
    "gripper": Case(
        ("left_torque=smooth:0:-0.003:0.1s", "right_torque=smooth:0:0.003:0.1s"),
        "0.4",
        "left=1.4",
        gentle=("left_torque=0.1", "right_torque=0.1"),
    ),
    "geartrain": Case(("motor_torque=smooth:0:2:0.1s",), "0.5"),
    "cube": Case(
        ("wheel=sine:2:0.4", "thruster=smooth:0:4:0.3s"),
        "2.5",
        "left_latch=0.1",
        box="base_places = [-1.0, 1.0]\nbase_velocities = [-1.0, 1.0]\nbase_accelerations = [-10.0, 10.0]\n",
    ),
}

REFUSED = {("geartrain", "rest"): "a chain has no weight"}
"""By scene and command, with words of the error."""


def inputs_of(words: tuple[str, ...]) -> list[str]:
    """Return inputs as options."""
    return [option for word in words for option in ("--input", word)]


def commands(name: str, case: Case) -> dict[str, list[str]]:
    """Return what is run on a scene, by what it shows."""
    scene, boxed, moved = f"{name}.toml", f"{name}_box.toml", inputs_of(case.inputs)
    gentle = inputs_of(case.gentle)
    near = ["--near", case.near] if case.near else []
    lengths = ["--until", case.until]
    return {
        "build": ["build", scene, "--out", "packages"],
        "check": ["check", scene],
        "check in float32": ["check", scene, "--real", "float32"],
        "check compensated": ["check", scene, "--real", "float32", "--compensated", *gentle],
        "check with sensitivities": ["check", scene, "--set", "emit.sensitivities=true", *LIBRARY_SINES],
        "check on a Cortex-M4F": ["check", scene, "--target", "cortex-m4f", "--real", "float32"],
        "check on a Cortex-M7": ["check", scene, "--target", "cortex-m7"],
        "proof": ["check", boxed, "--prove"],
        "run": ["run", scene, *moved, *lengths, "--plot", "--csv", "record.csv", "--with-inputs"],
        "explain": ["explain", scene],
        "rest": ["rest", scene, *near],
        "modes": ["modes", scene, "--plot"],
        **({"modes about a chosen equilibrium": ["modes", scene, *near]} if near else {}),
        "frequency": ["frequency", scene, "--plot"],
        "stability": ["stability", scene],
        "trade": ["trade", scene, "--integrators", "newmark,sdirk4", "--steps", "4e-3,2e-3,1e-3"],
        "tune": ["tune", scene, "--integrators", "newmark,sdirk4", "--max-error", "1%", "--max-time", "50ms"],
        "export to MuJoCo": ["export", scene, "--to", "mjcf", "--out", f"{name}.xml"],
        "export to FMI": ["export", scene, "--to", "fmu", "--out", f"{name}.fmu"],
        "calibrate": ["calibrate", scene, "record.csv", "--fit", "stiffness"],
    }


def boxed(text: str, case: Case, names: list[str]) -> str:
    """Return a scene with bounds of state and inputs, within which it is proved."""
    bounds = "".join(f"{name} = [-0.01, 0.01]\n" for name in names)
    state = "angles = [-0.5, 0.5]\nrates = [-1.0, 1.0]\naccelerations = [-10.0, 10.0]\n"
    return f"{text}\n[emit.box]\n{state}{case.box}{bounds}"


def ran(name: str, shows: str, words: list[str], folder: Path) -> bool:
    """Run a command, print a line on it, and return whether it did what it should."""
    since = time.monotonic()
    done = subprocess.run(
        [sys.executable, "-m", "tmm_gen", *words],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
    )
    said = done.stdout + done.stderr
    (folder / f"{shows.replace(' ', '-')}.txt").write_text(said)
    refusal = REFUSED.get((name, shows))
    right = done.returncode == 0 if refusal is None else done.returncode == 2 and refusal in said
    last = (said.strip().splitlines() or [""])[-1]
    word = ("right" if refusal is None else "refused") if right else "WRONG"
    print(f"{name:10} {shows:34} {word:8} {time.monotonic() - since:5.1f} s  {last[:100]}", flush=True)
    return right


def main() -> int:
    """Run all on each scene."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--scene", choices=CASES, action="append", help="only this one; repeatable")
    parser.add_argument("--out", type=Path, help="where to keep what is written; by default nowhere")
    options = parser.parse_args()
    wrong = 0
    with tempfile.TemporaryDirectory() as scratch:
        for name in options.scene or CASES:
            case, folder = CASES[name], (options.out or Path(scratch)).resolve() / name
            folder.mkdir(parents=True, exist_ok=True)
            text = (ROOT / "scenes" / f"{name}.toml").read_text()
            (folder / f"{name}.toml").write_text(text)
            inputs = [part.split('"')[1] for part in text.split("[[input]]")[1:]]
            (folder / f"{name}_box.toml").write_text(boxed(text, case, inputs))
            for shows, words in commands(name, case).items():
                wrong += not ran(name, shows, words, folder)
    print(f"{wrong} wrong" if wrong else "all right")
    return 1 if wrong else 0


if __name__ == "__main__":
    raise SystemExit(main())

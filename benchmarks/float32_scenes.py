"""Single precision in each committed scene: over 60 s, and over a million steps, plain and compensated.

    python benchmarks/float32_scenes.py --out out/bench
    python benchmarks/float32_scenes.py --figure docs/figures

The C kernel in `float` beside the same kernel in `double`, both at the scene's step and under a load that keeps it
moving; two scenes once more, turning one way and on. Then the same with `[emit] compensated = true`. Errors are
relative to the largest value of the output. `growth` is the exponent of time with which the RMS error grows over the
second run: 0 stays, 0.5 is a random walk, 1 a drift, negative dies out.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from itertools import cycle
from pathlib import Path

import numpy as np
from support.float32_error import SingleError, single_precision

from tmm_gen.cli.console import Column, progress, table
from tmm_gen.csv_text import csv_text
from tmm_gen.files import write_whole
from tmm_gen.scene import load_scene
from tmm_gen.style import FAINT, PALETTE, figure, picture, style

SCENES = Path(__file__).resolve().parents[1] / "scenes"
DURATION = 60.0
LEAST = 1e-9
"""Of the figure: what has died out is drawn there."""
MANY = 1_000_000

Loads = dict[str, Callable[[np.ndarray], np.ndarray]]

LOADS: dict[str, tuple[str, Loads]] = {
    "thesis2": ("two tones on 1 N m", {"tip_torque": lambda t: 1.0 + np.sin(0.7 * t) + np.sin(1.9 * t)}),
    "thesis10": ("two tones on 1 N m", {"tip_torque": lambda t: 1.0 + np.sin(0.3 * t) + np.sin(0.7 * t)}),
    "hundred": ("1 N m at 2 rad/s", {"tip_torque": lambda t: np.sin(2.0 * t)}),
    "drivetrain": (
        "turning back and forth at 1 Hz",
        {
            "motor_torque": lambda t: 5.0 * np.cos(2.0 * np.pi * t),
            "load_torque": lambda t: 0.5 * np.cos(6.0 * np.pi * t),
        },
    ),
    "arm2": ("released, then 0.5 N m at 2 rad/s", {"hub_torque": lambda t: 0.5 * np.sin(2.0 * t)}),
    "arm10": ("released, then 0.3 N m at 2 rad/s", {"hub_torque": lambda t: 0.3 * np.sin(2.0 * t)}),
    "arm50": ("base swung by 1 rad at 0.5 Hz", {"base_angle": lambda t: 0.5 * (1.0 - np.cos(np.pi * t))}),
    "fall10": ("released", {}),
    "swing": ("turning back and forth at 1 Hz", {"hub_torque": lambda t: np.cos(2.0 * np.pi * t)}),
    "elbow": (
        "released, then 0.02 and 0.01 N m at 9 and 13 rad/s",
        {
            "shoulder_torque": lambda t: 0.02 * np.sin(9.0 * t),
            "elbow_torque": lambda t: 0.01 * np.sin(13.0 * t),
        },
    ),
    "cube": (
        "turned and pushed back and forth at 0.5 and 0.3 Hz",
        {
            "wheel": lambda t: 0.5 * np.cos(np.pi * t),
            "thruster": lambda t: 2.0 * np.cos(0.6 * np.pi * t),
        },
    ),
    "geartrain": (
        "turning back and forth at 1 Hz",
        {
            "motor_torque": lambda t: 2.0 * np.cos(2.0 * np.pi * t),
            "load_torque": lambda t: 3.0 * np.cos(6.0 * np.pi * t),
            "feeder_torque": lambda t: 0.2 * np.cos(4.0 * np.pi * t),
        },
    ),
    "gripper": (
        "released, then 0.002 N m at 3 and 4 rad/s",
        {
            "left_torque": lambda t: 0.002 * np.sin(3.0 * t),
            "right_torque": lambda t: 0.002 * np.sin(4.0 * t),
        },
    ),
}


ONWARD: dict[str, tuple[str, Loads]] = {
    "drivetrain": (
        "spun up, on and on",
        {
            "motor_torque": lambda t: 5.0 * np.sin(2.0 * np.pi * t),
            "load_torque": lambda t: np.full_like(t, -0.5),
        },
    ),
    "swing": ("turned one way", {"hub_torque": lambda t: np.sin(2.0 * np.pi * t)}),
}
"""Nothing holds these where they are."""
SHOWN = {"spun up, on and on": "shaft_torque", "turned one way": "hub"}
"""Outputs of the figure, by load; others show the first."""
CASES = [(name, LOADS[name]) for name in LOADS] + [(name, ONWARD[name]) for name in ONWARD]
COMPENSATED = {"emit.real": "float32", "emit.compensated": True, "emit.trigonometry": "own"}


def measure(
    name: str, load: str, signals: Loads, compensated: bool
) -> tuple[list[dict[str, object]], SingleError]:
    """Return a row for each output, and the error over the long run of the output that the figure shows."""
    scene = load_scene(SCENES / f"{name}.toml")
    if compensated:
        scene = scene.replace(**{**COMPENSATED, **({"emit.box": None} if scene.emit.box else {})})
    minute = single_precision(scene, signals, round(DURATION / scene.integrator.step))
    long = single_precision(scene, signals, MANY)
    rows: list[dict[str, object]] = [
        {
            "scene": name,
            "load": load,
            "compensated": compensated,
            "output": short.output,
            "peak": short.peak,
            "error_60s": short.largest,
            "rms_60s": float(np.sqrt(np.mean(short.windows**2))),
            "error_million_steps": far.largest,
            "rms_second_tenth": float(np.sqrt(np.mean(far.windows[2:4] ** 2))),
            "rms_last_tenth": float(np.sqrt(np.mean(far.windows[-2:] ** 2))),
            "growth": far.growth,
        }
        for short, far in zip(minute, long, strict=True)
    ]
    shown = SHOWN.get(load, long[0].output)
    return rows, next(error for error in long if error.output == shown)


def draw(found: dict[bool, dict[tuple[str, str], SingleError]]) -> bytes:
    """Show the error of one output of each case over the steps taken, plain beside compensated."""
    colours = dict(zip(LOADS, cycle((*PALETTE, FAINT)), strict=False))
    with style():
        made, axes = figure(10.0, 4.6, nrows=1, ncols=2, sharey=True)
        for axis, (compensated, errors) in zip(axes, found.items(), strict=True):
            for (name, load), error in errors.items():
                onward = name in ONWARD and load == ONWARD[name][0]
                steps = MANY * (np.arange(len(error.windows)) + 0.5) / len(error.windows)
                axis.loglog(
                    steps,
                    np.maximum(error.windows, LEAST),
                    color=colours[name],
                    linestyle="--" if onward else "-",
                    marker="o",
                    markersize=3,
                    label=None if compensated else f"{name}, {load}" if onward else name,
                )
            axis.set_title("compensated = true" if compensated else "plain")
            axis.set_xlabel("steps taken")
        axes[0].set_ylabel("RMS difference to double precision, over the peak")
        made.legend(loc="outside right center")
        return picture(made, "png")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--out", type=Path, default=Path("out/bench"))
    parser.add_argument("--figure", type=Path, help="folder of float32.png; by default that of the table")
    options = parser.parse_args()
    rows: list[dict[str, object]] = []
    found: dict[bool, dict[tuple[str, str], SingleError]] = {False: {}, True: {}}
    with progress("simulating", total=2 * len(CASES)) as advance:
        for compensated, errors in found.items():
            for name, (load, signals) in CASES:
                advance(0, doing=f"{name}, compensated" if compensated else name)
                more, errors[name, load] = measure(name, load, signals, compensated)
                rows += more
                advance()
    columns: list[Column | str] = [
        "scene",
        "load",
        "compensated",
        "output",
        Column("error_60s", "60 s", ".1e"),
        Column("error_million_steps", "10^6 steps", ".1e"),
        Column("rms_second_tenth", "RMS, 2nd tenth", ".1e"),
        Column("rms_last_tenth", "RMS, last tenth", ".1e"),
        Column("growth", "growth", "+.2f"),
    ]
    table(rows, columns, title="float beside double, C, relative to the peak")
    written = {options.out / "float32_scenes.csv": csv_text(rows)}
    for path, text in written.items():
        write_whole(path, text)
    target = (options.figure or options.out) / "float32.png"
    write_whole(target, draw(found))
    print(f"wrote {options.out / 'float32_scenes.csv'}, {target}")


if __name__ == "__main__":
    main()

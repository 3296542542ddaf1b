"""Single precision where nothing pulls an error back: undamped, over the top, turning on and on.

    python benchmarks/float32_free.py --out out/bench

Without damping the energy tells: its mean over a tenth of a million steps, relative to what swings at first. An arm
that goes over the top forgets where it came from: until when do single and double precision tell the same story?
A drive that turns on and on loses the twists of its shafts in ever larger angles, unless somebody takes the turns out.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from tmm_gen.cli.console import Column, progress, table
from tmm_gen.csv_text import csv_text
from tmm_gen.files import write_whole
from tmm_gen.native import NativeKernel, compile_kernel
from tmm_gen.native.series import Series
from tmm_gen.program.build import build_program
from tmm_gen.scene import Scene, load_scene

SCENES = Path(__file__).resolve().parents[1] / "scenes"
MANY = 1_000_000
REALS = ("float64", "float32")
ENERGIES = ("kinetic_energy", "elastic_energy", "gravitational_energy")
APART = 0.01
TURNING_STEPS = 100_000


def kernels(scene: Scene) -> Iterator[tuple[str, NativeKernel]]:
    program = build_program(scene)
    for real in REALS:
        yield real, compile_kernel(program, scene.replace(**{"emit.real": real}))


def planar(name: str, **changes: object) -> Scene:
    outputs = [{"name": energy, "at": "arm", "of": energy} for energy in ENERGIES]
    return load_scene(SCENES / f"{name}.toml").replace(
        output=[*outputs, {"name": "tip", "at": "tip", "of": "position"}], **changes
    )


def undamped_fall() -> list[dict[str, object]]:
    """Fall10 without damping: energy, and how far the tips come apart."""
    scene = planar("fall10", **{"beam.damping_time": 0.0})
    step = scene.integrator.step
    found = {real: Series(kernel, {}, MANY, step).run() for real, kernel in kernels(scene)}
    apart = np.hypot(*(found["float32"][axis] - found["float64"][axis] for axis in ("tip_x", "tip_y")))
    rows = []
    for real in REALS:
        energy = np.sum([found[real][name] for name in ENERGIES], axis=0)
        swing = float(np.max(found["float64"]["elastic_energy"]))
        rows.append(row("fall10, undamped", real, "energy", energy - energy[0], swing))
    return [*rows, row("fall10, undamped", "float32", "tip apart (m)", apart, 1.0)]


def undamped_chain() -> list[dict[str, object]]:
    """Thesis10 without damping, let go bent: Newmark 1/4 keeps its energy to rounding."""
    stations = range(1, 11)
    scene = load_scene(SCENES / "thesis10.toml").replace(
        **{"joint.1.damping": 0.0},
        initial={"angles": [0.05 * k for k in stations]},
        output=[{"name": f"{of}{k}", "at": k, "of": of} for of in ("angle", "velocity") for k in stations],
    )
    stiffness, inertia = scene.joints[0].stiffness, scene.links[0].inertia
    rows = []
    for real, kernel in kernels(scene):
        found = Series(kernel, {}, MANY, scene.integrator.step).run()
        angles, rates = (np.array([found[f"{of}{k}"] for k in stations]) for of in ("angle", "velocity"))
        twists = np.diff(angles, axis=0, prepend=0.0)
        energy = 0.5 * (stiffness * np.sum(twists**2, axis=0) + inertia * np.sum(rates**2, axis=0))
        rows.append(row("thesis10, undamped", real, "energy", energy - energy[0], float(energy[0])))
    return rows


def free_hub() -> list[dict[str, object]]:
    """Swing, its hub turned one way by an oscillating torque: nothing holds it where it is."""
    scene = load_scene(SCENES / "swing.toml")
    signals = {"hub_torque": lambda t: np.sin(2.0 * np.pi * t)}
    found = {
        real: Series(kernel, signals, MANY, scene.integrator.step).run() for real, kernel in kernels(scene)
    }
    return [
        row(
            "swing, turned one way",
            "float32",
            "hub (rad)",
            found["float32"]["hub"] - found["float64"]["hub"],
            1.0,
        )
    ]


def over_the_top() -> list[dict[str, object]]:
    """Arm2 with a limp elbow and no damping, a double pendulum: when the two precisions part."""
    limp = {"stiffness": 1e-3}
    scene = planar("arm2", joint=[{"stiffness": 1e-3}, limp], **{"base.damping": 0.0, "initial.angles": 1.5})
    step = scene.integrator.step
    found = {real: Series(kernel, {}, MANY // 10, step).run() for real, kernel in kernels(scene)}
    apart = np.hypot(*(found["float32"][axis] - found["float64"][axis] for axis in ("tip_x", "tip_y")))
    parted = float(step * np.argmax(apart > APART)) if np.max(apart) > APART else float("nan")
    rows: list[dict[str, object]] = [
        {
            "case": "double pendulum",
            "real": "float32",
            "what": f"tip {APART:g} m apart after (s)",
            "value": parted,
        }
    ]
    for real in REALS:
        energy = np.sum([found[real][name] for name in ENERGIES], axis=0)
        swing = float(np.max(found["float64"]["kinetic_energy"]))
        rows.append(row("double pendulum", real, "energy", energy - energy[0], swing))
        mean = float(np.mean(found[real]["kinetic_energy"]) / swing)
        rows.append({"case": "double pendulum", "real": real, "what": "mean kinetic energy", "value": mean})
    return rows


def turning() -> list[dict[str, object]]:
    """The drive spun up for 10 s, with and without the hub's angle taken out of all angles now and then."""
    scene = load_scene(SCENES / "drivetrain.toml")
    compiled = dict(kernels(scene))
    exact = spun(compiled["float64"], 0)
    rows: list[dict[str, object]] = []
    for every in (0, 100, 1):
        found = spun(compiled["float32"], every)
        for column, name in enumerate(("shaft_torque", "motor_speed")):
            error = np.max(np.abs(found - exact)[:, column]) / np.max(np.abs(exact[:, column]))
            how = f"turns taken out every {every} steps" if every else "as it is"
            rows.append(
                {
                    "case": f"drivetrain, spinning, {how}",
                    "real": "float32",
                    "what": name,
                    "value": float(error),
                }
            )
    return rows


def spun(kernel: NativeKernel, every: int) -> np.ndarray:
    """Return shaft torque and motor speed while the drive gathers speed."""
    step, outputs = 1e-4, np.empty((TURNING_STEPS, 2))
    kernel.prepare(step=step)
    kernel.initialise({"load_torque": -0.5})
    for k in range(TURNING_STEPS):
        time = (k + 1) * step
        kernel.step({"motor_torque": 5.0 * np.sin(2.0 * np.pi * time), "load_torque": -0.5})
        found = kernel.output()
        outputs[k] = found["shaft_torque"], found["motor_speed"]
        if every and (k + 1) % every == 0:
            state = kernel.state
            # exact: the angles are close to each other, so their difference is a number of the type
            kernel.state = {"hub_angle": 0.0, "angle": state["angle"] - state["hub_angle"]}
    return outputs


def row(case: str, real: str, what: str, values: np.ndarray, scale: float) -> dict[str, object]:
    """Return the mean of the last tenth and the largest value, over a scale."""
    tenth = values[-len(values) // 10 :]
    return {
        "case": case,
        "real": real,
        "what": what,
        "value": float(np.mean(tenth) / scale),
        "largest": float(np.max(np.abs(values)) / scale),
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--out", type=Path, default=Path("out/bench"))
    out = parser.parse_args().out
    rows: list[dict[str, object]] = []
    cases = (undamped_chain, undamped_fall, free_hub, over_the_top, turning)
    with progress("simulating", total=len(cases)) as advance:
        for case in cases:
            advance(0, doing=case.__name__)
            rows += case()
            advance()
    rows = [{"largest": None} | each for each in rows]
    columns: list[Column | str] = [
        "case",
        "real",
        "what",
        Column("value", form="+.2g"),
        Column("largest", form=".2g"),
    ]
    table(rows, columns, title=f"free running, {MANY} steps; value: mean over the last tenth")
    write_whole(out / "float32_free.csv", csv_text(rows))
    print(f"wrote {out / 'float32_free.csv'}")


if __name__ == "__main__":
    main()

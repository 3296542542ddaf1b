"""One step of arms in space beside articulated-body code from CasADi and beside Pinocchio, in one run.

    pip install --target out/pin pin cmeel-eigen
    python benchmarks/space_speed.py --pinocchio out/pin/cmeel.prefix --update

All take a step of Newmark (1/4, 1/2) and read no outputs. tmm-gen's has one articulated sweep and one correction, and
once the sweep alone, in C with `favour = "speed"` and own sines; the default, small code for controllers with the
sines of the C library, stands beside it. The peers' has one pass of their recursion about the motion predicted with the
last acceleration, springs and dampers implicit as armatures. CasADi's code has the arm's numbers in it and checks
nothing; tmm-gen's reads them from its model and checks inputs, pivots and the new state. Everyone: one thread, gcc -O3
-march=native, thread time, by turns; ratios within a round, then their median. Before that each peer's accelerations at
the start must be those of the reference. Without Pinocchio, or g++, its rows are left out. `--update` writes the table
into docs/space.md.
"""

from __future__ import annotations

import argparse
import shutil
import statistics
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from peers.joint_arm import FLAGS
from peers.pinocchio import HOW_TO_GET, has_headers, installed
from peers.tree import ArticulatedTree, Peer, PinocchioTree, compiled, driven
from support.marks import renewed

from tmm_gen.cli.console import Column, progress, table
from tmm_gen.csv_text import csv_text
from tmm_gen.derive.integrators.registry import integrator
from tmm_gen.files import write_whole
from tmm_gen.inputs.signals import Constant
from tmm_gen.native import compile_kernel
from tmm_gen.program.space.assemble import SpaceChoices, build_in_space
from tmm_gen.reference.spatial_arm import WorldArm
from tmm_gen.reference.spatial_motion import motion
from tmm_gen.scene import Scene, load_scene
from tmm_gen.scene.spatial.arm import SpatialArm

Array = NDArray[np.float64]

PAGE = Path(__file__).resolve().parents[1] / "docs" / "space.md"
SCENES = Path(__file__).resolve().parents[1] / "examples" / "space"
TORQUES: Mapping[str, Mapping[str, float]] = {
    "yaw3": {"yaw_torque": 0.05, "shoulder_torque": -0.1, "elbow_torque": -0.05},
    "arm6": {"shoulder_torque": -0.1, "elbow_torque": -0.1},
}
ROUNDS = 31
STEPS_A_ROUND = 2000
UNTIL = 0.2
"""When errors are taken, s."""
AGREEMENT = 1e-8
"""Of accelerations at the start with the reference's, relative to the largest; its dense mass matrix of many cells has
lost digits."""


@dataclass(frozen=True, eq=False)
class Contender:
    """Somebody's step.

    Parameters
    ----------
    time : callable
        Measures it once, ns.
    angles : array, (n,)
        Of the joints at `UNTIL`, rad.
    """

    time: Callable[[], float]
    angles: Array


def arms() -> dict[str, tuple[str, Scene]]:
    """Return the arms by their titles, with the names of their torques."""
    yaw3 = load_scene(SCENES / "yaw3.toml")
    long = yaw3.replace(**{"beam.upper.links": 20, "beam.forearm.links": 20})
    return {
        "yaw3, 2 x 5 cells": ("yaw3", yaw3),
        "yaw3, 2 x 20 cells": ("yaw3", long),
        "arm6": ("arm6", load_scene(SCENES / "arm6.toml")),
    }


FAST = {"emit.favour": "speed", "emit.trigonometry": "own"}


def ours(arm: SpatialArm, scene: Scene, torques: Mapping[str, float], sweeps: int) -> Contender:
    """Return the step that tmm-gen emits for a scene."""
    step = scene.integrator.step
    choices = SpaceChoices(step, iterations=sweeps, held=sweeps == 1)
    program = build_in_space(arm, scene.name, scene.title, integrator("newmark"), choices)
    kernel = compile_kernel(program, scene, flags=FLAGS)
    _, outputs = kernel.simulate(UNTIL, torques)
    return Contender(kernel.timer(torques), np.array([outputs[o.name][-1] for o in arm.outputs]))


def theirs(peer: Peer, arm: SpatialArm, torques: Mapping[str, float], step: float) -> Contender:
    """Return a peer's step.

    Raises
    ------
    AssertionError
        If it is another arm: its accelerations differ at the start.
    """
    q, v = (np.array([getattr(joint, name) for joint in arm.joints]) for name in ("angle", "rate"))
    start = peer.started(q, v)
    true = WorldArm(arm).forward_dynamics(q, v, torques)
    if np.abs(start[2 * peer.joints :] - true).max() > AGREEMENT * np.abs(true).max():
        raise AssertionError(f"{type(peer).__name__} has another arm: its accelerations differ")
    there, _ = peer.advance(start, round(UNTIL / step))
    return Contender(
        lambda: 1e9 / STEPS_A_ROUND * peer.advance(start, STEPS_A_ROUND)[1], there[: peer.joints]
    )


def contenders(
    name: str, scene: Scene, pinocchio: Path | None, folder: Path
) -> tuple[dict[str, Contender], Array]:
    """Return everyone, the first of whom others are compared with, and the true angles at `UNTIL`."""
    assert scene.spatial is not None
    arm, step = driven(scene.spatial), scene.integrator.step
    torques = {item.name: TORQUES[name].get(item.name, 0.0) for item in arm.inputs}
    acting = np.zeros(len(arm.joints))
    for item in arm.inputs:
        acting[item.joint - 1] += arm.joints[item.joint - 1].gear * torques[item.name]
    fast = scene.replace(**FAST)
    found = {
        "tmm-gen, sweep and correction": ours(arm, fast, torques, 2),
        "tmm-gen, sweep alone": ours(arm, fast, torques, 1),
        "tmm-gen, sweep and correction, small code": ours(arm, scene, torques, 2),
        "tmm-gen, sweep alone, small code": ours(arm, scene, torques, 1),
        "CasADi": theirs(ArticulatedTree(arm, acting, step), arm, torques, step),
    }
    if pinocchio is not None:
        library = compiled(pinocchio, folder)
        for axes, in_world in (("links", False), ("the world", True)):
            peer = PinocchioTree(arm, acting, step, library, in_world=in_world)
            found[f"Pinocchio, axes of {axes}"] = theirs(peer, arm, torques, step)
    signals = {column: Constant(value) for column, value in torques.items()}
    true, _, _ = motion(arm, signals, np.array([0.0, UNTIL]))
    return found, true[-1]


def measure(
    title: str, joints: int, everyone: dict[str, Contender], true: Array, rounds: int
) -> list[dict[str, object]]:
    """Measure all by turns."""
    first, second, *_ = everyone
    times: dict[str, list[float]] = {name: [] for name in everyone}
    with progress(f"measuring {title}", total=rounds) as advance:
        for _ in range(rounds):
            for name, each in everyone.items():
                times[name].append(each.time())
            advance()

    def ratio(name: str, to: str) -> float:
        return statistics.median(a / b for a, b in zip(times[name], times[to], strict=True))

    return [
        {
            "arm": title,
            "step": name,
            "ns_per_joint": statistics.median(times[name]) / joints,
            "tmm_gen_over_it": ratio(first, name),
            "sweep_alone_over_it": ratio(second, name),
            "largest_error": float(np.max(np.abs(each.angles - true))),
        }
        for name, each in everyone.items()
    ]


def told(rows: list[dict[str, object]], rounds: int) -> str:
    """Return the table in Markdown."""
    lines = [
        f"One step of Newmark, medians of {rounds} rounds on one core; ratios are of times, below 1 where tmm-gen is "
        f"faster. Errors are the largest of any joint's angle after {UNTIL:g} s, at the scene's step.",
        "",
        "| arm | step | ns per joint | tmm-gen over it | its sweep alone over it | error (rad) |",
        "| --- | --- | ---: | ---: | ---: | ---: |",
    ]
    for row in rows:
        lines.append(
            f"| {row['arm']} | {row['step']} | {row['ns_per_joint']:.0f} | {row['tmm_gen_over_it']:.2f} | "
            f"{row['sweep_alone_over_it']:.2f} | {row['largest_error']:.1e} |"
        )
    return "\n".join(lines)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--out", type=Path, default=Path("out/bench"))
    parser.add_argument("--rounds", type=int, default=ROUNDS)
    parser.add_argument("--pinocchio", type=Path, default=installed(), help="folder with its include/")
    parser.add_argument("--update", action="store_true", help="write the table into docs/space.md")
    given = parser.parse_args()
    place: Path | None = given.pinocchio
    if place is None or not has_headers(place) or shutil.which("g++") is None:
        print(f"Pinocchio is left out: it wants g++ and {HOW_TO_GET}")
        place = None
    given.out.mkdir(parents=True, exist_ok=True)
    rows: list[dict[str, object]] = []
    for title, (name, scene) in arms().items():
        everyone, true = contenders(name, scene, place, given.out)
        rows += measure(title, scene.stations, everyone, true, given.rounds)
    columns: list[Column | str] = [
        "arm",
        "step",
        Column("ns_per_joint", "ns per joint", ".0f"),
        Column("tmm_gen_over_it", "tmm-gen over it", ".3f"),
        Column("sweep_alone_over_it", "its sweep alone over it", ".3f"),
        Column("largest_error", f"largest error of an angle after {UNTIL:g} s (rad)", ".1e"),
    ]
    table(rows, columns, title=f"one step, medians of {given.rounds} rounds")
    write_whole(given.out / "space_speed.csv", csv_text(rows))
    print(f"wrote {given.out / 'space_speed.csv'}")
    if given.update:
        PAGE.write_text(renewed(PAGE.read_text(), told(rows, given.rounds), "space_speed.py"))
        print(f"updated {PAGE}")


if __name__ == "__main__":
    main()

"""One step of an arm with two motors beside articulated-body code from CasADi and beside Pinocchio, in one run.

    pip install --target out/pin pin cmeel-eigen
    python benchmarks/elbow_speed.py --pinocchio out/pin/cmeel.prefix --out out/bench

The arm is scenes/elbow.toml with ten links in each beam. All take a step of Newmark (1/4, 1/2), with no outputs. The
peers' has springs and dampers implicit, as armatures, and one pass of the articulated-body algorithm about the motion
predicted with the last acceleration: one pass is the least that a method of second order costs them. tmm-gen's has
Newton's exact slopes of everything. CasADi's code has the arm's numbers in it and checks nothing; tmm-gen's reads them
from its model and checks inputs, pivots and the new state. On a processor with vectors that is code made with
``[emit] favour = "speed"``; the default, small code for controllers, stands beside it. Pinocchio is general code, for
any robot in space. Everyone: one thread, gcc -O3 -march=native, thread time, by turns; ratios within a round, then
their median. Before that each peer's accelerations must be those of Lagrange's equations. Without Pinocchio, or g++,
its rows are left out.
"""

from __future__ import annotations

import argparse
import shutil
import statistics
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from peers.articulated import Articulated
from peers.joint_arm import FLAGS, joint_arm
from peers.pinocchio import HOW_TO_GET, Pinocchio, compiled, has_headers, installed

from tmm_gen.cli.console import Column, progress, table
from tmm_gen.csv_text import csv_text
from tmm_gen.files import write_whole
from tmm_gen.inputs.signals import Constant
from tmm_gen.native import compile_kernel
from tmm_gen.program.build import build_program
from tmm_gen.reference.planar_arm import Arm
from tmm_gen.scene import Scene, load_scene

Array = NDArray[np.float64]
Peer = Articulated | Pinocchio

SCENE = Path(__file__).resolve().parents[1] / "scenes" / "elbow.toml"
LINKS = 10
TORQUES = {"shoulder_torque": 0.05, "elbow_torque": 0.03}
ROUNDS = 31
STEPS_A_ROUND = 5000
UNTIL = 0.2
"""When errors are taken, s."""
AGREEMENT = 1e-11
"""Of accelerations at the start with Lagrange's equations, relative to the largest."""


@dataclass(frozen=True, eq=False)
class Contender:
    """Somebody's step.

    Parameters
    ----------
    time : callable
        Measures it once, ns.
    tip : array, (2,)
        Where its arm's tip is at `UNTIL`, m.
    """

    time: Callable[[], float]
    tip: Array


def elbow(links: int = LINKS) -> Scene:
    """Return the arm."""
    return load_scene(SCENE).replace(**{"beam.upper.links": links, "beam.forearm.links": links})


def ours(scene: Scene) -> Contender:
    """Return the step that tmm-gen emits."""
    kernel = compile_kernel(build_program(scene), scene, flags=FLAGS)
    _, outputs = kernel.simulate(UNTIL, TORQUES)
    return Contender(kernel.timer(TORQUES), np.array([outputs["payload_x"][-1], outputs["payload_y"][-1]]))


def theirs(peer: Peer, arm: Arm) -> Contender:
    """Return a peer's step.

    Raises
    ------
    AssertionError
        If it is another arm: its accelerations differ at the start.
    """
    rest = np.zeros(peer.joints)
    start = peer.started(rest, rest)
    true = arm.bent(arm.accelerations(np.zeros(1), rest[None], rest[None]))[0]
    if np.abs(start[2 * peer.joints :] - true).max() > AGREEMENT * np.abs(true).max():
        raise AssertionError(f"{type(peer).__name__} has another arm: its accelerations differ")
    there, _ = peer.advance(start, round(UNTIL / arm.scene.integrator.step))
    return Contender(
        lambda: 1e9 / STEPS_A_ROUND * peer.advance(start, STEPS_A_ROUND)[1],
        tip_of(arm, np.cumsum(there[: peer.joints])),
    )


def tip_of(arm: Arm, angles: Array) -> Array:
    """Return where the tip is at absolute angles, (2,), m."""
    return np.array([arm.lengths @ np.cos(angles), arm.lengths @ np.sin(angles)])


def contenders(scene: Scene, arm: Arm, pinocchio: Path | None, folder: Path) -> dict[str, Contender]:
    """Return everyone; the first two are what others are compared with."""
    torques = np.array([TORQUES[item.name] for item in scene.inputs])
    jointed = joint_arm(scene)
    fast = scene.replace(**{"emit.favour": "speed"})
    found = {
        "tmm-gen, favour speed": ours(fast),
        "tmm-gen": ours(scene),
        "tmm-gen, favour speed, sines of the C library": ours(fast.replace(**{"emit.trigonometry": "libm"})),
        "tmm-gen, sines of the C library": ours(scene.replace(**{"emit.trigonometry": "libm"})),
        "CasADi": theirs(Articulated(jointed, torques), arm),
    }
    if pinocchio is not None:
        library = compiled(pinocchio, folder)
        for axes, in_world in (("links", False), ("the world", True)):
            peer = Pinocchio(jointed, torques, library, in_world=in_world)
            found[f"Pinocchio, axes of {axes}"] = theirs(peer, arm)
    return found


def measure(everyone: dict[str, Contender], true: Array, rounds: int) -> list[dict[str, object]]:
    """Measure all by turns."""
    first, second, *_ = everyone
    times: dict[str, list[float]] = {name: [] for name in everyone}
    with progress("measuring", total=rounds) as advance:
        for _ in range(rounds):
            for name, each in everyone.items():
                times[name].append(each.time())
            advance()

    def ratio(name: str, to: str) -> float:
        return statistics.median(a / b for a, b in zip(times[name], times[to], strict=True))

    return [
        {
            "step": name,
            "ns": statistics.median(times[name]),
            "fast_over_it": ratio(first, name),
            "small_over_it": ratio(second, name),
            "tip_error": float(np.linalg.norm(each.tip - true)),
        }
        for name, each in everyone.items()
    ]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--out", type=Path, default=Path("out/bench"))
    parser.add_argument("--rounds", type=int, default=ROUNDS)
    parser.add_argument("--pinocchio", type=Path, default=installed(), help="folder with its include/")
    given = parser.parse_args()
    place: Path | None = given.pinocchio
    if place is None or not has_headers(place) or shutil.which("g++") is None:
        print(f"Pinocchio is left out: it wants g++ and {HOW_TO_GET}")
        place = None
    scene = elbow()
    arm = Arm(scene, {name: Constant(value) for name, value in TORQUES.items()})
    angles, _, _ = arm.trajectory(UNTIL).at(np.array([UNTIL]))
    given.out.mkdir(parents=True, exist_ok=True)
    everyone = contenders(scene, arm, place, given.out)
    rows = measure(everyone, tip_of(arm, angles[0]), given.rounds)
    columns: list[Column | str] = [
        "step",
        Column("ns", "ns", ".0f"),
        Column("fast_over_it", "favour speed over it", ".3f"),
        Column("small_over_it", "default over it", ".3f"),
        Column("tip_error", f"tip error after {UNTIL:g} s (m)", ".1e"),
    ]
    table(rows, columns, title=f"elbow, 2 x {LINKS} links: one step, medians of {given.rounds} rounds")
    write_whole(given.out / "elbow_speed.csv", csv_text(rows))
    print(f"wrote {given.out / 'elbow_speed.csv'}")


if __name__ == "__main__":
    main()

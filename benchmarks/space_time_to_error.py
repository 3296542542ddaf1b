"""Time to an error of the tip: arms in space beside articulated-body code from CasADi and beside Pinocchio, in one run.

    python benchmarks/space_time_to_error.py --pinocchio out/pin/cmeel.prefix --update

The arms, torques and peers of `space_speed.py`, whose peers take Newmark's steps. tmm-gen takes Newmark's, those of
sdirk4 with two corrections a stage and with one exact sweep, and those of radau3 and gauss3 in two iterations, the
latter also in vectors (`emit.favour = "speed"`); its sines are its own (`emit.trigonometry`). Error: the largest of the
tip's place at 0.05, 0.1, 0.15 and 0.2 s against the reference. For each the fewest steps with the wanted error are
sought, to 3 %, and the time of so many steps is taken in turns with the others (thread time, medians, medians of
ratios). `--update` writes the table into docs/space.md.
"""

from __future__ import annotations

import argparse
import shutil
import statistics
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from peers.joint_arm import FLAGS
from peers.pinocchio import HOW_TO_GET, has_headers, installed
from peers.tree import ArticulatedTree, Peer, PinocchioTree, compiled, driven
from space_speed import TORQUES, Array, arms
from support.marks import renewed

from tmm_gen.csv_text import csv_text
from tmm_gen.derive.integrators.registry import integrator
from tmm_gen.files import write_whole
from tmm_gen.inputs.signals import Constant
from tmm_gen.native import NativeKernel, compile_kernel
from tmm_gen.native.recording import record
from tmm_gen.program.space.assemble import SpaceChoices, build_in_space
from tmm_gen.reference.spatial_motion import motion, start
from tmm_gen.reference.spatial_places import Tree
from tmm_gen.scene import Scene
from tmm_gen.scene.spatial.arm import Frame, SpatialArm

PAGE = Path(__file__).resolve().parents[1] / "docs" / "space.md"
TIPS = {"yaw3": "payload", "arm6": "hand"}
OURS = {
    "tmm-gen, newmark, 1 correction": ("newmark", SpaceChoices(1e-3, iterations=2)),
    "tmm-gen, sdirk4, 2 corrections": ("sdirk4", SpaceChoices(1e-3, iterations=3, held=True)),
    "tmm-gen, radau3, 1 correction": ("radau3", SpaceChoices(1e-3, iterations=2)),
    "tmm-gen, gauss3, 1 correction": ("gauss3", SpaceChoices(1e-3, iterations=2)),
    "tmm-gen, gauss3, 1 correction, in vectors": ("gauss3", SpaceChoices(1e-3, iterations=2, vectors=True)),
    "tmm-gen, sdirk4, exact": ("sdirk4", SpaceChoices(1e-3, iterations=1, exact=True, held=True)),
}
INTERVAL, INTERVALS = 0.05, 4
"""Between checkpoints, s."""
WANTED = (1e-4, 1e-6)
MOST = 50_000
"""Steps between checkpoints."""
ROUNDS = 11
SAMPLE = 2000
"""Steps of a peer that are timed at once."""


@dataclass(frozen=True, eq=False)
class Contender:
    """Somebody's steps.

    Parameters
    ----------
    angles : callable
        Takes so many steps between checkpoints and returns the joints' angles there, (4, n), rad.
    timer : callable
        Returns what measures one step once, ns.
    """

    angles: Callable[[int], Array]
    timer: Callable[[], Callable[[], float]]


@dataclass(frozen=True, eq=False)
class Tip:
    """Where it is, and where it should be.

    Parameters
    ----------
    arm : SpatialArm
    frame : Frame
        Of the tip.
    exact : array, (4, n)
        Angles of the joints at the checkpoints, rad.
    """

    arm: SpatialArm
    frame: Frame
    exact: Array

    def error(self, angles: Array) -> float:
        """Return how far off it is at most, m."""
        if not np.isfinite(angles).all():
            return np.inf
        there, meant = (Tree(self.arm).places(q).frame(self.frame)[1] for q in (angles, self.exact))
        return float(np.max(np.linalg.norm(there - meant, axis=-1)))

    def fewest(self, contender: Contender, wanted: float) -> int | None:
        """Return the fewest steps between checkpoints with a wanted error."""

        def reached(count: int) -> bool:
            return self.error(contender.angles(count)) <= wanted

        low, high = 0, 1
        while not reached(high):
            low, high = high, 2 * high
            if high > MOST:
                return None
        while high - low > max(1, high // 33):
            middle = (low + high) // 2
            low, high = (low, middle) if reached(middle) else (middle, high)
        return high


def ours(kernel: NativeKernel, torques: Mapping[str, float], arm: SpatialArm) -> Contender:
    """Return the steps of a kernel."""
    inputs = {name: np.array(value) for name, value in torques.items()}

    def angles(count: int) -> Array:
        kernel.prepare(step=INTERVAL / count)
        kernel.initialise(torques)
        found = record(kernel, inputs, INTERVALS * count)
        if found.failed is not None:
            return np.full((INTERVALS, len(arm.joints)), np.nan)
        return np.column_stack([found.outputs[o.name][count - 1 :: count] for o in arm.outputs])

    return Contender(angles, lambda: kernel.timer(torques))


def theirs(peer: Peer, arm: SpatialArm) -> Contender:
    """Return a peer's steps; that it has the same arm, `space_speed.py` shows, and so do its errors."""
    begun = peer.started(*start(arm))

    def angles(count: int) -> Array:
        stepping, moved, found = peer.at_step(INTERVAL / count), begun, []
        for _ in range(INTERVALS):
            moved, _ = stepping.advance(moved, count)
            found.append(moved[: peer.joints])
        return np.array(found)

    still = peer.at_step(1e-4)
    return Contender(angles, lambda: lambda: 1e9 / SAMPLE * still.advance(begun, SAMPLE)[1])


def measured(
    title: str, name: str, scene: Scene, place: Path | None, folder: Path, rounds: int
) -> list[dict[str, object]]:
    """Return a row for each contender and wanted error."""
    assert scene.spatial is not None
    arm = driven(scene.spatial)
    torques = {item.name: TORQUES[name].get(item.name, 0.0) for item in arm.inputs}
    acting = np.zeros(len(arm.joints))
    for item in arm.inputs:
        acting[item.joint - 1] += arm.joints[item.joint - 1].gear * torques[item.name]
    signals = {column: Constant(value) for column, value in torques.items()}
    times = INTERVAL * np.arange(1, INTERVALS + 1, dtype=float)
    frame = next(f for f in arm.frames if f.name == TIPS[name])
    tip = Tip(arm, frame, motion(arm, signals, times)[0])
    everyone: dict[str, Contender] = {}
    for words, (method, choices) in OURS.items():
        favour = "speed" if choices.vectors else "size"
        own = scene.replace(**{"emit.trigonometry": "own", "emit.favour": favour})
        program = build_in_space(arm, scene.name, scene.title, integrator(method), choices)
        everyone[words] = ours(compile_kernel(program, own, flags=FLAGS), torques, arm)
    everyone["CasADi, newmark"] = theirs(ArticulatedTree(arm, acting, None), arm)
    if place is not None:
        peer = PinocchioTree(arm, acting, 1e-3, compiled(place, folder), in_world=True)
        everyone["Pinocchio, newmark"] = theirs(peer, arm)
    fewest = {
        wanted: {words: tip.fewest(each, wanted) for words, each in everyone.items()} for wanted in WANTED
    }
    timers = {words: each.timer() for words, each in everyone.items()}
    steps: dict[str, list[float]] = {words: [] for words in timers}
    for _ in range(rounds):
        for words, timer in timers.items():
            steps[words].append(timer())
    return [row for wanted in WANTED for row in compared(title, wanted, fewest[wanted], steps)]


def compared(
    title: str, wanted: float, fewest: Mapping[str, int | None], steps: Mapping[str, list[float]]
) -> list[dict[str, object]]:
    """Return the rows of a wanted error: steps, time, and the time over that of the best peer."""
    runs = {
        words: [1e-6 * INTERVALS * count * each for each in steps[words]]
        for words, count in fewest.items()
        if count is not None
    }
    peers = [words for words in runs if not words.startswith("tmm-gen")]
    best = min(peers, key=lambda words: statistics.median(runs[words])) if peers else None
    rows: list[dict[str, object]] = []
    for words, count in fewest.items():
        row: dict[str, object] = {"arm": title, "error": f"{wanted:.0e}", "who": words, "steps": "-"}
        if count is not None:
            median = statistics.median(runs[words])
            row |= {"steps": INTERVALS * count, "ms": f"{median:.2f}" if median >= 0.1 else f"{median:.2g}"}
        if count is not None and best is not None:
            pairs = zip(runs[words], runs[best], strict=True)
            row["over"] = f"{statistics.median(a / b for a, b in pairs):.2f}"
        rows.append(row)
    return rows


def told(rows: list[dict[str, object]]) -> str:
    """Return the table in Markdown."""
    keys = ("arm", "error", "who", "steps", "ms", "over")
    lines = [
        f"Steps and time for {INTERVALS * INTERVAL:g} s with the tip's largest error below 1e-4 m and 1e-6 m, one "
        "core; last, the time over that of the best peer.",
        "",
        "| arm | error (m) | method | steps | time (ms) | over the best peer |",
        "| --- | --- | --- | ---: | ---: | ---: |",
    ]
    return "\n".join(
        lines + ["| " + " | ".join(str(row.get(key, "-")) for key in keys) + " |" for row in rows]
    )


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--out", type=Path, default=Path("out/bench"))
    parser.add_argument("--rounds", type=int, default=ROUNDS)
    parser.add_argument("--arms", nargs="+", default=list(arms()), help="titles")
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
        if title in given.arms:
            rows += measured(title, name, scene, place, given.out, given.rounds)
            print(told(rows[-2 * (len(OURS) + 1 + (place is not None)) :]), flush=True)
    write_whole(given.out / "space_time_to_error.csv", csv_text(rows))
    if given.update:
        PAGE.write_text(renewed(PAGE.read_text(), told(rows), "space_time_to_error.py"))
        print(f"updated {PAGE}")


if __name__ == "__main__":
    main()

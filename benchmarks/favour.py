"""What ``emit.favour = "speed"`` is worth: time of one step of the fast C over that of the small one.

    python benchmarks/favour.py --update

Each arm in turns with itself, one thread, thread time, own sines; ratios are formed within a round, then their median
is taken. `--update` writes the table into docs/planar.md.
"""

from __future__ import annotations

import argparse
import statistics
from pathlib import Path

from support.marks import renewed
from time_to_error import arm

from tmm_gen.files import write_whole
from tmm_gen.native import compile_kernel
from tmm_gen.program.build import build_program
from tmm_gen.scene import Scene, load_scene

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "planar.md"
FLAGS = (("-O2", "-ffp-contract=off"), ("-O3", "-march=native", "-ffp-contract=off"))
ROUNDS = 21
INTEGRATORS = ("newmark", "sdirk4", "radau3")


def cases() -> dict[str, Scene]:
    """Return what is measured, by its name in the table."""
    found = {
        f"`{name}`": load_scene(ROOT / "scenes" / f"{name}.toml").replace(
            **{"emit.trigonometry": "own", "emit.box": None}
        )
        for name in ("arm10", "arm50")
    }
    found |= {
        f"{links} links, `{name}`": arm("gravity", links, name, "1")
        for name in INTEGRATORS
        for links in (10, 50)
    }
    return found


def measured(scene: Scene, flags: tuple[str, ...], rounds: int) -> tuple[float, float]:
    """Return nanoseconds of a step of the fast code per link, and the ratio to the small one."""
    timers = []
    for favour in ("size", "speed"):
        asked = scene.replace(**{"emit.favour": favour})
        timers.append(compile_kernel(build_program(asked), asked, flags=flags).timer())
    times = [[timer() for timer in timers] for _ in range(rounds)]
    fast = statistics.median(fast for _, fast in times) / scene.stations
    return fast, statistics.median(fast / small for small, fast in times)


def main() -> None:
    """Measure and print, and write the page."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--rounds", type=int, default=ROUNDS)
    parser.add_argument("--update", action="store_true", help="write the table into docs/planar.md")
    given = parser.parse_args()
    lines = ["| arm | gcc -O2 | gcc -O3 -march=native | ns per link and step |", "|---|---:|---:|---:|"]
    for name, scene in cases().items():
        (_, plain), (ns, native) = (measured(scene, flags, given.rounds) for flags in FLAGS)
        lines.append(f"| {name} | {plain:.2f} | {native:.2f} | {ns:.0f} |")
        print(lines[-1], flush=True)
    if given.update:
        write_whole(PAGE, renewed(PAGE.read_text(), "\n".join(lines), "favour.py"))
        print(f"updated {PAGE}")


if __name__ == "__main__":
    main()

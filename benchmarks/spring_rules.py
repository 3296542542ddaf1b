"""How the rules of joint springs converge to the continuous beam: docs/figures/spring_rules.png.

    python benchmarks/spring_rules.py --out docs/figures

A clamped, uniform beam without tip mass, cut into 2 to 200 links. Errors are those of its first five natural
frequencies against the exact ones; `slope` is fitted from 20 links on.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
from thesis.spring_rule_errors import Convergence, convergence

from tmm_gen.cli.console import Column, progress, table
from tmm_gen.files import write_whole
from tmm_gen.scene import Scene, parse_scene
from tmm_gen.scene.beam import Springs
from tmm_gen.style import FAINT, PALETTE, figure, picture, style, subtitle

LINKS = (2, 3, 4, 5, 6, 7, 8, 10, 12, 15, 20, 26, 34, 45, 60, 80, 110, 150, 200)
MODES = 5
FIT_FROM = 20
TEXTS: dict[Springs, str] = {
    "thesis": "thesis: 8/9, (48n−72)/(42n−71), 1",
    "uniform": "uniform: 1, 1, 1",
    "half-clamp": "half-clamp: 2, 1, 1",
    "clamped-segment": "clamped-segment: 2, 1, 1; half a link last",
}
BEAM = """
name = "uniform_beam"
[model]
kind = "planar"
[integrator]
name = "newmark"
step = 1e-3
[base]
kind = "clamp"
[beam]
length = 1.0
bending_stiffness = 1.0
mass_per_length = 1.0
links = 2
[[output]]
name = "tip"
at = "tip"
of = "position"
"""


def uniform_beam() -> Scene:
    """Return the clamped beam."""
    return parse_scene(BEAM)


def drawn(found: list[Convergence]) -> bytes:
    """Draw one panel for each rule."""
    with style():
        made, axes = figure(13.5, 4.0, ncols=4, sharex=True, sharey=True)
        for panel, each in zip(axes, found, strict=True):
            panel.set_xscale("log")
            panel.set_yscale("log")
            for mode in range(MODES):
                panel.plot(
                    each.links,
                    each.errors[:, mode],
                    marker="o",
                    markersize=3,
                    linewidth=1.4,
                    color=PALETTE[mode],
                    label=f"mode {mode + 1}",
                )
            slope = round(float(np.mean(each.slopes(FIT_FROM))))
            line = 10.0 ** (-0.3 if slope == 1 else 0.3) * 2.0 * (each.links / 2.0) ** -float(slope)
            panel.plot(each.links, line, color=FAINT, linestyle="--", linewidth=1.2)
            panel.annotate(
                f"slope −{slope}", (each.links[9], line[9]), (2, 5), textcoords="offset points", color=FAINT
            )
            subtitle(panel, each.rule, f"springs over EI/l: {TEXTS[each.rule].partition(': ')[2]}")
            panel.set_xlabel("links")
            panel.set_xticks([2, 5, 10, 20, 50, 100, 200], ["2", "5", "10", "20", "50", "100", "200"])
            panel.minorticks_off()
        axes[0].set_ylabel("relative error of the natural frequency")
        handles, labels = axes[0].get_legend_handles_labels()
        made.legend(handles, labels, loc="outside lower center", ncols=MODES)
        return picture(made, "png")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--out", type=Path, default=Path("out/bench"))
    out = parser.parse_args().out
    found = []
    with progress("cutting the beam", total=len(TEXTS)) as advance:
        for rule in TEXTS:
            found.append(convergence(uniform_beam(), rule, LINKS, MODES))
            advance(doing=rule)
    at = {n: list(LINKS).index(n) for n in (10, 50, 200) if n in LINKS}
    rows = [
        {
            "rule": each.rule,
            "mode": mode + 1,
            **{f"error_{n}": 100.0 * float(each.errors[row, mode]) for n, row in at.items()},
            "slope": float(each.slopes(FIT_FROM)[mode]),
        }
        for each in found
        for mode in range(MODES)
    ]
    columns = [
        Column("rule"),
        Column("mode"),
        *(Column(f"error_{n}", f"error at {n} links (%)", ".4g") for n in at),
    ]
    table(rows, [*columns, Column("slope", "order", ".3f")], title="natural frequencies of a clamped beam")
    write_whole(out / "spring_rules.png", drawn(found))
    print(f"wrote {out / 'spring_rules.png'}")


if __name__ == "__main__":
    main()

"""What a step costs on microcontrollers: instructions, code, memory and stack, in emulators, beside committed budgets.

``--update`` commits what is measured: it rewrites benchmarks/embedded.json and the table in docs/embedded.md. README
quotes one row, which a test compares.
"""

from __future__ import annotations

import argparse
import csv
import json
from dataclasses import dataclass
from pathlib import Path

from tmm_gen.files import write_tree_whole
from tmm_gen.scene import load_scene
from tmm_gen.target import BOARDS, Measurement, measure

ROOT = Path(__file__).resolve().parents[1]
BUDGETS = ROOT / "benchmarks" / "embedded.json"
PAGE = ROOT / "docs" / "embedded.md"
BEGIN, END = "<!-- written by benchmarks/embedded.py --update -->", "<!-- end -->"
FIGURES = ("instructions_per_step", "step_bytes", "code_bytes", "ram_bytes", "stack_bytes")
TOLERANCE = 1.02
"""Counts are exact: what grows by more than this is a change of the code."""


ARM6 = {
    "emit.trigonometry": "own",
    "emit.box": {
        "angles": [-3.2, 3.2],
        "rates": [-6.0, 6.0],
        "accelerations": [-2e3, 2e3],
        **{f"torque{k}": [-2.0, 2.0] for k in range(1, 7)},
    },
}
"""What a controller's scene says besides: within this box `tmm-gen check --prove` finds no fault."""


@dataclass(frozen=True)
class Case:
    """A kernel and where it runs."""

    scene: str
    real: str
    parameters: str
    target: str

    def __str__(self) -> str:
        """Key in the file of budgets."""
        return f"{self.scene} {self.real} {self.parameters} {self.target}"

    def measure(self) -> Measurement:
        """Measure it."""
        folder = "examples/space" if self.in_space else "scenes"
        scene = load_scene(ROOT / folder / f"{self.scene}.toml")
        changes = {"emit.real": self.real, "emit.parameters": self.parameters}
        return measure(scene.replace(**changes, **(ARM6 if self.in_space else {})), self.target)

    @property
    def in_space(self) -> bool:
        """Whether it is an example in space, which says nothing of controllers itself."""
        return self.scene == "arm6"


CASES = (
    Case("thesis10", "float32", "free", "cortex-m4f"),
    Case("thesis10", "float32", "bound", "cortex-m4f"),
    Case("thesis10", "float64", "free", "cortex-m7"),
    Case("thesis10", "float64", "free", "rv32imafdc"),
    Case("arm10", "float32", "free", "cortex-m4f"),
    Case("arm10", "float32", "bound", "cortex-m4f"),
    Case("arm10", "float64", "free", "cortex-m7"),
    Case("arm10", "float64", "free", "rv32imafdc"),
    Case("arm6", "float32", "free", "cortex-m4f"),
    Case("arm6", "float64", "free", "cortex-m7"),
)


def figures(found: Measurement) -> dict[str, int | bool]:
    """Return what is committed of a measurement."""
    return {**{name: getattr(found, name) for name in FIGURES}, "bits_equal": found.bits_equal}


def committed() -> dict[str, dict[str, int]]:
    """Return the committed budgets by case."""
    budgets: dict[str, dict[str, int]] = json.loads(BUDGETS.read_text())
    return budgets


def table(rows: dict[str, dict[str, int]]) -> str:
    """Write the table of the page."""
    lines = [
        "| scene | number type | parameters | processor | instructions per step | code of the step | all code "
        "| memory | stack | bits as on the host |",
        "|---|---|---|---|---|---|---|---|---|---|",
    ]
    for case in CASES:
        row = rows[str(case)]
        cells = (f"{row[name]} B" if name.endswith("bytes") else str(row[name]) for name in FIGURES)
        bits = "equal" if row["bits_equal"] else "differ"
        title = BOARDS[case.target].title
        lines.append(
            f"| `{case.scene}` | {case.real} | {case.parameters} | {title} | {' | '.join(cells)} | {bits} |"
        )
    return "\n".join(lines)


def page_with(text: str, written: str) -> str:
    """Return a page with a table in its place."""
    before, _, rest = text.partition(BEGIN)
    _, _, after = rest.partition(END)
    return f"{before}{BEGIN}\n{written}\n{END}{after}"


def pages(rows: dict[str, dict[str, int]]) -> dict[Path, str]:
    """Return all pages with tables, with these figures."""
    return {PAGE: page_with(PAGE.read_text(), table(rows))}


def main() -> None:
    """Measure all cases, print them beside the budgets, write a CSV; or commit them."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("out/bench"))
    parser.add_argument("--update", action="store_true", help="commit what is measured")
    options = parser.parse_args()
    rows = {}
    for case in CASES:
        rows[str(case)] = figures(case.measure())
        print(
            f"{case}: " + ", ".join(f"{name} {value}" for name, value in rows[str(case)].items()), flush=True
        )
    if options.update:
        write_tree_whole({BUDGETS: json.dumps(rows, indent=1) + "\n", **pages(rows)})
        return
    options.out.mkdir(parents=True, exist_ok=True)
    with (options.out / "embedded.csv").open("w", newline="") as file:
        writer = csv.DictWriter(file, ["case", *FIGURES, "bits_equal"])
        writer.writeheader()
        writer.writerows({"case": name, **row} for name, row in rows.items())


if __name__ == "__main__":
    main()

"""Write a recording as a C header: python csv_to_c.py recording.csv recording.h."""

from __future__ import annotations

import csv
import sys
from pathlib import Path

COLUMNS = ("hub_torque", "hub_angle")


def header(rows: list[dict[str, str]]) -> str:
    """Return the header: one array for each column, in single precision."""
    lines = ["/* Written by csv_to_c.py. */", "#ifndef RECORDING_H", "#define RECORDING_H", ""]
    lines += [f"#define RECORDING_SAMPLES {len(rows)}", ""]
    for column in COLUMNS:
        lines += [f"static const float recorded_{column}[RECORDING_SAMPLES] = {{"]
        lines += [f"    {float(row[column])!r}f," for row in rows]
        lines += ["};", ""]
    return "\n".join([*lines, "#endif"]) + "\n"


def main() -> None:
    """Convert the file named first into the one named second."""
    source, target = map(Path, sys.argv[1:3])
    with source.open(newline="") as stream:
        target.write_text(header(list(csv.DictReader(stream))))


if __name__ == "__main__":
    main()

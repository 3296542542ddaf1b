"""Write columns of a table as a C header: python csv_to_c.py recording.csv recording.h recorded hub_torque hub_angle.

The third word stands in front of the names of the arrays.
"""

from __future__ import annotations

import csv
import sys
from pathlib import Path


def header(rows: list[dict[str, str]], prefix: str, columns: list[str]) -> str:
    """Return the header: one array for each column, in single precision."""
    guard = f"{prefix.upper()}_H"
    lines = ["/* Written by csv_to_c.py. */", f"#ifndef {guard}", f"#define {guard}", ""]
    lines += [f"#define {prefix.upper()}_ROWS {len(rows)}", ""]
    for column in columns:
        lines += [f"static const float {prefix}_{column}[{prefix.upper()}_ROWS] = {{"]
        lines += [f"    {float(row[column])!r}f," for row in rows]
        lines += ["};", ""]
    return "\n".join([*lines, "#endif"]) + "\n"


def main() -> None:
    """Convert the file named first into the one named second."""
    source, target = map(Path, sys.argv[1:3])
    prefix, *columns = sys.argv[3:]
    with source.open(newline="") as stream:
        target.write_text(header(list(csv.DictReader(stream)), prefix, columns))


if __name__ == "__main__":
    main()

"""Error against time in a table: milliseconds to round errors, and who is how much slower."""

from __future__ import annotations

from against_time.picture import Curve

LEVELS = (1e-2, 1e-4, 1e-6, 1e-8)


def told(curves: list[Curve]) -> str:
    """Return the table in Markdown: milliseconds for a simulated second of one arm, at the errors of the columns."""
    lines = [
        "| | " + " | ".join(_length(level) for level in LEVELS) + " |",
        "|---|" + "---:|" * len(LEVELS),
    ]
    for curve in curves:
        many = ", many arms" if curve.panel == "many" else ""
        times = [curve.time_to(level) for level in LEVELS]
        said = ["-" if each is None else f"{1e3 * each:.2g}" for each in times]
        name = f"**{curve.name}{many}**" if curve.ours else curve.name
        lines.append(f"| {name} | " + " | ".join(said) + " |")
    lines.append("| " + " | ".join(["the best peer's time over our best, one arm", *_ratios(curves)]) + " |")
    return "\n".join(lines)


def _ratios(curves: list[Curve]) -> list[str]:
    found = []
    for level in LEVELS:
        ours, theirs = (
            [t for c in curves if c.panel == "one" and c.ours is own and (t := c.time_to(level)) is not None]
            for own in (True, False)
        )
        found.append(f"{min(theirs) / min(ours):.1f} times" if ours and theirs else "-")
    return found


def _length(level: float) -> str:
    return {1e-2: "1 cm", 1e-4: "0.1 mm", 1e-6: "1 µm", 1e-8: "0.01 µm"}[level]

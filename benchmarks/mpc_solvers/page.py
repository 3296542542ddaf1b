"""What was measured, as the page shows it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

Rows = Sequence[Mapping[str, object]]
HEAD = (
    "| links | solver | median (µs) | 99 % over median | times full RTI | times zero-order | torque off by | samples |",
    "|---:|---|---:|---:|---:|---:|---:|---:|",
)

SPACE_HEAD = (
    "| joints | wall | solver | median (µs) | 99 % over median | times `rti` | times `rti-zero` | torque off by "
    "| samples |",
    "|---:|---|---|---:|---:|---:|---:|---:|---:|",
)
DERIVATIVES = "derivatives of all stages"
"""Not a solver: what others spend of their time at least once."""


def section(rows: Rows, growth: Rows, costs: Rows) -> str:
    """Return table and sentences.

    Parameters
    ----------
    rows, growth, costs
        Of `mpc_speed.py`.
    """
    smallest, largest = min(_whole(row["links"]) for row in rows), max(_whole(row["links"]) for row in rows)
    powers = [f"{_short_name(row)} {_number(row['exponent']):.2f}" for row in growth]
    grows = f"From {smallest} to {largest} links the time of a sample grows as the number of links to the power of"
    return "\n\n".join(
        [
            "\n".join([*HEAD, *map(_line, rows)]),
            f"{grows}: {', '.join(powers)}.",
            *_limits(rows),
            f"Closed-loop cost on the model, relative to SQP iterated to convergence at every sample: {_costs(costs)}.",
        ]
    )


def _limits(rows: Rows) -> list[str]:
    """Return, for each form of CasADi's and do-mpc's, the least ratio over five and ten links."""
    found = []
    for name in dict.fromkeys(str(row["solver"]) for row in rows):
        seen = [row for row in rows if row["solver"] == name and row["links"] in (5, 10)]
        if len(seen) == 2 and all(_number(row["over_full"]) > 1.0 for row in seen):
            full, zero = (min(_number(row[key]) for row in seen) for key in ("over_full", "over_zero"))
            found.append(f"{name} {_short(full)} and {_short(zero)}")
    if not found:
        return []
    text = "At five and ten links others take at least so many times the time of full and zero-order RTI"
    return [f"{text}: {'; '.join(found)}."]


def _line(row: Mapping[str, object]) -> str:
    return f"| {row['links']} | {_cells(row)} |"


def _cells(row: Mapping[str, object]) -> str:
    off = row["torque_off"]
    cells = [
        str(row["solver"]),
        _time(_number(row["median_us"])),
        f"{_number(row['p99_over_median']):.2f}",
        _short(_number(row["over_full"])),
        _short(_number(row["over_zero"])),
        f"{_number(off):.0e}".replace("e-0", "e-") if off else "0",
        str(row["samples"]),
    ]
    return " | ".join(cells)


def space_section(rows: Rows) -> str:
    """Return table and sentences.

    Parameters
    ----------
    rows
        Of `mpc_space_speed.py`.
    """
    solvers = [row for row in rows if row["solver"] != DERIVATIVES]
    lines = [f"| {row['joints']} | {'yes' if row['walled'] else 'no'} | {_cells(row)} |" for row in solvers]
    found = ["\n".join([*SPACE_HEAD, *lines])]
    for joints in dict.fromkeys(row["joints"] for row in rows):
        own = [row for row in rows if row["joints"] == joints]
        others = [row for row in own if row in solvers and not str(row["solver"]).startswith("`")]
        once = min(_number(row["median_us"]) for row in own if row["solver"] == DERIVATIVES)
        found.append(
            f"With {joints} joints the fastest of the others takes {_least(others, 'over_full', True)} times the time "
            f"of `rti` up to the wall and {_least(others, 'over_zero', True)} times that of `rti-zero`, "
            f"{_least(others, 'over_full', False)} and {_least(others, 'over_zero', False)} times without it. "
            f"To compute the derivatives of all stages "
            f"once takes them {_time(once)} µs."
        )
    return "\n\n".join(found)


def _least(rows: Rows, key: str, walled: bool) -> str:
    """Return the least ratio of those with a wall, or without."""
    return _short(min(_number(row[key]) for row in rows if row["walled"] == walled))


def _time(microseconds: float) -> str:
    return f"{microseconds:.3g}" if microseconds < 1000.0 else f"{microseconds:.0f}"


def _short(ratio: float) -> str:
    return f"{ratio:.2f}" if ratio < 10.0 else f"{ratio:.3g}" if ratio < 1000.0 else f"{ratio:.0f}"


def _costs(costs: Rows) -> str:
    links = dict.fromkeys(row["links"] for row in costs)
    parts = []
    for count in links:
        others = [row for row in costs if row["links"] == count and row["solver"] != "converged SQP"]
        changes = [f"{_short_name(row)} {_change(_number(row['more']))}" for row in others]
        parts.append(f"with {count} links {', '.join(changes)}")
    return "; ".join(parts)


def _change(more: float) -> str:
    return f"{abs(more):.0e} {'more' if more >= 0.0 else 'less'}".replace("e-0", "e-")


def _short_name(row: Mapping[str, object]) -> str:
    return str(row["solver"]).partition(",")[0]


def _number(value: object) -> float:
    assert isinstance(value, int | float)
    return float(value)


def _whole(value: object) -> int:
    assert isinstance(value, int)
    return value

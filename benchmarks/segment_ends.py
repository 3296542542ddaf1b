"""Where a beam is cut: `half-clamp`, `finite-segment` and `clamped-segment` beside the exact beam, on nine arms.

    python benchmarks/segment_ends.py --update

`half-clamp` cuts at the inner ends of equal links, with a spring of 2 EI/l where the beam is held; `finite-segment` in
the middle of equal pieces, with springs of EI/l only and half a piece rigid at either end. `clamped-segment` has the
former's root and the latter's end, on a clamp as on a hub that turns; on the motor between two beams it is the latter.
A prescribed base has the frequencies of a clamp. Beams of 1 m, EI = 1 N m^2 and 1 kg/m (the outer one
half as stiff and heavy), no gravity, 4 to 32 springs each. Frequencies are those of
Lagrange's equations (`reference/planar_arm.py`); exact ones of the beam's dynamic stiffness. `--update` writes the
table into docs/modes.md.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigh
from scipy.optimize import brentq
from support.marks import renewed

from tmm_gen.cli.console import Column, table
from tmm_gen.csv_text import csv_text
from tmm_gen.files import write_whole
from tmm_gen.modal.beam import BeamArm, natural_frequencies
from tmm_gen.modal.beam.arm import BeamBase, Body
from tmm_gen.modal.beam.member import Member
from tmm_gen.modal.beam.stiffness import dynamic_stiffness
from tmm_gen.reference.planar_arm import Arm
from tmm_gen.scene import Initial, parse_scene
from tmm_gen.scene.beam import Tip
from tmm_gen.scene.parts.expansion import joined
from tmm_gen.scene.station import Joint, Link

Array = NDArray[np.float64]
Rule = Literal["half-clamp", "finite-segment", "clamped-segment"]
Station = tuple[Joint, Link]

PAGE = Path(__file__).resolve().parents[1] / "docs" / "modes.md"
RULES: tuple[Rule, ...] = ("half-clamp", "finite-segment", "clamped-segment")
LINKS = (4, 8, 16, 32)
MODES = 3
INNER = Member(1.0, 1.0, 1.0)
OUTER = Member(1.0, 0.5, 0.5)
HEAVY = Tip(mass=0.2)
TIP = Tip(mass=0.2, inertia=0.05)
HUB = 0.1
"""Inertia of a hub, kg m^2."""
HOUSING, ROTOR = 0.2, 0.1
"""Mass on the elbow, kg; inertia of the motor's rotor at the joint, kg m^2."""
ROUNDING = 1e-12
"""Errors below it are none of a rule's."""
MOMENT = np.pi
"""On the tip, N m: the beam becomes half a circle."""

WEIGHTLESS = Link.model_construct(length=0.0, mass=0.0, inertia=0.0, center=0.5)
EMPTY = parse_scene("""
    name = "ends"
    [model]
    kind = "planar"
    [integrator]
    name = "newmark"
    step = 1e-3
    [base]
    kind = "clamp"
    [[joint]]
    stiffness = 1.0
    [[link]]
    length = 1.0
    mass = 1.0
    inertia = 0.1
    [[output]]
    name = "tip"
    at = "tip"
    of = "position"
""")


# -- cut beams ------------------------------------------------------------------------------------


def rod(member: Member, share: float) -> Link:
    """Return a rigid piece of a beam."""
    length, mass = share * member.length, share * member.mass_per_length * member.length
    return Link(length=length, mass=mass, inertia=mass * length**2 / 12.0, center=0.5)


def cut(member: Member, n: int, rule: Rule, root: Joint | None = None) -> list[Station]:
    """Return a beam on a clamp, or on a joint that turns; half a piece on a clamp stands still and is left out."""
    if rule == "clamped-segment" and root is None:
        pieces = n - 0.5
        k = member.bending_stiffness * pieces / member.length
        whole, half = rod(member, 1.0 / pieces), rod(member, 0.5 / pieces)
        links = [*[whole] * (n - 1), half]
        return list(zip([Joint(stiffness=2.0 * k), *[Joint(stiffness=k)] * (n - 1)], links, strict=True))
    k = member.bending_stiffness * n / member.length
    spring, whole = Joint(stiffness=k), rod(member, 1.0 / n)
    if rule == "half-clamp":
        # on a joint, the clamp is the joint's outer side, which weighs nothing
        side = [] if root is None else [(root, WEIGHTLESS)]
        return [*side, (Joint(stiffness=2.0 * k), whole), *[(spring, whole)] * (n - 1)]
    half = rod(member, 0.5 / n)
    side = [] if root is None else [(root, half)]
    return [*side, *[(spring, whole)] * (n - 1), (spring, half)]


def arm_of(stations: Sequence[Station], tip: Tip | None = None) -> Arm:
    """Return Lagrange's equations of some joints and links."""
    still = (0.0,) * len(stations)
    joints, links = zip(*stations, strict=True)
    return Arm(replace(EMPTY, joints=joints, links=links, tip=tip, initial=Initial(still, still)), {})


def frequencies(arm: Arm, angles: Array | None = None, welded: int | None = None, turning: int = 0) -> Array:
    """Return the lowest frequencies (rad/s) that bend the arm about a shape without tension.

    Parameters
    ----------
    arm : Arm
        The arm.
    angles : array, (n,), optional
        Its shape; by default straight.
    welded : int, optional
        Link that is one piece with the next.
    turning : int
        Motions in which nothing bends; they are left out.
    """
    n = len(arm.lengths)
    shape = np.zeros(n) if angles is None else angles
    held = np.eye(n)
    if welded is not None:
        held[:, welded] += held[:, welded + 1]
        held = np.delete(held, welded + 1, axis=1)
    mass = arm.coupling * np.cos(shape[:, None] - shape[None, :]) + arm.own_inertias
    stiffness, _ = arm.springs
    squares: Array = eigh(held.T @ stiffness @ held, held.T @ mass @ held, eigvals_only=True)
    found: Array = np.sqrt(squares[turning : turning + MODES])
    return found


# -- exact beams ----------------------------------------------------------------------------------


def roots(stiffness: Callable[[float], Array], near: Array) -> Array:
    """Return frequencies at which a dynamic stiffness is singular, one near each given, rad/s."""

    def determinant(omega: float) -> float:
        return float(np.linalg.det(stiffness(omega)))

    found = [brentq(determinant, *_bracket(determinant, start), xtol=1e-13 * start) for start in near]
    return np.array(found)


def _bracket(of: Callable[[float], float], start: float) -> tuple[float, float]:
    """Return the narrowest bracket about a start in which a function changes sign."""
    for width in np.geomspace(1e-5, 0.1, 17):
        low, high = start * (1.0 - width), start * (1.0 + width)
        if of(low) * of(high) < 0.0:
            return low, high
    raise ArithmeticError(f"no root near {start:g}")


def corner(omega: float) -> Array:
    """Return the dynamic stiffness of two beams at a right angle: across and turn of the corner, of the tip.

    Beams do not stretch: the corner moves across the inner beam only, and takes the outer one along as a mass.
    """
    s = np.array([1j * omega])
    found = np.zeros((4, 4))
    found[:2, :2] = dynamic_stiffness(INNER, s)[0, 2:, 2:].real
    found[0, 0] -= omega**2 * OUTER.mass_per_length * OUTER.length
    found[1:, 1:] += dynamic_stiffness(OUTER, s)[0, 1:, 1:].real
    return found


def elbow(omega: float) -> Array:
    """Return the dynamic stiffness of two beams with a motor between them."""
    arm = BeamArm((INNER, OUTER), bodies=(Body(HOUSING, 0.0, 0.0), Body(TIP.mass, TIP.inertia)))
    found: Array = arm.stiffness(1j * omega)[0].real
    sides = np.ix_([1, 2], [1, 2])
    found[sides] -= omega**2 * ROTOR * np.array([[1.0, -1.0], [-1.0, 1.0]])
    return found


# -- arms -----------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Case:
    """An arm, and what of it is compared.

    Parameters
    ----------
    name : str
        What it is.
    quantities : tuple of str
        What is found.
    found : callable
        From links and rule to values, (quantities,).
    exact : array, (quantities,)
        Those of the beam.
    scale : array, (quantities,)
        What errors are relative to.
    ends : str
        What sits on the outer ends: "nothing" that turns with them, or "something".
    """

    name: str
    quantities: tuple[str, ...]
    found: Callable[[int, Rule], Array]
    exact: Array
    scale: Array
    ends: str


FREQUENCIES = tuple(f"mode {mode + 1}" for mode in range(MODES))


def clamped(n: int, rule: Rule, tip: Tip | None = None) -> Array:
    """Return the frequencies of a beam on a clamp."""
    return frequencies(arm_of(cut(INNER, n, rule), tip))


def turned(n: int, rule: Rule, tip: Tip | None = None) -> Array:
    """Return the frequencies of a beam on a hub that turns; a spring at the root makes it a link of its own."""
    hub = Joint(stiffness=0.0, rotor_inertia=HUB)
    if rule == "clamped-segment":
        return frequencies(arm_of([(hub, WEIGHTLESS), *cut(INNER, n, rule)], tip), turning=1)
    return frequencies(arm_of(cut(INNER, n, rule, hub), tip), turning=1)


def cornered(n: int, rule: Rule) -> Array:
    """Return the frequencies of two beams at a right angle."""
    inner = cut(INNER, n, rule)
    if rule != "finite-segment":
        outer = cut(OUTER, n, rule)
        return frequencies(arm_of(inner + outer), np.repeat([0.0, np.pi / 2.0], [n, n]))
    outer = cut(OUTER, n, rule, Joint(stiffness=0.0))
    return frequencies(arm_of(inner + outer), np.repeat([0.0, np.pi / 2.0], [n, n + 1]), welded=n - 1)


def driven(n: int, rule: Rule) -> Array:
    """Return the frequencies of two beams with a motor between them, and a body that has inertia at the tip."""
    inner = cut(INNER, n, rule)
    joint, end = inner[-1]
    carried = joined(end, Link.model_construct(length=0.0, mass=HOUSING, inertia=0.0, center=0.0))
    outer = cut(OUTER, n, rule, Joint(stiffness=0.0, rotor_inertia=ROTOR))
    return frequencies(arm_of([*inner[:-1], (joint, carried), *outer], TIP), turning=1)


def rolled(n: int, rule: Rule) -> Array:
    """Return the tip's angle (rad) and place (m) under a torque on it, however far the beam bends."""
    arm = arm_of(cut(INNER, n, rule))
    stiffness, _ = arm.joints
    angles = np.cumsum(MOMENT / stiffness)
    held = INNER.length - arm.lengths.sum()
    return np.array([angles[-1], held + arm.lengths @ np.cos(angles), arm.lengths @ np.sin(angles)])


def cases() -> tuple[Case, ...]:
    """Return all arms with their exact values."""
    radius = 1.0 / MOMENT
    circle = np.array([MOMENT, radius * np.sin(MOMENT), radius * (1.0 - np.cos(MOMENT))])
    found = [
        *(_single(base, tip) for base in ("clamp", "hub") for tip in (None, HEAVY, TIP)),
        (
            "two beams at a right angle",
            "something",
            cornered,
            roots(corner, cornered(128, "finite-segment")),
        ),
        ("two beams, motor between", "something", driven, roots(elbow, driven(128, "finite-segment"))),
    ]
    return (
        *(Case(name, FREQUENCIES, of, exact, exact, ends) for name, ends, of, exact in found),
        Case(
            "clamp, rolled up to half a circle by a torque on the tip",
            ("tip angle", "tip place, x", "tip place, y"),
            rolled,
            circle,
            np.array([MOMENT, INNER.length, INNER.length]),
            "something",
        ),
    )


def _single(base: str, tip: Tip | None) -> tuple[str, str, Callable[[int, Rule], Array], Array]:
    """Return name, what turns with the end, links' and exact frequencies of one beam."""
    inertia = tip is not None and tip.inertia > 0.0
    name = base if tip is None else f"{base}, tip with inertia" if inertia else f"{base}, tip mass"
    bodies = () if tip is None else (Body(tip.mass, tip.inertia),)
    hub = base == "hub"
    arm = BeamArm((INNER,), BeamBase("hub", HUB) if hub else BeamBase(), bodies)
    exact = natural_frequencies(arm, MODES + hub)[int(hub) :]
    return (
        name,
        "something" if inertia else "nothing",
        partial(turned if hub else clamped, tip=tip),
        exact,
    )


def rows_of(case: Case) -> list[dict[str, object]]:
    """Measure one arm."""
    errors = {
        rule: np.array([np.abs(case.found(n, rule) - case.exact) / case.scale for n in LINKS])
        for rule in RULES
    }
    rows: list[dict[str, object]] = []
    for place, quantity in enumerate(case.quantities):
        row: dict[str, object] = {"arm": case.name, "quantity": quantity, "ends": case.ends}
        for rule in RULES:
            found = errors[rule][:, place]
            row |= {f"{rule}_{n}": float(error) for n, error in zip(LINKS, found, strict=True)}
            row[f"{rule}_order"] = order(found)
        rows.append(row)
    return rows


def order(errors: Array) -> float:
    """Return the order fitted from the second number of links on; NaN where errors are rounding, or change sign."""
    behind = errors[1:]
    if np.max(errors) < ROUNDING or np.any(np.diff(behind) > 0.0):
        return float("nan")
    return -float(np.polyfit(np.log(LINKS[1:]), np.log(behind), 1)[0])


def page(rows: list[dict[str, object]]) -> str:
    """Return the table of docs/modes.md."""
    heads = ["arm", "", *(head for rule in RULES for head in (f"`{rule}`", "order"))]
    lines = [heads, ["---", "---", *["---", "---:"] * len(RULES)]]
    last = ""
    for row in rows:
        cells = [str(row["arm"]) if row["arm"] != last else "", str(row["quantity"])]
        last = str(row["arm"])
        for rule in RULES:
            errors = [float(str(row[f"{rule}_{n}"])) for n in LINKS]
            fitted = float(str(row[f"{rule}_order"]))
            cells.append("exact" if max(errors) < ROUNDING else " ".join(f"{error:.1e}" for error in errors))
            cells.append("" if np.isnan(fitted) else f"{fitted:.2f}")
        lines.append(cells)
    text = "\n".join(f"| {' | '.join(cells)} |" for cells in lines)
    loaded, of_loaded = _better(rows, "something")
    plain, of_plain = _better(rows, "nothing")
    return (
        f"{text}\n\nOf the {of_loaded} frequencies of arms whose beams carry something that turns with their ends,\n"
        f"`finite-segment` has a smaller error than `half-clamp` in {loaded[0]}, `clamped-segment` in {loaded[1]}; of\n"
        f"the {of_plain} others, with a mass or nothing there, in {plain[0]} and {plain[1]}."
    )


def _better(rows: list[dict[str, object]], ends: str) -> tuple[list[int], int]:
    """Return in how many frequencies each segment rule is better than `half-clamp`, and how many there are."""
    bending = [
        [float(str(row[f"{rule}_{n}"])) for rule in RULES]
        for row in rows
        for n in LINKS
        if row["quantity"] in FREQUENCIES and row["ends"] == ends
    ]
    return [sum(each[place] < each[0] for each in bending) for place in (1, 2)], len(bending)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--out", type=Path, default=Path("out/bench"))
    parser.add_argument("--update", action="store_true", help="write the table into docs/modes.md")
    given = parser.parse_args()
    rows = [row for case in cases() for row in rows_of(case)]
    columns: list[Column | str] = ["arm", "quantity"]
    for rule in RULES:
        columns += [Column(f"{rule}_{n}", f"{rule} {n}", ".1e") for n in LINKS]
        columns.append(Column(f"{rule}_order", "order", ".2f"))
    table(rows, columns, title="relative errors against the exact beam")
    write_whole(given.out / "segment_ends.csv", csv_text(rows))
    if given.update:
        write_whole(PAGE, renewed(PAGE.read_text(), page(rows), "segment_ends.py"))


if __name__ == "__main__":
    main()

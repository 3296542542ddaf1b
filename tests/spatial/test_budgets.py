"""What one more joint costs in a step of an arm in space, exactly: ends of the arm do not count."""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cache
from itertools import pairwise

import pytest
from support.spatial.beams import Beam, add_beam
from support.spatial.kernels import program_of

from tmm_gen.program.count import count_routine
from tmm_gen.program.space.assemble import SpaceChoices
from tmm_gen.scene.spatial.arm import FreeBase, Revolute, RigidBody, SpatialArm, Turn

BEAM = Beam(1.0, (2.0, 5.0), 0.8, 1.0, 2e-4, decay=1e-3)
BODY = RigidBody(1.0, (0.1, 0.02, 0.03), (0.01, 0.02, 0.03, 0.001, 0.002, 0.003))
QUARTER: Turn = ((1.0, 0.0, 0.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0))
"""About x."""


def beam(cells: int, joints_of_a_cell: int) -> SpatialArm:
    """Return a beam under gravity whose cells bend about two axes, or about two and twist."""
    joints: list[Revolute] = []
    add_beam(joints, BEAM, cells, twists=joints_of_a_cell == 3)
    return SpatialArm(tuple(joints), gravity=(0.0, 0.0, -9.81))


def links(count: int, turn: Turn) -> SpatialArm:
    """Return rigid links with any offset and any inertia, quarter turns between them, springs, dampers, rotors."""
    return SpatialArm(
        tuple(
            Revolute(f"joint_{k + 1}", k, (0.3, 0.1, 0.2), turn, 2, BODY, 5.0, 0.1, armature=0.1)
            for k in range(count)
        ),
        gravity=(0.0, 0.0, -9.81),
    )


def row(count: int) -> SpatialArm:
    """Return links that all turn about one axis, whose masses lie off their joints but in one plane."""
    body = RigidBody(1.0, (0.1, 0.0, 0.0), (0.01, 0.02, 0.03, 0.0, 0.0, 0.0))
    return SpatialArm(
        tuple(
            Revolute(f"joint_{k + 1}", k, (0.3, 0.0, 0.0), axis=2, body=body, stiffness=5.0, damping=0.1)
            for k in range(count)
        ),
        gravity=(0.0, -9.81, 0.0),
    )


@dataclass(frozen=True)
class Cost:
    """Operations per joint and Newmark step, and what they should not exceed.

    Parameters
    ----------
    first, correction, exact : Fraction
        Of a step of one inertial sweep that predicts no acceleration, of each correction, of a step of one exact
        sweep.
    budgets : tuple of int
        For each of the three.
    """

    first: Fraction
    correction: Fraction
    exact: Fraction
    budgets: tuple[int, int, int]


COSTS = {
    "bend, bend": Cost(Fraction(491, 2), Fraction(235, 2), Fraction(637), (290, 120, 710)),
    "bend, bend, twist": Cost(Fraction(685, 3), Fraction(319, 3), Fraction(1784, 3), (270, 110, 668)),
    "link": Cost(Fraction(446), Fraction(237), Fraction(1118), (511, 240, 1147)),
    "planar": Cost(Fraction(110), Fraction(66), Fraction(198), (133, 67, 212)),
}
"""Of the last nothing turns out of its plane, and nothing is computed of what would."""


def arm_of(kind: str, cells: int) -> SpatialArm:
    """Return the arm of a kind."""
    if kind == "planar":
        return row(cells)
    return links(cells, QUARTER) if kind == "link" else beam(cells, len(kind.split(",")))


@cache
def operations(kind: str, cells: int, choices: SpaceChoices, base: FreeBase | None = None) -> int:
    """Return what a step of an arm takes on a clamp, or on a base that floats."""
    return count_routine(program_of(replace(arm_of(kind, cells), base=base), choices=choices).main).total


def per_joint(kind: str, choices: SpaceChoices) -> Fraction:
    """Return the operations of a step per joint between 10 and 20 cells."""
    few, many = (operations(kind, cells, choices) for cells in (10, 20))
    joints = [len(arm_of(kind, cells).joints) for cells in (10, 20)]
    return Fraction(many - few, joints[1] - joints[0])


@pytest.mark.parametrize("kind", COSTS)
def test_inertial_step(kind: str) -> None:
    first = per_joint(kind, SpaceChoices(1e-3, iterations=1))
    assert first == COSTS[kind].first
    assert first <= COSTS[kind].budgets[0]


@pytest.mark.parametrize("kind", COSTS)
def test_each_correction(kind: str) -> None:
    """The second one costs what the first one does."""
    steps = [per_joint(kind, SpaceChoices(1e-3, iterations=sweeps)) for sweeps in (1, 2, 3)]
    assert [more - less for less, more in pairwise(steps)] == [COSTS[kind].correction] * 2
    assert COSTS[kind].correction <= COSTS[kind].budgets[1]


@pytest.mark.parametrize("kind", COSTS)
def test_exact_step(kind: str) -> None:
    exact = per_joint(kind, SpaceChoices(1e-3, iterations=1, exact=True))
    assert exact == COSTS[kind].exact
    assert exact <= COSTS[kind].budgets[2]


PRODUCTS = {
    "bend, bend": Fraction(31),
    "bend, bend, twist": Fraction(31),
    "link": Fraction(31),
    "planar": Fraction(10),
}
"""What plain products take more to turn an inertia about its joint, which single precision keeps."""


@pytest.mark.parametrize("kind", PRODUCTS)
def test_turns_of_single_precision(kind: str) -> None:
    single, double = (
        per_joint(kind, SpaceChoices(1e-3, iterations=1, single=single)) for single in (True, False)
    )
    assert single - double == PRODUCTS[kind]


@pytest.mark.parametrize("kind", COSTS)
def test_newest_acceleration_costs_little(kind: str) -> None:
    """Predicting with it instead of with none takes up to four operations a joint; in a plane, where few are, eight."""
    none, newest = (per_joint(kind, SpaceChoices(1e-3, iterations=1, held=held)) for held in (False, True))
    assert 0 < newest - none <= (8 if kind == "planar" else 4)


DIRECTIONS = {"bend, bend": (494, 589), "link": (814, 942)}
"""Per joint of a step with one correction: that which keeps what its slopes are, once, and each direction of its
tangent."""


@pytest.mark.parametrize("kind", DIRECTIONS)
def test_tangents(kind: str) -> None:
    """The factors of the sweep are differentiated too, and so a direction takes about two steps."""
    choices = SpaceChoices(1e-3, iterations=2, sensitivities=True)
    few, many = (program_of(arm_of(kind, cells), choices=choices).sensitivities for cells in (10, 20))
    assert few is not None
    assert many is not None
    joints = [len(arm_of(kind, cells).joints) for cells in (10, 20)]
    for found, right in zip(("linearise", "tangent"), DIRECTIONS[kind], strict=True):
        counts = [count_routine(getattr(each, found)).total for each in (few, many)]
        assert Fraction(counts[1] - counts[0], joints[1] - joints[0]) == right


FLOATS = {
    "bend, bend": (966, 585, 2601),
    "link": (1146, 686, 3005),
}
"""What a step takes more where the base is a body that floats instead of a clamp: one inertial sweep without any
acceleration predicted, each correction, one exact sweep. The first joint's share, which a clamp spares, is in it."""


@pytest.mark.parametrize("kind", FLOATS)
def test_a_base_that_floats(kind: str) -> None:
    """However long the arm is."""
    once, twice, exact = (
        SpaceChoices(1e-3, iterations=1),
        SpaceChoices(1e-3, iterations=2),
        SpaceChoices(1e-3, iterations=1, exact=True),
    )
    for cells in (10, 20):
        more = [
            operations(kind, cells, choices, FreeBase(BODY)) - operations(kind, cells, choices)
            for choices in (once, twice, exact)
        ]
        assert (more[0], more[1] - more[0], more[2]) == FLOATS[kind]


FLOATS_AT_ONCE = (3166, 1690)
"""The same of `gauss2` on general links: one iteration, and each further one."""


def test_a_base_that_floats_where_stages_are_solved_at_once() -> None:
    def taken(iterations: int, base: FreeBase | None) -> int:
        arm = replace(links(4, QUARTER), base=base)
        return count_routine(program_of(arm, "gauss2", SpaceChoices(1e-3, iterations=iterations)).main).total

    once, twice = (taken(count, FreeBase(BODY)) - taken(count, None) for count in (1, 2))
    assert (once, twice - once) == FLOATS_AT_ONCE


def geared(count: int, *, elastic: bool) -> SpatialArm:
    """Return general links on motors, with a gear each that is rigid or not."""
    joints: list[Revolute] = []
    for k in range(count):
        host = len(joints)
        motor = Revolute(f"motor_{k}", host, (0.3, 0.1, 0.2), QUARTER, 2, damping=0.1, armature=0.1)
        gear = Revolute(f"gear_{k}", host + 1, axis=2, body=BODY, stiffness=5.0, damping=0.1)
        joints += [motor, gear] if elastic else [replace(motor, body=BODY)]
    return SpatialArm(tuple(joints), gravity=(0.0, 0.0, -9.81))


@pytest.mark.parametrize(
    ("more", "choices"),
    [
        (24, SpaceChoices(1e-3, iterations=1)),
        (24 + 11, SpaceChoices(1e-3, iterations=2)),
    ],
    ids=["sweep", "correction"],
)
def test_an_elastic_gear(more: int, choices: SpaceChoices) -> None:
    """Over a rigid one as much as in a plane, where a step has one sweep.

    Joints near the base cost less: some of their motion is zero yet.
    """
    rigid, elastic = (
        [
            count_routine(program_of(geared(count, elastic=way), choices=choices).main).total
            for count in (5, 6)
        ]
        for way in (False, True)
    )
    assert elastic[1] - elastic[0] == rigid[1] - rigid[0] + more

"""Rules that cut a beam into links and joints."""

from __future__ import annotations

import math
import re
from fractions import Fraction

import pytest
import sympy
from hypothesis import example, given, settings
from hypothesis import strategies as st

from tmm_gen.emit.c import emit_kernel
from tmm_gen.emit.numpy import emit_numpy
from tmm_gen.program.build import build_program
from tmm_gen.scene import parse_scene
from tmm_gen.scene.beam import Beam, Springs, beam_joints, beam_links, finite_segments
from tmm_gen.scene.station import Link

RULES: tuple[Springs, ...] = ("clamped-segment", "half-clamp", "uniform", "thesis")
SECOND_ORDER = ("clamped-segment", "half-clamp")


def beam(links: int, springs: Springs = "half-clamp", damping_time: float = 0.0) -> Beam:
    return Beam(
        length=2.0,
        bending_stiffness=3.0,
        mass_per_length=0.5,
        links=links,
        springs=springs,
        damping_time=damping_time,
    )


def pieces(links: int, springs: Springs) -> Fraction:
    """How many whole pieces a beam makes."""
    return links - Fraction(1, 2) if springs == "clamped-segment" else Fraction(links)


def stiffnesses_of(made: Beam) -> tuple[float, ...]:
    """Stiffnesses of a beam's joints, base to tip."""
    return tuple(joint.stiffness for joint in beam_joints(made))


def tip_deflection(made: Beam) -> float:
    """Static deflection of the tip under a unit force across it, small: each joint bends by moment over k."""
    links = beam_links(made)
    arms = [sum(link.length for link in links[i:]) for i in range(len(links))]
    return sum(arm**2 / k for arm, k in zip(arms, stiffnesses_of(made), strict=True))


@pytest.mark.parametrize(
    ("springs", "links", "expected"),
    [
        # In units of EI/l, which is 3 n/2 where n pieces are alike.
        # Gholampour (2018), eqs. 2-1, 2-2 at n = 10: (480 - 72)/(420 - 71).
        ("thesis", 10, [Fraction(8, 9), Fraction(408, 349), *[1] * 8]),
        ("thesis", 3, [Fraction(8, 9), Fraction(72, 55), 1]),
        ("thesis", 2, [Fraction(8, 9), Fraction(24, 13)]),
        ("thesis", 1, [Fraction(8, 9)]),
        ("clamped-segment", 4, [2, 1, 1, 1]),
        ("clamped-segment", 1, [2]),
        ("half-clamp", 4, [2, 1, 1, 1]),
        ("half-clamp", 1, [2]),
        ("uniform", 3, [1, 1, 1]),
    ],
)
def test_stiffnesses(springs: Springs, links: int, expected: list[Fraction]) -> None:
    unit = Fraction(3, 2) * pieces(links, springs)
    assert stiffnesses_of(beam(links, springs)) == pytest.approx([float(unit * k) for k in expected])


@given(links=st.integers(1, 200), springs=st.sampled_from(RULES))
def test_every_rule_gives_positive_springs_that_tend_to_the_continuous_ones(
    links: int, springs: Springs
) -> None:
    stiffnesses = stiffnesses_of(beam(links, springs))
    assert len(stiffnesses) == links
    unit = float(3 * pieces(links, springs) / 2)
    assert all(0.5 * unit < k <= 2.0 * unit for k in stiffnesses)


@pytest.mark.parametrize("springs", RULES)
def test_static_deflection_converges_to_the_continuous_beam(springs: Springs) -> None:
    exact = 2.0**3 / (3.0 * 3.0)  # F L^3/(3 E I)
    errors = [abs(tip_deflection(beam(n, springs)) / exact - 1.0) for n in (10, 20, 40, 80)]
    order = math.log2(errors[-2] / errors[-1])
    assert order == pytest.approx(2.0 if springs in SECOND_ORDER else 1.0, abs=0.1)
    assert errors[-1] < (1e-4 if springs in SECOND_ORDER else 0.03)


@given(links=st.integers(1, 100))
def test_segments_have_all_of_a_beams_flexibility_under_a_moment(links: int) -> None:
    """A torque on the tip turns it by M L/(E I), whatever the number of links."""
    clamped = stiffnesses_of(beam(links, "clamped-segment"))
    finite = [joint.stiffness for joint in finite_segments(beam(links))[0]]
    for stiffnesses in (clamped, finite):
        assert sum(1.0 / k for k in stiffnesses) == pytest.approx(2.0 / 3.0)


@given(links=st.integers(1, 100), springs=st.sampled_from(RULES))
def test_mass_length_and_rotary_inertia_are_those_of_rods(links: int, springs: Springs) -> None:
    made = beam_links(beam(links, springs))
    assert len(made) == links
    check_rods(made)
    joints, segments = finite_segments(beam(links, springs))
    assert (len(joints), len(segments)) == (links, links + 1)
    check_rods(segments)


def check_rods(links: tuple[Link, ...]) -> None:
    assert sum(link.mass for link in links) == pytest.approx(1.0)
    assert sum(link.length for link in links) == pytest.approx(2.0)
    # Moment of inertia about the clamp of the straight arm: m L^2/3, exactly, for any n.
    about_base = inner = 0.0
    for link in links:
        about_base += link.inertia + link.mass * (inner + link.center * link.length) ** 2
        inner += link.length
    assert about_base == pytest.approx(1.0 * 2.0**2 / 3.0)


@pytest.mark.parametrize("springs", RULES)
def test_damping_is_proportional_to_stiffness(springs: Springs) -> None:
    for joint in beam_joints(beam(7, springs, damping_time=0.002)):
        assert joint.damping == pytest.approx(0.002 * joint.stiffness)


DECIMALS = st.tuples(st.integers(1, 9999), st.integers(0, 3)).map(
    lambda pair: f"{pair[0] / 10 ** pair[1]:.{pair[1]}f}"
)


@given(
    ei=DECIMALS,
    length=DECIMALS,
    mass=DECIMALS,
    time=DECIMALS,
    links=st.integers(1, 60),
    springs=st.sampled_from(RULES),
)
@example(ei="3.45", length="1.0", mass="0.3", time="0.002", links=10, springs="uniform")
def test_what_is_printed_is_the_shortest_decimal_of_the_exact_value(
    ei: str, length: str, mass: str, time: str, links: int, springs: Springs
) -> None:
    """EI = 3.45 in ten links of 0.1 m is 34.5 N m/rad, not the 34.49999999999999 that floats make of it."""
    made = Beam(
        length=float(length),
        bending_stiffness=float(ei),
        mass_per_length=float(mass),
        links=links,
        springs=springs,
        damping_time=float(time),
    )
    unit = Fraction(ei) * pieces(links, springs) / Fraction(length)
    first = (
        Fraction(2)
        if springs in SECOND_ORDER
        else {"uniform": Fraction(1), "thesis": Fraction(8, 9)}[springs]
    )
    factors = [first, *[Fraction(1)] * (links - 1)]
    if springs == "thesis" and links > 1:
        factors[1] = Fraction(48 * links - 72, 42 * links - 71)
    for joint, factor in zip(beam_joints(made), factors, strict=True):
        assert is_shortest(joint.stiffness, factor * unit)
        assert is_shortest(joint.damping, factor * unit * Fraction(time))
    whole = Fraction(length) / pieces(links, springs)
    lengths = [whole] * links
    if springs == "clamped-segment":
        lengths[-1] /= 2
    for link, exact in zip(beam_links(made), lengths, strict=True):
        assert is_shortest(link.length, exact)
        assert is_shortest(link.mass, Fraction(mass) * exact)
        assert is_shortest(link.inertia, Fraction(mass) * exact**3 / 12)


def is_shortest(value: float, exact: Fraction) -> bool:
    """Whether a number is printed as the exact one, or is the nearest where that has more digits than numbers keep."""
    printed = Fraction(repr(value))
    return printed == exact or (
        not keeps(exact) and abs(Fraction(value) - exact) <= Fraction(math.ulp(value)) / 2
    )


def keeps(exact: Fraction) -> bool:
    """Whether a fraction is a decimal of at most 15 digits: every such survives the way into a float and back."""
    if set(sympy.factorint(exact.denominator)) - {2, 5}:
        return False
    digits = exact
    while digits.denominator != 1:
        digits *= 10
    return len(str(digits.numerator).rstrip("0")) <= 15


@settings(max_examples=5, deadline=None)
@given(ei=DECIMALS, length=DECIMALS, links=st.integers(2, 12))
@example(ei="3.45", length="1.0", links=10)
def test_kernels_print_the_shortest_decimal(ei: str, length: str, links: int) -> None:
    scene = parse_scene(
        'name = "beam"\n[model]\nkind = "planar"\n[integrator]\nname = "newmark"\nstep = 1e-3\n[base]\nkind = "clamp"\n'
        f"[beam]\nlength = {length}\nbending_stiffness = {ei}\nmass_per_length = 0.5\nlinks = {links}\n"
        'springs = "uniform"\n[[output]]\nname = "tip"\nat = "tip"\nof = "position"\n'
    )
    exact = Fraction(ei) * links / Fraction(length)
    texts = emit_kernel(build_program(scene), scene)
    for text in (texts["c/beam.c"], emit_numpy(build_program(scene), scene)["kernel.py"]):
        printed = re.findall(r"\bstiffness(?:|: ArrayLike) = ([0-9.e+-]+)[;\n]", text)
        assert printed
        assert all(is_shortest(float(number), exact) and number == repr(float(number)) for number in printed)

"""Arms of stiff and soft parts: digits must not depend on the ratio, nor decisions on the last bits."""

from __future__ import annotations

import os
import subprocess
import sys

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tmm_gen.modal.beam import BeamArm, BeamBase, Body, Member, modes_below, natural_frequencies
from tmm_gen.modal.beam.counting import rigid_motions

HALVES = (Member(0.5, 1.0, 1.0),) * 2
DECADES = [10.0**k for k in range(7, 15)]


@pytest.mark.parametrize("stiffness", [*DECADES, 1e100, 1e300])
def test_a_joint_that_is_all_but_rigid(stiffness: float) -> None:
    """A cantilever with a spring in its middle: 3.516015 less what the spring gives way, first order in 1/k."""
    found = natural_frequencies(BeamArm(HALVES, bodies=(Body(joint_stiffness=stiffness), Body())), 2)
    exact = np.array([1.8751040687119612, 4.694091132974175]) ** 2
    np.testing.assert_allclose(found, exact, rtol=3.0 / stiffness + 1e-13)


@pytest.mark.parametrize("stiffness", [1e-3, 1e-7, 1e-14, 1e-40])
def test_a_joint_that_is_all_but_free(stiffness: float) -> None:
    """The outer half turns about the hinge as a rigid rod, w^2 = k / (m L^2 / 3)."""
    found = natural_frequencies(BeamArm(HALVES, bodies=(Body(joint_stiffness=stiffness), Body())), 1)
    assert found[0] == pytest.approx(np.sqrt(stiffness / (0.5**3 / 3.0)), rel=stiffness + 1e-12)


def test_free_motions_are_told_from_the_joints_there_are() -> None:
    for hub in (0.0, 1e-300, 1e-9, 1.0):
        for joints in ((0.0, 0.0), (0.0, 1e-300), (1e-12, None), (None, 0.0), (1e300, 1e300)):
            bodies = (*(Body(joint_stiffness=joint) for joint in joints), Body(joint_stiffness=0.0))
            arm = BeamArm((Member(0.3, 1.0, 1.0),) * 3, BeamBase("hub", stiffness=hub), bodies)
            # behind the last beam there is nothing a joint could let turn
            assert rigid_motions(arm) == (hub == 0.0) + sum(joint == 0.0 for joint in joints)


def decades(low: float, high: float) -> st.SearchStrategy[float]:
    """Numbers as often in one decade as in another."""
    return st.floats(low, high).map(lambda power: 10.0**power)


members = st.builds(Member, st.floats(0.2, 2.0), decades(-7, 7), st.floats(0.3, 3.0))
joints = st.one_of(st.none(), st.just(0.0), decades(-7, 7))
bodies = st.builds(Body, st.one_of(st.just(0.0), decades(-3, 3)), st.just(0.0), joints)
bases = st.one_of(st.just(BeamBase()), st.builds(BeamBase, st.just("hub"), decades(-3, 3)))


@st.composite
def arms(draw: st.DrawFn) -> BeamArm:
    count = draw(st.integers(1, 3))
    beams = tuple(draw(members) for _ in range(count))
    return BeamArm(beams, draw(bases), tuple(draw(bodies) for _ in range(count)))


@given(arms())
@settings(max_examples=12, deadline=None)
def test_each_frequency_is_a_root_of_the_determinant(arm: BeamArm) -> None:
    found = natural_frequencies(arm, rigid_motions(arm) + 4)
    assert np.all(found[: rigid_motions(arm)] == 0.0)
    swinging = found[rigid_motions(arm) :]
    assert np.all(np.diff(swinging) > 0.0)
    with mpmath.workdps(60):
        for omega in swinging:
            below, above = (determinant(arm, mpmath.mpf(omega) * (1 + side)) for side in (-1e-9, 1e-9))
            assert below * above < 0


@given(arms())
@settings(max_examples=8, deadline=None)
def test_none_is_missed(arm: BeamArm) -> None:
    """Ritz's frequencies are never below the exact ones, so no exact one is left out."""
    rigid = rigid_motions(arm)
    found = natural_frequencies(arm, rigid + 3)
    for one, ritz in zip(found[rigid:], ritz_frequencies(arm)[rigid:], strict=False):
        assert one <= ritz * (1 + 1e-9)


@pytest.mark.long
@given(arms(), st.floats(-6, 6))
@settings(max_examples=12, deadline=None)
def test_other_units_change_no_count(arm: BeamArm, power: float) -> None:
    """Masses and stiffnesses times a number that is no power of two: every last bit is another."""
    scale = 10.0**power
    scaled = BeamArm(
        tuple(Member(m.length, scale * m.bending_stiffness, scale * m.mass_per_length) for m in arm.members),
        BeamBase(arm.base.kind, scale * arm.base.inertia),
        tuple(
            Body(scale * b.mass, 0.0, None if b.joint_stiffness is None else scale * b.joint_stiffness)
            for b in arm.bodies
        ),
    )
    one, other = natural_frequencies(arm, 4), natural_frequencies(scaled, 4)
    np.testing.assert_allclose(other, one, rtol=1e-9)
    between = 0.5 * (one[:-1] + one[1:])
    np.testing.assert_array_equal(modes_below(arm, between), modes_below(scaled, between))


@pytest.mark.parametrize("kernels", ["Prescott", "Haswell", "SkylakeX"])
def test_other_processors_find_the_same(kernels: str) -> None:
    """OpenBLAS for other processors rounds otherwise; one that this machine cannot run falls back to its own."""
    program = (
        "from tmm_gen.modal.beam import *\n"
        "for k in range(7, 15):\n"
        "    arm = BeamArm((Member(0.5, 1, 1),) * 2, bodies=(Body(joint_stiffness=10.0**k), Body()))\n"
        "    print(*natural_frequencies(arm, 2))\n"
    )
    ran = subprocess.run(
        [sys.executable, "-c", program],
        env={**os.environ, "OPENBLAS_CORETYPE": kernels},
        capture_output=True,
        text=True,
        check=False,
    )
    if ran.returncode < 0:
        pytest.skip(f"this processor has not the instructions of {kernels}")
    assert ran.stderr == ""
    found = np.array([line.split() for line in ran.stdout.splitlines()], float)
    np.testing.assert_allclose(found, [[3.516015, 22.03449]] * 8, rtol=2e-7)


def determinant(arm: BeamArm, omega: mpmath.mpf) -> mpmath.mpf:
    """Return what vanishes at a natural frequency: two motions from the base, carried to the tip, leave no force.

    The columns are ``(w, psi, M, V)`` of the unknowns at the base, and of one more for each joint's twist; the rows
    are the forces at the tip and the law of each joint.
    """
    square = omega**2
    if arm.base.kind == "hub":
        start = [[0, 1, -arm.base.inertia * square + arm.base.stiffness, 0], [0, 0, 0, 1]]
    else:
        start = [[0, 0, 1, 0], [0, 0, 0, 1]]
    columns = [[mpmath.mpf(value) for value in column] for column in start]
    laws: list[list[mpmath.mpf]] = []
    for k, (member, body) in enumerate(zip(arm.members, arm.bodies, strict=True)):
        columns = [carried(member, square, column) for column in columns]
        for column in columns:
            column[2] -= mpmath.mpf(body.inertia) * square * column[1]
            column[3] -= mpmath.mpf(body.mass) * square * column[0]
        if body.joint_stiffness is not None and k + 1 < len(arm.members):
            # M = k twist, the twist one more unknown
            laws.append([column[2] for column in columns] + [-mpmath.mpf(body.joint_stiffness)])
            columns.append([mpmath.mpf(0), mpmath.mpf(1), mpmath.mpf(0), mpmath.mpf(0)])
    rows = [[column[part] for column in columns] for part in (2, 3)]
    rows += [law + [mpmath.mpf(0)] * (len(columns) - len(law)) for law in laws]
    return mpmath.det(mpmath.matrix(rows))


def carried(member: Member, square: mpmath.mpf, state: list[mpmath.mpf]) -> list[mpmath.mpf]:
    """Return the state at the outer end by Krylov's functions: w' = psi, EI psi' = M, M' = -V, V' = -rho A w^2 w."""
    stiffness, length = mpmath.mpf(member.bending_stiffness), mpmath.mpf(member.length)
    beta = (mpmath.mpf(member.mass_per_length) * square / stiffness) ** mpmath.mpf("0.25")
    x = beta * length
    c, s, ch, sh = mpmath.cos(x), mpmath.sin(x), mpmath.cosh(x), mpmath.sinh(x)
    krylov = [(ch + c) / 2, (sh + s) / 2, (ch - c) / 2, (sh - s) / 2]
    # derivatives of w at the inner end, over beta each
    w, psi, moment, shear = state
    begun = [w, psi / beta, moment / stiffness / beta**2, -shear / stiffness / beta**3]
    ended = [sum((begun[i] * krylov[(i - d) % 4] for i in range(4)), mpmath.mpf(0)) for d in range(4)]
    return [ended[0], ended[1] * beta, ended[2] * stiffness * beta**2, -ended[3] * stiffness * beta**3]


def ritz_frequencies(arm: BeamArm, pieces: int = 3) -> list[float]:
    """Return upper bounds by cubic elements (Hermite), whose matrices are in every textbook, in 40 digits."""
    with mpmath.workdps(40):
        ends: list[tuple[tuple[int, int], tuple[int, int]]] = []
        base = (-1, 0 if arm.base.kind == "hub" else -1)
        here, count = base, base[1] + 1
        for body in arm.bodies:
            for _ in range(pieces):
                ends.append((here, (count, count + 1)))
                here, count = (count, count + 1), count + 2
            if body.joint_stiffness is not None:
                here, count = (here[0], count), count + 1
        stiffness, mass = mpmath.zeros(count), mpmath.zeros(count)
        for k, body in enumerate(arm.bodies):
            own = ends[k * pieces : (k + 1) * pieces]
            for inner, outer in own:
                add(stiffness, mass, arm.members[k], pieces, [*inner, *outer])
            at = own[-1][1]
            mass[at[0], at[0]] += body.mass
            if body.joint_stiffness is not None and k + 1 < len(arm.bodies):
                other = ends[(k + 1) * pieces][0][1]
                for one, two, sign in (
                    (at[1], at[1], 1),
                    (other, other, 1),
                    (at[1], other, -1),
                    (other, at[1], -1),
                ):
                    stiffness[one, two] += sign * mpmath.mpf(body.joint_stiffness)
        if arm.base.kind == "hub":
            mass[0, 0] += arm.base.inertia
        size = count - (arm.bodies[-1].joint_stiffness is not None)
        root = mpmath.cholesky(mass[:size, :size]) ** -1
        squares = mpmath.eigsy(root * stiffness[:size, :size] * root.T, eigvals_only=True)
        return sorted(float(mpmath.sqrt(max(square, mpmath.mpf(0)))) for square in squares)


def add(
    stiffness: mpmath.matrix, mass: mpmath.matrix, member: Member, pieces: int, places: list[int]
) -> None:
    h = mpmath.mpf(member.length) / pieces
    bending = mpmath.mpf(member.bending_stiffness) / h**3
    weight = mpmath.mpf(member.mass_per_length) * h / 420
    k = [[12, 6 * h, -12, 6 * h], [6 * h, 4 * h**2, -6 * h, 2 * h**2]]
    k += [[-12, -6 * h, 12, -6 * h], [6 * h, 2 * h**2, -6 * h, 4 * h**2]]
    m = [[156, 22 * h, 54, -13 * h], [22 * h, 4 * h**2, 13 * h, -3 * h**2]]
    m += [[54, 13 * h, 156, -22 * h], [-13 * h, -3 * h**2, -22 * h, 4 * h**2]]
    for i, row in enumerate(places):
        for j, column in enumerate(places):
            if row >= 0 and column >= 0:
                stiffness[row, column] += bending * k[i][j]
                mass[row, column] += weight * m[i][j]

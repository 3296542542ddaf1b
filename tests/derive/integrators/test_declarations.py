from __future__ import annotations

import re

import pytest
import sympy as sp

from tmm_gen.derive.integrators.declaration import (
    CONSISTENT_START,
    KINDS,
    STEP,
    Integrator,
    Past,
    past,
    pasts_in,
    stage,
)
from tmm_gen.derive.integrators.history import history, history_depth
from tmm_gen.derive.integrators.registry import all_integrators, integrator
from tmm_gen.derive.integrators.relations import (
    UNKNOWN,
    Unknown,
    UnsuitableUnknownError,
    affine_motion,
    discrete_coefficients,
)

ALL = all_integrators()
IMPLICIT = [method for method in ALL if method.name != "zhai" and not method.main.coupled]
"""Those whose stages may be solved for displacements."""
UNKNOWNS: tuple[Unknown, ...] = ("displacement", "increment", "acceleration")


def _stages_in(expression: sp.Expr) -> set[int]:
    """Return the numbers of the stages whose values an expression reads."""
    found = (re.fullmatch(r"[qva]_stage(\d+)", symbol.name) for symbol in expression.free_symbols)
    return {int(match[1]) for match in found if match}


def is_zero(expression: sp.Expr) -> bool:
    return sp.expand(sp.radsimp(sp.expand(expression))) == 0


@pytest.mark.parametrize("method", ALL, ids=lambda m: m.name)
def test_stages_use_only_what_is_known(method: Integrator) -> None:
    for number, scheme in enumerate(method.schemes):
        for index, declared in enumerate(scheme.stages, start=1):
            for relation in declared.relations:
                last = len(scheme.stages) if scheme.coupled else index
                assert _stages_in(relation) <= set(range(1, last + 1))
                if number < len(method.startup):
                    assert all(p.lag <= number for p in pasts_in(relation))
        assert set(scheme.update) == set(KINDS)


@pytest.mark.parametrize("method", IMPLICIT, ids=lambda m: m.name)
def test_discrete_coefficients_satisfy_the_declared_relations(method: Integrator) -> None:
    """a = A q + B and v = D q + E must make both relations vanish for every q."""
    for scheme in method.schemes:
        for index, declared in enumerate(scheme.stages, start=1):
            c = discrete_coefficients(scheme, index)
            q = stage("q", index)
            at = {stage("a", index): c.A * q + c.B, stage("v", index): c.D * q + c.E}
            assert all(is_zero(relation.subs(at)) for relation in declared.relations)
            assert (c.A * c.D).free_symbols <= {STEP}


@pytest.mark.parametrize("unknown", UNKNOWNS)
@pytest.mark.parametrize("method", IMPLICIT, ids=lambda m: m.name)
def test_every_unknown_satisfies_the_declared_relations(method: Integrator, unknown: Unknown) -> None:
    for scheme in method.schemes:
        for index, declared in enumerate(scheme.stages, start=1):
            motion = affine_motion(scheme, index, unknown)
            at = {stage(k, index): motion.gain[k] * UNKNOWN + motion.offset[k] for k in KINDS}
            assert all(is_zero(relation.subs(at)) for relation in declared.relations)


@pytest.mark.parametrize("method", [integrator("zhai"), integrator("newmark", beta=0)], ids=lambda m: m.name)
@pytest.mark.parametrize("unknown", ["displacement", "increment"])
def test_explicit_stages_refuse_displacements(method: Integrator, unknown: Unknown) -> None:
    with pytest.raises(UnsuitableUnknownError, match="acceleration"):
        affine_motion(method.main, 1, unknown)
    assert affine_motion(method.main, 1, "acceleration").gain["q"] == 0


def test_equal_diagonals_give_equal_gains() -> None:
    """A sweep shares its factors between stages whose gains are the same expression."""
    for method in (
        integrator("sdirk2"),
        integrator("sdirk4"),
        integrator("bathe", gamma=2 - sp.sqrt(2)),
    ):
        gains = [
            affine_motion(method.main, i + 1, "acceleration").gain for i in range(len(method.main.stages))
        ]
        assert all(gain == gains[0] for gain in gains)


def test_history_is_what_a_method_needs() -> None:
    def needs(name: str) -> set[str]:
        return {f"{p.kind}{p.lag}" for p in history(integrator(name), "acceleration")}

    assert needs("fox_euler") == {"q0", "v0"}
    assert needs("sdirk4") == {"q0", "v0"}
    assert needs("newmark") == {"q0", "v0", "a0"}
    assert needs("zhou") == {"q0", "v0", "a0", "a1"}
    # q of three instants in the main step; v and a for the start-up, a one step late too
    assert needs("houbolt") == {"q0", "q1", "q2", "v0", "a0", "a1"}
    depths = {
        name: history_depth(integrator(name)) for name in ("newmark", "zhou", "zhai", "houbolt", "park")
    }
    assert depths == {"newmark": 1, "zhou": 2, "zhai": 2, "houbolt": 3, "park": 3}


@pytest.mark.parametrize("unknown", UNKNOWNS)
def test_history_is_closed_under_ageing(unknown: Unknown) -> None:
    for method in IMPLICIT:
        kept = history(method, unknown)
        assert all(Past(p.kind, p.lag - 1) in kept for p in kept if p.lag)
        assert list(kept) == sorted(kept, key=lambda p: (p.lag, KINDS.index(p.kind)))


def test_wilson_interpolates_back_and_is_newmark_at_theta_one() -> None:
    general = integrator("wilson", theta=sp.Symbol("theta", positive=True)).main
    assert general.update["a"] != stage("a", 1)
    wilson, newmark = integrator("wilson", theta=1).main, integrator("newmark", beta=1 / 6).main
    assert discrete_coefficients(wilson) == discrete_coefficients(newmark)
    motion = affine_motion(wilson, 1, "acceleration")
    solved = {stage(k, 1): motion.gain[k] * UNKNOWN + motion.offset[k] for k in KINDS}
    assert all(is_zero((wilson.update[k] - stage(k, 1)).subs(solved)) for k in KINDS)


def test_generalized_alpha_equilibrium_is_the_weighted_one() -> None:
    """The stage's q and v must be the same mixture of old and new values as their definition says."""
    rho = sp.Symbol("rho_inf", positive=True)
    scheme = integrator("generalized_alpha", rho_inf=rho).main
    motion = affine_motion(scheme, 1, "acceleration")
    solved = {stage(k, 1): motion.gain[k] * UNKNOWN + motion.offset[k] for k in KINDS}
    weight = scheme.stages[0].instant
    for kind in ("q", "v"):
        new = scheme.update[kind].subs(solved)
        assert sp.cancel(weight * new + (1 - weight) * past(kind) - solved[stage(kind, 1)]) == 0


def test_park_is_the_mean_of_two_backward_differences() -> None:
    relation = integrator("park").main.stages[0].relations[0]
    values = (stage("q", 1), past("q"), past("q", 1), past("q", 2))
    weights = sp.Matrix([sp.expand(relation * STEP).coeff(value) for value in values])
    two_step, three_step = sp.Matrix([3, -4, 1, 0]) / 2, sp.Matrix([11, -18, 9, -2]) / 6
    assert weights == (two_step + three_step) / 2


def test_consistent_start_yields_the_acceleration_alone() -> None:
    motion = affine_motion(CONSISTENT_START, 1, "acceleration")
    assert dict(motion.gain) == {"q": 0, "v": 0, "a": 1}
    assert dict(motion.offset) == {"q": past("q"), "v": past("v"), "a": 0}

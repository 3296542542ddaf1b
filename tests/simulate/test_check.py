"""The checks of a scene hold for every kind of base, and fail where something is wrong."""

from __future__ import annotations

from collections.abc import Callable

import pytest

import tmm_gen.verify.check as checks
from tmm_gen.errors import UserError
from tmm_gen.native.python_module import casadi_module
from tmm_gen.program.build import build_program
from tmm_gen.scene import Scene, parse_scene
from tmm_gen.verify.check import CheckReport, check_scene
from tmm_gen.verify.host_test import run_host_test

pytestmark = pytest.mark.compiler


def check(scene: Scene) -> CheckReport:
    done: list[float] = []
    report = check_scene(scene, lambda share, doing: done.append(share))
    assert sum(done) <= 1.0 + 1e-9
    return report


def failed(report: CheckReport) -> list[str]:
    return [row.check for row in report.rows if not row.passed]


@pytest.mark.parametrize(
    ("base", "changes"),
    [
        ("clamp", {}),
        ("motor", {}),
        ("prescribed", {}),
        ("motor", {"integrator.name": "zhou"}),
        ("prescribed", {"integrator.name": "sdirk2"}),
        ("clamp", {"emit.real": "float32"}),
        ("clamp", {"model.unknown": "displacement", "integrator.name": "houbolt"}),
        ("clamp", {"model.sweep": "product"}),
    ],
)
def test_everything_holds(base: str, changes: dict[str, object], chain: Callable[[str], Scene]) -> None:
    report = check(chain(base).replace(**changes))
    assert failed(report) == []
    assert [row.check for row in report.rows] == [
        "c_host_test",
        "numpy_against_c",
        "numpy_against_casadi",
        "error_against_exact",
        "c_run_against_numpy",
        "order_against_derived",
    ]
    assert float(report.facts["ns_per_step"]) > 0.0  # type: ignore[arg-type]
    assert report.facts["fitted_order"] == pytest.approx(report.facts["derived_order"], abs=0.1)


def test_only_what_the_scene_emits_is_checked(example: Callable[[str], Scene]) -> None:
    report = check(example("thesis2").replace(**{"emit.backends": ["numpy"]}))
    assert [row.check for row in report.rows] == ["error_against_exact", "order_against_derived"]
    assert "ns_per_step" not in report.facts


def test_a_scene_without_inputs_still_moves(example: Callable[[str], Scene]) -> None:
    scene = example("thesis2").replace(**{"input": [], "emit.backends": ["numpy"]})
    report = check(scene)
    assert report.passed
    assert report.facts["fitted_order"] == pytest.approx(2.0, abs=0.1)


def test_a_coarse_step_fails(example: Callable[[str], Scene]) -> None:
    scene = example("thesis2").replace(**{"integrator.name": "fox_euler", "integrator.step": 0.5})
    assert failed(check(scene)) == ["error_against_exact"]


def test_a_backend_that_disagrees_fails(
    monkeypatch: pytest.MonkeyPatch, example: Callable[[str], Scene]
) -> None:
    def off(scene: Scene, program: object) -> object:
        return casadi_module(scene.replace(**{"link.2.inertia": 5.0 + 1e-9}))

    monkeypatch.setattr(checks, "casadi_module", off)
    report = check(example("thesis2").replace(**{"emit.backends": ["numpy", "casadi"]}))
    assert failed(report) == ["numpy_against_casadi"]


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("return THESIS2_OK;", "int unused = 0; return THESIS2_OK;"),  # a warning
        ("#include <math.h>", "#include <maths.h>"),  # an error
        ("0.25 * ", "0.26 * "),  # a wrong result
    ],
)
def test_wrong_c_is_found(
    old: str, new: str, monkeypatch: pytest.MonkeyPatch, example: Callable[[str], Scene]
) -> None:
    import tmm_gen.emit.c as emit

    scene = example("thesis2")
    program = build_program(scene)
    good = emit.emit_c(program, scene)
    assert run_host_test(program, scene)[0] == 0
    assert old in good["c/thesis2.c"]
    bad = {**good, "c/thesis2.c": good["c/thesis2.c"].replace(old, new)}
    monkeypatch.setattr(emit, "emit_c", lambda *_: bad)
    failures, said = run_host_test(program, scene)
    assert failures == 1
    assert said


def test_a_missing_compiler_is_told(monkeypatch: pytest.MonkeyPatch, example: Callable[[str], Scene]) -> None:
    scene = example("thesis2")
    program = build_program(scene)
    with pytest.raises(UserError, match="the C compiler 'no-such-cc' was not found; install one"):
        run_host_test(program, scene, "no-such-cc")


def test_signals_may_be_called_like_the_kernel_s_own_variables() -> None:
    """Everyday names: an output ``angle``, an input ``load``, another called like a local of the sweep."""
    scene = parse_scene("""
        name = "namesakes"
        [model]
        kind = "chain"
        [integrator]
        name = "newmark"
        step = 0.01
        [base]
        kind = "clamp"
        [[joint]]
        stiffness = 20.0
        damping = 5.0
        repeat = 3
        [[link]]
        inertia = 1.0
        repeat = 3
        [[input]]
        name = "load"
        at = 2
        acts = "torque"
        [[input]]
        name = "bias"
        at = "tip"
        acts = "torque"
        [[output]]
        name = "angle"
        at = "tip"
        of = "angle"
    """)
    assert failed(check(scene)) == []

"""The table of integrators a scene may name."""

from __future__ import annotations

import math

import pytest

from tmm_gen.scene import INTEGRATOR_NAMES, METHODS, SceneError, parse_scene
from tmm_gen.scene.integrator import Method, method_named


def test_names() -> None:
    assert set(INTEGRATOR_NAMES) == {
        "fox_euler",
        "newmark",
        "wilson",
        "houbolt",
        "zhou",
        "generalized_alpha",
        "bathe",
        "park",
        "mixed",
        "zhai",
        "sdirk2",
        "sdirk4",
        "radau2",
        "radau3",
        "gauss2",
        "gauss3",
    }
    assert len(set(INTEGRATOR_NAMES)) == len(METHODS)


def test_hyphens_and_underscores_are_the_same() -> None:
    assert method_named("fox-euler") is method_named("fox_euler")
    assert method_named("fox euler") is None


@pytest.mark.parametrize("method", METHODS, ids=lambda method: method.name)
def test_defaults_are_in_range(method: Method) -> None:
    for parameter in method.parameters:
        assert parameter.admits(parameter.default)
        assert not parameter.admits(math.nan)
        assert not parameter.admits(math.inf)


@pytest.mark.parametrize(
    ("name", "parameter", "value", "accepted"),
    [
        ("newmark", "beta", 0, True),
        ("newmark", "beta", -1e-9, False),
        ("wilson", "theta", 1.0, True),
        ("wilson", "theta", 0.99, False),
        ("generalized_alpha", "rho_inf", 0.0, True),
        ("generalized_alpha", "rho_inf", 1.0, True),
        ("generalized_alpha", "rho_inf", 1.01, False),
        ("bathe", "gamma", 0.0, False),
        ("bathe", "gamma", 1.0, False),
        ("bathe", "gamma", 0.6, True),
        ("zhou", "g1", -3.0, True),
        ("zhai", "psi", -0.1, True),
        ("mixed", "delta", 0.01, True),
        ("mixed", "delta", -1e-9, False),
    ],
)
def test_ranges(chain: str, name: str, parameter: str, value: float, accepted: bool) -> None:
    scene = parse_scene(chain)
    changes = {"integrator.name": name, f"integrator.{parameter}": value}
    if accepted:
        assert scene.replace(**changes).integrator.parameters[parameter] == value
    else:
        with pytest.raises(SceneError, match=rf"integrator\.{parameter}: must be "):
            scene.replace(**changes)


def test_methods_of_several_steps_are_those_that_start_in_another_way() -> None:
    from tmm_gen.derive.integrators.registry import integrator

    for method in METHODS:
        assert method.multistep == bool(integrator(method.name).startup), method.name


def test_a_tolerance_wants_steps_that_can_change(chain: str) -> None:
    scene = parse_scene(chain).replace(**{"integrator.tolerance": 1e-6})
    assert scene.integrator.tolerance == 1e-6
    assert scene.replace(**{"integrator.name": "sdirk4"}).integrator.tolerance == 1e-6
    assert scene.digest != parse_scene(chain).digest
    with pytest.raises(
        SceneError, match=r"integrator\.tolerance: does not go with houbolt.*name = \"newmark\""
    ):
        scene.replace(**{"integrator.name": "houbolt"})
    for value, words in ((1e-11, "at least 1e-10"), (0.1, "at most 0.05"), ("fine", "must be a number")):
        with pytest.raises(SceneError, match=rf"integrator\.tolerance: .*{words}.*tolerance = 1e-6"):
            scene.replace(**{"integrator.tolerance": value})


@pytest.mark.parametrize("unknown", ["increment", "displacement"])
@pytest.mark.parametrize(
    ("changes", "explicit"),
    [
        ({"integrator.beta": 0.0}, True),
        ({"integrator.beta": 0.1}, False),
        ({"integrator.name": "zhai"}, True),
        ({"integrator.name": "zhou"}, False),
        ({"integrator.name": "zhou", "integrator.g2": 2.0}, True),
        ({"integrator.name": "fox_euler"}, False),
    ],
)
def test_explicit_methods_need_the_acceleration(
    chain: str, unknown: str, changes: dict[str, object], explicit: bool
) -> None:
    scene = parse_scene(chain).replace(**changes)
    if explicit:
        with pytest.raises(SceneError, match=r"model\.unknown: cannot be solved for"):
            scene.replace(**{"model.unknown": unknown})
    else:
        assert scene.replace(**{"model.unknown": unknown}).model.unknown == unknown


@pytest.mark.parametrize(
    "changes",
    [
        {"integrator.name": "zhai"},
        {"integrator.beta": 0.0},
        {"integrator.name": "zhou", "integrator.g2": 2.0},
        {"integrator.name": "fox_euler"},
        {"integrator.name": "sdirk4"},
    ],
)
def test_every_method_can_follow_a_prescribed_base(chain: str, changes: dict[str, object]) -> None:
    moved = {
        "base.kind": "prescribed",
        "input": [{"name": "angle", "at": "base", "acts": "angle"}],
        **changes,
    }
    assert parse_scene(chain).replace(**moved).base.kind == "prescribed"

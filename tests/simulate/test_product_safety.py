"""The number of safe stations of the plain product: predicted from its gains, borne out by measurement."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path

import pytest
from thesis.product_safety import product_loss, safe_stations

from tmm_gen.derive.integrators.registry import integrator
from tmm_gen.digits.product import require_safe_product, torque_growth
from tmm_gen.errors import UserError
from tmm_gen.scene import Scene

LOAD = {"tip_torque": 1.0}
STEPS = 400


@pytest.fixture(scope="session")
def uniform(example: Callable[[str], Scene]) -> Callable[..., Scene]:
    """Make a chain of identical stations, as in thesis10."""

    def make(stations: int, step: float, name: str = "newmark", **changes: object) -> Scene:
        return example("thesis10").replace(
            **{
                "joint.1.repeat": stations,
                "link.1.repeat": stations,
                "integrator.name": name,
                "integrator.step": step,
                **changes,
            }
        )

    return make


@pytest.mark.parametrize(
    ("name", "step", "unknown"),
    [
        ("newmark", 0.1, "acceleration"),
        ("newmark", 0.01, "acceleration"),
        ("newmark", 0.01, "increment"),
        ("newmark", 0.01, "displacement"),
        ("newmark", 0.001, "acceleration"),
        ("zhou", 0.01, "acceleration"),
        ("houbolt", 0.01, "displacement"),
        ("sdirk4", 0.01, "acceleration"),
    ],
)
def test_six_digits_up_to_there_and_not_far_beyond(
    name: str, step: float, unknown: str, uniform: Callable[..., Scene]
) -> None:
    safe = safe_stations(uniform(1, step, name, **{"model.unknown": unknown}))
    assert safe >= 2
    at_limit = product_loss(uniform(safe, step, name, **{"model.unknown": unknown}), LOAD, STEPS)
    assert at_limit.safe_stations == safe
    assert at_limit.measured <= 1e-6
    beyond = product_loss(uniform(safe + 3, step, name, **{"model.unknown": unknown}), LOAD, STEPS)
    assert beyond.measured > 1e-6


@pytest.mark.parametrize("step", [0.1, 0.01, 0.001])
def test_prediction_is_borne_out(step: float, uniform: Callable[..., Scene]) -> None:
    for stations in range(2, 7):
        loss = product_loss(uniform(stations, step), LOAD, STEPS)
        if loss.predicted < 1e-3:  # beyond, the error feeds on itself
            assert 1e-3 < loss.measured / loss.predicted < 10.0


def test_the_thesis_chain_loses_everything_at_a_step_of_0_01(example: Callable[[str], Scene]) -> None:
    loss = product_loss(example("thesis10"), LOAD, 2000)
    assert loss.measured > 0.1
    assert loss.safe_stations == 5


def test_growth_is_that_of_a_uniform_ladder(example: Callable[[str], Scene]) -> None:
    scene = example("thesis10")
    h, k, c, inertia = 0.01, 20.0, 5.0, 1.0
    ratio = inertia / (k * h**2 / 4 + c * h / 2)  # link's over joint's impedance, average acceleration
    root = math.acosh(1.0 + ratio / 2.0)
    growth = torque_growth(scene, integrator("newmark"))
    for n in range(1, 30):
        # A ladder of n equal cells, seen from its shorted end (a classic of filter theory).
        closed = math.cosh((n + 0.5) * root) / math.cosh(0.5 * root)
        assert next(growth) == pytest.approx(closed, rel=1e-10)


def test_unlike_stations_each_with_its_own_numbers(chain: Callable[[str], Scene]) -> None:
    scene = chain("clamp").replace(**{"integrator.step": 0.02})
    h, motion, torque = 0.02, 0.0, 1.0
    growth = torque_growth(scene, integrator("newmark"))
    stations = list(zip(scene.joints, scene.links, strict=True))
    for joint, link in [*stations, stations[-1]]:  # beyond the scene's own, more of the last
        motion += torque / (joint.stiffness * h**2 / 4 + joint.damping * h / 2)
        torque += link.inertia * motion
        assert next(growth) == pytest.approx(torque, rel=1e-12)


@pytest.mark.parametrize("base", ["clamp", "motor", "prescribed"])
def test_every_base_is_safe_up_to_there(base: str, chain: Callable[[str], Scene]) -> None:
    scene = chain(base)
    assert safe_stations(scene) >= scene.stations
    assert product_loss(scene, {"outer": 1.0, "inner": -0.5}, STEPS).measured < 1e-6


def test_single_precision_holds_less(uniform: Callable[..., Scene]) -> None:
    assert safe_stations(uniform(1, 0.01, **{"emit.real": "float32"})) < safe_stations(uniform(1, 0.01))


def test_explicit_methods_have_no_product(uniform: Callable[..., Scene]) -> None:
    assert safe_stations(uniform(1, 0.01, "zhai")) == 0


def test_refusal_names_the_number_and_the_remedy(uniform: Callable[..., Scene]) -> None:
    newmark = integrator("newmark")
    require_safe_product(uniform(10, 0.01), newmark)
    require_safe_product(uniform(5, 0.01, **{"model.sweep": "product"}), newmark)
    with pytest.raises(
        UserError, match=r'5 stations at a step of 0\.01 s.*has 6.*sweep = "riccati"'
    ) as caught:
        require_safe_product(uniform(6, 0.01, **{"model.sweep": "product"}), newmark)
    assert caught.value.exit_code == 2


def documented() -> dict[str, list[str]]:
    """Rows of the table in docs/product-sweep.md, by their first cell."""
    text = (Path(__file__).resolve().parents[2] / "docs" / "product-sweep.md").read_text(encoding="utf-8")
    rows = [
        [cell.strip(" *") for cell in line.strip("|").split("|")]
        for line in text.splitlines()
        if line[:1] == "|"
    ]
    return {row[0]: row[1:] for row in rows}


@pytest.mark.parametrize("column", range(3))
def test_the_documented_table_is_what_is_measured(column: int, uniform: Callable[..., Scene]) -> None:
    step = (0.1, 0.01, 0.001)[column]
    table = documented()
    assert table["stations"][column] == f"loss at {step:g} s"
    assert int(table["safe up to"][column]) == safe_stations(uniform(1, step))
    for stations in (3, 5, 10):
        measured = product_loss(uniform(stations, step), LOAD, 1000).measured
        said = table[str(stations)][column]
        if said == "all":
            assert measured > 1.0
        else:  # rounding differs from machine to machine
            assert abs(math.log10(measured / float(said))) < 1.0

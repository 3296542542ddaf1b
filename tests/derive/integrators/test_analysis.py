from __future__ import annotations

import pytest
import sympy as sp

from tmm_gen.cli import main
from tmm_gen.derive.integrators.analysis import analyse
from tmm_gen.derive.integrators.registry import integrator, names

KEYS = {
    "name",
    "title",
    "source",
    "parameters",
    "order",
    "stages",
    "startup_steps",
    "history_depth",
    "explicit",
    "unconditionally_stable",
    "stability_limit",
    "stability_limit_exact",
    "stability_limit_damped",
    "stability_limit_damped_exact",
    "rho_infinity",
    "period_error",
    "numerical_damping",
}


def test_analysis_gathers_what_is_derived() -> None:
    found = analyse(integrator("newmark", beta=1 / 6), zeta=0.1)
    assert (found.name, found.order, found.stages, found.startup_steps) == ("newmark", 2, 1, 0)
    assert (found.history_depth, found.explicit) == (1, False)
    assert found.stability_limit == found.stability_limit_damped == 2 * sp.sqrt(3)
    assert found.rho_infinity == 2 + sp.sqrt(3)
    assert analyse(integrator("newmark", beta=0)).explicit
    assert (analyse(integrator("houbolt")).startup_steps, analyse(integrator("zhou")).startup_steps) == (2, 1)
    assert analyse(integrator("zhou")).stability_limit_damped == 0


@pytest.mark.xdist_group("integrators")  # one worker analyses them
def test_json_has_a_row_for_each(printed: dict) -> None:
    assert printed["zeta"] == 0.1
    assert [row["name"] for row in printed["rows"]] == list(names())
    assert all(set(row) == KEYS for row in printed["rows"])


@pytest.mark.xdist_group("integrators")  # one worker analyses them
def test_json_is_what_is_derived(printed: dict) -> None:
    rows = {row["name"]: row for row in printed["rows"]}
    assert rows["newmark"]["parameters"] == {"beta": 0.25, "gamma": 0.5}
    assert rows["newmark"]["unconditionally_stable"]
    assert rows["newmark"]["stability_limit"] is None  # JSON has no infinity
    assert rows["newmark"]["stability_limit_exact"] == "inf"
    assert rows["zhou"]["stability_limit"] == 0
    assert not rows["zhou"]["unconditionally_stable"]
    assert rows["zhou"]["stability_limit_damped"] > 1
    assert (rows["zhai"]["explicit"], rows["zhai"]["stability_limit"]) == (True, 2)
    assert rows["zhai"]["rho_infinity"] is None
    assert rows["sdirk4"]["period_error"] == "13*Omega^4/15360"
    assert rows["wilson"]["rho_infinity"] == pytest.approx(0.778442, abs=1e-6)


def test_the_table(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    few = (integrator("newmark"), integrator("zhou"), integrator("zhai"))
    monkeypatch.setattr("tmm_gen.derive.integrators.registry.all_integrators", lambda: few)
    assert main(["integrators"]) == 0
    out = capsys.readouterr().out
    assert "limit at ζ = 0.05" in out
    newmark, zhou, zhai = (next(x for x in out.splitlines() if method.name in x) for method in few)
    assert [cell.strip() for cell in newmark.split("│")[2:-1]] == [
        *("2", "1", "0", "1", "no", "none", "none", "1", "0.0833 Ω^2", "0")
    ]
    assert "unstable" in zhou
    assert "1.519" in zhou
    assert "grows" in zhai


@pytest.mark.parametrize("zeta", ["-0.1", "1", "nan", "inf", "much"])
def test_bad_damping_ratios(zeta: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["integrators", "--zeta", zeta]) == 2
    assert "--zeta" in capsys.readouterr().err

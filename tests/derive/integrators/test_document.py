"""docs/integrators.md: its table is what is derived, and its example, a row and a file, is all an integrator takes."""

from __future__ import annotations

import re
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest
import sympy as sp

import tmm_gen.derive.integrators as package
from tmm_gen.cli import main
from tmm_gen.derive.integrators.amplification import amplification
from tmm_gen.derive.integrators.analysis import analyse
from tmm_gen.derive.integrators.registry import all_integrators, integrator, names
from tmm_gen.derive.integrators.relations import discrete_coefficients
from tmm_gen.derive.integrators.stability import radius_at_infinity
from tmm_gen.native.python_module import numpy_module
from tmm_gen.scene import Scene, SceneError, load_scene
from tmm_gen.scene.integrator import METHODS, Method, Parameter

DOCUMENT = Path(__file__).resolve().parents[3] / "docs" / "integrators.md"


def rounded(value: float | None, absent: str) -> str:
    return absent if value is None else f"{value:.3g}"


@pytest.mark.xdist_group("integrators")  # one worker analyses them
def test_the_table_is_what_is_derived(printed: dict) -> None:
    rows = re.findall(r"^\| `(.*) \|$", DOCUMENT.read_text(), flags=re.M)
    found = {
        cells[0]: cells[1:]
        for cells in (row.replace("`", "").split(" | ") for row in rows)
        if len(cells) == 9
    }
    assert list(found) == [row["name"] for row in printed["rows"]]
    for row in printed["rows"]:
        order, stages, startup, limit, damped, radius, period, damping = found[row["name"]]
        assert (int(order), int(stages)) == (row["order"], row["stages"])
        assert int(startup) == row["startup_steps"]
        for shown, value in ((limit, row["stability_limit"]), (damped, row["stability_limit_damped"])):
            assert (shown == "none") == (value is None)
            assert value is None or float(shown) == pytest.approx(value, rel=1e-3)
        assert radius == rounded(row["rho_infinity"], "grows")
        for shown, value in ((period, row["period_error"]), (damping, row["numerical_damping"])):
            assert sp.expand(sp.sympify(shown) - sp.sympify(value)) == 0


def test_what_it_says_of_single_methods() -> None:
    text = DOCUMENT.read_text()
    assert "With `g2 = 1` the order stays 3" in text
    found = analyse(integrator("zhou", g2=1))
    assert (found.order, found.numerical_damping, found.stability_limit) == (3, 0, sp.sqrt(6))
    assert "`theta = (1 + sqrt(3))/2`" in text
    assert analyse(integrator("wilson", theta=(1 + sp.sqrt(3)) / 2)).stability_limit == sp.oo
    assert analyse(integrator("wilson", theta=1.366)).stability_limit.is_finite


SNIPPETS = re.findall(r"^```python\n(.*?)^```$", DOCUMENT.read_text(), flags=re.M | re.S)
HHT, *OTHERS = zip(SNIPPETS[::2], SNIPPETS[1::2], strict=True)
"""Examples: a row and a file each."""


@pytest.fixture
def added(request: pytest.FixtureRequest, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[str]:
    """Put an example of the document where integrators are declared and looked for; nothing else."""
    row, code = getattr(request, "param", HHT)
    if row:
        method = eval(row, {"Method": Method, "Parameter": Parameter})
        monkeypatch.setattr("tmm_gen.scene.integrator.METHODS", (*METHODS, method))
    (name,) = re.findall(r"^def (\w+)\(.*-> Integrator", code, re.MULTILINE) or [method.name]
    (tmp_path / f"{name}.py").write_text(code)
    monkeypatch.setattr(package, "__path__", [*package.__path__, str(tmp_path)])
    yield name
    sys.modules.pop(f"{package.__name__}.{name}", None)
    if hasattr(package, name):
        delattr(package, name)


def test_a_row_and_a_file_add_an_integrator(
    added: str,
    simulate: Callable[..., np.ndarray],
    oscillator: type,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    assert added in names()
    method = integrator(added)
    assert method.name in [other.name for other in all_integrators()]
    with pytest.raises(ValueError, match=r"alpha = 1 must be between -0\.333333 and 0"):
        integrator(added, alpha=1)

    found = analyse(method, 0.05)
    assert (found.order, found.stages, found.startup_steps, found.explicit) == (2, 1, 0, False)
    assert found.stability_limit == found.stability_limit_damped == sp.oo
    # (1 + alpha)/(1 - alpha), Chung & Hulbert (1993)
    assert radius_at_infinity(amplification(integrator(added, alpha=-1 / 3).main)) == sp.S.Half
    assert discrete_coefficients(integrator(added, alpha=0).main) == discrete_coefficients(
        integrator("newmark").main
    )

    steps = [0.08 / 2**k for k in range(5)]
    motion = oscillator(zeta=0.1, amplitude=0.8)
    errors = []
    for step in steps:
        count = round(4 / step)
        computed = simulate(method, motion, step, count)[:2]
        errors.append(float(np.max(np.abs(computed - motion.exact(step * np.arange(count + 1))))))
    assert abs(np.polyfit(np.log(steps), np.log(errors), 1)[0] - found.order) < 0.1

    monkeypatch.setattr("tmm_gen.derive.integrators.registry.names", lambda: (added,))
    assert main(["integrators"]) == 0
    assert added in capsys.readouterr().out


def test_scenes_may_name_it_and_kernels_are_made_of_it(added: str) -> None:
    scene = load_scene(DOCUMENT.parents[1] / "scenes" / "thesis2.toml")
    with pytest.raises(SceneError, match="alpha: must be between"):
        scene.replace(**{"integrator.name": added, "integrator.alpha": 0.1})
    tips = []
    for changes in ({"integrator.name": added, "integrator.alpha": 0.0}, {"integrator.name": "newmark"}):
        module = numpy_module(scene.replace(**changes))
        params, inputs = module.Params(), module.Input(**dict.fromkeys((i.name for i in scene.inputs), 1.0))
        model, state = module.prepare(), module.initialise(params, inputs)
        for _ in range(20):
            state = module.step(model, state, inputs)
        tips.append(np.array(state.angle))
    np.testing.assert_allclose(tips[0], tips[1], rtol=1e-12)


def moved(scene: Scene, **changes: object) -> np.ndarray:
    """Return where joints of a chain are after 40 steps under a torque that stays."""
    module = numpy_module(scene.replace(**changes))
    params, inputs = module.Params(), module.Input(**dict.fromkeys((i.name for i in scene.inputs), 1.0))
    model, state = module.prepare(), module.initialise(params, inputs)
    for _ in range(40):
        state = module.step(model, state, inputs)
    return np.array(state.angle)


@pytest.mark.parametrize("added", OTHERS, indirect=True, ids=["tableau", "abscissae"])
def test_a_tableau_or_abscissae_are_a_method(added: str) -> None:
    """Each is of order 2 and L-stable, as the page says, and a chain's kernel goes by it."""
    method = integrator(added)
    found = analyse(method, 0.05)
    assert (found.order, found.stages, found.stability_limit) == (2, 2, sp.oo)
    assert radius_at_infinity(amplification(method.main)) == 0
    assert method.main.coupled == (added == "halves")
    scene = load_scene(DOCUMENT.parents[1] / "scenes" / "thesis2.toml")
    exact = moved(scene, **{"integrator.name": "radau3"})
    errors = [
        np.max(np.abs(moved(scene, **{"integrator.name": name}) - exact)) for name in (added, "fox_euler")
    ]
    assert 0 < errors[0] < 0.2 * errors[1]


@pytest.mark.parametrize(
    ("added", "said"),
    [
        pytest.param(
            ("", HHT[1]), r"hht\.py: .* no row: add Method\(\"hht\", \(Parameter\(\"alpha\", 0\.5\),\)\)"
        ),
        pytest.param((HHT[0].replace("alpha", "beta"), HHT[1]), "takes 'alpha', and its row .* has 'beta'"),
        pytest.param((HHT[0], "def hht():\n    return 1\n"), "has a row .* but no function `hht`"),
        pytest.param((HHT[0], "def hht() -> Integrator\n"), r"hht\.py:1: expected ':'"),
        pytest.param(
            (
                "Method('hht')",
                HHT[1].replace("alpha: sp.Expr", "").replace("return Int", "return 1 / 0, Int"),
            ),
            r"hht\.py:\d+: .* fails: NameError: name 'alpha'",
        ),
        pytest.param(
            (HHT[0], HHT[1].replace("sp.S.Half", "0.5")), r"hht\.py: .* the number 0\.\d+, of which"
        ),
        pytest.param(
            (HHT[0], HHT[1].replace("sp.S.Half", "sp.pi / 6")), r"hht\.py: .* the number pi, of which"
        ),
        pytest.param(
            (HHT[0], HHT[1].replace("weighted[1]))", "weighted[1] ** 2))")),
            r"hht\.py: .* fails: NonlinearError: nonlinear term",
        ),
    ],
    indirect=["added"],
    ids=["no row", "other arguments", "no function", "no Python", "fails", "a decimal", "no root", "no line"],
)
def test_a_row_and_a_file_that_do_not_go_together_are_told(
    added: str, said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """In one line that names the file, by whatever command."""
    scene = DOCUMENT.parents[1] / "scenes" / "thesis2.toml"
    listing = (
        ["integrators"]
        if "no function" not in said
        else ["explain", str(scene), "--set", f"integrator.name={added}"]
    )
    assert main(listing) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert re.search(said, line)


def test_the_example_is_gone_afterwards() -> None:
    assert "hht" not in names()

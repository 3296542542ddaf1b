"""Discrete dynamics in C for acados: compiled, loaded, and held against the step and differences."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import casadi as ca
import numpy as np
import pytest
from numpy.testing import assert_allclose

from tmm_gen.cli import main
from tmm_gen.control.acados import acados_fields
from tmm_gen.control.acados_code import acados_code
from tmm_gen.control.bench import Bench
from tmm_gen.control.prediction.step_model import StepModel
from tmm_gen.native.compiler import compile_library
from tmm_gen.scene import load_scene

ROOT = Path(__file__).resolve().parents[2]
pytestmark = pytest.mark.compiler

FLAGS = ("-O0", "-Wall", "-Werror", "-Wno-unused", "-Dcasadi_int=long long int")
"""CasADi loads functions with its own integers; acados calls them with int, as the text says."""

ONE_LINK = {"beam.upper.links": 1, "beam.forearm.links": 1, "control.substeps": 2, "control.modes": 4}
ARMS: dict[str, tuple[str, dict[str, Any]]] = {
    "hub": ("scenes/swing.toml", {"beam.links": 2, "control.substeps": 3}),
    "motors": ("scenes/elbow.toml", ONE_LINK),
    "space": ("examples/space/wall3.toml", {"beam.upper.links": 1, "beam.forearm.links": 1}),
}


@pytest.fixture(scope="module", params=sorted(ARMS))
def model(request: pytest.FixtureRequest) -> StepModel:
    """One motor and two in a plane, three in space."""
    path, changes = ARMS[request.param]
    return Bench.of(load_scene(ROOT / path).replace(**changes)).step


@pytest.fixture(scope="module")
def called(model: StepModel) -> Callable[..., list[np.ndarray[Any, Any]]]:
    """The functions by the ends of their names, each compiled by itself as strictly as C99 is."""
    texts, front = acados_code(model), acados_fields(model)["name"]
    known: dict[str, Any] = {}

    def call(end: str, *arguments: Any) -> list[np.ndarray[Any, Any]]:
        name = f"{front}_dyn_disc_phi_{end}"
        if name not in known:
            source = {file: texts[file] for file in (f"{name}.c", f"{name}.h")}
            library = compile_library(source, flags=FLAGS)
            known[name] = ca.external(name, str(library))
        found = known[name](*arguments)
        return [np.array(each) for each in (found if isinstance(found, tuple) else (found,))]

    return call


@pytest.fixture(scope="module")
def point(model: StepModel) -> tuple[np.ndarray[Any, Any], ...]:
    """Torques, a state that is bent and moves, weights and a direction."""
    random = np.random.default_rng(5)
    motors, size = model.motors.count, model.size
    u, x = 0.3 * random.standard_normal(motors), 0.3 * random.standard_normal(size)
    return u, x, random.standard_normal(size), random.standard_normal(motors + size)


def test_expression_and_slopes(model: StepModel, called: Any, point: Any) -> None:
    """As Python predicts; slopes as CasADi derives them from the step itself, torques first."""
    u, x, *_ = point
    expected = np.array(model.sample(x, np.tile(u, 2)))
    (phi,) = called("fun", x, u, [])
    assert_allclose(phi, expected, rtol=1e-13, atol=1e-13 * np.abs(expected).max())
    state, torques = ca.MX.sym("x", model.size), ca.MX.sym("u", model.motors.count)
    after = model.sample(state, ca.vertcat(torques, torques))
    slopes = ca.Function("J", [state, torques], [ca.jacobian(after, ca.vertcat(torques, state))])
    wanted = np.array(ca.densify(slopes(x, u))).T
    for end, arguments in (("fun_jac", (x, u, [])), ("fun_jac_hess", (x, u, point[2], []))):
        again, found = called(end, *arguments)[:2]
        assert_allclose(again, phi, rtol=1e-13, atol=1e-13 * np.abs(phi).max())
        assert_allclose(found, wanted, rtol=1e-9, atol=1e-11 * np.abs(wanted).max())


def test_second_derivatives(model: StepModel, called: Any, point: Any) -> None:
    """Those of differences of the slopes, symmetric; times a direction what the function for products gives."""
    u, x, lam, v = point
    hessian = called("fun_jac_hess", x, u, lam, [])[2]
    assert np.array_equal(hessian, hessian.T)
    z, m = np.concatenate([u, x]), model.motors.count

    def gradient(at: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
        return np.asarray(called("fun_jac", at[m:], at[:m], [])[1] @ lam)

    def difference(way: np.ndarray[Any, Any], h: float) -> np.ndarray[Any, Any]:
        return (gradient(z + h * way) - gradient(z - h * way)) / (2.0 * h)

    # of fourth order: what it leaves out is far below the tolerance
    for way in (*np.eye(len(z)), v):
        near, far = difference(way, 2e-4), difference(way, 4e-4)
        expected = (4.0 * near - far) / 3.0
        assert_allclose(hessian @ way, expected, rtol=1e-6, atol=1e-7 * np.abs(hessian).max())
    (product,) = called("hess_vec", x, u, lam, v, [])
    assert_allclose(product.ravel(), hessian @ v, rtol=1e-11, atol=1e-12 * np.abs(hessian @ v).max())
    assert np.abs(hessian).max() > 1e-3  # there is something to compare


def test_the_command_writes_all_files_and_replaces_none(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    scene = str(ROOT / "scenes" / "swing.toml")
    assert main(["export", scene, "--to", "acados", "--json"]) == 0
    facts = json.loads(capsys.readouterr().out)
    assert (facts["name"], facts["folder"], facts["u"]) == (
        "swing_discrete",
        "swing_discrete_model",
        ["hub_torque"],
    )
    ends = ("fun", "fun_jac", "fun_jac_hess", "hess_vec")
    wanted = {f"swing_discrete_dyn_disc_phi_{end}.{kind}" for end in ends for kind in "ch"}
    assert {path.name for path in Path("swing_discrete_model").iterdir()} == wanted
    assert {Path(each["file"]).name for each in facts["files"]} == wanted
    changed = Path("swing_discrete_model/swing_discrete_dyn_disc_phi_fun.c")
    before = changed.read_text()
    changed.write_text("mine")
    assert main(["export", scene, "--to", "acados"]) == 2
    assert "--force" in capsys.readouterr().err
    assert changed.read_text() == "mine"
    assert main(["export", scene, "--to", "acados", "--force"]) == 0
    assert changed.read_text() == before


@pytest.mark.parametrize(
    ("words", "what"),
    [
        (["thesis10", "--to", "acados"], "nothing that controllers turn"),
        (["swing", "--to", "acados", "--out", __file__], "is a file"),
        (["swing", "--to", "mjcf", "--force"], "--to acados only"),
    ],
)
def test_refusals(words: list[str], what: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["export", str(ROOT / "scenes" / f"{words[0]}.toml"), *words[1:]]) == 2
    shown = capsys.readouterr().err
    assert what in shown
    assert "Traceback" not in shown

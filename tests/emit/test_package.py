"""Whole packages: what is in them, and that formatters, linters and checkers of types have nothing to say."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

from tmm_gen.emit.seal import is_intact
from tmm_gen.package.texts import emit_package
from tmm_gen.scene import METHODS, Scene, load_scene
from tmm_gen.version import __version__

pytestmark = pytest.mark.xdist_group("packages")  # the printed packages are made once

ROOT = Path(__file__).resolve().parents[2]
SCENES = ROOT / "scenes"
PYTHON = {
    "numpy": {"__init__.py", "kernel.py"},
    "casadi": {"casadi_model.py"},
    "jax": {"jax_kernel.py"},
}


@pytest.fixture(scope="module")
def thesis2() -> Scene:
    return load_scene(SCENES / "thesis2.toml")


@pytest.mark.parametrize(
    "backends", [["numpy"], ["casadi"], ["numpy", "casadi"], ["numpy", "c", "casadi"], ["jax", "numpy"]]
)
def test_a_package_has_the_backends_asked_for(thesis2: Scene, backends: list[str]) -> None:
    files = emit_package(thesis2.replace(**{"emit.backends": backends}))
    python = {path for path in files if not path.startswith("c/")}
    assert python == set().union(*(PYTHON[name] for name in backends if name != "c"))
    assert any(path.startswith("c/") for path in files) == ("c" in backends)
    assert list(files) == sorted(files)
    assert all(is_intact(text) for text in files.values())


def test_headers_say_what_a_file_comes_from_and_costs(thesis2: Scene) -> None:
    for path, text in emit_package(thesis2).items():
        head = text[:3000]
        assert "thesis2: Two-station torsional chain" in head, path
        assert f"tmm-gen {__version__}" in head, path
        assert thesis2.digest in head, path
        assert not re.search(r"\b20\d\d-\d\d-\d\d\b|\d\d:\d\d:\d\d", text), path
        if path.endswith(("kernel.py", "casadi_model.py")):
            assert re.search(r"^# operations of a step: \d+, [\d.]+ per station \(", text, re.MULTILINE), path


def test_nothing_names_this_machine(thesis2: Scene) -> None:
    for path, text in emit_package(thesis2).items():
        assert str(ROOT) not in text, path
        assert str(Path.home()) not in text, path


@pytest.fixture(scope="module")
def printed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Python packages by every integrator, some of the committed scenes, odd names."""
    folder = tmp_path_factory.mktemp("printed")
    drivetrain = load_scene(SCENES / "drivetrain.toml")
    scenes = {
        method.name: drivetrain.replace(**{"integrator.name": method.name, "integrator.step": 1e-4})
        for method in METHODS
    }
    changes = {"integrator.name": "sdirk2", "model.unknown": "displacement"}
    scenes["displacement"] = drivetrain.replace(**changes)
    scenes["product"] = drivetrain.replace(**changes, **{"model.sweep": "product", "integrator.step": 0.5})
    scenes["planar"] = load_scene(SCENES / "arm10.toml")
    scenes["planar_stages"] = scenes["planar"].replace(**{"integrator.name": "sdirk4"})
    long = "a_name_that_has_as_many_characters_as_they_allow"
    odd = {"input.1.name": long, "output.1.name": "model", "title": f'"Quotes" {"and words " * 20}'}
    scenes["odd"] = drivetrain.replace(**odd)
    scenes["hundred"] = load_scene(SCENES / "hundred.toml")
    scenes["batch"] = drivetrain.replace(**{"emit.batch": 4})
    for name, scene in scenes.items():
        emitted = {"backends": ["numpy", "casadi", "jax"]}
        if scene.emit.batch is not None:
            emitted = {"backends": ["numpy", "c"], "batch": scene.emit.batch}
        for path, text in emit_package(scene.replace(emit=emitted)).items():
            if path.endswith(".py"):
                (folder / name).mkdir(exist_ok=True)
                (folder / name / path).write_text(text, encoding="utf-8")
    return folder


@pytest.mark.style
def test_a_formatter_changes_nothing(printed: Path) -> None:
    command = [
        sys.executable,
        "-m",
        "ruff",
        "format",
        "--isolated",
        "--line-length",
        "110",
        "--diff",
        str(printed),
    ]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout[:3000]


@pytest.mark.style
def test_a_linter_finds_nothing(printed: Path) -> None:
    command = [
        sys.executable,
        "-m",
        "ruff",
        "check",
        "--isolated",
        "--line-length",
        "110",
        "--select",
        "E,F,W,I",
    ]
    done = subprocess.run([*command, str(printed)], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout[:3000]


@pytest.mark.style
@pytest.mark.parametrize("name", ["houbolt", "bathe", "odd", "planar_stages", "batch"])
def test_a_checker_of_types_finds_nothing(printed: Path, name: str, tmp_path: Path) -> None:
    settings = tmp_path / "mypy.ini"
    settings.write_text("[mypy]\nstrict = True\n[mypy-casadi.*,jax.*]\nignore_missing_imports = True\n")
    command = [
        sys.executable,
        "-m",
        "mypy",
        "--config-file",
        str(settings),
        "--cache-dir",
        str(ROOT / ".mypy_cache"),
    ]
    done = subprocess.run([*command, "-p", name], cwd=printed, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout[:3000]

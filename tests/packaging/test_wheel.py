"""The distribution: built, installed where the sources are not, and used."""

from __future__ import annotations

import importlib.util
import os
import re
import subprocess
import sys
import tarfile
import zipfile
from collections.abc import Callable
from pathlib import Path

import pytest

from tmm_gen import __version__

pytestmark = [pytest.mark.packaging, pytest.mark.xdist_group("packaging")]

USE_THE_RESULT = """
import inspect, sys
import numpy as np
sys.path.insert(0, "generated_here")
import foo
assert "site-packages" not in foo.__file__, foo.__file__
assert inspect.getdoc(foo.prepare) and inspect.getdoc(foo.step)
print(foo.__file__)
"""


def _run(words: list[str | Path], cwd: Path) -> str:
    # Nothing may lead back to the sources.
    environment = {key: value for key, value in os.environ.items() if not key.startswith("PYTHON")}
    done = subprocess.run(
        [str(word) for word in words], cwd=cwd, env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, f"{words} ended with {done.returncode}:\n{done.stdout}\n{done.stderr}"
    return done.stdout


def _shipped(repository: Path) -> set[str]:
    """Every file of the repository that an installed tmm-gen needs, as named in the wheel."""
    names = set()
    for source, target in {
        "src/tmm_gen": "tmm_gen",
        "templates": "tmm_gen/templates",
        "scenes": "tmm_gen/scenes",
        "third_party": "tmm_gen/third_party",
    }.items():
        folder = repository / source
        names |= {
            f"{target}/{path.relative_to(folder).as_posix()}"
            for path in folder.rglob("*")
            if path.is_file() and "__pycache__" not in path.parts
        }
    return names


@pytest.fixture(scope="module")
def built(repository: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the sdist, and with the wheel that was built from it."""
    folder = tmp_path_factory.mktemp("dist")
    _run([sys.executable, "-m", "build", "--no-isolation", "--outdir", folder, repository], folder)
    return folder


@pytest.fixture(scope="module")
def wheel(built: Path) -> Path:
    (made,) = built.glob("*.whl")
    return made


def test_an_index_would_take_both(built: Path) -> None:
    if not os.environ.get("CI"):
        pytest.importorskip("twine")
    said = _run([sys.executable, "-m", "twine", "check", "--strict", *built.iterdir()], built)
    assert said.count("PASSED") == 2


def test_what_the_index_shows_links_nowhere_by_path(wheel: Path) -> None:
    with zipfile.ZipFile(wheel) as archive:
        (metadata,) = (name for name in archive.namelist() if name.endswith("/METADATA"))
        shown = archive.read(metadata).decode()
    assert "# tmm-gen" in shown
    assert [to for to in re.findall(r"\]\(([^)]*)\)", shown) if not to.startswith(("https://", "#"))] == []


def test_where_the_repository_has_an_address_links_lead_there(repository: Path) -> None:
    specification = importlib.util.spec_from_file_location(
        "pypi_page", repository / "packaging" / "pypi_page.py"
    )
    assert specification is not None
    assert specification.loader is not None
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    text = "![An arm](docs/a.gif)\n\n[more](docs/b.md#c), [here](#there), [else](https://e.org/f)\n"
    assert module.page(text, "https://g.org/h") == (
        "![An arm](https://g.org/h/raw/main/docs/a.gif)\n\n"
        "[more](https://g.org/h/blob/main/docs/b.md#c), [here](#there), [else](https://e.org/f)\n"
    )
    assert module.page(text, "") == "\n\nmore, [here](#there), [else](https://e.org/f)\n"


@pytest.fixture(scope="module")
def installed(
    wheel: Path, tmp_path_factory: pytest.TempPathFactory, borrow_environment: Callable[[Path], Path]
) -> Path:
    """The ``bin`` of an environment whose tmm-gen is the wheel's."""
    folder = tmp_path_factory.mktemp("installed")
    programs = borrow_environment(folder / "venv")
    offline = ["--no-index", "--no-deps", "--force-reinstall"]
    _run([programs / "python", "-m", "pip", "install", "--quiet", *offline, wheel], folder)
    return programs


def test_the_wheel_holds_the_package_its_templates_and_scenes_and_nothing_else(
    wheel: Path, repository: Path
) -> None:
    with zipfile.ZipFile(wheel) as archive:
        names = set(archive.namelist())
    inside = {name for name in names if ".dist-info/" not in name}
    assert inside == _shipped(repository)
    for needed in ("tmm_gen/py.typed", "tmm_gen/templates/", "tmm_gen/scenes/"):
        assert any(name.startswith(needed) for name in inside), needed


def test_the_sdist_holds_sources_and_no_outputs(built: Path) -> None:
    (sdist,) = built.glob(f"tmm_gen-{__version__}.tar.gz")
    with tarfile.open(sdist) as archive:
        names = {name.partition("/")[2] for name in archive.getnames()}
    assert {
        "pyproject.toml",
        "README.md",
        "LICENSE",
        "CHANGELOG.md",
        "Makefile",
        "tests/conftest.py",
    } <= names
    assert not [
        name for name in names if name.startswith((".venv", "out/", "dist/")) or "__pycache__" in name
    ]


def test_the_installed_command_is_the_wheels(installed: Path, tmp_path: Path, repository: Path) -> None:
    origin = Path(
        _run([installed / "python", "-c", "import tmm_gen; print(tmm_gen.__file__)"], tmp_path).strip()
    )
    assert origin.is_relative_to(installed.parent)
    assert not origin.is_relative_to(repository)
    assert _run([installed / "tmm-gen", "--version"], tmp_path) == f"tmm-gen {__version__}\n"

    ask = "from tmm_gen import resources as r; print(r.templates_dir()); print(r.scenes_dir())"
    folders = _run([installed / "python", "-c", ask], tmp_path).splitlines()
    assert folders == [str(origin.parent / "templates"), str(origin.parent / "scenes")]


def test_the_installed_command_writes_a_scene_and_a_kernel_that_runs(installed: Path, tmp_path: Path) -> None:
    _run([installed / "tmm-gen", "new", "foo", "--out", "."], tmp_path)
    assert (tmp_path / "foo.toml").is_file()
    _run([installed / "tmm-gen", "build", "foo.toml", "--out", "generated_here"], tmp_path)
    kernel = Path(_run([installed / "python", "-c", USE_THE_RESULT], tmp_path).strip())
    assert (tmp_path / kernel) == tmp_path / "generated_here" / "foo" / "__init__.py"

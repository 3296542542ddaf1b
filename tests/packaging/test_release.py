"""What repeats the version, the requirements or the steps of `make lint` says the same as their source."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path
from typing import Any

import pytest
import yaml

from tmm_gen import __version__

CONDA = {"matplotlib": "matplotlib-base"}
"""What a package of PyPI is called on conda-forge, where that differs: without graphical interfaces."""


@pytest.fixture(scope="module")
def project(repository: Path) -> dict[str, Any]:
    return tomllib.loads((repository / "pyproject.toml").read_text())


def test_all_name_one_version_and_one_day(repository: Path) -> None:
    citation = yaml.safe_load((repository / "CITATION.cff").read_text())
    recipe = yaml.safe_load((repository / "packaging" / "conda" / "recipe.yaml").read_text())
    headings = re.findall(r"^## \[(.*)\]", (repository / "CHANGELOG.md").read_text(), re.MULTILINE)
    assert headings[:2] == ["Unreleased", __version__]
    assert citation["version"] == recipe["context"]["version"] == __version__
    assert f"## [{__version__}] - {citation['date-released']}\n" in (repository / "CHANGELOG.md").read_text()


def test_the_conda_recipe_asks_for_what_the_project_asks_for(
    repository: Path, project: dict[str, Any]
) -> None:
    recipe = yaml.safe_load((repository / "packaging" / "conda" / "recipe.yaml").read_text())
    python = f"python {project['project']['requires-python']}"

    def spelled(requirements: list[str]) -> set[str]:
        split = (re.fullmatch(r"([\w.-]+)(.*)", each) for each in requirements)
        return {f"{CONDA.get(each[1], each[1])} {each[2]}".strip() for each in split if each}

    assert set(recipe["requirements"]["run"]) == {python} | spelled(project["project"]["dependencies"])
    assert set(recipe["requirements"]["host"]) == {python, "pip"} | spelled(
        project["build-system"]["requires"]
    )
    (command,) = recipe["build"]["python"]["entry_points"]
    assert dict([command.split(" = ")]) == project["project"]["scripts"]
    assert recipe["source"]["path"] == "../../dist/tmm_gen-${{ version }}.tar.gz"


def test_hooks_before_a_commit_are_steps_of_make_lint(repository: Path) -> None:
    (local,) = yaml.safe_load((repository / ".pre-commit-config.yaml").read_text())["repos"]
    makefile = (repository / "Makefile").read_text()
    steps = re.findall(
        r"^\t(\.venv-lint/bin/(?:ruff|mypy).*)$", makefile.partition("\nformat:")[0], re.MULTILINE
    )
    assert [hook["entry"] for hook in local["hooks"]] == steps
    assert len(steps) == 3

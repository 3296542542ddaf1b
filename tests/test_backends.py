"""Backends are found by one registry, and another package adds one by an entry point."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

from tmm_gen.backends import OWN, USUAL, backend_named, backend_names

SCENES = Path(__file__).resolve().parents[1] / "scenes"

LISTING = """
from tmm_gen.emit.header import header_lines
from tmm_gen.emit.seal import sealed

def emit_listing(program, scene):
    lines = [*header_lines(program, scene), *(section.title for section in program.main.sections)]
    return {"listing.txt": sealed("\\n".join(lines) + "\\n")}
"""


@pytest.fixture
def other_package(tmp_path: Path) -> Path:
    """Install, as pip would, a package whose backend lists the phases of a step."""
    (tmp_path / "listing.py").write_text(LISTING)
    info = tmp_path / "listing-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: listing\nVersion: 1.0\n")
    (info / "entry_points.txt").write_text(
        "[tmm_gen.backends]\nlisting = listing:emit_listing\nc = listing:emit_listing\n"
    )
    return tmp_path


@pytest.mark.parametrize("each", OWN, ids=lambda each: each.name)
def test_every_backend_of_ours_has_an_emitter(each) -> None:  # type: ignore[no-untyped-def]
    assert callable(each.load())
    assert backend_named(each.name) == each


def test_there_is_no_other() -> None:
    assert backend_names()[:4] == ("numpy", "c", "casadi", "jax")
    assert [name for name in backend_names() if name in USUAL] == list(USUAL)
    assert backend_named("nupy") is None


def test_another_package_brings_one(
    other_package: Path, tmm_gen: Callable[..., subprocess.CompletedProcess[str]], tmp_path: Path
) -> None:
    """Its text comes out; it cannot take the name of one of ours."""
    scene = (SCENES / "thesis2.toml").read_text().partition("[emit]")[0]
    (tmp_path / "thesis2.toml").write_text(scene + '[emit]\nbackends = ["listing", "c"]\n')
    path = {"PYTHONPATH": os.pathsep.join((str(other_package), os.environ.get("PYTHONPATH", "")))}
    done = tmm_gen("build", "thesis2.toml", env=path)
    assert done.returncode == 0, done.stderr
    made = tmp_path / "generated" / "thesis2"
    assert "thesis2: Two-station torsional chain" in (made / "listing.txt").read_text()
    assert (made / "c" / "thesis2.c").is_file()

    # a build with nothing to do does not look at what it prints: another package may have changed
    (other_package / "listing.py").write_text(LISTING.replace("*header_lines", "'changed', *header_lines"))
    done = tmm_gen("build", "thesis2.toml", env=path)
    assert done.returncode == 0, done.stderr
    assert (made / "listing.txt").read_text().startswith("changed")


def test_without_it_the_scene_is_refused_in_words(
    tmm_gen: Callable[..., subprocess.CompletedProcess[str]], tmp_path: Path
) -> None:
    scene = (SCENES / "thesis2.toml").read_text().partition("[emit]")[0]
    (tmp_path / "thesis2.toml").write_text(scene + '[emit]\nbackends = ["listing"]\n')
    done = tmm_gen("build", "thesis2.toml")
    assert done.returncode == 2
    for words in ("emit.backends[1]", "is not one of the choices", "numpy, c, casadi"):
        assert words in done.stderr

"""Templates and scenes are found from a source checkout; tests/packaging asks an installed wheel."""

from __future__ import annotations

from pathlib import Path

import pytest

from tmm_gen import resources


def test_a_checkout_has_its_own(repository: Path) -> None:
    assert resources.templates_dir() == repository / "templates"
    assert resources.scenes_dir() == repository / "scenes"


def test_a_wheel_has_them_inside(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    package = tmp_path / "site-packages" / "tmm_gen"
    (package / "templates").mkdir(parents=True)
    monkeypatch.setattr(resources, "_PACKAGE", package)
    assert resources.templates_dir() == package / "templates"
    with pytest.raises(FileNotFoundError, match="without its scenes"):
        resources.scenes_dir()

"""How `build` says to import what it has written: from wherever it was started."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from tmm_gen.cli.build import import_line


@pytest.mark.parametrize("out", ["generated", "some folder/my-out", "elsewhere/gen"])
def test_the_line_imports_as_it_says(out: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    package = tmp_path / out / "arm"
    package.mkdir(parents=True)
    (package / "__init__.py").write_text("simulate = 1\n")
    line = import_line(Path(out), ["arm"])
    statement = line.removeprefix("In Python: ").partition(",")[0]
    (tmp_path / "elsewhere").mkdir(exist_ok=True)
    (tmp_path / "elsewhere" / "script.py").write_text(statement + "\n")
    command = line.partition(": PYTHONPATH=")[2].replace(
        "python SCRIPT.py", f"{sys.executable} elsewhere/script.py"
    )
    subprocess.run(f"PYTHONPATH={command}", shell=True, cwd=tmp_path, check=True)

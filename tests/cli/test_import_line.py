"""How `build` says to take what it has written, from wherever it was started."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

from tmm_gen.cli import main
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


def test_cmake_finds_what_the_line_names(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    scene = Path("scenes/thesis2.toml").resolve()
    monkeypatch.chdir(tmp_path)
    assert main(["build", str(scene), "--out", "out/of"]) == 0
    (line,) = [line for line in capsys.readouterr().out.splitlines() if line.startswith("In CMake: ")]
    found = re.fullmatch(r"In CMake: add_subdirectory\((.*)\), and link (\w+); .* compile (\S+) there", line)
    assert found is not None
    folder = tmp_path / found[1]
    assert f"add_library({found[2]} STATIC {found[3]})" in (folder / "CMakeLists.txt").read_text()
    assert (folder / found[3]).exists()

"""The README's Python and C snippets run as they stand."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).parents[2]


def blocks(language: str) -> list[str]:
    return re.findall(rf"```{language}\n(.*?)```", (REPOSITORY / "README.md").read_text(), re.DOTALL)


def test_python_interface(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "scenes").symlink_to(REPOSITORY / "scenes")
    monkeypatch.chdir(tmp_path)
    interface, _ = blocks("python")
    exec(interface, {})
    assert capsys.readouterr().out.startswith(
        "<Run of swing, 1 s in 200 steps by newmark: tip_x, tip_y, hub, accurate"
    )
    assert (tmp_path / "swing.png").is_file()
    assert (tmp_path / "packages" / "swing" / "c" / "swing.c").is_file()


def test_generated_package() -> None:
    _, package = blocks("python")
    done = subprocess.run(
        [sys.executable, "-c", package], cwd=REPOSITORY, capture_output=True, text=True, check=True
    )
    first, last = (float(line) for line in done.stdout.split())
    assert 0 < first < 1e-3
    assert 0.3 < last < 0.8  # swinging about the static deflection of 0.5 rad


def test_c_snippet(tmp_path: Path) -> None:
    (snippet,) = blocks("c")
    source = f"""
        #include <stdio.h>
        #include "thesis10.h"
        int main(void)
        {{
            double angles[10] = {{0}}, rates[10] = {{0}};
            thesis10_outputs out;
            {snippet}
            thesis10_output(&model, &state, &out);
            printf("%.17g\\n", out.tip);
            return 0;
        }}
    """
    (tmp_path / "main.c").write_text(source)
    kernel = REPOSITORY / "generated" / "thesis10" / "c"
    program = tmp_path / "main"
    command = ["gcc", "-std=c99", "-Wall", "-Wextra", "-Werror", f"-I{kernel}", str(tmp_path / "main.c")]
    subprocess.run([*command, str(kernel / "thesis10.c"), "-lm", "-o", str(program)], check=True)
    done = subprocess.run([str(program)], capture_output=True, text=True, check=True)
    sys.path.insert(0, str(REPOSITORY))
    try:
        from generated.thesis10 import Input, initialise, output, prepare, step
    finally:
        sys.path.remove(str(REPOSITORY))
    model = prepare()
    state = step(model, initialise(input=Input(tip_torque=1.0)), Input(tip_torque=1.0))
    assert float(done.stdout) == float(output(model, state).tip)

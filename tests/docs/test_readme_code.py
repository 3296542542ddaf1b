"""The README's Python and C snippets run as they stand."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

REPOSITORY = Path(__file__).parents[2]


def block(language: str) -> str:
    found = re.findall(rf"```{language}\n(.*?)```", (REPOSITORY / "README.md").read_text(), re.DOTALL)
    assert len(found) == 1
    return str(found[0])


def test_python_snippet() -> None:
    done = subprocess.run(
        [sys.executable, "-c", block("python")], cwd=REPOSITORY, capture_output=True, text=True, check=True
    )
    first, last = (float(line) for line in done.stdout.split())
    assert 0 < first < 1e-3
    assert 0.3 < last < 0.8  # swinging about the static deflection of 0.5 rad


def test_c_snippet(tmp_path: Path) -> None:
    source = f"""
        #include <stdio.h>
        #include "thesis10.h"
        int main(void)
        {{
            double angles[10] = {{0}}, rates[10] = {{0}};
            thesis10_outputs out;
            {block("c")}
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

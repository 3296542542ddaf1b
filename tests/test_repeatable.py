"""The same tree tries the same cases, whatever a worker has run before."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

DRAWS = """
import conftest  # as all tests have it
{before}
from hypothesis import given, settings
from hypothesis import strategies as st

drawn = []

@given(st.floats(-7, 7), st.integers(0, 100_000))
@settings(max_examples=300)
def draw(number, count):
    drawn.append((number, count))

draw()
print(len(drawn), drawn)
"""


def test_draws_do_not_hang_on_what_is_loaded(repository: Path, tmp_path: Path) -> None:
    """With more of our modules loaded, which hold more constants, the same numbers are drawn."""
    found = []
    for before in ("", "import tmm_gen.cli, tmm_gen.modal.undamped, tmm_gen.scene"):
        script = tmp_path / "draws.py"  # the same file: its text is the seed
        script.write_text(DRAWS.format(before=before))
        found.append(
            subprocess.run(
                [sys.executable, script],
                env={
                    **os.environ,
                    "PYTHONPATH": str(repository / "tests"),
                    "HYPOTHESIS_PROFILE": "repeatable",
                },
                capture_output=True,
                text=True,
                check=True,
                cwd=tmp_path,
            ).stdout
        )
    assert found[0].startswith("300 ")
    assert found[0] == found[1]

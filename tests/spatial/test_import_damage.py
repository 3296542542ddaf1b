"""Files that were damaged: whatever stands in them, the command ends in words."""

from __future__ import annotations

import random
from collections.abc import Iterator
from pathlib import Path

import pytest

from tmm_gen.cli import main

EXAMPLE = Path(__file__).resolve().parents[2] / "examples" / "urdf"
PIECES = (
    "",
    " ",
    "<",
    ">",
    "/",
    '"',
    "&",
    "-",
    "0",
    "1e400",
    "nan",
    "\0",
    "é",
    "[",
    "=",
    "link",
    "joint",
    "\n",
    "{",
    "3",
)


def damaged(text: str, rng: random.Random) -> str:
    """Return a text with a few characters, words or lines taken out, doubled or replaced."""
    for _ in range(rng.randint(1, 4)):
        kind = rng.randrange(4)
        if kind == 0:
            at = rng.randrange(len(text))
            text = text[:at] + rng.choice(PIECES) + text[at + rng.randint(0, 3) :]
        elif kind == 1:
            lines = text.split("\n")
            at = rng.randrange(len(lines))
            lines[at : at + 1] = rng.choice(([], [lines[at]] * 2, [lines[rng.randrange(len(lines))]]))
            text = "\n".join(lines)
        else:
            words = [word for word in text.replace('"', " ").split() if len(word) > 1]
            text = text.replace(
                rng.choice(words), rng.choice((*PIECES, rng.choice(words))), rng.choice((1, -1))
            )
    return text


def files(seed: int) -> Iterator[tuple[str, str]]:
    rng = random.Random(seed)
    urdf, flex = ((EXAMPLE / f"picker.{end}").read_text() for end in ("urdf", "flex.toml"))
    for _ in range(25):
        yield (damaged(urdf, rng), flex) if rng.random() < 0.6 else (urdf, damaged(flex, rng))


@pytest.mark.parametrize("seed", range(8))
def test_the_command_ends_in_words(seed: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    codes = set()
    for urdf, flex in files(seed):
        (tmp_path / "picker.urdf").write_text(urdf, encoding="utf-8")
        (tmp_path / "flex.toml").write_text(flex, encoding="utf-8")
        words = [str(tmp_path / "picker.urdf"), "--flex", str(tmp_path / "flex.toml")]
        codes.add(
            main(["import", *words, "--out", str(tmp_path / "scene.toml"), "--force"])
        )  # anything else raises
        said = capsys.readouterr()
        assert bool(said.err) != bool(said.out.startswith("wrote"))
        assert "Traceback" not in said.err
    assert codes == {0, 2}

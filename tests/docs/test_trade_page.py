"""The page on the trade: its commands work, and it says of the reports what they say."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from tmm_gen.cli import main

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs" / "trade.md").read_text()
SENTENCE = re.compile(r"<p>(At an error of [^<]*)</p>")
WINNER = re.compile(r"At an error of (?P<error>\S+), (?P<who>\w+)[\w, ]* is the cheapest")
FACTORS = re.compile(
    r"(?P<time>[\d.]+) times less time and (?P<count>[\d.]+) times fewer operations than Newmark"
)
COLUMNS = {"thesis10": 2, "arm10": 3, "arm50": 4}


def _commands() -> list[str]:
    blocks = re.findall(r"```console\n(.*?)```", PAGE, re.DOTALL)
    return [line[2:] for block in blocks for line in block.splitlines() if line.startswith("$ ")]


def test_every_command_works(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    commands = _commands()
    assert len(commands) == 3
    monkeypatch.chdir(tmp_path)
    for folder in ("scenes", "examples"):
        (tmp_path / folder).symlink_to(ROOT / folder)
    for command in commands:
        program, *words = command.split()
        assert program == "tmm-gen"
        assert main(words) == 0
    assert {path.name for path in tmp_path.iterdir()} == {
        "scenes",
        "examples",
        "thesis10-trade.html",
        "tuned.toml",
    }


@pytest.mark.parametrize("scene", COLUMNS)
def test_winners_are_those_of_the_reports(scene: str) -> None:
    report = (ROOT / "docs" / "reports" / f"{scene}.html").read_text()
    sentences = SENTENCE.findall(report)
    table = [line.split("|") for line in PAGE.splitlines() if re.match(r"\| 1e-\d \|", line)]
    assert len(table) == 3
    for sentence, row, level in zip(sentences, table, (1e-2, 1e-4, 1e-6), strict=True):
        winner, factors = WINNER.match(sentence), FACTORS.search(sentence)
        assert winner
        assert float(row[1]) == float(winner["error"]) == level
        first = row[COLUMNS[scene]].split(";")[0].strip().replace("`", "").lower()
        expected = winner["who"]
        if factors:
            expected += f" {float(factors['time']):.1f} ({float(factors['count']):.1f})"
        assert first == expected

"""Commands that pages name within a sentence exist, and so do their options."""

from __future__ import annotations

import re
from pathlib import Path

import click
import pytest

from tmm_gen.cli import tmm_gen

ROOT = Path(__file__).resolve().parents[2]
PAGES = (ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md")))
NAMED = re.compile(r"`tmm-gen ([a-z]+)([^`]*)`")


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_commands_in_sentences_have_their_options(page: Path) -> None:
    text = re.sub(r"```.*?```", "", page.read_text(encoding="utf-8"), flags=re.S)
    context = click.Context(tmm_gen)
    for name, rest in NAMED.findall(text):
        command = tmm_gen.get_command(context, name)
        assert command is not None, f"{page.name}: tmm-gen {name}"
        known = {option for parameter in command.params for option in parameter.opts}
        unknown = [word for word in re.findall(r"(?<![\w-])--[a-z][a-z-]*", rest) if word not in known]
        assert not unknown, f"{page.name}: tmm-gen {name}{rest}"

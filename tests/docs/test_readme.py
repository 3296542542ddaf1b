"""The README is run, and its links followed: what it tells a newcomer to type works as printed."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
README = ROOT / "README.md"
DOCUMENTS = [README, *sorted((ROOT / "docs").glob("**/*.md"))]

FENCE = re.compile(
    r"^(?P<indent> *)```(?P<language>[\w-]*)[^\n]*\n(?P<body>.*?)^(?P=indent)```\s*$", re.M | re.S
)
# These would run this very test again, or install from the network: it is enough that they exist.
MAKE = re.compile(r"make(?P<targets>( [a-z][a-z-]*)+)")
CI = re.compile(r"(bash )?(\./)?\.ci/run")


@dataclass(frozen=True)
class Block:
    line: int
    commands: tuple[str, ...]


def _commands(body: str, prompts_only: bool) -> Iterator[str]:
    """Lines after a `$ ` prompt, joined where a backslash ends one; or, in sh without prompts, all lines."""
    prompted = prompts_only or re.search(r"^\$ ", body, flags=re.M) is not None
    joined = re.sub(r"\\\n(> )?", "", body)
    for line in joined.splitlines():
        if prompted and line.startswith("$ "):
            yield line[2:].strip()
        elif not prompted and line.strip() and not line.lstrip().startswith("#"):
            yield line.strip()


def _blocks(text: str) -> list[Block]:
    found = []
    for fence in FENCE.finditer(text):
        if fence["language"] in {"console", "sh"}:
            body = re.sub(rf"^{fence['indent']}", "", fence["body"], flags=re.M)
            line = text.count("\n", 0, fence.start()) + 1
            found.append(Block(line, tuple(_commands(body, fence["language"] == "console"))))
    return found


def _assert_make_targets(command: str, targets: list[str], where: str) -> None:
    done = subprocess.run(
        ["make", "--dry-run", *targets], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, f"{where}: {command}: {done.stderr}"


def test_blocks_are_found_as_they_are_written() -> None:
    text = (
        "```console\n$ one \\\n>   more\noutput\n$ two  # said\n```\n"
        "```sh\n# said\nthree\n```\n"
        "- item\n  ```sh\n  $ four\n  output\n  ```\n"
        "```python\n$ not\n```\n"
    )
    assert [block.commands for block in _blocks(text)] == [
        ("one   more", "two  # said"),
        ("three",),
        ("four",),
    ]
    assert [block.line for block in _blocks(text)] == [1, 7, 12]


def test_other_names_for_a_shell_do_not_hide_commands() -> None:
    languages = {fence["language"] for fence in FENCE.finditer(README.read_text())}
    assert not languages & {"bash", "shell", "shell-session", "zsh", ""}


def test_every_command_of_the_readme_works(
    tmp_path: Path, borrow_environment: Callable[[Path], Path]
) -> None:
    blocks = _blocks(README.read_text())
    assert blocks
    copy = tmp_path / "tmm-gen"
    outputs = shutil.ignore_patterns(".git", ".venv*", ".*_cache", ".hypothesis", "__pycache__")
    shutil.copytree(ROOT, copy, ignore=lambda folder, names: {*outputs(folder, names), *_at_root(folder)})

    # What `make demo` leaves behind. It is not on PATH: the README must say how to have the command.
    programs = borrow_environment(copy / ".venv")
    script = programs / "tmm-gen"
    script.write_text(f'#!/bin/sh\nexec "{programs / "python"}" -m tmm_gen "$@"\n')
    script.chmod(0o755)
    bare_path = [folder for folder in os.get_exec_path() if not (Path(folder) / "tmm-gen").exists()]
    environment = {
        **{name: value for name, value in os.environ.items() if name != "VIRTUAL_ENV"},
        "PATH": os.pathsep.join(bare_path),
        "PYTHONPATH": str(copy / "src"),  # the copy's sources, not those this test runs from
    }

    runnable = []
    for block in blocks:
        where = f"README.md, block at line {block.line}"
        assert block.commands, f"{where}: no command in it"
        for command in block.commands:
            bare = command.partition("  #")[0].strip()
            if targets := MAKE.fullmatch(bare):
                _assert_make_targets(command, targets["targets"].split(), where)
            elif CI.fullmatch(bare):
                assert (ROOT / ".ci" / "run").is_file()
            else:
                runnable.append(command)
    (main,) = (fence["body"] for fence in FENCE.finditer(README.read_text()) if fence["language"] == "c")
    (copy / "main.c").write_text(main)
    # A reader pastes one block after another into one shell.
    done = subprocess.run(
        ["bash", "-exo", "pipefail", "-c", "\n".join(runnable)],
        cwd=copy,
        env=environment,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        check=False,
    )
    assert done.returncode == 0, f"README.md ended with {done.returncode}:\n{done.stdout}"


def _at_root(folder: str) -> set[str]:
    """Outputs at the root, which are not part of what a newcomer clones."""
    return {"out", "build", "dist"} if Path(folder) == ROOT else set()


def _without_code(text: str) -> str:
    return re.sub(r"`[^`\n]*`", "", FENCE.sub("", text))


def _links(text: str) -> list[str]:
    """Targets of links and images, inline, by reference, or in HTML."""
    text = _without_code(text)
    inline = re.findall(r"\]\(\s*<?([^)\s>]+)>?(?:\s+\"[^\"]*\")?\s*\)", text)
    by_reference = re.findall(r"^\s*\[[^\]^]+\]:\s*(\S+)", text, flags=re.M)
    html = re.findall(r"<(?:img|a|source)\b[^>]*?\b(?:src|href|srcset)=\"([^\"]+)\"", text)
    return [*inline, *by_reference, *html]


def _anchors(text: str) -> set[str]:
    """Anchors GitHub gives to headings."""
    headings = re.findall(r"^#{1,6}\s+(.*?)\s*#*\s*$", FENCE.sub("", text), flags=re.M)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def test_links_are_found_as_they_are_written() -> None:
    text = '[a](b.md#c "title") ![d](e.png) `[no](no.md)`\n\n[f]: g.md\n<img width="3" src="h.png">\n'
    assert _links(text) == ["b.md#c", "e.png", "g.md", "h.png"]
    assert _anchors("# One\n## Two: `three` & four\n") == {"one", "two-three--four"}


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda path: path.relative_to(ROOT).as_posix())
def test_relative_links_and_images_exist(document: Path) -> None:
    text = document.read_text()
    broken = []
    for link in _links(text):
        if re.match(r"[a-z][a-z0-9+.-]*:", link):
            continue
        path, _, anchor = link.partition("#")
        target = (document.parent / path).resolve() if path else document
        if not (target.is_relative_to(ROOT) and target.exists()) or (
            anchor and target.suffix == ".md" and anchor not in _anchors(target.read_text())
        ):
            broken.append(link)
    assert not broken

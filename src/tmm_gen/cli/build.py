"""`tmm-gen build`: the generated packages of scenes, written or compared."""

from __future__ import annotations

import shlex
from collections.abc import Sequence
from dataclasses import dataclass, fields
from difflib import get_close_matches, unified_diff
from keyword import iskeyword
from pathlib import Path
from typing import TYPE_CHECKING

import click

from tmm_gen.cli.console import Column, progress, table
from tmm_gen.cli.hints import hinted
from tmm_gen.cli.kinds import served_scene
from tmm_gen.errors import CheckFailed, UserError

if TYPE_CHECKING:
    from tmm_gen.package.write import Changes
    from tmm_gen.scene import Scene

# Scenes are read, and what emits them is imported, inside: a build with nothing to do needs no SymPy.

_SCENES = Path("scenes")
_BUILT, _UP_TO_DATE, _DRIFT = "built", "up to date", "drift"


@dataclass(frozen=True)
class _Row:
    """What became of one package."""

    scene: str
    folder: Path
    state: str
    written: tuple[str, ...]
    removed: tuple[str, ...]
    unchanged: tuple[str, ...]
    without_motion: bool

    def as_dict(self) -> dict[str, object]:
        """Return the row for a table."""
        return {item.name: getattr(self, item.name) for item in fields(self)}


@click.command("build")
@click.argument("scenes", metavar="[SCENE ...]", nargs=-1)
@click.option("--check", is_flag=True, help="Write nothing; show what would change, exit 1 if anything.")
@click.option(
    "--out",
    type=click.Path(file_okay=False, path_type=Path),
    default=Path("generated"),
    show_default=True,
    help="Folder of the packages; made if missing.",
)
@click.option("--force", is_flag=True, help="Overwrite also files edited by hand or not tmm-gen's.")
@click.option("--json", "json_mode", is_flag=True, help="One JSON object instead of a table.")
def build(scenes: tuple[str, ...], check: bool, out: Path, force: bool, json_mode: bool) -> None:
    """Generate the kernels of SCENEs, files or names of scenes in scenes/; by default all of scenes/.

    Files that have been edited by hand stop the build, so that no edit is lost.
    """
    loaded = _load(scene_files(scenes))
    with progress("comparing" if check else "building", total=len(loaded)) as advance:
        rows: list[_Row] = []
        drift: list[str] = []
        hints: list[str] = []
        for scene in loaded:
            advance(0, scene.name)
            row, found = _compare(scene, out) if check else _build(scene, out, force)
            rows.append(row)
            if check or row.state == _BUILT:  # as compilers warn of what they compile
                hints += hinted(scene, json_mode)
            drift += found
            advance()
    if not json_mode:
        for line in drift:
            click.echo(line)
    table([row.as_dict() for row in rows], _columns(check), json_mode, more={"hints": hints})
    if not json_mode and not check and (names := [s.name for s in loaded if "numpy" in s.emit.backends]):
        click.echo(import_line(out, names))
    if not json_mode:
        for row in rows:
            if row.without_motion:
                click.echo(
                    f"{row.scene}: the C's test holds no motion, as no start leads to steps within range"
                )
    if differing := [row.scene for row in rows if row.state == _DRIFT]:
        command = " ".join(["tmm-gen build", *scenes])
        raise CheckFailed(f"{out}/ is not what the scenes give: {', '.join(differing)}. Run `{command}`.")


def import_line(out: Path, names: Sequence[str]) -> str:
    """Return how to import packages, and from where: Python looks in the folder of a script, not in the current one.

    Parameters
    ----------
    out : Path
        Folder of the packages.
    names : sequence of str
        Of the packages.
    """
    folder = out.resolve()
    package = folder.name.isidentifier() and not iskeyword(folder.name)
    root = folder.parent if package else folder
    here = root == Path.cwd()
    which = names[0] if len(names) == 1 else "NAME"
    module = f"{folder.name}.{which}" if package else which
    where = "this folder" if here else str(root)
    path = "." if here else shlex.quote(str(root))
    return f"In Python: from {module} import simulate, with {where} on its path: PYTHONPATH={path} python SCRIPT.py"


def scene_files(named: Sequence[str]) -> list[Path]:
    """Return the files of scenes: named by file or, if in ``scenes/``, by name; all of ``scenes/`` for none.

    Raises
    ------
    UserError
        If there is no such scene.
    """
    known = {path.stem: path for path in sorted(_SCENES.glob("*.toml"))}
    if not named and not known:
        remedy = "Name a file, or make one by `tmm-gen new NAME`."
        raise UserError(f"no scene: {_SCENES}/ holds no *.toml here. {remedy}")
    return [_scene_file(word, known) for word in named] if named else list(known.values())


def _scene_file(word: str, known: dict[str, Path]) -> Path:
    path = Path(word)
    if path.suffix == ".toml" or path.exists():
        return path  # reading it says what is wrong with it
    if word in known:
        return known[word]
    if near := get_close_matches(word, known, n=1):
        remedy = f"Did you mean '{near[0]}'?"
    else:
        remedy = f"Name a *.toml file, or one of: {', '.join(known)}." if known else "Name a *.toml file."
    raise UserError(f"no scene '{word}' in {_SCENES}/. {remedy}")


def _load(paths: Sequence[Path]) -> list[Scene]:
    """Read all scenes before anything is written; no two may be one package."""
    loaded: dict[str, Scene] = {}
    for path in paths:
        scene = served_scene("build", path)
        if (other := loaded.get(scene.name)) is not None and other.source.origin != scene.source.origin:
            raise UserError(
                f"{path}: has the name '{scene.name}', as {other.source.origin} has. Change one of the two, "
                "since the name is also the package's."
            )
        loaded[scene.name] = scene
    return list(loaded.values())


def _build(scene: Scene, out: Path, force: bool) -> tuple[_Row, list[str]]:
    from tmm_gen.package.cache import is_up_to_date, remember

    folder = out / scene.name
    if is_up_to_date(scene.digest, folder):
        return _row(scene, folder, _UP_TO_DATE, _nothing(folder)), []
    from tmm_gen.package.texts import emit_package
    from tmm_gen.package.write import write_package

    files = emit_package(scene)
    changes = write_package(files, folder, force=force)
    remember(scene.digest, files)
    return _row(scene, folder, _BUILT if changes.written or changes.stale else _UP_TO_DATE, changes), []


def _compare(scene: Scene, out: Path) -> tuple[_Row, list[str]]:
    """Generate anew, whatever is remembered, and compare."""
    from tmm_gen.package.texts import emit_package
    from tmm_gen.package.write import compare_package

    folder = out / scene.name
    changes = compare_package(emit_package(scene), folder)
    drift = bool(changes.written or changes.stale)
    wanted = {**changes.written, **dict.fromkeys(changes.stale, "")}
    lines = [line for path in sorted(wanted) for line in _difference(path, wanted[path])]
    return _row(scene, folder, _DRIFT if drift else _UP_TO_DATE, changes), lines


def _difference(path: Path, wanted: str) -> list[str]:
    """Return what a build would change in a file."""
    from tmm_gen.package.write import text_of

    held = text_of(path) if path.is_file() else ""
    name = path.as_posix()
    before, after = (name if held else "/dev/null"), (name if wanted else "/dev/null")
    return list(unified_diff(held.splitlines(), wanted.splitlines(), before, after, lineterm=""))


def _nothing(folder: Path) -> Changes:
    from tmm_gen.package.write import Changes, written_files

    return Changes({}, (), tuple(written_files(folder)))


def _row(scene: Scene, folder: Path, state: str, changes: Changes) -> _Row:
    written, removed, unchanged = (
        tuple(path.relative_to(folder).as_posix() for path in paths)
        for paths in (changes.written, changes.stale, changes.unchanged)
    )
    return _Row(scene.name, folder, state, written, removed, unchanged, _without_motion(scene, folder))


def _without_motion(scene: Scene, folder: Path) -> bool:
    """Whether the C's test has nothing to compare a motion with."""
    from tmm_gen.package.write import text_of, without_motion

    test = folder / "c" / f"test_{scene.name}.c"
    return test.is_file() and without_motion(text_of(test))


def _columns(check: bool) -> list[Column | str]:
    def count(files: object) -> str:
        return str(len(files)) if isinstance(files, list) else "-"

    return [
        "scene",
        "folder",
        "state",
        Column("written", "differing" if check else "written", count, "right"),
        Column("removed", "stale" if check else "removed", count, "right"),
        Column("unchanged", form=count, justify="right"),
    ]

"""`tmm-gen build`: the generated packages of scenes, written or compared."""

from __future__ import annotations

import re
import shlex
from collections.abc import Sequence
from keyword import iskeyword
from pathlib import Path
from typing import TYPE_CHECKING

import click

from tmm_gen.cli.changes import changed_scene
from tmm_gen.cli.console import Column, progress, table
from tmm_gen.cli.hints import hinted
from tmm_gen.errors import CheckFailed, UserError

if TYPE_CHECKING:
    from tmm_gen.package.build import Built
    from tmm_gen.scene import Scene

# Scenes are read, and what emits them is imported, inside: a build with nothing to do needs no SymPy.

_SCENES = Path("scenes")
_PACKAGES = Path("generated")


@click.command("build")
@click.argument("scenes", metavar="[SCENE ...]", nargs=-1)
@click.option("--check", is_flag=True, help="Write nothing; show what would change, exit 1 if anything.")
@click.option(
    "--out",
    type=click.Path(file_okay=False, path_type=Path),
    default=_PACKAGES,
    show_default=True,
    help="Folder of the packages; made if missing.",
)
@click.option("--force", is_flag=True, help="Overwrite also files edited by hand or not tmm-gen's.")
@click.option("--json", "json_mode", is_flag=True, help="One JSON object instead of a table.")
def build(scenes: tuple[str, ...], check: bool, out: Path, force: bool, json_mode: bool) -> None:
    """Generate the kernels of SCENEs, files or names of scenes in scenes/; by default all of scenes/.

    Files that have been edited by hand stop the build, so that no edit is lost.
    """
    from tmm_gen.package.build import BUILT, DRIFT, Built, built, compared

    loaded = _load(scene_files(scenes), None if check else out)
    with progress("comparing" if check else "building", total=len(loaded)) as advance:
        rows: list[Built] = []
        drift: list[str] = []
        hints: list[str] = []
        for name, scene in loaded.items():
            advance(0, name)
            if isinstance(scene, Built):
                rows.append(scene)
            else:
                row, found = compared(scene, out) if check else (built(scene, out, force), [])
                rows.append(row)
                if check or row.state == BUILT:  # as compilers warn of what they compile
                    hints += hinted(scene, json_mode)
                drift += found
            advance()
    if not json_mode:
        for line in drift:
            click.echo(line)
    table([row.as_dict() for row in rows], _columns(check), json_mode, more={"hints": hints})
    if not json_mode and not check:
        for file, taken in (("__init__.py", import_line), ("c/{}.c", cmake_line)):
            if names := [row.scene for row in rows if _holds(row, file.format(row.scene))]:
                click.echo(taken(out, names))
    if not json_mode:
        for row in rows:
            if row.without_motion:
                click.echo(
                    f"{row.scene}: the C's test holds no motion, as no start leads to steps within range"
                )
    if differing := [row.scene for row in rows if row.state == DRIFT]:
        elsewhere = [] if out == _PACKAGES else ["--out", str(out)]
        command = shlex.join(["tmm-gen", "build", *scenes, *elsewhere])
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
    below = folder.parent == Path.cwd() and folder.name.isidentifier() and not iskeyword(folder.name)
    which = names[0] if len(names) == 1 else "NAME"
    module = f"{folder.name}.{which}" if below else which
    where, path = ("this folder", ".") if below else (str(out), shlex.quote(str(out)))
    return f"In Python: from {module} import simulate, with {where} on its path: PYTHONPATH={path} python SCRIPT.py"


def cmake_line(out: Path, names: Sequence[str]) -> str:
    """Return how a CMake project takes the C of packages.

    Parameters
    ----------
    out : Path
        Folder of the packages.
    names : sequence of str
        Of the packages.
    """
    which = names[0] if len(names) == 1 else "NAME"
    folder = str(out / which / "c")
    if not re.fullmatch(r"[\w./+-]+", folder):
        folder = '"' + re.sub(r'(["\\$])', r"\\\1", folder) + '"'
    if out.is_absolute() or ".." in out.parts:  # CMake asks where to build what is not in its own tree
        folder += f" {which}"
    return (
        f"In CMake: add_subdirectory({folder}), and link tmm_{which}; without CMake compile {which}.c there"
    )


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
    from difflib import get_close_matches

    if near := get_close_matches(word, known, n=1):
        remedy = f"Did you mean '{near[0]}'?"
    else:
        remedy = f"Name a *.toml file, or one of: {', '.join(known)}." if known else "Name a *.toml file."
    raise UserError(f"no scene '{word}' in {_SCENES}/. {remedy}")


def _load(paths: Sequence[Path], out: Path | None) -> dict[str, Scene | Built]:
    """Read all scenes before anything is written; no two may be one package.

    Parameters
    ----------
    paths : sequence of Path
        Of the scenes.
    out : Path or None
        Folder of the packages: scenes whose packages are known to be there are not read; None reads all.

    Returns
    -------
    dict from str to Scene or Built
        By name, in order of first mention.
    """
    from tmm_gen.package.build import up_to_date

    loaded: dict[str, Scene | Built] = {}
    origins: dict[str, str] = {}
    for path in paths:
        scene: Scene | Built
        if out is not None and (known := up_to_date(path, out)) is not None:
            scene, name = known, known.scene
        else:
            scene = changed_scene(path)
            name = scene.name
        if (other := origins.setdefault(name, str(path))) != str(path):
            raise UserError(
                f"{path}: has the name '{name}', as {other} has. Change one of the two, "
                "since the name is also the package's."
            )
        loaded[name] = scene
    return loaded


def _holds(row: Built, file: str) -> bool:
    """Whether a package has a file: a kernel in NumPy, which its ``__init__.py`` shows, or in C."""
    return file in (*row.written, *row.unchanged)


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

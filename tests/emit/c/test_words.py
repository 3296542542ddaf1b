"""What no member may be called and no ``#undef`` may take away is read off the emitted texts themselves."""

from __future__ import annotations

import re
import subprocess
from functools import cache
from typing import Any

import pytest

from tmm_gen.c_language.names import bare_names, declared, macros, signal
from tmm_gen.c_language.words import taken
from tmm_gen.emit.c import emit_c
from tmm_gen.emit.c.box import box_of
from tmm_gen.emit.c.kernel import Kernel
from tmm_gen.export.fmu.unit import unit_content
from tmm_gen.program.build import build_program
from tmm_gen.resources import templates_dir
from tmm_gen.scene import Scene, load_scene
from tmm_gen.target.harness import harness
from tmm_gen.target.proof import driver

pytestmark = pytest.mark.compiler


def without_words(text: str) -> str:
    """Return C without comments and strings."""
    return re.sub(r"/\*.*?\*/|//[^\n]*|\"(?:\\.|[^\"\\\n])*\"", "", text, flags=re.DOTALL)


@cache
def library(includes: tuple[str, ...], *options: str) -> str:
    """Return headers of the C library, preprocessed as options say."""
    done = subprocess.run(
        ["gcc", "-std=gnu17", "-D_GNU_SOURCE", "-E", *options, "-"],
        input="".join(f"#include <{name}>\n" for name in includes),
        capture_output=True,
        text=True,
        check=True,
    )
    return done.stdout


def needed(text: str) -> set[str]:
    """Return names that a source takes from headers of the C library, functions and macros, and its own macros."""
    code = without_words(text)
    found = re.findall(r"^#include <(\w[\w/]*\.h)>", text, re.MULTILINE)
    includes = tuple(dict.fromkeys(name for name in found if not name.startswith(("fmi", "__fc"))))
    own = set(re.findall(r"^#define (\w+)", code, re.MULTILINE))
    used = set(re.findall(r"\b[A-Za-z]\w*", re.sub(r"^#(?:include|undef).*", "", code, flags=re.MULTILINE)))
    library_macros = set(re.findall(r"^#define (\w+)", library(includes, "-dM"), re.MULTILINE))
    declares = library(includes)
    calls = {name for name in used if re.search(rf"\b{name}\(", code)}
    functions = {name for name in calls if re.search(rf"\b{name} ?\(", declares)}
    return own | (used & library_macros) | functions


@cache
def sources(scene: Scene) -> dict[str, str]:
    """Return what is emitted for a scene and uses its signals: kernel, tests, programs for boards and proofs."""
    program = build_program(scene)
    kernel = Kernel.of(program, scene)
    files = {path: text for path, text in emit_c(program, scene).items() if path.endswith((".c", ".h"))}
    files["harness.c"] = harness(kernel, "systick")
    if (box := box_of(scene)) is not None:
        files["proof.c"] = driver(kernel, box)
    if (
        kernel.real.number_size == kernel.real.size
        and not kernel.bound
        and box is None
        and kernel.circle is None
    ):
        files |= unit_content(program, scene.replace(**{"emit.sensitivities": None}), 2).filled(2)[0]
    return files


@pytest.fixture(
    scope="module",
    params=[
        ("thesis2", {}),
        ("thesis10", {"emit.real": "float32"}),
        ("thesis10", {"emit.real": "float32", "emit.compensated": True, "emit.box": None}),
        ("arm2", {"emit.real": "float32"}),
        ("arm2", {"emit.trigonometry": "own", "emit.parameters": "bound", "emit.box": None}),
        ("thesis2", {"integrator.name": "sdirk2", "emit.sensitivities": True}),
        ("arm2", {"emit.trigonometry": "own", "emit.batch": 8, "emit.box": None}),
    ],
    ids=str,
)
def scene(request: pytest.FixtureRequest, repository: Any) -> Scene:
    name, changes = request.param
    made = load_scene(repository / "scenes" / f"{name}.toml")
    present = {key: value for key, value in changes.items() if value is not None or _has(made, key)}
    return made.replace(**present)


def _has(scene: Scene, key: str) -> bool:
    value: Any = scene
    for part in key.split("."):
        value = getattr(value, part)
    return value not in (None, False, "libm")


def test_what_emitted_sources_need_is_theirs(scene: Scene) -> None:
    chosen = {*bare_names(build_program(scene))}
    for path, text in sources(scene).items():
        members = "#undef" in text or path.endswith(".h")
        for name in needed(text) - chosen if members else ():
            assert taken(name, scene.name, macros(scene.name)) or name.startswith("_"), (path, name)


@pytest.mark.parametrize(
    "name",
    [path.stem for path in sorted((templates_dir() / "control").iterdir())],
)
def test_what_controllers_need_is_theirs(name: str) -> None:
    text = (templates_dir() / "control" / f"{name}.jinja").read_text()
    text = re.sub(r"\{\{ (?!NAME).*?\}\}|\{%.*?%\}", "", text)
    text = "#include <math.h>\n#include <string.h>\n" + text.replace("{{ NAME }}", "ARM_RTI")
    assert [word for word in sorted(needed(text)) if not (taken(word, "arm", "ARM") or word[0] == "_")] == []


def test_sources_lift_macros_off_exactly_their_bare_names(scene: Scene) -> None:
    program = build_program(scene)
    names = bare_names(program)
    assert names
    for path, text in sources(scene).items():
        lifted = re.findall(r"^#undef (\w+)$", text, re.MULTILINE)
        uses = re.search(r"\b(?:in|out)puts(?:->|\.)", without_words(text))
        assert lifted == (names if path.endswith(".c") and uses else []), path
        if lifted:  # behind the C library's headers, before the scene's own
            behind = text[text.rindex("#undef") :]
            assert "#include <" not in behind
            assert '#include "' in behind


def test_declarations_are_bare_where_no_macro_is(scene: Scene) -> None:
    program = build_program(scene)
    text = next(text for path, text in sources(scene).items() if path == f"c/{scene.name}.h")
    for variable in (*program.inputs, *program.outputs):
        name = signal(variable.name, scene.name)
        assert name == variable.name
        first, second, third, fourth, last = declared(name, "real ", ";", "")
        assert f"\n{first}\n" in text
        assert f"\n{third}\n" in text
        assert re.search(rf"_real tmm_{name}(\[\w+\])?;\n{last}\n", text)
        assert second.replace(name, f"tmm_{name}") == fourth

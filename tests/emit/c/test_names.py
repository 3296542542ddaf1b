"""Whatever users call inputs, outputs and scenes: macros of any header, keywords of C and C++, names of our own."""

from __future__ import annotations

import keyword
import re
import subprocess
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st

from tmm_gen.c_language.names import PREFIX, macros, signal
from tmm_gen.emit.c import emit_c, emit_kernel
from tmm_gen.program.build import build_program
from tmm_gen.scene import parse_scene
from tmm_gen.scene.identifier import name_fault, scene_name_fault

pytestmark = pytest.mark.compiler

HEADERS = """assert complex ctype errno fenv float inttypes iso646 limits locale math setjmp signal stdarg stdbool
stddef stdint stdio stdlib string tgmath time wchar wctype unistd sys/types sys/socket
netinet/in pthread poll fcntl termios"""
DIALECTS = {
    "C": (("gcc", "-std=c99", "-pedantic", "-Werror"), ("gcc", "-std=gnu17", "-Werror")),
    "C++": (("g++", "-std=gnu++17", "-Werror"),),
}
CPP = """
alignas alignof and and_eq asm auto bitand bitor bool break case catch char char16_t class compl
const constexpr const_cast continue decltype default delete do double dynamic_cast else enum
explicit export extern false float for friend goto if inline int long mutable namespace new noexcept
not not_eq nullptr operator or or_eq private protected public register reinterpret_cast restrict
return short signed sizeof static static_assert static_cast struct switch template this thread_local
throw true try typedef typeid typename union unsigned using virtual void volatile wchar_t while xor
xor_eq
"""
OWN = """
k i j x y u p h n t step state model params inputs outputs real pair circle total count status bad
before none main unknown known_rate known_angle tally expect printf memset memcmp BUFSIZ EOF NULL
NAN INFINITY HUGE_VAL M_PI linux unix FP_ZERO ARM_STEP ARM_OK ARM_STATIONS tmm_tip
"""


FEW = settings(
    max_examples=2,
    phases=[Phase.generate],  # a compiler says what is wrong; making lists shorter would take it long
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)


def included() -> str:
    return "".join(f"#include <{header}.h>\n" for header in HEADERS.split())


@cache
def hostile() -> tuple[str, ...]:
    """Return macros of all standard headers in the loosest dialect, keywords, and names that kernels use."""
    done = subprocess.run(
        ["gcc", "-std=gnu17", "-D_GNU_SOURCE", "-dM", "-E", "-"],
        input=included(),
        capture_output=True,
        text=True,
        check=True,
    )
    found = {*re.findall(r"^#define (\w+)", done.stdout, re.MULTILINE), *CPP.split(), *OWN.split()}
    found |= {f"{name}_{end}" for name in ("ARM", "arm") for end in ("STEP", "H", "step", "inputs", "real")}
    return tuple(sorted(name for name in found if name_fault(name) is None))


def names(count: int) -> st.SearchStrategy[list[str]]:
    """Return lists of different names, most of them hostile."""
    random = st.from_regex(r"[A-Za-z][A-Za-z0-9_]{0,20}", fullmatch=True).filter(
        lambda x: name_fault(x) is None
    )
    one = st.one_of(st.sampled_from(hostile()), st.sampled_from(hostile()), random)
    return st.lists(one, min_size=count, max_size=count, unique=True)


def scene_text(name: str, called: list[str], real: str = "float64", kind: str = "chain") -> str:
    """Return a scene of two links whose signals have these names, three of them inputs."""
    base = 'kind = "motor"\ninertia = 0.3\n'
    link = "inertia = 0.7\n" + ("mass = 0.5\nlength = 0.4\n" if kind == "planar" else "")
    stations = f"[[joint]]\nstiffness = 30.0\ndamping = 0.1\n[[link]]\n{link}" * 2
    inputs = "".join(
        f'[[input]]\nname = "{x}"\nat = {at}\nacts = "torque"\n'
        for x, at in zip(called[:3], ('"base"', "1", '"tip"'), strict=True)
    )
    outputs = "".join(
        f'[[output]]\nname = "{x}"\nat = {k % 2 + 1}\nof = "velocity"\n' for k, x in enumerate(called[3:])
    )
    return (
        f'name = "{name}"\n[model]\nkind = "{kind}"\n[integrator]\nname = "newmark"\nstep = 0.01\n'
        f'[emit]\nreal = "{real}"\n[base]\n{base}{stations}{inputs}{outputs}'
    )


def emitted(text: str) -> dict[str, str]:
    scene = parse_scene(text)
    return {Path(path).name: content for path, content in emit_c(build_program(scene), scene).items()}


@pytest.fixture(params=DIALECTS)
def language(request: pytest.FixtureRequest, need_tool: Callable[[str], str]) -> str:
    """What headers are used from."""
    if request.param == "C++":
        need_tool("g++")
    return str(request.param)


def compile_all(folder: Path, files: dict[str, str], users: dict[str, str], language: str) -> None:
    """Compile C files and users of their headers in the dialects of C; in C++, the users alone."""
    for name, text in {**files, **users}.items():
        (folder / name).write_text(text)
    for compiler, *flags in DIALECTS[language]:
        sources = [n for n in (*files, *users) if n.endswith(".c") and (language == "C" or n in users)]
        done = subprocess.run(
            [compiler, *flags, "-fsyntax-only", "-x", language.lower(), *sources],
            cwd=folder,
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == 0, done.stderr


def use(scene: str, name: str, text: str) -> str:
    """Return a line that uses a member as any program can: by its name, or with the prefix where that is a macro."""
    prefixed = text.format(PREFIX + name)
    if signal(name, scene) != name:
        return f"    {prefixed}\n"
    return f"#ifdef {name}\n    {prefixed}\n#else\n    {text.format(name)}\n#endif\n"


def user_of(scene: str, called: list[str], before: str) -> str:
    """Return a program that includes everything before a kernel's header, and reads and writes every signal."""
    body = "".join(use(scene, name, "in->{} = 1.0f;") for name in called[:3])
    body += "".join(use(scene, name, "if (out->{} > 2.0f) return 1;") for name in called[3:])
    plain = before.replace("#include <complex.h>", "").replace("#include <tgmath.h>", "")
    head = f"int use_{scene}({scene}_inputs *in, const {scene}_outputs *out)"
    return (
        f"#ifndef __cplusplus\n{before}#else\n{plain}#endif\n"
        f'#include "{scene}.h"\n#include "{scene}.h"\n{head};\n'
        f"{head}\n{{\n{body}    return (int){macros(scene)}_OK;\n}}\n"
    )


def first_of(scene: str, called: list[str], behind: str) -> str:
    """Return a program that includes a kernel's header before all others: bare names, but for macros of gcc itself."""
    body = "".join(use(scene, name, "in->{} = 1.0f;") for name in called[:3])
    body += "".join(use(scene, name, "if (out->{} > 2.0f) return 1;") for name in called[3:])
    head = f"int first_{scene}({scene}_inputs *in, const {scene}_outputs *out)"
    return (
        f'#include "{scene}.h"\n{head};\n{head}\n{{\n{body}    return 0;\n}}\n{behind}#include "{scene}.h"\n'
    )


@FEW
@given(called=names(40))
def test_signals_may_have_any_name(called: list[str], language: str, tmp_path: Path) -> None:
    users = {"user.c": user_of("arm", called, included())}
    users["first.c"] = first_of("arm", called, "#include <math.h>\n#include <stdio.h>\n#include <string.h>\n")
    compile_all(tmp_path, emitted(scene_text("arm", called)), users, language)


def test_every_dialect_finds_the_same_member(language: str, tmp_path: Path) -> None:
    """Kernels and programs of different dialects disagree on what is a macro, never on where a signal lies."""
    hostile = ["linux", "NAN", "EOF", "register", "M_PI", "k", "unix", "ARM_STEP", "tmm_k", "xor", "arm_real"]
    printed: dict[tuple[str, ...], set[str]] = {}
    for called in (hostile, [f"plain_{n}" for n in range(len(hostile))]):
        folder = tmp_path / called[0]
        folder.mkdir()
        files = emitted(scene_text("arm", called))
        for name, text in files.items():
            (folder / name).write_text(text)
        sets = "".join(use("arm", name, f"in.{{}} = {k + 1}.25;") for k, name in enumerate(called[:3]))
        shows = "".join(use("arm", name, 'printf("%.17g\\n", out.{});') for name in called[3:])
        (folder / "main.c").write_text(
            "#include <stdio.h>\n#include <math.h>\n#include <stdlib.h>\n#include <unistd.h>\n"
            f"""#include "arm.h"
int main(void)
{{
    arm_params params; arm_model model; arm_state state; arm_inputs in; arm_outputs out;
{sets}    arm_default_params(&params);
    if (arm_prepare(&model, &params, ARM_STEP) != ARM_OK) return 1;
    if (arm_initialise(&state, &params, NULL, NULL, &in) != ARM_OK) return 2;
    for (int n = 0; n < 10; ++n) if (arm_step(&model, &state, &in) != ARM_OK) return 3;
    arm_output(&model, &state, &out);
{shows}    return 0;
}}
"""
        )
        subprocess.run(["gcc", "-std=c99", "-c", "arm.c"], cwd=folder, check=True)
        for compiler, *flags in (*DIALECTS["C"], *(DIALECTS[language] if language != "C" else ())):
            said = "c++" if compiler == "g++" else "c"
            command = [compiler, *flags, "-x", said, "main.c", "-x", "none", "arm.o", "-lm", "-o", "run"]
            subprocess.run(command, cwd=folder, check=True)
            done = subprocess.run(["./run"], cwd=folder, capture_output=True, text=True, check=True)
            printed.setdefault(tuple(called), set()).add(done.stdout)
    first, second = printed.values()
    assert len(first) == 1
    assert first == second
    assert len(set(next(iter(first)).split())) == 2  # rates of the first and of the last station, in turn


def test_signals_of_own_names_stay_apart() -> None:
    called = ["NAN", "tmm_NAN", "tmm_tmm_NAN", "NaN", "tmm_Arm_STEP", "Arm_STEP"]
    for scene in ("arm", "Arm", "k"):
        members: list[str] = []
        for name in called:
            bare = signal(name, scene) == name
            members += [name, PREFIX + name] if bare else [PREFIX + name]
        assert len(set(members)) == len(members)


@FEW
@given(scenes=names(2), called=names(5))
def test_scenes_may_have_any_name_and_share_a_program(
    scenes: list[str], called: list[str], language: str, tmp_path: Path
) -> None:
    fine = [name for name in dict.fromkeys([*scenes, "R", "w", "linux"]) if scene_name_fault(name) is None]
    files: dict[str, str] = {}
    users: dict[str, str] = {}
    for name in fine:
        # the kernel of a scene is the same but for its name, which nothing else contains
        files |= emitted(scene_text(name, called))
        users[f"user_{name}.c"] = user_of(name, called, included())
    compile_all(tmp_path, files, users, language)


def test_macros_of_two_names_differ() -> None:
    found = [
        macros(name)
        for name in ("arm", "Arm", "ARM", "aRM", "tmm_arm", "tmm_Arm", "a", "A", "TMM_A", "tmm_a")
    ]
    assert len(set(found)) == len(found)


def test_names_of_one_scene_are_never_those_of_another() -> None:
    """``arm_default_params`` is a function of ``arm``: no scene ``arm_default`` may have params in its program."""
    called = ["u", "v", "w", "x", "y"]
    ends: set[str] = set()
    for kind, integrator, changes in (
        ("chain", "sdirk2", "sensitivities = true"),
        ("planar", "newmark", 'trigonometry = "own"'),
        ("chain", "newmark", 'real = "float32"\ncompensated = true'),
    ):
        text = scene_text("arm", called, kind=kind).replace('real = "float64"', changes)
        scene = parse_scene(text.replace('"newmark"', f'"{integrator}"'))
        for path, content in emit_kernel(build_program(scene), scene).items():
            if path.endswith(".h"):
                code = re.sub(r"/\*.*?\*/", "", content, flags=re.DOTALL)
                ends |= set(re.findall(r"\b(?:arm|ARM)_(\w+)", code))
    assert {
        "default_params",
        "INVALID_STEP",
        "STEP",
        "params",
        "state_tangents",
        "pair",
        "STAGES",
        "LANES",
        "LARGEST_ANGLE",
    } <= ends

    def names_of(scene: str) -> set[str]:
        return {f"{macros(scene) if end.isupper() else scene}_{end}" for end in ends}

    for base in ("arm", "Arm", "ARM", "a"):
        for other in {end.rsplit("_", k)[0] for end in ends for k in range(1, end.count("_") + 1)}:
            for scene in (f"{base}_{other}", f"{base}_{other.lower()}", f"{base}_{other.upper()}"):
                assert scene_name_fault(scene) is not None or not names_of(base) & names_of(scene), scene


@given(
    st.lists(st.from_regex(r"[A-Za-z][A-Za-z0-9_]{0,8}", fullmatch=True), min_size=2, max_size=2, unique=True)
)
def test_macros_of_any_two_names_differ(pair: list[str]) -> None:
    assert macros(pair[0]) != macros(pair[1])


def test_scenes_of_two_cases_and_precisions_run_in_one_program(tmp_path: Path) -> None:
    called = ["k", "i", "u", "NAN", "lambda_", "EOF"]
    body = ""
    includes = ""
    for name, real in (("Arm", "float64"), ("ARM", "float32"), ("arm", "float32")):
        folder = tmp_path / f"in_{real}_{'up' if name == 'ARM' else name}"
        folder.mkdir()
        for file, text in emitted(scene_text(name, called, real)).items():
            (folder / file).write_text(text)
        includes += f'#include "{folder.name}/{name}.h"\n'
        body += f"""{{
    {name}_params params; {name}_model model; {name}_state state; {name}_outputs out;
    {name}_inputs in = {{.k = 1.0f}};
    {name}_default_params(&params);
    if ({name}_prepare(&model, &params, {macros(name)}_STEP) != {macros(name)}_OK) return 1;
    if ({name}_initialise(&state, &params, NULL, NULL, &in) != {macros(name)}_OK) return 2;
    for (int step = 0; step < 10; ++step) if ({name}_step(&model, &state, &in) != {macros(name)}_OK) return 3;
    {name}_output(&model, &state, &out);
    printf("%.5e\\n", (double)out.tmm_NAN);
}}
"""
    (tmp_path / "main.c").write_text(
        f"#include <stdio.h>\n{includes}int main(void)\n{{\n{body}return 0;\n}}\n"
    )
    kernels = [str(path) for path in tmp_path.glob("in_*/*.c") if not path.name.startswith("test_")]
    subprocess.run(["gcc", "-std=gnu17", "main.c", *kernels, "-lm", "-o", "run"], cwd=tmp_path, check=True)
    lines = subprocess.run(["./run"], cwd=tmp_path, capture_output=True, text=True, check=True).stdout.split()
    assert len(lines) == 3
    assert float(lines[0]) == pytest.approx(float(lines[1]), rel=1e-3)
    assert lines[1] == lines[2]


def test_no_name_of_the_kernels_own_looks_like_a_scenes(chain: Any) -> None:
    """Static functions and local variables never end as the types and functions of some scene would."""
    ends = [f"_{end}" for end in ("real", "pair", "status", "params", "model", "state", "inputs", "outputs")]
    ends += [f"_{end}" for end in ("default_params", "prepare", "initialise", "step", "output")]
    for kind in ({}, {"base": "motor", "integrator": "houbolt"}, {"integrator": "sdirk4", "real": "float32"}):
        of = chain(**kind, name="qqq")
        for path, text in of.files.items():
            code = re.sub(r"/\*.*?\*/|\"[^\"\n]*\"", "", text, flags=re.DOTALL)
            for word in set(re.findall(r"[A-Za-z]\w*", code)) if path.endswith((".c", ".h")) else ():
                if not word.lower().startswith(("qqq", "tmm_")):
                    assert not word.endswith(tuple(ends)), (path, word)


@pytest.mark.parametrize("word", [w for w in keyword.kwlist if w.isidentifier()])
def test_keywords_of_python_are_refused_with_a_remedy(word: str) -> None:
    found = name_fault(word)
    assert found is not None
    assert "Python" in found[0]
    assert f"'{word}_1'" in found[1]

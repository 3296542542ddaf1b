"""How emitted C reads."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from typing import Any

import pytest

from tmm_gen.emit.seal import is_intact
from tmm_gen.program.count import count_routine

KINDS = [
    {"base": "motor", "inner": True},
    {"integrator": "sdirk4", "base": "prescribed", "real": "float32"},
    {"integrator": "houbolt", "name": "a_quite_long_name_of_a_scene"},
]
ids = [str(kind.get("integrator", "newmark")) for kind in KINDS]


def code(text: str) -> str:
    """Return a text of C without its comments."""
    return re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL)


@pytest.mark.parametrize("kind", KINDS, ids=ids)
def test_form(kind: dict[str, Any], chain: Any) -> None:
    for path, text in chain(**kind).files.items():
        assert is_intact(text), path
        assert max(map(len, text.splitlines())) <= 110, path
        assert text.endswith("\n"), path
        assert "\t" not in text, path
        assert not re.search(r"[ \t]\n|\n\n\n", text), path
        assert "Undefined" not in text, path
        if path.endswith((".c", ".h")):
            assert text.isascii(), path


@pytest.mark.parametrize("kind", KINDS, ids=ids)
def test_no_heap_no_globals_no_asserts(kind: dict[str, Any], chain: Any) -> None:
    of = chain(**kind)
    kernel = code(of.files[f"c/{of.name}.c"])
    assert re.findall(r"#include (.*)", kernel) == ["<float.h>", "<math.h>", "<stddef.h>", f'"{of.name}.h"']
    assert not re.search(r"malloc|free|assert|goto|printf", kernel)
    outside = re.sub(r"\{.*?\n\}", "", kernel, flags=re.DOTALL)
    assert "=" not in outside  # nothing is defined outside functions


def test_float_is_float_throughout(chain: Any) -> None:
    of = chain(integrator="sdirk4", base="motor", real="float32")
    for path in ("c/arm.c", "c/arm.h"):
        text = code(of.files[path])
        assert "double" not in text
        literals = re.findall(r"(?<![\w.])\d+\.\d*(?:e[-+]?\d+)?\w?|(?<![\w.])\d+e[-+]?\d+\w?", text)
        assert literals
        assert all(literal.endswith("f") for literal in literals)
        assert not re.search(r"\b(?:sqrt|sin|cos|fabs)\(", text)


def test_header_states_costs_and_sizes(chain: Any) -> None:
    of = chain(alike=True, stations=10)
    header = of.files["c/arm.h"]
    total = count_routine(of.program.main).total
    assert f"operations of a step: {total}, {total / 10:g} per station" in header
    assert total / 10 <= 30
    assert "bytes of the structs: params 24, model 280, state 240, inputs 8, outputs 32" in header
    assert of.scene.digest in header


def test_sizes_are_those_of_the_compiler(chain: Any, written: Any, command: Any, tmp_path: Any) -> None:
    for kind in KINDS:
        of = chain(**kind)
        written(of.files)
        stated = re.search(r"bytes of the structs: (.*)", of.files[f"c/{of.name}.h"])
        assert stated
        sizes = dict(pair.rsplit(" ", 1) for pair in stated[1].split(", "))
        prints = "".join(f'    printf("%u ", (unsigned)sizeof({of.name}_{which}));\n' for which in sizes)
        main = f'#include <stdio.h>\n#include "{of.name}.h"\nint main(void)\n{{\n{prints}    return 0;\n}}\n'
        (tmp_path / "sizes.c").write_text(main)
        command("gcc", "sizes.c", "-o", "sizes")
        assert command("./sizes").split() == list(sizes.values())


def test_loops_stay_loops(chain: Any) -> None:
    """A hundred times the stations make no line more."""
    ten, thousand = (chain(alike=True, stations=n, base="motor").files for n in (10, 1000))
    for path in ("c/arm.c", "c/arm.h", "c/test_arm.c", "c/CMakeLists.txt"):
        assert len(ten[path].splitlines()) == len(thousand[path].splitlines()), path


@pytest.mark.compiler
@pytest.mark.parametrize("compiler", ["gcc", "clang"])
def test_machine_code_does_not_grow_with_stations(
    compiler: str, chain: Any, written: Any, command: Any
) -> None:
    sizes: dict[tuple[str, int], int] = {}
    for n in (10, 200, 1000):
        written(chain(alike=True, stations=n, base="motor", inner=True).files)
        for optimisation in ("-Os", "-O2"):
            command(compiler, "-std=c99", optimisation, "-c", "arm.c", "-o", "arm.o")
            text, data, bss = map(int, command("size", "arm.o").splitlines()[1].split()[:3])
            assert (data, bss) == (0, 0)  # no globals
            sizes[optimisation, n] = text
    # but for the padding behind offsets of stations that stand outside the loops
    assert abs(sizes["-O2", 200] - sizes["-O2", 1000]) <= 16
    assert sizes["-Os", 200] == sizes["-Os", 1000]
    # an offset or a count below 128 takes one byte of an instruction, others take four
    assert 0.8 * sizes["-Os", 1000] <= sizes["-Os", 10] <= sizes["-Os", 1000]


def test_text_does_not_depend_on_the_hash_seed(tmp_path: Any, chain: Any) -> None:
    script = (
        "import sys\n"
        "from tmm_gen.emit.c import emit_c\n"
        "from tmm_gen.program.build import build_program\n"
        "from tmm_gen.resources import scenes_dir\n"
        "from tmm_gen.scene import load_scene\n"
        "scene = load_scene(scenes_dir() / 'drivetrain.toml').replace(**{'integrator.name': 'houbolt'})\n"
        "print(''.join(emit_c(build_program(scene), scene).values()))\n"
    )
    texts = set()
    for seed in ("0", "271828"):
        done = subprocess.run(
            [sys.executable, "-c", script],
            env={**os.environ, "PYTHONHASHSEED": seed},
            capture_output=True,
            text=True,
            check=True,
        )
        texts.add(done.stdout)
    (text,) = texts
    assert len(text) > 10_000


@pytest.mark.parametrize(
    ("integrator", "told"),
    [
        ("mixed", "in step 1 0.333333 of the step and the end of the step, then the end of the step"),
        ("bathe", "0.5 of the step and the end of the step"),
    ],
)
def test_the_header_says_when_inputs_are_read_in_first_steps_too(
    integrator: str, told: str, chain: Any
) -> None:
    header = " ".join(chain(integrator=integrator).files["c/arm.h"].replace("\n *", "").split())
    assert f"at which inputs are read: {told}. */" in header

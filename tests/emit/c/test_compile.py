"""Emitted C compiles without a warning, and its own test passes, for chains of every kind."""

from __future__ import annotations

import re
from itertools import product
from typing import Any

import pytest

from tmm_gen.derive.integrators.registry import names
from tmm_gen.emit.c import emit_c

pytestmark = pytest.mark.compiler

CHAINS: list[dict[str, Any]] = [
    {"alike": True},
    {"base": "motor", "inner": True, "real": "float32"},
    {"base": "prescribed"},
]
COMPILERS = ("gcc", "clang")
INTEGRATORS = [
    (compiler, {"integrator": name, **CHAINS[(k + shift) % 3]})
    for shift, compiler in enumerate(COMPILERS)
    for k, name in enumerate(names())
]
"""Each integrator on two bases, on one by each compiler; everything else by both."""
KINDS = [
    *(
        {"integrator": name, "base": "free motor", "sweep": "product"}
        for name in ("newmark", "houbolt", "sdirk2")
    ),
    {"sweep": "product", "real": "float32", "stations": 2, "step": 0.3},
    {"sweep": "product", "base": "prescribed", "integrator": "bathe"},
    {"unknown": "displacement", "base": "motor", "integrator": "park"},
    {"unknown": "increment", "base": "prescribed", "integrator": "wilson", "real": "float32"},
    {"integrator": "newmark", "parameters": "beta = 0.0", "damped": False},
    {"stations": 1},
    {"stations": 1, "base": "motor", "integrator": "sdirk4"},
    {"stations": 2, "inner": True, "integrator": "zhou"},
    {"driven": False},
    {"driven": False, "integrator": "houbolt"},
]


@pytest.mark.parametrize(
    ("compiler", "kind"),
    [*INTEGRATORS, *product(COMPILERS, KINDS)],
    ids=lambda given: given if isinstance(given, str) else "-".join(map(str, given.values())),
)
def test_silent_and_right(
    kind: dict[str, Any], compiler: str, chain: Any, written: Any, command: Any, warnings: Any
) -> None:
    command(compiler, *warnings, "-O2", *written(chain(**kind).files), "-o", "test", "-lm")
    assert re.fullmatch(r"\d+ checks passed\n", command("./test"))


@pytest.mark.parametrize("compiler", COMPILERS)
@pytest.mark.parametrize("optimisation", ["-O0", "-O1", "-O3", "-Os"])
def test_every_optimisation(
    optimisation: str, compiler: str, chain: Any, written: Any, command: Any, warnings: Any
) -> None:
    sources = written(chain(base="motor", inner=True, integrator="houbolt").files)
    command(compiler, *warnings, optimisation, *sources, "-o", "test", "-lm")
    assert command("./test").endswith("checks passed\n")


@pytest.mark.parametrize("compiler", COMPILERS)
@pytest.mark.parametrize(
    "kind",
    [
        {"inner": True},
        {"base": "motor", "inner": True, "integrator": "houbolt", "real": "float32"},
        {"base": "prescribed", "integrator": "sdirk4"},
        {"base": "free motor", "integrator": "bathe", "sweep": "product", "inner": True},
        {"stations": 1, "base": "motor"},
    ],
    ids=lambda kind: "-".join(map(str, kind.values())),
)
def test_sanitizers(kind: dict[str, Any], compiler: str, chain: Any, written: Any, command: Any) -> None:
    sanitize = "-fsanitize=address,undefined,float-divide-by-zero"
    flags = ("-std=c99", "-g", "-O1", sanitize, "-fno-sanitize-recover=all")
    command(compiler, *flags, *written(chain(**kind).files), "-o", "test", "-lm")
    assert command("./test").endswith("checks passed\n")


@pytest.mark.parametrize(
    "kind", [{"base": "motor"}, {"integrator": "park", "base": "prescribed", "inner": True}]
)
def test_no_uninitialised_memory(kind: dict[str, Any], chain: Any, written: Any, command: Any) -> None:
    flags = ("-std=c99", "-g", "-O1", "-fsanitize=memory", "-fno-sanitize-recover=all")
    command("clang", *flags, *written(chain(**kind).files), "-o", "test", "-lm")
    assert command("./test").endswith("checks passed\n")


def test_cmake(chain: Any, written: Any, command: Any) -> None:
    written(chain(base="motor").files)
    command("cmake", "-S", ".", "-B", "build", "-DCMAKE_C_FLAGS=-Werror -Wall -Wextra")
    command("cmake", "--build", "build")
    assert "100% tests passed" in command("ctest", "--test-dir", "build")


def test_header_serves_cpp(chain: Any, written: Any, command: Any, tmp_path: Any) -> None:
    written(chain(integrator="sdirk2").files)
    (tmp_path / "user.cpp").write_text(
        '#include "arm.h"\nint main() { arm_params p; arm_default_params(&p); }\n'
    )
    command("g++", "-std=c++11", "-pedantic", "-Wall", "-Wextra", "-Werror", "-c", "user.cpp")


def test_the_emitted_test_finds_a_wrong_sign(chain: Any, written: Any, command: Any) -> None:
    files = dict(chain().files)
    right = "state->rate[j] = known_rate[j + 1] + "
    assert right in files["c/arm.c"]
    files["c/arm.c"] = files["c/arm.c"].replace(right, right.replace("+ ", "- ").replace("j - 1", "j + 1"))
    command("gcc", "-std=c99", *written(files), "-o", "test", "-lm")
    with pytest.raises(AssertionError, match=r"\d+ of \d+ checks failed"):
        command("./test")


@pytest.mark.parametrize("compiler", COMPILERS)
@pytest.mark.parametrize(
    "kind",
    [{"base": "motor", "inner": True}, {"integrator": "houbolt", "base": "prescribed"}, {"driven": False}],
    ids=lambda kind: "-".join(map(str, kind.values())),
)
def test_compensated_kernels_are_silent_and_right(
    kind: dict[str, Any], compiler: str, chain: Any, written: Any, command: Any, warnings: Any
) -> None:
    scene = chain(**kind, real="float32").scene.replace(**{"emit.compensated": True})
    sources = written(emit_c(chain(**kind, real="float32").program, scene))
    command(compiler, *warnings, "-O2", *sources, "-o", "test", "-lm")
    assert re.fullmatch(r"\d+ checks passed\n", command("./test"))

"""C for many arms compiles without a warning as it lies, and does in its lanes what the ordinary kernel does."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

import pytest

from tmm_gen.emit.c import emit_c
from tmm_gen.program.build import build_program
from tmm_gen.scene import load_scene, parse_scene

pytestmark = pytest.mark.compiler

ROOT = Path(__file__).resolve().parents[3]
CASES: dict[str, dict[str, Any]] = {
    "thesis10": {"integrator": {"name": "mixed", "step": 0.002}, "emit.batch": 8},
    "arm2": {"integrator": {"name": "sdirk4", "step": 0.002}, "emit.trigonometry": "own", "emit.batch": 4},
    "fall10": {"emit.real": "float32", "emit.trigonometry": "own", "emit.batch": 16},
    "drivetrain": {"emit.batch": 8},
}
MAIN = """
#include <stdio.h>
#include <string.h>
#include "{name}_batch.h"

int main(void)
{{
    static {name}_model_batch models;
    static {name}_state_batch states;
    static {name}_inputs_batch inputs;
    static {name}_outputs_batch outputs;
    {name}_params params;
    {name}_model model;
    {name}_state state[{NAME}_BATCH];
    {name}_inputs input;
    {name}_outputs output;
    {name}_status status[{NAME}_BATCH];

    {name}_default_params(&params);
    memset(&input, 0, sizeof input);
    if ({name}_prepare(&model, &params, {NAME}_STEP)) {{
        return 1;
    }}
    for (int arm = 0; arm < {NAME}_BATCH; ++arm) {{
        memset(&state[arm], 0, sizeof state[arm]); /* padding too */
        if ({name}_initialise(&state[arm], &params{given}, &input{step})) {{
            return 2;
        }}
        state[arm].{moved} += ({name}_real)arm / 64;
        {name}_model_to_batch(&models, arm, &model);
        {name}_state_to_batch(&states, arm, &state[arm]);
    }}
    {name}_model_to_batch(&models, {NAME}_BATCH, &model); /* no such place */
    {name}_state_to_batch(&states, -1, &state[0]);
    for (int k = 0; k < 50; ++k) {{
        if ({name}_step_batch(&models, &states, &inputs, status)) {{
            return 3;
        }}
        for (int arm = 0; arm < {NAME}_BATCH; ++arm) {{
            if ({name}_step(&model, &state[arm], &input)) {{
                return 4;
            }}
        }}
    }}
    {name}_output_batch(&models, &states, &outputs);
    for (int arm = 0; arm < {NAME}_BATCH; ++arm) {{
        {name}_state there;
        memset(&there, 0, sizeof there);
        {name}_state_from_batch(&states, arm, &there);
        {name}_output(&model, &state[arm], &output);
        if (memcmp(&there, &state[arm], sizeof there) || outputs.{read}[arm] < output.{read}
            || outputs.{read}[arm] > output.{read}) {{
            return 5;
        }}
    }}
    if ({name}_step_batch(NULL, &states, &inputs, status) != -1
        || {name}_run_batch(1, 0, 1, 1, 0, &model, state, {signals}NULL, status) != -1) {{
        return 6;
    }}
    {name}_state started;
    memset(&started, 0, sizeof started);
    memset(&state[0], 0, sizeof state[0]);
    if ({name}_start_batch(0, 1, &params, {NAME}_STEP{given}, &input, &model, &started, status) || status[0]
        || {name}_initialise(&state[0], &params{given}, &input{step}) || memcmp(&started, &state[0], sizeof started)) {{
        return 7;
    }}
    if ({name}_start_batch(0, 1, &params, -{NAME}_STEP{given}, &input, &model, state, status) != 1 || !status[0]
        || {name}_start_batch(1, 0, &params, {NAME}_STEP{given}, &input, &model, state, status) != -1
        || {name}_start_batch(0, 1, NULL, {NAME}_STEP{given}, &input, &model, state, status) != -1) {{
        return 8;
    }}
    puts("same");
    return 0;
}}
"""


@cache
def emitted(name: str) -> dict[str, str]:
    scene = load_scene(ROOT / "scenes" / f"{name}.toml").replace(**CASES[name])
    program = build_program(scene)
    words = {
        "name": name,
        "NAME": name.upper(),
        "given": ", NULL" * len(program.given),
        "step": f", {name.upper()}_STEP" if program.step in program.initialise.read() else "",
        "moved": next(f"{v.name}[1]" for v in program.state if v.length and v.length >= 2),
        "read": program.outputs[0].name,
        "signals": "NULL, " if program.inputs else "",
    }
    return {**emit_c(program, scene), "c/main.c": MAIN.format(**words)}


def without_main(files: dict[str, str]) -> dict[str, str]:
    """The test of the ordinary kernel has a main of its own."""
    return {
        path: text for path, text in files.items() if "/test_" not in path and path.endswith((".c", ".h"))
    }


@pytest.mark.parametrize("compiler", ["gcc", "clang"])
@pytest.mark.parametrize("name", list(CASES))
def test_silent_and_the_same(name: str, compiler: str, written: Any, command: Any, warnings: Any) -> None:
    sources = written(without_main(emitted(name)))
    command(compiler, *warnings, "-O2", "-ffp-contract=off", *sources, "-o", "same", "-lm")
    assert command("./same") == "same\n"


@pytest.mark.parametrize("flags", [["-O0"], ["-O3", "-march=native"], ["-Os"]], ids=" ".join)
@pytest.mark.parametrize("compiler", ["gcc", "clang"])
def test_every_optimisation(compiler: str, flags: list[str], written: Any, command: Any) -> None:
    sources = written(without_main(emitted("arm2")))
    command(compiler, "-std=c99", *flags, "-ffp-contract=off", *sources, "-o", "same", "-lm")
    assert command("./same") == "same\n"


@pytest.mark.parametrize("compiler", ["gcc", "clang"])
def test_sanitizers(compiler: str, written: Any, command: Any) -> None:
    sanitize = ("-fsanitize=address,undefined", "-fno-sanitize-recover=all", "-ffp-contract=off")
    command(
        compiler,
        "-std=c99",
        "-g",
        "-O1",
        *sanitize,
        *written(without_main(emitted("fall10"))),
        "-o",
        "same",
        "-lm",
    )
    assert command("./same") == "same\n"


def test_its_folder_is_a_whole_program(written: Any, command: Any) -> None:
    """As everything that is emitted: compiled as it lies, the ordinary kernel's test included."""
    files = {path: text for path, text in emitted("arm2").items() if not path.endswith("main.c")}
    command("gcc", *written(files), "-o", "test", "-lm")
    assert command("./test").endswith("checks passed\n")


def test_cpp_takes_the_header(written: Any, command: Any, tmp_path: Path) -> None:
    written(emitted("arm2"))
    (tmp_path / "user.cpp").write_text('#include "arm2_batch.h"\nint arms = ARM2_BATCH;\n')
    command("g++", "-Wall", "-Wextra", "-Werror", "-c", "user.cpp")


def test_cpp_takes_inputs_and_outputs_called_as_types(written: Any, command: Any, tmp_path: Path) -> None:
    """In C++ no member may be called as the type of another in the same struct."""
    text = (ROOT / "scenes" / "arm2.toml").read_text()
    scene = parse_scene(text.replace('name = "hub_torque"', 'name = "arm2_many"'))
    scene = scene.replace(**CASES["arm2"])
    assert "arm2_many" in [item.name for item in scene.inputs]
    written(emit_c(build_program(scene), scene))
    (tmp_path / "user.cpp").write_text('#include "arm2_batch.h"\nint arms = ARM2_BATCH;\n')
    command("g++", "-Wall", "-Wextra", "-Werror", "-c", "user.cpp")


def test_a_scene_that_asks_for_none_has_none() -> None:
    scene = load_scene(ROOT / "scenes" / "arm2.toml")
    assert not any("batch" in text for text in emit_c(build_program(scene), scene).values())

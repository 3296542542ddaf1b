"""Kernels in C called with anything: huge, tiny, infinite numbers and NaN as parameters, steps, states and inputs.

Whatever a function is given, where it returns OK nothing infinite and no NaN may be in what it has written; where it
refuses inputs, nothing may have changed. ``python benchmarks/fuzz_kernels.py`` makes a
million calls and prints a table.
"""

from __future__ import annotations

import argparse
import subprocess
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from typing import Any

from tmm_gen.c_language.names import macros
from tmm_gen.emit.c import emit_kernel
from tmm_gen.emit.c.kernel import Kernel
from tmm_gen.errors import UserError
from tmm_gen.program.build import build_program
from tmm_gen.scene import Scene, load_scene

ROOT = Path(__file__).resolve().parents[1]
CALLS = 1_000_000

DRIVER = """
#include "{name}.h"
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
typedef {name}_real real;
static uint64_t seed = {seed}u;
static uint64_t next(void)
{{
    seed ^= seed << 13;
    seed ^= seed >> 7;
    seed ^= seed << 17;
    return seed;
}}
static double uniform(void) {{ return (double)(next() >> 11) / 9007199254740992.0; }}
/* wildness 0: near the scene's values; 1: any exponent; 2: also infinities, NaN, zeros. */
static real wild(real around, int wildness)
{{
    const double span = sizeof(real) == 8 ? 308.0 : 38.0;
    const double sign = next() & 1 ? -1.0 : 1.0;
    if (wildness == 0 || uniform() < 0.3) return (real)((around != 0 ? around : 1) * (0.5 + uniform()));
    if (wildness == 2 && uniform() < 0.05) {{
        const real odd[] = {{(real)NAN, (real)INFINITY, -(real)INFINITY, 0, -(real)0.0, (real)1e-40}};
        return odd[next() % 6];
    }}
    if (uniform() < 0.3) return (real)(sign * pow(10.0, span) * (0.2 + 0.79 * uniform()));
    return (real)(sign * pow(10.0, span * (2.0 * uniform() - 1.0)));
}}
static int finite_all(const void *data, size_t numbers)
{{
    const real *values = data;
    for (size_t k = 0; k < numbers; ++k) if (!isfinite(values[k])) return 0;
    return 1;
}}
static void fill(void *data, const void *around, size_t numbers, int wildness, double share)
{{
    real *values = data;
    const real *base = around;
    for (size_t k = 0; k < numbers; ++k) values[k] = uniform() < share ? wild(base[k], wildness) : base[k];
}}
#define COUNT(kind) (sizeof(kind) / sizeof(real))
#define STATE_NUMBERS ({state_numbers}u)
int main(int argc, char **argv)
{{
    const long calls = argc > 1 ? atol(argv[1]) : 1000;
    long ok = 0, bad_prepare = 0, bad_start = 0, bad_step = 0, changed = 0;
    static {name}_state state, first, before;
    static {name}_inputs inputs, none;
    {free}
    memset(&none, 0, sizeof none);
    {defaults}
    if ({name}_initialise(&first, {params}{nulls}, &none{start_step}) != {NAME}_OK) return 3;
    for (long k = 0; k < calls; ++k) {{
        const int wildness = (int)(next() % 3);
        const double share = uniform() < 0.5 ? 0.1 : 1.0;
        {name}_status status;
        fill(&inputs, &none, COUNT({name}_inputs), wildness, share);
        {prepare}
        if (next() % 4 == 0) {{
            status = {name}_initialise(&state, {params}{nulls}, &inputs{start_step});
            if (status == {NAME}_OK && !finite_all(&state, STATE_NUMBERS)) ++bad_start;
        }}
        state = first;
        fill(&state, &first, STATE_NUMBERS, wildness, share);
        {counter}
        before = state;
        status = {name}_step({model}&state, &inputs);
        if (status == {NAME}_OK) {{
            ++ok;
            if (!finite_all(&state, STATE_NUMBERS)) ++bad_step;
        }} else if (status == {NAME}_NON_FINITE_INPUT && memcmp(&before, &state, sizeof state) != 0) {{
            ++changed;
        }}
    }}
    printf("%ld %ld %ld %ld %ld %ld\\n", calls, ok, bad_prepare, bad_start, bad_step, changed);
    return 0;
}}
"""

PREPARE = """
        fill(&params, &scene, COUNT({name}_params), wildness, share);
        {{
            {number} step = {NAME}_STEP;
            fill(&step, &own_step, COUNT({number}), wildness, 1.0);
            status = {name}_prepare(&model, &params, step);
            if (status == {NAME}_OK && !finite_all(&model, COUNT({name}_model))) ++bad_prepare;
            if (status != {NAME}_OK || next() % 2) (void){name}_prepare(&model, &scene, {NAME}_STEP);
        }}
"""


@dataclass(frozen=True)
class Found:
    """What came of calls.

    Parameters
    ----------
    calls, fine : int
        Rounds, each of a prepare and a step and every fourth an initialise; steps that returned OK.
    prepare, initialise, step : int
        How often OK came with a number that is not finite.
    changed : int
        How often a step that refused its inputs changed the state.
    """

    calls: int
    fine: int
    prepare: int
    initialise: int
    step: int
    changed: int

    @property
    def faults(self) -> int:
        """All faults together."""
        return self.prepare + self.initialise + self.step + self.changed


def fuzz(scene: Scene, calls: int, seed: int = 1, edit: Callable[[str], str] = str) -> Found:
    """Compile a scene's kernel, its text edited, with a driver and run it."""
    program = build_program(scene)
    kernel = Kernel.of(program, scene)
    name, capitals = scene.name, macros(scene.name)
    number = f"{name}_pair" if kernel.real.pair else f"{name}_real"
    numbers = sum(v.length or 1 for v in program.state) * (2 if kernel.real.pair else 1)
    words = {
        "name": name,
        "NAME": capitals,
        "number": number,
        "seed": str(seed * 2654435761 + 88172645463325252),
        "state_numbers": str(numbers),
        "nulls": ", ".join(["NULL"] * len(program.given)),
        "start_step": f", {capitals}_STEP" if kernel.starts_from_step else "",
        "counter": f"state.start_steps_taken = (int)(next() % {len(program.startup) + 1}u);"
        if program.startup
        else "",
        "params": "" if kernel.bound else "&params, ",
        "model": "" if kernel.bound else "&model, ",
        "free": ""
        if kernel.bound
        else f"static {name}_params params, scene; static {name}_model model;"
        f" const {number} own_step = {capitals}_STEP;",
        "defaults": ""
        if kernel.bound
        else f"{name}_default_params(&params); {name}_default_params(&scene);"
        f" if ({name}_prepare(&model, &params, {capitals}_STEP) != {capitals}_OK) return 2;",
    }
    words["prepare"] = "" if kernel.bound else PREPARE.format(**words)
    files = {PurePosixPath(path).name: text for path, text in emit_kernel(program, scene).items()}
    with tempfile.TemporaryDirectory(prefix="tmm-gen-") as scratch:
        folder = Path(scratch)
        for file, text in {**files, "fuzz.c": DRIVER.format(**words)}.items():
            (folder / file).write_text(edit(text) if file in files else text)
        sources = sorted(path.name for path in folder.glob("*.c"))
        build = ["gcc", "-std=gnu17", "-ffp-contract=off", "-O2", *sources, "-lm", "-o", "fuzz"]
        subprocess.run(build, cwd=folder, check=True)
        done = subprocess.run(["./fuzz", str(calls)], cwd=folder, capture_output=True, text=True, check=True)
    return Found(*map(int, done.stdout.split()))


def kinds() -> dict[str, Scene]:
    """Return scenes of every integrator, chain and planar, every number type and form of the C."""
    from tmm_gen.derive.integrators.registry import names

    found: dict[str, Scene] = {}
    forms: tuple[dict[str, Any], ...] = (
        {},
        {"emit.real": "float32"},
        {"emit.parameters": "bound"},
        {"emit.real": "float32", "emit.compensated": True, "emit.trigonometry": "own"},
        {"emit.real": "float64", "emit.trigonometry": "own"},
    )
    for stem in ("thesis10", "drivetrain", "arm2", "swing", "arm10"):
        base = load_scene(ROOT / "scenes" / f"{stem}.toml")
        for form in forms:
            words = ", ".join(f"{key.removeprefix('emit.')} {value}" for key, value in form.items())
            found[f"{stem} {words}".strip()] = base.replace(**form) if form else base
    for k, integrator in enumerate(names()):
        for stem in ("drivetrain", "arm2"):
            base = load_scene(ROOT / "scenes" / f"{stem}.toml")
            changes: dict[str, Any] = {"integrator": {"name": integrator, "step": base.integrator.step}}
            changes |= {"emit.real": ("float64", "float32")[k % 2]}
            try:
                found[f"{stem} {integrator} {changes['emit.real']}"] = base.replace(**changes)
            except UserError as error:  # a pair of scene and integrator that does not exist
                print(f"left out: {stem} {integrator}: {error}")
    return found


def main() -> None:
    """Fuzz all kinds and print a table."""
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--calls", type=int, default=CALLS, help="in all, shared by the kinds")
    options.add_argument("--seed", type=int, default=1)
    chosen = options.parse_args()
    scenes = kinds()
    each = -(-chosen.calls // len(scenes))
    total = 0
    print(f"{'kernel':58} {'calls':>8} {'OK':>8} prepare start step changed")
    for name, scene in scenes.items():
        found = fuzz(scene, each, chosen.seed)
        total += found.faults
        print(
            f"{name:58} {found.calls:8} {found.fine:8} {found.prepare:7} {found.initialise:5} {found.step:4} "
            f"{found.changed:7}",
            flush=True,
        )
    print(f"{each * len(scenes)} rounds, {total} faults")
    raise SystemExit(1 if total else 0)


if __name__ == "__main__":
    main()

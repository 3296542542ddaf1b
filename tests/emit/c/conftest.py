"""Chains of many kinds, compilers, and an executor that computes in the order in which backends write."""

from __future__ import annotations

import subprocess
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tmm_gen.derive.integrators.registry import integrator
from tmm_gen.emit.c import emit_c
from tmm_gen.emit.expressions import ExpressionPrinter
from tmm_gen.native import NativeKernel, compile_kernel
from tmm_gen.program.build import build_unchecked
from tmm_gen.program.statements import Loop, Order, Program, Require, Routine
from tmm_gen.program.variables import SCRATCH, Ref, Variable
from tmm_gen.scene import Scene, parse_scene

WARNINGS = [
    *("-std=c99", "-pedantic", "-Wall", "-Wextra", "-Wconversion", "-Wdouble-promotion", "-Wfloat-equal"),
    *("-Wshadow", "-Wundef", "-Wstrict-prototypes", "-Werror"),
]
BASES = {
    "clamp": 'kind = "clamp"',
    "motor": 'kind = "motor"\ninertia = 0.3\ndamping = 0.02',
    "free motor": 'kind = "motor"\ninertia = 0.3',
    "prescribed": 'kind = "prescribed"',
}
BASE_INPUTS = {
    "clamp": "",
    "motor": '[[input]]\nname = "hub_torque"\nat = "base"\nacts = "torque"\n',
    "free motor": '[[input]]\nname = "hub_torque"\nat = "base"\nacts = "torque"\n',
    "prescribed": '[[input]]\nname = "base_angle"\nat = "base"\nacts = "angle"\n',
}


@dataclass(frozen=True)
class Chain:
    """What a test asks of a chain; stations differ unless ``alike``."""

    stations: int = 4
    base: str = "clamp"
    alike: bool = False
    damped: bool = True
    inner: bool = False
    integrator: str = "newmark"
    parameters: str = ""
    step: float = 0.01
    sweep: str = "riccati"
    unknown: str = "acceleration"
    real: str = "float64"
    driven: bool = True
    name: str = field(default="arm")

    def __str__(self) -> str:
        """Name the test's case."""
        words = [self.integrator, self.base, self.sweep, self.unknown, self.real, str(self.stations)]
        return "-".join([*words, *(["alike"] if self.alike else []), *(["inner"] if self.inner else [])])

    @property
    def scene(self) -> Scene:
        """The scene."""
        return _scene(self)

    @property
    def program(self) -> Program:
        """Its program."""
        return _program(self)

    @property
    def kernel(self) -> NativeKernel:
        """Its compiled kernel, prepared; shared by all who ask."""
        made = _kernel(self)
        made.prepare()
        return made

    @property
    def files(self) -> dict[str, str]:
        """What is emitted for it."""
        return _files(self)


@cache
def _scene(chain: Chain) -> Scene:
    n = chain.stations
    joints = []
    for j in range(n):
        vary = 1.0 if chain.alike else 1.0 + 0.25 * (j % 4)
        damping = f"damping = {0.8 * vary}\n" if chain.damped else ""
        joint = f"[[joint]]\nstiffness = {30.0 * vary}\n{damping}"
        joints.append(f"{joint}[[link]]\ninertia = {0.7 / vary}\n")
    inputs = [BASE_INPUTS[chain.base]]
    if chain.inner:
        inputs.append('[[input]]\nname = "inner_torque"\nat = 2\nacts = "torque"\n')
    inputs.append('[[input]]\nname = "tip_torque"\nat = "tip"\nacts = "torque"\n')
    outputs = "".join(
        f'[[output]]\nname = "y_{k}"\nat = {at}\nof = "{of}"\n'
        for k, (at, of) in enumerate(
            [('"tip"', "angle"), (1, "velocity"), ('"base"', "torque"), ('"tip"', "acceleration")]
        )
    )
    text = f"""
name = "{chain.name}"
[model]
kind = "chain"
sweep = "{chain.sweep}"
unknown = "{chain.unknown}"
[integrator]
name = "{chain.integrator}"
step = {chain.step}
{chain.parameters}
[base]
{BASES[chain.base]}
{"".join(joints)}
{"".join(inputs) if chain.driven else ""}
{outputs}
[emit]
real = "{chain.real}"
"""
    return parse_scene(text)


@cache
def _program(chain: Chain) -> Program:
    # not by build_program, which refuses products of matrices that lose too many digits to be of use
    chosen = chain.scene.integrator
    return build_unchecked(chain.scene, integrator(chosen.name, **chosen.parameters))


@cache
def _kernel(chain: Chain) -> NativeKernel:
    return compile_kernel(chain.program, chain.scene)


@cache
def _files(chain: Chain) -> dict[str, str]:
    return emit_c(chain.program, chain.scene)


@pytest.fixture(scope="session")
def chain() -> type[Chain]:
    """Make a chain: ``chain(base="motor").files``."""
    return Chain


@pytest.fixture(scope="session")
def warnings() -> list[str]:
    """The flags under which emitted C must be silent."""
    return WARNINGS


@pytest.fixture
def command(tmp_path: Path, need_tool: Callable[..., str]) -> Callable[..., str]:
    """Run a program that must succeed in an empty folder; return what it printed."""

    def call(*words: str | Path) -> str:
        if not (tmp_path / words[0]).exists():
            need_tool(str(words[0]))
        done = subprocess.run(
            [str(w) for w in words], cwd=tmp_path, capture_output=True, text=True, check=False
        )
        assert done.returncode == 0, f"{' '.join(map(str, words))}\n{done.stdout}{done.stderr}"
        return done.stdout + done.stderr

    return call


@pytest.fixture
def written(tmp_path: Path) -> Callable[[dict[str, str]], list[str]]:
    """Write emitted files to the test's folder; return the names of the sources."""

    def write(files: dict[str, str]) -> list[str]:
        for path, text in files.items():
            (tmp_path / Path(path).name).write_text(text)
        return sorted(Path(path).name for path in files if path.endswith(".c"))

    return write


# -- an executor in the written order -----------------------------------------------------------


class PythonText(ExpressionPrinter):
    """Expressions in Python, every number of one type."""

    def reference(self, ref: Ref) -> str:
        """Look it up among the values."""
        index = "" if ref.variable.length is None else f"[{ref.entry}]"
        if ref.offset is not None:
            index = f"[j + {ref.offset}]"
        return f"v[{_key(ref.variable)!r}]{index}"

    def literal(self, value: float) -> str:
        """Make a number of the type."""
        return f"real({value!r})"

    def function(self, name: str) -> str:
        """Take it from NumPy."""
        return f"np.{name}"


def _key(variable: Variable) -> str:
    """Return under which name values hold a variable: one routine's scratch may be called like the model's."""
    return f"scratch {variable.name}" if variable.role in SCRATCH else variable.name


def python_source(routine: Routine) -> str:
    """Write a routine as Python."""
    printer = PythonText()
    lines = []

    def line(statement: Any) -> str:
        value = printer.text(statement.value)
        return (
            f"assert {value} > 0"
            if isinstance(statement, Require)
            else f"{printer.text(statement.target)} = {value}"
        )

    for statement in routine.statements():
        if isinstance(statement, Loop):
            stations = f"range({statement.start}, {statement.stop})"
            stations = f"reversed({stations})" if statement.order is Order.INWARD else stations
            lines += [f"for j in {stations}:", *(f"    {line(inner)}" for inner in statement.body)]
        else:
            lines.append(line(statement))
    return "\n".join(lines) or "pass"


@cache
def compiled(routine: Routine) -> Any:
    """Compile a routine's Python."""
    return compile(python_source(routine), routine.name, "exec")


class WrittenOrder:
    """Values of a program, changed by its routines in the order in which backends write operations."""

    def __init__(self, program: Program, real: str) -> None:
        self.program = program
        self.real = np.float32 if real == "float32" else np.float64
        self.values: dict[str, Any] = {}
        for v in (program.step, *program.parameters, *program.inputs, *program.given, *program.state):
            self.set(v.name, v.default if v.default is not None else 0.0)

    def set(self, name: str, value: Any) -> None:
        """Give a variable a number or numbers."""
        known = (self.program.step, *self.program.parameters, *self.program.inputs, *self.program.given)
        variable = next(v for v in (*known, *self.program.state) if v.name == name)
        if variable.length is None:
            self.values[name] = self.real(value)
        else:
            self.values[name] = [
                self.real(x) for x in np.broadcast_to(np.asarray(value, float), variable.length)
            ]

    def run(self, routine: Routine) -> None:
        """Run a routine."""
        for v in routine.written():
            if v.name not in self.values or v.role in SCRATCH:
                self.values[_key(v)] = self.real(0) if v.length is None else [self.real(0)] * v.length
        exec(compiled(routine), {"np": np, "real": self.real}, {"v": self.values})

    def step(self, taken: int) -> None:
        """Take the step that follows ``taken`` others."""
        self.run(self.program.steps[min(taken, len(self.program.startup))])


@pytest.fixture(scope="session")
def written_order() -> type[WrittenOrder]:
    """The executor: ``written_order(program, "float64")``."""
    return WrittenOrder

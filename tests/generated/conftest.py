"""Scenes, their programs and their generated modules, for comparing backends with each other."""

from __future__ import annotations

import ast
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest

from tmm_gen.emit.casadi import emit_casadi
from tmm_gen.emit.numpy import emit_numpy
from tmm_gen.program.build import build_program
from tmm_gen.program.evaluate import Values, allocate, execute, key
from tmm_gen.program.statements import Program
from tmm_gen.scene import Scene, load_scene, parse_scene

ROOT = Path(__file__).resolve().parents[2]


@dataclass(frozen=True)
class Generated:
    """A scene with everything that follows from it."""

    scene: Scene

    @cached_property
    def program(self) -> Program:
        return build_program(self.scene)

    @cached_property
    def text(self) -> str:
        return emit_numpy(self.program, self.scene)["kernel.py"]

    @cached_property
    def kernel(self) -> ModuleType:
        return run(ast.parse(self.text), "kernel")

    @cached_property
    def casadi(self) -> ModuleType:
        return run(ast.parse(emit_casadi(self.program, self.scene)["casadi_model.py"]), "casadi_model")

    def kernel_in(
        self,
        number: Callable[[float], Any],
        quotient: Callable[[float, float], Any],
        functions: Mapping[str, Callable[[Any], Any]],
    ) -> ModuleType:
        """Return the NumPy kernel with its literals, thus all it computes, in another type of number."""
        module = run(_Literals().visit(ast.parse(self.text)), "kernel", LITERAL=number, QUOTIENT=quotient)
        module.__dict__["np"] = _Functions(functions)
        return module

    @property
    def several_stages(self) -> bool:
        return any(variable.length is not None for variable in self.program.inputs)

    def random(self, rng: np.random.Generator, names: Sequence[str] = ("state", "inputs")) -> Values:
        """Return random values of variables; inputs for every stage where there are several."""
        variables = [v for name in names for v in getattr(self.program, name)]
        # An arm in a plane that turns wildly has no solution at a long step: its pivots vanish.
        size = 1.0 if self.scene.model.kind == "chain" else 0.2 / self.program.stations
        return {v.name: size * rng.normal(size=v.length if v.length is not None else ()) for v in variables}

    def state(self, kernel: ModuleType, values: Values, steps_taken: int) -> Any:
        """Return the kernel's state after some steps."""
        fields = {v.name: values[v.name] for v in self.program.state}
        return kernel.State(**fields, **({"steps_taken": steps_taken} if self.program.startup else {}))

    def input(self, kernel: ModuleType, values: Values, steps_taken: int) -> Any:
        """Return the kernel's input, or those of all stages of the step."""
        names = [v.name for v in self.program.inputs]
        if not self.several_stages:
            return kernel.Input(**{name: values[name] for name in names})
        stages = len(self.program.stage_instants[min(steps_taken, len(self.program.startup))])
        return [kernel.Input(**{name: values[name][k] for name in names}) for k in range(stages)]

    def interpret(
        self, values: Values, *routines: str, number: Callable[[Any], Any] = float, modules: Any = "math"
    ) -> Values:
        """Run routines of the program on values in the interpreter."""
        program = self.program
        declared = (program.step, *program.parameters, *program.state, *program.inputs, *program.given)
        held = allocate((*declared, *program.outputs), number)
        signals = {v.name: key(v) for v in program.inputs}
        for name, value in values.items():
            held[signals.get(name, name)] = [number(x) for x in value] if np.ndim(value) else number(value)
        steps = {f"step{k}": routine for k, routine in enumerate(program.steps)}
        for name in routines:
            execute(steps[name] if name in steps else getattr(program, name), held, number, modules)
        return held


class _Functions:
    """NumPy with functions of another type of number."""

    def __init__(self, functions: Mapping[str, Callable[[Any], Any]]) -> None:
        self._functions = {name: np.vectorize(f, otypes=[object]) for name, f in functions.items()}

    def __getattr__(self, name: str) -> Any:
        return self._functions.get(name) or getattr(np, name)


class _Literals(ast.NodeTransformer):
    """Writes ``LITERAL(0.5)`` for ``0.5`` and ``QUOTIENT(1.0, 3.0)`` for ``1.0 / 3.0``."""

    def visit_BinOp(self, node: ast.BinOp) -> ast.AST:
        if isinstance(node.op, ast.Div) and _is_float(node.left) and _is_float(node.right):
            return _call("QUOTIENT", node.left, node.right)
        return self.generic_visit(node)

    def visit_Constant(self, node: ast.Constant) -> ast.AST:
        return _call("LITERAL", node) if _is_float(node) else node


def _is_float(node: ast.AST) -> bool:
    return isinstance(node, ast.Constant) and isinstance(node.value, float)


def _call(name: str, *arguments: ast.expr) -> ast.Call:
    return ast.Call(ast.Name(name, ast.Load()), list(arguments), [])


def run(tree: ast.AST, name: str, **names: Any) -> ModuleType:
    """Execute a module's tree with some names defined."""
    module = ModuleType(name)
    module.__dict__.update(names)
    tree = ast.fix_missing_locations(tree)
    # dataclasses look their module up by its name
    import sys

    sys.modules[name] = module
    try:
        exec(compile(tree, f"{name}.py", "exec"), module.__dict__)  # type: ignore[call-overload]
    finally:
        del sys.modules[name]
    return module


@pytest.fixture(scope="session")
def generate() -> Callable[[Scene], Generated]:
    """Return what follows from a scene, remembered for scenes that say the same."""
    known: dict[Scene, Generated] = {}

    def of(scene: Scene) -> Generated:
        return known.setdefault(scene, Generated(scene))

    return of


@pytest.fixture(scope="session")
def committed() -> dict[str, Scene]:
    """Return the scenes of scenes/ by name."""
    return {path.stem: load_scene(path) for path in sorted((ROOT / "scenes").glob("*.toml"))}


@pytest.fixture(scope="session")
def chain() -> Callable[..., Scene]:
    """Return a function that makes a chain from lists of numbers."""
    return chain_scene


def chain_scene(
    *,
    joints: Sequence[tuple[float, float]] = ((20.0, 0.5), (35.0, 0.2), (15.0, 0.0)),
    links: Sequence[float] = (1.0, 2.0, 0.5),
    base: str = "clamp",
    hub: tuple[float, float] = (0.7, 0.1),
    inputs: Sequence[tuple[str, str | int, str]] = (("push", "tip", "torque"),),
    outputs: Sequence[tuple[str, str | int, str]] = (("tip", "tip", "angle"), ("held", "base", "torque")),
    integrator: str = "newmark",
    step: float = 0.01,
    unknown: str = "acceleration",
    sweep: str = "riccati",
) -> Scene:
    """Make a chain: joints are (stiffness, damping), links inertias, the hub (inertia, damping)."""
    lines = ['name = "drawn"', "[model]", 'kind = "chain"', f'unknown = "{unknown}"', f'sweep = "{sweep}"']
    lines += ["[integrator]", f'name = "{integrator}"', f"step = {step!r}", "[base]", f'kind = "{base}"']
    if base == "motor":
        lines += [f"inertia = {hub[0]!r}", f"damping = {hub[1]!r}"]
    for (stiffness, damping), inertia in zip(joints, links, strict=True):
        lines += ["[[joint]]", f"stiffness = {stiffness!r}", f"damping = {damping!r}"]
        lines += ["[[link]]", f"inertia = {inertia!r}"]
    for table, verb, signals in (("input", "acts", inputs), ("output", "of", outputs)):
        for name, at, what in signals:
            place = f'"{at}"' if isinstance(at, str) else at
            lines += [f"[[{table}]]", f'name = "{name}"', f"at = {place}", f'{verb} = "{what}"']
    return parse_scene("\n".join(lines) + "\n")

"""Scenes whose step is differentiated, and CasADi's derivatives of it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import casadi as ca
import numpy as np
import pytest
from support.native_sensitivities import NativeSensitivities

from tmm_gen.native.python_module import casadi_module
from tmm_gen.program.build import build_program
from tmm_gen.program.statements import Program
from tmm_gen.resources import scenes_dir
from tmm_gen.scene import Scene, load_scene, parse_scene

UNLIKE = """
name = "unlike"
[model]
kind = "planar"
gravity = 9.81
[integrator]
name = "newmark"
step = 2e-3
[base]
kind = "{base}"
{hub}
[[joint]]
stiffness = 40.0
damping = 0.2
[[joint]]
stiffness = 25.0
damping = 0.05
[[joint]]
stiffness = 30.0
damping = 0.3
[[link]]
mass = 0.7
length = 0.4
center = 0.3
inertia = 0.01
[[link]]
mass = 0.5
length = 0.25
inertia = 0.003
[[link]]
mass = 0.4
length = 0.3
center = 0.8
inertia = 0.004
[tip]
mass = 0.3
inertia = 0.01
[[input]]
name = "push"
at = "tip"
acts = "force_y"
[[input]]
name = "pull"
at = 1
acts = "force_x"
[[input]]
name = "twist"
at = 2
acts = "torque"
{base_input}
[[output]]
name = "tip"
at = "tip"
of = "position"
[[output]]
name = "shear"
at = 1
of = "force"
[emit]
sensitivities = true
"""
_HUB = '\n[[input]]\nname = "hub"\nat = "base"\nacts = "{}"\n'


def unlike(base: str) -> Scene:
    """Return an arm of three unlike links under loads of every kind."""
    hub = {"motor": "inertia = 0.3\ndamping = 0.2"}.get(base, "")
    acts = {"motor": "torque", "prescribed": "angle"}.get(base)
    return parse_scene(UNLIKE.format(base=base, hub=hub, base_input=_HUB.format(acts) if acts else ""))


PARTS = """
name = "parts"
[model]
kind = "planar"
gravity = 9.81
[integrator]
name = "newmark"
step = 2e-3
[base]
kind = "{base}"
[[{first}]]
name = "shoulder"
damping = 0.1
[[beam]]
name = "upper"
on = "shoulder"
length = 0.5
bending_stiffness = 6.0
mass_per_length = 0.3
links = 2
damping_time = 2e-3
[[motor]]
name = "elbow"
on = "upper"
rotor_inertia = 2e-5
gear = 50
[[link]]
name = "forearm"
on = "elbow"
length = 0.3
mass = 0.2
inertia = 2e-3
[[joint]]
name = "wrist"
on = "forearm"
stiffness = 3.0
rest = 0.3
[[link]]
name = "hand"
on = "wrist"
length = 0.1
mass = 0.1
inertia = 2e-4
[[joint]]
name = "finger_joint"
on = "hand"
[[link]]
name = "finger"
on = "finger_joint"
length = 0.1
mass = 0.1
inertia = 2e-4
[[input]]
name = "shoulder_torque"
at = "shoulder"
acts = "torque"
[[input]]
name = "elbow_torque"
at = "elbow"
acts = "torque"
[[input]]
name = "finger_torque"
at = "finger_joint"
acts = "torque"
[[input]]
name = "push"
at = "forearm"
acts = "force_y"
{base_input}
[[output]]
name = "tip"
at = "finger"
of = "position"
[[output]]
name = "torque"
at = "elbow"
of = "torque"
[emit]
sensitivities = true
"""


def parts(base: str) -> Scene:
    """Return an arm with motors, a beam, a slack angle and a hinge with nothing but a torque in it."""
    base_input = _HUB.format("angle") if base == "prescribed" else ""
    first = "joint" if base == "prescribed" else "motor"
    return parse_scene(PARTS.format(base=base, base_input=base_input, first=first))


BRANCHES = """\
[[motor]]
name = "second"
on = "base"
rotor_inertia = 1e-5
gear = 40
stiffness = 90.0
damping_time = 1e-3
[[link]]
name = "thumb"
on = "second"
length = 0.2
mass = 0.15
inertia = 6e-4
center = 0.4
[[joint]]
name = "third"
on = "upper"
stiffness = 2.0
[[link]]
name = "pad"
on = "third"
length = 0.15
mass = 0.1
inertia = 3e-4
[[input]]
name = "second_torque"
at = "second"
acts = "torque"
[[input]]
name = "lift"
at = "pad"
acts = "force_y"
[[output]]
name = "pad"
at = "pad"
of = "position"
[[output]]
name = "held"
at = "upper"
of = "velocity"
"""


def tree(base: str) -> Scene:
    """Return the same arm with a branch on its upper arm, and one that begins with a motor's shaft on the base."""
    hub = 'kind = "motor"\ninertia = 0.1' if base == "motor" else f'kind = "{base}"'
    text = PARTS.format(base=base, base_input=_HUB.format("torque") if base == "motor" else "", first="motor")
    text = text.replace(f'kind = "{base}"\n[[motor]]', f"{hub}\n[[motor]]")
    text = text.replace('name = "shoulder"\n', 'name = "shoulder"\non = "base"\n')
    return parse_scene(text + BRANCHES)


def floating() -> Scene:
    """Return the tree on a base that floats, pushed and turned; its places are read, so that no state is dropped."""
    text = PARTS.format(base="free", base_input=_HUB.format("torque"), first="motor")
    text = text.replace('name = "shoulder"\n', 'name = "shoulder"\non = "base"\n')
    hub = '[[body]]\nname = "hub"\non = "base"\nmass = 0.7\ninertia = 0.05\n'
    push = '[[input]]\nname = "thruster"\nat = "hub"\nacts = "force_x"\n'
    place = '[[output]]\nname = "where"\nat = "hub"\nof = "position"\n'
    return parse_scene(text + BRANCHES + hub + push + place)


IN_SPACE = """
name = "in_space"
[model]
kind = "spatial"
gravity = [0, 0, -9.81]
[integrator]
name = "newmark"
step = 5e-3
[base]
kind = "clamp"
[[motor]]
name = "yaw"
axis = "z"
rotor_inertia = 1e-5
gear = 50
damping = 0.1
{links}
{branch}
[[input]]
name = "yaw_torque"
at = "yaw"
acts = "torque"
[[input]]
name = "elbow_torque"
at = "joint_5"
acts = "torque"
[[output]]
name = "tip"
at = "link_5"
of = "position"
[emit]
sensitivities = true
"""
ASIDE = """\
[[motor]]
name = "aside"
on = "yaw"
axis = "x"
rotor_inertia = 1e-5
gear = 20
stiffness = 3.0
damping_time = 1e-3
[[body]]
name = "weight"
on = "aside"
at = [0, 0.1, 0.05]
mass = 0.4
inertia = [1e-3, 2e-3, 1e-3]
[[input]]
name = "push"
at = "link_5"
acts = "force"
"""
LINK = """\
[[joint]]
name = "joint_{number}"
on = "{host}"
axis = "{axis}"
stiffness = 4.0
damping = 0.02
[[link]]
name = "link_{number}"
on = "joint_{number}"
length = 0.1
mass = 0.2
inertia = [1e-4, 2e-4, 2e-4]
"""


def in_space(branch: bool = True) -> Scene:
    """Return an arm in space, its links in turn a loop; an elastic gear on a branch and a force, or links beyond."""
    hosts = ["yaw", *(f"link_{k}" for k in range(1, 5 if branch else 10))]
    links = [LINK.format(number=k, host=host, axis="zy"[k % 2]) for k, host in enumerate(hosts, start=1)]
    return parse_scene(IN_SPACE.format(links="".join(links), branch=ASIDE if branch else ""))


@dataclass(frozen=True, eq=False)
class Case:
    """A scene, a point, and CasADi's derivatives there.

    Parameters
    ----------
    x, u : array
        State, and inputs with all their stages, one input after the other.
    x_next, a, b : array
        The step and its derivatives by x and u.
    """

    scene: Scene
    program: Program
    module: Any
    x: np.ndarray
    u: np.ndarray
    x_next: np.ndarray
    a: np.ndarray
    b: np.ndarray

    @cached_property
    def native(self) -> NativeSensitivities:
        """The step with its derivatives in compiled C."""
        return NativeSensitivities(self.program, self.scene, flags=("-O1", "-ffp-contract=off"))


def case_of(scene: Scene) -> Case:
    program = build_program(scene)
    module = casadi_module(scene, program)
    several = len(program.stage_instants[-1]) > 1
    step = module.step_function(held=False) if several else module.step_function()
    x, u, p = ca.SX.sym("x", step.size1_in(0)), ca.SX.sym("u", *step.size_in(1)), module.default_parameters()
    after = step(x, u, p)[0]
    slopes = ca.Function("slopes", [x, u], [after, ca.jacobian(after, x), ca.jacobian(after, ca.vec(u))])
    random = np.random.default_rng(3)
    point = random.uniform(-0.6, 0.6, x.numel())
    acting = random.uniform(-2.0, 2.0, u.shape)
    x_next, a, b = (np.array(value) for value in slopes(point, acting))
    b = b[:, np.arange(u.numel()).reshape(u.shape, order="F").ravel()]  # stage by stage -> input by input
    return Case(scene, program, module, point, acting.ravel(), x_next.ravel(), a, b)


SCENES: dict[str, Callable[[], Scene]] = {
    "arm2": lambda: _shipped("arm2"),
    "arm10": lambda: _shipped("arm10"),
    "chain": lambda: _shipped("drivetrain"),
    "clamp": lambda: unlike("clamp"),
    "motor": lambda: unlike("motor"),
    "prescribed": lambda: unlike("prescribed"),
    "parts": lambda: parts("clamp"),
    "parts on a moving base": lambda: parts("prescribed").replace(**{"integrator.name": "sdirk4"}),
    "tree": lambda: tree("clamp"),
    "tree on a hub": lambda: tree("motor").replace(**{"model.iterations": 2}),
    "floating": lambda: floating(),
    "floating, sdirk4": lambda: floating().replace(**{"integrator.name": "sdirk4"}),
    "floating, two iterations": lambda: floating().replace(**{"model.iterations": 2}),
    "sdirk4": lambda: unlike("motor").replace(**{"integrator.name": "sdirk4"}),
    "generalized_alpha": lambda: unlike("motor").replace(**{"integrator.name": "generalized_alpha"}),
    "in space": in_space,
    "two iterations": lambda: unlike("motor").replace(**{"model.iterations": 2}),
}


def _shipped(name: str) -> Scene:
    return load_scene(scenes_dir() / f"{name}.toml").replace(emit={"sensitivities": True})


_known: dict[str, Case] = {}


# one worker derives and compiles a scene for all tests
@pytest.fixture(
    params=[pytest.param(name, marks=pytest.mark.xdist_group(f"tangents of {name}")) for name in SCENES]
)
def case(request: pytest.FixtureRequest) -> Case:
    """Return each scene with CasADi's derivatives."""
    name = str(request.param)
    if name not in _known:
        _known[name] = case_of(SCENES[name]())
    return _known[name]


@pytest.fixture
def without_branch() -> Case:
    """Return the arm in space without its branch and the force."""
    return case_of(in_space(branch=False))

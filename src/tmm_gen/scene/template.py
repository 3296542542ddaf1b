"""The scene a user starts from: complete, commented, and valid as it stands."""

from __future__ import annotations

from tmm_gen.scene.control_template import HUB_CONTROL, motors_control
from tmm_gen.scene.model import Kind
from tmm_gen.scene.spatial import template as spatial

_HEAD = """\
# A scene: what `tmm-gen` builds kernels for. SI units and radians; angles are @angles@.
# What you leave out is not modelled and costs nothing in the generated code.

name = "@name@"{pad}# also the name of the generated Python package and C files
title = "{title}"

[model]
{model}
[integrator]
name = "newmark"               # `tmm-gen integrators` shows all of them
step = {step}                    # default time step, s
beta = 0.25                    # average acceleration: second order, stable at any step
gamma = 0.5
"""

_CHAIN = """
[base]
kind = "clamp"                 # or "motor": a hub with inertia, damping and a torque input

# From base to tip: each link stands behind its own joint.
[[joint]]
stiffness = 20.0               # N m/rad
damping = 0.5                  # N m s/rad

[[link]]
inertia = 1.0                  # kg m^2

[[joint]]
stiffness = 20.0
damping = 0.5
repeat = 2                     # this many alike, one behind the other

[[link]]
inertia = 0.8
repeat = 2

# What you will feed in, by name. Inputs are zero until you give them a value.
[[input]]
name = "tip_torque"
at = "tip"                     # "base", "tip", or the number of a link, from 1
acts = "torque"                # N m

# What you will get out, by name.
[[output]]
name = "tip"
at = "tip"
of = "angle"                   # or "velocity", "acceleration" (of the angle), "torque"

[[output]]
name = "base_torque"
at = "base"                    # for a torque: that in joint 1; at = 2 is that in joint 2
of = "torque"

# [initial]
# angles = 0.1                 # rad, one number for all links or a list, one per link
# rates = 0.0                  # rad/s
"""

_PLANAR = """
[base]
kind = "motor"                 # or "clamp", or "prescribed" (an angle input)
inertia = 0.05                 # hub, kg m^2
damping = 0.01                 # hub to ground, N m s/rad

# A uniform beam, cut into links and joints for you.
[beam]
length = 1.0                   # m
bending_stiffness = 12.0       # EI, N m^2
mass_per_length = 0.4          # kg/m
links = 5
damping_time = 0.0015          # joint damping over joint stiffness, s

[tip]
mass = 0.1                     # payload, kg

# What you will feed in, by name. Inputs are zero until you give them a value.
[[input]]
name = "hub_torque"
at = "base"                    # "base", "tip", or the number of a link, from 1
acts = "torque"                # N m; or "force_x", "force_y" at a link or the tip

# What you will get out, by name.
[[output]]
name = "tip"
at = "tip"
of = "position"                # or "angle", "rate", "velocity", "acceleration", "torque", "force"

[[output]]
name = "hub"
at = "base"
of = "angle"

# [initial]
# angles = 0.1                 # rad, one number for all links or a list, one per link
# rates = 0.0                  # rad/s
"""

_MOTORS_BASE = """
[base]
kind = "clamp"                 # or "prescribed" (an angle input)

# Parts hang on each other by name: `on` says on which; the first one hangs on the base.
"""

_MOTOR = """\
[[motor]]                      # a driven joint; [[joint]] is one without, with stiffness, damping, rest
name = "motor{k}"
{on}rotor_inertia = {rotor}           # kg m^2, on the motor's side; gear^2 times it acts along the joint
gear = {gear}                     # turns of the motor per turn of the joint
damping = {damping}                  # at the output, N m s/rad

[[beam]]                       # a flexible link; [[link]] is a rigid one, with length, mass, inertia
name = "arm{k}"
on = "motor{k}"
length = 0.4                   # m
material = {{ young = 70e9, density = 2700 }}   # Pa, kg/m^3: aluminium
section = {{ kind = "rectangle", width = {width:g}, thickness = 0.005 }}   # m; or "tube", "circle"
links = 3                      # pieces it is cut into
damping_time = 0.002           # damping of its springs over their stiffness, s

"""

_MOTOR_INPUT = """\
[[input]]
name = "torque{k}"
at = "motor{k}"                  # of the motor itself; gear-fold between both sides of the joint
acts = "torque"                # N m

"""

_MOTOR_OUTPUT = """\
[[output]]
name = "angle{k}"
at = "motor{k}"
of = "angle"                   # or "rate", "torque", "force"

"""

_MOTORS_TAIL = """\
[[body]]                       # a rigid body on the outer end of a beam or a link
name = "payload"
on = "arm{k}"
mass = 0.2                     # kg
# inertia = 1e-3               # kg m^2

# What you will feed in, by name. Inputs are zero until you give them a value.
{inputs}
# What you will get out, by name.
[[output]]
name = "payload"
at = "payload"
of = "position"                # or "velocity", "acceleration", "angle", "rate"

{outputs}# [initial]
# angles = 0.1                 # rad, absolute: one number for all, or one each: {{ arm1 = 0.1, arm2 = 0.2 }}
"""

_TAIL = """
[emit]
backends = ["numpy", "c", "casadi"]
real = "float64"               # of the C code; "float32" for small controllers
"""


_CHAIN_MODEL = """\
kind = "chain"                 # torsional stations in a row: linear, one angle each
"""
_FLAT_MODEL = """\
kind = "planar"                # an arm in a plane, however far it turns
# gravity = 9.81               # along -y, m/s^2; without it the plane is horizontal
"""
_PLANAR_MODEL = """\
kind = "planar"                # an arm in a plane, however far it turns
gravity = 9.81                 # along -y, m/s^2; remove the line for a horizontal plane
"""


def template(name: str, kind: Kind = "chain", control: bool = False, motors: int = 0) -> str:
    """Return the text of a commented scene.

    Parameters
    ----------
    name : str
        A valid name of a scene, see :func:`tmm_gen.scene.identifier.scene_name_fault`.
    kind : {"chain", "planar", "spatial"}
        Family of models.
    control : bool
        Whether a planar arm gets a ``[control]``; one on a hub then lies in a horizontal plane.
    motors : int
        Motors of a planar arm by parts, each with a beam on it; 0 for an arm on a hub.

    Returns
    -------
    str
        TOML, valid as it stands.
    """
    if kind == "spatial":
        title = "Arm in space with two motors, a flexible boom and a payload"
        head = _HEAD.format(pad=_pad(name), title=title, model=spatial.MODEL, step="1e-3")
        return _named(head, name, "those of joints") + spatial.ARM + _TAIL
    chain = kind == "chain"
    head = _HEAD.format(
        pad=_pad(name),
        title="Three torsional stations behind a clamp"
        if chain
        else f"Flexible arm with {motors} motor{'s' * (motors > 1)} and a payload"
        if motors
        else "Flexible arm with a payload, swung by a hub motor",
        model=_CHAIN_MODEL if chain else _FLAT_MODEL if control and not motors else _PLANAR_MODEL,
        step="0.01" if chain else "1e-3",
    )
    body = _CHAIN if chain else _by_parts(motors) if motors else _PLANAR
    controlled = "" if chain or not control else motors_control(motors) if motors else HUB_CONTROL
    return _named(head, name, "absolute") + body + controlled + _TAIL


def _pad(name: str) -> str:
    return " " * max(22 - len(name), 1)


def _named(head: str, name: str, angles: str) -> str:
    return head.replace("@name@", name).replace("@angles@", angles)


def _by_parts(motors: int) -> str:
    """Return an arm of motors with beams on them, each lighter than the one before."""
    parts, inputs, outputs = [], [], []
    for k in range(1, motors + 1):
        on = "" if k == 1 else f'on = "arm{k - 1}"\n'
        share = 0.5 ** (k - 1)
        numbers = {
            "rotor": "2e-5",
            "gear": 100,
            "damping": 0.5,
            "width": 0.03 * share,
        }
        parts.append(_MOTOR.format(k=k, on=on, **numbers))
        inputs.append(_MOTOR_INPUT.format(k=k))
        outputs.append(_MOTOR_OUTPUT.format(k=k))
    tail = _MOTORS_TAIL.format(k=motors, inputs="".join(inputs).rstrip() + "\n", outputs="".join(outputs))
    return _MOTORS_BASE + "".join(parts) + tail

"""The scene a user starts from: complete, commented, and valid as it stands."""

from __future__ import annotations

from tmm_gen.scene.model import Kind

_HEAD = """\
# A scene: what `tmm-gen` builds kernels for. SI units and radians; angles are absolute.
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

_TAIL = """
[emit]
backends = ["numpy", "c", "casadi"]
real = "float64"               # of the C code; "float32" for small controllers
"""

_CHAIN_MODEL = """\
kind = "chain"                 # torsional stations in a row: linear, one angle each
"""
_PLANAR_MODEL = """\
kind = "planar"                # an arm in a plane, however far it turns
gravity = 9.81                 # along -y, m/s^2; remove the line for a horizontal plane
"""


def template(name: str, kind: Kind = "chain") -> str:
    """Return the text of a commented scene.

    Parameters
    ----------
    name : str
        A valid name of a scene, see :func:`tmm_gen.scene.identifier.scene_name_fault`.
    kind : {"chain", "planar"}
        Family of models.

    Returns
    -------
    str
        TOML, valid as it stands.
    """
    chain = kind == "chain"
    head = _HEAD.format(
        pad=" " * max(22 - len(name), 1),
        title="Three torsional stations behind a clamp"
        if chain
        else "Flexible arm with a payload, swung by a hub motor",
        model=_CHAIN_MODEL if chain else _PLANAR_MODEL,
        step="0.01" if chain else "1e-3",
    )
    return head.replace("@name@", name) + (_CHAIN if chain else _PLANAR) + _TAIL

"""A small arm in space with all that kernels may have: a geared motor, a beam, a payload, vectors in and out."""

from __future__ import annotations

BOOM = """
name = "boom"
[model]
kind = "spatial"
gravity = [0, 0, -9.81]
[integrator]
name = "newmark"
step = 5e-4
[base]
kind = "clamp"
[[motor]]
name = "yaw"
axis = "z"
rotor_inertia = 1e-5
gear = 50
damping = 0.1
[[beam]]
name = "rod"
on = "yaw"
turn = [0, 0.4, 0]
length = 0.5
bending_stiffness = [20.0, 30.0]
torsional_stiffness = 8.0
polar_inertia_per_length = 1e-4
mass_per_length = 0.3
links = 1
damping_time = 0.002
[[body]]
name = "hand"
on = "rod"
mass = 0.1
[[input]]
name = "torque"
at = "yaw"
acts = "torque"
[[input]]
name = "push"
at = "hand"
acts = "force"
in = "world"
[[output]]
name = "hand"
at = "hand"
of = "position"
[[output]]
name = "facing"
at = "hand"
of = "orientation"
[[output]]
name = "yaw"
at = "yaw"
of = "angle"
"""

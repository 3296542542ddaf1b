"""Two rigid links in space: a heavy one on a spring, and a light one on a joint that nothing holds."""

from __future__ import annotations

PALM = """
name = "palm"
[model]
kind = "spatial"
[integrator]
name = "newmark"
step = 2e-3
[base]
kind = "clamp"
[[joint]]
name = "root"
axis = "z"
stiffness = 40.0
damping = 0.1
[[link]]
name = "bone"
on = "root"
length = 0.8
mass = 4.0
inertia = [0.01, 0.2, 0.2]
[[joint]]
name = "finger"
on = "bone"
axis = "y"
[[link]]
name = "nail"
on = "finger"
length = 0.05
mass = 0.02
inertia = [1e-6, 5e-6, 5e-6]
[[input]]
name = "twist"
at = "finger"
acts = "torque"
[[input]]
name = "push"
at = "nail"
acts = "force"
[[output]]
name = "root"
at = "root"
of = "angle"
[[output]]
name = "bone"
at = "bone"
of = "position"
[[output]]
name = "nail"
at = "nail"
of = "position"
"""

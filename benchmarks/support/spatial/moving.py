"""Small arms in space whose base moves: one that floats, and one on a table that turns as an input says."""

from __future__ import annotations

AFLOAT = """
name = "bird"
model = { kind = "spatial", gravity = [0, 0, -9.81] }
integrator = { name = "newmark", step = 1e-2 }
base = { kind = "free" }
joint = [{ name = "hinge", on = "base", at = [0.1, 0.0, 0.1], axis = "y", stiffness = 20.0, damping = 0.05 }]
body = [
  { name = "hub", on = "base", mass = 2.0, center = [0.01, 0.02, -0.05], inertia = [0.1, 0.2, 0.3] },
  { name = "load", on = "hinge", mass = 0.5, center = [0.3, 0.02, 0.01], inertia = [1e-3, 1e-3, 5e-4] },
]
input = [{ name = "push", at = "load", acts = "force" }]
output = [{ name = "load", at = "load", of = "position" }]
"""

TABLE = """
name = "table"
model = { kind = "spatial", gravity = [0, 0, -9.81] }
integrator = { name = "newmark", step = 1e-2 }
base = { kind = "prescribed", axis = [0.5, 0.6, 1.0] }
joint = [
  { name = "hinge", on = "base", at = [0.1, 0.0, 0.1], axis = "y", stiffness = 20.0, damping = 0.05 },
  { name = "other", on = "base", axis = "x", stiffness = 20.0 },
]
link = [{ name = "tip", on = "load", end = [0.3, 0.0, 0.0] }]
body = [
  { name = "load", on = "hinge", mass = 0.5, center = [0.3, 0.02, 0.01], inertia = [1e-3, 1e-3, 5e-4] },
  { name = "second", on = "other", mass = 0.5, center = [-0.1, 0.2, 0.01], inertia = [1e-3, 1e-3, 5e-4] },
]
input = [{ name = "table", at = "base", acts = "angle" }, { name = "push", at = "tip", acts = "force" }]
output = [
  { name = "load", at = "tip", of = "position" },
  { name = "facing", at = "second", of = "orientation" },
  { name = "turned", at = "base", of = "rate" },
]
"""

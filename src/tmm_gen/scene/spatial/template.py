"""The arm in space that a user starts from."""

from __future__ import annotations

MODEL = """\
kind = "spatial"               # an arm in space, however far it turns
gravity = [0, 0, -9.81]        # m/s^2, in the axes of the base; remove the line for none
"""

ARM = """
[base]
kind = "clamp"

# Parts hang on each other by name: `on` says on which, `at` and `turn` where in the frame of its outer end. Without
# them a part continues where the other ends. The first one hangs on the base.
[[motor]]                      # a driven joint; [[joint]] is one without, with stiffness, damping, rest
name = "yaw"
at = [0, 0, 0.1]               # m
axis = "z"                     # or a vector; of its own frame, which turns with it
rotor_inertia = 2e-5           # kg m^2, on the motor's side; gear^2 times it acts along the joint
gear = 100                     # turns of the motor per turn of the joint
damping = 0.5                  # at the output, N m s/rad

[[link]]                       # a rigid link
name = "column"
on = "yaw"
end = [0, 0, 0.2]              # where the next part hangs, m; or `length`, along its x axis
mass = 1.0                     # kg, half way to its end unless `center` says where
inertia = [4e-3, 4e-3, 1e-3]   # kg m^2, about its centre: xx, yy, zz, or six: and xy, xz, yz

[[motor]]
name = "shoulder"
on = "column"
axis = "y"                     # positive angles lower what points along x
rotor_inertia = 1e-5
gear = 100
damping = 0.3
limits = [-1.5, 1.5]           # rad, for control: no stops are simulated

[[beam]]                       # a flexible link along its own x axis
name = "boom"
on = "shoulder"
length = 0.5                   # m
material = { young = 70e9, density = 2700, shear = 26e9 }   # Pa, kg/m^3; without `shear` it does not twist
section = { kind = "rectangle", width = 0.02, thickness = 0.005 }   # m, along y and z; or "tube", "circle"
links = 3                      # cells it is cut into
damping_time = 0.002           # damping of its springs over their stiffness, s

[[body]]                       # a rigid body on the outer end of any part
name = "payload"
on = "boom"
mass = 0.2                     # kg
inertia = [1e-4, 1e-4, 1e-4]   # kg m^2

# What you will feed in, by name. Inputs are zero until you give them a value.
[[input]]
name = "yaw_torque"
at = "yaw"                     # of the motor itself; gear-fold between both sides of the joint
acts = "torque"                # N m

[[input]]
name = "shoulder_torque"
at = "shoulder"
acts = "torque"

[[input]]
name = "push"
at = "payload"
acts = "force"                 # N, or "moment", N m: push_x, push_y, push_z
in = "world"                   # or "body": axes of the components

# What you will get out, by name.
[[output]]
name = "payload"
at = "payload"
of = "position"                # or "velocity", "orientation" (a quaternion)

[[output]]
name = "yaw"
at = "yaw"
of = "angle"                   # or "rate", "acceleration", "torque"

[[output]]
name = "shoulder"
at = "shoulder"
of = "angle"

[initial]
angles = { shoulder = -0.3 }   # rad, of motors and joints; those left out start at 0, beams straight
"""

"""The ``[control]`` of scenes to start from: of an arm on a hub, and of motors by name."""

from __future__ import annotations

HUB_CONTROL = """
# What `tmm-gen mpc` has the motor do.
[control]
reference = 1.0                # angle of the tip to reach, rad
horizon = 30                   # samples looked ahead
sample_time = 0.02             # s
substeps = 4                   # steps of the generated kernel per sample
modes = 4                      # where prediction is by modes
delay = 0.0                    # from a measurement to the torque that answers it, s
payload = 1.3                  # mass at the tip that controllers reckon with, relative to the one above

[control.weights]              # of squares, per sample
tip = 1.0                      # 1/rad^2
hub = 14.5                     # 1/rad^2
tip_rate = 0.399               # s^2/rad^2
hub_rate = 0.00234             # s^2/rad^2
torque = 0.00252               # 1/(N m)^2, beyond what holds the target
torque_step = 0.00551          # 1/(N m)^2, of its change
overshoot = 6.98               # 1/rad^2, of passing the soft bounds below
hub_bound = 1.32               # 1/rad^2

[control.bounds]
torque = 3.0                   # N m, always kept
hub = [-0.1, 1.02]             # rad; passed where there is no other way
overshoot = 0.005              # of the tip, relative to its way; likewise

# As data sheets have them: an absolute encoder of 16 bits, as robots have at their joints; an ordinary MEMS
# accelerometer, 300 ug/sqrt(Hz) over the 25 Hz that a sample can see, and some more.
[control.sensors]
encoder = 65536                # counts per revolution of the hub
accelerometer = 0.02           # noise at the tip, m/s^2; leave out what is not there
# strain = 0.01                # noise of the bending moment at the root, N m

[control.estimator]            # standard deviations the Kalman filter assumes, model errors included
encoder = 0.000547             # rad
accelerometer = 2.22           # m/s^2
torque = 0.0119                # unknown torque, N m
disturbance = 0.704            # change of the constant part per sample, N m
rate = 0.0386                  # change of rate per sample that no torque explains, rad/s

[control.baselines]            # what predictive control is compared with; gains in N m/rad, N m s/rad
pd = [9.35, 2.71]
pd_zv = [11.8, 3.0]            # with a shaped reference
pd_zvd = [11.6, 2.58]

[control.baselines.lqr]        # weights beside that of the tip, 1
hub = 0.198
tip_rate = 0.0199
hub_rate = 0.000132
torque = 0.000747
"""
"""Of one motor, tuned."""

_MOTORS_CONTROL = """
# What `tmm-gen mpc` has the motors do. Numbers are one for all motors, or one by each name; these are not tuned.
[control]
reference = {{ {reference} }}   # joint angles to reach, rad; it starts at rest, held by its motors
horizon = 30                   # samples looked ahead
sample_time = 0.02             # s
substeps = 4                   # steps of the generated kernel per sample

[control.weights]              # of squares, per sample
tip = 1.0                      # of each beam's end against what carries its motor, 1/rad^2
hub = 4.5                      # of the motor's joint, 1/rad^2
tip_rate = 0.15                # s^2/rad^2
torque = 1.0                   # 1/(N m)^2, beyond what holds the target
torque_step = 2.0              # 1/(N m)^2, of its change

[control.bounds]
torque = 0.15                  # of the motors themselves, N m, always kept
# hub = {{ motor1 = [-1.0, 1.0] }}   # of the joints, rad; passed where there is no other way

[control.sensors]
encoder = 65536                # counts per revolution of each joint
"""


def motors_control(motors: int) -> str:
    """Return a ``[control]`` that swings every other motor the other way."""
    names = (f"motor{k} = {-0.5 if k % 2 == 0 else 0.5}" for k in range(1, motors + 1))
    return _MOTORS_CONTROL.format(reference=", ".join(names))

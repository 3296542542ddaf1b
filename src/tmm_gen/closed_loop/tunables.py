"""What can be tuned, and in what ranges: of an arm on a hub, and of one whose motors are parts by name.

Of several motors what belongs to torques counts in the largest that each may have, so that one number serves all of
them: a weight in its square's reciprocal, gains and unknown torques in itself. Gains of PD are turned motor by motor.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from tmm_gen.closed_loop.knobs import Knob, Tunable
from tmm_gen.control.arm.arms import arm_of
from tmm_gen.control.bench import Bench
from tmm_gen.control.controllers import BY_NAME
from tmm_gen.control.estimators.kalman import present_sensors

Ranges = Sequence[tuple[str, float, float]]

_WEIGHTS = (("hub", -1.0, 2.0), ("tip_rate", -2.0, 1.0), ("hub_rate", -4.0, -1.0), ("torque", -4.0, -1.0))
"""Three decades each, as most that follow: a tip weight of one, and time constants of about a second or less."""
_MORE_WEIGHTS = (
    ("torque_step", -5.0, -2.0),
    ("overshoot", 0.0, 3.0),
    ("hub_bound", 0.0, 3.0),
)
_ESTIMATOR = (
    ("encoder", -4.0, -1.5),  # from a count of good encoders
    ("accelerometer", -1.5, 1.0),  # of some tens of m/s^2
    ("torque", -3.0, 0.0),  # of 3 N m
    ("disturbance", -3.0, 0.0),
    ("rate", -2.5, 0.5),  # of some rad/s
)
_GAUGE = ("strain", -3.5, -0.5)
"""Of a motor's largest torque, at the joint."""
_THIS = math.log10(3.0)
"""The ranges above are of a motor of 3 N m."""
_TORQUES = {"torque": -2, "torque_step": -2}
"""Weights, and in which power of a torque they count; what an estimator assumes of torques is one."""
_GAINS = ((-1.0, 2.0), (-1.5, 1.5))
"""Of PD, N m/rad and N m s/rad."""

_PAYLOAD = Knob("control.payload", 0.0, math.log10(1.4), grid=0.05)
"""Of what is tried the heaviest carries half as much again. A grid, since models are made anew for each value."""

_OF_MPC, _OF_LQR = "control.weights", "control.baselines.lqr"
PREDICTIVE = ("mpc-modes", "mpc-links", "rti-zero", "rti")
"""Tuned together; the first two with several noises."""
_BASELINES = {
    "pd": "gains of PD",
    "pd-zv": "gains of PD, ZV shaper",
    "pd-zvd": "gains of PD, ZVD shaper",
    "pd-id": "gains of PD beside inverse dynamics",
}


def like_lqr(key: str) -> str:
    """Return the key of a regulator's weight that is like one of predictive control."""
    return key.replace(_OF_MPC, _OF_LQR)


def _knobs(prefix: str, ranges: Ranges) -> tuple[Knob, ...]:
    return tuple(Knob(f"{prefix}.{key}", low, high) for key, low, high in ranges)


def _key(name: str) -> str:
    return f"control.baselines.{name.replace('-', '_')}"


def _together(
    weights: tuple[Knob, ...],
    regulator: tuple[Knob, ...],
    estimating: tuple[Knob, ...],
    controllers: tuple[str, ...] = PREDICTIVE,
) -> tuple[Tunable, Tunable]:
    """Return predictive control and LQR, for knobs of weights, of those of a regulator, and of the estimator."""
    first = Tunable("regulator", "weights and estimator of a regulator", ("lqr",), (*regulator, *estimating))
    return (
        Tunable(
            "mpc",
            "weights and estimator of predictive control",
            controllers,
            (*weights, *estimating),
            first,
        ),
        Tunable("lqr", "weights of LQR", ("lqr",), regulator),
    )


TUNABLE: tuple[Tunable, ...] = (
    *_together(
        _knobs(_OF_MPC, (*_WEIGHTS, *_MORE_WEIGHTS)),
        _knobs(_OF_LQR, _WEIGHTS),
        (*_knobs("control.estimator", _ESTIMATOR), _PAYLOAD),
    ),
    *(
        Tunable(name, _BASELINES[name], (name,), tuple(Knob(_key(name), *ends) for ends in _GAINS))
        for name in ("pd", "pd-zv", "pd-zvd")
    ),
)
"""Of an arm on a hub. In this order, since LQR takes the estimator that was found for predictive control."""


def titles() -> dict[str, str]:
    """Return a few words on all there is, by name."""
    return {item.name: item.title for item in TUNABLE} | {
        "pd-id": f"{_BASELINES['pd-id']}, of motors by name"
    }


def tunables_of(bench: Bench) -> tuple[Tunable, ...]:
    """Return what can be tuned of an arm: what it has, with controllers that keep its walls."""
    problem = bench.problem
    if problem.motors.on_hub:
        return TUNABLE
    names, largest = problem.motors.names, np.max(np.abs(problem.torque), axis=0)

    def counted(prefix: str, ranges: Ranges, powers: dict[str, int], sizes: np.ndarray) -> tuple[Knob, ...]:
        found = []
        for key, low, high in ranges:
            power = powers.get(key, 0)
            units = tuple(zip(names, (sizes**power).tolist(), strict=True)) if power else ()
            off = power * _THIS if key != _GAUGE[0] else 0.0
            found.append(Knob(f"{prefix}.{key}", low - off, high - off, units=units))
        return tuple(found)

    bounded = {"overshoot": any(problem.tip), "hub_bound": any(problem.hub)}
    more = tuple(each for each in _MORE_WEIGHTS if bounded.get(each[0], True))
    behind = np.array(present_sensors(problem)[problem.count :])
    felt = bool(np.any(behind < 2 * problem.count)) if len(behind) else False
    estimated = tuple(each for each in _ESTIMATOR if each[0] != "accelerometer" or felt)
    estimating = counted("control.estimator", estimated, {"torque": 1, "disturbance": 1}, largest)
    if np.any(behind >= 2 * problem.count):
        estimating += counted("control.estimator", (_GAUGE,), {"strain": 1}, largest * problem.motors.gears)
    if arm_of(bench.scene).payloads():
        estimating += (_PAYLOAD,)
    able = tuple(name for name in PREDICTIVE if not problem.keeps or BY_NAME[name].keeps)
    return (
        *_together(
            counted(_OF_MPC, (*_WEIGHTS, *more), _TORQUES, largest),
            counted(_OF_LQR, _WEIGHTS, _TORQUES, largest),
            estimating,
            able,
        ),
        *(
            Tunable(
                name,
                title,
                (name,),
                tuple(
                    Knob(_key(name), low - _THIS, high - _THIS, units=(unit,))
                    for unit in zip(names, largest.tolist(), strict=True)
                    for low, high in _GAINS
                ),
            )
            for name, title in _BASELINES.items()
        ),
    )

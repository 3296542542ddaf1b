"""What acts on an arm on a page, ready for JSON: a sine, or a smooth way of the base with its rate and acceleration."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from tmm_gen.inputs.signals import Signal, Sine
from tmm_gen.scene import Scene
from tmm_gen.simulate.prescribed import Derivative, kernel_signals
from tmm_gen.study.rise import Rise


def loads(scene: Scene, signals: Mapping[str, Signal]) -> list[dict[str, Any]]:
    """Return what a kernel's inputs do over time, by name; those that stay zero are left out.

    Returns
    -------
    list of dict
        ``name``, and ``amplitude`` and ``frequency`` (rad/s) of a sine, or ``duration`` (s) and ``way``: coefficients
        by rising power of how far on it is, -1/2 before it begins and 1/2 at its end.
    """
    found = []
    for name, signal in kernel_signals(scene, signals).items():
        of, order = (signal.of, signal.order) if isinstance(signal, Derivative) else (signal, 0)
        if isinstance(of, Sine):
            found.append({"name": name, "amplitude": of.amplitude, "frequency": of.frequency})
        elif isinstance(of, Rise):
            way = [float(number) for number in of.way(order).coef]
            found.append({"name": name, "duration": of.duration, "way": way})
    return found

"""What an arm goes through in a study, as a program says it."""

from __future__ import annotations

from collections.abc import Mapping

from tmm_gen.api.given import positive, signals
from tmm_gen.errors import UserError
from tmm_gen.inputs.sampled import Function
from tmm_gen.reference.duration import default_duration
from tmm_gen.scene import Scene
from tmm_gen.simulate.run import number_of_steps
from tmm_gen.study.excitation import Excitation, excitation

__all__ = ["excited"]


def excited(scene: Scene, until: float | None, output: object, acting: Mapping[str, object]) -> Excitation:
    """Return what a scene goes through; inputs by column, as of :func:`tmm_gen.api.given.named`.

    Raises
    ------
    UserError
        If an input is none, or a function, of which a study could not say what it is.
    """
    if output is not None and not isinstance(output, str):
        raise UserError(f"output: {output!r} is no name of an output. Name one.")
    duration = positive("until", until, "seconds") or default_duration(scene)
    given = signals(scene, acting, number_of_steps(duration, scene.integrator.step) if acting else 0)
    for name, signal in given.items():
        if isinstance(signal, Function):
            raise UserError(
                f"{name}: a study keeps its results by what acts, and cannot tell one function from another. Give a "
                f"profile, such as tmm_gen.sine(1.0, 2.0), or times and values."
            )
    return excitation(scene, given, duration, output)

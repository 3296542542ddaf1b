"""What sweeps may leave unsolved of a planar run: no more than its step does, or what the scene says.

Equations of a step need to be solved no better than they stand for the motion (E. Hairer, G. Wanner, Solving Ordinary
Differential Equations II, 2nd ed. 1996, section IV.8). Both shares grow alike with the length of a run: a false energy
makes a false speed, and that is an error per radian, as the step's own is.
"""

from __future__ import annotations

import math

from tmm_gen.errors import CheckFailed
from tmm_gen.scene import Scene
from tmm_gen.simulate.accuracy import MOST, SENSITIVE, Accuracy
from tmm_gen.simulate.too_long import LEAST, TooLongError

SMALLEST, LARGEST = 1e-7, 1e-4
"""Between them the tolerance follows the step: so little is always accepted, and never more than so much."""


class UnsolvedError(CheckFailed, TooLongError):
    """The sweeps of a run left too much of its equations: the message says how much, and what to do."""


class InaccurateError(CheckFailed, TooLongError):
    """The steps of a run are too long for its motion: the message says how wrong it is, and what to do."""


def largest_error(scene: Scene) -> float:
    """Return the largest error of a run, as a share of the motion."""
    return MOST if scene.model.accuracy is None else scene.model.accuracy


def refuse_inaccurate(scene: Scene, accuracy: Accuracy) -> None:
    """Refuse a run that is too far from the motion it stands for.

    Raises
    ------
    InaccurateError
        With the error and the remedies.
    """
    most = largest_error(scene)
    if accuracy.error <= most:
        return
    known = math.isfinite(accuracy.error)
    error = f"about {100.0 * accuracy.error:.2g} % of the motion" if known else "unknown: shorter steps fail"
    sensitive = ""
    if accuracy.sensitivity is not None and accuracy.sensitivity > SENSITIVE:
        sensitive = (
            f" The motion is sensitive: a small disturbance of its start grows {accuracy.sensitivity:.0e}-fold, and so "
            "do the errors of each step."
        )
    step = shorter_step(scene, accuracy)
    remedies = [f"Take shorter steps, --step {step:g}"]
    if accuracy.good_until >= scene.integrator.step:
        remedies.append(f"end sooner, --until {_rounded_down(accuracy.good_until):g}")
    if known:
        accepted = float(f"{1.2 * accuracy.error:.2g}")
        remedies.append(f"accept it, --set model.accuracy={accepted:g}")
    raise InaccurateError(
        f"scene '{scene.name}': with steps of {scene.integrator.step:g} s the error is {error}, more than the "
        f"{100.0 * most:g} % that a run may have.{sensitive}\n{'; or '.join(remedies)}.",
        reason=f"the error would be {error}",
        times=max(LEAST, math.sqrt(2.0 * accuracy.error / most)) if known else LEAST,
    )


def shorter_step(scene: Scene, accuracy: Accuracy) -> float:
    """Return a step that is short enough, as far as can be told: for a tenth of what is accepted at least."""
    fall = 100.0
    if math.isfinite(accuracy.error):
        fall = min(fall, max(10.0, math.sqrt(10.0 * accuracy.error / largest_error(scene))))
    return float(f"{scene.integrator.step / fall:.2g}")


def _rounded_down(value: float) -> float:
    unit = 10.0 ** (math.floor(math.log10(value)) - 2)
    return float(f"{math.floor(value / unit * (1.0 + 1e-12)) * unit:.3g}")


def tolerance(scene: Scene, step_error: float) -> float:
    """Return the largest share of the energy that moves whose work may be left unsolved.

    Parameters
    ----------
    scene : Scene
        Planar, with the linearisation "newton".
    step_error : float
        Of the run (:func:`tmm_gen.simulate.step_error.step_error`).
    """
    if scene.model.unsolved is not None:
        return scene.model.unsolved
    return min(max(step_error, SMALLEST), LARGEST)


def to_accept(scene: Scene, share: float | None, step_error: float | None) -> float | None:
    """Return the ``model.unsolved`` with which a run passes; None where it passes anyway.

    Parameters
    ----------
    scene : Scene
        What has been run.
    share, step_error : float or None
        What its sweeps left unsolved, and its step; None where nothing is iterated.
    """
    if share is None or step_error is None or share <= tolerance(scene, step_error):
        return None
    unit = 10.0 ** math.floor(math.log10(share))
    # the next number above with one digit
    return float(f"{math.ceil(share / unit * 1.001) * unit:.1g}")


def refuse_unsolved(scene: Scene, share: float, step_error: float) -> None:
    """Refuse a run whose sweeps left more unsolved than the tolerance.

    Raises
    ------
    UnsolvedError
        With both figures and the remedies.
    """
    accepted = to_accept(scene, share, step_error)
    if accepted is None:
        return
    sweeps, step = scene.model.iterations, scene.integrator.step
    done = {"auto": "even many sweeps", 1: "one sweep per stage"}.get(sweeps, f"{sweeps} sweeps per stage")
    again = f"Take shorter steps, --step {step / 10:g}"
    if not scene.model.auto:
        again = f"Sweep as often as it takes, --iterations auto; mostly a smaller step helps too, --step {step / 10:g}"
    raise UnsolvedError(
        f"scene '{scene.name}': {done} left loads unsolved whose work is {share:.1e} of the energy that moves, "
        f"{_limit(scene, step_error)}: the motion cannot be trusted.\n"
        f"{again}; or accept it, --set model.unsolved={accepted:g}.",
        reason=f"{done} would leave loads unsolved whose work is {share:.0e} of the energy that moves",
    )


def _limit(scene: Scene, step_error: float) -> str:
    """Say what has been exceeded."""
    if scene.model.unsolved is not None:
        return f"more than model.unsolved = {scene.model.unsolved:g}"
    if step_error > LARGEST:
        return (
            f"more than the {LARGEST:g} that any step may leave (the error of this one is {step_error:.1e})"
        )
    if step_error < SMALLEST:
        return f"and the step's own error explains but {step_error:.1e} ({SMALLEST:g} would pass)"
    return f"more than the step's own error explains, {step_error:.1e}"

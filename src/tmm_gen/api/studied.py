"""What an arm that is studied answers: costs, limits, tunings, controllers, fits."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from os import PathLike
from typing import TYPE_CHECKING, Literal, cast

from tmm_gen.api.described import Described
from tmm_gen.api.given import free_angles, named
from tmm_gen.api.guard import guarded

if TYPE_CHECKING:
    from tmm_gen.api.arm import Arm
    from tmm_gen.api.calibrated import Calibrated
    from tmm_gen.api.controlled import Control
    from tmm_gen.api.explained import Explained
    from tmm_gen.api.run import Run
    from tmm_gen.api.stability import Stability
    from tmm_gen.api.trade import Trade
    from tmm_gen.api.tuned import Tuned
    from tmm_gen.scene import Scene

# SymPy, SciPy, CasADi and Matplotlib are imported inside: an arm is read and changed without them.

__all__ = ["Studied"]

Words = str | Iterable[str] | None
Wholes = int | Iterable[int] | None


class Studied(Described):
    """An arm that can be studied."""

    def _arm(self, scene: Scene) -> Arm:
        return cast("Arm", self.of(scene))

    @guarded
    def explain(self) -> Explained:
        """Say what it makes the generator model, what it leaves out and why, and what that saves."""
        from tmm_gen.api.explained import explained

        return explained(self.scene)

    @guarded
    def stability(
        self, *, maps: Words = None, cells: int | None = None, near: Mapping[str, float] | None = None
    ) -> Stability:
        """Say where it stands against the limit of stability of every integrator.

        Parameters
        ----------
        maps : str or iterable of str, optional
            Integrators whose growth is measured over step and stiffness; by default its own.
        cells : int, optional
            Steps of a map, for two thirds as many stiffnesses; 0 leaves maps out. By default what takes seconds.
        near : mapping from str to float, optional
            Angles of joints, rad: about the equilibrium near them.
        """
        from tmm_gen.api.stability import stability_of

        return stability_of(self.scene, maps, cells, free_angles(self.scene, near))

    @guarded
    def trade(
        self,
        *,
        integrators: Words = None,
        steps: float | Iterable[float] | None = None,
        links: Wholes = None,
        iterations: Wholes = None,
        corrections: Wholes = None,
        linearisations: Words = None,
        reals: Words = None,
        backends: Words = None,
        until: float | None = None,
        output: str | None = None,
        workers: int | None = None,
        scheduler: str | None = None,
        store: str | PathLike[str] | None = None,
        rounds: int = 9,
        inputs: Mapping[str, object] | None = None,
        **more: object,
    ) -> Trade:
        """Measure what accuracy costs, over integrators, steps, links and number types; needs a C compiler.

        Parameters
        ----------
        integrators, steps, links, iterations, corrections, linearisations, reals, backends : optional
            What is tried, one or several of each; by default all integrators, ten steps, each half the last, and else
            what the scene says. Steps in s.
        until : float, optional
            s; by default five slow periods.
        output : str, optional
            Where errors are measured; by default the tip's place or angle.
        workers, scheduler : optional
            Compute errors in so many processes, or on a running cluster, by Dask.
        store : str or path, optional
            SQLite file that keeps results; an interrupted study goes on where it stopped.
        rounds : int
            Measurements of each time, of which the median counts; 0 for none.
        inputs, **more
            What moves it, by name as of :meth:`simulate`, but for functions; by default every input acts, smoothly.
        """
        from tmm_gen.api.trade import traded

        options = {
            "integrators": integrators,
            "steps": steps,
            "links": links,
            "iterations": iterations,
            "corrections": corrections,
            "linearisations": linearisations,
            "reals": reals,
            "backends": ("c",) if backends is None else backends,
        }
        acting = named(self.scene, inputs, more)
        return traded(self.scene, options, until, output, acting, workers, scheduler, store, rounds)

    @guarded
    def tune(
        self,
        max_error: float | str,
        max_time: float | str,
        *,
        links: Wholes | Literal["auto"] = None,
        integrators: Words = None,
        iterations: Wholes = None,
        corrections: Wholes = None,
        linearisations: Words = None,
        reals: Words = None,
        until: float | None = None,
        output: str | None = None,
        target: str | None = None,
        tolerances: bool = False,
        rounds: int = 9,
        inputs: Mapping[str, object] | None = None,
        **more: object,
    ) -> Tuned:
        """Find the cheapest way to compute it within an error and a time; needs a C compiler.

        Parameters
        ----------
        max_error : float or str
            Largest error of the output at any instant: relative to its travel (1e-3, "0.1%") or with a unit ("0.5mm").
        max_time : float or str
            Computing time for a simulated second on this machine, s, or with a unit ("200µs").
        links : "auto", int or iterable of int, optional
            Choose the number of links of the beam too.
        integrators, iterations, corrections, linearisations, reals : optional
            Choose among these, one or several of each; by default all integrators, and else what the scene says.
        until, output, rounds, inputs, **more
            As of :meth:`trade`.
        target : str, optional
            Microcontroller that the scene's budget is for.
        tolerances : bool
            Whether to try steps that a tolerance within the bound on the error chooses, too; not for controllers.
        """
        from tmm_gen.api.tuned import Tuned, searched
        from tmm_gen.scene import parse_scene
        from tmm_gen.study.explain import tuned_text

        options = {
            "integrators": integrators,
            "iterations": iterations,
            "corrections": corrections,
            "linearisations": linearisations,
            "reals": reals,
        }
        acting = named(self.scene, inputs, more)
        tuning, allowed = searched(
            self.scene,
            max_error,
            max_time,
            links,
            options,
            until,
            output,
            target,
            rounds,
            acting,
            tolerances=tolerances,
        )
        if not tuning.found:
            return Tuned(tuning, allowed, None)
        return Tuned(tuning, allowed, self._arm(parse_scene(tuned_text(tuning, self.toml()))))

    @guarded
    def mpc(
        self,
        controllers: Words = None,
        conditions: Words = None,
        *,
        until: float = 2.5,
        seed: int = 0,
        compiled: bool = False,
    ) -> Control:
        """Control it as its ``[control]`` says, on a finer arm with noisy sensors, and compare controllers.

        Parameters
        ----------
        controllers, conditions : str or iterable of str, optional
            Only these; ``tmm-gen mpc --list`` shows them.
        until : float
            Duration of each closed loop, s.
        seed : int
            Of the sensors' noise.
        compiled : bool
            Whether to run the controllers that exist as C as compiled C.
        """
        from tmm_gen.api.controlled import controlled

        return controlled(self.scene, controllers, conditions, until, seed, compiled)

    @guarded
    def calibrate(
        self,
        record: str | PathLike[str] | Run | Mapping[str, object],
        *,
        fit: Words = None,
        time_unit: Literal["s", "ms", "us", "ns"] = "s",
        start: float | None = None,
        loss: Literal["linear", "huber"] = "linear",
        max_misfit: float = 0.5,
        inputs: Mapping[str, object] | None = None,
        **more: object,
    ) -> Calibrated:
        """Fit numbers of it to a recorded response; needs a C compiler.

        Parameters
        ----------
        record : str, path, Run or mapping
            A CSV file with a ``time`` column and columns named as inputs and outputs; the same as a mapping from names
            to arrays, NaN where a sample is missing; or a run.
        fit : str or iterable of str, optional
            Keys of numbers, such as ``"tip.mass"``; ``"stiffness"`` and ``"damping"`` mean all springs and all
            dampers. By default stiffness and damping, of each part by itself.
        time_unit : {"s", "ms", "us", "ns"}
            What ``time`` counts.
        start : float, optional
            When it was in the scene's initial state, in that unit; by default where the clock starts.
        loss : {"linear", "huber"}
            Least squares, or Huber's loss, which gives single wrong samples less weight.
        max_misfit : float
            What may be left, as a share of the record's standard deviation; more is an error.
        inputs, **more
            Inputs that are not in the record, by name as of :meth:`simulate`.
        """
        from tmm_gen.api.calibrated import Calibrated, fitted

        acting = named(self.scene, inputs, more)
        found = fitted(self.scene, record, fit, time_unit, start, loss, max_misfit, acting)
        return Calibrated(found, self._arm(found.scene))

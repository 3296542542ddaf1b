"""An arm: of a scene file or of tables, and all that can be asked of it."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from types import ModuleType
from typing import TYPE_CHECKING, Literal, Unpack

import numpy as np
from numpy.typing import NDArray

from tmm_gen.api.changes import keys_of
from tmm_gen.api.given import constants, free_angles, named, positive, required, signals
from tmm_gen.api.guard import guarded
from tmm_gen.api.studied import Studied
from tmm_gen.api.tables import Tables
from tmm_gen.api.words import whole
from tmm_gen.api.written import Written
from tmm_gen.errors import UserError
from tmm_gen.scene import scene_from

if TYPE_CHECKING:
    from tmm_gen.api.checked import Check
    from tmm_gen.api.frequency import Response
    from tmm_gen.api.kernels import Kernels
    from tmm_gen.api.modes import Modes
    from tmm_gen.api.rest import Equilibria, Equilibrium
    from tmm_gen.api.run import Run
    from tmm_gen.control.arm.linear_model import LinearModel
    from tmm_gen.modal.discretised import LinksNeeded

# SymPy, SciPy, CasADi and Matplotlib are imported inside: an arm is read and changed without them.

__all__ = ["Arm", "Near"]

Array = NDArray[np.float64]
Near = Mapping[str, float]
"""Angles of joints by name, rad."""


class Arm(Studied, Written):
    """An arm, checked. It never changes: :meth:`with_` returns another.

    Parameters
    ----------
    tables : mapping, optional
        The tables of a scene file, as TOML has them: ``Arm({"name": "arm", "model": {"kind": "planar"}, ...})``.
    **more
        The same by name: ``Arm(name="arm", model={"kind": "planar"}, beam={"length": 1.0, ...}, ...)``.

    Raises
    ------
    SceneError
        If they make no arm: it names each key at fault, its value, and what to do. It is a UserError.
    """

    @guarded
    def __init__(self, tables: Mapping[str, object] | None = None, /, **more: Unpack[Tables]) -> None:
        self.scene = scene_from({**_mapping(tables), **more})

    @cached_property
    def _kernels(self) -> Kernels:
        from tmm_gen.api.kernels import Kernels

        return Kernels(self.scene)

    @guarded
    def with_(self, changes: Mapping[str, object] | None = None, /, **more: object) -> Arm:
        """Return the arm with some keys changed, checked again.

        Parameters
        ----------
        changes : mapping, optional
            Values by dotted key, such as ``{"motor.elbow.gear": 80}``; tables by name or counted from 1. None removes a
            key.
        **more
            The same with two underscores for each dot: ``with_(beam__links=20, integrator__name="sdirk4")``.

        Raises
        ------
        SceneError
            If there is no such key, or the result is no arm.
        """
        return Arm.of(self.scene.replace(**keys_of(changes, more)))

    @guarded
    def simulate(
        self,
        until: float | None = None,
        *,
        step: float | None = None,
        backend: Literal["numpy", "c"] = "numpy",
        inputs: Mapping[str, object] | None = None,
        **more: object,
    ) -> Run:
        """Simulate it with its generated kernel.

        Parameters
        ----------
        until : float, optional
            s; by default some periods of its slowest swing.
        step : float, optional
            s; by default the scene's. Where it is given, steps that are too long are not divided but refused.
        backend : {"numpy", "c"}
            Which kernel; C needs a compiler.
        inputs : mapping, optional
            Inputs by name; those not given are zero. Each a number; a profile, as :func:`tmm_gen.smooth` makes it, or
            a text like ``"smooth:0:1.5:0.8s"``; the name of a CSV file; a function of time; an array with a value for
            every instant; a pair of times and values.
        **more
            The same by name: ``simulate(2.0, shoulder_torque=1.0)``.

        Raises
        ------
        UserError
            If an input is none of these, or the run cannot be trusted.
        """
        from tmm_gen.api.run import Run
        from tmm_gen.api.simulating import simulated

        return Run(
            simulated(self.scene, self._kernels.of, until, step, backend, named(self.scene, inputs, more))
        )

    @guarded
    def rest(
        self, *, near: Near | None = None, inputs: Mapping[str, object] | None = None, **more: object
    ) -> Equilibria:
        """Return where it comes to rest, or would balance, under constant inputs.

        Parameters
        ----------
        near : mapping from str to float, optional
            Angles of joints, rad: the equilibrium near them comes first.
        inputs, **more
            Constant inputs by name, numbers; those not given are zero.
        """
        from tmm_gen.api.rest import equilibria_of
        from tmm_gen.modal.situation import require_weight

        require_weight(self.scene)
        return equilibria_of(self.scene, constants(self.scene, inputs, more), free_angles(self.scene, near))

    @guarded
    def modes(
        self,
        count: int = 6,
        *,
        near: Near | None = None,
        inputs: Mapping[str, object] | None = None,
        **more: object,
    ) -> Modes:
        """Return its lowest modes about where it rests; see :meth:`rest` for the other arguments."""
        from tmm_gen.api.modes import modes_of

        held = constants(self.scene, inputs, more)
        return modes_of(self.scene, whole("count", count, 1), held, free_angles(self.scene, near))

    @guarded
    def frequency(
        self,
        source: str | None = None,
        target: str | None = None,
        *,
        low: float | None = None,
        high: float | None = None,
        points: int = 1000,
        near: Near | None = None,
        inputs: Mapping[str, object] | None = None,
        **more: object,
    ) -> Response:
        """Return how an output answers an input at each frequency, by default the first of each.

        Parameters
        ----------
        source, target : str, optional
            Input, a column of them, and output.
        low, high : float, optional
            Band, Hz; by default about the lowest modes.
        points : int
            Frequencies, evenly in log.
        near, inputs, **more
            As of :meth:`rest`.
        """
        from tmm_gen.api.frequency import Response
        from tmm_gen.modal.answer import answered, asked

        limits = positive("low", low, "hertz"), positive("high", high, "hertz")
        if limits[0] is not None and limits[1] is not None and limits[0] >= limits[1]:
            raise UserError(f"low: {low:g} must be less than high, {high:g}.")
        held, start = constants(self.scene, inputs, more), free_angles(self.scene, near)
        about = asked(self.scene, source, target)
        return Response(answered(self.scene, about, limits, whole("points", points, 2), held, start))

    @guarded
    def links_for(self, error: float, band: float) -> LinksNeeded:
        """Return how few links keep its natural frequencies within a relative error, up to a frequency in Hz.

        The arm must be planar, of one ``[beam]``; the answer has ``links``, and ``errors`` of each mode.
        """
        from tmm_gen.modal.discretised import links_for

        return links_for(self.scene, required("error", error, ""), required("band", band, "hertz"))

    @guarded
    def linearise(
        self,
        at: Near | Equilibrium | Literal["rest", "start"] = "rest",
        *,
        inputs: Mapping[str, object] | None = None,
        **more: object,
    ) -> LinearModel:
        """Return it in small motion as ``x' = A x + B u``, ``y = C x + D u``, in continuous time.

        Parameters
        ----------
        at : {"rest", "start"}, mapping or Equilibrium
            About where it comes to rest, as :meth:`modes` is; about its motion at the start; about angles of joints by
            name, rad, the others as at the start, whether it would stay there or not; about one of :meth:`rest`.
        inputs, **more
            Constant inputs that act there, numbers by name; those not given are zero, or as of the equilibrium.
        """
        from tmm_gen.api.linear import linearised

        return linearised(self.scene, lambda: self._kernels.small_motion, at, inputs, more)

    @guarded
    def check(self, *, inputs: Mapping[str, object] | None = None, **more: object) -> Check:
        """Compile its C, and compare every backend with the others and with the exact response.

        Parameters
        ----------
        inputs, **more
            Forces and torques of the run that is compared, as of :meth:`simulate`; by default each is 1.
        """
        from tmm_gen.api.checked import Check
        from tmm_gen.reference.duration import default_duration
        from tmm_gen.scene.signal import PRESCRIBED
        from tmm_gen.simulate.run import number_of_steps
        from tmm_gen.verify.check import check_scene

        scene, acting = self.scene, named(self.scene, inputs, more)
        for item in scene.inputs:
            if item.acts in PRESCRIBED and item.name in acting:
                raise UserError(f"{item.name}: a prescribed base is moved by the check itself. Leave it out.")
        steps = number_of_steps(default_duration(scene), scene.integrator.step)
        return Check(self.name, check_scene(scene, lambda share, doing: None, signals(scene, acting, steps)))

    @guarded
    def casadi(self) -> ModuleType:
        """Return its generated CasADi module: ``step_function()``, ``initial_function()``, ``default_parameters()``."""
        return self._kernels.casadi


def _mapping(tables: object) -> Mapping[str, object]:
    if tables is None or isinstance(tables, Mapping):
        return tables or {}
    raise UserError(f"Arm: takes tables by name, or a mapping of them, not {type(tables).__name__}.")

"""Where else a linear model's arm can rest: the same model in other coordinates, for a target that moves."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tmm_gen.control.prediction.linear import LinearModel
from tmm_gen.control.task.terms import Goal

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Place:
    """A rest that all of a linear model counts from.

    Parameters
    ----------
    goal : Goal
        Angles and torques there.
    state : array, (s,)
        The state there, off the target of the scene.
    shown : array, (3 m,)
        What sensors show there.
    more : float
        Payload that holding it is reckoned with, beyond the scene's, kg.
    """

    goal: Goal
    state: Array
    shown: Array
    more: float = 0.0

    @classmethod
    def of(cls, model: LinearModel) -> Place:
        """Return the target of the scene."""
        return cls(model.goal, np.zeros(model.size), model.target_sensors)


@dataclass(frozen=True, eq=False)
class Places:
    """The places where the arm of a linear model can rest, by the angles of its hubs.

    A rest elsewhere is that of the target turned as a rigid arm, and what its weight then makes of it: of how it
    sags, and of what sensors show. Weight is periodic in each hub's angle, so that this is too: it is taken to go with
    the sine of how far the hub is off, with the slope that the linear model has at the target. Torques are what holds
    the rigid arm up there, exactly, and what is beside that at the target.

    Parameters
    ----------
    model : LinearModel
        About the target of the scene.
    sag : array, (s, m)
        By which the state of a rest at hubs 1 rad on differs from that of a rigid turn.
    felt : array, (3 m, m)
        What sensors but encoders show by that, and by the turn.
    """

    model: LinearModel
    sag: Array
    felt: Array

    @classmethod
    def of(cls, model: LinearModel, still: Array, torque: Array) -> Places:
        """Return those of a model.

        Parameters
        ----------
        still, torque : array, (s, m) and (m, m)
            State and torques, off the target's, of a rest at hubs 1 rad on.
        """
        felt = model.measure @ still + model.feed @ torque
        felt[: model.count] = 0.0
        return cls(model, still - model.turned, felt)

    def at(self, hub: Array, more: float = 0.0) -> Place:
        """Return the rest with the hubs somewhere, (m,), rad, and some more payload, kg."""
        model, target = self.model, self.model.goal
        away = hub - target.hub
        sine = np.sin(away)
        state = model.turned @ away + self.sag @ sine
        shown = model.target_sensors + self.felt @ sine
        shown[: model.count] += away
        torque = model.lift.beside(target) + model.lift.weight(hub, more)
        return Place(Goal(target.tip + model.tip @ state, hub, torque), state, shown, more)

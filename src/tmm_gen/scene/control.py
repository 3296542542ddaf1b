"""``[control]``: what a controller of the arm is to reach, what it may do, and what it knows."""

from __future__ import annotations

from pydantic import Field

from tmm_gen.scene.control_values import (
    EachCount,
    EachFinite,
    EachGains,
    EachNonNegative,
    EachPositive,
    EachRange,
    Horizon,
    Modes,
    Substeps,
)
from tmm_gen.scene.table import NonNegative, Positive, Table
from tmm_gen.scene.trajectory import Keep, Trajectory


class Weights(Table):
    """``[control.weights]``: of the squares in the cost, each per sample; a number for all motors, or one by each name.

    Parameters
    ----------
    tip, hub : float
        Of what tip angle and hub angle are off their targets, 1/rad^2.
    tip_rate, hub_rate : float
        Of the angles' rates, s^2/rad^2.
    torque : float, optional
        Of the torque beyond what holds the target, 1/(N m)^2.
    torque_step : float, optional
        Of the change of torque from sample to sample, 1/(N m)^2; positive, since it makes the problem convex.
    overshoot, hub_bound : float
        Of what the tip angle passes its bound by, and the hub angle its own, 1/rad^2.
    hub_rate_bound : float
        Of what the hub's rate passes its own by, s^2/rad^2.
    """

    tip: EachPositive = Field(default=1.0, description="weight of the tip angle", examples=["1.0"])
    hub: EachNonNegative = Field(default=0.0, description="weight of the hub angle", examples=["0.1"])
    tip_rate: EachNonNegative = Field(default=0.0, description="weight of the tip's rate", examples=["1e-3"])
    hub_rate: EachNonNegative = Field(default=0.0, description="weight of the hub's rate", examples=["1e-3"])
    torque: EachNonNegative | None = Field(
        default=None,
        description="weight of the torque",
        examples=["1e-3"],
        json_schema_extra={"absent": "0.001; of motors by name 0.02 over the square of its largest"},
    )
    torque_step: EachPositive | None = Field(
        default=None,
        description="weight of the change of torque",
        examples=["1e-3"],
        json_schema_extra={"absent": "0.001; of motors by name 0.05 over the square of its largest"},
    )
    overshoot: EachPositive = Field(default=1e4, description="weight of overshoot", examples=["1e4"])
    hub_bound: EachPositive = Field(
        default=1e4, description="weight of passing the hub's bounds", examples=["1e4"]
    )
    hub_rate_bound: EachPositive = Field(
        default=1e3, description="weight of passing the bound of the hub's rate", examples=["1e3"]
    )


class Bounds(Table):
    """``[control.bounds]``: for all motors alike, or by each name.

    Parameters
    ----------
    torque : (low, high)
        Of the hub torque, N m; always kept.
    torque_rate : float, optional
        Largest rate of change of the torque from sample to sample, N m/s; always kept.
    hub : (low, high), optional
        Of the hub's angle, rad; soft: passed where there is no other way.
    hub_rate : float, optional
        Largest rate of the hub's angle, rad/s; soft, and kept by predictive controllers of motors by name.
    overshoot : float, optional
        How far the tip may pass the reference, relative to the way from its start; soft.
    """

    torque: EachRange = Field(description="bounds of the hub torque in N m", examples=["3.0"])
    torque_rate: EachPositive | None = Field(
        default=None, description="largest change of the torque in N m/s", examples=["100.0"]
    )
    hub: EachRange | None = Field(
        default=None, description="bounds of the hub angle in rad", examples=["[-0.1, 1.02]"]
    )
    hub_rate: EachPositive | None = Field(
        default=None, description="largest rate of the hub angle in rad/s", examples=["2.5"]
    )
    overshoot: NonNegative | None = Field(
        default=None, description="largest overshoot of the tip relative to its way", examples=["0.005"]
    )


class Sensors(Table):
    """``[control.sensors]``: what is measured, and how well.

    Parameters
    ----------
    encoder : int
        Counts of the hub's encoder per revolution.
    accelerometer : float, optional
        Standard deviation of the noise of an accelerometer at the tip, across the last link, m/s^2; no such
        sensor if absent. Of several motors one at each one's tip, or at those that are named.
    strain : float, optional
        Standard deviation of the noise of a strain gauge at the root, as a bending moment, N m; no such sensor
        if absent. Of several motors one on the beam that each carries, or on those of the motors that are named.
    """

    encoder: EachCount = Field(default=8192, description="counts per revolution", examples=["8192"])
    accelerometer: EachNonNegative | None = Field(
        default=None, description="noise of the tip accelerometer in m/s^2", examples=["0.05"]
    )
    strain: EachNonNegative | None = Field(
        default=None, description="noise of the root strain gauge in N m", examples=["0.01"]
    )


class Estimator(Table):
    """``[control.estimator]``: standard deviations a Kalman filter takes for granted.

    They speak of the model's errors as well as the sensors', and so may be larger than the sensors' own.

    Parameters
    ----------
    encoder : float
        rad.
    accelerometer : float
        m/s^2.
    strain : float
        N m.
    torque : float, optional
        Of what drives the arm besides the torque known, per sample, N m.
    disturbance : float, optional
        By how much the constant part of it changes per sample, N m.
    rate : float, optional
        By how much the arm's rate as a whole changes per sample without a torque, rad/s: keeps a filter that trusts
        an accelerometer from drifting away from the encoder.
    """

    encoder: EachPositive = Field(default=1e-3, description="error of the encoder in rad", examples=["1e-3"])
    accelerometer: EachPositive = Field(
        default=1.0, description="error of the accelerometer in m/s^2", examples=["1.0"]
    )
    strain: EachPositive = Field(
        default=0.1, description="error of the strain gauge in N m", examples=["0.1"]
    )
    torque: EachPositive | None = Field(
        default=None,
        description="unknown torque in N m",
        examples=["0.01"],
        json_schema_extra={"absent": "0.01; of motors by name 0.05 of its largest torque"},
    )
    disturbance: EachPositive | None = Field(
        default=None,
        description="change of the disturbance per sample in N m",
        examples=["0.01"],
        json_schema_extra={"absent": "0.01; of motors by name 0.01 of its largest torque"},
    )
    rate: EachNonNegative | None = Field(
        default=None,
        description="unexplained change of rate per sample in rad/s",
        examples=["0.005"],
        json_schema_extra={"absent": "0; of motors by name 0.02"},
    )


class RegulatorWeights(Table):
    """``[control.baselines.lqr]``: weights of a linear-quadratic regulator beside that of the tip angle, 1/rad^2.

    Parameters
    ----------
    hub : float
        1/rad^2.
    tip_rate, hub_rate : float
        s^2/rad^2.
    torque : float, optional
        1/(N m)^2, positive.
    """

    hub: EachNonNegative = Field(default=0.0, description="weight of the hub angle", examples=["0.1"])
    tip_rate: EachNonNegative = Field(default=0.0, description="weight of the tip's rate", examples=["0.01"])
    hub_rate: EachNonNegative = Field(default=0.0, description="weight of the hub's rate", examples=["0.01"])
    torque: EachPositive | None = Field(
        default=None,
        description="weight of the torque",
        examples=["0.1"],
        json_schema_extra={"absent": "0.1; of motors by name 0.4 over the square of its largest"},
    )


class Baselines(Table):
    """``[control.baselines]``: what predictive controllers are compared with.

    Parameters
    ----------
    pd, pd_zv, pd_zvd : (proportional, derivative), optional
        Gains on the hub, N m/rad and N m s/rad: alone, and with a reference shaped to leave no vibration. Without
        them: critical damping of the rigid arm at a quarter of its first frequency, or where that is not stable in
        samples at a half, a quarter, ... of this.
    pd_id : (proportional, derivative), optional
        The same beside the torques of the rigid arm along a quintic.
    lqr : RegulatorWeights
        Of a linear-quadratic regulator.
    """

    pd: EachGains | None = Field(default=None, description="gains", examples=["[2.0, 0.8]"])
    pd_zv: EachGains | None = Field(default=None, description="gains", examples=["[2.0, 0.8]"])
    pd_zvd: EachGains | None = Field(default=None, description="gains", examples=["[2.0, 0.8]"])
    pd_id: EachGains | None = Field(
        default=None, description="gains beside inverse dynamics", examples=["[2.0, 0.8]"]
    )
    lqr: RegulatorWeights = Field(default_factory=RegulatorWeights, description="weights of an LQR")


class Control(Table):
    """``[control]``: a controller that turns the tip of a planar arm by the torque at its hub, or by several motors.

    What is said of a motor may be a number for all of them, or a table of one by each name.

    Parameters
    ----------
    reference : float, or dict from str to float
        Angle of the tip to reach, rad; of an arm by parts, the angle of each motor's joint.
    horizon : int
        Samples looked ahead, N.
    sample_time : float
        Time between samples, T, s.
    substeps : int
        Steps of the generated kernel per sample, M.
    modes : int, optional
        Modes of the fine arm where the prediction is by modes, the turning of the whole arm among them; of several
        motors each turns it by one. See `counted_modes`.
    delay : float
        From a measurement to the torque that answers it, s; known and compensated.
    payload : float
        What models take the tip's mass times: a controller that is to do with more than the scene's mass may well
        reckon with some of it.
    payload_body : str, optional
        Name of the ``[[body]]`` whose mass that is, of an arm by parts; without it, of all that are outermost.
    weights, bounds, sensors, estimator, baselines
        Tables of their own.
    trajectory : Trajectory, optional
        What to follow on the way, of an arm by parts; models stay linear about ``reference``.
    keep : tuple of Keep
        Half-planes that parts are to stay in, of an arm by parts.
    """

    reference: EachFinite = Field(description="angle to reach in rad", examples=["1.0"])
    horizon: Horizon = Field(default=30, description="samples looked ahead", examples=["30"])
    sample_time: Positive = Field(default=0.02, description="time between samples in s", examples=["0.02"])
    substeps: Substeps = Field(default=2, description="steps of the kernel per sample", examples=["2"])
    modes: Modes | None = Field(
        default=None,
        description="modes of a prediction by modes",
        examples=["3"],
        json_schema_extra={"absent": "3; of several motors 4 more than there are"},
    )
    delay: NonNegative = Field(default=0.0, description="from measurement to torque in s", examples=["0.01"])
    payload: Positive = Field(
        default=1.0, description="tip mass models reckon with, by the scene's", examples=["1.05"]
    )
    payload_body: str | None = Field(
        default=None,
        description="body whose mass is the payload",
        examples=['"gripper"'],
        json_schema_extra={"absent": "all that are outermost"},
    )
    weights: Weights = Field(default_factory=Weights, description="weights of the cost")
    bounds: Bounds = Field(description="what must be kept", examples=["torque = 3.0"])
    sensors: Sensors = Field(default_factory=Sensors, description="what is measured")
    estimator: Estimator = Field(default_factory=Estimator, description="what a Kalman filter assumes")
    baselines: Baselines = Field(default_factory=Baselines, description="what it is compared with")
    trajectory: Trajectory | None = Field(default=None, description="what to follow")
    keep: tuple[Keep, ...] = Field(default=(), description="half-planes that parts stay in")

    def counted_modes(self, motors: int) -> int:
        """Return the number of modes for so many motors: besides those that turn the arm, some in which it bends."""
        return self.modes or (3 if motors == 1 else motors + 4)

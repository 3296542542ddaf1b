/**
 * arm10: Ten-link arm swung by a hub motor
 *
 * Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: d9d28dc691ae4f0a1d62cb9cfa9f4612d111fa76a756dd286c77eac7f930ab35
 * sha256 of the rest of this file: 056fd181968ffd11cc80380f4b1b6a15d5d31147bf934e70cb54013a082868b9
 *
 * model: planar arm, large rotations, gravity, tip mass
 * stations: 10
 * base: motor
 * integrator: Newmark 1959, beta = 0.25, gamma = 0.5
 * linearisation: newton
 * sweep: riccati
 * unknown: acceleration
 * operations of a step: 1171, 117.1 per station (541 additions, 599 multiplications, 11 divisions, 20 sines
 *     and cosines)
 * operations of prepare: 77, 7.7 per station (15 additions, 62 multiplications)
 * number type: double
 * bytes of the structs: params 224, model 336, state 264, inputs 16, outputs 32
 *
 * @file arm10.c
 */
#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(_M_FP_FAST) \
    || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "-Ofast and -ffast-math remove checks of this file: use -O3, or put -fno-fast-math behind them"
#endif

#include <float.h>
#include <math.h>
#include <stddef.h>
#include <stdint.h>

/* Members of the header below: no macro of a header above may have their names. */
#undef hub_torque
#undef tip_force
#undef tip_x
#undef tip_y
#undef hub
#undef root

#include "arm10.h"

typedef arm10_real real;

/* Sine and cosine of an angle. */
typedef struct {
    real sine;
    real cosine;
} circle;

/*
 * Sine and cosine, right within 2.5e-16 for angles up to 1647099 rad. Additions and multiplications alone, and
 * the same ones for every angle: the same bits on every machine, in the same time.
 */
static circle circle_of(real angle)
{
    /* Sines of no, one, two, three and four quarters of a turn. */
    static const real sine_of_quarters[5] = {
        0.0, 1.0, 0.0, -1.0, 0.0
    };
    circle result;

    /* So large a number that it has no digits behind the point: its last ones count quarters of a turn. */
    const union {
        real number;
        uint64_t digits;
    } counted = {angle * 0.6366197723675814 + 6755399441055744.0};
    const uint64_t quarters = counted.digits & 3u;

    /* The angle without these quarters, in three parts. One expression, so that an analyser sees how small it is. */
    const real rest = angle
        - ((angle * 0.6366197723675814 + 6755399441055744.0) - 6755399441055744.0) * 1.5707963267341256
        - ((angle * 0.6366197723675814 + 6755399441055744.0) - 6755399441055744.0) * 6.077100506303966e-11
        - ((angle * 0.6366197723675814 + 6755399441055744.0) - 6755399441055744.0) * 2.0222662487959506e-21;

    /* Polynomials, of an eighth of a turn at most. */
    const real z = rest * rest;
    real sine = 1.5917030971117794e-10;
    sine = -2.5051116540593934e-08 + z * sine;
    sine = 2.7557316028832514e-06 + z * sine;
    sine = -0.00019841269836615895 + z * sine;
    sine = 0.008333333333330854 + z * sine;
    sine = -0.16666666666666666 + z * sine;
    sine = rest + rest * z * sine;
    real cosine = -1.1381945321240986e-11;
    cosine = 2.0876136694130206e-09 + z * cosine;
    cosine = -2.7557317225611814e-07 + z * cosine;
    cosine = 2.4801587298676432e-05 + z * cosine;
    cosine = -0.001388888888888734 + z * cosine;
    cosine = 0.041666666666666664 + z * cosine;
    cosine = (1.0 - 0.5 * z) + z * z * cosine;

    /* Theorem of addition. */
    result.sine = sine * sine_of_quarters[quarters + 1u] + cosine * sine_of_quarters[quarters];
    result.cosine = cosine * sine_of_quarters[quarters + 1u] - sine * sine_of_quarters[quarters];
    return result;
}

static int inputs_are_finite(const arm10_inputs *inputs)
{
    if (!isfinite(inputs->hub_torque) || !isfinite(inputs->tip_force)) {
        return 0;
    }
    return 1;
}

void arm10_default_params(arm10_params *params)
{
    static const real stiffness[] = {
        64.0, 32.0, 32.0, 32.0, 32.0, 32.0, 32.0, 32.0, 32.0, 32.0
    };
    static const real damping[] = {
        0.128, 0.064, 0.064, 0.064, 0.064, 0.064, 0.064, 0.064, 0.064, 0.064
    };
    if (params == NULL) {
        return;
    }
    params->length = 0.1;
    params->mass = 0.05;
    params->inertia = 4.1666666666666665e-05;
    params->center = 0.5;
    for (int j = 0; j < ARM10_STATIONS; ++j) {
        params->stiffness[j] = stiffness[j];
    }
    for (int j = 0; j < ARM10_STATIONS; ++j) {
        params->damping[j] = damping[j];
    }
    params->gravity = 9.81;
    params->hub_inertia = 0.05;
    params->hub_damping = 0.01;
    params->tip_mass = 0.1;
}

arm10_status arm10_prepare(
    arm10_model *model,
    const arm10_params *params,
    arm10_real step)
{
    if (model == NULL || params == NULL) {
        return ARM10_NULL_POINTER;
    }
    if (!(step > 0.0) || !(step <= DBL_MAX)) {
        return ARM10_INVALID_STEP;
    }
    /* Infinities and NaN less themselves are NaN, all other numbers 0. */
    real lost = (params->length - params->length) + (params->mass - params->mass)
        + (params->inertia - params->inertia) + (params->center - params->center)
        + (params->gravity - params->gravity) + (params->hub_inertia - params->hub_inertia)
        + (params->hub_damping - params->hub_damping) + (params->tip_mass - params->tip_mass);
    for (int j = 0; j < ARM10_STATIONS; ++j) {
        lost += (params->stiffness[j] - params->stiffness[j]) + (params->damping[j] - params->damping[j]);
    }
    if (!(lost >= 0.0)) {
        return ARM10_NON_FINITE_INPUT;
    }

    /* Masses at the nodes between links, and what they leave over. */
    model->end_mass = params->tip_mass - params->mass * (1.0 - params->center);
    model->rod_inertia = params->inertia
        - params->center * (params->length * params->length) * params->mass * (1.0 - params->center);

    /* Factors of the sweep that do not change from step to step. */
    for (int j = ARM10_STATIONS - 1; j >= 0; --j) {
        model->joint_impedance[j] = 0.5 * params->damping[j] * step
            + 0.25 * (step * step) * params->stiffness[j];
    }
    model->hub_impedance = params->hub_inertia + 0.5 * params->hub_damping * step;

    /* Factors of the step that depend on the time step and parameters alone. */
    model->half_step_squared = 0.5 * (step * step);
    model->angle_per_acceleration = 0.25 * (step * step);
    model->rate_per_acceleration = 0.5 * step;

    /* What the step needs as it is. */
    model->step = step;
    model->length = params->length;
    model->mass = params->mass;
    for (int j = 0; j < ARM10_STATIONS; ++j) {
        model->stiffness[j] = params->stiffness[j];
    }
    for (int j = 0; j < ARM10_STATIONS; ++j) {
        model->damping[j] = params->damping[j];
    }
    model->gravity = params->gravity;
    model->hub_inertia = params->hub_inertia;
    model->hub_damping = params->hub_damping;

    real total = 0.0; /* of the model: is all of it finite? */
    for (int j = 0; j < ARM10_STATIONS; ++j) {
        total += model->joint_impedance[j];
    }
    if (!isfinite(model->half_step_squared + model->angle_per_acceleration + model->rate_per_acceleration
        + model->end_mass + model->rod_inertia + model->hub_impedance + total)) {
        return ARM10_NON_FINITE_MODEL;
    }
    return ARM10_OK;
}

arm10_status arm10_initialise(
    arm10_state *state,
    const arm10_params *params,
    const arm10_real initial_angle[ARM10_STATIONS],
    const arm10_real initial_rate[ARM10_STATIONS],
    const arm10_inputs *inputs)
{
    if (state == NULL || params == NULL || inputs == NULL) {
        return ARM10_NULL_POINTER;
    }
    if (!inputs_are_finite(inputs)) {
        return ARM10_NON_FINITE_INPUT;
    }
    for (int j = 0; j < ARM10_STATIONS; ++j) {
        if ((initial_angle != NULL && !isfinite(initial_angle[j]))
            || (initial_rate != NULL && !isfinite(initial_rate[j]))) {
            return ARM10_NON_FINITE_INPUT;
        }
    }

    const real length = params->length;
    const real mass = params->mass;
    real acceleration_x[ARM10_STATIONS + 1]; /* acceleration of the nodes along x [m/s^2] */
    real acceleration_y[ARM10_STATIONS + 1]; /* acceleration of the nodes along y [m/s^2] */
    real answer_own[ARM10_STATIONS]; /* unknown of a station if its inner side kept its motion */
    real answer_x[ARM10_STATIONS]; /* answer of the unknown to the joint's acceleration along x */
    real answer_y[ARM10_STATIONS]; /* answer of the unknown to the joint's acceleration along y */
    real lever_cosine[ARM10_STATIONS]; /* length times cosine of the angle [m] */
    real lever_sine[ARM10_STATIONS]; /* length times sine of the angle [m] */
    /* acceleration of base and links as predicted [rad/s^2] */
    real predicted_acceleration[ARM10_STATIONS + 1];
    real predicted_angle[ARM10_STATIONS + 1]; /* angle of base and links as predicted [rad] */
    real predicted_rate[ARM10_STATIONS + 1]; /* rate of base and links as predicted [rad/s] */
    real total = 0.0; /* of the new motion: is all of it finite? */

    /* Masses at the nodes between links, and what they leave over. */
    const real start_end_mass = params->tip_mass - mass * (1.0 - params->center);
    const real start_rod_inertia = params->inertia
        - params->center * (length * length) * mass * (1.0 - params->center);

    /* What is the same at every station. */
    const real hub_pivot = params->hub_inertia;
    if (!(params->hub_inertia > 0.00048828125) || !(params->hub_inertia <= DBL_MAX)) {
        return ARM10_VANISHING_PIVOT;
    }

    /* Predicted motion. */
    predicted_rate[0] = 0.0;
    predicted_angle[0] = 0.0;
    predicted_acceleration[0] = 0.0;

    /* Predicted motion; accelerations of the nodes, seen from a falling frame: gravity is the base's own. */
    real node_x = 0.0;
    real node_y = params->gravity;
    acceleration_x[0] = node_x;
    acceleration_y[0] = params->gravity;
    for (int j = 0; j < ARM10_STATIONS; ++j) {
        predicted_rate[j + 1] = (initial_rate != NULL ? initial_rate[j] : 0.0);
        predicted_angle[j + 1] = (initial_angle != NULL ? initial_angle[j] : 0.0);
        predicted_acceleration[j + 1] = 0.0;
        if (!(fabs(predicted_angle[j + 1]) <= ARM10_LARGEST_ANGLE)) {
            return ARM10_OUT_OF_RANGE;
        }
        const circle turn_1 = circle_of(predicted_angle[j + 1]);
        lever_cosine[j] = length * turn_1.cosine;
        lever_sine[j] = length * turn_1.sine;
        const real square = predicted_rate[j + 1] * predicted_rate[j + 1];
        const real relative_x = -lever_cosine[j] * square - lever_sine[j] * predicted_acceleration[j + 1];
        const real relative_y = lever_cosine[j] * predicted_acceleration[j + 1] - lever_sine[j] * square;
        node_x = node_x + relative_x;
        node_y = node_y + relative_y;
        acceleration_x[j + 1] = node_x;
        acceleration_y[j + 1] = node_y;
    }

    /* Forces of the joints at the motion so far; sweep inward: force beyond each joint as an affine function
     * of the motion at it. */
    real impedance_xx = start_end_mass;
    real impedance_xy = 0.0;
    real impedance_yx = 0.0;
    real impedance_yy = start_end_mass;
    real force_x = acceleration_x[10] * start_end_mass;
    real force_y = acceleration_y[10] * start_end_mass - inputs->tip_force;
    real torque = 0.0;
    for (int j = ARM10_STATIONS - 1; j >= 0; --j) {
        const real joint_torque = params->damping[j] * (predicted_rate[j] - predicted_rate[j + 1])
            + params->stiffness[j] * (predicted_angle[j] - predicted_angle[j + 1]);
        impedance_xx = impedance_xx + mass;
        force_x = force_x + acceleration_x[j + 1] * mass;
        impedance_yy = impedance_yy + mass;
        force_y = force_y + acceleration_y[j + 1] * mass;
        const real impedance_xu = impedance_xy * lever_cosine[j] - impedance_xx * lever_sine[j];
        const real impedance_yu = impedance_yy * lever_cosine[j] - impedance_yx * lever_sine[j];
        const real impedance_ux = impedance_yx * lever_cosine[j] - impedance_xx * lever_sine[j];
        const real impedance_uy = impedance_yy * lever_cosine[j] - impedance_xy * lever_sine[j];
        const real impedance_uu = start_rod_inertia - impedance_xu * lever_sine[j]
            + impedance_yu * lever_cosine[j];
        torque = torque - force_x * lever_sine[j] + force_y * lever_cosine[j]
            + predicted_acceleration[j + 1] * start_rod_inertia;
        if (!(impedance_uu > 3.814697265625e-06) || !(impedance_uu <= DBL_MAX)) {
            return ARM10_VANISHING_PIVOT;
        }
        const real admittance = 1.0 / impedance_uu;
        answer_own[j] = admittance * (joint_torque - torque);
        if (!(fabs(answer_own[j]) < 536870912.0)) {
            return ARM10_OUT_OF_RANGE;
        }
        /*@ admit -536870912.0 < answer_own[j] < 536870912.0; */
        answer_x[j] = admittance * impedance_ux;
        if (!(fabs(answer_x[j]) < 1024.0)) {
            return ARM10_OUT_OF_RANGE;
        }
        /*@ admit -1024.0 < answer_x[j] < 1024.0; */
        answer_y[j] = admittance * impedance_uy;
        if (!(fabs(answer_y[j]) < 2048.0)) {
            return ARM10_OUT_OF_RANGE;
        }
        /*@ admit -2048.0 < answer_y[j] < 2048.0; */
        impedance_xx = impedance_xx - answer_x[j] * impedance_xu;
        impedance_xy = impedance_xy - answer_y[j] * impedance_xu;
        force_x = force_x + answer_own[j] * impedance_xu;
        impedance_yx = impedance_yx - answer_x[j] * impedance_yu;
        impedance_yy = impedance_yy - answer_y[j] * impedance_yu;
        force_y = force_y + answer_own[j] * impedance_yu;
        torque = joint_torque;
    }

    /* The base. */
    real unknown = (inputs->hub_torque - torque - params->hub_damping * predicted_rate[0]
        - params->hub_inertia * predicted_acceleration[0]) / hub_pivot;
    const real hub_unknown = unknown;

    /* Sweep outward: the unknown of each station. */
    real change_x = 0.0;
    real change_y = 0.0;

    /* Sweep outward: the unknown of each station; motion at the end of the step. */
    state->hub_angle = predicted_angle[0];
    state->hub_rate = predicted_rate[0];
    state->hub_acceleration = hub_unknown + predicted_acceleration[0];
    for (int j = 0; j < ARM10_STATIONS; ++j) {
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y;
        change_x = change_x - lever_sine[j] * unknown;
        change_y = change_y + lever_cosine[j] * unknown;
        state->angle[j] = predicted_angle[j + 1];
        state->rate[j] = predicted_rate[j + 1];
        state->acceleration[j] = predicted_acceleration[j + 1] + unknown;
        total += state->angle[j] + state->rate[j] + state->acceleration[j];
    }

    if (!isfinite(total + state->hub_angle + state->hub_rate + state->hub_acceleration)) {
        return ARM10_NON_FINITE_STATE;
    }
    return ARM10_OK;
}

arm10_status arm10_step(
    const arm10_model *model,
    arm10_state *state,
    const arm10_inputs *inputs)
{
    if (model == NULL || state == NULL || inputs == NULL) {
        return ARM10_NULL_POINTER;
    }
    if (!inputs_are_finite(inputs)) {
        return ARM10_NON_FINITE_INPUT;
    }

    const real step = model->step;
    const real length = model->length;
    const real mass = model->mass;
    const real half_step_squared = model->half_step_squared;
    const real angle_per_acceleration = model->angle_per_acceleration;
    const real rate_per_acceleration = model->rate_per_acceleration;
    const real rod_inertia = model->rod_inertia;
    real acceleration_x[ARM10_STATIONS + 1]; /* acceleration of the nodes along x [m/s^2] */
    real acceleration_y[ARM10_STATIONS + 1]; /* acceleration of the nodes along y [m/s^2] */
    real answer_own[ARM10_STATIONS]; /* unknown of a station if its inner side kept its motion */
    real answer_x[ARM10_STATIONS]; /* answer of the unknown to the joint's acceleration along x */
    real answer_y[ARM10_STATIONS]; /* answer of the unknown to the joint's acceleration along y */
    real lever_cosine[ARM10_STATIONS]; /* length times cosine of the angle [m] */
    real lever_sine[ARM10_STATIONS]; /* length times sine of the angle [m] */
    real predicted_angle[ARM10_STATIONS + 1]; /* angle of base and links as predicted [rad] */
    real predicted_rate[ARM10_STATIONS + 1]; /* rate of base and links as predicted [rad/s] */
    real swing_x[ARM10_STATIONS]; /* change of the outer end's acceleration along x per unknown [m] */
    real swing_y[ARM10_STATIONS]; /* change of the outer end's acceleration along y per unknown [m] */
    real transmission[ARM10_STATIONS]; /* share of motion and torque each joint passes on */
    real total = 0.0; /* of the new motion: is all of it finite? */

    /* Predicted motion. */
    predicted_rate[0] = state->hub_rate + state->hub_acceleration * step;
    predicted_angle[0] = state->hub_angle + half_step_squared * state->hub_acceleration
        + state->hub_rate * step;

    /* Predicted motion; accelerations of the nodes, seen from a falling frame: gravity is the base's own. */
    real node_x = 0.0;
    real node_y = model->gravity;
    acceleration_x[0] = node_x;
    acceleration_y[0] = model->gravity;
    for (int j = 0; j < ARM10_STATIONS; ++j) {
        predicted_rate[j + 1] = state->rate[j] + state->acceleration[j] * step;
        predicted_angle[j + 1] = state->angle[j] + state->acceleration[j] * half_step_squared
            + state->rate[j] * step;
        if (!(fabs(predicted_angle[j + 1]) <= ARM10_LARGEST_ANGLE)) {
            return ARM10_OUT_OF_RANGE;
        }
        const circle turn_1 = circle_of(predicted_angle[j + 1]);
        lever_cosine[j] = length * turn_1.cosine;
        lever_sine[j] = length * turn_1.sine;
        const real square = predicted_rate[j + 1] * predicted_rate[j + 1];
        const real relative_x = -state->acceleration[j] * lever_sine[j] - lever_cosine[j] * square;
        const real relative_y = state->acceleration[j] * lever_cosine[j] - lever_sine[j] * square;
        const real turning = predicted_rate[j + 1] * step;
        swing_x[j] = -lever_sine[j] - angle_per_acceleration * relative_y - lever_cosine[j] * turning;
        swing_y[j] = lever_cosine[j] + angle_per_acceleration * relative_x - lever_sine[j] * turning;
        node_x = node_x + relative_x;
        node_y = node_y + relative_y;
        acceleration_x[j + 1] = node_x;
        acceleration_y[j + 1] = node_y;
    }

    /* Forces of the joints at the motion so far; sweep inward: force beyond each joint as an affine function
     * of the motion at it. */
    real impedance_xx = model->end_mass;
    real impedance_xy = 0.0;
    real impedance_xu = 0.0;
    real impedance_yx = 0.0;
    real impedance_yy = model->end_mass;
    real impedance_yu = 0.0;
    real impedance_ux = 0.0;
    real impedance_uy = 0.0;
    real impedance_uu = 0.0;
    real force_x = acceleration_x[10] * model->end_mass;
    real force_y = acceleration_y[10] * model->end_mass - inputs->tip_force;
    real torque = 0.0;
    for (int j = ARM10_STATIONS - 1; j >= 0; --j) {
        const real joint_torque = model->damping[j] * (predicted_rate[j] - predicted_rate[j + 1])
            + model->stiffness[j] * (predicted_angle[j] - predicted_angle[j + 1]);
        impedance_xx = impedance_xx + mass;
        force_x = force_x + acceleration_x[j + 1] * mass;
        impedance_yy = impedance_yy + mass;
        force_y = force_y + acceleration_y[j + 1] * mass;
        impedance_xu = impedance_xu + impedance_xx * swing_x[j] + impedance_xy * swing_y[j];
        impedance_yu = impedance_yu + impedance_yx * swing_x[j] + impedance_yy * swing_y[j];
        impedance_uu = impedance_uu + impedance_ux * swing_x[j] + impedance_uy * swing_y[j];
        impedance_ux = impedance_ux - impedance_xx * lever_sine[j] + impedance_yx * lever_cosine[j];
        impedance_uy = impedance_uy - impedance_xy * lever_sine[j] + impedance_yy * lever_cosine[j];
        impedance_uu = impedance_uu + rod_inertia
            + lever_cosine[j] * (impedance_yu - angle_per_acceleration * force_x)
            + lever_sine[j] * (-impedance_xu - angle_per_acceleration * force_y);
        torque = torque + state->acceleration[j] * rod_inertia - force_x * lever_sine[j]
            + force_y * lever_cosine[j];
        const real pivot = impedance_uu + model->joint_impedance[j];
        if (!(pivot > 3.814697265625e-06) || !(pivot <= DBL_MAX)) {
            return ARM10_VANISHING_PIVOT;
        }
        const real admittance = 1.0 / pivot;
        answer_own[j] = admittance * (joint_torque - torque);
        if (!(fabs(answer_own[j]) < 134217728.0)) {
            return ARM10_OUT_OF_RANGE;
        }
        /*@ admit -134217728.0 < answer_own[j] < 134217728.0; */
        answer_x[j] = admittance * impedance_ux;
        if (!(fabs(answer_x[j]) < 1024.0)) {
            return ARM10_OUT_OF_RANGE;
        }
        /*@ admit -1024.0 < answer_x[j] < 1024.0; */
        answer_y[j] = admittance * impedance_uy;
        if (!(fabs(answer_y[j]) < 1024.0)) {
            return ARM10_OUT_OF_RANGE;
        }
        /*@ admit -1024.0 < answer_y[j] < 1024.0; */
        transmission[j] = admittance * model->joint_impedance[j];
        impedance_xx = impedance_xx - answer_x[j] * impedance_xu;
        impedance_xy = impedance_xy - answer_y[j] * impedance_xu;
        force_x = force_x + answer_own[j] * impedance_xu;
        impedance_xu = impedance_xu * transmission[j];
        impedance_yx = impedance_yx - answer_x[j] * impedance_yu;
        impedance_yy = impedance_yy - answer_y[j] * impedance_yu;
        force_y = force_y + answer_own[j] * impedance_yu;
        impedance_yu = impedance_yu * transmission[j];
        impedance_ux = answer_x[j] * model->joint_impedance[j];
        impedance_uy = answer_y[j] * model->joint_impedance[j];
        impedance_uu = impedance_uu * transmission[j];
        torque = joint_torque - answer_own[j] * model->joint_impedance[j];
    }

    /* The base. */
    const real hub_pivot = model->hub_impedance + impedance_uu;
    if (!(hub_pivot > 0.00048828125) || !(hub_pivot <= DBL_MAX)) {
        return ARM10_VANISHING_PIVOT;
    }
    real unknown = (inputs->hub_torque - torque - state->hub_acceleration * model->hub_inertia
        - model->hub_damping * predicted_rate[0]) / hub_pivot;
    const real hub_unknown = unknown;

    /* Sweep outward: the unknown of each station. */
    real change_x = 0.0;
    real change_y = 0.0;

    /* Sweep outward: the unknown of each station; motion at the end of the step. */
    state->hub_angle = predicted_angle[0] + angle_per_acceleration * hub_unknown;
    state->hub_rate = predicted_rate[0] + hub_unknown * rate_per_acceleration;
    state->hub_acceleration = state->hub_acceleration + hub_unknown;
    for (int j = 0; j < ARM10_STATIONS; ++j) {
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y + transmission[j] * unknown;
        change_x = change_x + swing_x[j] * unknown;
        change_y = change_y + swing_y[j] * unknown;
        state->angle[j] = predicted_angle[j + 1] + angle_per_acceleration * unknown;
        state->rate[j] = predicted_rate[j + 1] + rate_per_acceleration * unknown;
        state->acceleration[j] = state->acceleration[j] + unknown;
        total += state->angle[j] + state->rate[j] + state->acceleration[j];
    }

    if (!isfinite(total + state->hub_angle + state->hub_rate + state->hub_acceleration)) {
        return ARM10_NON_FINITE_STATE;
    }
    return ARM10_OK;
}

void arm10_output(
    const arm10_model *model,
    const arm10_state *state,
    arm10_outputs *outputs)
{
    if (model == NULL || state == NULL || outputs == NULL) {
        return;
    }
    const real length = model->length;

    /* Output tip: position. */
    outputs->tip_x = 0.0;
    outputs->tip_y = 0.0;
    for (int j = 0; j < ARM10_STATIONS; ++j) {
        const circle turn_1 = circle_of(state->angle[j]);
        outputs->tip_x = outputs->tip_x + length * turn_1.cosine;
        outputs->tip_y = outputs->tip_y + length * turn_1.sine;
    }

    /* Output hub: angle. */
    outputs->hub = state->hub_angle;

    /* Output root: torque. */
    outputs->root = model->damping[0] * (state->rate[0] - state->hub_rate)
        + model->stiffness[0] * (state->angle[0] - state->hub_angle);
}

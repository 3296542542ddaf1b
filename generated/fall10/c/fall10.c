/**
 * fall10: Soft clamped beam falling under its own weight
 *
 * Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: 225557ccb20983327784b6fc8326b9127fb185b183a5e99d150385ab258b9303
 * sha256 of the rest of this file: 494640172c28385658d978e6ce0464236c5711ce5aeb352942573aea95dd2c76
 *
 * model: planar arm, large rotations, gravity
 * stations: 10
 * base: clamp
 * integrator: Newmark 1959, beta = 0.25, gamma = 0.5
 * linearisation: newton
 * sweep: riccati
 * unknown: acceleration
 * operations of a step: 1152, 115.2 per station (530 additions, 592 multiplications, 10 divisions, 20 sines
 *     and cosines)
 * operations of prepare: 73, 7.3 per station (13 additions, 60 multiplications)
 * number type: double
 * bytes of the structs: params 200, model 312, state 240, inputs 8, outputs 40
 *
 * @file fall10.c
 */
#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(_M_FP_FAST) \
    || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "-Ofast and -ffast-math remove checks of this file: use -O3, or put -fno-fast-math behind them"
#endif

#include <float.h>
#include <math.h>
#include <stddef.h>

/* Members of the header below: no macro of a header above may have their names. */
#undef tip_x
#undef tip_y
#undef speed_x
#undef speed_y
#undef root

#include "fall10.h"

typedef fall10_real real;

void fall10_default_params(fall10_params *params)
{
    static const real stiffness[] = {
        32.0, 16.0, 16.0, 16.0, 16.0, 16.0, 16.0, 16.0, 16.0, 16.0
    };
    static const real damping[] = {
        0.064, 0.032, 0.032, 0.032, 0.032, 0.032, 0.032, 0.032, 0.032, 0.032
    };
    if (params == NULL) {
        return;
    }
    params->length = 0.1;
    params->mass = 0.03;
    params->inertia = 2.5e-05;
    params->center = 0.5;
    for (int j = 0; j < FALL10_STATIONS; ++j) {
        params->stiffness[j] = stiffness[j];
    }
    for (int j = 0; j < FALL10_STATIONS; ++j) {
        params->damping[j] = damping[j];
    }
    params->gravity = 9.81;
}

fall10_status fall10_prepare(
    fall10_model *model,
    const fall10_params *params,
    fall10_real step)
{
    if (model == NULL || params == NULL) {
        return FALL10_NULL_POINTER;
    }
    if (!(step > 0.0) || !(step <= DBL_MAX)) {
        return FALL10_INVALID_STEP;
    }
    /* Infinities and NaN less themselves are NaN, all other numbers 0. */
    real lost = (params->length - params->length) + (params->mass - params->mass)
        + (params->inertia - params->inertia) + (params->center - params->center)
        + (params->gravity - params->gravity);
    for (int j = 0; j < FALL10_STATIONS; ++j) {
        lost += (params->stiffness[j] - params->stiffness[j]) + (params->damping[j] - params->damping[j]);
    }
    if (!(lost >= 0.0)) {
        return FALL10_NON_FINITE_INPUT;
    }

    /* Masses at the nodes between links, and what they leave over. */
    model->end_mass = -params->mass * (1.0 - params->center);
    model->rod_inertia = params->inertia
        - params->center * (params->length * params->length) * params->mass * (1.0 - params->center);

    /* Factors of the sweep that do not change from step to step. */
    for (int j = FALL10_STATIONS - 1; j >= 0; --j) {
        model->joint_impedance[j] = 0.5 * params->damping[j] * step
            + 0.25 * (step * step) * params->stiffness[j];
    }

    /* Factors of the step that depend on the time step and parameters alone. */
    model->half_step_squared = 0.5 * (step * step);
    model->angle_per_acceleration = 0.25 * (step * step);
    model->rate_per_acceleration = 0.5 * step;

    /* What the step needs as it is. */
    model->step = step;
    model->length = params->length;
    model->mass = params->mass;
    for (int j = 0; j < FALL10_STATIONS; ++j) {
        model->stiffness[j] = params->stiffness[j];
    }
    for (int j = 0; j < FALL10_STATIONS; ++j) {
        model->damping[j] = params->damping[j];
    }
    model->gravity = params->gravity;

    real total = 0.0; /* of the model: is all of it finite? */
    for (int j = 0; j < FALL10_STATIONS; ++j) {
        total += model->joint_impedance[j];
    }
    if (!isfinite(model->half_step_squared + model->angle_per_acceleration + model->rate_per_acceleration
        + model->end_mass + model->rod_inertia + total)) {
        return FALL10_NON_FINITE_MODEL;
    }
    return FALL10_OK;
}

fall10_status fall10_initialise(
    fall10_state *state,
    const fall10_params *params,
    const fall10_real initial_angle[FALL10_STATIONS],
    const fall10_real initial_rate[FALL10_STATIONS],
    const fall10_inputs *inputs)
{
    if (state == NULL || params == NULL) {
        return FALL10_NULL_POINTER;
    }
    for (int j = 0; j < FALL10_STATIONS; ++j) {
        if ((initial_angle != NULL && !isfinite(initial_angle[j]))
            || (initial_rate != NULL && !isfinite(initial_rate[j]))) {
            return FALL10_NON_FINITE_INPUT;
        }
    }
    (void)inputs;

    const real length = params->length;
    const real mass = params->mass;
    real acceleration_x[FALL10_STATIONS + 1]; /* acceleration of the nodes along x [m/s^2] */
    real acceleration_y[FALL10_STATIONS + 1]; /* acceleration of the nodes along y [m/s^2] */
    real answer_own[FALL10_STATIONS]; /* unknown of a station if its inner side kept its motion */
    real answer_x[FALL10_STATIONS]; /* answer of the unknown to the joint's acceleration along x */
    real answer_y[FALL10_STATIONS]; /* answer of the unknown to the joint's acceleration along y */
    real lever_cosine[FALL10_STATIONS]; /* length times cosine of the angle [m] */
    real lever_sine[FALL10_STATIONS]; /* length times sine of the angle [m] */
    /* acceleration of base and links as predicted [rad/s^2] */
    real predicted_acceleration[FALL10_STATIONS + 1];
    real predicted_angle[FALL10_STATIONS + 1]; /* angle of base and links as predicted [rad] */
    real predicted_rate[FALL10_STATIONS + 1]; /* rate of base and links as predicted [rad/s] */
    real total = 0.0; /* of the new motion: is all of it finite? */

    /* Masses at the nodes between links, and what they leave over. */
    const real start_end_mass = -mass * (1.0 - params->center);
    const real start_rod_inertia = params->inertia
        - params->center * (length * length) * mass * (1.0 - params->center);

    /* Predicted motion. */
    predicted_rate[0] = 0.0;
    predicted_angle[0] = 0.0;
    predicted_acceleration[0] = 0.0;

    /* Predicted motion; accelerations of the nodes, seen from a falling frame: gravity is the base's own. */
    real node_x = 0.0;
    real node_y = params->gravity;
    acceleration_x[0] = node_x;
    acceleration_y[0] = params->gravity;
    for (int j = 0; j < FALL10_STATIONS; ++j) {
        predicted_rate[j + 1] = (initial_rate != NULL ? initial_rate[j] : 0.0);
        predicted_angle[j + 1] = (initial_angle != NULL ? initial_angle[j] : 0.0);
        predicted_acceleration[j + 1] = 0.0;
        lever_cosine[j] = length * cos(predicted_angle[j + 1]);
        lever_sine[j] = length * sin(predicted_angle[j + 1]);
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
    real force_y = acceleration_y[10] * start_end_mass;
    real torque = 0.0;
    for (int j = FALL10_STATIONS - 1; j >= 0; --j) {
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
        if (!(impedance_uu > 0.0) || !(impedance_uu <= DBL_MAX)) {
            return FALL10_VANISHING_PIVOT;
        }
        const real admittance = 1.0 / impedance_uu;
        answer_own[j] = admittance * (joint_torque - torque);
        answer_x[j] = admittance * impedance_ux;
        answer_y[j] = admittance * impedance_uy;
        impedance_xx = impedance_xx - answer_x[j] * impedance_xu;
        impedance_xy = impedance_xy - answer_y[j] * impedance_xu;
        force_x = force_x + answer_own[j] * impedance_xu;
        impedance_yx = impedance_yx - answer_x[j] * impedance_yu;
        impedance_yy = impedance_yy - answer_y[j] * impedance_yu;
        force_y = force_y + answer_own[j] * impedance_yu;
        torque = joint_torque;
    }

    /* The base. */
    real unknown = 0.0;

    /* Sweep outward: the unknown of each station; motion at the end of the step. */
    real change_x = 0.0;
    real change_y = 0.0;
    for (int j = 0; j < FALL10_STATIONS; ++j) {
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y;
        change_x = change_x - lever_sine[j] * unknown;
        change_y = change_y + lever_cosine[j] * unknown;
        state->angle[j] = predicted_angle[j + 1];
        state->rate[j] = predicted_rate[j + 1];
        state->acceleration[j] = predicted_acceleration[j + 1] + unknown;
        total += state->angle[j] + state->rate[j] + state->acceleration[j];
    }

    if (!isfinite(total)) {
        return FALL10_NON_FINITE_STATE;
    }
    return FALL10_OK;
}

fall10_status fall10_step(
    const fall10_model *model,
    fall10_state *state,
    const fall10_inputs *inputs)
{
    if (model == NULL || state == NULL) {
        return FALL10_NULL_POINTER;
    }
    (void)inputs;

    const real step = model->step;
    const real length = model->length;
    const real mass = model->mass;
    const real half_step_squared = model->half_step_squared;
    const real angle_per_acceleration = model->angle_per_acceleration;
    const real rate_per_acceleration = model->rate_per_acceleration;
    const real rod_inertia = model->rod_inertia;
    real acceleration_x[FALL10_STATIONS + 1]; /* acceleration of the nodes along x [m/s^2] */
    real acceleration_y[FALL10_STATIONS + 1]; /* acceleration of the nodes along y [m/s^2] */
    real answer_own[FALL10_STATIONS]; /* unknown of a station if its inner side kept its motion */
    real answer_x[FALL10_STATIONS]; /* answer of the unknown to the joint's acceleration along x */
    real answer_y[FALL10_STATIONS]; /* answer of the unknown to the joint's acceleration along y */
    real lever_cosine[FALL10_STATIONS]; /* length times cosine of the angle [m] */
    real lever_sine[FALL10_STATIONS]; /* length times sine of the angle [m] */
    real predicted_angle[FALL10_STATIONS + 1]; /* angle of base and links as predicted [rad] */
    real predicted_rate[FALL10_STATIONS + 1]; /* rate of base and links as predicted [rad/s] */
    real swing_x[FALL10_STATIONS]; /* change of the outer end's acceleration along x per unknown [m] */
    real swing_y[FALL10_STATIONS]; /* change of the outer end's acceleration along y per unknown [m] */
    real transmission[FALL10_STATIONS]; /* share of motion and torque each joint passes on */
    real total = 0.0; /* of the new motion: is all of it finite? */

    /* Predicted motion. */
    predicted_rate[0] = 0.0;
    predicted_angle[0] = 0.0;

    /* Predicted motion; accelerations of the nodes, seen from a falling frame: gravity is the base's own. */
    real node_x = 0.0;
    real node_y = model->gravity;
    acceleration_x[0] = node_x;
    acceleration_y[0] = model->gravity;
    for (int j = 0; j < FALL10_STATIONS; ++j) {
        predicted_rate[j + 1] = state->rate[j] + state->acceleration[j] * step;
        predicted_angle[j + 1] = state->angle[j] + state->acceleration[j] * half_step_squared
            + state->rate[j] * step;
        lever_cosine[j] = length * cos(predicted_angle[j + 1]);
        lever_sine[j] = length * sin(predicted_angle[j + 1]);
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
    real force_y = acceleration_y[10] * model->end_mass;
    real torque = 0.0;
    for (int j = FALL10_STATIONS - 1; j >= 0; --j) {
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
        if (!(pivot > 0.0) || !(pivot <= DBL_MAX)) {
            return FALL10_VANISHING_PIVOT;
        }
        const real admittance = 1.0 / pivot;
        answer_own[j] = admittance * (joint_torque - torque);
        answer_x[j] = admittance * impedance_ux;
        answer_y[j] = admittance * impedance_uy;
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
    real unknown = 0.0;

    /* Sweep outward: the unknown of each station; motion at the end of the step. */
    real change_x = 0.0;
    real change_y = 0.0;
    for (int j = 0; j < FALL10_STATIONS; ++j) {
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y + transmission[j] * unknown;
        change_x = change_x + swing_x[j] * unknown;
        change_y = change_y + swing_y[j] * unknown;
        state->angle[j] = predicted_angle[j + 1] + angle_per_acceleration * unknown;
        state->rate[j] = predicted_rate[j + 1] + rate_per_acceleration * unknown;
        state->acceleration[j] = state->acceleration[j] + unknown;
        total += state->angle[j] + state->rate[j] + state->acceleration[j];
    }

    if (!isfinite(total)) {
        return FALL10_NON_FINITE_STATE;
    }
    return FALL10_OK;
}

void fall10_output(
    const fall10_model *model,
    const fall10_state *state,
    fall10_outputs *outputs)
{
    if (model == NULL || state == NULL || outputs == NULL) {
        return;
    }
    const real length = model->length;

    /* Output tip: position. */
    outputs->tip_x = 0.0;
    outputs->tip_y = 0.0;

    /* Output tip: position; output speed: velocity. */
    outputs->speed_x = 0.0;
    outputs->speed_y = 0.0;
    for (int j = 0; j < FALL10_STATIONS; ++j) {
        outputs->tip_x = outputs->tip_x + length * cos(state->angle[j]);
        outputs->tip_y = outputs->tip_y + length * sin(state->angle[j]);
        outputs->speed_x = outputs->speed_x - length * state->rate[j] * sin(state->angle[j]);
        outputs->speed_y = outputs->speed_y + length * state->rate[j] * cos(state->angle[j]);
    }

    /* Output root: torque. */
    outputs->root = state->angle[0] * model->stiffness[0] + model->damping[0] * state->rate[0];
}

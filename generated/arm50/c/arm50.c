/**
 * arm50: Stiff arm of fifty links on a servo
 *
 * Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: 7e2e87b8a48332cf3886a22711bd9428eeea692a0d70cc5ae1662962d37ffc57
 * sha256 of the rest of this file: a1b87106dd6a89caa5f24c47f7c264a2be2608d3047a6423c81ea76b4d0bc958
 *
 * model: planar arm, large rotations, tip mass
 * stations: 50
 * base: prescribed
 * integrator: SDIRK, order 4, 5 stages (Hairer & Wanner 1996)
 * linearisation: newton
 * sweep: riccati
 * unknown: acceleration
 * operations of a step: 29465, 589.3 per station (13600 additions, 15115 multiplications, 250 divisions, 500
 *     sines and cosines)
 * operations of prepare: 329, 6.58 per station (55 additions, 274 multiplications)
 * number type: double
 * bytes of the structs: params 848, model 1392, state 1216, inputs 120, outputs 48
 *
 * @file arm50.c
 */
#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(_M_FP_FAST) \
    || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "-Ofast and -ffast-math remove checks of this file: use -O3, or put -fno-fast-math behind them"
#endif

#include <float.h>
#include <math.h>
#include <stddef.h>

/* Members of the header below: no macro of a header above may have their names. */
#undef base_angle
#undef base_angle_rate
#undef base_angle_acceleration
#undef tip_x
#undef tip_y
#undef tip_angle
#undef reaction_x
#undef reaction_y
#undef drive

#include "arm50.h"

typedef arm50_real real;

static int inputs_are_finite(const arm50_inputs *inputs)
{
    /* Infinities and NaN less themselves are NaN, all other numbers 0. */
    real lost = 0.0;
    for (int j = 0; j < ARM50_STAGES; ++j) {
        lost += (inputs->base_angle[j] - inputs->base_angle[j])
            + (inputs->base_angle_rate[j] - inputs->base_angle_rate[j])
            + (inputs->base_angle_acceleration[j] - inputs->base_angle_acceleration[j]);
    }
    if (!(lost >= 0.0)) {
        return 0;
    }
    return 1;
}

void arm50_default_params(arm50_params *params)
{
    static const real stiffness[] = {
        31250.0, 15625.0, 15625.0, 15625.0, 15625.0, 15625.0, 15625.0, 15625.0, 15625.0, 15625.0, 15625.0,
        15625.0, 15625.0, 15625.0, 15625.0, 15625.0, 15625.0, 15625.0, 15625.0, 15625.0, 15625.0, 15625.0,
        15625.0, 15625.0, 15625.0, 15625.0, 15625.0, 15625.0, 15625.0, 15625.0, 15625.0, 15625.0, 15625.0,
        15625.0, 15625.0, 15625.0, 15625.0, 15625.0, 15625.0, 15625.0, 15625.0, 15625.0, 15625.0, 15625.0,
        15625.0, 15625.0, 15625.0, 15625.0, 15625.0, 15625.0
    };
    static const real damping[] = {
        3.125, 1.5625, 1.5625, 1.5625, 1.5625, 1.5625, 1.5625, 1.5625, 1.5625, 1.5625, 1.5625, 1.5625, 1.5625,
        1.5625, 1.5625, 1.5625, 1.5625, 1.5625, 1.5625, 1.5625, 1.5625, 1.5625, 1.5625, 1.5625, 1.5625,
        1.5625, 1.5625, 1.5625, 1.5625, 1.5625, 1.5625, 1.5625, 1.5625, 1.5625, 1.5625, 1.5625, 1.5625,
        1.5625, 1.5625, 1.5625, 1.5625, 1.5625, 1.5625, 1.5625, 1.5625, 1.5625, 1.5625, 1.5625, 1.5625, 1.5625
    };
    if (params == NULL) {
        return;
    }
    params->length = 0.016;
    params->mass = 0.0304;
    params->inertia = 6.485333333333333e-07;
    params->center = 0.5;
    for (int j = 0; j < ARM50_STATIONS; ++j) {
        params->stiffness[j] = stiffness[j];
    }
    for (int j = 0; j < ARM50_STATIONS; ++j) {
        params->damping[j] = damping[j];
    }
    params->tip_mass = 0.5;
    params->tip_inertia = 0.0004;
}

arm50_status arm50_prepare(
    arm50_model *model,
    const arm50_params *params,
    arm50_real step)
{
    if (model == NULL || params == NULL) {
        return ARM50_NULL_POINTER;
    }
    if (!(step > 0.0) || !(step <= DBL_MAX)) {
        return ARM50_INVALID_STEP;
    }
    /* Infinities and NaN less themselves are NaN, all other numbers 0. */
    real lost = (params->length - params->length) + (params->mass - params->mass)
        + (params->inertia - params->inertia) + (params->center - params->center)
        + (params->tip_mass - params->tip_mass) + (params->tip_inertia - params->tip_inertia);
    for (int j = 0; j < ARM50_STATIONS; ++j) {
        lost += (params->stiffness[j] - params->stiffness[j]) + (params->damping[j] - params->damping[j]);
    }
    if (!(lost >= 0.0)) {
        return ARM50_NON_FINITE_INPUT;
    }

    /* Masses at the nodes between links, and what they leave over. */
    model->end_mass = params->tip_mass - params->mass * (1.0 - params->center);
    model->rod_inertia = params->inertia
        - params->center * (params->length * params->length) * params->mass * (1.0 - params->center);

    /* Factors of the sweep that do not change from step to step. */
    for (int j = ARM50_STATIONS - 1; j >= 0; --j) {
        model->joint_impedance[j] = 0.25 * params->damping[j] * step
            + 0.0625 * (step * step) * params->stiffness[j];
    }

    /* Factors of the step that depend on the time step and parameters alone. */
    model->rate_per_acceleration = 0.25 * step;
    model->half_timestep = 0.5 * step;
    model->angle_per_acceleration = 0.0625 * (step * step);
    model->three_quarters_timestep = 0.75 * step;
    model->predicted_rate_per_stage1_acceleration = (17.0 / 50.0) * step;
    model->predicted_rate_per_stage2_acceleration = (21.0 / 100.0) * step;
    model->predicted_angle_per_stage2_rate = (1.0 / 25.0) * step;
    model->predicted_rate_per_stage1_acceleration_2 = (371.0 / 1360.0) * step;
    model->predicted_rate_per_stage2_acceleration_2 = (137.0 / 2720.0) * step;
    model->predicted_rate_per_stage3_acceleration = (151.0 / 544.0) * step;
    model->predicted_angle_per_stage3_rate = (15.0 / 544.0) * step;
    model->predicted_rate_per_stage1_acceleration_3 = (25.0 / 24.0) * step;
    model->predicted_rate_per_stage2_acceleration_3 = (49.0 / 48.0) * step;
    model->predicted_rate_per_stage3_acceleration_2 = 7.8125 * step;
    model->predicted_rate_per_stage4_acceleration = (41.0 / 6.0) * step;
    model->predicted_angle_per_stage4_rate = (85.0 / 12.0) * step;
    model->reaction_x_per_acceleration_x = params->center * params->mass;
    model->reaction_x_per_acceleration_x_2 = params->mass * (params->center - 1.0);

    /* What the step needs as it is. */
    model->length = params->length;
    model->mass = params->mass;
    for (int j = 0; j < ARM50_STATIONS; ++j) {
        model->stiffness[j] = params->stiffness[j];
    }
    for (int j = 0; j < ARM50_STATIONS; ++j) {
        model->damping[j] = params->damping[j];
    }
    model->tip_mass = params->tip_mass;
    model->tip_inertia = params->tip_inertia;

    real total = 0.0; /* of the model: is all of it finite? */
    for (int j = 0; j < ARM50_STATIONS; ++j) {
        total += model->joint_impedance[j];
    }
    if (!isfinite(model->rate_per_acceleration + model->half_timestep + model->angle_per_acceleration
        + model->three_quarters_timestep + model->predicted_rate_per_stage1_acceleration
        + model->predicted_rate_per_stage2_acceleration + model->predicted_angle_per_stage2_rate
        + model->predicted_rate_per_stage1_acceleration_2 + model->predicted_rate_per_stage2_acceleration_2
        + model->predicted_rate_per_stage3_acceleration + model->predicted_angle_per_stage3_rate
        + model->predicted_rate_per_stage1_acceleration_3 + model->predicted_rate_per_stage2_acceleration_3
        + model->predicted_rate_per_stage3_acceleration_2 + model->predicted_rate_per_stage4_acceleration
        + model->predicted_angle_per_stage4_rate + model->reaction_x_per_acceleration_x
        + model->reaction_x_per_acceleration_x_2 + model->end_mass + model->rod_inertia + total)) {
        return ARM50_NON_FINITE_MODEL;
    }
    return ARM50_OK;
}

arm50_status arm50_initialise(
    arm50_state *state,
    const arm50_params *params,
    const arm50_real initial_angle[ARM50_STATIONS],
    const arm50_real initial_rate[ARM50_STATIONS],
    const arm50_inputs *inputs)
{
    if (state == NULL || params == NULL || inputs == NULL) {
        return ARM50_NULL_POINTER;
    }
    if (!inputs_are_finite(inputs)) {
        return ARM50_NON_FINITE_INPUT;
    }
    for (int j = 0; j < ARM50_STATIONS; ++j) {
        if ((initial_angle != NULL && !isfinite(initial_angle[j]))
            || (initial_rate != NULL && !isfinite(initial_rate[j]))) {
            return ARM50_NON_FINITE_INPUT;
        }
    }

    const real length = params->length;
    const real mass = params->mass;
    real acceleration_x[ARM50_STATIONS + 1]; /* acceleration of the nodes along x [m/s^2] */
    real acceleration_y[ARM50_STATIONS + 1]; /* acceleration of the nodes along y [m/s^2] */
    real answer_own[ARM50_STATIONS]; /* unknown of a station if its inner side kept its motion */
    real answer_x[ARM50_STATIONS]; /* answer of the unknown to the joint's acceleration along x */
    real answer_y[ARM50_STATIONS]; /* answer of the unknown to the joint's acceleration along y */
    real lever_cosine[ARM50_STATIONS]; /* length times cosine of the angle [m] */
    real lever_sine[ARM50_STATIONS]; /* length times sine of the angle [m] */
    /* acceleration of base and links as predicted [rad/s^2] */
    real predicted_acceleration[ARM50_STATIONS + 1];
    real predicted_angle[ARM50_STATIONS + 1]; /* angle of base and links as predicted [rad] */
    real predicted_rate[ARM50_STATIONS + 1]; /* rate of base and links as predicted [rad/s] */
    real total = 0.0; /* of the new motion: is all of it finite? */

    /* Masses at the nodes between links, and what they leave over. */
    const real start_end_mass = params->tip_mass - mass * (1.0 - params->center);
    const real start_rod_inertia = params->inertia
        - params->center * (length * length) * mass * (1.0 - params->center);

    /* Predicted motion. */
    predicted_rate[0] = inputs->base_angle_rate[0];
    predicted_angle[0] = inputs->base_angle[0];
    predicted_acceleration[0] = inputs->base_angle_acceleration[0];

    /* Predicted motion; accelerations of the nodes. */
    real node_x = 0.0;
    real node_y = 0.0;
    acceleration_x[0] = node_x;
    acceleration_y[0] = node_y;
    for (int j = 0; j < ARM50_STATIONS; ++j) {
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
    real impedance_uu = params->tip_inertia;
    real force_x = acceleration_x[50] * start_end_mass;
    real force_y = acceleration_y[50] * start_end_mass;
    real torque = predicted_acceleration[50] * params->tip_inertia;
    for (int j = ARM50_STATIONS - 1; j >= 0; --j) {
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
        impedance_uu = impedance_uu + start_rod_inertia - impedance_xu * lever_sine[j]
            + impedance_yu * lever_cosine[j];
        torque = torque - force_x * lever_sine[j] + force_y * lever_cosine[j]
            + predicted_acceleration[j + 1] * start_rod_inertia;
        if (!(impedance_uu > 0.0) || !(impedance_uu <= DBL_MAX)) {
            return ARM50_VANISHING_PIVOT;
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
        impedance_uu = 0.0;
    }

    /* The base. */
    real unknown = 0.0;

    /* Sweep outward: the unknown of each station. */
    real change_x = 0.0;
    real change_y = 0.0;

    /* Sweep outward: the unknown of each station; motion at the end of the step. */
    state->hub_angle = inputs->base_angle[0];
    state->hub_rate = inputs->base_angle_rate[0];
    for (int j = 0; j < ARM50_STATIONS; ++j) {
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y;
        change_x = change_x - lever_sine[j] * unknown;
        change_y = change_y + lever_cosine[j] * unknown;
        state->angle[j] = predicted_angle[j + 1];
        state->rate[j] = predicted_rate[j + 1];
        state->acceleration[j] = predicted_acceleration[j + 1] + unknown;
        total += state->angle[j] + state->rate[j] + state->acceleration[j];
    }

    if (!isfinite(total + state->hub_angle + state->hub_rate)) {
        return ARM50_NON_FINITE_STATE;
    }
    return ARM50_OK;
}

arm50_status arm50_step(
    const arm50_model *model,
    arm50_state *state,
    const arm50_inputs *inputs)
{
    if (model == NULL || state == NULL || inputs == NULL) {
        return ARM50_NULL_POINTER;
    }
    if (!inputs_are_finite(inputs)) {
        return ARM50_NON_FINITE_INPUT;
    }

    const real length = model->length;
    const real mass = model->mass;
    const real rate_per_acceleration = model->rate_per_acceleration;
    const real half_timestep = model->half_timestep;
    const real angle_per_acceleration = model->angle_per_acceleration;
    const real three_quarters_timestep = model->three_quarters_timestep;
    const real predicted_rate_per_stage1_acceleration = model->predicted_rate_per_stage1_acceleration;
    const real predicted_rate_per_stage2_acceleration = model->predicted_rate_per_stage2_acceleration;
    const real predicted_angle_per_stage2_rate = model->predicted_angle_per_stage2_rate;
    const real predicted_rate_per_stage1_acceleration_2 = model->predicted_rate_per_stage1_acceleration_2;
    const real predicted_rate_per_stage2_acceleration_2 = model->predicted_rate_per_stage2_acceleration_2;
    const real predicted_rate_per_stage3_acceleration = model->predicted_rate_per_stage3_acceleration;
    const real predicted_angle_per_stage3_rate = model->predicted_angle_per_stage3_rate;
    const real predicted_rate_per_stage1_acceleration_3 = model->predicted_rate_per_stage1_acceleration_3;
    const real predicted_rate_per_stage2_acceleration_3 = model->predicted_rate_per_stage2_acceleration_3;
    const real predicted_rate_per_stage3_acceleration_2 = model->predicted_rate_per_stage3_acceleration_2;
    const real predicted_rate_per_stage4_acceleration = model->predicted_rate_per_stage4_acceleration;
    const real predicted_angle_per_stage4_rate = model->predicted_angle_per_stage4_rate;
    const real rod_inertia = model->rod_inertia;
    real acceleration_x[ARM50_STATIONS + 1]; /* acceleration of the nodes along x [m/s^2] */
    real acceleration_y[ARM50_STATIONS + 1]; /* acceleration of the nodes along y [m/s^2] */
    real answer_own[ARM50_STATIONS]; /* unknown of a station if its inner side kept its motion */
    real answer_x[ARM50_STATIONS]; /* answer of the unknown to the joint's acceleration along x */
    real answer_y[ARM50_STATIONS]; /* answer of the unknown to the joint's acceleration along y */
    real lever_cosine[ARM50_STATIONS]; /* length times cosine of the angle [m] */
    real lever_sine[ARM50_STATIONS]; /* length times sine of the angle [m] */
    real predicted_angle[ARM50_STATIONS + 1]; /* angle of base and links as predicted [rad] */
    real predicted_rate[ARM50_STATIONS + 1]; /* rate of base and links as predicted [rad/s] */
    real stage1_acceleration[ARM50_STATIONS]; /* acceleration at stage 1 [rad/s^2] */
    real stage1_rate[ARM50_STATIONS]; /* rate at stage 1 [rad/s] */
    real stage2_acceleration[ARM50_STATIONS]; /* acceleration at stage 2 [rad/s^2] */
    real stage2_rate[ARM50_STATIONS]; /* rate at stage 2 [rad/s] */
    real stage3_acceleration[ARM50_STATIONS]; /* acceleration at stage 3 [rad/s^2] */
    real stage3_rate[ARM50_STATIONS]; /* rate at stage 3 [rad/s] */
    real stage4_acceleration[ARM50_STATIONS]; /* acceleration at stage 4 [rad/s^2] */
    real swing_x[ARM50_STATIONS]; /* change of the outer end's acceleration along x per unknown [m] */
    real swing_y[ARM50_STATIONS]; /* change of the outer end's acceleration along y per unknown [m] */
    real transmission[ARM50_STATIONS]; /* share of motion and torque each joint passes on */
    real total = 0.0; /* of the new motion: is all of it finite? */

    /* Stage 1 of 5: predicted motion. */
    predicted_rate[0] = inputs->base_angle_rate[0];
    predicted_angle[0] = inputs->base_angle[0];

    /* Stage 1 of 5: predicted motion; accelerations of the nodes. */
    real node_x = 0.0;
    real node_y = 0.0;
    acceleration_x[0] = node_x;
    acceleration_y[0] = node_y;
    for (int j = 0; j < ARM50_STATIONS; ++j) {
        predicted_rate[j + 1] = state->rate[j] + state->acceleration[j] * rate_per_acceleration;
        predicted_angle[j + 1] = state->angle[j] + predicted_rate[j + 1] * rate_per_acceleration;
        lever_cosine[j] = length * cos(predicted_angle[j + 1]);
        lever_sine[j] = length * sin(predicted_angle[j + 1]);
        const real square = predicted_rate[j + 1] * predicted_rate[j + 1];
        const real relative_x = -state->acceleration[j] * lever_sine[j] - lever_cosine[j] * square;
        const real relative_y = state->acceleration[j] * lever_cosine[j] - lever_sine[j] * square;
        const real turning = half_timestep * predicted_rate[j + 1];
        swing_x[j] = -lever_sine[j] - angle_per_acceleration * relative_y - lever_cosine[j] * turning;
        swing_y[j] = lever_cosine[j] + angle_per_acceleration * relative_x - lever_sine[j] * turning;
        node_x = node_x + relative_x;
        node_y = node_y + relative_y;
        acceleration_x[j + 1] = node_x;
        acceleration_y[j + 1] = node_y;
    }

    /* Stage 1 of 5: forces of the joints at the motion so far; sweep inward: force beyond each joint as an
     * affine function of the motion at it. */
    real impedance_xx = model->end_mass;
    real impedance_xy = 0.0;
    real impedance_xu = 0.0;
    real impedance_yx = 0.0;
    real impedance_yy = model->end_mass;
    real impedance_yu = 0.0;
    real impedance_ux = 0.0;
    real impedance_uy = 0.0;
    real impedance_uu = model->tip_inertia;
    real force_x = acceleration_x[50] * model->end_mass;
    real force_y = acceleration_y[50] * model->end_mass;
    real torque = state->acceleration[49] * model->tip_inertia;
    for (int j = ARM50_STATIONS - 1; j >= 0; --j) {
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
            return ARM50_VANISHING_PIVOT;
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

    /* Stage 1 of 5: the base. */
    real unknown = 0.0;

    /* Stage 1 of 5: sweep outward: the unknown of each station. */
    real change_x = 0.0;
    real change_y = 0.0;

    /* Stage 2 of 5: predicted motion. */
    predicted_rate[0] = inputs->base_angle_rate[1];
    predicted_angle[0] = inputs->base_angle[1];

    /* Stage 1 of 5: sweep outward: the unknown of each station; motion at this stage. Stage 2 of 5: predicted
     * motion; accelerations of the nodes. */
    node_x = 0.0;
    node_y = 0.0;
    acceleration_x[0] = node_x;
    acceleration_y[0] = node_y;
    for (int j = 0; j < ARM50_STATIONS; ++j) {
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y + transmission[j] * unknown;
        change_x = change_x + swing_x[j] * unknown;
        change_y = change_y + swing_y[j] * unknown;
        stage1_acceleration[j] = state->acceleration[j] + unknown;
        stage1_rate[j] = predicted_rate[j + 1] + rate_per_acceleration * unknown;
        predicted_rate[j + 1] = state->rate[j] + stage1_acceleration[j] * three_quarters_timestep;
        predicted_angle[j + 1] = state->angle[j] + half_timestep * stage1_rate[j]
            + predicted_rate[j + 1] * rate_per_acceleration;
        lever_cosine[j] = length * cos(predicted_angle[j + 1]);
        lever_sine[j] = length * sin(predicted_angle[j + 1]);
        const real square = predicted_rate[j + 1] * predicted_rate[j + 1];
        const real relative_x = -lever_cosine[j] * square - lever_sine[j] * stage1_acceleration[j];
        const real relative_y = lever_cosine[j] * stage1_acceleration[j] - lever_sine[j] * square;
        const real turning = half_timestep * predicted_rate[j + 1];
        swing_x[j] = -lever_sine[j] - angle_per_acceleration * relative_y - lever_cosine[j] * turning;
        swing_y[j] = lever_cosine[j] + angle_per_acceleration * relative_x - lever_sine[j] * turning;
        node_x = node_x + relative_x;
        node_y = node_y + relative_y;
        acceleration_x[j + 1] = node_x;
        acceleration_y[j + 1] = node_y;
    }

    /* Stage 2 of 5: forces of the joints at the motion so far; sweep inward: force beyond each joint as an
     * affine function of the motion at it. */
    impedance_xx = model->end_mass;
    impedance_xy = 0.0;
    impedance_xu = 0.0;
    impedance_yx = 0.0;
    impedance_yy = model->end_mass;
    impedance_yu = 0.0;
    impedance_ux = 0.0;
    impedance_uy = 0.0;
    impedance_uu = model->tip_inertia;
    force_x = acceleration_x[50] * model->end_mass;
    force_y = acceleration_y[50] * model->end_mass;
    torque = stage1_acceleration[49] * model->tip_inertia;
    for (int j = ARM50_STATIONS - 1; j >= 0; --j) {
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
        torque = torque - force_x * lever_sine[j] + force_y * lever_cosine[j]
            + rod_inertia * stage1_acceleration[j];
        const real pivot = impedance_uu + model->joint_impedance[j];
        if (!(pivot > 0.0) || !(pivot <= DBL_MAX)) {
            return ARM50_VANISHING_PIVOT;
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

    /* Stage 2 of 5: the base. */
    unknown = 0.0;

    /* Stage 2 of 5: sweep outward: the unknown of each station. */
    change_x = 0.0;
    change_y = 0.0;

    /* Stage 3 of 5: predicted motion. */
    predicted_rate[0] = inputs->base_angle_rate[2];
    predicted_angle[0] = inputs->base_angle[2];

    /* Stage 2 of 5: sweep outward: the unknown of each station; motion at this stage. Stage 3 of 5: predicted
     * motion; accelerations of the nodes. */
    node_x = 0.0;
    node_y = 0.0;
    acceleration_x[0] = node_x;
    acceleration_y[0] = node_y;
    for (int j = 0; j < ARM50_STATIONS; ++j) {
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y + transmission[j] * unknown;
        change_x = change_x + swing_x[j] * unknown;
        change_y = change_y + swing_y[j] * unknown;
        const real solved = unknown;
        stage2_acceleration[j] = solved + stage1_acceleration[j];
        stage2_rate[j] = predicted_rate[j + 1] + rate_per_acceleration * unknown;
        predicted_rate[j + 1] = state->rate[j]
            + predicted_rate_per_stage1_acceleration * stage1_acceleration[j]
            + predicted_rate_per_stage2_acceleration * stage2_acceleration[j];
        predicted_angle[j + 1] = state->angle[j] - predicted_angle_per_stage2_rate * stage2_rate[j]
            + predicted_rate[j + 1] * rate_per_acceleration
            + predicted_rate_per_stage1_acceleration * stage1_rate[j];
        lever_cosine[j] = length * cos(predicted_angle[j + 1]);
        lever_sine[j] = length * sin(predicted_angle[j + 1]);
        const real square = predicted_rate[j + 1] * predicted_rate[j + 1];
        const real relative_x = -lever_cosine[j] * square - lever_sine[j] * stage2_acceleration[j];
        const real relative_y = lever_cosine[j] * stage2_acceleration[j] - lever_sine[j] * square;
        const real turning = half_timestep * predicted_rate[j + 1];
        swing_x[j] = -lever_sine[j] - angle_per_acceleration * relative_y - lever_cosine[j] * turning;
        swing_y[j] = lever_cosine[j] + angle_per_acceleration * relative_x - lever_sine[j] * turning;
        node_x = node_x + relative_x;
        node_y = node_y + relative_y;
        acceleration_x[j + 1] = node_x;
        acceleration_y[j + 1] = node_y;
    }

    /* Stage 3 of 5: forces of the joints at the motion so far; sweep inward: force beyond each joint as an
     * affine function of the motion at it. */
    impedance_xx = model->end_mass;
    impedance_xy = 0.0;
    impedance_xu = 0.0;
    impedance_yx = 0.0;
    impedance_yy = model->end_mass;
    impedance_yu = 0.0;
    impedance_ux = 0.0;
    impedance_uy = 0.0;
    impedance_uu = model->tip_inertia;
    force_x = acceleration_x[50] * model->end_mass;
    force_y = acceleration_y[50] * model->end_mass;
    torque = stage2_acceleration[49] * model->tip_inertia;
    for (int j = ARM50_STATIONS - 1; j >= 0; --j) {
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
        torque = torque - force_x * lever_sine[j] + force_y * lever_cosine[j]
            + rod_inertia * stage2_acceleration[j];
        const real pivot = impedance_uu + model->joint_impedance[j];
        if (!(pivot > 0.0) || !(pivot <= DBL_MAX)) {
            return ARM50_VANISHING_PIVOT;
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

    /* Stage 3 of 5: the base. */
    unknown = 0.0;

    /* Stage 3 of 5: sweep outward: the unknown of each station. */
    change_x = 0.0;
    change_y = 0.0;

    /* Stage 4 of 5: predicted motion. */
    predicted_rate[0] = inputs->base_angle_rate[3];
    predicted_angle[0] = inputs->base_angle[3];

    /* Stage 3 of 5: sweep outward: the unknown of each station; motion at this stage. Stage 4 of 5: predicted
     * motion; accelerations of the nodes. */
    node_x = 0.0;
    node_y = 0.0;
    acceleration_x[0] = node_x;
    acceleration_y[0] = node_y;
    for (int j = 0; j < ARM50_STATIONS; ++j) {
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y + transmission[j] * unknown;
        change_x = change_x + swing_x[j] * unknown;
        change_y = change_y + swing_y[j] * unknown;
        const real solved = unknown;
        stage3_acceleration[j] = solved + stage2_acceleration[j];
        stage3_rate[j] = predicted_rate[j + 1] + rate_per_acceleration * unknown;
        predicted_rate[j + 1] = state->rate[j]
            + predicted_rate_per_stage1_acceleration_2 * stage1_acceleration[j]
            - predicted_rate_per_stage2_acceleration_2 * stage2_acceleration[j]
            + predicted_rate_per_stage3_acceleration * stage3_acceleration[j];
        predicted_angle[j + 1] = state->angle[j] + predicted_angle_per_stage3_rate * stage3_rate[j]
            + predicted_rate[j + 1] * rate_per_acceleration
            + predicted_rate_per_stage1_acceleration_2 * stage1_rate[j]
            - predicted_rate_per_stage2_acceleration_2 * stage2_rate[j];
        lever_cosine[j] = length * cos(predicted_angle[j + 1]);
        lever_sine[j] = length * sin(predicted_angle[j + 1]);
        const real square = predicted_rate[j + 1] * predicted_rate[j + 1];
        const real relative_x = -lever_cosine[j] * square - lever_sine[j] * stage3_acceleration[j];
        const real relative_y = lever_cosine[j] * stage3_acceleration[j] - lever_sine[j] * square;
        const real turning = half_timestep * predicted_rate[j + 1];
        swing_x[j] = -lever_sine[j] - angle_per_acceleration * relative_y - lever_cosine[j] * turning;
        swing_y[j] = lever_cosine[j] + angle_per_acceleration * relative_x - lever_sine[j] * turning;
        node_x = node_x + relative_x;
        node_y = node_y + relative_y;
        acceleration_x[j + 1] = node_x;
        acceleration_y[j + 1] = node_y;
    }

    /* Stage 4 of 5: forces of the joints at the motion so far; sweep inward: force beyond each joint as an
     * affine function of the motion at it. */
    impedance_xx = model->end_mass;
    impedance_xy = 0.0;
    impedance_xu = 0.0;
    impedance_yx = 0.0;
    impedance_yy = model->end_mass;
    impedance_yu = 0.0;
    impedance_ux = 0.0;
    impedance_uy = 0.0;
    impedance_uu = model->tip_inertia;
    force_x = acceleration_x[50] * model->end_mass;
    force_y = acceleration_y[50] * model->end_mass;
    torque = stage3_acceleration[49] * model->tip_inertia;
    for (int j = ARM50_STATIONS - 1; j >= 0; --j) {
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
        torque = torque - force_x * lever_sine[j] + force_y * lever_cosine[j]
            + rod_inertia * stage3_acceleration[j];
        const real pivot = impedance_uu + model->joint_impedance[j];
        if (!(pivot > 0.0) || !(pivot <= DBL_MAX)) {
            return ARM50_VANISHING_PIVOT;
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

    /* Stage 4 of 5: the base. */
    unknown = 0.0;

    /* Stage 4 of 5: sweep outward: the unknown of each station. */
    change_x = 0.0;
    change_y = 0.0;

    /* Stage 5 of 5: predicted motion. */
    predicted_rate[0] = inputs->base_angle_rate[4];
    predicted_angle[0] = inputs->base_angle[4];

    /* Stage 4 of 5: sweep outward: the unknown of each station; motion at this stage. Stage 5 of 5: predicted
     * motion; accelerations of the nodes. */
    node_x = 0.0;
    node_y = 0.0;
    acceleration_x[0] = node_x;
    acceleration_y[0] = node_y;
    for (int j = 0; j < ARM50_STATIONS; ++j) {
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y + transmission[j] * unknown;
        change_x = change_x + swing_x[j] * unknown;
        change_y = change_y + swing_y[j] * unknown;
        const real solved = unknown;
        stage4_acceleration[j] = solved + stage3_acceleration[j];
        const real stage4_rate = predicted_rate[j + 1] + rate_per_acceleration * unknown;
        predicted_rate[j + 1] = state->rate[j]
            + predicted_rate_per_stage1_acceleration_3 * stage1_acceleration[j]
            - predicted_rate_per_stage2_acceleration_3 * stage2_acceleration[j]
            + predicted_rate_per_stage3_acceleration_2 * stage3_acceleration[j]
            - predicted_rate_per_stage4_acceleration * stage4_acceleration[j];
        predicted_angle[j + 1] = state->angle[j] - predicted_angle_per_stage4_rate * stage4_rate
            + predicted_rate[j + 1] * rate_per_acceleration
            + predicted_rate_per_stage1_acceleration_3 * stage1_rate[j]
            - predicted_rate_per_stage2_acceleration_3 * stage2_rate[j]
            + predicted_rate_per_stage3_acceleration_2 * stage3_rate[j];
        lever_cosine[j] = length * cos(predicted_angle[j + 1]);
        lever_sine[j] = length * sin(predicted_angle[j + 1]);
        const real square = predicted_rate[j + 1] * predicted_rate[j + 1];
        const real relative_x = -lever_cosine[j] * square - lever_sine[j] * stage4_acceleration[j];
        const real relative_y = lever_cosine[j] * stage4_acceleration[j] - lever_sine[j] * square;
        const real turning = half_timestep * predicted_rate[j + 1];
        swing_x[j] = -lever_sine[j] - angle_per_acceleration * relative_y - lever_cosine[j] * turning;
        swing_y[j] = lever_cosine[j] + angle_per_acceleration * relative_x - lever_sine[j] * turning;
        node_x = node_x + relative_x;
        node_y = node_y + relative_y;
        acceleration_x[j + 1] = node_x;
        acceleration_y[j + 1] = node_y;
    }

    /* Stage 5 of 5: forces of the joints at the motion so far; sweep inward: force beyond each joint as an
     * affine function of the motion at it. */
    impedance_xx = model->end_mass;
    impedance_xy = 0.0;
    impedance_xu = 0.0;
    impedance_yx = 0.0;
    impedance_yy = model->end_mass;
    impedance_yu = 0.0;
    impedance_ux = 0.0;
    impedance_uy = 0.0;
    impedance_uu = model->tip_inertia;
    force_x = acceleration_x[50] * model->end_mass;
    force_y = acceleration_y[50] * model->end_mass;
    torque = stage4_acceleration[49] * model->tip_inertia;
    for (int j = ARM50_STATIONS - 1; j >= 0; --j) {
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
        torque = torque - force_x * lever_sine[j] + force_y * lever_cosine[j]
            + rod_inertia * stage4_acceleration[j];
        const real pivot = impedance_uu + model->joint_impedance[j];
        if (!(pivot > 0.0) || !(pivot <= DBL_MAX)) {
            return ARM50_VANISHING_PIVOT;
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

    /* Stage 5 of 5: the base. */
    unknown = 0.0;

    /* Stage 5 of 5: sweep outward: the unknown of each station. */
    change_x = 0.0;
    change_y = 0.0;

    /* Stage 5 of 5: sweep outward: the unknown of each station; motion at the end of the step. */
    state->hub_angle = inputs->base_angle[4];
    state->hub_rate = inputs->base_angle_rate[4];
    for (int j = 0; j < ARM50_STATIONS; ++j) {
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y + transmission[j] * unknown;
        change_x = change_x + swing_x[j] * unknown;
        change_y = change_y + swing_y[j] * unknown;
        const real solved = unknown;
        state->angle[j] = predicted_angle[j + 1] + angle_per_acceleration * unknown;
        state->rate[j] = predicted_rate[j + 1] + rate_per_acceleration * unknown;
        state->acceleration[j] = solved + stage4_acceleration[j];
        total += state->angle[j] + state->rate[j] + state->acceleration[j];
    }

    if (!isfinite(total + state->hub_angle + state->hub_rate)) {
        return ARM50_NON_FINITE_STATE;
    }
    return ARM50_OK;
}

void arm50_output(
    const arm50_model *model,
    const arm50_state *state,
    arm50_outputs *outputs)
{
    if (model == NULL || state == NULL || outputs == NULL) {
        return;
    }
    const real length = model->length;
    const real reaction_x_per_acceleration_x = model->reaction_x_per_acceleration_x;
    const real reaction_x_per_acceleration_x_2 = model->reaction_x_per_acceleration_x_2;
    real acceleration_x[ARM50_STATIONS + 1]; /* acceleration of the nodes along x [m/s^2] */
    real acceleration_y[ARM50_STATIONS + 1]; /* acceleration of the nodes along y [m/s^2] */

    /* Output tip: position. */
    outputs->tip_x = 0.0;
    outputs->tip_y = 0.0;

    /* Output tip_angle: angle. */
    outputs->tip_angle = state->angle[49];

    /* Output tip: position; output reaction: force. */
    real a_x = 0.0;
    real a_y = 0.0;
    acceleration_x[0] = a_x;
    acceleration_y[0] = a_y;
    for (int j = 0; j < ARM50_STATIONS; ++j) {
        outputs->tip_x = outputs->tip_x + length * cos(state->angle[j]);
        outputs->tip_y = outputs->tip_y + length * sin(state->angle[j]);
        a_x = a_x - state->acceleration[j] * length * sin(state->angle[j])
            - length * (state->rate[j] * state->rate[j]) * cos(state->angle[j]);
        a_y = a_y + state->acceleration[j] * length * cos(state->angle[j])
            - length * (state->rate[j] * state->rate[j]) * sin(state->angle[j]);
        acceleration_x[j + 1] = a_x;
        acceleration_y[j + 1] = a_y;
    }
    outputs->reaction_x = acceleration_x[50] * model->tip_mass;
    outputs->reaction_y = acceleration_y[50] * model->tip_mass;
    for (int j = ARM50_STATIONS - 1; j >= 0; --j) {
        outputs->reaction_x = outputs->reaction_x + acceleration_x[j + 1] * reaction_x_per_acceleration_x;
        outputs->reaction_y = outputs->reaction_y + acceleration_y[j + 1] * reaction_x_per_acceleration_x;
        outputs->reaction_x = outputs->reaction_x - acceleration_x[j] * reaction_x_per_acceleration_x_2;
        outputs->reaction_y = outputs->reaction_y - acceleration_y[j] * reaction_x_per_acceleration_x_2;
    }

    /* Output drive: torque. */
    outputs->drive = model->damping[0] * (state->rate[0] - state->hub_rate)
        + model->stiffness[0] * (state->angle[0] - state->hub_angle);
}

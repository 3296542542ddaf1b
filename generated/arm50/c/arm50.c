/**
 * arm50: Stiff arm of fifty links on a servo
 *
 * Written by tmm-gen 0.1.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: 7e2e87b8a48332cf3886a22711bd9428eeea692a0d70cc5ae1662962d37ffc57
 * sha256 of the rest of this file: 5624c666a48ceb43f22d39715b015f77d62980ee59d4ecad2942cdf69877072a
 *
 * model: planar arm, large rotations, tip mass
 * stations: 50
 * base: prescribed
 * integrator: SDIRK, order 4, 5 stages (Hairer & Wanner 1996)
 * linearisation: newton
 * sweep: riccati
 * unknown: acceleration
 * operations of a step: 35065, 701.3 per station (16150 additions, 18165 multiplications, 250 divisions, 500
 *     functions)
 * operations of prepare: 348, 6.96 per station (53 additions, 295 multiplications)
 * number type: double
 * bytes of the structs: params 848, model 1480, state 1216, inputs 120, outputs 48
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
    if (!(step > 0.0) || !(step <= 1.7976931348623157e+308)) {
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

    /* Masses by the ends they act at, and joint impedances. */
    model->carried_mass = params->center * params->mass;
    model->inner_mass = params->mass - params->center * params->mass;
    model->pin_inertia = params->inertia
        + params->center * params->center * (params->length * params->length) * params->mass;
    for (int j = 0; j < ARM50_STATIONS; ++j) {
        model->joint_impedance[j] = 0.25 * params->damping[j] * step
            + 0.0625 * (step * step) * params->stiffness[j];
    }

    /* Factors of the step that depend on the time step and parameters alone. */
    model->angle_per_acceleration = 0.0625 * (step * step);
    model->rate_per_acceleration = 0.25 * step;
    model->step_1_over_2 = 0.5 * step;
    model->step2_3_over_16 = 0.1875 * (step * step);
    model->step_3_over_4 = 0.75 * step;
    model->step2_17_over_200 = (17.0 / 200.0) * (step * step);
    model->step_17_over_50 = (17.0 / 50.0) * step;
    model->step2_21_over_400 = (21.0 / 400.0) * (step * step);
    model->step_1_over_25 = (1.0 / 25.0) * step;
    model->step_21_over_100 = (21.0 / 100.0) * step;
    model->step2_371_over_5440 = (371.0 / 5440.0) * (step * step);
    model->step_371_over_1360 = (371.0 / 1360.0) * step;
    model->step2_137_over_10880 = (137.0 / 10880.0) * (step * step);
    model->step_137_over_2720 = (137.0 / 2720.0) * step;
    model->step2_151_over_2176 = (151.0 / 2176.0) * (step * step);
    model->step_15_over_544 = (15.0 / 544.0) * step;
    model->step_151_over_544 = (151.0 / 544.0) * step;
    model->step2_25_over_96 = (25.0 / 96.0) * (step * step);
    model->step_25_over_24 = (25.0 / 24.0) * step;
    model->step2_49_over_192 = (49.0 / 192.0) * (step * step);
    model->step_49_over_48 = (49.0 / 48.0) * step;
    model->step2_125_over_64 = 1.953125 * (step * step);
    model->step_125_over_16 = 7.8125 * step;
    model->step2_41_over_24 = (41.0 / 24.0) * (step * step);
    model->step_85_over_12 = (85.0 / 12.0) * step;
    model->step_41_over_6 = (41.0 / 6.0) * step;
    model->factor_27 = params->mass * (params->center - 1.0);
    model->factor_28 = params->center * params->mass;

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
    if (!isfinite(model->angle_per_acceleration + model->rate_per_acceleration + model->step_1_over_2
        + model->step2_3_over_16 + model->step_3_over_4 + model->step2_17_over_200 + model->step_17_over_50
        + model->step2_21_over_400 + model->step_1_over_25 + model->step_21_over_100
        + model->step2_371_over_5440 + model->step_371_over_1360 + model->step2_137_over_10880
        + model->step_137_over_2720 + model->step2_151_over_2176 + model->step_15_over_544
        + model->step_151_over_544 + model->step2_25_over_96 + model->step_25_over_24
        + model->step2_49_over_192 + model->step_49_over_48 + model->step2_125_over_64
        + model->step_125_over_16 + model->step2_41_over_24 + model->step_85_over_12 + model->step_41_over_6
        + model->factor_27 + model->factor_28 + model->carried_mass + model->inner_mass + model->pin_inertia
        + total)) {
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
    const real inertia = params->inertia;
    const real center = params->center;
    real acceleration_x[ARM50_STATIONS + 1]; /* acceleration of the nodes along x [m/s^2] */
    real acceleration_y[ARM50_STATIONS + 1]; /* acceleration of the nodes along y [m/s^2] */
    real answer_own[ARM50_STATIONS]; /* increment of the unknown if the inner side kept its motion */
    real answer_x[ARM50_STATIONS]; /* answer to the joint's acceleration along x */
    real answer_y[ARM50_STATIONS]; /* answer to the joint's acceleration along y */
    real lever_cosine[ARM50_STATIONS]; /* length times cosine of the predicted angle [m] */
    real lever_sine[ARM50_STATIONS]; /* length times sine of the predicted angle [m] */
    /* acceleration of base and links as predicted [rad/s^2] */
    real predicted_acceleration[ARM50_STATIONS + 1];
    real predicted_angle[ARM50_STATIONS + 1]; /* angle of base and links as predicted [rad] */
    real predicted_rate[ARM50_STATIONS + 1]; /* rate of base and links as predicted [rad/s] */
    real swing_x[ARM50_STATIONS]; /* change of the outer end's acceleration along x per unknown [m] */
    real swing_y[ARM50_STATIONS]; /* change of the outer end's acceleration along y per unknown [m] */
    real total = 0.0; /* of the new motion: is all of it finite? */

    /* Predicted motion. */
    predicted_angle[0] = inputs->base_angle[0];
    predicted_rate[0] = inputs->base_angle_rate[0];
    predicted_acceleration[0] = inputs->base_angle_acceleration[0];

    /* Predicted motion; accelerations of the nodes. */
    real node_x = 0.0;
    real node_y = 0.0;
    acceleration_x[0] = node_x;
    acceleration_y[0] = node_y;
    for (int j = 0; j < ARM50_STATIONS; ++j) {
        predicted_angle[j + 1] = (initial_angle != NULL ? initial_angle[j] : 0.0);
        predicted_rate[j + 1] = (initial_rate != NULL ? initial_rate[j] : 0.0);
        predicted_acceleration[j + 1] = 0.0;
        lever_sine[j] = length * sin(predicted_angle[j + 1]);
        lever_cosine[j] = length * cos(predicted_angle[j + 1]);
        const real square = predicted_rate[j + 1] * predicted_rate[j + 1];
        node_x = node_x - lever_cosine[j] * square - lever_sine[j] * predicted_acceleration[j + 1];
        node_y = node_y + lever_cosine[j] * predicted_acceleration[j + 1] - lever_sine[j] * square;
        acceleration_x[j + 1] = node_x;
        acceleration_y[j + 1] = node_y;
    }

    /* How each link's outer end answers to its unknown, and the predicted joint torques; sweep inward: force
     * beyond each joint as an affine function of the motion at it. */
    real impedance_xx = params->tip_mass;
    real impedance_xy = 0.0;
    real impedance_xu = 0.0;
    real impedance_yx = 0.0;
    real impedance_yy = params->tip_mass;
    real impedance_yu = 0.0;
    real impedance_ux = 0.0;
    real impedance_uy = 0.0;
    real impedance_uu = params->tip_inertia;
    real force_x = acceleration_x[50] * params->tip_mass;
    real force_y = acceleration_y[50] * params->tip_mass;
    real torque = predicted_acceleration[50] * params->tip_inertia;
    for (int j = ARM50_STATIONS - 1; j >= 0; --j) {
        swing_x[j] = -lever_sine[j];
        swing_y[j] = lever_cosine[j];
        const real joint_torque = params->damping[j] * (predicted_rate[j] - predicted_rate[j + 1])
            + params->stiffness[j] * (predicted_angle[j] - predicted_angle[j + 1]);
        const real outer_x = impedance_xu + impedance_xx * swing_x[j] + impedance_xy * swing_y[j];
        const real outer_y = impedance_yu + impedance_yx * swing_x[j] + impedance_yy * swing_y[j];
        const real outer_u = impedance_uu + impedance_ux * swing_x[j] + impedance_uy * swing_y[j];
        const real load_x = force_x + acceleration_x[j] * center * mass;
        const real load_y = force_y + acceleration_y[j] * center * mass;
        const real link_ux = impedance_ux + impedance_yx * lever_cosine[j]
            - lever_sine[j] * (impedance_xx + center * mass);
        const real link_uy = impedance_uy - impedance_xy * lever_sine[j]
            + lever_cosine[j] * (impedance_yy + center * mass);
        const real link_uu = inertia + outer_u + lever_cosine[j] * outer_y - lever_sine[j] * outer_x
            + center * center * (length * length) * mass;
        const real link_xx = impedance_xx + mass;
        const real link_xu = outer_x + center * mass * swing_x[j];
        const real link_yy = impedance_yy + mass;
        const real link_yu = outer_y + center * mass * swing_y[j];
        torque = torque + lever_cosine[j] * load_y - lever_sine[j] * load_x
            + predicted_acceleration[j + 1] * (inertia + center * center * (length * length) * mass);
        force_x = force_x + acceleration_x[j] * (mass - center * mass)
            + acceleration_x[j + 1] * center * mass;
        force_y = force_y + acceleration_y[j] * (mass - center * mass)
            + acceleration_y[j + 1] * center * mass;
        if (!(link_uu > 0.0) || !(link_uu <= DBL_MAX)) {
            return ARM50_VANISHING_PIVOT;
        }
        const real inverse_pivot = 1.0 / link_uu;
        answer_own[j] = inverse_pivot * (joint_torque - torque);
        answer_x[j] = inverse_pivot * link_ux;
        answer_y[j] = inverse_pivot * link_uy;
        impedance_xx = link_xx - answer_x[j] * link_xu;
        impedance_xy = impedance_xy - answer_y[j] * link_xu;
        impedance_xu = 0.0;
        force_x = force_x + answer_own[j] * link_xu;
        impedance_yx = impedance_yx - answer_x[j] * link_yu;
        impedance_yy = link_yy - answer_y[j] * link_yu;
        impedance_yu = 0.0;
        force_y = force_y + answer_own[j] * link_yu;
        impedance_ux = 0.0;
        impedance_uy = 0.0;
        impedance_uu = 0.0;
        torque = joint_torque;
    }

    /* The base moves as prescribed. */
    real unknown = 0.0;

    /* Sweep outward: the increment of each link's unknown. */
    real change_x = 0.0;
    real change_y = 0.0;

    /* Sweep outward: the increment of each link's unknown; motion at the end of the step. */
    state->hub_angle = inputs->base_angle[0];
    state->hub_rate = inputs->base_angle_rate[0];
    for (int j = 0; j < ARM50_STATIONS; ++j) {
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y;
        change_x = change_x + swing_x[j] * unknown;
        change_y = change_y + swing_y[j] * unknown;
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
    const real angle_per_acceleration = model->angle_per_acceleration;
    const real rate_per_acceleration = model->rate_per_acceleration;
    const real step_1_over_2 = model->step_1_over_2;
    const real step2_3_over_16 = model->step2_3_over_16;
    const real step_3_over_4 = model->step_3_over_4;
    const real step2_17_over_200 = model->step2_17_over_200;
    const real step_17_over_50 = model->step_17_over_50;
    const real step2_21_over_400 = model->step2_21_over_400;
    const real step_1_over_25 = model->step_1_over_25;
    const real step_21_over_100 = model->step_21_over_100;
    const real step2_371_over_5440 = model->step2_371_over_5440;
    const real step_371_over_1360 = model->step_371_over_1360;
    const real step2_137_over_10880 = model->step2_137_over_10880;
    const real step_137_over_2720 = model->step_137_over_2720;
    const real step2_151_over_2176 = model->step2_151_over_2176;
    const real step_15_over_544 = model->step_15_over_544;
    const real step_151_over_544 = model->step_151_over_544;
    const real step2_25_over_96 = model->step2_25_over_96;
    const real step_25_over_24 = model->step_25_over_24;
    const real step2_49_over_192 = model->step2_49_over_192;
    const real step_49_over_48 = model->step_49_over_48;
    const real step2_125_over_64 = model->step2_125_over_64;
    const real step_125_over_16 = model->step_125_over_16;
    const real step2_41_over_24 = model->step2_41_over_24;
    const real step_85_over_12 = model->step_85_over_12;
    const real step_41_over_6 = model->step_41_over_6;
    const real carried_mass = model->carried_mass;
    const real inner_mass = model->inner_mass;
    const real pin_inertia = model->pin_inertia;
    real acceleration_x[ARM50_STATIONS + 1]; /* acceleration of the nodes along x [m/s^2] */
    real acceleration_y[ARM50_STATIONS + 1]; /* acceleration of the nodes along y [m/s^2] */
    real answer_from_inner[ARM50_STATIONS]; /* answer to the inner link's unknown */
    real answer_own[ARM50_STATIONS]; /* increment of the unknown if the inner side kept its motion */
    real answer_x[ARM50_STATIONS]; /* answer to the joint's acceleration along x */
    real answer_y[ARM50_STATIONS]; /* answer to the joint's acceleration along y */
    real lever_cosine[ARM50_STATIONS]; /* length times cosine of the predicted angle [m] */
    real lever_sine[ARM50_STATIONS]; /* length times sine of the predicted angle [m] */
    /* acceleration of base and links as predicted [rad/s^2] */
    real predicted_acceleration[ARM50_STATIONS + 1];
    real predicted_angle[ARM50_STATIONS + 1]; /* angle of base and links as predicted [rad] */
    real predicted_rate[ARM50_STATIONS + 1]; /* rate of base and links as predicted [rad/s] */
    real stage1_acceleration[ARM50_STATIONS]; /* acceleration at stage 1 [rad/s^2] */
    real stage1_rate[ARM50_STATIONS]; /* rate at stage 1 [rad/s] */
    real stage2_acceleration[ARM50_STATIONS]; /* acceleration at stage 2 [rad/s^2] */
    real stage2_rate[ARM50_STATIONS]; /* rate at stage 2 [rad/s] */
    real stage3_acceleration[ARM50_STATIONS]; /* acceleration at stage 3 [rad/s^2] */
    real stage3_rate[ARM50_STATIONS]; /* rate at stage 3 [rad/s] */
    real swing_x[ARM50_STATIONS]; /* change of the outer end's acceleration along x per unknown [m] */
    real swing_y[ARM50_STATIONS]; /* change of the outer end's acceleration along y per unknown [m] */
    real total = 0.0; /* of the new motion: is all of it finite? */

    /* Stage 1 of 5: predicted motion. */
    predicted_angle[0] = inputs->base_angle[0];
    predicted_rate[0] = inputs->base_angle_rate[0];
    predicted_acceleration[0] = inputs->base_angle_acceleration[0];

    /* Stage 1 of 5: predicted motion; accelerations of the nodes. */
    real node_x = 0.0;
    real node_y = 0.0;
    acceleration_x[0] = node_x;
    acceleration_y[0] = node_y;
    for (int j = 0; j < ARM50_STATIONS; ++j) {
        predicted_angle[j + 1] = state->angle[j] + state->acceleration[j] * angle_per_acceleration
            + state->rate[j] * rate_per_acceleration;
        predicted_rate[j + 1] = state->rate[j] + state->acceleration[j] * rate_per_acceleration;
        predicted_acceleration[j + 1] = state->acceleration[j];
        lever_sine[j] = length * sin(predicted_angle[j + 1]);
        lever_cosine[j] = length * cos(predicted_angle[j + 1]);
        const real square = predicted_rate[j + 1] * predicted_rate[j + 1];
        node_x = node_x - lever_cosine[j] * square - lever_sine[j] * predicted_acceleration[j + 1];
        node_y = node_y + lever_cosine[j] * predicted_acceleration[j + 1] - lever_sine[j] * square;
        acceleration_x[j + 1] = node_x;
        acceleration_y[j + 1] = node_y;
    }

    /* Stage 1 of 5: how each link's outer end answers to its unknown, and the predicted joint torques; sweep
     * inward: force beyond each joint as an affine function of the motion at it. */
    real impedance_xx = model->tip_mass;
    real impedance_xy = 0.0;
    real impedance_xu = 0.0;
    real impedance_yx = 0.0;
    real impedance_yy = model->tip_mass;
    real impedance_yu = 0.0;
    real impedance_ux = 0.0;
    real impedance_uy = 0.0;
    real impedance_uu = model->tip_inertia;
    real force_x = acceleration_x[50] * model->tip_mass;
    real force_y = acceleration_y[50] * model->tip_mass;
    real torque = predicted_acceleration[50] * model->tip_inertia;
    for (int j = ARM50_STATIONS - 1; j >= 0; --j) {
        const real tangential = 1.0
            - angle_per_acceleration * (predicted_rate[j + 1] * predicted_rate[j + 1]);
        const real turning = angle_per_acceleration * predicted_acceleration[j + 1]
            + predicted_rate[j + 1] * step_1_over_2;
        swing_x[j] = -lever_cosine[j] * turning - lever_sine[j] * tangential;
        swing_y[j] = lever_cosine[j] * tangential - lever_sine[j] * turning;
        const real joint_torque = model->damping[j] * (predicted_rate[j] - predicted_rate[j + 1])
            + model->stiffness[j] * (predicted_angle[j] - predicted_angle[j + 1]);
        const real outer_x = impedance_xu + impedance_xx * swing_x[j] + impedance_xy * swing_y[j];
        const real outer_y = impedance_yu + impedance_yx * swing_x[j] + impedance_yy * swing_y[j];
        const real outer_u = impedance_uu + impedance_ux * swing_x[j] + impedance_uy * swing_y[j];
        const real load_x = force_x + acceleration_x[j] * carried_mass;
        const real load_y = force_y + acceleration_y[j] * carried_mass;
        const real link_ux = impedance_ux + impedance_yx * lever_cosine[j]
            - lever_sine[j] * (carried_mass + impedance_xx);
        const real link_uy = impedance_uy - impedance_xy * lever_sine[j]
            + lever_cosine[j] * (carried_mass + impedance_yy);
        const real link_uu = outer_u + pin_inertia
            + angle_per_acceleration * (-lever_cosine[j] * load_x - lever_sine[j] * load_y)
            + lever_cosine[j] * outer_y - lever_sine[j] * outer_x;
        const real link_xx = impedance_xx + mass;
        const real link_xu = outer_x + carried_mass * swing_x[j];
        const real link_yy = impedance_yy + mass;
        const real link_yu = outer_y + carried_mass * swing_y[j];
        torque = torque + lever_cosine[j] * load_y - lever_sine[j] * load_x
            + pin_inertia * predicted_acceleration[j + 1];
        force_x = force_x + acceleration_x[j + 1] * carried_mass + acceleration_x[j] * inner_mass;
        force_y = force_y + acceleration_y[j + 1] * carried_mass + acceleration_y[j] * inner_mass;
        const real pivot = model->joint_impedance[j] + link_uu;
        if (!(pivot > 0.0) || !(pivot <= DBL_MAX)) {
            return ARM50_VANISHING_PIVOT;
        }
        const real inverse_pivot = 1.0 / pivot;
        answer_own[j] = inverse_pivot * (joint_torque - torque);
        answer_x[j] = inverse_pivot * link_ux;
        answer_y[j] = inverse_pivot * link_uy;
        answer_from_inner[j] = inverse_pivot * model->joint_impedance[j];
        impedance_xx = link_xx - answer_x[j] * link_xu;
        impedance_xy = impedance_xy - answer_y[j] * link_xu;
        impedance_xu = answer_from_inner[j] * link_xu;
        force_x = force_x + answer_own[j] * link_xu;
        impedance_yx = impedance_yx - answer_x[j] * link_yu;
        impedance_yy = link_yy - answer_y[j] * link_yu;
        impedance_yu = answer_from_inner[j] * link_yu;
        force_y = force_y + answer_own[j] * link_yu;
        impedance_ux = answer_x[j] * model->joint_impedance[j];
        impedance_uy = answer_y[j] * model->joint_impedance[j];
        impedance_uu = answer_from_inner[j] * link_uu;
        torque = joint_torque - answer_own[j] * model->joint_impedance[j];
    }

    /* Stage 1 of 5: the base moves as prescribed. */
    real unknown = 0.0;

    /* Stage 1 of 5: sweep outward: the increment of each link's unknown. */
    real change_x = 0.0;
    real change_y = 0.0;

    /* Stage 2 of 5: predicted motion. */
    predicted_angle[0] = inputs->base_angle[1];
    predicted_rate[0] = inputs->base_angle_rate[1];
    predicted_acceleration[0] = inputs->base_angle_acceleration[1];

    /* Stage 1 of 5: sweep outward: the increment of each link's unknown; motion at this stage. Stage 2 of 5:
     * predicted motion; accelerations of the nodes. */
    node_x = 0.0;
    node_y = 0.0;
    acceleration_x[0] = node_x;
    acceleration_y[0] = node_y;
    for (int j = 0; j < ARM50_STATIONS; ++j) {
        unknown = answer_own[j] + answer_from_inner[j] * unknown - answer_x[j] * change_x
            - answer_y[j] * change_y;
        change_x = change_x + swing_x[j] * unknown;
        change_y = change_y + swing_y[j] * unknown;
        stage1_acceleration[j] = predicted_acceleration[j + 1] + unknown;
        stage1_rate[j] = predicted_rate[j + 1] + rate_per_acceleration * unknown;
        predicted_angle[j + 1] = state->angle[j] + state->rate[j] * rate_per_acceleration
            + stage1_acceleration[j] * step2_3_over_16 + stage1_rate[j] * step_1_over_2;
        predicted_rate[j + 1] = state->rate[j] + stage1_acceleration[j] * step_3_over_4;
        predicted_acceleration[j + 1] = stage1_acceleration[j];
        lever_sine[j] = length * sin(predicted_angle[j + 1]);
        lever_cosine[j] = length * cos(predicted_angle[j + 1]);
        const real square = predicted_rate[j + 1] * predicted_rate[j + 1];
        node_x = node_x - lever_cosine[j] * square - lever_sine[j] * predicted_acceleration[j + 1];
        node_y = node_y + lever_cosine[j] * predicted_acceleration[j + 1] - lever_sine[j] * square;
        acceleration_x[j + 1] = node_x;
        acceleration_y[j + 1] = node_y;
    }

    /* Stage 2 of 5: how each link's outer end answers to its unknown, and the predicted joint torques; sweep
     * inward: force beyond each joint as an affine function of the motion at it. */
    impedance_xx = model->tip_mass;
    impedance_xy = 0.0;
    impedance_xu = 0.0;
    impedance_yx = 0.0;
    impedance_yy = model->tip_mass;
    impedance_yu = 0.0;
    impedance_ux = 0.0;
    impedance_uy = 0.0;
    impedance_uu = model->tip_inertia;
    force_x = acceleration_x[50] * model->tip_mass;
    force_y = acceleration_y[50] * model->tip_mass;
    torque = predicted_acceleration[50] * model->tip_inertia;
    for (int j = ARM50_STATIONS - 1; j >= 0; --j) {
        const real tangential = 1.0
            - angle_per_acceleration * (predicted_rate[j + 1] * predicted_rate[j + 1]);
        const real turning = angle_per_acceleration * predicted_acceleration[j + 1]
            + predicted_rate[j + 1] * step_1_over_2;
        swing_x[j] = -lever_cosine[j] * turning - lever_sine[j] * tangential;
        swing_y[j] = lever_cosine[j] * tangential - lever_sine[j] * turning;
        const real joint_torque = model->damping[j] * (predicted_rate[j] - predicted_rate[j + 1])
            + model->stiffness[j] * (predicted_angle[j] - predicted_angle[j + 1]);
        const real outer_x = impedance_xu + impedance_xx * swing_x[j] + impedance_xy * swing_y[j];
        const real outer_y = impedance_yu + impedance_yx * swing_x[j] + impedance_yy * swing_y[j];
        const real outer_u = impedance_uu + impedance_ux * swing_x[j] + impedance_uy * swing_y[j];
        const real load_x = force_x + acceleration_x[j] * carried_mass;
        const real load_y = force_y + acceleration_y[j] * carried_mass;
        const real link_ux = impedance_ux + impedance_yx * lever_cosine[j]
            - lever_sine[j] * (carried_mass + impedance_xx);
        const real link_uy = impedance_uy - impedance_xy * lever_sine[j]
            + lever_cosine[j] * (carried_mass + impedance_yy);
        const real link_uu = outer_u + pin_inertia
            + angle_per_acceleration * (-lever_cosine[j] * load_x - lever_sine[j] * load_y)
            + lever_cosine[j] * outer_y - lever_sine[j] * outer_x;
        const real link_xx = impedance_xx + mass;
        const real link_xu = outer_x + carried_mass * swing_x[j];
        const real link_yy = impedance_yy + mass;
        const real link_yu = outer_y + carried_mass * swing_y[j];
        torque = torque + lever_cosine[j] * load_y - lever_sine[j] * load_x
            + pin_inertia * predicted_acceleration[j + 1];
        force_x = force_x + acceleration_x[j + 1] * carried_mass + acceleration_x[j] * inner_mass;
        force_y = force_y + acceleration_y[j + 1] * carried_mass + acceleration_y[j] * inner_mass;
        const real pivot = model->joint_impedance[j] + link_uu;
        if (!(pivot > 0.0) || !(pivot <= DBL_MAX)) {
            return ARM50_VANISHING_PIVOT;
        }
        const real inverse_pivot = 1.0 / pivot;
        answer_own[j] = inverse_pivot * (joint_torque - torque);
        answer_x[j] = inverse_pivot * link_ux;
        answer_y[j] = inverse_pivot * link_uy;
        answer_from_inner[j] = inverse_pivot * model->joint_impedance[j];
        impedance_xx = link_xx - answer_x[j] * link_xu;
        impedance_xy = impedance_xy - answer_y[j] * link_xu;
        impedance_xu = answer_from_inner[j] * link_xu;
        force_x = force_x + answer_own[j] * link_xu;
        impedance_yx = impedance_yx - answer_x[j] * link_yu;
        impedance_yy = link_yy - answer_y[j] * link_yu;
        impedance_yu = answer_from_inner[j] * link_yu;
        force_y = force_y + answer_own[j] * link_yu;
        impedance_ux = answer_x[j] * model->joint_impedance[j];
        impedance_uy = answer_y[j] * model->joint_impedance[j];
        impedance_uu = answer_from_inner[j] * link_uu;
        torque = joint_torque - answer_own[j] * model->joint_impedance[j];
    }

    /* Stage 2 of 5: the base moves as prescribed. */
    unknown = 0.0;

    /* Stage 2 of 5: sweep outward: the increment of each link's unknown. */
    change_x = 0.0;
    change_y = 0.0;

    /* Stage 3 of 5: predicted motion. */
    predicted_angle[0] = inputs->base_angle[2];
    predicted_rate[0] = inputs->base_angle_rate[2];
    predicted_acceleration[0] = inputs->base_angle_acceleration[2];

    /* Stage 2 of 5: sweep outward: the increment of each link's unknown; motion at this stage. Stage 3 of 5:
     * predicted motion; accelerations of the nodes. */
    node_x = 0.0;
    node_y = 0.0;
    acceleration_x[0] = node_x;
    acceleration_y[0] = node_y;
    for (int j = 0; j < ARM50_STATIONS; ++j) {
        unknown = answer_own[j] + answer_from_inner[j] * unknown - answer_x[j] * change_x
            - answer_y[j] * change_y;
        change_x = change_x + swing_x[j] * unknown;
        change_y = change_y + swing_y[j] * unknown;
        stage2_acceleration[j] = predicted_acceleration[j + 1] + unknown;
        stage2_rate[j] = predicted_rate[j + 1] + rate_per_acceleration * unknown;
        predicted_angle[j + 1] = state->angle[j] + state->rate[j] * rate_per_acceleration
            + stage1_acceleration[j] * step2_17_over_200 + stage1_rate[j] * step_17_over_50
            + stage2_acceleration[j] * step2_21_over_400 - stage2_rate[j] * step_1_over_25;
        predicted_rate[j + 1] = state->rate[j] + stage1_acceleration[j] * step_17_over_50
            + stage2_acceleration[j] * step_21_over_100;
        predicted_acceleration[j + 1] = stage2_acceleration[j];
        lever_sine[j] = length * sin(predicted_angle[j + 1]);
        lever_cosine[j] = length * cos(predicted_angle[j + 1]);
        const real square = predicted_rate[j + 1] * predicted_rate[j + 1];
        node_x = node_x - lever_cosine[j] * square - lever_sine[j] * predicted_acceleration[j + 1];
        node_y = node_y + lever_cosine[j] * predicted_acceleration[j + 1] - lever_sine[j] * square;
        acceleration_x[j + 1] = node_x;
        acceleration_y[j + 1] = node_y;
    }

    /* Stage 3 of 5: how each link's outer end answers to its unknown, and the predicted joint torques; sweep
     * inward: force beyond each joint as an affine function of the motion at it. */
    impedance_xx = model->tip_mass;
    impedance_xy = 0.0;
    impedance_xu = 0.0;
    impedance_yx = 0.0;
    impedance_yy = model->tip_mass;
    impedance_yu = 0.0;
    impedance_ux = 0.0;
    impedance_uy = 0.0;
    impedance_uu = model->tip_inertia;
    force_x = acceleration_x[50] * model->tip_mass;
    force_y = acceleration_y[50] * model->tip_mass;
    torque = predicted_acceleration[50] * model->tip_inertia;
    for (int j = ARM50_STATIONS - 1; j >= 0; --j) {
        const real tangential = 1.0
            - angle_per_acceleration * (predicted_rate[j + 1] * predicted_rate[j + 1]);
        const real turning = angle_per_acceleration * predicted_acceleration[j + 1]
            + predicted_rate[j + 1] * step_1_over_2;
        swing_x[j] = -lever_cosine[j] * turning - lever_sine[j] * tangential;
        swing_y[j] = lever_cosine[j] * tangential - lever_sine[j] * turning;
        const real joint_torque = model->damping[j] * (predicted_rate[j] - predicted_rate[j + 1])
            + model->stiffness[j] * (predicted_angle[j] - predicted_angle[j + 1]);
        const real outer_x = impedance_xu + impedance_xx * swing_x[j] + impedance_xy * swing_y[j];
        const real outer_y = impedance_yu + impedance_yx * swing_x[j] + impedance_yy * swing_y[j];
        const real outer_u = impedance_uu + impedance_ux * swing_x[j] + impedance_uy * swing_y[j];
        const real load_x = force_x + acceleration_x[j] * carried_mass;
        const real load_y = force_y + acceleration_y[j] * carried_mass;
        const real link_ux = impedance_ux + impedance_yx * lever_cosine[j]
            - lever_sine[j] * (carried_mass + impedance_xx);
        const real link_uy = impedance_uy - impedance_xy * lever_sine[j]
            + lever_cosine[j] * (carried_mass + impedance_yy);
        const real link_uu = outer_u + pin_inertia
            + angle_per_acceleration * (-lever_cosine[j] * load_x - lever_sine[j] * load_y)
            + lever_cosine[j] * outer_y - lever_sine[j] * outer_x;
        const real link_xx = impedance_xx + mass;
        const real link_xu = outer_x + carried_mass * swing_x[j];
        const real link_yy = impedance_yy + mass;
        const real link_yu = outer_y + carried_mass * swing_y[j];
        torque = torque + lever_cosine[j] * load_y - lever_sine[j] * load_x
            + pin_inertia * predicted_acceleration[j + 1];
        force_x = force_x + acceleration_x[j + 1] * carried_mass + acceleration_x[j] * inner_mass;
        force_y = force_y + acceleration_y[j + 1] * carried_mass + acceleration_y[j] * inner_mass;
        const real pivot = model->joint_impedance[j] + link_uu;
        if (!(pivot > 0.0) || !(pivot <= DBL_MAX)) {
            return ARM50_VANISHING_PIVOT;
        }
        const real inverse_pivot = 1.0 / pivot;
        answer_own[j] = inverse_pivot * (joint_torque - torque);
        answer_x[j] = inverse_pivot * link_ux;
        answer_y[j] = inverse_pivot * link_uy;
        answer_from_inner[j] = inverse_pivot * model->joint_impedance[j];
        impedance_xx = link_xx - answer_x[j] * link_xu;
        impedance_xy = impedance_xy - answer_y[j] * link_xu;
        impedance_xu = answer_from_inner[j] * link_xu;
        force_x = force_x + answer_own[j] * link_xu;
        impedance_yx = impedance_yx - answer_x[j] * link_yu;
        impedance_yy = link_yy - answer_y[j] * link_yu;
        impedance_yu = answer_from_inner[j] * link_yu;
        force_y = force_y + answer_own[j] * link_yu;
        impedance_ux = answer_x[j] * model->joint_impedance[j];
        impedance_uy = answer_y[j] * model->joint_impedance[j];
        impedance_uu = answer_from_inner[j] * link_uu;
        torque = joint_torque - answer_own[j] * model->joint_impedance[j];
    }

    /* Stage 3 of 5: the base moves as prescribed. */
    unknown = 0.0;

    /* Stage 3 of 5: sweep outward: the increment of each link's unknown. */
    change_x = 0.0;
    change_y = 0.0;

    /* Stage 4 of 5: predicted motion. */
    predicted_angle[0] = inputs->base_angle[3];
    predicted_rate[0] = inputs->base_angle_rate[3];
    predicted_acceleration[0] = inputs->base_angle_acceleration[3];

    /* Stage 3 of 5: sweep outward: the increment of each link's unknown; motion at this stage. Stage 4 of 5:
     * predicted motion; accelerations of the nodes. */
    node_x = 0.0;
    node_y = 0.0;
    acceleration_x[0] = node_x;
    acceleration_y[0] = node_y;
    for (int j = 0; j < ARM50_STATIONS; ++j) {
        unknown = answer_own[j] + answer_from_inner[j] * unknown - answer_x[j] * change_x
            - answer_y[j] * change_y;
        change_x = change_x + swing_x[j] * unknown;
        change_y = change_y + swing_y[j] * unknown;
        stage3_acceleration[j] = predicted_acceleration[j + 1] + unknown;
        stage3_rate[j] = predicted_rate[j + 1] + rate_per_acceleration * unknown;
        predicted_angle[j + 1] = state->angle[j] + state->rate[j] * rate_per_acceleration
            + stage1_acceleration[j] * step2_371_over_5440 + stage1_rate[j] * step_371_over_1360
            - stage2_acceleration[j] * step2_137_over_10880 - stage2_rate[j] * step_137_over_2720
            + stage3_acceleration[j] * step2_151_over_2176 + stage3_rate[j] * step_15_over_544;
        predicted_rate[j + 1] = state->rate[j] + stage1_acceleration[j] * step_371_over_1360
            - stage2_acceleration[j] * step_137_over_2720 + stage3_acceleration[j] * step_151_over_544;
        predicted_acceleration[j + 1] = stage3_acceleration[j];
        lever_sine[j] = length * sin(predicted_angle[j + 1]);
        lever_cosine[j] = length * cos(predicted_angle[j + 1]);
        const real square = predicted_rate[j + 1] * predicted_rate[j + 1];
        node_x = node_x - lever_cosine[j] * square - lever_sine[j] * predicted_acceleration[j + 1];
        node_y = node_y + lever_cosine[j] * predicted_acceleration[j + 1] - lever_sine[j] * square;
        acceleration_x[j + 1] = node_x;
        acceleration_y[j + 1] = node_y;
    }

    /* Stage 4 of 5: how each link's outer end answers to its unknown, and the predicted joint torques; sweep
     * inward: force beyond each joint as an affine function of the motion at it. */
    impedance_xx = model->tip_mass;
    impedance_xy = 0.0;
    impedance_xu = 0.0;
    impedance_yx = 0.0;
    impedance_yy = model->tip_mass;
    impedance_yu = 0.0;
    impedance_ux = 0.0;
    impedance_uy = 0.0;
    impedance_uu = model->tip_inertia;
    force_x = acceleration_x[50] * model->tip_mass;
    force_y = acceleration_y[50] * model->tip_mass;
    torque = predicted_acceleration[50] * model->tip_inertia;
    for (int j = ARM50_STATIONS - 1; j >= 0; --j) {
        const real tangential = 1.0
            - angle_per_acceleration * (predicted_rate[j + 1] * predicted_rate[j + 1]);
        const real turning = angle_per_acceleration * predicted_acceleration[j + 1]
            + predicted_rate[j + 1] * step_1_over_2;
        swing_x[j] = -lever_cosine[j] * turning - lever_sine[j] * tangential;
        swing_y[j] = lever_cosine[j] * tangential - lever_sine[j] * turning;
        const real joint_torque = model->damping[j] * (predicted_rate[j] - predicted_rate[j + 1])
            + model->stiffness[j] * (predicted_angle[j] - predicted_angle[j + 1]);
        const real outer_x = impedance_xu + impedance_xx * swing_x[j] + impedance_xy * swing_y[j];
        const real outer_y = impedance_yu + impedance_yx * swing_x[j] + impedance_yy * swing_y[j];
        const real outer_u = impedance_uu + impedance_ux * swing_x[j] + impedance_uy * swing_y[j];
        const real load_x = force_x + acceleration_x[j] * carried_mass;
        const real load_y = force_y + acceleration_y[j] * carried_mass;
        const real link_ux = impedance_ux + impedance_yx * lever_cosine[j]
            - lever_sine[j] * (carried_mass + impedance_xx);
        const real link_uy = impedance_uy - impedance_xy * lever_sine[j]
            + lever_cosine[j] * (carried_mass + impedance_yy);
        const real link_uu = outer_u + pin_inertia
            + angle_per_acceleration * (-lever_cosine[j] * load_x - lever_sine[j] * load_y)
            + lever_cosine[j] * outer_y - lever_sine[j] * outer_x;
        const real link_xx = impedance_xx + mass;
        const real link_xu = outer_x + carried_mass * swing_x[j];
        const real link_yy = impedance_yy + mass;
        const real link_yu = outer_y + carried_mass * swing_y[j];
        torque = torque + lever_cosine[j] * load_y - lever_sine[j] * load_x
            + pin_inertia * predicted_acceleration[j + 1];
        force_x = force_x + acceleration_x[j + 1] * carried_mass + acceleration_x[j] * inner_mass;
        force_y = force_y + acceleration_y[j + 1] * carried_mass + acceleration_y[j] * inner_mass;
        const real pivot = model->joint_impedance[j] + link_uu;
        if (!(pivot > 0.0) || !(pivot <= DBL_MAX)) {
            return ARM50_VANISHING_PIVOT;
        }
        const real inverse_pivot = 1.0 / pivot;
        answer_own[j] = inverse_pivot * (joint_torque - torque);
        answer_x[j] = inverse_pivot * link_ux;
        answer_y[j] = inverse_pivot * link_uy;
        answer_from_inner[j] = inverse_pivot * model->joint_impedance[j];
        impedance_xx = link_xx - answer_x[j] * link_xu;
        impedance_xy = impedance_xy - answer_y[j] * link_xu;
        impedance_xu = answer_from_inner[j] * link_xu;
        force_x = force_x + answer_own[j] * link_xu;
        impedance_yx = impedance_yx - answer_x[j] * link_yu;
        impedance_yy = link_yy - answer_y[j] * link_yu;
        impedance_yu = answer_from_inner[j] * link_yu;
        force_y = force_y + answer_own[j] * link_yu;
        impedance_ux = answer_x[j] * model->joint_impedance[j];
        impedance_uy = answer_y[j] * model->joint_impedance[j];
        impedance_uu = answer_from_inner[j] * link_uu;
        torque = joint_torque - answer_own[j] * model->joint_impedance[j];
    }

    /* Stage 4 of 5: the base moves as prescribed. */
    unknown = 0.0;

    /* Stage 4 of 5: sweep outward: the increment of each link's unknown. */
    change_x = 0.0;
    change_y = 0.0;

    /* Stage 5 of 5: predicted motion. */
    predicted_angle[0] = inputs->base_angle[4];
    predicted_rate[0] = inputs->base_angle_rate[4];
    predicted_acceleration[0] = inputs->base_angle_acceleration[4];

    /* Stage 4 of 5: sweep outward: the increment of each link's unknown; motion at this stage. Stage 5 of 5:
     * predicted motion; accelerations of the nodes. */
    node_x = 0.0;
    node_y = 0.0;
    acceleration_x[0] = node_x;
    acceleration_y[0] = node_y;
    for (int j = 0; j < ARM50_STATIONS; ++j) {
        unknown = answer_own[j] + answer_from_inner[j] * unknown - answer_x[j] * change_x
            - answer_y[j] * change_y;
        change_x = change_x + swing_x[j] * unknown;
        change_y = change_y + swing_y[j] * unknown;
        const real stage4_acceleration = predicted_acceleration[j + 1] + unknown;
        const real stage4_rate = predicted_rate[j + 1] + rate_per_acceleration * unknown;
        predicted_angle[j + 1] = state->angle[j] + state->rate[j] * rate_per_acceleration
            + stage1_acceleration[j] * step2_25_over_96 + stage1_rate[j] * step_25_over_24
            - stage2_acceleration[j] * step2_49_over_192 - stage2_rate[j] * step_49_over_48
            + stage3_acceleration[j] * step2_125_over_64 + stage3_rate[j] * step_125_over_16
            - stage4_acceleration * step2_41_over_24 - stage4_rate * step_85_over_12;
        predicted_rate[j + 1] = state->rate[j] + stage1_acceleration[j] * step_25_over_24
            - stage2_acceleration[j] * step_49_over_48 + stage3_acceleration[j] * step_125_over_16
            - stage4_acceleration * step_41_over_6;
        predicted_acceleration[j + 1] = stage4_acceleration;
        lever_sine[j] = length * sin(predicted_angle[j + 1]);
        lever_cosine[j] = length * cos(predicted_angle[j + 1]);
        const real square = predicted_rate[j + 1] * predicted_rate[j + 1];
        node_x = node_x - lever_cosine[j] * square - lever_sine[j] * predicted_acceleration[j + 1];
        node_y = node_y + lever_cosine[j] * predicted_acceleration[j + 1] - lever_sine[j] * square;
        acceleration_x[j + 1] = node_x;
        acceleration_y[j + 1] = node_y;
    }

    /* Stage 5 of 5: how each link's outer end answers to its unknown, and the predicted joint torques; sweep
     * inward: force beyond each joint as an affine function of the motion at it. */
    impedance_xx = model->tip_mass;
    impedance_xy = 0.0;
    impedance_xu = 0.0;
    impedance_yx = 0.0;
    impedance_yy = model->tip_mass;
    impedance_yu = 0.0;
    impedance_ux = 0.0;
    impedance_uy = 0.0;
    impedance_uu = model->tip_inertia;
    force_x = acceleration_x[50] * model->tip_mass;
    force_y = acceleration_y[50] * model->tip_mass;
    torque = predicted_acceleration[50] * model->tip_inertia;
    for (int j = ARM50_STATIONS - 1; j >= 0; --j) {
        const real tangential = 1.0
            - angle_per_acceleration * (predicted_rate[j + 1] * predicted_rate[j + 1]);
        const real turning = angle_per_acceleration * predicted_acceleration[j + 1]
            + predicted_rate[j + 1] * step_1_over_2;
        swing_x[j] = -lever_cosine[j] * turning - lever_sine[j] * tangential;
        swing_y[j] = lever_cosine[j] * tangential - lever_sine[j] * turning;
        const real joint_torque = model->damping[j] * (predicted_rate[j] - predicted_rate[j + 1])
            + model->stiffness[j] * (predicted_angle[j] - predicted_angle[j + 1]);
        const real outer_x = impedance_xu + impedance_xx * swing_x[j] + impedance_xy * swing_y[j];
        const real outer_y = impedance_yu + impedance_yx * swing_x[j] + impedance_yy * swing_y[j];
        const real outer_u = impedance_uu + impedance_ux * swing_x[j] + impedance_uy * swing_y[j];
        const real load_x = force_x + acceleration_x[j] * carried_mass;
        const real load_y = force_y + acceleration_y[j] * carried_mass;
        const real link_ux = impedance_ux + impedance_yx * lever_cosine[j]
            - lever_sine[j] * (carried_mass + impedance_xx);
        const real link_uy = impedance_uy - impedance_xy * lever_sine[j]
            + lever_cosine[j] * (carried_mass + impedance_yy);
        const real link_uu = outer_u + pin_inertia
            + angle_per_acceleration * (-lever_cosine[j] * load_x - lever_sine[j] * load_y)
            + lever_cosine[j] * outer_y - lever_sine[j] * outer_x;
        const real link_xx = impedance_xx + mass;
        const real link_xu = outer_x + carried_mass * swing_x[j];
        const real link_yy = impedance_yy + mass;
        const real link_yu = outer_y + carried_mass * swing_y[j];
        torque = torque + lever_cosine[j] * load_y - lever_sine[j] * load_x
            + pin_inertia * predicted_acceleration[j + 1];
        force_x = force_x + acceleration_x[j + 1] * carried_mass + acceleration_x[j] * inner_mass;
        force_y = force_y + acceleration_y[j + 1] * carried_mass + acceleration_y[j] * inner_mass;
        const real pivot = model->joint_impedance[j] + link_uu;
        if (!(pivot > 0.0) || !(pivot <= DBL_MAX)) {
            return ARM50_VANISHING_PIVOT;
        }
        const real inverse_pivot = 1.0 / pivot;
        answer_own[j] = inverse_pivot * (joint_torque - torque);
        answer_x[j] = inverse_pivot * link_ux;
        answer_y[j] = inverse_pivot * link_uy;
        answer_from_inner[j] = inverse_pivot * model->joint_impedance[j];
        impedance_xx = link_xx - answer_x[j] * link_xu;
        impedance_xy = impedance_xy - answer_y[j] * link_xu;
        impedance_xu = answer_from_inner[j] * link_xu;
        force_x = force_x + answer_own[j] * link_xu;
        impedance_yx = impedance_yx - answer_x[j] * link_yu;
        impedance_yy = link_yy - answer_y[j] * link_yu;
        impedance_yu = answer_from_inner[j] * link_yu;
        force_y = force_y + answer_own[j] * link_yu;
        impedance_ux = answer_x[j] * model->joint_impedance[j];
        impedance_uy = answer_y[j] * model->joint_impedance[j];
        impedance_uu = answer_from_inner[j] * link_uu;
        torque = joint_torque - answer_own[j] * model->joint_impedance[j];
    }

    /* Stage 5 of 5: the base moves as prescribed. */
    unknown = 0.0;

    /* Stage 5 of 5: sweep outward: the increment of each link's unknown. */
    change_x = 0.0;
    change_y = 0.0;

    /* Stage 5 of 5: sweep outward: the increment of each link's unknown; motion at the end of the step. */
    state->hub_angle = inputs->base_angle[4];
    state->hub_rate = inputs->base_angle_rate[4];
    for (int j = 0; j < ARM50_STATIONS; ++j) {
        unknown = answer_own[j] + answer_from_inner[j] * unknown - answer_x[j] * change_x
            - answer_y[j] * change_y;
        change_x = change_x + swing_x[j] * unknown;
        change_y = change_y + swing_y[j] * unknown;
        state->angle[j] = predicted_angle[j + 1] + angle_per_acceleration * unknown;
        state->rate[j] = predicted_rate[j + 1] + rate_per_acceleration * unknown;
        state->acceleration[j] = predicted_acceleration[j + 1] + unknown;
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
    const real factor_27 = model->factor_27;
    const real factor_28 = model->factor_28;

    /* Tip: position. */
    outputs->tip_x = 0.0;
    outputs->tip_y = 0.0;

    /* Tip_angle: angle. */
    outputs->tip_angle = state->angle[49];

    /* Tip: position; reaction: force. */
    real node_x = 0.0;
    real node_y = 0.0;
    outputs->reaction_x = 0.0;
    outputs->reaction_y = 0.0;
    for (int j = 0; j < ARM50_STATIONS; ++j) {
        outputs->tip_x = outputs->tip_x + length * cos(state->angle[j]);
        outputs->tip_y = outputs->tip_y + length * sin(state->angle[j]);
        const real inner_x = node_x;
        const real inner_y = node_y;
        node_x = node_x - state->acceleration[j] * length * sin(state->angle[j])
            - length * (state->rate[j] * state->rate[j]) * cos(state->angle[j]);
        node_y = node_y + state->acceleration[j] * length * cos(state->angle[j])
            - length * (state->rate[j] * state->rate[j]) * sin(state->angle[j]);
        outputs->reaction_x = outputs->reaction_x - factor_27 * inner_x + factor_28 * node_x;
        outputs->reaction_y = outputs->reaction_y - factor_27 * inner_y + factor_28 * node_y;
    }
    outputs->reaction_x = outputs->reaction_x + node_x * model->tip_mass;
    outputs->reaction_y = outputs->reaction_y + node_y * model->tip_mass;

    /* Drive: torque. */
    outputs->drive = model->damping[0] * (state->rate[0] - state->hub_rate)
        + model->stiffness[0] * (state->angle[0] - state->hub_angle);
}

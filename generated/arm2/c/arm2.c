/**
 * arm2: Two unlike links swung by a motor
 *
 * Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: c5e09abbb61734735cef8cfddf39dd959eb5765da3ad6484bed2957b4fdf212c
 * sha256 of the rest of this file: 7753e201107dae63ff036f66af73f8bdb430488fba3f5c98c47ae1489c5e6a7d
 *
 * model: planar arm, large rotations, gravity, tip mass
 * stations: 2
 * base: motor
 * integrator: Newmark 1959, beta = 0.25, gamma = 0.5
 * linearisation: newton
 * sweep: riccati
 * unknown: acceleration
 * operations of a step: 249, 124.5 per station (116 additions, 126 multiplications, 3 divisions, 4 sines and
 *     cosines)
 * operations of prepare: 38, 19 per station (10 additions, 28 multiplications)
 * number type: double
 * bytes of the structs: params 136, model 168, state 72, inputs 8, outputs 32
 *
 * @file arm2.c
 */
#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(_M_FP_FAST) \
    || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "-Ofast and -ffast-math remove checks of this file: use -O3, or put -fno-fast-math behind them"
#endif

#include <float.h>
#include <math.h>
#include <stddef.h>

/* Members of the header below: no macro of a header above may have their names. */
#undef hub_torque
#undef tip_x
#undef tip_y
#undef hub
#undef elbow

#include "arm2.h"

typedef arm2_real real;

static int inputs_are_finite(const arm2_inputs *inputs)
{
    if (!isfinite(inputs->hub_torque)) {
        return 0;
    }
    return 1;
}

void arm2_default_params(arm2_params *params)
{
    static const real length[] = {
        0.45, 0.35
    };
    static const real mass[] = {
        0.9, 0.5
    };
    static const real inertia[] = {
        0.016, 0.006
    };
    static const real center[] = {
        0.4, 0.45
    };
    static const real stiffness[] = {
        120.0, 40.0
    };
    static const real damping[] = {
        0.6, 0.2
    };
    if (params == NULL) {
        return;
    }
    for (int j = 0; j < ARM2_STATIONS; ++j) {
        params->length[j] = length[j];
    }
    for (int j = 0; j < ARM2_STATIONS; ++j) {
        params->mass[j] = mass[j];
    }
    for (int j = 0; j < ARM2_STATIONS; ++j) {
        params->inertia[j] = inertia[j];
    }
    for (int j = 0; j < ARM2_STATIONS; ++j) {
        params->center[j] = center[j];
    }
    for (int j = 0; j < ARM2_STATIONS; ++j) {
        params->stiffness[j] = stiffness[j];
    }
    for (int j = 0; j < ARM2_STATIONS; ++j) {
        params->damping[j] = damping[j];
    }
    params->gravity = 9.81;
    params->hub_inertia = 0.05;
    params->hub_damping = 0.05;
    params->tip_mass = 0.1;
    params->tip_inertia = 0.0002;
}

arm2_status arm2_prepare(
    arm2_model *model,
    const arm2_params *params,
    arm2_real step)
{
    if (model == NULL || params == NULL) {
        return ARM2_NULL_POINTER;
    }
    if (!(step > 0.0) || !(step <= DBL_MAX)) {
        return ARM2_INVALID_STEP;
    }
    /* Infinities and NaN less themselves are NaN, all other numbers 0. */
    real lost = (params->gravity - params->gravity) + (params->hub_inertia - params->hub_inertia)
        + (params->hub_damping - params->hub_damping) + (params->tip_mass - params->tip_mass)
        + (params->tip_inertia - params->tip_inertia);
    for (int j = 0; j < ARM2_STATIONS; ++j) {
        lost += (params->length[j] - params->length[j]) + (params->mass[j] - params->mass[j])
            + (params->inertia[j] - params->inertia[j]) + (params->center[j] - params->center[j])
            + (params->stiffness[j] - params->stiffness[j]) + (params->damping[j] - params->damping[j]);
    }
    if (!(lost >= 0.0)) {
        return ARM2_NON_FINITE_INPUT;
    }

    /* Masses at the nodes between links, and what they leave over; factors of the sweep that do not change
     * from step to step. */
    for (int j = 0; j < 1; ++j) {
        model->node_mass[j] = params->center[j] * params->mass[j]
            + params->mass[j + 1] * (1.0 - params->center[j + 1]);
    }
    model->node_mass[1] = params->tip_mass + params->center[1] * params->mass[1];
    for (int j = ARM2_STATIONS - 1; j >= 0; --j) {
        model->rod_inertia[j] = params->inertia[j]
            - params->center[j] * (params->length[j] * params->length[j]) * params->mass[j]
            * (1.0 - params->center[j]);
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
    for (int j = 0; j < ARM2_STATIONS; ++j) {
        model->length[j] = params->length[j];
    }
    for (int j = 0; j < ARM2_STATIONS; ++j) {
        model->stiffness[j] = params->stiffness[j];
    }
    for (int j = 0; j < ARM2_STATIONS; ++j) {
        model->damping[j] = params->damping[j];
    }
    model->gravity = params->gravity;
    model->hub_inertia = params->hub_inertia;
    model->hub_damping = params->hub_damping;
    model->tip_inertia = params->tip_inertia;

    real total = 0.0; /* of the model: is all of it finite? */
    for (int j = 0; j < ARM2_STATIONS; ++j) {
        total += model->node_mass[j] + model->rod_inertia[j] + model->joint_impedance[j];
    }
    if (!isfinite(model->half_step_squared + model->angle_per_acceleration + model->rate_per_acceleration
        + model->hub_impedance + total)) {
        return ARM2_NON_FINITE_MODEL;
    }
    return ARM2_OK;
}

arm2_status arm2_initialise(
    arm2_state *state,
    const arm2_params *params,
    const arm2_real initial_angle[ARM2_STATIONS],
    const arm2_real initial_rate[ARM2_STATIONS],
    const arm2_inputs *inputs)
{
    if (state == NULL || params == NULL || inputs == NULL) {
        return ARM2_NULL_POINTER;
    }
    if (!inputs_are_finite(inputs)) {
        return ARM2_NON_FINITE_INPUT;
    }
    for (int j = 0; j < ARM2_STATIONS; ++j) {
        if ((initial_angle != NULL && !isfinite(initial_angle[j]))
            || (initial_rate != NULL && !isfinite(initial_rate[j]))) {
            return ARM2_NON_FINITE_INPUT;
        }
    }

    real acceleration_x[ARM2_STATIONS + 1]; /* acceleration of the nodes along x [m/s^2] */
    real acceleration_y[ARM2_STATIONS + 1]; /* acceleration of the nodes along y [m/s^2] */
    real answer_own[ARM2_STATIONS]; /* unknown of a station if its inner side kept its motion */
    real answer_x[ARM2_STATIONS]; /* answer of the unknown to the joint's acceleration along x */
    real answer_y[ARM2_STATIONS]; /* answer of the unknown to the joint's acceleration along y */
    real lever_cosine[ARM2_STATIONS]; /* length times cosine of the angle [m] */
    real lever_sine[ARM2_STATIONS]; /* length times sine of the angle [m] */
    /* acceleration of base and links as predicted [rad/s^2] */
    real predicted_acceleration[ARM2_STATIONS + 1];
    real predicted_angle[ARM2_STATIONS + 1]; /* angle of base and links as predicted [rad] */
    real predicted_rate[ARM2_STATIONS + 1]; /* rate of base and links as predicted [rad/s] */
    real start_node_mass[ARM2_STATIONS]; /* mass at the outer end of each link [kg] */
    real total = 0.0; /* of the new motion: is all of it finite? */

    /* Masses at the nodes between links, and what they leave over. */
    for (int j = 0; j < 1; ++j) {
        start_node_mass[j] = params->center[j] * params->mass[j]
            + params->mass[j + 1] * (1.0 - params->center[j + 1]);
    }
    start_node_mass[1] = params->tip_mass + params->center[1] * params->mass[1];

    /* What is the same at every station. */
    const real hub_pivot = params->hub_inertia;
    if (!(params->hub_inertia > 0.0) || !(params->hub_inertia <= DBL_MAX)) {
        return ARM2_VANISHING_PIVOT;
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
    for (int j = 0; j < ARM2_STATIONS; ++j) {
        predicted_rate[j + 1] = (initial_rate != NULL ? initial_rate[j] : 0.0);
        predicted_angle[j + 1] = (initial_angle != NULL ? initial_angle[j] : 0.0);
        predicted_acceleration[j + 1] = 0.0;
        lever_cosine[j] = params->length[j] * cos(predicted_angle[j + 1]);
        lever_sine[j] = params->length[j] * sin(predicted_angle[j + 1]);
        const real square = predicted_rate[j + 1] * predicted_rate[j + 1];
        const real relative_x = -lever_cosine[j] * square - lever_sine[j] * predicted_acceleration[j + 1];
        const real relative_y = lever_cosine[j] * predicted_acceleration[j + 1] - lever_sine[j] * square;
        node_x = node_x + relative_x;
        node_y = node_y + relative_y;
        acceleration_x[j + 1] = node_x;
        acceleration_y[j + 1] = node_y;
    }

    /* Masses at the nodes between links, and what they leave over; forces of the joints at the motion so far;
     * sweep inward: force beyond each joint as an affine function of the motion at it. */
    real impedance_xx = 0.0;
    real impedance_xy = 0.0;
    real impedance_yx = 0.0;
    real impedance_yy = 0.0;
    real impedance_uu = params->tip_inertia;
    real force_x = 0.0;
    real force_y = 0.0;
    real torque = predicted_acceleration[2] * params->tip_inertia;
    for (int j = ARM2_STATIONS - 1; j >= 0; --j) {
        const real start_rod_inertia = params->inertia[j]
            - params->center[j] * (params->length[j] * params->length[j]) * params->mass[j]
            * (1.0 - params->center[j]);
        const real joint_torque = params->damping[j] * (predicted_rate[j] - predicted_rate[j + 1])
            + params->stiffness[j] * (predicted_angle[j] - predicted_angle[j + 1]);
        impedance_xx = impedance_xx + start_node_mass[j];
        force_x = force_x + acceleration_x[j + 1] * start_node_mass[j];
        impedance_yy = impedance_yy + start_node_mass[j];
        force_y = force_y + acceleration_y[j + 1] * start_node_mass[j];
        const real impedance_xu = impedance_xy * lever_cosine[j] - impedance_xx * lever_sine[j];
        const real impedance_yu = impedance_yy * lever_cosine[j] - impedance_yx * lever_sine[j];
        const real impedance_ux = impedance_yx * lever_cosine[j] - impedance_xx * lever_sine[j];
        const real impedance_uy = impedance_yy * lever_cosine[j] - impedance_xy * lever_sine[j];
        impedance_uu = impedance_uu + start_rod_inertia - impedance_xu * lever_sine[j]
            + impedance_yu * lever_cosine[j];
        torque = torque - force_x * lever_sine[j] + force_y * lever_cosine[j]
            + predicted_acceleration[j + 1] * start_rod_inertia;
        if (!(impedance_uu > 0.0) || !(impedance_uu <= DBL_MAX)) {
            return ARM2_VANISHING_PIVOT;
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
    for (int j = 0; j < ARM2_STATIONS; ++j) {
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y;
        change_x = change_x - lever_sine[j] * unknown;
        change_y = change_y + lever_cosine[j] * unknown;
        state->angle[j] = predicted_angle[j + 1];
        state->rate[j] = predicted_rate[j + 1];
        state->acceleration[j] = predicted_acceleration[j + 1] + unknown;
        total += state->angle[j] + state->rate[j] + state->acceleration[j];
    }

    if (!isfinite(total + state->hub_angle + state->hub_rate + state->hub_acceleration)) {
        return ARM2_NON_FINITE_STATE;
    }
    return ARM2_OK;
}

arm2_status arm2_step(
    const arm2_model *model,
    arm2_state *state,
    const arm2_inputs *inputs)
{
    if (model == NULL || state == NULL || inputs == NULL) {
        return ARM2_NULL_POINTER;
    }
    if (!inputs_are_finite(inputs)) {
        return ARM2_NON_FINITE_INPUT;
    }

    const real step = model->step;
    const real half_step_squared = model->half_step_squared;
    const real angle_per_acceleration = model->angle_per_acceleration;
    const real rate_per_acceleration = model->rate_per_acceleration;
    real acceleration_x[ARM2_STATIONS + 1]; /* acceleration of the nodes along x [m/s^2] */
    real acceleration_y[ARM2_STATIONS + 1]; /* acceleration of the nodes along y [m/s^2] */
    real answer_own[ARM2_STATIONS]; /* unknown of a station if its inner side kept its motion */
    real answer_x[ARM2_STATIONS]; /* answer of the unknown to the joint's acceleration along x */
    real answer_y[ARM2_STATIONS]; /* answer of the unknown to the joint's acceleration along y */
    real lever_cosine[ARM2_STATIONS]; /* length times cosine of the angle [m] */
    real lever_sine[ARM2_STATIONS]; /* length times sine of the angle [m] */
    real predicted_angle[ARM2_STATIONS + 1]; /* angle of base and links as predicted [rad] */
    real predicted_rate[ARM2_STATIONS + 1]; /* rate of base and links as predicted [rad/s] */
    real swing_x[ARM2_STATIONS]; /* change of the outer end's acceleration along x per unknown [m] */
    real swing_y[ARM2_STATIONS]; /* change of the outer end's acceleration along y per unknown [m] */
    real transmission[ARM2_STATIONS]; /* share of motion and torque each joint passes on */
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
    for (int j = 0; j < ARM2_STATIONS; ++j) {
        predicted_rate[j + 1] = state->rate[j] + state->acceleration[j] * step;
        predicted_angle[j + 1] = state->angle[j] + state->acceleration[j] * half_step_squared
            + state->rate[j] * step;
        lever_cosine[j] = model->length[j] * cos(predicted_angle[j + 1]);
        lever_sine[j] = model->length[j] * sin(predicted_angle[j + 1]);
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
    real impedance_xx = 0.0;
    real impedance_xy = 0.0;
    real impedance_xu = 0.0;
    real impedance_yx = 0.0;
    real impedance_yy = 0.0;
    real impedance_yu = 0.0;
    real impedance_ux = 0.0;
    real impedance_uy = 0.0;
    real impedance_uu = model->tip_inertia;
    real force_x = 0.0;
    real force_y = 0.0;
    real torque = state->acceleration[1] * model->tip_inertia;
    for (int j = ARM2_STATIONS - 1; j >= 0; --j) {
        const real joint_torque = model->damping[j] * (predicted_rate[j] - predicted_rate[j + 1])
            + model->stiffness[j] * (predicted_angle[j] - predicted_angle[j + 1]);
        impedance_xx = impedance_xx + model->node_mass[j];
        force_x = force_x + acceleration_x[j + 1] * model->node_mass[j];
        impedance_yy = impedance_yy + model->node_mass[j];
        force_y = force_y + acceleration_y[j + 1] * model->node_mass[j];
        impedance_xu = impedance_xu + impedance_xx * swing_x[j] + impedance_xy * swing_y[j];
        impedance_yu = impedance_yu + impedance_yx * swing_x[j] + impedance_yy * swing_y[j];
        impedance_uu = impedance_uu + impedance_ux * swing_x[j] + impedance_uy * swing_y[j];
        impedance_ux = impedance_ux - impedance_xx * lever_sine[j] + impedance_yx * lever_cosine[j];
        impedance_uy = impedance_uy - impedance_xy * lever_sine[j] + impedance_yy * lever_cosine[j];
        impedance_uu = impedance_uu + model->rod_inertia[j]
            + lever_cosine[j] * (impedance_yu - angle_per_acceleration * force_x)
            + lever_sine[j] * (-impedance_xu - angle_per_acceleration * force_y);
        torque = torque + state->acceleration[j] * model->rod_inertia[j] - force_x * lever_sine[j]
            + force_y * lever_cosine[j];
        const real pivot = impedance_uu + model->joint_impedance[j];
        if (!(pivot > 0.0) || !(pivot <= DBL_MAX)) {
            return ARM2_VANISHING_PIVOT;
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
    const real hub_pivot = model->hub_impedance + impedance_uu;
    if (!(hub_pivot > 0.0) || !(hub_pivot <= DBL_MAX)) {
        return ARM2_VANISHING_PIVOT;
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
    for (int j = 0; j < ARM2_STATIONS; ++j) {
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y + transmission[j] * unknown;
        change_x = change_x + swing_x[j] * unknown;
        change_y = change_y + swing_y[j] * unknown;
        state->angle[j] = predicted_angle[j + 1] + angle_per_acceleration * unknown;
        state->rate[j] = predicted_rate[j + 1] + rate_per_acceleration * unknown;
        state->acceleration[j] = state->acceleration[j] + unknown;
        total += state->angle[j] + state->rate[j] + state->acceleration[j];
    }

    if (!isfinite(total + state->hub_angle + state->hub_rate + state->hub_acceleration)) {
        return ARM2_NON_FINITE_STATE;
    }
    return ARM2_OK;
}

void arm2_output(
    const arm2_model *model,
    const arm2_state *state,
    arm2_outputs *outputs)
{
    if (model == NULL || state == NULL || outputs == NULL) {
        return;
    }
    /* Output tip: position. */
    outputs->tip_x = 0.0;
    outputs->tip_y = 0.0;
    for (int j = 0; j < ARM2_STATIONS; ++j) {
        outputs->tip_x = outputs->tip_x + model->length[j] * cos(state->angle[j]);
        outputs->tip_y = outputs->tip_y + model->length[j] * sin(state->angle[j]);
    }

    /* Output hub: angle. */
    outputs->hub = state->hub_angle;

    /* Output elbow: torque. */
    outputs->elbow = model->damping[1] * (state->rate[1] - state->rate[0])
        + model->stiffness[1] * (state->angle[1] - state->angle[0]);
}

/**
 * gripper: Gripper with two fingers on a flexible wrist
 *
 * Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: c8f8226e93fd9d4e49ccbb14a6d21dfabaa9c32be55619277914a499c6eae156
 * sha256 of the rest of this file: 15c01d1fa0d3b9d941c7c824bb6f8ed31822c2117773a85c8122c009783c60bb
 *
 * model: planar arm, large rotations, gravity
 * stations: 8
 * base: clamp
 * integrator: Newmark 1959, beta = 0.25, gamma = 0.5
 * linearisation: newton
 * sweep: riccati
 * unknown: acceleration
 * joints in arrays, from 0: left 4, left_hinge 5, right 6, right_hinge 7
 * links in arrays, from 0: wrist 0 to 3, left_finger 4, left_pad 5, right_finger 6, right_pad 7
 * operations of a step: 892, 111.5 per station (404 additions, 464 multiplications, 8 divisions, 16 sines and
 *     cosines)
 * operations of prepare: 148, 18.5 per station (42 additions, 106 multiplications)
 * number type: double
 * bytes of the structs: params 584, model 616, state 192, inputs 16, outputs 48
 *
 * @file gripper.c
 */
#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(_M_FP_FAST) \
    || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "-Ofast and -ffast-math remove checks of this file: use -O3, or put -fno-fast-math behind them"
#endif

#include <float.h>
#include <math.h>
#include <stddef.h>

/* Members of the header below: no macro of a header above may have their names. */
#undef left_torque
#undef right_torque
#undef left_tip_x
#undef left_tip_y
#undef right_tip_x
#undef right_tip_y
#undef left
#undef right

#include "gripper.h"

typedef gripper_real real;

static int inputs_are_finite(const gripper_inputs *inputs)
{
    if (!isfinite(inputs->left_torque) || !isfinite(inputs->right_torque)) {
        return 0;
    }
    return 1;
}

void gripper_default_params(gripper_params *params)
{
    static const real length[] = {
        0.03, 0.03, 0.03, 0.03, 0.08, 0.04, 0.08, 0.04
    };
    static const real mass[] = {
        0.00885, 0.00885, 0.00885, 0.15885, 0.03, 0.01, 0.03, 0.01
    };
    static const real inertia[] = {
        6.6375e-07, 6.6375e-07, 6.6375e-07, 6.254406161473088e-05, 1.6e-05, 1.5e-06, 1.6e-05, 1.5e-06
    };
    static const real center[] = {
        0.5, 0.5, 0.5, 0.9721435316336167, 0.5, 0.5, 0.5, 0.5
    };
    static const real stiffness[] = {
        98.66666666666667, 49.333333333333336, 49.333333333333336, 49.333333333333336, 0.0, 0.4, 0.0, 0.4
    };
    static const real damping[] = {
        0.19733333333333333, 0.09866666666666667, 0.09866666666666667, 0.09866666666666667, 0.06, 0.001, 0.06,
        0.001
    };
    static const real rest[] = {
        0.0, 0.0, 0.0, 0.0, 0.0, -0.6, 0.0, 0.6
    };
    static const real rotor_inertia[] = {
        0.0, 0.0, 0.0, 0.0, 1e-07, 0.0, 1e-07, 0.0
    };
    static const real gear[] = {
        1.0, 1.0, 1.0, 1.0, 30.0, 1.0, 30.0, 1.0
    };
    if (params == NULL) {
        return;
    }
    for (int j = 0; j < GRIPPER_STATIONS; ++j) {
        params->length[j] = length[j];
    }
    for (int j = 0; j < GRIPPER_STATIONS; ++j) {
        params->mass[j] = mass[j];
    }
    for (int j = 0; j < GRIPPER_STATIONS; ++j) {
        params->inertia[j] = inertia[j];
    }
    for (int j = 0; j < GRIPPER_STATIONS; ++j) {
        params->center[j] = center[j];
    }
    for (int j = 0; j < GRIPPER_STATIONS; ++j) {
        params->stiffness[j] = stiffness[j];
    }
    for (int j = 0; j < GRIPPER_STATIONS; ++j) {
        params->damping[j] = damping[j];
    }
    for (int j = 0; j < GRIPPER_STATIONS; ++j) {
        params->rest[j] = rest[j];
    }
    for (int j = 0; j < GRIPPER_STATIONS; ++j) {
        params->rotor_inertia[j] = rotor_inertia[j];
    }
    for (int j = 0; j < GRIPPER_STATIONS; ++j) {
        params->gear[j] = gear[j];
    }
    params->gravity = 9.81;
}

gripper_status gripper_prepare(
    gripper_model *model,
    const gripper_params *params,
    gripper_real step)
{
    if (model == NULL || params == NULL) {
        return GRIPPER_NULL_POINTER;
    }
    if (!(step > 0.0) || !(step <= DBL_MAX)) {
        return GRIPPER_INVALID_STEP;
    }
    /* Infinities and NaN less themselves are NaN, all other numbers 0. */
    real lost = (params->gravity - params->gravity);
    for (int j = 0; j < GRIPPER_STATIONS; ++j) {
        lost += (params->length[j] - params->length[j]) + (params->mass[j] - params->mass[j])
            + (params->inertia[j] - params->inertia[j]) + (params->center[j] - params->center[j])
            + (params->stiffness[j] - params->stiffness[j]) + (params->damping[j] - params->damping[j])
            + (params->rest[j] - params->rest[j]) + (params->rotor_inertia[j] - params->rotor_inertia[j])
            + (params->gear[j] - params->gear[j]);
    }
    if (!(lost >= 0.0)) {
        return GRIPPER_NON_FINITE_INPUT;
    }

    /* Masses at the nodes between links, and what they leave over. */
    for (int j = 0; j < 7; ++j) {
        model->node_mass[j] = params->center[j] * params->mass[j]
            + params->mass[j + 1] * (1.0 - params->center[j + 1]);
    }
    model->node_mass[3] = params->center[3] * params->mass[3] + params->mass[4] * (1.0 - params->center[4])
        + params->mass[6] * (1.0 - params->center[6]);
    model->node_mass[5] = params->center[5] * params->mass[5];
    model->node_mass[7] = params->center[7] * params->mass[7];
    for (int j = 0; j < GRIPPER_STATIONS; ++j) {
        model->rod_inertia[j] = params->inertia[j]
            - params->center[j] * (params->length[j] * params->length[j]) * params->mass[j]
            * (1.0 - params->center[j]);
        model->armature[j] = params->gear[j] * params->gear[j] * params->rotor_inertia[j];
    }

    /* Factors of the sweep that do not change from step to step. */
    for (int j = GRIPPER_STATIONS - 1; j >= 7; --j) {
        model->joint_impedance[j] = 0.5 * params->damping[j] * step
            + 0.25 * (step * step) * params->stiffness[j];
    }
    for (int j = 6; j >= 6; --j) {
        model->joint_impedance[j] = model->armature[j] + 0.5 * params->damping[j] * step;
    }
    for (int j = 5; j >= 5; --j) {
        model->joint_impedance[j] = 0.5 * params->damping[j] * step
            + 0.25 * (step * step) * params->stiffness[j];
    }
    for (int j = 4; j >= 4; --j) {
        model->joint_impedance[j] = model->armature[j] + 0.5 * params->damping[j] * step;
    }
    for (int j = 3; j >= 0; --j) {
        model->joint_impedance[j] = 0.5 * params->damping[j] * step
            + 0.25 * (step * step) * params->stiffness[j];
    }

    /* Factors of the step that depend on the time step and parameters alone. */
    model->half_step_squared = 0.5 * (step * step);
    model->angle_per_acceleration = 0.25 * (step * step);
    model->rate_per_acceleration = 0.5 * step;

    /* What the step needs as it is. */
    model->step = step;
    for (int j = 0; j < GRIPPER_STATIONS; ++j) {
        model->length[j] = params->length[j];
    }
    for (int j = 0; j < GRIPPER_STATIONS; ++j) {
        model->stiffness[j] = params->stiffness[j];
    }
    for (int j = 0; j < GRIPPER_STATIONS; ++j) {
        model->damping[j] = params->damping[j];
    }
    for (int j = 0; j < GRIPPER_STATIONS; ++j) {
        model->rest[j] = params->rest[j];
    }
    for (int j = 0; j < GRIPPER_STATIONS; ++j) {
        model->gear[j] = params->gear[j];
    }
    model->gravity = params->gravity;

    real total = 0.0; /* of the model: is all of it finite? */
    for (int j = 0; j < GRIPPER_STATIONS; ++j) {
        total += model->node_mass[j] + model->rod_inertia[j] + model->armature[j] + model->joint_impedance[j];
    }
    if (!isfinite(model->half_step_squared + model->angle_per_acceleration + model->rate_per_acceleration
        + total)) {
        return GRIPPER_NON_FINITE_MODEL;
    }
    return GRIPPER_OK;
}

/* The scene's angles to start from [rad]. */
static const real scene_initial_angle[GRIPPER_STATIONS] = {
    0.0, 0.0, 0.0, 0.0, 0.9, 0.3, -0.9, -0.3
};

gripper_status gripper_initialise(
    gripper_state *state,
    const gripper_params *params,
    const gripper_real initial_angle[GRIPPER_STATIONS],
    const gripper_real initial_rate[GRIPPER_STATIONS],
    const gripper_inputs *inputs)
{
    if (state == NULL || params == NULL || inputs == NULL) {
        return GRIPPER_NULL_POINTER;
    }
    if (!inputs_are_finite(inputs)) {
        return GRIPPER_NON_FINITE_INPUT;
    }
    for (int j = 0; j < GRIPPER_STATIONS; ++j) {
        if ((initial_angle != NULL && !isfinite(initial_angle[j]))
            || (initial_rate != NULL && !isfinite(initial_rate[j]))) {
            return GRIPPER_NON_FINITE_INPUT;
        }
    }

    real acceleration_x[GRIPPER_STATIONS + 1]; /* acceleration of the nodes along x [m/s^2] */
    real acceleration_y[GRIPPER_STATIONS + 1]; /* acceleration of the nodes along y [m/s^2] */
    real answer_own[GRIPPER_STATIONS]; /* unknown of a station if its inner side kept its motion */
    real answer_x[GRIPPER_STATIONS]; /* answer of the unknown to the joint's acceleration along x */
    real answer_y[GRIPPER_STATIONS]; /* answer of the unknown to the joint's acceleration along y */
    real drive[GRIPPER_STATIONS]; /* torque of each joint's motor [N m] */
    real lever_cosine[GRIPPER_STATIONS]; /* length times cosine of the angle [m] */
    real lever_sine[GRIPPER_STATIONS]; /* length times sine of the angle [m] */
    /* acceleration of base and links as predicted [rad/s^2] */
    real predicted_acceleration[GRIPPER_STATIONS + 1];
    real predicted_angle[GRIPPER_STATIONS + 1]; /* angle of base and links as predicted [rad] */
    real predicted_rate[GRIPPER_STATIONS + 1]; /* rate of base and links as predicted [rad/s] */
    /* acceleration of the outer end against the inner one along x [m/s^2] */
    real relative_x[GRIPPER_STATIONS];
    /* acceleration of the outer end against the inner one along y [m/s^2] */
    real relative_y[GRIPPER_STATIONS];
    real solved[GRIPPER_STATIONS]; /* unknown of each station */
    /* inertia of a joint's motor at the joint, between both sides [kg m^2] */
    real start_armature[GRIPPER_STATIONS];
    real start_node_mass[GRIPPER_STATIONS]; /* mass at the outer end of each link [kg] */
    /* inertia of a link that masses at its ends leave over [kg m^2] */
    real start_rod_inertia[GRIPPER_STATIONS];
    real transmission[GRIPPER_STATIONS]; /* share of motion and torque each joint passes on */
    real force_x; /* force beyond this joint [N] */
    real force_y; /* force beyond this joint [N] */
    real impedance_uu;
    real impedance_ux;
    real impedance_uy;
    real impedance_xu;
    real impedance_xx;
    real impedance_xy;
    real impedance_yu;
    real impedance_yx;
    real impedance_yy;
    real torque; /* force beyond this joint [N m] */
    real total = 0.0; /* of the new motion: is all of it finite? */

    /* Masses at the nodes between links, and what they leave over. */
    for (int j = 0; j < 7; ++j) {
        start_node_mass[j] = params->center[j] * params->mass[j]
            + params->mass[j + 1] * (1.0 - params->center[j + 1]);
    }
    start_node_mass[3] = params->center[3] * params->mass[3] + params->mass[4] * (1.0 - params->center[4])
        + params->mass[6] * (1.0 - params->center[6]);
    start_node_mass[5] = params->center[5] * params->mass[5];
    start_node_mass[7] = params->center[7] * params->mass[7];

    /* Predicted motion. */
    predicted_rate[0] = 0.0;
    predicted_angle[0] = 0.0;
    predicted_acceleration[0] = 0.0;

    /* Accelerations of the nodes, seen from a falling frame: gravity is the base's own. */
    real node_x = 0.0;
    real node_y = params->gravity;
    acceleration_x[0] = node_x;
    acceleration_y[0] = params->gravity;

    /* Masses at the nodes between links, and what they leave over; predicted motion; forces of the joints at
     * the motion so far. */
    for (int j = 0; j < GRIPPER_STATIONS; ++j) {
        start_rod_inertia[j] = params->inertia[j]
            - params->center[j] * (params->length[j] * params->length[j]) * params->mass[j]
            * (1.0 - params->center[j]);
        start_armature[j] = params->gear[j] * params->gear[j] * params->rotor_inertia[j];
        predicted_rate[j + 1] = (initial_rate != NULL ? initial_rate[j] : 0.0);
        predicted_angle[j + 1] = (initial_angle != NULL ? initial_angle[j] : scene_initial_angle[j]);
        predicted_acceleration[j + 1] = 0.0;
        drive[j] = 0.0;
    }

    /* Accelerations of the nodes, seen from a falling frame: gravity is the base's own. */
    for (int j = 0; j < GRIPPER_STATIONS; ++j) {
        lever_cosine[j] = params->length[j] * cos(predicted_angle[j + 1]);
        lever_sine[j] = params->length[j] * sin(predicted_angle[j + 1]);
        const real square = predicted_rate[j + 1] * predicted_rate[j + 1];
        relative_x[j] = -lever_cosine[j] * square - lever_sine[j] * predicted_acceleration[j + 1];
        relative_y[j] = lever_cosine[j] * predicted_acceleration[j + 1] - lever_sine[j] * square;
    }
    for (int j = 0; j < 6; ++j) {
        node_x = node_x + relative_x[j];
        node_y = node_y + relative_y[j];
        acceleration_x[j + 1] = node_x;
        acceleration_y[j + 1] = node_y;
    }
    node_x = acceleration_x[4];
    node_y = acceleration_y[4];
    for (int j = 6; j < GRIPPER_STATIONS; ++j) {
        node_x = node_x + relative_x[j];
        node_y = node_y + relative_y[j];
        acceleration_x[j + 1] = node_x;
        acceleration_y[j + 1] = node_y;
    }

    /* Forces of the joints at the motion so far; sweep inward: force beyond each joint as an affine function
     * of the motion at it. */
    drive[4] = inputs->left_torque;
    drive[6] = inputs->right_torque;
    for (int j = GRIPPER_STATIONS - 1; j >= 7; --j) {
        const real joint_torque = params->damping[j] * (predicted_rate[j] - predicted_rate[j + 1])
            + params->rest[j] * params->stiffness[j]
            + params->stiffness[j] * (predicted_angle[j] - predicted_angle[j + 1]);
        impedance_xx = start_node_mass[j];
        force_x = acceleration_x[j + 1] * start_node_mass[j];
        impedance_yy = start_node_mass[j];
        force_y = acceleration_y[j + 1] * start_node_mass[j];
        impedance_xu = -impedance_xx * lever_sine[j];
        impedance_yu = impedance_yy * lever_cosine[j];
        impedance_ux = -impedance_xx * lever_sine[j];
        impedance_uy = impedance_yy * lever_cosine[j];
        impedance_uu = start_rod_inertia[j] - impedance_xu * lever_sine[j] + impedance_yu * lever_cosine[j];
        torque = force_y * lever_cosine[j] - force_x * lever_sine[j]
            + predicted_acceleration[j + 1] * start_rod_inertia[j];
        if (!(impedance_uu > 0.0) || !(impedance_uu <= DBL_MAX)) {
            return GRIPPER_VANISHING_PIVOT;
        }
        const real admittance = 1.0 / impedance_uu;
        answer_own[j] = admittance * (joint_torque - torque);
        answer_x[j] = admittance * impedance_ux;
        answer_y[j] = admittance * impedance_uy;
        impedance_xx = start_node_mass[j] - answer_x[j] * impedance_xu;
        impedance_xy = -answer_y[j] * impedance_xu;
        force_x = force_x + answer_own[j] * impedance_xu;
        impedance_yx = -answer_x[j] * impedance_yu;
        impedance_yy = start_node_mass[j] - answer_y[j] * impedance_yu;
        force_y = force_y + answer_own[j] * impedance_yu;
        torque = joint_torque;
    }
    for (int j = 6; j >= 6; --j) {
        const real joint_torque = params->damping[j] * (predicted_rate[4] - predicted_rate[j + 1])
            + drive[j] * params->gear[j]
            + start_armature[j] * (predicted_acceleration[4] - predicted_acceleration[j + 1]);
        impedance_xx = impedance_xx + start_node_mass[j];
        force_x = force_x + acceleration_x[j + 1] * start_node_mass[j];
        impedance_yy = impedance_yy + start_node_mass[j];
        force_y = force_y + acceleration_y[j + 1] * start_node_mass[j];
        impedance_xu = impedance_xy * lever_cosine[j] - impedance_xx * lever_sine[j];
        impedance_yu = impedance_yy * lever_cosine[j] - impedance_yx * lever_sine[j];
        impedance_ux = impedance_yx * lever_cosine[j] - impedance_xx * lever_sine[j];
        impedance_uy = impedance_yy * lever_cosine[j] - impedance_xy * lever_sine[j];
        impedance_uu = start_rod_inertia[j] - impedance_xu * lever_sine[j] + impedance_yu * lever_cosine[j];
        torque = torque - force_x * lever_sine[j] + force_y * lever_cosine[j]
            + predicted_acceleration[j + 1] * start_rod_inertia[j];
        const real pivot = impedance_uu + start_armature[j];
        if (!(pivot > 0.0) || !(pivot <= DBL_MAX)) {
            return GRIPPER_VANISHING_PIVOT;
        }
        const real admittance = 1.0 / pivot;
        answer_own[j] = admittance * (joint_torque - torque);
        answer_x[j] = admittance * impedance_ux;
        answer_y[j] = admittance * impedance_uy;
        transmission[j] = admittance * start_armature[j];
        impedance_xx = impedance_xx - answer_x[j] * impedance_xu;
        impedance_xy = impedance_xy - answer_y[j] * impedance_xu;
        force_x = force_x + answer_own[j] * impedance_xu;
        impedance_xu = impedance_xu * transmission[j];
        impedance_yx = impedance_yx - answer_x[j] * impedance_yu;
        impedance_yy = impedance_yy - answer_y[j] * impedance_yu;
        force_y = force_y + answer_own[j] * impedance_yu;
        impedance_yu = impedance_yu * transmission[j];
        impedance_ux = answer_x[j] * start_armature[j];
        impedance_uy = answer_y[j] * start_armature[j];
        impedance_uu = impedance_uu * transmission[j];
        torque = joint_torque - answer_own[j] * start_armature[j];
    }
    const real impedance_xx_of_branch_7 = impedance_xx;
    const real impedance_xy_of_branch_7 = impedance_xy;
    const real impedance_xu_of_branch_7 = impedance_xu;
    const real impedance_yx_of_branch_7 = impedance_yx;
    const real impedance_yy_of_branch_7 = impedance_yy;
    const real impedance_yu_of_branch_7 = impedance_yu;
    const real impedance_ux_of_branch_7 = impedance_ux;
    const real impedance_uy_of_branch_7 = impedance_uy;
    const real impedance_uu_of_branch_7 = impedance_uu;
    const real force_x_of_branch_7 = force_x;
    const real force_y_of_branch_7 = force_y;
    const real torque_of_branch_7 = torque;
    for (int j = 5; j >= 5; --j) {
        const real joint_torque = params->damping[j] * (predicted_rate[j] - predicted_rate[j + 1])
            + params->rest[j] * params->stiffness[j]
            + params->stiffness[j] * (predicted_angle[j] - predicted_angle[j + 1]);
        impedance_xx = start_node_mass[j];
        force_x = acceleration_x[j + 1] * start_node_mass[j];
        impedance_yy = start_node_mass[j];
        force_y = acceleration_y[j + 1] * start_node_mass[j];
        impedance_xu = -impedance_xx * lever_sine[j];
        impedance_yu = impedance_yy * lever_cosine[j];
        impedance_ux = -impedance_xx * lever_sine[j];
        impedance_uy = impedance_yy * lever_cosine[j];
        impedance_uu = start_rod_inertia[j] - impedance_xu * lever_sine[j] + impedance_yu * lever_cosine[j];
        torque = force_y * lever_cosine[j] - force_x * lever_sine[j]
            + predicted_acceleration[j + 1] * start_rod_inertia[j];
        if (!(impedance_uu > 0.0) || !(impedance_uu <= DBL_MAX)) {
            return GRIPPER_VANISHING_PIVOT;
        }
        const real admittance = 1.0 / impedance_uu;
        answer_own[j] = admittance * (joint_torque - torque);
        answer_x[j] = admittance * impedance_ux;
        answer_y[j] = admittance * impedance_uy;
        impedance_xx = start_node_mass[j] - answer_x[j] * impedance_xu;
        impedance_xy = -answer_y[j] * impedance_xu;
        force_x = force_x + answer_own[j] * impedance_xu;
        impedance_yx = -answer_x[j] * impedance_yu;
        impedance_yy = start_node_mass[j] - answer_y[j] * impedance_yu;
        force_y = force_y + answer_own[j] * impedance_yu;
        torque = joint_torque;
    }
    for (int j = 4; j >= 4; --j) {
        const real joint_torque = params->damping[j] * (predicted_rate[j] - predicted_rate[j + 1])
            + drive[j] * params->gear[j]
            + start_armature[j] * (predicted_acceleration[j] - predicted_acceleration[j + 1]);
        impedance_xx = impedance_xx + start_node_mass[j];
        force_x = force_x + acceleration_x[j + 1] * start_node_mass[j];
        impedance_yy = impedance_yy + start_node_mass[j];
        force_y = force_y + acceleration_y[j + 1] * start_node_mass[j];
        impedance_xu = impedance_xy * lever_cosine[j] - impedance_xx * lever_sine[j];
        impedance_yu = impedance_yy * lever_cosine[j] - impedance_yx * lever_sine[j];
        impedance_ux = impedance_yx * lever_cosine[j] - impedance_xx * lever_sine[j];
        impedance_uy = impedance_yy * lever_cosine[j] - impedance_xy * lever_sine[j];
        impedance_uu = start_rod_inertia[j] - impedance_xu * lever_sine[j] + impedance_yu * lever_cosine[j];
        torque = torque - force_x * lever_sine[j] + force_y * lever_cosine[j]
            + predicted_acceleration[j + 1] * start_rod_inertia[j];
        const real pivot = impedance_uu + start_armature[j];
        if (!(pivot > 0.0) || !(pivot <= DBL_MAX)) {
            return GRIPPER_VANISHING_PIVOT;
        }
        const real admittance = 1.0 / pivot;
        answer_own[j] = admittance * (joint_torque - torque);
        answer_x[j] = admittance * impedance_ux;
        answer_y[j] = admittance * impedance_uy;
        transmission[j] = admittance * start_armature[j];
        impedance_xx = impedance_xx - answer_x[j] * impedance_xu;
        impedance_xy = impedance_xy - answer_y[j] * impedance_xu;
        force_x = force_x + answer_own[j] * impedance_xu;
        impedance_xu = impedance_xu * transmission[j];
        impedance_yx = impedance_yx - answer_x[j] * impedance_yu;
        impedance_yy = impedance_yy - answer_y[j] * impedance_yu;
        force_y = force_y + answer_own[j] * impedance_yu;
        impedance_yu = impedance_yu * transmission[j];
        impedance_ux = answer_x[j] * start_armature[j];
        impedance_uy = answer_y[j] * start_armature[j];
        impedance_uu = impedance_uu * transmission[j];
        torque = joint_torque - answer_own[j] * start_armature[j];
    }
    impedance_xx = impedance_xx + impedance_xx_of_branch_7;
    impedance_xy = impedance_xy + impedance_xy_of_branch_7;
    impedance_xu = impedance_xu + impedance_xu_of_branch_7;
    impedance_yx = impedance_yx + impedance_yx_of_branch_7;
    impedance_yy = impedance_yy + impedance_yy_of_branch_7;
    impedance_yu = impedance_yu + impedance_yu_of_branch_7;
    impedance_ux = impedance_ux + impedance_ux_of_branch_7;
    impedance_uy = impedance_uy + impedance_uy_of_branch_7;
    impedance_uu = impedance_uu + impedance_uu_of_branch_7;
    force_x = force_x + force_x_of_branch_7;
    force_y = force_y + force_y_of_branch_7;
    torque = torque + torque_of_branch_7;
    for (int j = 3; j >= 0; --j) {
        const real joint_torque = params->damping[j] * (predicted_rate[j] - predicted_rate[j + 1])
            + params->stiffness[j] * (predicted_angle[j] - predicted_angle[j + 1]);
        impedance_xx = impedance_xx + start_node_mass[j];
        force_x = force_x + acceleration_x[j + 1] * start_node_mass[j];
        impedance_yy = impedance_yy + start_node_mass[j];
        force_y = force_y + acceleration_y[j + 1] * start_node_mass[j];
        impedance_xu = impedance_xu - impedance_xx * lever_sine[j] + impedance_xy * lever_cosine[j];
        impedance_yu = impedance_yu - impedance_yx * lever_sine[j] + impedance_yy * lever_cosine[j];
        impedance_uu = impedance_uu - impedance_ux * lever_sine[j] + impedance_uy * lever_cosine[j];
        impedance_ux = impedance_ux - impedance_xx * lever_sine[j] + impedance_yx * lever_cosine[j];
        impedance_uy = impedance_uy - impedance_xy * lever_sine[j] + impedance_yy * lever_cosine[j];
        impedance_uu = impedance_uu + start_rod_inertia[j] - impedance_xu * lever_sine[j]
            + impedance_yu * lever_cosine[j];
        torque = torque - force_x * lever_sine[j] + force_y * lever_cosine[j]
            + predicted_acceleration[j + 1] * start_rod_inertia[j];
        if (!(impedance_uu > 0.0) || !(impedance_uu <= DBL_MAX)) {
            return GRIPPER_VANISHING_PIVOT;
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
        impedance_ux = 0.0;
        impedance_uy = 0.0;
        impedance_xu = 0.0;
        impedance_yu = 0.0;
    }

    /* The base. */
    real unknown = 0.0;

    /* Sweep outward: the unknown of each station. */
    real change_x = 0.0;
    real change_y = 0.0;
    for (int j = 0; j < 4; ++j) {
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y;
        change_x = change_x - lever_sine[j] * unknown;
        change_y = change_y + lever_cosine[j] * unknown;
        solved[j] = unknown;
    }
    const real change_x_at_fork_4 = change_x;
    const real change_y_at_fork_4 = change_y;
    for (int j = 4; j < 5; ++j) {
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y + transmission[j] * unknown;
        change_x = change_x - lever_sine[j] * unknown;
        change_y = change_y + lever_cosine[j] * unknown;
        solved[j] = unknown;
    }
    for (int j = 5; j < 6; ++j) {
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y;
        change_x = change_x - lever_sine[j] * unknown;
        change_y = change_y + lever_cosine[j] * unknown;
        solved[j] = unknown;
    }
    change_x = change_x_at_fork_4;
    change_y = change_y_at_fork_4;
    unknown = solved[3];
    for (int j = 6; j < 7; ++j) {
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y + transmission[j] * unknown;
        change_x = change_x - lever_sine[j] * unknown;
        change_y = change_y + lever_cosine[j] * unknown;
        solved[j] = unknown;
    }
    for (int j = 7; j < GRIPPER_STATIONS; ++j) {
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y;
        change_x = change_x - lever_sine[j] * unknown;
        change_y = change_y + lever_cosine[j] * unknown;
        solved[j] = unknown;
    }

    /* Motion at the end of the step. */
    for (int j = 0; j < GRIPPER_STATIONS; ++j) {
        state->angle[j] = predicted_angle[j + 1];
        state->rate[j] = predicted_rate[j + 1];
        state->acceleration[j] = predicted_acceleration[j + 1] + solved[j];
        total += state->angle[j] + state->rate[j] + state->acceleration[j];
    }

    if (!isfinite(total)) {
        return GRIPPER_NON_FINITE_STATE;
    }
    return GRIPPER_OK;
}

gripper_status gripper_step(
    const gripper_model *model,
    gripper_state *state,
    const gripper_inputs *inputs)
{
    if (model == NULL || state == NULL || inputs == NULL) {
        return GRIPPER_NULL_POINTER;
    }
    if (!inputs_are_finite(inputs)) {
        return GRIPPER_NON_FINITE_INPUT;
    }

    const real step = model->step;
    const real half_step_squared = model->half_step_squared;
    const real angle_per_acceleration = model->angle_per_acceleration;
    const real rate_per_acceleration = model->rate_per_acceleration;
    real acceleration_x[GRIPPER_STATIONS + 1]; /* acceleration of the nodes along x [m/s^2] */
    real acceleration_y[GRIPPER_STATIONS + 1]; /* acceleration of the nodes along y [m/s^2] */
    real answer_own[GRIPPER_STATIONS]; /* unknown of a station if its inner side kept its motion */
    real answer_x[GRIPPER_STATIONS]; /* answer of the unknown to the joint's acceleration along x */
    real answer_y[GRIPPER_STATIONS]; /* answer of the unknown to the joint's acceleration along y */
    real drive[GRIPPER_STATIONS]; /* torque of each joint's motor [N m] */
    real lever_cosine[GRIPPER_STATIONS]; /* length times cosine of the angle [m] */
    real lever_sine[GRIPPER_STATIONS]; /* length times sine of the angle [m] */
    /* acceleration of base and links as predicted [rad/s^2] */
    real predicted_acceleration[GRIPPER_STATIONS + 1];
    real predicted_angle[GRIPPER_STATIONS + 1]; /* angle of base and links as predicted [rad] */
    real predicted_rate[GRIPPER_STATIONS + 1]; /* rate of base and links as predicted [rad/s] */
    /* acceleration of the outer end against the inner one along x [m/s^2] */
    real relative_x[GRIPPER_STATIONS];
    /* acceleration of the outer end against the inner one along y [m/s^2] */
    real relative_y[GRIPPER_STATIONS];
    real solved[GRIPPER_STATIONS]; /* unknown of each station */
    real swing_x[GRIPPER_STATIONS]; /* change of the outer end's acceleration along x per unknown [m] */
    real swing_y[GRIPPER_STATIONS]; /* change of the outer end's acceleration along y per unknown [m] */
    real transmission[GRIPPER_STATIONS]; /* share of motion and torque each joint passes on */
    real force_x; /* force beyond this joint [N] */
    real force_y; /* force beyond this joint [N] */
    real impedance_uu;
    real impedance_ux;
    real impedance_uy;
    real impedance_xu;
    real impedance_xx;
    real impedance_xy;
    real impedance_yu;
    real impedance_yx;
    real impedance_yy;
    real torque; /* force beyond this joint [N m] */
    real total = 0.0; /* of the new motion: is all of it finite? */

    /* Predicted motion. */
    predicted_rate[0] = 0.0;
    predicted_angle[0] = 0.0;
    predicted_acceleration[0] = 0.0;

    /* Accelerations of the nodes, seen from a falling frame: gravity is the base's own. */
    real node_x = 0.0;
    real node_y = model->gravity;
    acceleration_x[0] = node_x;
    acceleration_y[0] = model->gravity;

    /* Predicted motion; forces of the joints at the motion so far. */
    for (int j = 0; j < GRIPPER_STATIONS; ++j) {
        predicted_rate[j + 1] = state->rate[j] + state->acceleration[j] * step;
        predicted_angle[j + 1] = state->angle[j] + state->acceleration[j] * half_step_squared
            + state->rate[j] * step;
        predicted_acceleration[j + 1] = state->acceleration[j];
        drive[j] = 0.0;
    }

    /* Accelerations of the nodes, seen from a falling frame: gravity is the base's own. */
    for (int j = 0; j < GRIPPER_STATIONS; ++j) {
        lever_cosine[j] = model->length[j] * cos(predicted_angle[j + 1]);
        lever_sine[j] = model->length[j] * sin(predicted_angle[j + 1]);
        const real square = predicted_rate[j + 1] * predicted_rate[j + 1];
        relative_x[j] = -lever_cosine[j] * square - lever_sine[j] * predicted_acceleration[j + 1];
        relative_y[j] = lever_cosine[j] * predicted_acceleration[j + 1] - lever_sine[j] * square;
        const real turning = predicted_rate[j + 1] * step;
        swing_x[j] = -lever_sine[j] - angle_per_acceleration * relative_y[j] - lever_cosine[j] * turning;
        swing_y[j] = lever_cosine[j] + angle_per_acceleration * relative_x[j] - lever_sine[j] * turning;
    }
    for (int j = 0; j < 6; ++j) {
        node_x = node_x + relative_x[j];
        node_y = node_y + relative_y[j];
        acceleration_x[j + 1] = node_x;
        acceleration_y[j + 1] = node_y;
    }
    node_x = acceleration_x[4];
    node_y = acceleration_y[4];
    for (int j = 6; j < GRIPPER_STATIONS; ++j) {
        node_x = node_x + relative_x[j];
        node_y = node_y + relative_y[j];
        acceleration_x[j + 1] = node_x;
        acceleration_y[j + 1] = node_y;
    }

    /* Forces of the joints at the motion so far; sweep inward: force beyond each joint as an affine function
     * of the motion at it. */
    drive[4] = inputs->left_torque;
    drive[6] = inputs->right_torque;
    for (int j = GRIPPER_STATIONS - 1; j >= 7; --j) {
        const real joint_torque = model->damping[j] * (predicted_rate[j] - predicted_rate[j + 1])
            + model->rest[j] * model->stiffness[j]
            + model->stiffness[j] * (predicted_angle[j] - predicted_angle[j + 1]);
        impedance_xx = model->node_mass[j];
        force_x = acceleration_x[j + 1] * model->node_mass[j];
        impedance_yy = model->node_mass[j];
        force_y = acceleration_y[j + 1] * model->node_mass[j];
        impedance_xu = model->node_mass[j] * swing_x[j];
        impedance_yu = model->node_mass[j] * swing_y[j];
        impedance_ux = -impedance_xx * lever_sine[j];
        impedance_uy = impedance_yy * lever_cosine[j];
        impedance_uu = model->rod_inertia[j]
            + lever_cosine[j] * (impedance_yu - angle_per_acceleration * force_x)
            + lever_sine[j] * (-impedance_xu - angle_per_acceleration * force_y);
        torque = force_y * lever_cosine[j] - force_x * lever_sine[j]
            + predicted_acceleration[j + 1] * model->rod_inertia[j];
        const real pivot = impedance_uu + model->joint_impedance[j];
        if (!(pivot > 0.0) || !(pivot <= DBL_MAX)) {
            return GRIPPER_VANISHING_PIVOT;
        }
        const real admittance = 1.0 / pivot;
        answer_own[j] = admittance * (joint_torque - torque);
        answer_x[j] = admittance * impedance_ux;
        answer_y[j] = admittance * impedance_uy;
        transmission[j] = admittance * model->joint_impedance[j];
        impedance_xx = model->node_mass[j] - answer_x[j] * impedance_xu;
        impedance_xy = -answer_y[j] * impedance_xu;
        force_x = force_x + answer_own[j] * impedance_xu;
        impedance_xu = impedance_xu * transmission[j];
        impedance_yx = -answer_x[j] * impedance_yu;
        impedance_yy = model->node_mass[j] - answer_y[j] * impedance_yu;
        force_y = force_y + answer_own[j] * impedance_yu;
        impedance_yu = impedance_yu * transmission[j];
        impedance_ux = answer_x[j] * model->joint_impedance[j];
        impedance_uy = answer_y[j] * model->joint_impedance[j];
        impedance_uu = impedance_uu * transmission[j];
        torque = joint_torque - answer_own[j] * model->joint_impedance[j];
    }
    for (int j = 6; j >= 6; --j) {
        const real joint_torque = model->armature[j]
            * (predicted_acceleration[4] - predicted_acceleration[j + 1])
            + model->damping[j] * (predicted_rate[4] - predicted_rate[j + 1]) + drive[j] * model->gear[j];
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
        torque = torque - force_x * lever_sine[j] + force_y * lever_cosine[j]
            + predicted_acceleration[j + 1] * model->rod_inertia[j];
        const real pivot = impedance_uu + model->joint_impedance[j];
        if (!(pivot > 0.0) || !(pivot <= DBL_MAX)) {
            return GRIPPER_VANISHING_PIVOT;
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
    const real impedance_xx_of_branch_7 = impedance_xx;
    const real impedance_xy_of_branch_7 = impedance_xy;
    const real impedance_xu_of_branch_7 = impedance_xu;
    const real impedance_yx_of_branch_7 = impedance_yx;
    const real impedance_yy_of_branch_7 = impedance_yy;
    const real impedance_yu_of_branch_7 = impedance_yu;
    const real impedance_ux_of_branch_7 = impedance_ux;
    const real impedance_uy_of_branch_7 = impedance_uy;
    const real impedance_uu_of_branch_7 = impedance_uu;
    const real force_x_of_branch_7 = force_x;
    const real force_y_of_branch_7 = force_y;
    const real torque_of_branch_7 = torque;
    for (int j = 5; j >= 5; --j) {
        const real joint_torque = model->damping[j] * (predicted_rate[j] - predicted_rate[j + 1])
            + model->rest[j] * model->stiffness[j]
            + model->stiffness[j] * (predicted_angle[j] - predicted_angle[j + 1]);
        impedance_xx = model->node_mass[j];
        force_x = acceleration_x[j + 1] * model->node_mass[j];
        impedance_yy = model->node_mass[j];
        force_y = acceleration_y[j + 1] * model->node_mass[j];
        impedance_xu = model->node_mass[j] * swing_x[j];
        impedance_yu = model->node_mass[j] * swing_y[j];
        impedance_ux = -impedance_xx * lever_sine[j];
        impedance_uy = impedance_yy * lever_cosine[j];
        impedance_uu = model->rod_inertia[j]
            + lever_cosine[j] * (impedance_yu - angle_per_acceleration * force_x)
            + lever_sine[j] * (-impedance_xu - angle_per_acceleration * force_y);
        torque = force_y * lever_cosine[j] - force_x * lever_sine[j]
            + predicted_acceleration[j + 1] * model->rod_inertia[j];
        const real pivot = impedance_uu + model->joint_impedance[j];
        if (!(pivot > 0.0) || !(pivot <= DBL_MAX)) {
            return GRIPPER_VANISHING_PIVOT;
        }
        const real admittance = 1.0 / pivot;
        answer_own[j] = admittance * (joint_torque - torque);
        answer_x[j] = admittance * impedance_ux;
        answer_y[j] = admittance * impedance_uy;
        transmission[j] = admittance * model->joint_impedance[j];
        impedance_xx = model->node_mass[j] - answer_x[j] * impedance_xu;
        impedance_xy = -answer_y[j] * impedance_xu;
        force_x = force_x + answer_own[j] * impedance_xu;
        impedance_xu = impedance_xu * transmission[j];
        impedance_yx = -answer_x[j] * impedance_yu;
        impedance_yy = model->node_mass[j] - answer_y[j] * impedance_yu;
        force_y = force_y + answer_own[j] * impedance_yu;
        impedance_yu = impedance_yu * transmission[j];
        impedance_ux = answer_x[j] * model->joint_impedance[j];
        impedance_uy = answer_y[j] * model->joint_impedance[j];
        impedance_uu = impedance_uu * transmission[j];
        torque = joint_torque - answer_own[j] * model->joint_impedance[j];
    }
    for (int j = 4; j >= 4; --j) {
        const real joint_torque = model->armature[j]
            * (predicted_acceleration[j] - predicted_acceleration[j + 1])
            + model->damping[j] * (predicted_rate[j] - predicted_rate[j + 1]) + drive[j] * model->gear[j];
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
        torque = torque - force_x * lever_sine[j] + force_y * lever_cosine[j]
            + predicted_acceleration[j + 1] * model->rod_inertia[j];
        const real pivot = impedance_uu + model->joint_impedance[j];
        if (!(pivot > 0.0) || !(pivot <= DBL_MAX)) {
            return GRIPPER_VANISHING_PIVOT;
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
    impedance_xx = impedance_xx + impedance_xx_of_branch_7;
    impedance_xy = impedance_xy + impedance_xy_of_branch_7;
    impedance_xu = impedance_xu + impedance_xu_of_branch_7;
    impedance_yx = impedance_yx + impedance_yx_of_branch_7;
    impedance_yy = impedance_yy + impedance_yy_of_branch_7;
    impedance_yu = impedance_yu + impedance_yu_of_branch_7;
    impedance_ux = impedance_ux + impedance_ux_of_branch_7;
    impedance_uy = impedance_uy + impedance_uy_of_branch_7;
    impedance_uu = impedance_uu + impedance_uu_of_branch_7;
    force_x = force_x + force_x_of_branch_7;
    force_y = force_y + force_y_of_branch_7;
    torque = torque + torque_of_branch_7;
    for (int j = 3; j >= 0; --j) {
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
        torque = torque - force_x * lever_sine[j] + force_y * lever_cosine[j]
            + predicted_acceleration[j + 1] * model->rod_inertia[j];
        const real pivot = impedance_uu + model->joint_impedance[j];
        if (!(pivot > 0.0) || !(pivot <= DBL_MAX)) {
            return GRIPPER_VANISHING_PIVOT;
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

    /* Sweep outward: the unknown of each station. */
    real change_x = 0.0;
    real change_y = 0.0;
    for (int j = 0; j < 4; ++j) {
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y + transmission[j] * unknown;
        change_x = change_x + swing_x[j] * unknown;
        change_y = change_y + swing_y[j] * unknown;
        solved[j] = unknown;
    }
    const real change_x_at_fork_4 = change_x;
    const real change_y_at_fork_4 = change_y;
    for (int j = 4; j < 6; ++j) {
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y + transmission[j] * unknown;
        change_x = change_x + swing_x[j] * unknown;
        change_y = change_y + swing_y[j] * unknown;
        solved[j] = unknown;
    }
    change_x = change_x_at_fork_4;
    change_y = change_y_at_fork_4;
    unknown = solved[3];
    for (int j = 6; j < GRIPPER_STATIONS; ++j) {
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y + transmission[j] * unknown;
        change_x = change_x + swing_x[j] * unknown;
        change_y = change_y + swing_y[j] * unknown;
        solved[j] = unknown;
    }

    /* Motion at the end of the step. */
    for (int j = 0; j < GRIPPER_STATIONS; ++j) {
        state->angle[j] = predicted_angle[j + 1] + angle_per_acceleration * solved[j];
        state->rate[j] = predicted_rate[j + 1] + rate_per_acceleration * solved[j];
        state->acceleration[j] = predicted_acceleration[j + 1] + solved[j];
        total += state->angle[j] + state->rate[j] + state->acceleration[j];
    }

    if (!isfinite(total)) {
        return GRIPPER_NON_FINITE_STATE;
    }
    return GRIPPER_OK;
}

void gripper_output(
    const gripper_model *model,
    const gripper_state *state,
    gripper_outputs *outputs)
{
    if (model == NULL || state == NULL || outputs == NULL) {
        return;
    }
    /* Output left_tip: position. */
    outputs->left_tip_x = 0.0;
    outputs->left_tip_y = 0.0;

    /* Output left_tip: position; output right_tip: position. */
    outputs->right_tip_x = 0.0;
    outputs->right_tip_y = 0.0;
    for (int j = 0; j < 4; ++j) {
        outputs->left_tip_x = outputs->left_tip_x + model->length[j] * cos(state->angle[j]);
        outputs->left_tip_y = outputs->left_tip_y + model->length[j] * sin(state->angle[j]);
        outputs->right_tip_x = outputs->right_tip_x + model->length[j] * cos(state->angle[j]);
        outputs->right_tip_y = outputs->right_tip_y + model->length[j] * sin(state->angle[j]);
    }
    for (int j = 4; j < 6; ++j) {
        outputs->left_tip_x = outputs->left_tip_x + model->length[j] * cos(state->angle[j]);
        outputs->left_tip_y = outputs->left_tip_y + model->length[j] * sin(state->angle[j]);
    }
    for (int j = 6; j < GRIPPER_STATIONS; ++j) {
        outputs->right_tip_x = outputs->right_tip_x + model->length[j] * cos(state->angle[j]);
        outputs->right_tip_y = outputs->right_tip_y + model->length[j] * sin(state->angle[j]);
    }

    /* Output left: joint angle. */
    outputs->left = state->angle[4] - state->angle[3];

    /* Output right: joint angle. */
    outputs->right = state->angle[6] - state->angle[3];
}

/**
 * elbow: Flexible arm with motors at shoulder and elbow
 *
 * Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: b7474d2f501b0139799e3f1e1a14aa2a3a455ea0221cabb6918551519b3600d0
 * sha256 of the rest of this file: a4055bb2a209b1cbcbf9a2f93fafbc537d104ce17419d48b38a957a4870b5ae3
 *
 * model: planar arm, large rotations, gravity, tip mass
 * stations: 12
 * base: clamp
 * integrator: Newmark 1959, beta = 0.25, gamma = 0.5
 * linearisation: newton
 * sweep: riccati
 * unknown: acceleration
 * joints in arrays, from 0: shoulder 0, elbow 6
 * links in arrays, from 0: upper 0 to 5, forearm 6 to 11
 * operations of a step: 1385, 115.4 per station (638 additions, 711 multiplications, 12 divisions, 24 sines
 *     and cosines)
 * operations of prepare: 213, 17.75 per station (59 additions, 154 multiplications)
 * number type: double
 * bytes of the structs: params 792, model 816, state 288, inputs 16, outputs 32
 *
 * @file elbow.c
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
#undef shoulder_torque
#undef elbow_torque
#undef payload_x
#undef payload_y
#undef shoulder
#undef elbow

#include "elbow.h"

typedef elbow_real real;

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

static int inputs_are_finite(const elbow_inputs *inputs)
{
    if (!isfinite(inputs->shoulder_torque) || !isfinite(inputs->elbow_torque)) {
        return 0;
    }
    return 1;
}

void elbow_default_params(elbow_params *params)
{
    static const real length[] = {
        0.05, 0.1, 0.1, 0.1, 0.1, 0.05, 0.04, 0.08, 0.08, 0.08, 0.08, 0.04
    };
    static const real mass[] = {
        0.0162, 0.0324, 0.0324, 0.0324, 0.0324, 0.2662, 0.00648, 0.01296, 0.01296, 0.01296, 0.01296, 0.00648
    };
    static const real inertia[] = {
        3.375e-06, 2.7e-05, 2.7e-05, 2.7e-05, 2.7e-05, 0.0001128838279489106, 8.64e-07, 6.912e-06, 6.912e-06,
        6.912e-06, 6.912e-06, 8.64e-07
    };
    static const real center[] = {
        0.5, 0.5, 0.5, 0.5, 0.5, 0.9695717505634861, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5
    };
    static const real stiffness[] = {
        0.0, 112.0, 112.0, 112.0, 112.0, 112.0, 0.0, 39.375, 39.375, 39.375, 39.375, 39.375
    };
    static const real damping[] = {
        0.5, 0.224, 0.224, 0.224, 0.224, 0.224, 0.1, 0.07875, 0.07875, 0.07875, 0.07875, 0.07875
    };
    static const real rotor_inertia[] = {
        2e-05, 0.0, 0.0, 0.0, 0.0, 0.0, 1e-05, 0.0, 0.0, 0.0, 0.0, 0.0
    };
    static const real gear[] = {
        100.0, 1.0, 1.0, 1.0, 1.0, 1.0, 50.0, 1.0, 1.0, 1.0, 1.0, 1.0
    };
    if (params == NULL) {
        return;
    }
    for (int j = 0; j < ELBOW_STATIONS; ++j) {
        params->length[j] = length[j];
    }
    for (int j = 0; j < ELBOW_STATIONS; ++j) {
        params->mass[j] = mass[j];
    }
    for (int j = 0; j < ELBOW_STATIONS; ++j) {
        params->inertia[j] = inertia[j];
    }
    for (int j = 0; j < ELBOW_STATIONS; ++j) {
        params->center[j] = center[j];
    }
    for (int j = 0; j < ELBOW_STATIONS; ++j) {
        params->stiffness[j] = stiffness[j];
    }
    for (int j = 0; j < ELBOW_STATIONS; ++j) {
        params->damping[j] = damping[j];
    }
    for (int j = 0; j < ELBOW_STATIONS; ++j) {
        params->rotor_inertia[j] = rotor_inertia[j];
    }
    for (int j = 0; j < ELBOW_STATIONS; ++j) {
        params->gear[j] = gear[j];
    }
    params->gravity = 9.81;
    params->tip_mass = 0.3;
    params->tip_inertia = 0.0002;
}

elbow_status elbow_prepare(
    elbow_model *model,
    const elbow_params *params,
    elbow_real step)
{
    if (model == NULL || params == NULL) {
        return ELBOW_NULL_POINTER;
    }
    if (!(step > 0.0) || !(step <= DBL_MAX)) {
        return ELBOW_INVALID_STEP;
    }
    /* Infinities and NaN less themselves are NaN, all other numbers 0. */
    real lost = (params->gravity - params->gravity) + (params->tip_mass - params->tip_mass)
        + (params->tip_inertia - params->tip_inertia);
    for (int j = 0; j < ELBOW_STATIONS; ++j) {
        lost += (params->length[j] - params->length[j]) + (params->mass[j] - params->mass[j])
            + (params->inertia[j] - params->inertia[j]) + (params->center[j] - params->center[j])
            + (params->stiffness[j] - params->stiffness[j]) + (params->damping[j] - params->damping[j])
            + (params->rotor_inertia[j] - params->rotor_inertia[j]) + (params->gear[j] - params->gear[j]);
    }
    if (!(lost >= 0.0)) {
        return ELBOW_NON_FINITE_INPUT;
    }

    /* Masses at the nodes between links, and what they leave over. */
    for (int j = 0; j < 11; ++j) {
        model->node_mass[j] = params->center[j] * params->mass[j]
            + params->mass[j + 1] * (1.0 - params->center[j + 1]);
    }
    model->node_mass[11] = params->tip_mass + params->center[11] * params->mass[11];
    for (int j = 0; j < ELBOW_STATIONS; ++j) {
        model->rod_inertia[j] = params->inertia[j]
            - params->center[j] * (params->length[j] * params->length[j]) * params->mass[j]
            * (1.0 - params->center[j]);
        model->armature[j] = params->gear[j] * params->gear[j] * params->rotor_inertia[j];
    }

    /* Factors of the sweep that do not change from step to step. */
    for (int j = ELBOW_STATIONS - 1; j >= 7; --j) {
        model->joint_impedance[j] = 0.5 * params->damping[j] * step
            + 0.25 * (step * step) * params->stiffness[j];
    }
    for (int j = 6; j >= 6; --j) {
        model->joint_impedance[j] = model->armature[j] + 0.5 * params->damping[j] * step;
    }
    for (int j = 5; j >= 1; --j) {
        model->joint_impedance[j] = 0.5 * params->damping[j] * step
            + 0.25 * (step * step) * params->stiffness[j];
    }
    for (int j = 0; j >= 0; --j) {
        model->joint_impedance[j] = model->armature[j] + 0.5 * params->damping[j] * step;
    }

    /* Factors of the step that depend on the time step and parameters alone. */
    model->half_step_squared = 0.5 * (step * step);
    model->angle_per_acceleration = 0.25 * (step * step);
    model->rate_per_acceleration = 0.5 * step;

    /* What the step needs as it is. */
    model->step = step;
    for (int j = 0; j < ELBOW_STATIONS; ++j) {
        model->length[j] = params->length[j];
    }
    for (int j = 0; j < ELBOW_STATIONS; ++j) {
        model->stiffness[j] = params->stiffness[j];
    }
    for (int j = 0; j < ELBOW_STATIONS; ++j) {
        model->damping[j] = params->damping[j];
    }
    for (int j = 0; j < ELBOW_STATIONS; ++j) {
        model->gear[j] = params->gear[j];
    }
    model->gravity = params->gravity;
    model->tip_inertia = params->tip_inertia;

    real total = 0.0; /* of the model: is all of it finite? */
    for (int j = 0; j < ELBOW_STATIONS; ++j) {
        total += model->node_mass[j] + model->rod_inertia[j] + model->armature[j] + model->joint_impedance[j];
    }
    if (!isfinite(model->half_step_squared + model->angle_per_acceleration + model->rate_per_acceleration
        + total)) {
        return ELBOW_NON_FINITE_MODEL;
    }
    return ELBOW_OK;
}

elbow_status elbow_initialise(
    elbow_state *state,
    const elbow_params *params,
    const elbow_real initial_angle[ELBOW_STATIONS],
    const elbow_real initial_rate[ELBOW_STATIONS],
    const elbow_inputs *inputs)
{
    if (state == NULL || params == NULL || inputs == NULL) {
        return ELBOW_NULL_POINTER;
    }
    if (!inputs_are_finite(inputs)) {
        return ELBOW_NON_FINITE_INPUT;
    }
    for (int j = 0; j < ELBOW_STATIONS; ++j) {
        if ((initial_angle != NULL && !isfinite(initial_angle[j]))
            || (initial_rate != NULL && !isfinite(initial_rate[j]))) {
            return ELBOW_NON_FINITE_INPUT;
        }
    }

    real acceleration_x[ELBOW_STATIONS + 1]; /* acceleration of the nodes along x [m/s^2] */
    real acceleration_y[ELBOW_STATIONS + 1]; /* acceleration of the nodes along y [m/s^2] */
    real answer_own[ELBOW_STATIONS]; /* unknown of a station if its inner side kept its motion */
    real answer_x[ELBOW_STATIONS]; /* answer of the unknown to the joint's acceleration along x */
    real answer_y[ELBOW_STATIONS]; /* answer of the unknown to the joint's acceleration along y */
    real drive[ELBOW_STATIONS]; /* torque of each joint's motor [N m] */
    real lever_cosine[ELBOW_STATIONS]; /* length times cosine of the angle [m] */
    real lever_sine[ELBOW_STATIONS]; /* length times sine of the angle [m] */
    /* acceleration of base and links as predicted [rad/s^2] */
    real predicted_acceleration[ELBOW_STATIONS + 1];
    real predicted_angle[ELBOW_STATIONS + 1]; /* angle of base and links as predicted [rad] */
    real predicted_rate[ELBOW_STATIONS + 1]; /* rate of base and links as predicted [rad/s] */
    real relative_x[ELBOW_STATIONS]; /* acceleration of the outer end against the inner one along x [m/s^2] */
    real relative_y[ELBOW_STATIONS]; /* acceleration of the outer end against the inner one along y [m/s^2] */
    real solved[ELBOW_STATIONS]; /* unknown of each station */
    /* inertia of a joint's motor at the joint, between both sides [kg m^2] */
    real start_armature[ELBOW_STATIONS];
    real start_node_mass[ELBOW_STATIONS]; /* mass at the outer end of each link [kg] */
    /* inertia of a link that masses at its ends leave over [kg m^2] */
    real start_rod_inertia[ELBOW_STATIONS];
    real transmission[ELBOW_STATIONS]; /* share of motion and torque each joint passes on */
    real impedance_ux;
    real impedance_uy;
    real impedance_xu;
    real impedance_yu;
    real total = 0.0; /* of the new motion: is all of it finite? */

    /* Masses at the nodes between links, and what they leave over. */
    for (int j = 0; j < 11; ++j) {
        start_node_mass[j] = params->center[j] * params->mass[j]
            + params->mass[j + 1] * (1.0 - params->center[j + 1]);
    }
    start_node_mass[11] = params->tip_mass + params->center[11] * params->mass[11];

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
    for (int j = 0; j < ELBOW_STATIONS; ++j) {
        start_rod_inertia[j] = params->inertia[j]
            - params->center[j] * (params->length[j] * params->length[j]) * params->mass[j]
            * (1.0 - params->center[j]);
        start_armature[j] = params->gear[j] * params->gear[j] * params->rotor_inertia[j];
        predicted_rate[j + 1] = (initial_rate != NULL ? initial_rate[j] : 0.0);
        predicted_angle[j + 1] = (initial_angle != NULL ? initial_angle[j] : 0.0);
        predicted_acceleration[j + 1] = 0.0;
        drive[j] = 0.0;
    }

    /* Accelerations of the nodes, seen from a falling frame: gravity is the base's own. */
    for (int j = 0; j < ELBOW_STATIONS; ++j) {
        if (!(fabs(predicted_angle[j + 1]) <= ELBOW_LARGEST_ANGLE)) {
            return ELBOW_OUT_OF_RANGE;
        }
        const circle turn_1 = circle_of(predicted_angle[j + 1]);
        lever_cosine[j] = params->length[j] * turn_1.cosine;
        lever_sine[j] = params->length[j] * turn_1.sine;
        const real square = predicted_rate[j + 1] * predicted_rate[j + 1];
        relative_x[j] = -lever_cosine[j] * square - lever_sine[j] * predicted_acceleration[j + 1];
        relative_y[j] = lever_cosine[j] * predicted_acceleration[j + 1] - lever_sine[j] * square;
    }
    for (int j = 0; j < ELBOW_STATIONS; ++j) {
        node_x = node_x + relative_x[j];
        node_y = node_y + relative_y[j];
        acceleration_x[j + 1] = node_x;
        acceleration_y[j + 1] = node_y;
    }

    /* Forces of the joints at the motion so far. */
    drive[0] = inputs->shoulder_torque;
    drive[6] = inputs->elbow_torque;

    /* Forces of the joints at the motion so far; sweep inward: force beyond each joint as an affine function
     * of the motion at it. */
    real impedance_xx = 0.0;
    real impedance_xy = 0.0;
    real impedance_yx = 0.0;
    real impedance_yy = 0.0;
    real impedance_uu = params->tip_inertia;
    real force_x = 0.0;
    real force_y = 0.0;
    real torque = predicted_acceleration[12] * params->tip_inertia;
    for (int j = ELBOW_STATIONS - 1; j >= 7; --j) {
        const real joint_torque = params->damping[j] * (predicted_rate[j] - predicted_rate[j + 1])
            + params->stiffness[j] * (predicted_angle[j] - predicted_angle[j + 1]);
        impedance_xx = impedance_xx + start_node_mass[j];
        force_x = force_x + acceleration_x[j + 1] * start_node_mass[j];
        impedance_yy = impedance_yy + start_node_mass[j];
        force_y = force_y + acceleration_y[j + 1] * start_node_mass[j];
        impedance_xu = impedance_xy * lever_cosine[j] - impedance_xx * lever_sine[j];
        impedance_yu = impedance_yy * lever_cosine[j] - impedance_yx * lever_sine[j];
        impedance_ux = impedance_yx * lever_cosine[j] - impedance_xx * lever_sine[j];
        impedance_uy = impedance_yy * lever_cosine[j] - impedance_xy * lever_sine[j];
        impedance_uu = impedance_uu + start_rod_inertia[j] - impedance_xu * lever_sine[j]
            + impedance_yu * lever_cosine[j];
        torque = torque - force_x * lever_sine[j] + force_y * lever_cosine[j]
            + predicted_acceleration[j + 1] * start_rod_inertia[j];
        if (!(impedance_uu > 0.0) || !(impedance_uu <= DBL_MAX)) {
            return ELBOW_VANISHING_PIVOT;
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
    for (int j = 6; j >= 6; --j) {
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
            return ELBOW_VANISHING_PIVOT;
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
    for (int j = 5; j >= 1; --j) {
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
            return ELBOW_VANISHING_PIVOT;
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
    for (int j = 0; j >= 0; --j) {
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
            return ELBOW_VANISHING_PIVOT;
        }
        const real admittance = 1.0 / pivot;
        answer_own[j] = admittance * (joint_torque - torque);
        answer_x[j] = admittance * impedance_ux;
        answer_y[j] = admittance * impedance_uy;
        transmission[j] = admittance * start_armature[j];
        impedance_xx = impedance_xx - answer_x[j] * impedance_xu;
        impedance_xy = impedance_xy - answer_y[j] * impedance_xu;
        force_x = force_x + answer_own[j] * impedance_xu;
        impedance_yx = impedance_yx - answer_x[j] * impedance_yu;
        impedance_yy = impedance_yy - answer_y[j] * impedance_yu;
        force_y = force_y + answer_own[j] * impedance_yu;
        torque = joint_torque - answer_own[j] * start_armature[j];
    }

    /* The base. */
    real unknown = 0.0;

    /* Sweep outward: the unknown of each station. */
    real change_x = 0.0;
    real change_y = 0.0;
    for (int j = 0; j < 1; ++j) {
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y + transmission[j] * unknown;
        change_x = change_x - lever_sine[j] * unknown;
        change_y = change_y + lever_cosine[j] * unknown;
        solved[j] = unknown;
    }
    for (int j = 1; j < 6; ++j) {
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y;
        change_x = change_x - lever_sine[j] * unknown;
        change_y = change_y + lever_cosine[j] * unknown;
        solved[j] = unknown;
    }
    for (int j = 6; j < 7; ++j) {
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y + transmission[j] * unknown;
        change_x = change_x - lever_sine[j] * unknown;
        change_y = change_y + lever_cosine[j] * unknown;
        solved[j] = unknown;
    }
    for (int j = 7; j < ELBOW_STATIONS; ++j) {
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y;
        change_x = change_x - lever_sine[j] * unknown;
        change_y = change_y + lever_cosine[j] * unknown;
        solved[j] = unknown;
    }

    /* Motion at the end of the step. */
    for (int j = 0; j < ELBOW_STATIONS; ++j) {
        state->angle[j] = predicted_angle[j + 1];
        state->rate[j] = predicted_rate[j + 1];
        state->acceleration[j] = predicted_acceleration[j + 1] + solved[j];
        total += state->angle[j] + state->rate[j] + state->acceleration[j];
    }

    if (!isfinite(total)) {
        return ELBOW_NON_FINITE_STATE;
    }
    return ELBOW_OK;
}

elbow_status elbow_step(
    const elbow_model *model,
    elbow_state *state,
    const elbow_inputs *inputs)
{
    if (model == NULL || state == NULL || inputs == NULL) {
        return ELBOW_NULL_POINTER;
    }
    if (!inputs_are_finite(inputs)) {
        return ELBOW_NON_FINITE_INPUT;
    }

    const real step = model->step;
    const real half_step_squared = model->half_step_squared;
    const real angle_per_acceleration = model->angle_per_acceleration;
    const real rate_per_acceleration = model->rate_per_acceleration;
    real acceleration_x[ELBOW_STATIONS + 1]; /* acceleration of the nodes along x [m/s^2] */
    real acceleration_y[ELBOW_STATIONS + 1]; /* acceleration of the nodes along y [m/s^2] */
    real answer_own[ELBOW_STATIONS]; /* unknown of a station if its inner side kept its motion */
    real answer_x[ELBOW_STATIONS]; /* answer of the unknown to the joint's acceleration along x */
    real answer_y[ELBOW_STATIONS]; /* answer of the unknown to the joint's acceleration along y */
    real drive[ELBOW_STATIONS]; /* torque of each joint's motor [N m] */
    real lever_cosine[ELBOW_STATIONS]; /* length times cosine of the angle [m] */
    real lever_sine[ELBOW_STATIONS]; /* length times sine of the angle [m] */
    /* acceleration of base and links as predicted [rad/s^2] */
    real predicted_acceleration[ELBOW_STATIONS + 1];
    real predicted_angle[ELBOW_STATIONS + 1]; /* angle of base and links as predicted [rad] */
    real predicted_rate[ELBOW_STATIONS + 1]; /* rate of base and links as predicted [rad/s] */
    real relative_x[ELBOW_STATIONS]; /* acceleration of the outer end against the inner one along x [m/s^2] */
    real relative_y[ELBOW_STATIONS]; /* acceleration of the outer end against the inner one along y [m/s^2] */
    real solved[ELBOW_STATIONS]; /* unknown of each station */
    real swing_x[ELBOW_STATIONS]; /* change of the outer end's acceleration along x per unknown [m] */
    real swing_y[ELBOW_STATIONS]; /* change of the outer end's acceleration along y per unknown [m] */
    real transmission[ELBOW_STATIONS]; /* share of motion and torque each joint passes on */
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
    for (int j = 0; j < ELBOW_STATIONS; ++j) {
        predicted_rate[j + 1] = state->rate[j] + state->acceleration[j] * step;
        predicted_angle[j + 1] = state->angle[j] + state->acceleration[j] * half_step_squared
            + state->rate[j] * step;
        predicted_acceleration[j + 1] = state->acceleration[j];
        drive[j] = 0.0;
    }

    /* Accelerations of the nodes, seen from a falling frame: gravity is the base's own. */
    for (int j = 0; j < ELBOW_STATIONS; ++j) {
        if (!(fabs(predicted_angle[j + 1]) <= ELBOW_LARGEST_ANGLE)) {
            return ELBOW_OUT_OF_RANGE;
        }
        const circle turn_1 = circle_of(predicted_angle[j + 1]);
        lever_cosine[j] = model->length[j] * turn_1.cosine;
        lever_sine[j] = model->length[j] * turn_1.sine;
        const real square = predicted_rate[j + 1] * predicted_rate[j + 1];
        relative_x[j] = -lever_cosine[j] * square - lever_sine[j] * predicted_acceleration[j + 1];
        relative_y[j] = lever_cosine[j] * predicted_acceleration[j + 1] - lever_sine[j] * square;
        const real turning = predicted_rate[j + 1] * step;
        swing_x[j] = -lever_sine[j] - angle_per_acceleration * relative_y[j] - lever_cosine[j] * turning;
        swing_y[j] = lever_cosine[j] + angle_per_acceleration * relative_x[j] - lever_sine[j] * turning;
    }
    for (int j = 0; j < ELBOW_STATIONS; ++j) {
        node_x = node_x + relative_x[j];
        node_y = node_y + relative_y[j];
        acceleration_x[j + 1] = node_x;
        acceleration_y[j + 1] = node_y;
    }

    /* Forces of the joints at the motion so far. */
    drive[0] = inputs->shoulder_torque;
    drive[6] = inputs->elbow_torque;

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
    real torque = predicted_acceleration[12] * model->tip_inertia;
    for (int j = ELBOW_STATIONS - 1; j >= 7; --j) {
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
            return ELBOW_VANISHING_PIVOT;
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
    for (int j = 6; j >= 6; --j) {
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
            return ELBOW_VANISHING_PIVOT;
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
    for (int j = 5; j >= 1; --j) {
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
            return ELBOW_VANISHING_PIVOT;
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
    for (int j = 0; j >= 0; --j) {
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
            return ELBOW_VANISHING_PIVOT;
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
    for (int j = 0; j < ELBOW_STATIONS; ++j) {
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y + transmission[j] * unknown;
        change_x = change_x + swing_x[j] * unknown;
        change_y = change_y + swing_y[j] * unknown;
        solved[j] = unknown;
    }

    /* Motion at the end of the step. */
    for (int j = 0; j < ELBOW_STATIONS; ++j) {
        state->angle[j] = predicted_angle[j + 1] + angle_per_acceleration * solved[j];
        state->rate[j] = predicted_rate[j + 1] + rate_per_acceleration * solved[j];
        state->acceleration[j] = predicted_acceleration[j + 1] + solved[j];
        total += state->angle[j] + state->rate[j] + state->acceleration[j];
    }

    if (!isfinite(total)) {
        return ELBOW_NON_FINITE_STATE;
    }
    return ELBOW_OK;
}

void elbow_output(
    const elbow_model *model,
    const elbow_state *state,
    elbow_outputs *outputs)
{
    if (model == NULL || state == NULL || outputs == NULL) {
        return;
    }
    /* Output payload: position. */
    outputs->payload_x = 0.0;
    outputs->payload_y = 0.0;
    for (int j = 0; j < ELBOW_STATIONS; ++j) {
        const circle turn_1 = circle_of(state->angle[j]);
        outputs->payload_x = outputs->payload_x + model->length[j] * turn_1.cosine;
        outputs->payload_y = outputs->payload_y + model->length[j] * turn_1.sine;
    }

    /* Output shoulder: joint angle. */
    outputs->shoulder = state->angle[0];

    /* Output elbow: joint angle. */
    outputs->elbow = state->angle[6] - state->angle[5];
}

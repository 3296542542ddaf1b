/**
 * beam5: Five-link arm on a hub, the model of an observer
 *
 * Written by tmm-gen 0.1.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: 7cda6afdfe9f28eb257c67670c83631d86f159a73ec0c14225ebe1e38843e797
 * sha256 of the rest of this file: 0e7c66822462ec76a1bff1b2f4da5a8fda78513ebc32ce75e21762439820a3da
 *
 * model: planar arm, large rotations, gravity, tip mass
 * stations: 5
 * base: motor
 * integrator: Newmark 1959, beta = 0.25, gamma = 0.5
 * linearisation: newton
 * sweep: riccati
 * unknown: acceleration
 * operations of a step: 685, 137 per station (315 additions, 354 multiplications, 6 divisions, 10 functions)
 * operations of prepare: 47, 9.4 per station (8 additions, 39 multiplications)
 * number type: float
 * bytes of the structs: state 72, inputs 4, outputs 12
 *
 * @file beam5.c
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
#undef hub
#undef tip_x
#undef tip_y

#include "beam5.h"

typedef beam5_real real;

/* Sine and cosine of an angle. */
typedef struct {
    real sine;
    real cosine;
} circle;

/*
 * Sine and cosine, right within 1.3e-07 for angles up to 6433 rad. Additions and multiplications alone, and
 * the same ones for every angle: the same bits on every machine, in the same time.
 */
static circle circle_of(real angle)
{
    /* Sines of no, one, two, three and four quarters of a turn. */
    static const real sine_of_quarters[5] = {
        0.0f, 1.0f, 0.0f, -1.0f, 0.0f
    };
    circle result;

    /* So large a number that it has no digits behind the point: its last ones count quarters of a turn. */
    const union {
        real number;
        uint32_t digits;
    } counted = {angle * 0.63661975f + 12582912.0f};
    const uint32_t quarters = counted.digits & 3u;

    /* The angle without these quarters, in three parts. One expression, so that an analyser sees how small it is. */
    const real rest = angle
        - ((angle * 0.63661975f + 12582912.0f) - 12582912.0f) * 1.5708008f
        - ((angle * 0.63661975f + 12582912.0f) - 12582912.0f) * -4.4535846e-06f
        - ((angle * 0.63661975f + 12582912.0f) - 12582912.0f) * -8.705516e-10f;

    /* Polynomials, of an eighth of a turn at most. */
    const real z = rest * rest;
    real sine = -0.0001958592f;
    sine = 0.008332739f + z * sine;
    sine = -0.16666664f + z * sine;
    sine = rest + rest * z * sine;
    real cosine = 2.4545967e-05f;
    cosine = -0.0013888294f + z * cosine;
    cosine = 0.041666664f + z * cosine;
    cosine = (1.0f - 0.5f * z) + z * z * cosine;

    /* Theorem of addition. */
    result.sine = sine * sine_of_quarters[quarters + 1u] + cosine * sine_of_quarters[quarters];
    result.cosine = cosine * sine_of_quarters[quarters + 1u] - sine * sine_of_quarters[quarters];
    return result;
}

static int inputs_are_finite(const beam5_inputs *inputs)
{
    if (!isfinite(inputs->hub_torque)) {
        return 0;
    }
    return 1;
}

/* Parameters and what follows from them and the time step: constants, as this arm is the only one. */
static const real step = 0.001f; /* time step [s] */
static const real length = 0.2f; /* link length, the same everywhere [m] */
static const real mass = 0.1f; /* link mass, the same everywhere [kg] */
/* link inertia about its centre of mass, the same everywhere [kg m^2] */
static const real inertia = 0.00033333333f;
static const real center = 0.5f; /* centre of mass along the link, 0 to 1, the same everywhere */
/* joint stiffness, base to tip [N m/rad] */
static const real stiffness[BEAM5_STATIONS] = {
    32.0f, 16.0f, 16.0f, 16.0f, 16.0f
};
/* joint damping, base to tip [N m s/rad] */
static const real damping[BEAM5_STATIONS] = {
    0.064f, 0.032f, 0.032f, 0.032f, 0.032f
};
static const real gravity = 9.81f; /* gravity along -y [m/s^2] */
static const real hub_inertia = 0.05f; /* hub inertia [kg m^2] */
static const real hub_damping = 0.01f; /* viscous damping of the hub to ground [N m s/rad] */
static const real tip_mass = 0.1f; /* mass at the tip [kg] */
static const real step2_1_over_2 = 5.0000006e-07f; /* step**2/2 [s^2] */
/* angle per unit of acceleration: step**2/4 [SI] */
static const real angle_per_acceleration = 2.5000003e-07f;
static const real factor_3 = 0.050005f; /* (hub_damping*step + 2*hub_inertia)/2 [SI] */
static const real rate_per_acceleration = 0.0005f; /* rate per unit of acceleration: step/2 [SI] */
static const real carried_mass = 0.05f; /* mass acting at a link's outer end [kg] */
static const real inner_mass = 0.05f; /* mass acting at a link's inner end [kg] */
static const real pin_inertia = 0.0013333333f; /* inertia of a link about its inner end [kg m^2] */
/* torque of a joint per difference of unknowns [SI] */
static const real joint_impedance[BEAM5_STATIONS] = {
    4.0000006e-05f, 2.0000003e-05f, 2.0000003e-05f, 2.0000003e-05f, 2.0000003e-05f
};

beam5_status beam5_initialise(
    beam5_state *state,
    const beam5_real initial_angle[BEAM5_STATIONS],
    const beam5_real initial_rate[BEAM5_STATIONS],
    const beam5_inputs *inputs)
{
    if (state == NULL || inputs == NULL) {
        return BEAM5_NULL_POINTER;
    }
    if (!inputs_are_finite(inputs)) {
        return BEAM5_NON_FINITE_INPUT;
    }
    for (int j = 0; j < BEAM5_STATIONS; ++j) {
        if ((initial_angle != NULL && !isfinite(initial_angle[j]))
            || (initial_rate != NULL && !isfinite(initial_rate[j]))) {
            return BEAM5_NON_FINITE_INPUT;
        }
    }

    real acceleration_x[BEAM5_STATIONS + 1]; /* acceleration of the nodes along x [m/s^2] */
    real acceleration_y[BEAM5_STATIONS + 1]; /* acceleration of the nodes along y [m/s^2] */
    real answer_own[BEAM5_STATIONS]; /* increment of the unknown if the inner side kept its motion */
    real answer_x[BEAM5_STATIONS]; /* answer to the joint's acceleration along x */
    real answer_y[BEAM5_STATIONS]; /* answer to the joint's acceleration along y */
    real lever_cosine[BEAM5_STATIONS]; /* length times cosine of the predicted angle [m] */
    real lever_sine[BEAM5_STATIONS]; /* length times sine of the predicted angle [m] */
    /* acceleration of base and links as predicted [rad/s^2] */
    real predicted_acceleration[BEAM5_STATIONS + 1];
    real predicted_angle[BEAM5_STATIONS + 1]; /* angle of base and links as predicted [rad] */
    real predicted_rate[BEAM5_STATIONS + 1]; /* rate of base and links as predicted [rad/s] */
    real swing_x[BEAM5_STATIONS]; /* change of the outer end's acceleration along x per unknown [m] */
    real swing_y[BEAM5_STATIONS]; /* change of the outer end's acceleration along y per unknown [m] */
    real total = 0.0f; /* of the new motion: is all of it finite? */

    /* Predicted motion. */
    predicted_angle[0] = 0.0f;
    predicted_rate[0] = 0.0f;
    predicted_acceleration[0] = 0.0f;

    /* Predicted motion; accelerations of the nodes, seen from a falling frame: gravity is the base's own. */
    real node_x = 0.0f;
    real node_y = gravity;
    acceleration_x[0] = node_x;
    acceleration_y[0] = gravity;
    for (int j = 0; j < BEAM5_STATIONS; ++j) {
        predicted_angle[j + 1] = (initial_angle != NULL ? initial_angle[j] : 0.0f);
        predicted_rate[j + 1] = (initial_rate != NULL ? initial_rate[j] : 0.0f);
        predicted_acceleration[j + 1] = 0.0f;
        if (!(fabsf(predicted_angle[j + 1]) <= BEAM5_LARGEST_ANGLE)) {
            return BEAM5_OUT_OF_RANGE;
        }
        const circle turn_1 = circle_of(predicted_angle[j + 1]);
        lever_sine[j] = length * turn_1.sine;
        lever_cosine[j] = length * turn_1.cosine;
        const real square = predicted_rate[j + 1] * predicted_rate[j + 1];
        node_x = node_x - lever_cosine[j] * square - lever_sine[j] * predicted_acceleration[j + 1];
        node_y = node_y + lever_cosine[j] * predicted_acceleration[j + 1] - lever_sine[j] * square;
        acceleration_x[j + 1] = node_x;
        acceleration_y[j + 1] = node_y;
    }

    /* How each link's outer end answers to its unknown, and the predicted joint torques; sweep inward: force
     * beyond each joint as an affine function of the motion at it. */
    real impedance_xx = tip_mass;
    real impedance_xy = 0.0f;
    real impedance_xu = 0.0f;
    real impedance_yx = 0.0f;
    real impedance_yy = tip_mass;
    real impedance_yu = 0.0f;
    real impedance_ux = 0.0f;
    real impedance_uy = 0.0f;
    real impedance_uu = 0.0f;
    real force_x = acceleration_x[5] * tip_mass;
    real force_y = acceleration_y[5] * tip_mass;
    real torque = 0.0f;
    for (int j = BEAM5_STATIONS - 1; j >= 0; --j) {
        swing_x[j] = -lever_sine[j];
        swing_y[j] = lever_cosine[j];
        const real joint_torque = damping[j] * (predicted_rate[j] - predicted_rate[j + 1])
            + stiffness[j] * (predicted_angle[j] - predicted_angle[j + 1]);
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
        if (!(link_uu > 0.0f) || !(link_uu <= FLT_MAX)) {
            return BEAM5_VANISHING_PIVOT;
        }
        const real inverse_pivot = 1.0f / link_uu;
        answer_own[j] = inverse_pivot * (joint_torque - torque);
        answer_x[j] = inverse_pivot * link_ux;
        answer_y[j] = inverse_pivot * link_uy;
        impedance_xx = link_xx - answer_x[j] * link_xu;
        impedance_xy = impedance_xy - answer_y[j] * link_xu;
        impedance_xu = 0.0f;
        force_x = force_x + answer_own[j] * link_xu;
        impedance_yx = impedance_yx - answer_x[j] * link_yu;
        impedance_yy = link_yy - answer_y[j] * link_yu;
        impedance_yu = 0.0f;
        force_y = force_y + answer_own[j] * link_yu;
        impedance_ux = 0.0f;
        impedance_uy = 0.0f;
        impedance_uu = 0.0f;
        torque = joint_torque;
    }

    /* The hub. */
    const real hub_pivot = hub_inertia + impedance_uu;
    if (!(hub_pivot > 0.0f) || !(hub_pivot <= FLT_MAX)) {
        return BEAM5_VANISHING_PIVOT;
    }
    real unknown = (inputs->hub_torque - torque - hub_damping * predicted_rate[0]
        - hub_inertia * predicted_acceleration[0]) / hub_pivot;
    const real hub_unknown = unknown;

    /* Sweep outward: the increment of each link's unknown. */
    real change_x = 0.0f;
    real change_y = 0.0f;

    /* Sweep outward: the increment of each link's unknown; motion at the end of the step. */
    state->hub_angle = predicted_angle[0];
    state->hub_rate = predicted_rate[0];
    state->hub_acceleration = hub_unknown + predicted_acceleration[0];
    for (int j = 0; j < BEAM5_STATIONS; ++j) {
        unknown = answer_own[j] - answer_x[j] * change_x - answer_y[j] * change_y;
        change_x = change_x + swing_x[j] * unknown;
        change_y = change_y + swing_y[j] * unknown;
        state->angle[j] = predicted_angle[j + 1];
        state->rate[j] = predicted_rate[j + 1];
        state->acceleration[j] = predicted_acceleration[j + 1] + unknown;
        total += state->angle[j] + state->rate[j] + state->acceleration[j];
    }

    if (!isfinite(total + state->hub_angle + state->hub_rate + state->hub_acceleration)) {
        return BEAM5_NON_FINITE_STATE;
    }
    return BEAM5_OK;
}

beam5_status beam5_step(
    beam5_state *state,
    const beam5_inputs *inputs)
{
    if (state == NULL || inputs == NULL) {
        return BEAM5_NULL_POINTER;
    }
    if (!inputs_are_finite(inputs)) {
        return BEAM5_NON_FINITE_INPUT;
    }

    real acceleration_x[BEAM5_STATIONS + 1]; /* acceleration of the nodes along x [m/s^2] */
    real acceleration_y[BEAM5_STATIONS + 1]; /* acceleration of the nodes along y [m/s^2] */
    real answer_from_inner[BEAM5_STATIONS]; /* answer to the inner link's unknown */
    real answer_own[BEAM5_STATIONS]; /* increment of the unknown if the inner side kept its motion */
    real answer_x[BEAM5_STATIONS]; /* answer to the joint's acceleration along x */
    real answer_y[BEAM5_STATIONS]; /* answer to the joint's acceleration along y */
    real lever_cosine[BEAM5_STATIONS]; /* length times cosine of the predicted angle [m] */
    real lever_sine[BEAM5_STATIONS]; /* length times sine of the predicted angle [m] */
    /* acceleration of base and links as predicted [rad/s^2] */
    real predicted_acceleration[BEAM5_STATIONS + 1];
    real predicted_angle[BEAM5_STATIONS + 1]; /* angle of base and links as predicted [rad] */
    real predicted_rate[BEAM5_STATIONS + 1]; /* rate of base and links as predicted [rad/s] */
    real swing_x[BEAM5_STATIONS]; /* change of the outer end's acceleration along x per unknown [m] */
    real swing_y[BEAM5_STATIONS]; /* change of the outer end's acceleration along y per unknown [m] */
    real total = 0.0f; /* of the new motion: is all of it finite? */

    /* Predicted motion. */
    predicted_angle[0] = state->hub_angle + state->hub_acceleration * step2_1_over_2 + state->hub_rate * step;
    predicted_rate[0] = state->hub_rate + state->hub_acceleration * step;
    predicted_acceleration[0] = state->hub_acceleration;

    /* Predicted motion; accelerations of the nodes, seen from a falling frame: gravity is the base's own. */
    real node_x = 0.0f;
    real node_y = gravity;
    acceleration_x[0] = node_x;
    acceleration_y[0] = gravity;
    for (int j = 0; j < BEAM5_STATIONS; ++j) {
        predicted_angle[j + 1] = state->angle[j] + state->acceleration[j] * step2_1_over_2
            + state->rate[j] * step;
        predicted_rate[j + 1] = state->rate[j] + state->acceleration[j] * step;
        predicted_acceleration[j + 1] = state->acceleration[j];
        if (!(fabsf(predicted_angle[j + 1]) <= BEAM5_LARGEST_ANGLE)) {
            return BEAM5_OUT_OF_RANGE;
        }
        const circle turn_1 = circle_of(predicted_angle[j + 1]);
        lever_sine[j] = length * turn_1.sine;
        lever_cosine[j] = length * turn_1.cosine;
        const real square = predicted_rate[j + 1] * predicted_rate[j + 1];
        node_x = node_x - lever_cosine[j] * square - lever_sine[j] * predicted_acceleration[j + 1];
        node_y = node_y + lever_cosine[j] * predicted_acceleration[j + 1] - lever_sine[j] * square;
        acceleration_x[j + 1] = node_x;
        acceleration_y[j + 1] = node_y;
    }

    /* How each link's outer end answers to its unknown, and the predicted joint torques; sweep inward: force
     * beyond each joint as an affine function of the motion at it. */
    real impedance_xx = tip_mass;
    real impedance_xy = 0.0f;
    real impedance_xu = 0.0f;
    real impedance_yx = 0.0f;
    real impedance_yy = tip_mass;
    real impedance_yu = 0.0f;
    real impedance_ux = 0.0f;
    real impedance_uy = 0.0f;
    real impedance_uu = 0.0f;
    real force_x = acceleration_x[5] * tip_mass;
    real force_y = acceleration_y[5] * tip_mass;
    real torque = 0.0f;
    for (int j = BEAM5_STATIONS - 1; j >= 0; --j) {
        const real tangential = 1.0f
            - angle_per_acceleration * (predicted_rate[j + 1] * predicted_rate[j + 1]);
        const real turning = angle_per_acceleration * predicted_acceleration[j + 1]
            + predicted_rate[j + 1] * step;
        swing_x[j] = -lever_cosine[j] * turning - lever_sine[j] * tangential;
        swing_y[j] = lever_cosine[j] * tangential - lever_sine[j] * turning;
        const real joint_torque = damping[j] * (predicted_rate[j] - predicted_rate[j + 1])
            + stiffness[j] * (predicted_angle[j] - predicted_angle[j + 1]);
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
        const real pivot = joint_impedance[j] + link_uu;
        if (!(pivot > 0.0f) || !(pivot <= FLT_MAX)) {
            return BEAM5_VANISHING_PIVOT;
        }
        const real inverse_pivot = 1.0f / pivot;
        answer_own[j] = inverse_pivot * (joint_torque - torque);
        answer_x[j] = inverse_pivot * link_ux;
        answer_y[j] = inverse_pivot * link_uy;
        answer_from_inner[j] = inverse_pivot * joint_impedance[j];
        impedance_xx = link_xx - answer_x[j] * link_xu;
        impedance_xy = impedance_xy - answer_y[j] * link_xu;
        impedance_xu = answer_from_inner[j] * link_xu;
        force_x = force_x + answer_own[j] * link_xu;
        impedance_yx = impedance_yx - answer_x[j] * link_yu;
        impedance_yy = link_yy - answer_y[j] * link_yu;
        impedance_yu = answer_from_inner[j] * link_yu;
        force_y = force_y + answer_own[j] * link_yu;
        impedance_ux = answer_x[j] * joint_impedance[j];
        impedance_uy = answer_y[j] * joint_impedance[j];
        impedance_uu = answer_from_inner[j] * link_uu;
        torque = joint_torque - answer_own[j] * joint_impedance[j];
    }

    /* The hub. */
    const real hub_pivot = factor_3 + impedance_uu;
    if (!(hub_pivot > 0.0f) || !(hub_pivot <= FLT_MAX)) {
        return BEAM5_VANISHING_PIVOT;
    }
    real unknown = (inputs->hub_torque - torque - hub_damping * predicted_rate[0]
        - hub_inertia * predicted_acceleration[0]) / hub_pivot;
    const real hub_unknown = unknown;

    /* Sweep outward: the increment of each link's unknown. */
    real change_x = 0.0f;
    real change_y = 0.0f;

    /* Sweep outward: the increment of each link's unknown; motion at the end of the step. */
    state->hub_angle = predicted_angle[0] + angle_per_acceleration * hub_unknown;
    state->hub_rate = predicted_rate[0] + hub_unknown * rate_per_acceleration;
    state->hub_acceleration = hub_unknown + predicted_acceleration[0];
    for (int j = 0; j < BEAM5_STATIONS; ++j) {
        unknown = answer_own[j] + answer_from_inner[j] * unknown - answer_x[j] * change_x
            - answer_y[j] * change_y;
        change_x = change_x + swing_x[j] * unknown;
        change_y = change_y + swing_y[j] * unknown;
        state->angle[j] = predicted_angle[j + 1] + angle_per_acceleration * unknown;
        state->rate[j] = predicted_rate[j + 1] + rate_per_acceleration * unknown;
        state->acceleration[j] = predicted_acceleration[j + 1] + unknown;
        total += state->angle[j] + state->rate[j] + state->acceleration[j];
    }

    if (!isfinite(total + state->hub_angle + state->hub_rate + state->hub_acceleration)) {
        return BEAM5_NON_FINITE_STATE;
    }
    return BEAM5_OK;
}

void beam5_output(
    const beam5_state *state,
    beam5_outputs *outputs)
{
    if (state == NULL || outputs == NULL) {
        return;
    }
    /* Hub: angle. */
    outputs->hub = state->hub_angle;

    /* Tip: position. */
    outputs->tip_x = 0.0f;
    outputs->tip_y = 0.0f;
    for (int j = 0; j < BEAM5_STATIONS; ++j) {
        const circle turn_1 = circle_of(state->angle[j]);
        outputs->tip_x = outputs->tip_x + length * turn_1.cosine;
        outputs->tip_y = outputs->tip_y + length * turn_1.sine;
    }
}

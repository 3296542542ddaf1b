/**
 * arm2: Two unlike links swung by a motor
 *
 * Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: c5e09abbb61734735cef8cfddf39dd959eb5765da3ad6484bed2957b4fdf212c
 * sha256 of the rest of this file: 253792d6c1a2e0baef708d77a9a344e7ad6d841b19616aa2518ac20453022235
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
 * A test for any machine: the kernel against 30 digits, within what rounding explains.
 *
 * @file test_arm2.c
 */
#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(_M_FP_FAST) \
    || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "-Ofast and -ffast-math remove checks of this file: use -O3, or put -fno-fast-math behind them"
#endif

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

/* Members of the header below: no macro of a header above may have their names. */
#undef hub_torque
#undef tip_x
#undef tip_y
#undef hub
#undef elbow

#include "arm2.h"

typedef arm2_real real;

typedef struct {
    int checks;
    int failures;
} tally;

static void expect(tally *count, const char *what, real value, real right, real tolerance)
{
    ++count->checks;
    if (!(fabs(value - right) <= tolerance)) {
        ++count->failures;
        printf("%s is %.17g, not %.17g within %.2g\n", what, (double)value, (double)right, (double)tolerance);
    }
}

static void expect_code(
    tally *count,
    const char *what,
    arm2_status value,
    arm2_status right)
{
    ++count->checks;
    if (value != right) {
        ++count->failures;
        printf("%s: status is %d, not %d\n", what, (int)value, (int)right);
    }
}

static void test_motion(tally *count)
{
    arm2_params params;
    arm2_model model;
    arm2_state state;
    arm2_inputs inputs;
    arm2_outputs outputs;
    arm2_status status;
    real initial_angle[ARM2_STATIONS];
    real initial_rate[ARM2_STATIONS];

    memset(&state, 0, sizeof state); /* padding too: it is compared below */
    arm2_default_params(&params);
    status = arm2_prepare(&model, &params, ARM2_STEP);
    expect_code(count, "prepare", status, ARM2_OK);

    for (int j = 0; j < ARM2_STATIONS; ++j) {
        initial_angle[j] = (real)((7 * j + 3) % 16 - 8) / 64.0;
    }
    for (int j = 0; j < ARM2_STATIONS; ++j) {
        initial_rate[j] = (real)((7 * j + 3) % 16 - 8) / 64.0;
    }
    inputs.hub_torque = -0.375;
    status = arm2_initialise(&state, &params, initial_angle, initial_rate, &inputs);
    expect_code(count, "initialise", status, ARM2_OK);

    /* Step 1. */
    inputs.hub_torque = 0.25;
    status = arm2_step(&model, &state, &inputs);
    expect_code(count, "step 1", status, ARM2_OK);
    arm2_output(&model, &state, &outputs);
    expect(count, "tip_x", outputs.tip_x, 0.7984602796950953, 4e-15);
    expect(count, "tip_y", outputs.tip_y, -0.024253900210004155, 2.4e-16);
    expect(count, "hub", outputs.hub, -9.34954459179551e-05, 4.8e-18);
    expect(count, "elbow", outputs.elbow, 4.233359997848719, 2.1e-14);

    /* Step 2. */
    inputs.hub_torque = -0.25;
    status = arm2_step(&model, &state, &inputs);
    expect_code(count, "step 2", status, ARM2_OK);
    arm2_output(&model, &state, &outputs);
    expect(count, "tip_x", outputs.tip_x, 0.798477298072207, 4e-15);
    expect(count, "tip_y", outputs.tip_y, -0.024411474125818337, 2.4e-16);
    expect(count, "hub", outputs.hub, -0.0003704693802380693, 4.8e-18);
    expect(count, "elbow", outputs.elbow, 4.04576223863709, 2.1e-14);

    /* Step 3. */
    inputs.hub_torque = 0.375;
    status = arm2_step(&model, &state, &inputs);
    expect_code(count, "step 3", status, ARM2_OK);
    arm2_output(&model, &state, &outputs);
    expect(count, "tip_x", outputs.tip_x, 0.7985065263338432, 4e-15);
    expect(count, "tip_y", outputs.tip_y, -0.02465418925084082, 2.4e-16);
    expect(count, "hub", outputs.hub, -0.0008235312257242458, 4.8e-18);
    expect(count, "elbow", outputs.elbow, 3.836054914822808, 2.1e-14);

    /* State after the last step. */
    expect(count, "hub_angle", state.hub_angle, -0.0008235312257242458, 4.8e-18);
    expect(count, "hub_rate", state.hub_rate, -0.5391667141680347, 2.2e-15);
    expect(count, "hub_acceleration", state.hub_acceleration, -162.5315884624378, 9.9e-13);
    expect(count, "angle[0]", state.angle[0], -0.07738491796846886, 3.5e-16);
    expect(count, "angle[1]", state.angle[1], 0.028959128083493747, 3.5e-16);
    expect(count, "rate[0]", state.rate[0], 0.5588810363304009, 1.4e-14);
    expect(count, "rate[1]", state.rate[1], -1.5296535999480798, 1.4e-14);
    expect(count, "acceleration[0]", state.acceleration[0], 197.39609021086613, 7e-12);
    expect(count, "acceleration[1]", state.acceleration[1], -486.1842225519613, 7e-12);

    /* Bad input is refused and leaves the state alone. */
    arm2_state before;
    memcpy(&before, &state, sizeof before);
    const real bad[] = {(real)NAN, (real)INFINITY, -(real)INFINITY};
    for (int k = 0; k < 3; ++k) {
        real good;
        good = inputs.hub_torque;
        inputs.hub_torque = bad[k];
        status = arm2_step(&model, &state, &inputs);
        expect_code(count, "bad hub_torque", status, ARM2_NON_FINITE_INPUT);
        inputs.hub_torque = good;
    }
    ++count->checks;
    if (memcmp(&before, &state, sizeof state) != 0) {
        ++count->failures;
        printf("bad input has changed the state\n");
    }
}

static void test_refusals(tally *count)
{
    arm2_params params;
    arm2_model model;
    arm2_status status;

    arm2_default_params(&params);
    status = arm2_prepare(&model, &params, 0.0);
    expect_code(count, "no step", status, ARM2_INVALID_STEP);
    status = arm2_prepare(&model, &params, (real)NAN);
    expect_code(count, "bad step", status, ARM2_INVALID_STEP);

    arm2_default_params(&params);
    params.length[ARM2_STATIONS - 1] = (real)NAN;
    status = arm2_prepare(&model, &params, ARM2_STEP);
    expect_code(count, "bad length", status, ARM2_NON_FINITE_INPUT);

    arm2_default_params(&params);
    params.mass[ARM2_STATIONS - 1] = (real)NAN;
    status = arm2_prepare(&model, &params, ARM2_STEP);
    expect_code(count, "bad mass", status, ARM2_NON_FINITE_INPUT);

    arm2_default_params(&params);
    params.inertia[ARM2_STATIONS - 1] = (real)NAN;
    status = arm2_prepare(&model, &params, ARM2_STEP);
    expect_code(count, "bad inertia", status, ARM2_NON_FINITE_INPUT);

    arm2_default_params(&params);
    params.center[ARM2_STATIONS - 1] = (real)NAN;
    status = arm2_prepare(&model, &params, ARM2_STEP);
    expect_code(count, "bad center", status, ARM2_NON_FINITE_INPUT);

    arm2_default_params(&params);
    params.stiffness[ARM2_STATIONS - 1] = (real)NAN;
    status = arm2_prepare(&model, &params, ARM2_STEP);
    expect_code(count, "bad stiffness", status, ARM2_NON_FINITE_INPUT);

    arm2_default_params(&params);
    params.damping[ARM2_STATIONS - 1] = (real)NAN;
    status = arm2_prepare(&model, &params, ARM2_STEP);
    expect_code(count, "bad damping", status, ARM2_NON_FINITE_INPUT);

    arm2_default_params(&params);
    params.gravity = (real)NAN;
    status = arm2_prepare(&model, &params, ARM2_STEP);
    expect_code(count, "bad gravity", status, ARM2_NON_FINITE_INPUT);

    arm2_default_params(&params);
    params.hub_inertia = (real)NAN;
    status = arm2_prepare(&model, &params, ARM2_STEP);
    expect_code(count, "bad hub_inertia", status, ARM2_NON_FINITE_INPUT);

    arm2_default_params(&params);
    params.hub_damping = (real)NAN;
    status = arm2_prepare(&model, &params, ARM2_STEP);
    expect_code(count, "bad hub_damping", status, ARM2_NON_FINITE_INPUT);

    arm2_default_params(&params);
    params.tip_mass = (real)NAN;
    status = arm2_prepare(&model, &params, ARM2_STEP);
    expect_code(count, "bad tip_mass", status, ARM2_NON_FINITE_INPUT);

    arm2_default_params(&params);
    params.tip_inertia = (real)NAN;
    status = arm2_prepare(&model, &params, ARM2_STEP);
    expect_code(count, "bad tip_inertia", status, ARM2_NON_FINITE_INPUT);
}

/* Arrays that are absent are the scene's own; any other pointer that is absent is refused. */
static void test_absent(tally *count)
{
    arm2_params params;
    arm2_model model;
    arm2_state state;
    arm2_inputs inputs;
    arm2_status status;

    memset(&inputs, 0, sizeof inputs);
    arm2_default_params(&params);
    arm2_default_params(NULL);
    status = arm2_prepare(NULL, &params, ARM2_STEP);
    expect_code(count, "no model", status, ARM2_NULL_POINTER);
    status = arm2_prepare(&model, NULL, ARM2_STEP);
    expect_code(count, "no parameters", status, ARM2_NULL_POINTER);
    status = arm2_prepare(&model, &params, ARM2_STEP);
    expect_code(count, "prepare", status, ARM2_OK);
    status = arm2_initialise(NULL, &params, NULL, NULL, &inputs);
    expect_code(count, "no state", status, ARM2_NULL_POINTER);
    status = arm2_initialise(&state, &params, NULL, NULL, &inputs);
    expect_code(count, "the scene's start", status, ARM2_OK);
    status = arm2_step(&model, NULL, &inputs);
    expect_code(count, "no state", status, ARM2_NULL_POINTER);
    status = arm2_step(NULL, &state, &inputs);
    expect_code(count, "no model", status, ARM2_NULL_POINTER);
    status = arm2_initialise(&state, &params, NULL, NULL, NULL);
    expect_code(count, "no inputs", status, ARM2_NULL_POINTER);
    status = arm2_step(&model, &state, NULL);
    expect_code(count, "no inputs", status, ARM2_NULL_POINTER);
    arm2_output(&model, &state, NULL);
}

int main(void)
{
    tally count = {0, 0};

    test_motion(&count);
    test_absent(&count);
    test_refusals(&count);
    if (count.failures > 0) {
        printf("%d of %d checks failed\n", count.failures, count.checks);
        return 1;
    }
    printf("%d checks passed\n", count.checks);
    return 0;
}

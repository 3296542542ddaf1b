/**
 * swing: Flexible arm swung by one radian
 *
 * Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: c9c08efbdc9f2f1b1ddadadab522649e5100f98e9cdabe31fcf56b416283c60f
 * sha256 of the rest of this file: 7f2d89c978a99dccf8d087dc0a513b56a668bd7528f6e79c6731a6331840a699
 *
 * model: planar arm, large rotations, tip mass
 * stations: 5
 * base: motor
 * integrator: Newmark 1959, beta = 0.25, gamma = 0.5
 * linearisation: newton
 * sweep: riccati
 * unknown: acceleration
 * operations of a step: 595, 119 per station (275 additions, 304 multiplications, 6 divisions, 10 sines and
 *     cosines)
 * operations of prepare: 47, 9.4 per station (10 additions, 37 multiplications)
 * number type: double
 * bytes of the structs: params 136, model 208, state 144, inputs 8, outputs 24
 *
 * A test for any machine: the kernel against 30 digits, within what rounding explains.
 *
 * @file test_swing.c
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

#include "swing.h"

typedef swing_real real;

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
    swing_status value,
    swing_status right)
{
    ++count->checks;
    if (value != right) {
        ++count->failures;
        printf("%s: status is %d, not %d\n", what, (int)value, (int)right);
    }
}

static void test_motion(tally *count)
{
    swing_params params;
    swing_model model;
    swing_state state;
    swing_inputs inputs;
    swing_outputs outputs;
    swing_status status;
    real initial_angle[SWING_STATIONS];
    real initial_rate[SWING_STATIONS];

    memset(&state, 0, sizeof state); /* padding too: it is compared below */
    swing_default_params(&params);
    status = swing_prepare(&model, &params, SWING_STEP);
    expect_code(count, "prepare", status, SWING_OK);

    for (int j = 0; j < SWING_STATIONS; ++j) {
        initial_angle[j] = (real)((7 * j + 3) % 16 - 8) / 64.0;
    }
    for (int j = 0; j < SWING_STATIONS; ++j) {
        initial_rate[j] = (real)((7 * j + 3) % 16 - 8) / 64.0;
    }
    inputs.hub_torque = -0.375;
    status = swing_initialise(&state, &params, initial_angle, initial_rate, &inputs);
    expect_code(count, "initialise", status, SWING_OK);

    /* Step 1. */
    inputs.hub_torque = 0.25;
    status = swing_step(&model, &state, &inputs);
    expect_code(count, "step 1", status, SWING_OK);
    swing_output(&model, &state, &outputs);
    expect(count, "tip_x", outputs.tip_x, 0.9944888561865907, 4.4e-15);
    expect(count, "tip_y", outputs.tip_y, -0.00687620987803648, 2.1e-15);
    expect(count, "hub", outputs.hub, -0.00018929673569545728, 9.2e-16);

    /* Step 2. */
    inputs.hub_torque = -0.25;
    status = swing_step(&model, &state, &inputs);
    expect_code(count, "step 2", status, SWING_OK);
    swing_output(&model, &state, &outputs);
    expect(count, "tip_x", outputs.tip_x, 0.9417398026423861, 4.4e-15);
    expect(count, "tip_y", outputs.tip_y, 0.009808930773380272, 2.1e-15);
    expect(count, "hub", outputs.hub, 0.002162378112709224, 9.2e-16);

    /* Step 3. */
    inputs.hub_torque = 0.375;
    status = swing_step(&model, &state, &inputs);
    expect_code(count, "step 3", status, SWING_OK);
    swing_output(&model, &state, &outputs);
    expect(count, "tip_x", outputs.tip_x, 0.89744992971305, 4.4e-15);
    expect(count, "tip_y", outputs.tip_y, 0.027721687178938286, 2.1e-15);
    expect(count, "hub", outputs.hub, 0.007285009529283769, 9.2e-16);

    /* State after the last step. */
    expect(count, "hub_angle", state.hub_angle, 0.007285009529283769, 9.2e-16);
    expect(count, "hub_rate", state.hub_rate, 1.032663932989763, 1.8e-13);
    expect(count, "hub_acceleration", state.hub_acceleration, -265.3390391386854, 3e-11);
    expect(count, "angle[0]", state.angle[0], -0.01915409707059555, 2.1e-14);
    expect(count, "angle[1]", state.angle[1], -0.499891647473002, 2.1e-14);
    expect(count, "angle[2]", state.angle[2], 0.8731757359000334, 2.1e-14);
    expect(count, "angle[3]", state.angle[3], 0.10296989316893042, 2.1e-14);
    expect(count, "angle[4]", state.angle[4], -0.2342043151683484, 2.1e-14);
    expect(count, "rate[0]", state.rate[0], -57.01514654639334, 3e-12);
    expect(count, "rate[1]", state.rate[1], 51.358070623337674, 3e-12);
    expect(count, "rate[2]", state.rate[2], 30.006677603120185, 3e-12);
    expect(count, "rate[3]", state.rate[3], 65.0148576822254, 3e-12);
    expect(count, "rate[4]", state.rate[4], -53.61709380222191, 3e-12);
    expect(count, "acceleration[0]", state.acceleration[0], -12344.382207883586, 5.7e-10);
    expect(count, "acceleration[1]", state.acceleration[1], 18223.937911735648, 5.7e-10);
    expect(count, "acceleration[2]", state.acceleration[2], -21151.00968413513, 5.7e-10);
    expect(count, "acceleration[3]", state.acceleration[3], 11913.737819000526, 5.7e-10);
    expect(count, "acceleration[4]", state.acceleration[4], -3131.8312141492625, 5.7e-10);

    /* Bad input is refused and leaves the state alone. */
    swing_state before;
    memcpy(&before, &state, sizeof before);
    const real bad[] = {(real)NAN, (real)INFINITY, -(real)INFINITY};
    for (int k = 0; k < 3; ++k) {
        real good;
        good = inputs.hub_torque;
        inputs.hub_torque = bad[k];
        status = swing_step(&model, &state, &inputs);
        expect_code(count, "bad hub_torque", status, SWING_NON_FINITE_INPUT);
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
    swing_params params;
    swing_model model;
    swing_status status;

    swing_default_params(&params);
    status = swing_prepare(&model, &params, 0.0);
    expect_code(count, "no step", status, SWING_INVALID_STEP);
    status = swing_prepare(&model, &params, (real)NAN);
    expect_code(count, "bad step", status, SWING_INVALID_STEP);

    swing_default_params(&params);
    params.length = (real)NAN;
    status = swing_prepare(&model, &params, SWING_STEP);
    expect_code(count, "bad length", status, SWING_NON_FINITE_INPUT);

    swing_default_params(&params);
    params.mass = (real)NAN;
    status = swing_prepare(&model, &params, SWING_STEP);
    expect_code(count, "bad mass", status, SWING_NON_FINITE_INPUT);

    swing_default_params(&params);
    params.inertia = (real)NAN;
    status = swing_prepare(&model, &params, SWING_STEP);
    expect_code(count, "bad inertia", status, SWING_NON_FINITE_INPUT);

    swing_default_params(&params);
    params.center = (real)NAN;
    status = swing_prepare(&model, &params, SWING_STEP);
    expect_code(count, "bad center", status, SWING_NON_FINITE_INPUT);

    swing_default_params(&params);
    params.stiffness[SWING_STATIONS - 1] = (real)NAN;
    status = swing_prepare(&model, &params, SWING_STEP);
    expect_code(count, "bad stiffness", status, SWING_NON_FINITE_INPUT);

    swing_default_params(&params);
    params.damping[SWING_STATIONS - 1] = (real)NAN;
    status = swing_prepare(&model, &params, SWING_STEP);
    expect_code(count, "bad damping", status, SWING_NON_FINITE_INPUT);

    swing_default_params(&params);
    params.hub_inertia = (real)NAN;
    status = swing_prepare(&model, &params, SWING_STEP);
    expect_code(count, "bad hub_inertia", status, SWING_NON_FINITE_INPUT);

    swing_default_params(&params);
    params.hub_damping = (real)NAN;
    status = swing_prepare(&model, &params, SWING_STEP);
    expect_code(count, "bad hub_damping", status, SWING_NON_FINITE_INPUT);

    swing_default_params(&params);
    params.tip_mass = (real)NAN;
    status = swing_prepare(&model, &params, SWING_STEP);
    expect_code(count, "bad tip_mass", status, SWING_NON_FINITE_INPUT);
}

/* Arrays that are absent are the scene's own; any other pointer that is absent is refused. */
static void test_absent(tally *count)
{
    swing_params params;
    swing_model model;
    swing_state state;
    swing_inputs inputs;
    swing_status status;

    memset(&inputs, 0, sizeof inputs);
    swing_default_params(&params);
    swing_default_params(NULL);
    status = swing_prepare(NULL, &params, SWING_STEP);
    expect_code(count, "no model", status, SWING_NULL_POINTER);
    status = swing_prepare(&model, NULL, SWING_STEP);
    expect_code(count, "no parameters", status, SWING_NULL_POINTER);
    status = swing_prepare(&model, &params, SWING_STEP);
    expect_code(count, "prepare", status, SWING_OK);
    status = swing_initialise(NULL, &params, NULL, NULL, &inputs);
    expect_code(count, "no state", status, SWING_NULL_POINTER);
    status = swing_initialise(&state, &params, NULL, NULL, &inputs);
    expect_code(count, "the scene's start", status, SWING_OK);
    status = swing_step(&model, NULL, &inputs);
    expect_code(count, "no state", status, SWING_NULL_POINTER);
    status = swing_step(NULL, &state, &inputs);
    expect_code(count, "no model", status, SWING_NULL_POINTER);
    status = swing_initialise(&state, &params, NULL, NULL, NULL);
    expect_code(count, "no inputs", status, SWING_NULL_POINTER);
    status = swing_step(&model, &state, NULL);
    expect_code(count, "no inputs", status, SWING_NULL_POINTER);
    swing_output(&model, &state, NULL);
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

/**
 * thesis2: Two-station torsional chain, Gholampour (2018), table 3-2
 *
 * Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: 8302c2fdab02afb73919e09c91c3abafc3d83d0760e2c0e63be40bfdc341e62e
 * sha256 of the rest of this file: 24fe207ac8af5b63e5f1a890787fd6c13e74200f1c208a069f80f89586269f73
 *
 * model: torsional chain (linear)
 * stations: 2
 * base: clamp
 * integrator: Newmark 1959, beta = 0.25, gamma = 0.5
 * sweep: riccati
 * unknown: acceleration
 * operations of a step: 44, 22 per station (22 additions, 22 multiplications)
 * operations of prepare: 21, 10.5 per station (5 additions, 14 multiplications, 2 divisions)
 * number type: double
 * bytes of the structs: params 24, model 88, state 48, inputs 8, outputs 16
 *
 * A test for any machine: the kernel against 30 digits, within what rounding explains.
 *
 * @file test_thesis2.c
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
#undef tip_torque
#undef tip
#undef base_torque

#include "thesis2.h"

typedef thesis2_real real;

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
    thesis2_status value,
    thesis2_status right)
{
    ++count->checks;
    if (value != right) {
        ++count->failures;
        printf("%s: status is %d, not %d\n", what, (int)value, (int)right);
    }
}

static void test_motion(tally *count)
{
    thesis2_params params;
    thesis2_model model;
    thesis2_state state;
    thesis2_inputs inputs;
    thesis2_outputs outputs;
    thesis2_status status;
    real initial_angle[THESIS2_STATIONS];
    real initial_rate[THESIS2_STATIONS];

    memset(&state, 0, sizeof state); /* padding too: it is compared below */
    thesis2_default_params(&params);
    status = thesis2_prepare(&model, &params, THESIS2_STEP);
    expect_code(count, "prepare", status, THESIS2_OK);

    for (int j = 0; j < THESIS2_STATIONS; ++j) {
        initial_angle[j] = (real)((7 * j + 3) % 16 - 8) / 64.0;
    }
    for (int j = 0; j < THESIS2_STATIONS; ++j) {
        initial_rate[j] = (real)((7 * j + 3) % 16 - 8) / 64.0;
    }
    inputs.tip_torque = -0.375;
    status = thesis2_initialise(&state, &params, initial_angle, initial_rate, &inputs);
    expect_code(count, "initialise", status, THESIS2_OK);

    /* Step 1. */
    inputs.tip_torque = 0.25;
    status = thesis2_step(&model, &state, &inputs);
    expect_code(count, "step 1", status, THESIS2_OK);
    thesis2_output(&model, &state, &outputs);
    expect(count, "tip", outputs.tip, 0.03153480002693913, 1.5e-16);
    expect(count, "base_torque", outputs.base_torque, -1.9213735846959639, 7.6e-15);

    /* Step 2. */
    inputs.tip_torque = -0.25;
    status = thesis2_step(&model, &state, &inputs);
    expect_code(count, "step 2", status, THESIS2_OK);
    thesis2_output(&model, &state, &outputs);
    expect(count, "tip", outputs.tip, 0.03176536713077275, 1.5e-16);
    expect(count, "base_torque", outputs.base_torque, -1.8886459772451525, 7.6e-15);

    /* Step 3. */
    inputs.tip_torque = 0.375;
    status = thesis2_step(&model, &state, &inputs);
    expect_code(count, "step 3", status, THESIS2_OK);
    thesis2_output(&model, &state, &outputs);
    expect(count, "tip", outputs.tip, 0.03194404375542388, 1.5e-16);
    expect(count, "base_torque", outputs.base_torque, -1.8549950079465363, 7.6e-15);

    /* State after the last step. */
    expect(count, "angle[0]", state.angle[0], -0.0800550627924514, 3.5e-16);
    expect(count, "angle[1]", state.angle[1], 0.03194404375542388, 3.5e-16);
    expect(count, "rate[0]", state.rate[0], -0.050778750419501625, 4.7e-16);
    expect(count, "rate[1]", state.rate[1], 0.015331909551330394, 4.7e-16);
    expect(count, "acceleration[0]", state.acceleration[0], 0.8851060877516405, 7e-15);
    expect(count, "acceleration[1]", state.acceleration[1], -0.4391070861623332, 7e-15);

    /* Bad input is refused and leaves the state alone. */
    thesis2_state before;
    memcpy(&before, &state, sizeof before);
    const real bad[] = {(real)NAN, (real)INFINITY, -(real)INFINITY};
    for (int k = 0; k < 3; ++k) {
        real good;
        good = inputs.tip_torque;
        inputs.tip_torque = bad[k];
        status = thesis2_step(&model, &state, &inputs);
        expect_code(count, "bad tip_torque", status, THESIS2_NON_FINITE_INPUT);
        inputs.tip_torque = good;
    }
    ++count->checks;
    if (memcmp(&before, &state, sizeof state) != 0) {
        ++count->failures;
        printf("bad input has changed the state\n");
    }
}

static void test_refusals(tally *count)
{
    thesis2_params params;
    thesis2_model model;
    thesis2_status status;

    thesis2_default_params(&params);
    status = thesis2_prepare(&model, &params, 0.0);
    expect_code(count, "no step", status, THESIS2_INVALID_STEP);
    status = thesis2_prepare(&model, &params, (real)NAN);
    expect_code(count, "bad step", status, THESIS2_INVALID_STEP);

    thesis2_default_params(&params);
    params.stiffness = (real)NAN;
    status = thesis2_prepare(&model, &params, THESIS2_STEP);
    expect_code(count, "bad stiffness", status, THESIS2_NON_FINITE_INPUT);

    thesis2_default_params(&params);
    params.damping = (real)NAN;
    status = thesis2_prepare(&model, &params, THESIS2_STEP);
    expect_code(count, "bad damping", status, THESIS2_NON_FINITE_INPUT);

    thesis2_default_params(&params);
    params.inertia = (real)NAN;
    status = thesis2_prepare(&model, &params, THESIS2_STEP);
    expect_code(count, "bad inertia", status, THESIS2_NON_FINITE_INPUT);
}

/* Arrays that are absent are the scene's own; any other pointer that is absent is refused. */
static void test_absent(tally *count)
{
    thesis2_params params;
    thesis2_model model;
    thesis2_state state;
    thesis2_inputs inputs;
    thesis2_status status;

    memset(&inputs, 0, sizeof inputs);
    thesis2_default_params(&params);
    thesis2_default_params(NULL);
    status = thesis2_prepare(NULL, &params, THESIS2_STEP);
    expect_code(count, "no model", status, THESIS2_NULL_POINTER);
    status = thesis2_prepare(&model, NULL, THESIS2_STEP);
    expect_code(count, "no parameters", status, THESIS2_NULL_POINTER);
    status = thesis2_prepare(&model, &params, THESIS2_STEP);
    expect_code(count, "prepare", status, THESIS2_OK);
    status = thesis2_initialise(NULL, &params, NULL, NULL, &inputs);
    expect_code(count, "no state", status, THESIS2_NULL_POINTER);
    status = thesis2_initialise(&state, &params, NULL, NULL, &inputs);
    expect_code(count, "the scene's start", status, THESIS2_OK);
    status = thesis2_step(&model, NULL, &inputs);
    expect_code(count, "no state", status, THESIS2_NULL_POINTER);
    status = thesis2_step(NULL, &state, &inputs);
    expect_code(count, "no model", status, THESIS2_NULL_POINTER);
    status = thesis2_initialise(&state, &params, NULL, NULL, NULL);
    expect_code(count, "no inputs", status, THESIS2_NULL_POINTER);
    status = thesis2_step(&model, &state, NULL);
    expect_code(count, "no inputs", status, THESIS2_NULL_POINTER);
    thesis2_output(&model, &state, NULL);
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

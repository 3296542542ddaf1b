/**
 * thesis10: Ten-station torsional chain, Gholampour (2018), table 4-1
 *
 * Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: f0c976d21d4524b79e43b0ef658e9df768725b961ac09b0a12bdaf9596a590df
 * sha256 of the rest of this file: 23b2378b21f483334a4bf91d7a616a810bd5505c2f2ca7f73faa91084c8120bf
 *
 * model: torsional chain (linear)
 * stations: 10
 * base: clamp
 * integrator: Newmark 1959, beta = 0.25, gamma = 0.5
 * sweep: riccati
 * unknown: acceleration
 * operations of a step: 220, 22 per station (110 additions, 110 multiplications)
 * operations of prepare: 69, 6.9 per station (21 additions, 38 multiplications, 10 divisions)
 * number type: double
 * bytes of the structs: params 24, model 280, state 240, inputs 8, outputs 16
 *
 * A test for any machine: the kernel against 30 digits, within what rounding explains.
 *
 * @file test_thesis10.c
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

#include "thesis10.h"

typedef thesis10_real real;

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
    thesis10_status value,
    thesis10_status right)
{
    ++count->checks;
    if (value != right) {
        ++count->failures;
        printf("%s: status is %d, not %d\n", what, (int)value, (int)right);
    }
}

static void test_motion(tally *count)
{
    thesis10_params params;
    thesis10_model model;
    thesis10_state state;
    thesis10_inputs inputs;
    thesis10_outputs outputs;
    thesis10_status status;
    real initial_angle[THESIS10_STATIONS];
    real initial_rate[THESIS10_STATIONS];

    memset(&state, 0, sizeof state); /* padding too: it is compared below */
    thesis10_default_params(&params);
    status = thesis10_prepare(&model, &params, THESIS10_STEP);
    expect_code(count, "prepare", status, THESIS10_OK);

    for (int j = 0; j < THESIS10_STATIONS; ++j) {
        initial_angle[j] = (real)((7 * j + 3) % 16 - 8) / 64.0;
    }
    for (int j = 0; j < THESIS10_STATIONS; ++j) {
        initial_rate[j] = (real)((7 * j + 3) % 16 - 8) / 64.0;
    }
    inputs.tip_torque = -0.375;
    status = thesis10_initialise(&state, &params, initial_angle, initial_rate, &inputs);
    expect_code(count, "initialise", status, THESIS10_OK);

    /* Step 1. */
    inputs.tip_torque = 0.25;
    status = thesis10_step(&model, &state, &inputs);
    expect_code(count, "step 1", status, THESIS10_OK);
    thesis10_output(&model, &state, &outputs);
    expect(count, "tip", outputs.tip, -0.0945256050708355, 5.9e-16);
    expect(count, "base_torque", outputs.base_torque, -1.747460724485656, 7.8e-15);

    /* Step 2. */
    inputs.tip_torque = -0.25;
    status = thesis10_step(&model, &state, &inputs);
    expect_code(count, "step 2", status, THESIS10_OK);
    thesis10_output(&model, &state, &outputs);
    expect(count, "tip", outputs.tip, -0.09499464236192906, 5.9e-16);
    expect(count, "base_torque", outputs.base_torque, -1.5664174789772825, 7.8e-15);

    /* Step 3. */
    inputs.tip_torque = 0.375;
    status = thesis10_step(&model, &state, &inputs);
    expect_code(count, "step 3", status, THESIS10_OK);
    thesis10_output(&model, &state, &outputs);
    expect(count, "tip", outputs.tip, -0.09518934630032247, 5.9e-16);
    expect(count, "base_torque", outputs.base_torque, -1.4070661368892177, 7.8e-15);

    /* State after the last step. */
    expect(count, "angle[0]", state.angle[0], -0.07867527622852927, 5.9e-16);
    expect(count, "angle[1]", state.angle[1], 0.02985239580366213, 5.9e-16);
    expect(count, "angle[2]", state.angle[2], -0.11022465991242364, 5.9e-16);
    expect(count, "angle[3]", state.angle[3], -4.477188258679443e-08, 5.9e-16);
    expect(count, "angle[4]", state.angle[4], 0.11022347752022721, 5.9e-16);
    expect(count, "angle[5]", state.angle[5], -0.0298799175904234, 5.9e-16);
    expect(count, "angle[6]", state.angle[6], 0.0781557906023311, 5.9e-16);
    expect(count, "angle[7]", state.angle[7], -0.06206445914441922, 5.9e-16);
    expect(count, "angle[8]", state.angle[8], 0.04591874119299722, 5.9e-16);
    expect(count, "angle[9]", state.angle[9], -0.09518934630032247, 5.9e-16);
    expect(count, "rate[0]", state.rate[0], 0.03328787753627354, 9.4e-16);
    expect(count, "rate[1]", state.rate[1], -0.11208736324706997, 9.4e-16);
    expect(count, "rate[2]", state.rate[2], 0.04281981437912253, 9.4e-16);
    expect(count, "rate[3]", state.rate[3], -5.638250851579959e-06, 9.4e-16);
    expect(count, "rate[4]", state.rate[4], -0.04295063126817839, 9.4e-16);
    expect(count, "rate[5]", state.rate[5], 0.10965298883340945, 9.4e-16);
    expect(count, "rate[6]", state.rate[6], -0.063383115067775, 9.4e-16);
    expect(count, "rate[7]", state.rate[7], 0.07873619635327264, 9.4e-16);
    expect(count, "rate[8]", state.rate[8], -0.0990010479220592, 9.4e-16);
    expect(count, "rate[9]", state.rate[9], -0.006504343627068539, 9.4e-16);
    expect(count, "acceleration[0]", state.acceleration[0], 2.8507433736163277, 4.4e-14);
    expect(count, "acceleration[1]", state.acceleration[1], -3.470682462917863, 4.4e-14);
    expect(count, "acceleration[2]", state.acceleration[2], 4.017370265851703, 4.4e-14);
    expect(count, "acceleration[3]", state.acceleration[3], -0.0006195589053884478, 4.4e-14);
    expect(count, "acceleration[4]", state.acceleration[4], -4.028795282460635, 4.4e-14);
    expect(count, "acceleration[5]", state.acceleration[5], 3.334583446054241, 4.4e-14);
    expect(count, "acceleration[6]", state.acceleration[6], -3.3893420821789366, 4.4e-14);
    expect(count, "acceleration[7]", state.acceleration[7], 3.3647862232014383, 4.4e-14);
    expect(count, "acceleration[8]", state.acceleration[8], -3.6306560137631103, 4.4e-14);
    expect(count, "acceleration[9]", state.acceleration[9], 2.7346782283914406, 4.4e-14);

    /* Bad input is refused and leaves the state alone. */
    thesis10_state before;
    memcpy(&before, &state, sizeof before);
    const real bad[] = {(real)NAN, (real)INFINITY, -(real)INFINITY};
    for (int k = 0; k < 3; ++k) {
        real good;
        good = inputs.tip_torque;
        inputs.tip_torque = bad[k];
        status = thesis10_step(&model, &state, &inputs);
        expect_code(count, "bad tip_torque", status, THESIS10_NON_FINITE_INPUT);
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
    thesis10_params params;
    thesis10_model model;
    thesis10_status status;

    thesis10_default_params(&params);
    status = thesis10_prepare(&model, &params, 0.0);
    expect_code(count, "no step", status, THESIS10_INVALID_STEP);
    status = thesis10_prepare(&model, &params, (real)NAN);
    expect_code(count, "bad step", status, THESIS10_INVALID_STEP);

    thesis10_default_params(&params);
    params.stiffness = (real)NAN;
    status = thesis10_prepare(&model, &params, THESIS10_STEP);
    expect_code(count, "bad stiffness", status, THESIS10_NON_FINITE_INPUT);

    thesis10_default_params(&params);
    params.damping = (real)NAN;
    status = thesis10_prepare(&model, &params, THESIS10_STEP);
    expect_code(count, "bad damping", status, THESIS10_NON_FINITE_INPUT);

    thesis10_default_params(&params);
    params.inertia = (real)NAN;
    status = thesis10_prepare(&model, &params, THESIS10_STEP);
    expect_code(count, "bad inertia", status, THESIS10_NON_FINITE_INPUT);
}

/* Arrays that are absent are the scene's own; any other pointer that is absent is refused. */
static void test_absent(tally *count)
{
    thesis10_params params;
    thesis10_model model;
    thesis10_state state;
    thesis10_inputs inputs;
    thesis10_status status;

    memset(&inputs, 0, sizeof inputs);
    thesis10_default_params(&params);
    thesis10_default_params(NULL);
    status = thesis10_prepare(NULL, &params, THESIS10_STEP);
    expect_code(count, "no model", status, THESIS10_NULL_POINTER);
    status = thesis10_prepare(&model, NULL, THESIS10_STEP);
    expect_code(count, "no parameters", status, THESIS10_NULL_POINTER);
    status = thesis10_prepare(&model, &params, THESIS10_STEP);
    expect_code(count, "prepare", status, THESIS10_OK);
    status = thesis10_initialise(NULL, &params, NULL, NULL, &inputs);
    expect_code(count, "no state", status, THESIS10_NULL_POINTER);
    status = thesis10_initialise(&state, &params, NULL, NULL, &inputs);
    expect_code(count, "the scene's start", status, THESIS10_OK);
    status = thesis10_step(&model, NULL, &inputs);
    expect_code(count, "no state", status, THESIS10_NULL_POINTER);
    status = thesis10_step(NULL, &state, &inputs);
    expect_code(count, "no model", status, THESIS10_NULL_POINTER);
    status = thesis10_initialise(&state, &params, NULL, NULL, NULL);
    expect_code(count, "no inputs", status, THESIS10_NULL_POINTER);
    status = thesis10_step(&model, &state, NULL);
    expect_code(count, "no inputs", status, THESIS10_NULL_POINTER);
    thesis10_output(&model, &state, NULL);
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

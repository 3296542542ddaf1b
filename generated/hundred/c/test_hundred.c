/**
 * hundred: Uniform shaft of a hundred stations
 *
 * Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: 1ec2a071f5720229c3b5c9d847fa0a44d6fa112015051ca13c1d73444e6eb10a
 * sha256 of the rest of this file: 77870c8f439c705b458b91309e0e9a17bcd745d7e49623e0370678600f50fa44
 *
 * model: torsional chain (linear)
 * stations: 100
 * base: clamp
 * integrator: Newmark 1959, beta = 0.25, gamma = 0.5
 * sweep: riccati
 * unknown: acceleration
 * operations of a step: 2200, 22 per station (1100 additions, 1100 multiplications)
 * operations of prepare: 609, 6.09 per station (201 additions, 308 multiplications, 100 divisions)
 * number type: double
 * bytes of the structs: params 24, model 2440, state 2400, inputs 8, outputs 24
 *
 * A test for any machine: the kernel against 30 digits, within what rounding explains.
 *
 * @file test_hundred.c
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
#undef middle
#undef base_torque

#include "hundred.h"

typedef hundred_real real;

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
    hundred_status value,
    hundred_status right)
{
    ++count->checks;
    if (value != right) {
        ++count->failures;
        printf("%s: status is %d, not %d\n", what, (int)value, (int)right);
    }
}

static void test_motion(tally *count)
{
    hundred_params params;
    hundred_model model;
    hundred_state state;
    hundred_inputs inputs;
    hundred_outputs outputs;
    hundred_status status;
    real initial_angle[HUNDRED_STATIONS];
    real initial_rate[HUNDRED_STATIONS];

    memset(&state, 0, sizeof state); /* padding too: it is compared below */
    hundred_default_params(&params);
    status = hundred_prepare(&model, &params, HUNDRED_STEP);
    expect_code(count, "prepare", status, HUNDRED_OK);

    for (int j = 0; j < HUNDRED_STATIONS; ++j) {
        initial_angle[j] = (real)((7 * j + 3) % 16 - 8) / 64.0;
    }
    for (int j = 0; j < HUNDRED_STATIONS; ++j) {
        initial_rate[j] = (real)((7 * j + 3) % 16 - 8) / 64.0;
    }
    inputs.tip_torque = -0.375;
    status = hundred_initialise(&state, &params, initial_angle, initial_rate, &inputs);
    expect_code(count, "initialise", status, HUNDRED_OK);

    /* Step 1. */
    inputs.tip_torque = 0.25;
    status = hundred_step(&model, &state, &inputs);
    expect_code(count, "step 1", status, HUNDRED_OK);
    hundred_output(&model, &state, &outputs);
    expect(count, "tip", outputs.tip, -0.002115529426724634, 9.4e-17);
    expect(count, "middle", outputs.middle, 0.02648989912409461, 1.5e-16);
    expect(count, "base_torque", outputs.base_torque, -29.690193827096046, 1.4e-13);

    /* Step 2. */
    inputs.tip_torque = -0.25;
    status = hundred_step(&model, &state, &inputs);
    expect_code(count, "step 2", status, HUNDRED_OK);
    hundred_output(&model, &state, &outputs);
    expect(count, "tip", outputs.tip, -0.008180260999534927, 9.4e-17);
    expect(count, "middle", outputs.middle, 0.012917479562693858, 1.5e-16);
    expect(count, "base_torque", outputs.base_torque, -25.445867355262788, 1.4e-13);

    /* Step 3. */
    inputs.tip_torque = 0.375;
    status = hundred_step(&model, &state, &inputs);
    expect_code(count, "step 3", status, HUNDRED_OK);
    hundred_output(&model, &state, &outputs);
    expect(count, "tip", outputs.tip, -0.017401223594142957, 9.4e-17);
    expect(count, "middle", outputs.middle, -0.007304781404710103, 1.5e-16);
    expect(count, "base_torque", outputs.base_torque, -19.079299436850487, 1.4e-13);

    /* State after the last step. */
    expect(count, "angle[0]", state.angle[0], -0.04859564964851543, 4.4e-16);
    expect(count, "angle[11]", state.angle[11], -0.08517317726029532, 4.4e-16);
    expect(count, "angle[22]", state.angle[22], 0.039674224326481766, 4.4e-16);
    expect(count, "angle[33]", state.angle[33], -0.007304781404710103, 4.4e-16);
    expect(count, "angle[44]", state.angle[44], -0.015671874999963836, 4.4e-16);
    expect(count, "angle[55]", state.angle[55], -0.024003041901320497, 4.4e-16);
    expect(count, "angle[66]", state.angle[66], -0.0695013022628718, 4.4e-16);
    expect(count, "angle[77]", state.angle[77], 0.0538294272628718, 4.4e-16);
    expect(count, "angle[88]", state.angle[88], 0.008331166901320497, 4.4e-16);
    expect(count, "angle[99]", state.angle[99], -0.017401223594142957, 4.4e-16);
    expect(count, "rate[0]", state.rate[0], 17.948021127784237, 1.8e-13);
    expect(count, "rate[11]", state.rate[11], 24.484047150667582, 1.8e-13);
    expect(count, "rate[22]", state.rate[22], -22.85425509772911, 1.8e-13);
    expect(count, "rate[33]", state.rate[33], -22.8511345638172, 1.8e-13);
    expect(count, "rate[44]", state.rate[44], -0.015624999936978056, 1.8e-13);
    expect(count, "rate[55]", state.rate[55], 22.868835389365355, 1.8e-13);
    expect(count, "rate[66]", state.rate[66], 24.49967214626793, 1.8e-13);
    expect(count, "rate[77]", state.rate[77], -24.51529714626793, 1.8e-13);
    expect(count, "rate[88]", state.rate[88], -22.884460389365355, 1.8e-13);
    expect(count, "rate[99]", state.rate[99], -10.543520897044743, 1.8e-13);
    expect(count, "acceleration[0]", state.acceleration[0], 3462.7143926151816, 8.1e-11);
    expect(count, "acceleration[11]", state.acceleration[11], 5124.211974539026, 8.1e-11);
    expect(count, "acceleration[22]", state.acceleration[22], -3659.011413318213, 8.1e-11);
    expect(count, "acceleration[33]", state.acceleration[33], -3596.5266509146404, 8.1e-11);
    expect(count, "acceleration[44]", state.acceleration[44], 1.0871337066190926e-07, 8.1e-11);
    expect(count, "acceleration[55]", state.acceleration[55], 3657.50622868608, 8.1e-11);
    expect(count, "acceleration[66]", state.acceleration[66], 5124.211967127061, 8.1e-11);
    expect(count, "acceleration[77]", state.acceleration[77], -5124.211967127061, 8.1e-11);
    expect(count, "acceleration[88]", state.acceleration[88], -3657.50622868608, 8.1e-11);
    expect(count, "acceleration[99]", state.acceleration[99], -2004.9412892012858, 8.1e-11);

    /* Bad input is refused and leaves the state alone. */
    hundred_state before;
    memcpy(&before, &state, sizeof before);
    const real bad[] = {(real)NAN, (real)INFINITY, -(real)INFINITY};
    for (int k = 0; k < 3; ++k) {
        real good;
        good = inputs.tip_torque;
        inputs.tip_torque = bad[k];
        status = hundred_step(&model, &state, &inputs);
        expect_code(count, "bad tip_torque", status, HUNDRED_NON_FINITE_INPUT);
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
    hundred_params params;
    hundred_model model;
    hundred_status status;

    hundred_default_params(&params);
    status = hundred_prepare(&model, &params, 0.0);
    expect_code(count, "no step", status, HUNDRED_INVALID_STEP);
    status = hundred_prepare(&model, &params, (real)NAN);
    expect_code(count, "bad step", status, HUNDRED_INVALID_STEP);

    hundred_default_params(&params);
    params.stiffness = (real)NAN;
    status = hundred_prepare(&model, &params, HUNDRED_STEP);
    expect_code(count, "bad stiffness", status, HUNDRED_NON_FINITE_INPUT);

    hundred_default_params(&params);
    params.damping = (real)NAN;
    status = hundred_prepare(&model, &params, HUNDRED_STEP);
    expect_code(count, "bad damping", status, HUNDRED_NON_FINITE_INPUT);

    hundred_default_params(&params);
    params.inertia = (real)NAN;
    status = hundred_prepare(&model, &params, HUNDRED_STEP);
    expect_code(count, "bad inertia", status, HUNDRED_NON_FINITE_INPUT);
}

/* Arrays that are absent are the scene's own; any other pointer that is absent is refused. */
static void test_absent(tally *count)
{
    hundred_params params;
    hundred_model model;
    hundred_state state;
    hundred_inputs inputs;
    hundred_status status;

    memset(&inputs, 0, sizeof inputs);
    hundred_default_params(&params);
    hundred_default_params(NULL);
    status = hundred_prepare(NULL, &params, HUNDRED_STEP);
    expect_code(count, "no model", status, HUNDRED_NULL_POINTER);
    status = hundred_prepare(&model, NULL, HUNDRED_STEP);
    expect_code(count, "no parameters", status, HUNDRED_NULL_POINTER);
    status = hundred_prepare(&model, &params, HUNDRED_STEP);
    expect_code(count, "prepare", status, HUNDRED_OK);
    status = hundred_initialise(NULL, &params, NULL, NULL, &inputs);
    expect_code(count, "no state", status, HUNDRED_NULL_POINTER);
    status = hundred_initialise(&state, &params, NULL, NULL, &inputs);
    expect_code(count, "the scene's start", status, HUNDRED_OK);
    status = hundred_step(&model, NULL, &inputs);
    expect_code(count, "no state", status, HUNDRED_NULL_POINTER);
    status = hundred_step(NULL, &state, &inputs);
    expect_code(count, "no model", status, HUNDRED_NULL_POINTER);
    status = hundred_initialise(&state, &params, NULL, NULL, NULL);
    expect_code(count, "no inputs", status, HUNDRED_NULL_POINTER);
    status = hundred_step(&model, &state, NULL);
    expect_code(count, "no inputs", status, HUNDRED_NULL_POINTER);
    hundred_output(&model, &state, NULL);
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

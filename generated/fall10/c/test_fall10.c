/**
 * fall10: Soft clamped beam falling under its own weight
 *
 * Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: 225557ccb20983327784b6fc8326b9127fb185b183a5e99d150385ab258b9303
 * sha256 of the rest of this file: 3d3449ba7c44b944c84e8dcf467f46d895e774daa64d428e5d2668c2b4b3a284
 *
 * model: planar arm, large rotations, gravity
 * stations: 10
 * base: clamp
 * integrator: Newmark 1959, beta = 0.25, gamma = 0.5
 * linearisation: newton
 * sweep: riccati
 * unknown: acceleration
 * operations of a step: 1152, 115.2 per station (530 additions, 592 multiplications, 10 divisions, 20 sines
 *     and cosines)
 * operations of prepare: 73, 7.3 per station (13 additions, 60 multiplications)
 * number type: double
 * bytes of the structs: params 200, model 312, state 240, inputs 8, outputs 40
 *
 * A test for any machine: the kernel against 30 digits, within what rounding explains.
 *
 * @file test_fall10.c
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
#undef tip_x
#undef tip_y
#undef speed_x
#undef speed_y
#undef root

#include "fall10.h"

typedef fall10_real real;

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
    fall10_status value,
    fall10_status right)
{
    ++count->checks;
    if (value != right) {
        ++count->failures;
        printf("%s: status is %d, not %d\n", what, (int)value, (int)right);
    }
}

static void test_motion(tally *count)
{
    fall10_params params;
    fall10_model model;
    fall10_state state;
    fall10_inputs inputs;
    fall10_outputs outputs;
    fall10_status status;
    real initial_angle[FALL10_STATIONS];
    real initial_rate[FALL10_STATIONS];

    memset(&state, 0, sizeof state); /* padding too: it is compared below */
    fall10_default_params(&params);
    status = fall10_prepare(&model, &params, FALL10_STEP);
    expect_code(count, "prepare", status, FALL10_OK);

    for (int j = 0; j < FALL10_STATIONS; ++j) {
        initial_angle[j] = (real)((7 * j + 3) % 16 - 8) / 64.0;
    }
    for (int j = 0; j < FALL10_STATIONS; ++j) {
        initial_rate[j] = (real)((7 * j + 3) % 16 - 8) / 64.0;
    }
    inputs.none = 0.0;
    status = fall10_initialise(&state, &params, initial_angle, initial_rate, &inputs);
    expect_code(count, "initialise", status, FALL10_OK);

    /* Step 1. */
    status = fall10_step(&model, &state, &inputs);
    expect_code(count, "step 1", status, FALL10_OK);
    fall10_output(&model, &state, &outputs);
    expect(count, "tip_x", outputs.tip_x, 0.998014126783768, 5.3e-15);
    expect(count, "tip_y", outputs.tip_y, -0.010185370005385618, 3.6e-16);
    expect(count, "speed_x", outputs.speed_x, 1.1725116719205155, 2e-14);
    expect(count, "speed_y", outputs.speed_y, 1.4842473153526383, 1.7e-13);
    expect(count, "root", outputs.root, -1.3718396065774041, 2.8e-14);

    /* Step 2. */
    status = fall10_step(&model, &state, &inputs);
    expect_code(count, "step 2", status, FALL10_OK);
    fall10_output(&model, &state, &outputs);
    expect(count, "tip_x", outputs.tip_x, 0.9988075200490485, 5.3e-15);
    expect(count, "tip_y", outputs.tip_y, -0.009074248010420179, 3.6e-16);
    expect(count, "speed_x", outputs.speed_x, 0.5019720025865869, 2e-14);
    expect(count, "speed_y", outputs.speed_y, 0.7374508787394595, 1.7e-13);
    expect(count, "root", outputs.root, -0.866780592715292, 2.8e-14);

    /* Step 3. */
    status = fall10_step(&model, &state, &inputs);
    expect_code(count, "step 3", status, FALL10_OK);
    fall10_output(&model, &state, &outputs);
    expect(count, "tip_x", outputs.tip_x, 0.9991647436354539, 5.3e-15);
    expect(count, "tip_y", outputs.tip_y, -0.008452586835136078, 3.6e-16);
    expect(count, "speed_x", outputs.speed_x, 0.24125854821523407, 2e-14);
    expect(count, "speed_y", outputs.speed_y, 0.5053134512171825, 1.7e-13);
    expect(count, "root", outputs.root, -0.7998316840058695, 2.8e-14);

    /* State after the last step. */
    expect(count, "angle[0]", state.angle[0], -0.04440904159165403, 2.8e-15);
    expect(count, "angle[1]", state.angle[1], -0.03269100364142152, 2.8e-15);
    expect(count, "angle[2]", state.angle[2], -0.07117509104232728, 2.8e-15);
    expect(count, "angle[3]", state.angle[3], 0.0009009376734914257, 2.8e-15);
    expect(count, "angle[4]", state.angle[4], 0.07012793900080318, 2.8e-15);
    expect(count, "angle[5]", state.angle[5], 0.024354287436685, 2.8e-15);
    expect(count, "angle[6]", state.angle[6], 0.03315770699006158, 2.8e-15);
    expect(count, "angle[7]", state.angle[7], -0.016745076349260687, 2.8e-15);
    expect(count, "angle[8]", state.angle[8], -0.007361891622181491, 2.8e-15);
    expect(count, "angle[9]", state.angle[9], -0.04071127663852745, 2.8e-15);
    expect(count, "rate[0]", state.rate[0], 9.707150733235302, 1.7e-12);
    expect(count, "rate[1]", state.rate[1], -19.92082759050195, 1.7e-12);
    expect(count, "rate[2]", state.rate[2], 15.579705636430043, 1.7e-12);
    expect(count, "rate[3]", state.rate[3], 0.7220003975375714, 1.7e-12);
    expect(count, "rate[4]", state.rate[4], -18.172007548310027, 1.7e-12);
    expect(count, "rate[5]", state.rate[5], 15.738231640802278, 1.7e-12);
    expect(count, "rate[6]", state.rate[6], -5.923493950025669, 1.7e-12);
    expect(count, "rate[7]", state.rate[7], 5.706917570487988, 1.7e-12);
    expect(count, "rate[8]", state.rate[8], -8.32530167371517, 1.7e-12);
    expect(count, "rate[9]", state.rate[9], 9.944691993316418, 1.7e-12);
    expect(count, "acceleration[0]", state.acceleration[0], -7765.9349807247345, 3e-09);
    expect(count, "acceleration[1]", state.acceleration[1], 14245.707947347766, 3e-09);
    expect(count, "acceleration[2]", state.acceleration[2], -5264.448172329187, 3e-09);
    expect(count, "acceleration[3]", state.acceleration[3], -2154.461287499742, 3e-09);
    expect(count, "acceleration[4]", state.acceleration[4], 5848.278442493287, 3e-09);
    expect(count, "acceleration[5]", state.acceleration[5], -11858.105900012719, 3e-09);
    expect(count, "acceleration[6]", state.acceleration[6], 8692.740939117659, 3e-09);
    expect(count, "acceleration[7]", state.acceleration[7], -4098.762499229, 3e-09);
    expect(count, "acceleration[8]", state.acceleration[8], 5260.934488483507, 3e-09);
    expect(count, "acceleration[9]", state.acceleration[9], -4920.481126413989, 3e-09);
}

static void test_refusals(tally *count)
{
    fall10_params params;
    fall10_model model;
    fall10_status status;

    fall10_default_params(&params);
    status = fall10_prepare(&model, &params, 0.0);
    expect_code(count, "no step", status, FALL10_INVALID_STEP);
    status = fall10_prepare(&model, &params, (real)NAN);
    expect_code(count, "bad step", status, FALL10_INVALID_STEP);

    fall10_default_params(&params);
    params.length = (real)NAN;
    status = fall10_prepare(&model, &params, FALL10_STEP);
    expect_code(count, "bad length", status, FALL10_NON_FINITE_INPUT);

    fall10_default_params(&params);
    params.mass = (real)NAN;
    status = fall10_prepare(&model, &params, FALL10_STEP);
    expect_code(count, "bad mass", status, FALL10_NON_FINITE_INPUT);

    fall10_default_params(&params);
    params.inertia = (real)NAN;
    status = fall10_prepare(&model, &params, FALL10_STEP);
    expect_code(count, "bad inertia", status, FALL10_NON_FINITE_INPUT);

    fall10_default_params(&params);
    params.center = (real)NAN;
    status = fall10_prepare(&model, &params, FALL10_STEP);
    expect_code(count, "bad center", status, FALL10_NON_FINITE_INPUT);

    fall10_default_params(&params);
    params.stiffness[FALL10_STATIONS - 1] = (real)NAN;
    status = fall10_prepare(&model, &params, FALL10_STEP);
    expect_code(count, "bad stiffness", status, FALL10_NON_FINITE_INPUT);

    fall10_default_params(&params);
    params.damping[FALL10_STATIONS - 1] = (real)NAN;
    status = fall10_prepare(&model, &params, FALL10_STEP);
    expect_code(count, "bad damping", status, FALL10_NON_FINITE_INPUT);

    fall10_default_params(&params);
    params.gravity = (real)NAN;
    status = fall10_prepare(&model, &params, FALL10_STEP);
    expect_code(count, "bad gravity", status, FALL10_NON_FINITE_INPUT);
}

/* Arrays that are absent are the scene's own; any other pointer that is absent is refused. */
static void test_absent(tally *count)
{
    fall10_params params;
    fall10_model model;
    fall10_state state;
    fall10_inputs inputs;
    fall10_status status;

    memset(&inputs, 0, sizeof inputs);
    fall10_default_params(&params);
    fall10_default_params(NULL);
    status = fall10_prepare(NULL, &params, FALL10_STEP);
    expect_code(count, "no model", status, FALL10_NULL_POINTER);
    status = fall10_prepare(&model, NULL, FALL10_STEP);
    expect_code(count, "no parameters", status, FALL10_NULL_POINTER);
    status = fall10_prepare(&model, &params, FALL10_STEP);
    expect_code(count, "prepare", status, FALL10_OK);
    status = fall10_initialise(NULL, &params, NULL, NULL, &inputs);
    expect_code(count, "no state", status, FALL10_NULL_POINTER);
    status = fall10_initialise(&state, &params, NULL, NULL, &inputs);
    expect_code(count, "the scene's start", status, FALL10_OK);
    status = fall10_step(&model, NULL, &inputs);
    expect_code(count, "no state", status, FALL10_NULL_POINTER);
    status = fall10_step(NULL, &state, &inputs);
    expect_code(count, "no model", status, FALL10_NULL_POINTER);
    fall10_output(&model, &state, NULL);
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

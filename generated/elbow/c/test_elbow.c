/**
 * elbow: Flexible arm with motors at shoulder and elbow
 *
 * Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: b7474d2f501b0139799e3f1e1a14aa2a3a455ea0221cabb6918551519b3600d0
 * sha256 of the rest of this file: 7e25d35c524f0afa0811ee209193ce95276364362a7277580ae0fa65d3232bfa
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
 * A test for any machine: the kernel against 30 digits, within what rounding explains.
 *
 * @file test_elbow.c
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
#undef shoulder_torque
#undef elbow_torque
#undef payload_x
#undef payload_y
#undef shoulder
#undef elbow

#include "elbow.h"

typedef elbow_real real;

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
    elbow_status value,
    elbow_status right)
{
    ++count->checks;
    if (value != right) {
        ++count->failures;
        printf("%s: status is %d, not %d\n", what, (int)value, (int)right);
    }
}

static void test_motion(tally *count)
{
    elbow_params params;
    elbow_model model;
    elbow_state state;
    elbow_inputs inputs;
    elbow_outputs outputs;
    elbow_status status;
    real initial_angle[ELBOW_STATIONS];
    real initial_rate[ELBOW_STATIONS];

    memset(&state, 0, sizeof state); /* padding too: it is compared below */
    elbow_default_params(&params);
    status = elbow_prepare(&model, &params, ELBOW_STEP);
    expect_code(count, "prepare", status, ELBOW_OK);

    for (int j = 0; j < ELBOW_STATIONS; ++j) {
        initial_angle[j] = (real)((7 * j + 3) % 16 - 8) / 64.0;
    }
    for (int j = 0; j < ELBOW_STATIONS; ++j) {
        initial_rate[j] = (real)((7 * j + 3) % 16 - 8) / 64.0;
    }
    inputs.shoulder_torque = -0.375;
    inputs.elbow_torque = 0.0;
    status = elbow_initialise(&state, &params, initial_angle, initial_rate, &inputs);
    expect_code(count, "initialise", status, ELBOW_OK);

    /* Step 1. */
    inputs.shoulder_torque = 0.25;
    inputs.elbow_torque = -0.5;
    status = elbow_step(&model, &state, &inputs);
    expect_code(count, "step 1", status, ELBOW_OK);
    elbow_output(&model, &state, &outputs);
    expect(count, "payload_x", outputs.payload_x, 0.8980531589859024, 5.1e-15);
    expect(count, "payload_y", outputs.payload_y, -0.011815938927832139, 3.7e-16);
    expect(count, "shoulder", outputs.shoulder, -0.07820908210958111, 2.2e-16);
    expect(count, "elbow", outputs.elbow, 0.10923304114376373, 1.1e-15);

    /* Step 2. */
    inputs.shoulder_torque = -0.25;
    inputs.elbow_torque = 0.125;
    status = elbow_step(&model, &state, &inputs);
    expect_code(count, "step 2", status, ELBOW_OK);
    elbow_output(&model, &state, &outputs);
    expect(count, "payload_x", outputs.payload_x, 0.8977889137988504, 5.1e-15);
    expect(count, "payload_y", outputs.payload_y, -0.012045818136189351, 3.7e-16);
    expect(count, "shoulder", outputs.shoulder, -0.07831048726238414, 2.2e-16);
    expect(count, "elbow", outputs.elbow, 0.10862300342631608, 1.1e-15);

    /* Step 3. */
    inputs.shoulder_torque = 0.375;
    inputs.elbow_torque = -0.375;
    status = elbow_step(&model, &state, &inputs);
    expect_code(count, "step 3", status, ELBOW_OK);
    elbow_output(&model, &state, &outputs);
    expect(count, "payload_x", outputs.payload_x, 0.8969404660975913, 5.1e-15);
    expect(count, "payload_y", outputs.payload_y, -0.012263276903435944, 3.7e-16);
    expect(count, "shoulder", outputs.shoulder, -0.0784206717271551, 2.2e-16);
    expect(count, "elbow", outputs.elbow, 0.10760316024583529, 1.1e-15);

    /* State after the last step. */
    expect(count, "angle[0]", state.angle[0], -0.0784206717271551, 9.7e-15);
    expect(count, "angle[1]", state.angle[1], -0.04812718476758371, 9.7e-15);
    expect(count, "angle[2]", state.angle[2], -0.08320123343979412, 9.7e-15);
    expect(count, "angle[4]", state.angle[4], 0.11023747728905049, 9.7e-15);
    expect(count, "angle[5]", state.angle[5], 0.061549285943162405, 9.7e-15);
    expect(count, "angle[6]", state.angle[6], 0.1691524461889977, 9.7e-15);
    expect(count, "angle[7]", state.angle[7], 0.007045151750482161, 9.7e-15);
    expect(count, "angle[9]", state.angle[9], -0.019748881888945236, 9.7e-15);
    expect(count, "angle[10]", state.angle[10], -0.11470959246247, 9.7e-15);
    expect(count, "angle[11]", state.angle[11], -0.17609400236298797, 9.7e-15);
    expect(count, "rate[0]", state.rate[0], -0.1075978430980643, 5.8e-12);
    expect(count, "rate[1]", state.rate[1], -31.446761700510002, 5.8e-12);
    expect(count, "rate[2]", state.rate[2], 7.657180712795081, 5.8e-12);
    expect(count, "rate[4]", state.rate[4], 2.178559801873921, 5.8e-12);
    expect(count, "rate[5]", state.rate[5], 32.67783493533064, 5.8e-12);
    expect(count, "rate[6]", state.rate[6], 31.464931296791793, 5.8e-12);
    expect(count, "rate[7]", state.rate[7], 57.8166176718754, 5.8e-12);
    expect(count, "rate[9]", state.rate[9], -52.50255859044728, 5.8e-12);
    expect(count, "rate[10]", state.rate[10], -25.012021631890878, 5.8e-12);
    expect(count, "rate[11]", state.rate[11], -31.709174399313383, 5.8e-12);
    expect(count, "acceleration[0]", state.acceleration[0], 143.10012529123514, 6.5e-09);
    expect(count, "acceleration[1]", state.acceleration[1], 15966.524157986894, 6.5e-09);
    expect(count, "acceleration[2]", state.acceleration[2], -9964.675332147, 6.5e-09);
    expect(count, "acceleration[4]", state.acceleration[4], -10310.413020001799, 6.5e-09);
    expect(count, "acceleration[5]", state.acceleration[5], -975.2596783791784, 6.5e-09);
    expect(count, "acceleration[6]", state.acceleration[6], -1789.9632338299168, 6.5e-09);
    expect(count, "acceleration[7]", state.acceleration[7], 34005.46692504077, 6.5e-09);
    expect(count, "acceleration[9]", state.acceleration[9], 33880.717996148356, 6.5e-09);
    expect(count, "acceleration[10]", state.acceleration[10], -30506.712681712284, 6.5e-09);
    expect(count, "acceleration[11]", state.acceleration[11], 5408.397334479815, 6.5e-09);

    /* Bad input is refused and leaves the state alone. */
    elbow_state before;
    memcpy(&before, &state, sizeof before);
    const real bad[] = {(real)NAN, (real)INFINITY, -(real)INFINITY};
    for (int k = 0; k < 3; ++k) {
        real good;
        good = inputs.shoulder_torque;
        inputs.shoulder_torque = bad[k];
        status = elbow_step(&model, &state, &inputs);
        expect_code(count, "bad shoulder_torque", status, ELBOW_NON_FINITE_INPUT);
        inputs.shoulder_torque = good;
        good = inputs.elbow_torque;
        inputs.elbow_torque = bad[k];
        status = elbow_step(&model, &state, &inputs);
        expect_code(count, "bad elbow_torque", status, ELBOW_NON_FINITE_INPUT);
        inputs.elbow_torque = good;
    }
    ++count->checks;
    if (memcmp(&before, &state, sizeof state) != 0) {
        ++count->failures;
        printf("bad input has changed the state\n");
    }
}

static void test_refusals(tally *count)
{
    elbow_params params;
    elbow_model model;
    elbow_status status;

    elbow_default_params(&params);
    status = elbow_prepare(&model, &params, 0.0);
    expect_code(count, "no step", status, ELBOW_INVALID_STEP);
    status = elbow_prepare(&model, &params, (real)NAN);
    expect_code(count, "bad step", status, ELBOW_INVALID_STEP);

    elbow_default_params(&params);
    params.length[ELBOW_STATIONS - 1] = (real)NAN;
    status = elbow_prepare(&model, &params, ELBOW_STEP);
    expect_code(count, "bad length", status, ELBOW_NON_FINITE_INPUT);

    elbow_default_params(&params);
    params.mass[ELBOW_STATIONS - 1] = (real)NAN;
    status = elbow_prepare(&model, &params, ELBOW_STEP);
    expect_code(count, "bad mass", status, ELBOW_NON_FINITE_INPUT);

    elbow_default_params(&params);
    params.inertia[ELBOW_STATIONS - 1] = (real)NAN;
    status = elbow_prepare(&model, &params, ELBOW_STEP);
    expect_code(count, "bad inertia", status, ELBOW_NON_FINITE_INPUT);

    elbow_default_params(&params);
    params.center[ELBOW_STATIONS - 1] = (real)NAN;
    status = elbow_prepare(&model, &params, ELBOW_STEP);
    expect_code(count, "bad center", status, ELBOW_NON_FINITE_INPUT);

    elbow_default_params(&params);
    params.stiffness[ELBOW_STATIONS - 1] = (real)NAN;
    status = elbow_prepare(&model, &params, ELBOW_STEP);
    expect_code(count, "bad stiffness", status, ELBOW_NON_FINITE_INPUT);

    elbow_default_params(&params);
    params.damping[ELBOW_STATIONS - 1] = (real)NAN;
    status = elbow_prepare(&model, &params, ELBOW_STEP);
    expect_code(count, "bad damping", status, ELBOW_NON_FINITE_INPUT);

    elbow_default_params(&params);
    params.rotor_inertia[ELBOW_STATIONS - 1] = (real)NAN;
    status = elbow_prepare(&model, &params, ELBOW_STEP);
    expect_code(count, "bad rotor_inertia", status, ELBOW_NON_FINITE_INPUT);

    elbow_default_params(&params);
    params.gear[ELBOW_STATIONS - 1] = (real)NAN;
    status = elbow_prepare(&model, &params, ELBOW_STEP);
    expect_code(count, "bad gear", status, ELBOW_NON_FINITE_INPUT);

    elbow_default_params(&params);
    params.gravity = (real)NAN;
    status = elbow_prepare(&model, &params, ELBOW_STEP);
    expect_code(count, "bad gravity", status, ELBOW_NON_FINITE_INPUT);

    elbow_default_params(&params);
    params.tip_mass = (real)NAN;
    status = elbow_prepare(&model, &params, ELBOW_STEP);
    expect_code(count, "bad tip_mass", status, ELBOW_NON_FINITE_INPUT);

    elbow_default_params(&params);
    params.tip_inertia = (real)NAN;
    status = elbow_prepare(&model, &params, ELBOW_STEP);
    expect_code(count, "bad tip_inertia", status, ELBOW_NON_FINITE_INPUT);
}

/* Arrays that are absent are the scene's own; any other pointer that is absent is refused. */
static void test_absent(tally *count)
{
    elbow_params params;
    elbow_model model;
    elbow_state state;
    elbow_inputs inputs;
    elbow_status status;

    memset(&inputs, 0, sizeof inputs);
    elbow_default_params(&params);
    elbow_default_params(NULL);
    status = elbow_prepare(NULL, &params, ELBOW_STEP);
    expect_code(count, "no model", status, ELBOW_NULL_POINTER);
    status = elbow_prepare(&model, NULL, ELBOW_STEP);
    expect_code(count, "no parameters", status, ELBOW_NULL_POINTER);
    status = elbow_prepare(&model, &params, ELBOW_STEP);
    expect_code(count, "prepare", status, ELBOW_OK);
    status = elbow_initialise(NULL, &params, NULL, NULL, &inputs);
    expect_code(count, "no state", status, ELBOW_NULL_POINTER);
    status = elbow_initialise(&state, &params, NULL, NULL, &inputs);
    expect_code(count, "the scene's start", status, ELBOW_OK);
    status = elbow_step(&model, NULL, &inputs);
    expect_code(count, "no state", status, ELBOW_NULL_POINTER);
    status = elbow_step(NULL, &state, &inputs);
    expect_code(count, "no model", status, ELBOW_NULL_POINTER);
    status = elbow_initialise(&state, &params, NULL, NULL, NULL);
    expect_code(count, "no inputs", status, ELBOW_NULL_POINTER);
    status = elbow_step(&model, &state, NULL);
    expect_code(count, "no inputs", status, ELBOW_NULL_POINTER);
    elbow_output(&model, &state, NULL);
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

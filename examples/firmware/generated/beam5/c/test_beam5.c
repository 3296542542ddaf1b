/**
 * beam5: Five-link arm on a hub, the model of an observer
 *
 * Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: 7cda6afdfe9f28eb257c67670c83631d86f159a73ec0c14225ebe1e38843e797
 * sha256 of the rest of this file: c48aa445d1841df93aaf20a973ca6bbda1db8dd7413ff73efc47bd187f5668f7
 *
 * model: planar arm, large rotations, gravity, tip mass
 * stations: 5
 * base: motor
 * integrator: Newmark 1959, beta = 0.25, gamma = 0.5
 * linearisation: newton
 * sweep: riccati
 * unknown: acceleration
 * operations of a step: 595, 119 per station (275 additions, 304 multiplications, 6 divisions, 10 sines and
 *     cosines)
 * operations of prepare: 47, 9.4 per station (10 additions, 37 multiplications)
 * number type: float
 * bytes of the structs: state 72, inputs 4, outputs 12
 *
 * A test for any machine: the kernel against 30 digits, within what rounding explains.
 *
 * @file test_beam5.c
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
#undef hub
#undef tip_x
#undef tip_y

#include "beam5.h"

typedef beam5_real real;

typedef struct {
    int checks;
    int failures;
} tally;

static void expect(tally *count, const char *what, real value, real right, real tolerance)
{
    ++count->checks;
    if (!(fabsf(value - right) <= tolerance)) {
        ++count->failures;
        printf("%s is %.17g, not %.17g within %.2g\n", what, (double)value, (double)right, (double)tolerance);
    }
}

static void expect_code(
    tally *count,
    const char *what,
    beam5_status value,
    beam5_status right)
{
    ++count->checks;
    if (value != right) {
        ++count->failures;
        printf("%s: status is %d, not %d\n", what, (int)value, (int)right);
    }
}

static void test_motion(tally *count)
{
    beam5_state state;
    beam5_inputs inputs;
    beam5_outputs outputs;
    beam5_status status;
    real initial_angle[BEAM5_STATIONS];
    real initial_rate[BEAM5_STATIONS];

    memset(&state, 0, sizeof state); /* padding too: it is compared below */

    for (int j = 0; j < BEAM5_STATIONS; ++j) {
        initial_angle[j] = (real)((7 * j + 3) % 16 - 8) / 64.0f;
    }
    for (int j = 0; j < BEAM5_STATIONS; ++j) {
        initial_rate[j] = (real)((7 * j + 3) % 16 - 8) / 64.0f;
    }
    inputs.hub_torque = -0.375f;
    status = beam5_initialise(&state, initial_angle, initial_rate, &inputs);
    expect_code(count, "initialise", status, BEAM5_OK);

    /* Step 1. */
    inputs.hub_torque = 0.25f;
    status = beam5_step(&state, &inputs);
    expect_code(count, "step 1", status, BEAM5_OK);
    beam5_output(&state, &outputs);
    expect(count, "hub", outputs.hub, -2.4471614353714572e-05f, 8.9e-10f);
    expect(count, "tip_x", outputs.tip_x, 0.9969939096612364f, 2.2e-06f);
    expect(count, "tip_y", outputs.tip_y, -0.00939825154850603f, 1.4e-07f);

    /* Step 2. */
    inputs.hub_torque = -0.25f;
    status = beam5_step(&state, &inputs);
    expect_code(count, "step 2", status, BEAM5_OK);
    beam5_output(&state, &outputs);
    expect(count, "hub", outputs.hub, -9.457053970571232e-05f, 8.9e-10f);
    expect(count, "tip_x", outputs.tip_x, 0.9972489550816658f, 2.2e-06f);
    expect(count, "tip_y", outputs.tip_y, -0.00950229615875876f, 1.4e-07f);

    /* Step 3. */
    inputs.hub_torque = 0.375f;
    status = beam5_step(&state, &inputs);
    expect_code(count, "step 3", status, BEAM5_OK);
    beam5_output(&state, &outputs);
    expect(count, "hub", outputs.hub, -0.00020321494221149923f, 8.9e-10f);
    expect(count, "tip_x", outputs.tip_x, 0.9975939801459514f, 2.2e-06f);
    expect(count, "tip_y", outputs.tip_y, -0.009689272690516988f, 1.4e-07f);

    /* State after the last step. */
    expect(count, "hub_angle", state.hub_angle, -0.00020321494221149923f, 8.9e-10f);
    expect(count, "hub_rate", state.hub_rate, -0.1260341770287053f, 3.2e-07f);
    expect(count, "hub_acceleration", state.hub_acceleration, -25.222785859280666f, 0.00016f);
    expect(count, "angle[0]", state.angle[0], -0.06621437481844797f, 2.9e-07f);
    expect(count, "angle[1]", state.angle[1], 0.006045019163412799f, 2.9e-07f);
    expect(count, "angle[2]", state.angle[2], -0.0906026354207628f, 2.9e-07f);
    expect(count, "angle[3]", state.angle[3], -0.0045452361629078454f, 2.9e-07f);
    expect(count, "angle[4]", state.angle[4], 0.10690210329020969f, 2.9e-07f);
    expect(count, "rate[0]", state.rate[0], 7.295175822685509f, 7.1e-05f);
    expect(count, "rate[1]", state.rate[1], -15.282998170414164f, 7.1e-05f);
    expect(count, "rate[2]", state.rate[2], 11.206120137087476f, 7.1e-05f);
    expect(count, "rate[3]", state.rate[3], -2.0276062292465076f, 7.1e-05f);
    expect(count, "rate[4]", state.rate[4], -2.305371158241009f, 7.1e-05f);
    expect(count, "acceleration[0]", state.acceleration[0], 1567.1157872553f, 0.041f);
    expect(count, "acceleration[1]", state.acceleration[1], -3209.564280429331f, 0.041f);
    expect(count, "acceleration[2]", state.acceleration[2], 2083.4853949062076f, 0.041f);
    expect(count, "acceleration[3]", state.acceleration[3], 468.3010078138665f, 0.041f);
    expect(count, "acceleration[4]", state.acceleration[4], -1418.3634397666137f, 0.041f);

    /* Bad input is refused and leaves the state alone. */
    beam5_state before;
    memcpy(&before, &state, sizeof before);
    const real bad[] = {(real)NAN, (real)INFINITY, -(real)INFINITY};
    for (int k = 0; k < 3; ++k) {
        real good;
        good = inputs.hub_torque;
        inputs.hub_torque = bad[k];
        status = beam5_step(&state, &inputs);
        expect_code(count, "bad hub_torque", status, BEAM5_NON_FINITE_INPUT);
        inputs.hub_torque = good;
    }
    ++count->checks;
    if (memcmp(&before, &state, sizeof state) != 0) {
        ++count->failures;
        printf("bad input has changed the state\n");
    }
}

/* Arrays that are absent are the scene's own; any other pointer that is absent is refused. */
static void test_absent(tally *count)
{
    beam5_state state;
    beam5_inputs inputs;
    beam5_status status;

    memset(&inputs, 0, sizeof inputs);
    status = beam5_initialise(NULL, NULL, NULL, &inputs);
    expect_code(count, "no state", status, BEAM5_NULL_POINTER);
    status = beam5_initialise(&state, NULL, NULL, &inputs);
    expect_code(count, "the scene's start", status, BEAM5_OK);
    status = beam5_step(NULL, &inputs);
    expect_code(count, "no state", status, BEAM5_NULL_POINTER);
    status = beam5_initialise(&state, NULL, NULL, NULL);
    expect_code(count, "no inputs", status, BEAM5_NULL_POINTER);
    status = beam5_step(&state, NULL);
    expect_code(count, "no inputs", status, BEAM5_NULL_POINTER);
    beam5_output(&state, NULL);
}

int main(void)
{
    tally count = {0, 0};

    test_motion(&count);
    test_absent(&count);
    if (count.failures > 0) {
        printf("%d of %d checks failed\n", count.failures, count.checks);
        return 1;
    }
    printf("%d checks passed\n", count.checks);
    return 0;
}

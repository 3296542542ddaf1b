/**
 * cube: Satellite with two flexible panels
 *
 * Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: f046f23ff154c77eb0de6f429bf04f6275910b87af75eea62b4aa0e7be8a3583
 * sha256 of the rest of this file: dfc91b1df4aa89c34743238becf7e8bb5ca54708f6445307f53496f19571c084
 *
 * model: planar arm, large rotations
 * stations: 12
 * base: free
 * integrator: Newmark 1959, beta = 0.25, gamma = 0.5
 * linearisation: newton
 * sweep: riccati
 * unknown: acceleration
 * joints in arrays, from 0: left_latch 0, right_latch 6
 * links in arrays, from 0: left_yoke 0, left_panel 1 to 5, right_yoke 6, right_panel 7 to 11
 * operations of a step: 1462, 121.8 per station (686 additions, 734 multiplications, 18 divisions, 24 sines
 *     and cosines)
 * operations of prepare: 201, 16.75 per station (62 additions, 139 multiplications)
 * number type: double
 * bytes of the structs: params 600, model 720, state 360, inputs 16, outputs 48
 *
 * A test for any machine: the kernel against 30 digits, within what rounding explains.
 *
 * @file test_cube.c
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
#undef wheel
#undef thruster
#undef attitude
#undef hub_x
#undef hub_y
#undef right_end_x
#undef right_end_y
#undef latch_torque

#include "cube.h"

typedef cube_real real;

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
    cube_status value,
    cube_status right)
{
    ++count->checks;
    if (value != right) {
        ++count->failures;
        printf("%s: status is %d, not %d\n", what, (int)value, (int)right);
    }
}

static void test_motion(tally *count)
{
    cube_params params;
    cube_model model;
    cube_state state;
    cube_inputs inputs;
    cube_outputs outputs;
    cube_status status;
    real initial_angle[CUBE_STATIONS];
    real initial_rate[CUBE_STATIONS];

    memset(&state, 0, sizeof state); /* padding too: it is compared below */
    cube_default_params(&params);
    status = cube_prepare(&model, &params, CUBE_STEP);
    expect_code(count, "prepare", status, CUBE_OK);

    for (int j = 0; j < CUBE_STATIONS; ++j) {
        initial_angle[j] = (real)((7 * j + 3) % 16 - 8) / 64.0;
    }
    for (int j = 0; j < CUBE_STATIONS; ++j) {
        initial_rate[j] = (real)((7 * j + 3) % 16 - 8) / 64.0;
    }
    inputs.wheel = -0.375;
    inputs.thruster = 0.0;
    status = cube_initialise(&state, &params, initial_angle, initial_rate, &inputs);
    expect_code(count, "initialise", status, CUBE_OK);

    /* Step 1. */
    inputs.wheel = 0.25;
    inputs.thruster = -0.5;
    status = cube_step(&model, &state, &inputs);
    expect_code(count, "step 1", status, CUBE_OK);
    cube_output(&model, &state, &outputs);
    expect(count, "attitude", outputs.attitude, -0.0030745674449535326, 1.5e-16);
    expect(count, "hub_x", outputs.hub_x, 0.00013958997158731128, 3.6e-17);
    expect(count, "hub_y", outputs.hub_y, -0.00017178210364818144, 1.3e-17);
    expect(count, "right_end_x", outputs.right_end_x, 1.048576089888524, 3.2e-15);
    expect(count, "right_end_y", outputs.right_end_y, -0.01715426117205965, 6e-16);
    expect(count, "latch_torque", outputs.latch_torque, -3.8133190997880986, 6.2e-14);

    /* Step 2. */
    inputs.wheel = -0.25;
    inputs.thruster = 0.125;
    status = cube_step(&model, &state, &inputs);
    expect_code(count, "step 2", status, CUBE_OK);
    cube_output(&model, &state, &outputs);
    expect(count, "attitude", outputs.attitude, -0.012106800522394753, 1.5e-16);
    expect(count, "hub_x", outputs.hub_x, 0.000882502411481677, 3.6e-17);
    expect(count, "hub_y", outputs.hub_y, -0.0006025024876685401, 1.3e-17);
    expect(count, "right_end_x", outputs.right_end_x, 1.0504423208066678, 3.2e-15);
    expect(count, "right_end_y", outputs.right_end_y, -0.013063832354481487, 6e-16);
    expect(count, "latch_torque", outputs.latch_torque, -2.4394183893309496, 6.2e-14);

    /* Step 3. */
    inputs.wheel = 0.375;
    inputs.thruster = -0.375;
    status = cube_step(&model, &state, &inputs);
    expect_code(count, "step 3", status, CUBE_OK);
    cube_output(&model, &state, &outputs);
    expect(count, "attitude", outputs.attitude, -0.026651364788664655, 1.5e-16);
    expect(count, "hub_x", outputs.hub_x, 0.0022530025018137755, 3.6e-17);
    expect(count, "hub_y", outputs.hub_y, -0.00116530467899589, 1.3e-17);
    expect(count, "right_end_x", outputs.right_end_x, 1.0515848381340664, 3.2e-15);
    expect(count, "right_end_y", outputs.right_end_y, -0.011789300072389137, 6e-16);
    expect(count, "latch_torque", outputs.latch_torque, -1.8050700247935108, 6.2e-14);

    /* State after the last step. */
    expect(count, "hub_angle", state.hub_angle, -0.026651364788664655, 1.5e-16);
    expect(count, "hub_rate", state.hub_rate, -8.586898633782214, 3.6e-14);
    expect(count, "hub_acceleration", state.hub_acceleration, -1246.7809319190067, 1.2e-11);
    expect(count, "angle[0]", state.angle[0], 0.5411990289822058, 5.5e-15);
    expect(count, "angle[1]", state.angle[1], -0.482382794671739, 5.5e-15);
    expect(count, "angle[2]", state.angle[2], 0.009615939357240361, 5.5e-15);
    expect(count, "angle[4]", state.angle[4], 0.0101021204536081, 5.5e-15);
    expect(count, "angle[5]", state.angle[5], 0.1737704595436577, 5.5e-15);
    expect(count, "angle[6]", state.angle[6], 0.004129448580234857, 5.5e-15);
    expect(count, "angle[7]", state.angle[7], 0.04320930294666788, 5.5e-15);
    expect(count, "angle[9]", state.angle[9], -0.025736270636093194, 5.5e-15);
    expect(count, "angle[10]", state.angle[10], -0.05301180446643123, 5.5e-15);
    expect(count, "angle[11]", state.angle[11], 0.023524181277558103, 5.5e-15);
    expect(count, "rate[0]", state.rate[0], 122.95078806927027, 1.9e-12);
    expect(count, "rate[1]", state.rate[1], -71.43021128837492, 1.9e-12);
    expect(count, "rate[2]", state.rate[2], -1.6075680023971823, 1.9e-12);
    expect(count, "rate[4]", state.rate[4], -18.896525799336025, 1.9e-12);
    expect(count, "rate[5]", state.rate[5], 6.764764485469358, 1.9e-12);
    expect(count, "rate[6]", state.rate[6], -10.67583750080521, 1.9e-12);
    expect(count, "rate[7]", state.rate[7], 15.23484599249351, 1.9e-12);
    expect(count, "rate[9]", state.rate[9], 8.010191206288885, 1.9e-12);
    expect(count, "rate[10]", state.rate[10], -4.099253310754681, 1.9e-12);
    expect(count, "rate[11]", state.rate[11], -3.0506670876673723, 1.9e-12);
    expect(count, "acceleration[0]", state.acceleration[0], -3349.607449624063, 9.4e-10);
    expect(count, "acceleration[1]", state.acceleration[1], 30157.098319000175, 9.4e-10);
    expect(count, "acceleration[2]", state.acceleration[2], -28963.68778921849, 9.4e-10);
    expect(count, "acceleration[4]", state.acceleration[4], 6692.7894128436765, 9.4e-10);
    expect(count, "acceleration[5]", state.acceleration[5], -34528.78074254761, 9.4e-10);
    expect(count, "acceleration[6]", state.acceleration[6], 6004.32756604663, 9.4e-10);
    expect(count, "acceleration[7]", state.acceleration[7], -8198.9164166524, 9.4e-10);
    expect(count, "acceleration[9]", state.acceleration[9], -5597.393071628067, 9.4e-10);
    expect(count, "acceleration[10]", state.acceleration[10], 6828.478856705886, 9.4e-10);
    expect(count, "acceleration[11]", state.acceleration[11], -19536.340867002127, 9.4e-10);
    expect(count, "base_place_x", state.base_place_x, 0.0022530025018137755, 3.6e-17);
    expect(count, "base_velocity_x", state.base_velocity_x, 0.7671776220250439, 1.7e-14);
    expect(count, "base_acceleration_x", state.base_acceleration_x, -18.429948705879266, 5.5e-12);
    expect(count, "base_place_y", state.base_place_y, -0.00116530467899589, 1.3e-17);
    expect(count, "base_velocity_y", state.base_velocity_y, -0.3038639109551728, 4.6e-15);
    expect(count, "base_acceleration_y", state.base_acceleration_y, -35.62998843068546, 1.5e-12);

    /* Bad input is refused and leaves the state alone. */
    cube_state before;
    memcpy(&before, &state, sizeof before);
    const real bad[] = {(real)NAN, (real)INFINITY, -(real)INFINITY};
    for (int k = 0; k < 3; ++k) {
        real good;
        good = inputs.wheel;
        inputs.wheel = bad[k];
        status = cube_step(&model, &state, &inputs);
        expect_code(count, "bad wheel", status, CUBE_NON_FINITE_INPUT);
        inputs.wheel = good;
        good = inputs.thruster;
        inputs.thruster = bad[k];
        status = cube_step(&model, &state, &inputs);
        expect_code(count, "bad thruster", status, CUBE_NON_FINITE_INPUT);
        inputs.thruster = good;
    }
    ++count->checks;
    if (memcmp(&before, &state, sizeof state) != 0) {
        ++count->failures;
        printf("bad input has changed the state\n");
    }
}

static void test_refusals(tally *count)
{
    cube_params params;
    cube_model model;
    cube_status status;

    cube_default_params(&params);
    status = cube_prepare(&model, &params, 0.0);
    expect_code(count, "no step", status, CUBE_INVALID_STEP);
    status = cube_prepare(&model, &params, (real)NAN);
    expect_code(count, "bad step", status, CUBE_INVALID_STEP);

    cube_default_params(&params);
    params.length[CUBE_STATIONS - 1] = (real)NAN;
    status = cube_prepare(&model, &params, CUBE_STEP);
    expect_code(count, "bad length", status, CUBE_NON_FINITE_INPUT);

    cube_default_params(&params);
    params.mass[CUBE_STATIONS - 1] = (real)NAN;
    status = cube_prepare(&model, &params, CUBE_STEP);
    expect_code(count, "bad mass", status, CUBE_NON_FINITE_INPUT);

    cube_default_params(&params);
    params.inertia[CUBE_STATIONS - 1] = (real)NAN;
    status = cube_prepare(&model, &params, CUBE_STEP);
    expect_code(count, "bad inertia", status, CUBE_NON_FINITE_INPUT);

    cube_default_params(&params);
    params.center = (real)NAN;
    status = cube_prepare(&model, &params, CUBE_STEP);
    expect_code(count, "bad center", status, CUBE_NON_FINITE_INPUT);

    cube_default_params(&params);
    params.stiffness[CUBE_STATIONS - 1] = (real)NAN;
    status = cube_prepare(&model, &params, CUBE_STEP);
    expect_code(count, "bad stiffness", status, CUBE_NON_FINITE_INPUT);

    cube_default_params(&params);
    params.damping[CUBE_STATIONS - 1] = (real)NAN;
    status = cube_prepare(&model, &params, CUBE_STEP);
    expect_code(count, "bad damping", status, CUBE_NON_FINITE_INPUT);

    cube_default_params(&params);
    params.rest[CUBE_STATIONS - 1] = (real)NAN;
    status = cube_prepare(&model, &params, CUBE_STEP);
    expect_code(count, "bad rest", status, CUBE_NON_FINITE_INPUT);

    cube_default_params(&params);
    params.hub_inertia = (real)NAN;
    status = cube_prepare(&model, &params, CUBE_STEP);
    expect_code(count, "bad hub_inertia", status, CUBE_NON_FINITE_INPUT);

    cube_default_params(&params);
    params.hub_mass = (real)NAN;
    status = cube_prepare(&model, &params, CUBE_STEP);
    expect_code(count, "bad hub_mass", status, CUBE_NON_FINITE_INPUT);
}

/* Arrays that are absent are the scene's own; any other pointer that is absent is refused. */
static void test_absent(tally *count)
{
    cube_params params;
    cube_model model;
    cube_state state;
    cube_inputs inputs;
    cube_status status;

    memset(&inputs, 0, sizeof inputs);
    cube_default_params(&params);
    cube_default_params(NULL);
    status = cube_prepare(NULL, &params, CUBE_STEP);
    expect_code(count, "no model", status, CUBE_NULL_POINTER);
    status = cube_prepare(&model, NULL, CUBE_STEP);
    expect_code(count, "no parameters", status, CUBE_NULL_POINTER);
    status = cube_prepare(&model, &params, CUBE_STEP);
    expect_code(count, "prepare", status, CUBE_OK);
    status = cube_initialise(NULL, &params, NULL, NULL, &inputs);
    expect_code(count, "no state", status, CUBE_NULL_POINTER);
    status = cube_initialise(&state, &params, NULL, NULL, &inputs);
    expect_code(count, "the scene's start", status, CUBE_OK);
    status = cube_step(&model, NULL, &inputs);
    expect_code(count, "no state", status, CUBE_NULL_POINTER);
    status = cube_step(NULL, &state, &inputs);
    expect_code(count, "no model", status, CUBE_NULL_POINTER);
    status = cube_initialise(&state, &params, NULL, NULL, NULL);
    expect_code(count, "no inputs", status, CUBE_NULL_POINTER);
    status = cube_step(&model, &state, NULL);
    expect_code(count, "no inputs", status, CUBE_NULL_POINTER);
    cube_output(&model, &state, NULL);
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

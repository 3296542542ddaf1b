/**
 * beam5: Five-link arm on a hub, the model of an observer
 *
 * Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: 7cda6afdfe9f28eb257c67670c83631d86f159a73ec0c14225ebe1e38843e797
 * sha256 of the rest of this file: 444532c380df1aa7efddd0a0a9b056a8a7aec0b3d2e60e19d703cec66890bf42
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
 * Parameters and time step are constants of the code. Call beam5_initialise() to put the arm somewhere, then
 * beam5_step() at every tick of the clock and beam5_output() to know. All memory is the caller's; nothing is
 * kept between calls, so any number of arms can be run side by side.
 *
 * @file beam5.h
 */
#ifndef TMM_GEN_KERNEL_beam5
#define TMM_GEN_KERNEL_beam5

#ifdef __cplusplus
extern "C" {
#endif

/** Number of links. */
#define BEAM5_STATIONS 5

/** The time step, a constant of the code [s]. */
#define BEAM5_STEP 0.001f

/** Largest angle, either way, of which a step takes sine and cosine [rad]. */
#define BEAM5_LARGEST_ANGLE 6433.0f

/** Type of all numbers. */
typedef float beam5_real;

/** What a function says about its success. */
typedef enum {
    /** Success. */
    BEAM5_OK = 0,
    /** An argument is infinite or not a number; nothing was changed. */
    BEAM5_NON_FINITE_INPUT,
    /** The time step is not a positive number; nothing was changed. */
    BEAM5_INVALID_STEP,
    /** No passive arm has such parameters (a negative inertia, say); the model is of no use. */
    BEAM5_VANISHING_PIVOT,
    /** The motion has outgrown the number type; initialise anew. */
    BEAM5_NON_FINITE_STATE,
    /** An angle is beyond BEAM5_LARGEST_ANGLE; nothing was changed. */
    BEAM5_OUT_OF_RANGE,
    /** A pointer that is needed is NULL; nothing was changed. */
    BEAM5_NULL_POINTER = 6
} beam5_status;

/** Motion of the arm, and the history its integrator needs. */
typedef struct {
    beam5_real hub_angle; /**< hub angle [rad] */
    beam5_real hub_rate; /**< hub rate [rad/s] */
    beam5_real hub_acceleration; /**< hub acceleration [rad/s^2] */
    beam5_real angle[BEAM5_STATIONS]; /**< angle of each link, base to tip [rad] */
    beam5_real rate[BEAM5_STATIONS]; /**< rate of each link, base to tip [rad/s] */
    beam5_real acceleration[BEAM5_STATIONS]; /**< acceleration of each link, base to tip [rad/s^2] */
} beam5_state;

/** What acts on the arm. */
typedef struct {
#ifndef hub_torque
    beam5_real hub_torque; /**< torque acting at the base [N m] */
#else /* a macro would replace the name */
    beam5_real tmm_hub_torque;
#endif
} beam5_inputs;

/** What the scene asks to know. */
typedef struct {
#ifndef hub
    beam5_real hub; /**< angle at the base [rad] */
#else /* a macro would replace the name */
    beam5_real tmm_hub;
#endif
#ifndef tip_x
    beam5_real tip_x; /**< position at the tip, x [m] */
#else /* a macro would replace the name */
    beam5_real tmm_tip_x;
#endif
#ifndef tip_y
    beam5_real tip_y; /**< position at the tip, y [m] */
#else /* a macro would replace the name */
    beam5_real tmm_tip_y;
#endif
} beam5_outputs;

/**
 * Start from given angles and rates with the acceleration that satisfies the equations of motion.
 *
 * @param[out] state   motion at the initial instant
 * @param[in]  initial_angle  angles to start from [rad]; NULL for the scene's own
 * @param[in]  initial_rate  rates to start from [rad/s]; NULL for the scene's own
 * @param[in]  inputs  what acts at the initial instant
 * @return OK, NON_FINITE_INPUT, NULL_POINTER, VANISHING_PIVOT, NON_FINITE_STATE or OUT_OF_RANGE
 */
beam5_status beam5_initialise(
    beam5_state *state,
    const beam5_real initial_angle[BEAM5_STATIONS],
    const beam5_real initial_rate[BEAM5_STATIONS],
    const beam5_inputs *inputs);

/**
 * Advance the state by one step.
 *
 * @param[in,out] state   motion before the step, and after it
 * @param[in]     inputs  what acts, at the end of the step
 * @return OK, NON_FINITE_INPUT, NULL_POINTER, VANISHING_PIVOT, NON_FINITE_STATE or OUT_OF_RANGE
 */
beam5_status beam5_step(
    beam5_state *state,
    const beam5_inputs *inputs);

/**
 * Read the outputs off the state. Nothing is done where a pointer is NULL.
 *
 * @param[in]  state    motion
 * @param[out] outputs  what the scene asks for
 */
void beam5_output(
    const beam5_state *state,
    beam5_outputs *outputs);

#ifdef __cplusplus
}
#endif

#endif /* TMM_GEN_KERNEL_beam5 */

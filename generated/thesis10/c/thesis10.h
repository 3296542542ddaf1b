/**
 * thesis10: Ten-station torsional chain, Gholampour (2018), table 4-1
 *
 * Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: f0c976d21d4524b79e43b0ef658e9df768725b961ac09b0a12bdaf9596a590df
 * sha256 of the rest of this file: 5d605a858b58ca8d09f4722b65b89d890f2cf6d1495b1d9794a2aafa8f93c692
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
 * Call thesis10_default_params() and thesis10_prepare() once, thesis10_initialise() to put the arm somewhere,
 * then thesis10_step() at every tick of the clock and thesis10_output() to know. All memory is the caller's;
 * nothing is kept between calls, so any number of arms can be run side by side.
 *
 * @file thesis10.h
 */
#ifndef TMM_GEN_KERNEL_thesis10
#define TMM_GEN_KERNEL_thesis10

#ifdef __cplusplus
extern "C" {
#endif

/** Number of links. */
#define THESIS10_STATIONS 10

/** The scene's time step [s]. */
#define THESIS10_STEP 0.01

/** Type of all numbers. */
typedef double thesis10_real;

/** What a function says about its success. */
typedef enum {
    /** Success. */
    THESIS10_OK = 0,
    /** An argument is infinite or not a number; nothing was changed. */
    THESIS10_NON_FINITE_INPUT,
    /** The time step is not a positive number; nothing was changed. */
    THESIS10_INVALID_STEP,
    /** No passive arm has such parameters (a negative inertia, say); the model is of no use. */
    THESIS10_VANISHING_PIVOT,
    /** The motion has outgrown the number type; initialise anew. */
    THESIS10_NON_FINITE_STATE,
    /** A pointer that is needed is NULL; nothing was changed. */
    THESIS10_NULL_POINTER = 6,
    /** Parameters or time step are too large or too small for the number type; the model is of no use. */
    THESIS10_NON_FINITE_MODEL = 7
} thesis10_status;

/** Physical parameters. */
typedef struct {
    thesis10_real stiffness; /**< joint stiffness, the same everywhere [N m/rad] */
    thesis10_real damping; /**< joint damping, the same everywhere [N m s/rad] */
    thesis10_real inertia; /**< link inertia, the same everywhere [kg m^2] */
} thesis10_params;

/** What prepare() derives from the parameters and the time step. */
typedef struct {
    thesis10_real step; /**< time step [s] */
    thesis10_real stiffness; /**< joint stiffness, the same everywhere [N m/rad] */
    thesis10_real damping; /**< joint damping, the same everywhere [N m s/rad] */
    thesis10_real rate_per_acceleration; /**< rate per unit of acceleration: step/2 [s] */
    thesis10_real angle_per_acceleration; /**< angle per unit of acceleration: step**2/4 [s^2] */
    thesis10_real admittance[THESIS10_STATIONS]; /**< inverse pivot of each joint */
    thesis10_real transmission[THESIS10_STATIONS]; /**< share of motion and torque each joint passes on */
    thesis10_real reflection[THESIS10_STATIONS]; /**< share of its own known torque each joint passes on */
} thesis10_model;

/** Motion of the arm, and the history its integrator needs. */
typedef struct {
    thesis10_real angle[THESIS10_STATIONS]; /**< angle of each link, base to tip [rad] */
    thesis10_real rate[THESIS10_STATIONS]; /**< rate of each link, base to tip [rad/s] */
    thesis10_real acceleration[THESIS10_STATIONS]; /**< acceleration of each link, base to tip [rad/s^2] */
} thesis10_state;

/** What acts on the arm. */
typedef struct {
#ifndef tip_torque
    thesis10_real tip_torque; /**< torque acting at the tip [N m] */
#else /* a macro would replace the name */
    thesis10_real tmm_tip_torque;
#endif
} thesis10_inputs;

/** What the scene asks to know. */
typedef struct {
#ifndef tip
    thesis10_real tip; /**< angle at the tip [rad] */
#else /* a macro would replace the name */
    thesis10_real tmm_tip;
#endif
#ifndef base_torque
    thesis10_real base_torque; /**< torque at the base [N m] */
#else /* a macro would replace the name */
    thesis10_real tmm_base_torque;
#endif
} thesis10_outputs;

/**
 * Write the scene's parameters.
 *
 * @param[out] params  parameters; nothing is done where it is NULL
 */
void thesis10_default_params(thesis10_params *params);

/**
 * Compute what depends on parameters and step alone.
 *
 * @param[out] model   what the other functions need
 * @param[in]  params  parameters
 * @param[in]  step    time step [s]
 * @return OK, NON_FINITE_INPUT, NULL_POINTER, INVALID_STEP, VANISHING_PIVOT or NON_FINITE_MODEL
 */
thesis10_status thesis10_prepare(
    thesis10_model *model,
    const thesis10_params *params,
    thesis10_real step);

/**
 * Start from given angles and rates with the acceleration that satisfies the equations of motion.
 *
 * @param[out] state   motion at the initial instant
 * @param[in]  params  parameters
 * @param[in]  initial_angle  angles to start from [rad]; NULL for the scene's own
 * @param[in]  initial_rate  rates to start from [rad/s]; NULL for the scene's own
 * @param[in]  inputs  what acts at the initial instant
 * @return OK, NON_FINITE_INPUT, NULL_POINTER or NON_FINITE_STATE
 */
thesis10_status thesis10_initialise(
    thesis10_state *state,
    const thesis10_params *params,
    const thesis10_real initial_angle[THESIS10_STATIONS],
    const thesis10_real initial_rate[THESIS10_STATIONS],
    const thesis10_inputs *inputs);

/**
 * Advance the state by one step.
 *
 * @param[in]     model   from thesis10_prepare()
 * @param[in,out] state   motion before the step, and after it
 * @param[in]     inputs  what acts, at the end of the step
 * @return OK, NON_FINITE_INPUT, NULL_POINTER or NON_FINITE_STATE
 */
thesis10_status thesis10_step(
    const thesis10_model *model,
    thesis10_state *state,
    const thesis10_inputs *inputs);

/**
 * Read the outputs off the state. Nothing is done where a pointer is NULL.
 *
 * @param[in]  model    from thesis10_prepare()
 * @param[in]  state    motion
 * @param[out] outputs  what the scene asks for
 */
void thesis10_output(
    const thesis10_model *model,
    const thesis10_state *state,
    thesis10_outputs *outputs);

#ifdef __cplusplus
}
#endif

#endif /* TMM_GEN_KERNEL_thesis10 */

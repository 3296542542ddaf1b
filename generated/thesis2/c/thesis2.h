/**
 * thesis2: Two-station torsional chain, Gholampour (2018), table 3-2
 *
 * Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: 8302c2fdab02afb73919e09c91c3abafc3d83d0760e2c0e63be40bfdc341e62e
 * sha256 of the rest of this file: a67aebda964d6cfd730b9a51eb1356a4477de8c9ac9ef67db65b2dccce941e65
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
 * Call thesis2_default_params() and thesis2_prepare() once, thesis2_initialise() to put the arm somewhere,
 * then thesis2_step() at every tick of the clock and thesis2_output() to know. All memory is the caller's;
 * nothing is kept between calls, so any number of arms can be run side by side.
 *
 * @file thesis2.h
 */
#ifndef TMM_GEN_KERNEL_thesis2
#define TMM_GEN_KERNEL_thesis2

#ifdef __cplusplus
extern "C" {
#endif

/** Number of links. */
#define THESIS2_STATIONS 2

/** The scene's time step [s]. */
#define THESIS2_STEP 0.01

/** Type of all numbers. */
typedef double thesis2_real;

/** What a function says about its success. */
typedef enum {
    /** Success. */
    THESIS2_OK = 0,
    /** An argument is infinite or not a number; nothing was changed. */
    THESIS2_NON_FINITE_INPUT,
    /** The time step is not a positive number; nothing was changed. */
    THESIS2_INVALID_STEP,
    /** No passive arm has such parameters (a negative inertia, say); the model is of no use. */
    THESIS2_VANISHING_PIVOT,
    /** The motion has outgrown the number type; initialise anew. */
    THESIS2_NON_FINITE_STATE,
    /** A pointer that is needed is NULL; nothing was changed. */
    THESIS2_NULL_POINTER = 6,
    /** Parameters or time step are too large or too small for the number type; the model is of no use. */
    THESIS2_NON_FINITE_MODEL = 7
} thesis2_status;

/** Physical parameters. */
typedef struct {
    thesis2_real stiffness; /**< joint stiffness, the same everywhere [N m/rad] */
    thesis2_real damping; /**< joint damping, the same everywhere [N m s/rad] */
    thesis2_real inertia; /**< link inertia, the same everywhere [kg m^2] */
} thesis2_params;

/** What prepare() derives from the parameters and the time step. */
typedef struct {
    thesis2_real step; /**< time step [s] */
    thesis2_real stiffness; /**< joint stiffness, the same everywhere [N m/rad] */
    thesis2_real damping; /**< joint damping, the same everywhere [N m s/rad] */
    thesis2_real rate_per_acceleration; /**< rate per unit of acceleration: step/2 [s] */
    thesis2_real angle_per_acceleration; /**< angle per unit of acceleration: step**2/4 [s^2] */
    thesis2_real admittance[THESIS2_STATIONS]; /**< inverse pivot of each joint */
    thesis2_real transmission[THESIS2_STATIONS]; /**< share of motion and torque each joint passes on */
    thesis2_real reflection[THESIS2_STATIONS]; /**< share of its own known torque each joint passes on */
} thesis2_model;

/** Motion of the arm, and the history its integrator needs. */
typedef struct {
    thesis2_real angle[THESIS2_STATIONS]; /**< angle of each link, base to tip [rad] */
    thesis2_real rate[THESIS2_STATIONS]; /**< rate of each link, base to tip [rad/s] */
    thesis2_real acceleration[THESIS2_STATIONS]; /**< acceleration of each link, base to tip [rad/s^2] */
} thesis2_state;

/** What acts on the arm. */
typedef struct {
#ifndef tip_torque
    thesis2_real tip_torque; /**< torque acting at the tip [N m] */
#else /* a macro would replace the name */
    thesis2_real tmm_tip_torque;
#endif
} thesis2_inputs;

/** What the scene asks to know. */
typedef struct {
#ifndef tip
    thesis2_real tip; /**< angle at the tip [rad] */
#else /* a macro would replace the name */
    thesis2_real tmm_tip;
#endif
#ifndef base_torque
    thesis2_real base_torque; /**< torque at the base [N m] */
#else /* a macro would replace the name */
    thesis2_real tmm_base_torque;
#endif
} thesis2_outputs;

/**
 * Write the scene's parameters.
 *
 * @param[out] params  parameters; nothing is done where it is NULL
 */
void thesis2_default_params(thesis2_params *params);

/**
 * Compute what depends on parameters and step alone.
 *
 * @param[out] model   what the other functions need
 * @param[in]  params  parameters
 * @param[in]  step    time step [s]
 * @return OK, NON_FINITE_INPUT, NULL_POINTER, INVALID_STEP, VANISHING_PIVOT or NON_FINITE_MODEL
 */
thesis2_status thesis2_prepare(
    thesis2_model *model,
    const thesis2_params *params,
    thesis2_real step);

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
thesis2_status thesis2_initialise(
    thesis2_state *state,
    const thesis2_params *params,
    const thesis2_real initial_angle[THESIS2_STATIONS],
    const thesis2_real initial_rate[THESIS2_STATIONS],
    const thesis2_inputs *inputs);

/**
 * Advance the state by one step.
 *
 * @param[in]     model   from thesis2_prepare()
 * @param[in,out] state   motion before the step, and after it
 * @param[in]     inputs  what acts, at the end of the step
 * @return OK, NON_FINITE_INPUT, NULL_POINTER or NON_FINITE_STATE
 */
thesis2_status thesis2_step(
    const thesis2_model *model,
    thesis2_state *state,
    const thesis2_inputs *inputs);

/**
 * Read the outputs off the state. Nothing is done where a pointer is NULL.
 *
 * @param[in]  model    from thesis2_prepare()
 * @param[in]  state    motion
 * @param[out] outputs  what the scene asks for
 */
void thesis2_output(
    const thesis2_model *model,
    const thesis2_state *state,
    thesis2_outputs *outputs);

#ifdef __cplusplus
}
#endif

#endif /* TMM_GEN_KERNEL_thesis2 */

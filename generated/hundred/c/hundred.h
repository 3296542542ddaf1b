/**
 * hundred: Uniform shaft of a hundred stations
 *
 * Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: 1ec2a071f5720229c3b5c9d847fa0a44d6fa112015051ca13c1d73444e6eb10a
 * sha256 of the rest of this file: a2007c7a886ef5228623d246e475f45840c000c0d8a1da233f894bc8255f6aa9
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
 * Call hundred_default_params() and hundred_prepare() once, hundred_initialise() to put the arm somewhere,
 * then hundred_step() at every tick of the clock and hundred_output() to know. All memory is the caller's;
 * nothing is kept between calls, so any number of arms can be run side by side.
 *
 * @file hundred.h
 */
#ifndef TMM_GEN_KERNEL_hundred
#define TMM_GEN_KERNEL_hundred

#ifdef __cplusplus
extern "C" {
#endif

/** Number of links. */
#define HUNDRED_STATIONS 100

/** The scene's time step [s]. */
#define HUNDRED_STEP 0.001

/** Type of all numbers. */
typedef double hundred_real;

/** What a function says about its success. */
typedef enum {
    /** Success. */
    HUNDRED_OK = 0,
    /** An argument is infinite or not a number; nothing was changed. */
    HUNDRED_NON_FINITE_INPUT,
    /** The time step is not a positive number; nothing was changed. */
    HUNDRED_INVALID_STEP,
    /** No passive arm has such parameters (a negative inertia, say); the model is of no use. */
    HUNDRED_VANISHING_PIVOT,
    /** The motion has outgrown the number type; initialise anew. */
    HUNDRED_NON_FINITE_STATE,
    /** A pointer that is needed is NULL; nothing was changed. */
    HUNDRED_NULL_POINTER = 6,
    /** Parameters or time step are too large or too small for the number type; the model is of no use. */
    HUNDRED_NON_FINITE_MODEL = 7
} hundred_status;

/** Physical parameters. */
typedef struct {
    hundred_real stiffness; /**< joint stiffness, the same everywhere [N m/rad] */
    hundred_real damping; /**< joint damping, the same everywhere [N m s/rad] */
    hundred_real inertia; /**< link inertia, the same everywhere [kg m^2] */
} hundred_params;

/** What prepare() derives from the parameters and the time step. */
typedef struct {
    hundred_real step; /**< time step [s] */
    hundred_real stiffness; /**< joint stiffness, the same everywhere [N m/rad] */
    hundred_real damping; /**< joint damping, the same everywhere [N m s/rad] */
    hundred_real rate_per_acceleration; /**< rate per unit of acceleration: step/2 [s] */
    hundred_real angle_per_acceleration; /**< angle per unit of acceleration: step**2/4 [s^2] */
    hundred_real admittance[HUNDRED_STATIONS]; /**< inverse pivot of each joint */
    hundred_real transmission[HUNDRED_STATIONS]; /**< share of motion and torque each joint passes on */
    hundred_real reflection[HUNDRED_STATIONS]; /**< share of its own known torque each joint passes on */
} hundred_model;

/** Motion of the arm, and the history its integrator needs. */
typedef struct {
    hundred_real angle[HUNDRED_STATIONS]; /**< angle of each link, base to tip [rad] */
    hundred_real rate[HUNDRED_STATIONS]; /**< rate of each link, base to tip [rad/s] */
    hundred_real acceleration[HUNDRED_STATIONS]; /**< acceleration of each link, base to tip [rad/s^2] */
} hundred_state;

/** What acts on the arm. */
typedef struct {
#ifndef tip_torque
    hundred_real tip_torque; /**< torque acting at the tip [N m] */
#else /* a macro would replace the name */
    hundred_real tmm_tip_torque;
#endif
} hundred_inputs;

/** What the scene asks to know. */
typedef struct {
#ifndef tip
    hundred_real tip; /**< angle at the tip [rad] */
#else /* a macro would replace the name */
    hundred_real tmm_tip;
#endif
#ifndef middle
    hundred_real middle; /**< angle at station 50 [rad] */
#else /* a macro would replace the name */
    hundred_real tmm_middle;
#endif
#ifndef base_torque
    hundred_real base_torque; /**< torque at the base [N m] */
#else /* a macro would replace the name */
    hundred_real tmm_base_torque;
#endif
} hundred_outputs;

/**
 * Write the scene's parameters.
 *
 * @param[out] params  parameters; nothing is done where it is NULL
 */
void hundred_default_params(hundred_params *params);

/**
 * Compute what depends on parameters and step alone.
 *
 * @param[out] model   what the other functions need
 * @param[in]  params  parameters
 * @param[in]  step    time step [s]
 * @return OK, NON_FINITE_INPUT, NULL_POINTER, INVALID_STEP, VANISHING_PIVOT or NON_FINITE_MODEL
 */
hundred_status hundred_prepare(
    hundred_model *model,
    const hundred_params *params,
    hundred_real step);

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
hundred_status hundred_initialise(
    hundred_state *state,
    const hundred_params *params,
    const hundred_real initial_angle[HUNDRED_STATIONS],
    const hundred_real initial_rate[HUNDRED_STATIONS],
    const hundred_inputs *inputs);

/**
 * Advance the state by one step.
 *
 * @param[in]     model   from hundred_prepare()
 * @param[in,out] state   motion before the step, and after it
 * @param[in]     inputs  what acts, at the end of the step
 * @return OK, NON_FINITE_INPUT, NULL_POINTER or NON_FINITE_STATE
 */
hundred_status hundred_step(
    const hundred_model *model,
    hundred_state *state,
    const hundred_inputs *inputs);

/**
 * Read the outputs off the state. Nothing is done where a pointer is NULL.
 *
 * @param[in]  model    from hundred_prepare()
 * @param[in]  state    motion
 * @param[out] outputs  what the scene asks for
 */
void hundred_output(
    const hundred_model *model,
    const hundred_state *state,
    hundred_outputs *outputs);

#ifdef __cplusplus
}
#endif

#endif /* TMM_GEN_KERNEL_hundred */

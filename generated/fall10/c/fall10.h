/**
 * fall10: Soft clamped beam falling under its own weight
 *
 * Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: 225557ccb20983327784b6fc8326b9127fb185b183a5e99d150385ab258b9303
 * sha256 of the rest of this file: edb7d409af738929a2f952dc0c22313bfdde75f13f22a32dc506868974189704
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
 * Call fall10_default_params() and fall10_prepare() once, fall10_initialise() to put the arm somewhere, then
 * fall10_step() at every tick of the clock and fall10_output() to know. All memory is the caller's; nothing
 * is kept between calls, so any number of arms can be run side by side.
 *
 * @file fall10.h
 */
#ifndef TMM_GEN_KERNEL_fall10
#define TMM_GEN_KERNEL_fall10

#ifdef __cplusplus
extern "C" {
#endif

/** Number of links. */
#define FALL10_STATIONS 10

/** The scene's time step [s]. */
#define FALL10_STEP 0.001

/** Type of all numbers. */
typedef double fall10_real;

/** What a function says about its success. */
typedef enum {
    /** Success. */
    FALL10_OK = 0,
    /** An argument is infinite or not a number; nothing was changed. */
    FALL10_NON_FINITE_INPUT,
    /** The time step is not a positive number; nothing was changed. */
    FALL10_INVALID_STEP,
    /** No passive arm has such parameters (a negative inertia, say); the model is of no use. */
    FALL10_VANISHING_PIVOT,
    /** The motion has outgrown the number type; initialise anew. */
    FALL10_NON_FINITE_STATE,
    /** A pointer that is needed is NULL; nothing was changed. */
    FALL10_NULL_POINTER = 6,
    /** Parameters or time step are too large or too small for the number type; the model is of no use. */
    FALL10_NON_FINITE_MODEL = 7
} fall10_status;

/** Physical parameters. */
typedef struct {
    fall10_real length; /**< link length, the same everywhere [m] */
    fall10_real mass; /**< link mass, the same everywhere [kg] */
    fall10_real inertia; /**< link inertia about its centre of mass, the same everywhere [kg m^2] */
    fall10_real center; /**< centre of mass along the link, 0 to 1, the same everywhere */
    fall10_real stiffness[FALL10_STATIONS]; /**< joint stiffness, base to tip [N m/rad] */
    fall10_real damping[FALL10_STATIONS]; /**< joint damping, base to tip [N m s/rad] */
    fall10_real gravity; /**< gravity along -y [m/s^2] */
} fall10_params;

/** What prepare() derives from the parameters and the time step. */
typedef struct {
    /** time step [s] */
    fall10_real step;
    /** link length, the same everywhere [m] */
    fall10_real length;
    /** link mass, the same everywhere [kg] */
    fall10_real mass;
    /** joint stiffness, base to tip [N m/rad] */
    fall10_real stiffness[FALL10_STATIONS];
    /** joint damping, base to tip [N m s/rad] */
    fall10_real damping[FALL10_STATIONS];
    /** gravity along -y [m/s^2] */
    fall10_real gravity;
    /** step**2/2 [s^2] */
    fall10_real half_step_squared;
    /** angle per unit of acceleration: step**2/4 [s^2] */
    fall10_real angle_per_acceleration;
    /** rate per unit of acceleration: step/2 [s] */
    fall10_real rate_per_acceleration;
    /** mass at the tip less the share of a link beyond it [kg] */
    fall10_real end_mass;
    /** inertia of a link that masses at its ends leave over [kg m^2] */
    fall10_real rod_inertia;
    /** torque of a joint per difference of unknowns [kg m^2] */
    fall10_real joint_impedance[FALL10_STATIONS];
} fall10_model;

/** Motion of the arm, and the history its integrator needs. */
typedef struct {
    fall10_real angle[FALL10_STATIONS]; /**< angle of each link, base to tip [rad] */
    fall10_real rate[FALL10_STATIONS]; /**< rate of each link, base to tip [rad/s] */
    fall10_real acceleration[FALL10_STATIONS]; /**< acceleration of each link, base to tip [rad/s^2] */
} fall10_state;

/** What acts on the arm. */
typedef struct {
    fall10_real none; /**< unused: C has no empty structs */
} fall10_inputs;

/** What the scene asks to know. */
typedef struct {
#ifndef tip_x
    fall10_real tip_x; /**< position at the tip, x [m] */
#else /* a macro would replace the name */
    fall10_real tmm_tip_x;
#endif
#ifndef tip_y
    fall10_real tip_y; /**< position at the tip, y [m] */
#else /* a macro would replace the name */
    fall10_real tmm_tip_y;
#endif
#ifndef speed_x
    fall10_real speed_x; /**< velocity at the tip, x [m/s] */
#else /* a macro would replace the name */
    fall10_real tmm_speed_x;
#endif
#ifndef speed_y
    fall10_real speed_y; /**< velocity at the tip, y [m/s] */
#else /* a macro would replace the name */
    fall10_real tmm_speed_y;
#endif
#ifndef root
    fall10_real root; /**< torque at station 1 [N m] */
#else /* a macro would replace the name */
    fall10_real tmm_root;
#endif
} fall10_outputs;

/**
 * Write the scene's parameters.
 *
 * @param[out] params  parameters; nothing is done where it is NULL
 */
void fall10_default_params(fall10_params *params);

/**
 * Compute what depends on parameters and step alone.
 *
 * @param[out] model   what the other functions need
 * @param[in]  params  parameters
 * @param[in]  step    time step [s]
 * @return OK, NON_FINITE_INPUT, NULL_POINTER, INVALID_STEP, VANISHING_PIVOT or NON_FINITE_MODEL
 */
fall10_status fall10_prepare(
    fall10_model *model,
    const fall10_params *params,
    fall10_real step);

/**
 * Start from given angles and rates with the acceleration that satisfies the equations of motion.
 *
 * @param[out] state   motion at the initial instant
 * @param[in]  params  parameters
 * @param[in]  initial_angle  angles to start from [rad]; NULL for the scene's own
 * @param[in]  initial_rate  rates to start from [rad/s]; NULL for the scene's own
 * @param[in]  inputs  what acts at the initial instant
 * @return OK, NON_FINITE_INPUT, NULL_POINTER, VANISHING_PIVOT or NON_FINITE_STATE
 */
fall10_status fall10_initialise(
    fall10_state *state,
    const fall10_params *params,
    const fall10_real initial_angle[FALL10_STATIONS],
    const fall10_real initial_rate[FALL10_STATIONS],
    const fall10_inputs *inputs);

/**
 * Advance the state by one step.
 *
 * @param[in]     model   from fall10_prepare()
 * @param[in,out] state   motion before the step, and after it
 * @param[in]     inputs  what acts, at the end of the step
 * @return OK, NON_FINITE_INPUT, NULL_POINTER, VANISHING_PIVOT or NON_FINITE_STATE
 */
fall10_status fall10_step(
    const fall10_model *model,
    fall10_state *state,
    const fall10_inputs *inputs);

/**
 * Read the outputs off the state. Nothing is done where a pointer is NULL.
 *
 * @param[in]  model    from fall10_prepare()
 * @param[in]  state    motion
 * @param[out] outputs  what the scene asks for
 */
void fall10_output(
    const fall10_model *model,
    const fall10_state *state,
    fall10_outputs *outputs);

#ifdef __cplusplus
}
#endif

#endif /* TMM_GEN_KERNEL_fall10 */

/**
 * swing: Flexible arm swung by one radian
 *
 * Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: c9c08efbdc9f2f1b1ddadadab522649e5100f98e9cdabe31fcf56b416283c60f
 * sha256 of the rest of this file: 6b1aa5f89491e21aa57d6e70b1a60406e811b63b1086057be71fb51d8dc4c25d
 *
 * model: planar arm, large rotations, tip mass
 * stations: 5
 * base: motor
 * integrator: Newmark 1959, beta = 0.25, gamma = 0.5
 * linearisation: newton
 * sweep: riccati
 * unknown: acceleration
 * operations of a step: 595, 119 per station (275 additions, 304 multiplications, 6 divisions, 10 sines and
 *     cosines)
 * operations of prepare: 47, 9.4 per station (10 additions, 37 multiplications)
 * number type: double
 * bytes of the structs: params 136, model 208, state 144, inputs 8, outputs 24
 *
 * Call swing_default_params() and swing_prepare() once, swing_initialise() to put the arm somewhere, then
 * swing_step() at every tick of the clock and swing_output() to know. All memory is the caller's; nothing is
 * kept between calls, so any number of arms can be run side by side.
 *
 * @file swing.h
 */
#ifndef TMM_GEN_KERNEL_swing
#define TMM_GEN_KERNEL_swing

#ifdef __cplusplus
extern "C" {
#endif

/** Number of links. */
#define SWING_STATIONS 5

/** The scene's time step [s]. */
#define SWING_STEP 0.005

/** Type of all numbers. */
typedef double swing_real;

/** What a function says about its success. */
typedef enum {
    /** Success. */
    SWING_OK = 0,
    /** An argument is infinite or not a number; nothing was changed. */
    SWING_NON_FINITE_INPUT,
    /** The time step is not a positive number; nothing was changed. */
    SWING_INVALID_STEP,
    /** No passive arm has such parameters (a negative inertia, say); the model is of no use. */
    SWING_VANISHING_PIVOT,
    /** The motion has outgrown the number type; initialise anew. */
    SWING_NON_FINITE_STATE,
    /** A pointer that is needed is NULL; nothing was changed. */
    SWING_NULL_POINTER = 6,
    /** Parameters or time step are too large or too small for the number type; the model is of no use. */
    SWING_NON_FINITE_MODEL = 7
} swing_status;

/** Physical parameters. */
typedef struct {
    swing_real length; /**< link length, the same everywhere [m] */
    swing_real mass; /**< link mass, the same everywhere [kg] */
    swing_real inertia; /**< link inertia about its centre of mass, the same everywhere [kg m^2] */
    swing_real center; /**< centre of mass along the link, 0 to 1, the same everywhere */
    swing_real stiffness[SWING_STATIONS]; /**< joint stiffness, base to tip [N m/rad] */
    swing_real damping[SWING_STATIONS]; /**< joint damping, base to tip [N m s/rad] */
    swing_real hub_inertia; /**< hub inertia [kg m^2] */
    swing_real hub_damping; /**< viscous damping of the hub to ground [N m s/rad] */
    swing_real tip_mass; /**< mass at the tip [kg] */
} swing_params;

/** What prepare() derives from the parameters and the time step. */
typedef struct {
    swing_real step; /**< time step [s] */
    swing_real length; /**< link length, the same everywhere [m] */
    swing_real mass; /**< link mass, the same everywhere [kg] */
    swing_real stiffness[SWING_STATIONS]; /**< joint stiffness, base to tip [N m/rad] */
    swing_real damping[SWING_STATIONS]; /**< joint damping, base to tip [N m s/rad] */
    swing_real hub_inertia; /**< hub inertia [kg m^2] */
    swing_real hub_damping; /**< viscous damping of the hub to ground [N m s/rad] */
    swing_real half_step_squared; /**< step**2/2 [s^2] */
    swing_real angle_per_acceleration; /**< angle per unit of acceleration: step**2/4 [s^2] */
    swing_real rate_per_acceleration; /**< rate per unit of acceleration: step/2 [s] */
    swing_real end_mass; /**< mass at the tip less the share of a link beyond it [kg] */
    swing_real rod_inertia; /**< inertia of a link that masses at its ends leave over [kg m^2] */
    swing_real joint_impedance[SWING_STATIONS]; /**< torque of a joint per difference of unknowns [kg m^2] */
    swing_real hub_impedance; /**< torque of the hub per unknown [kg m^2] */
} swing_model;

/** Motion of the arm, and the history its integrator needs. */
typedef struct {
    swing_real hub_angle; /**< hub angle [rad] */
    swing_real hub_rate; /**< hub rate [rad/s] */
    swing_real hub_acceleration; /**< hub acceleration [rad/s^2] */
    swing_real angle[SWING_STATIONS]; /**< angle of each link, base to tip [rad] */
    swing_real rate[SWING_STATIONS]; /**< rate of each link, base to tip [rad/s] */
    swing_real acceleration[SWING_STATIONS]; /**< acceleration of each link, base to tip [rad/s^2] */
} swing_state;

/** What acts on the arm. */
typedef struct {
#ifndef hub_torque
    swing_real hub_torque; /**< torque acting at the base [N m] */
#else /* a macro would replace the name */
    swing_real tmm_hub_torque;
#endif
} swing_inputs;

/** What the scene asks to know. */
typedef struct {
#ifndef tip_x
    swing_real tip_x; /**< position at the tip, x [m] */
#else /* a macro would replace the name */
    swing_real tmm_tip_x;
#endif
#ifndef tip_y
    swing_real tip_y; /**< position at the tip, y [m] */
#else /* a macro would replace the name */
    swing_real tmm_tip_y;
#endif
#ifndef hub
    swing_real hub; /**< angle at the base [rad] */
#else /* a macro would replace the name */
    swing_real tmm_hub;
#endif
} swing_outputs;

/**
 * Write the scene's parameters.
 *
 * @param[out] params  parameters; nothing is done where it is NULL
 */
void swing_default_params(swing_params *params);

/**
 * Compute what depends on parameters and step alone.
 *
 * @param[out] model   what the other functions need
 * @param[in]  params  parameters
 * @param[in]  step    time step [s]
 * @return OK, NON_FINITE_INPUT, NULL_POINTER, INVALID_STEP, VANISHING_PIVOT or NON_FINITE_MODEL
 */
swing_status swing_prepare(
    swing_model *model,
    const swing_params *params,
    swing_real step);

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
swing_status swing_initialise(
    swing_state *state,
    const swing_params *params,
    const swing_real initial_angle[SWING_STATIONS],
    const swing_real initial_rate[SWING_STATIONS],
    const swing_inputs *inputs);

/**
 * Advance the state by one step.
 *
 * @param[in]     model   from swing_prepare()
 * @param[in,out] state   motion before the step, and after it
 * @param[in]     inputs  what acts, at the end of the step
 * @return OK, NON_FINITE_INPUT, NULL_POINTER, VANISHING_PIVOT or NON_FINITE_STATE
 */
swing_status swing_step(
    const swing_model *model,
    swing_state *state,
    const swing_inputs *inputs);

/**
 * Read the outputs off the state. Nothing is done where a pointer is NULL.
 *
 * @param[in]  model    from swing_prepare()
 * @param[in]  state    motion
 * @param[out] outputs  what the scene asks for
 */
void swing_output(
    const swing_model *model,
    const swing_state *state,
    swing_outputs *outputs);

#ifdef __cplusplus
}
#endif

#endif /* TMM_GEN_KERNEL_swing */

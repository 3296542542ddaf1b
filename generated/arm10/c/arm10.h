/**
 * arm10: Ten-link arm swung by a hub motor
 *
 * Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: d9d28dc691ae4f0a1d62cb9cfa9f4612d111fa76a756dd286c77eac7f930ab35
 * sha256 of the rest of this file: f6eddb46010eee9af4b40da924186c7932d5021b8a02564d34490e7ad0aafd3a
 *
 * model: planar arm, large rotations, gravity, tip mass
 * stations: 10
 * base: motor
 * integrator: Newmark 1959, beta = 0.25, gamma = 0.5
 * linearisation: newton
 * sweep: riccati
 * unknown: acceleration
 * operations of a step: 1171, 117.1 per station (541 additions, 599 multiplications, 11 divisions, 20 sines
 *     and cosines)
 * operations of prepare: 77, 7.7 per station (15 additions, 62 multiplications)
 * number type: double
 * bytes of the structs: params 224, model 336, state 264, inputs 16, outputs 32
 *
 * Call arm10_default_params() and arm10_prepare() once, arm10_initialise() to put the arm somewhere, then
 * arm10_step() at every tick of the clock and arm10_output() to know. All memory is the caller's; nothing is
 * kept between calls, so any number of arms can be run side by side.
 *
 * @file arm10.h
 */
#ifndef TMM_GEN_KERNEL_arm10
#define TMM_GEN_KERNEL_arm10

#ifdef __cplusplus
extern "C" {
#endif

/** Number of links. */
#define ARM10_STATIONS 10

/** The scene's time step [s]. */
#define ARM10_STEP 0.001

/** Largest angle, either way, of which a step takes sine and cosine [rad]. */
#define ARM10_LARGEST_ANGLE 1647099.0

/** Type of all numbers. */
typedef double arm10_real;

/** What a function says about its success. */
typedef enum {
    /** Success. */
    ARM10_OK = 0,
    /** An argument is infinite or not a number; nothing was changed. */
    ARM10_NON_FINITE_INPUT,
    /** The time step is not a positive number; nothing was changed. */
    ARM10_INVALID_STEP,
    /** No passive arm has such parameters (a negative inertia, say); the model is of no use. */
    ARM10_VANISHING_PIVOT,
    /** The motion has outgrown the number type; initialise anew. */
    ARM10_NON_FINITE_STATE,
    /** An angle is beyond ARM10_LARGEST_ANGLE, or an intermediate result is beyond what the box of the scene
     * can lead to; nothing was changed. */
    ARM10_OUT_OF_RANGE,
    /** A pointer that is needed is NULL; nothing was changed. */
    ARM10_NULL_POINTER = 6,
    /** Parameters or time step are too large or too small for the number type; the model is of no use. */
    ARM10_NON_FINITE_MODEL = 7
} arm10_status;

/** Physical parameters. */
typedef struct {
    arm10_real length; /**< link length, the same everywhere [m] */
    arm10_real mass; /**< link mass, the same everywhere [kg] */
    arm10_real inertia; /**< link inertia about its centre of mass, the same everywhere [kg m^2] */
    arm10_real center; /**< centre of mass along the link, 0 to 1, the same everywhere */
    arm10_real stiffness[ARM10_STATIONS]; /**< joint stiffness, base to tip [N m/rad] */
    arm10_real damping[ARM10_STATIONS]; /**< joint damping, base to tip [N m s/rad] */
    arm10_real gravity; /**< gravity along -y [m/s^2] */
    arm10_real hub_inertia; /**< hub inertia [kg m^2] */
    arm10_real hub_damping; /**< viscous damping of the hub to ground [N m s/rad] */
    arm10_real tip_mass; /**< mass at the tip [kg] */
} arm10_params;

/** What prepare() derives from the parameters and the time step. */
typedef struct {
    arm10_real step; /**< time step [s] */
    arm10_real length; /**< link length, the same everywhere [m] */
    arm10_real mass; /**< link mass, the same everywhere [kg] */
    arm10_real stiffness[ARM10_STATIONS]; /**< joint stiffness, base to tip [N m/rad] */
    arm10_real damping[ARM10_STATIONS]; /**< joint damping, base to tip [N m s/rad] */
    arm10_real gravity; /**< gravity along -y [m/s^2] */
    arm10_real hub_inertia; /**< hub inertia [kg m^2] */
    arm10_real hub_damping; /**< viscous damping of the hub to ground [N m s/rad] */
    arm10_real half_step_squared; /**< step**2/2 [s^2] */
    arm10_real angle_per_acceleration; /**< angle per unit of acceleration: step**2/4 [s^2] */
    arm10_real rate_per_acceleration; /**< rate per unit of acceleration: step/2 [s] */
    arm10_real end_mass; /**< mass at the tip less the share of a link beyond it [kg] */
    arm10_real rod_inertia; /**< inertia of a link that masses at its ends leave over [kg m^2] */
    arm10_real joint_impedance[ARM10_STATIONS]; /**< torque of a joint per difference of unknowns [kg m^2] */
    arm10_real hub_impedance; /**< torque of the hub per unknown [kg m^2] */
} arm10_model;

/** Motion of the arm, and the history its integrator needs. */
typedef struct {
    arm10_real hub_angle; /**< hub angle [rad] */
    arm10_real hub_rate; /**< hub rate [rad/s] */
    arm10_real hub_acceleration; /**< hub acceleration [rad/s^2] */
    arm10_real angle[ARM10_STATIONS]; /**< angle of each link, base to tip [rad] */
    arm10_real rate[ARM10_STATIONS]; /**< rate of each link, base to tip [rad/s] */
    arm10_real acceleration[ARM10_STATIONS]; /**< acceleration of each link, base to tip [rad/s^2] */
} arm10_state;

/** What acts on the arm. */
typedef struct {
#ifndef hub_torque
    arm10_real hub_torque; /**< torque acting at the base [N m] */
#else /* a macro would replace the name */
    arm10_real tmm_hub_torque;
#endif
#ifndef tip_force
    arm10_real tip_force; /**< force_y acting at the tip [N] */
#else /* a macro would replace the name */
    arm10_real tmm_tip_force;
#endif
} arm10_inputs;

/** What the scene asks to know. */
typedef struct {
#ifndef tip_x
    arm10_real tip_x; /**< position at the tip, x [m] */
#else /* a macro would replace the name */
    arm10_real tmm_tip_x;
#endif
#ifndef tip_y
    arm10_real tip_y; /**< position at the tip, y [m] */
#else /* a macro would replace the name */
    arm10_real tmm_tip_y;
#endif
#ifndef hub
    arm10_real hub; /**< angle at the base [rad] */
#else /* a macro would replace the name */
    arm10_real tmm_hub;
#endif
#ifndef root
    arm10_real root; /**< torque at station 1 [N m] */
#else /* a macro would replace the name */
    arm10_real tmm_root;
#endif
} arm10_outputs;

/**
 * Write the scene's parameters.
 *
 * @param[out] params  parameters; nothing is done where it is NULL
 */
void arm10_default_params(arm10_params *params);

/**
 * Compute what depends on parameters and step alone.
 *
 * @param[out] model   what the other functions need
 * @param[in]  params  parameters
 * @param[in]  step    time step [s]
 * @return OK, NON_FINITE_INPUT, NULL_POINTER, INVALID_STEP, VANISHING_PIVOT or NON_FINITE_MODEL
 */
arm10_status arm10_prepare(
    arm10_model *model,
    const arm10_params *params,
    arm10_real step);

/**
 * Start from given angles and rates with the acceleration that satisfies the equations of motion.
 *
 * @param[out] state   motion at the initial instant
 * @param[in]  params  parameters
 * @param[in]  initial_angle  angles to start from [rad]; NULL for the scene's own
 * @param[in]  initial_rate  rates to start from [rad/s]; NULL for the scene's own
 * @param[in]  inputs  what acts at the initial instant
 * @return OK, NON_FINITE_INPUT, NULL_POINTER, VANISHING_PIVOT, NON_FINITE_STATE or OUT_OF_RANGE
 */
arm10_status arm10_initialise(
    arm10_state *state,
    const arm10_params *params,
    const arm10_real initial_angle[ARM10_STATIONS],
    const arm10_real initial_rate[ARM10_STATIONS],
    const arm10_inputs *inputs);

/**
 * Advance the state by one step.
 *
 * @param[in]     model   from arm10_prepare()
 * @param[in,out] state   motion before the step, and after it
 * @param[in]     inputs  what acts, at the end of the step
 * @return OK, NON_FINITE_INPUT, NULL_POINTER, VANISHING_PIVOT, NON_FINITE_STATE or OUT_OF_RANGE
 */
arm10_status arm10_step(
    const arm10_model *model,
    arm10_state *state,
    const arm10_inputs *inputs);

/**
 * Read the outputs off the state. Nothing is done where a pointer is NULL.
 *
 * @param[in]  model    from arm10_prepare()
 * @param[in]  state    motion
 * @param[out] outputs  what the scene asks for
 */
void arm10_output(
    const arm10_model *model,
    const arm10_state *state,
    arm10_outputs *outputs);

#ifdef __cplusplus
}
#endif

#endif /* TMM_GEN_KERNEL_arm10 */

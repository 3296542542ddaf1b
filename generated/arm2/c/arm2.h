/**
 * arm2: Two unlike links swung by a motor
 *
 * Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: c5e09abbb61734735cef8cfddf39dd959eb5765da3ad6484bed2957b4fdf212c
 * sha256 of the rest of this file: e6fbcbacf5d7d31f239f53f525ba9c588c3894294b7fbc2d72c03b6538a415cb
 *
 * model: planar arm, large rotations, gravity, tip mass
 * stations: 2
 * base: motor
 * integrator: Newmark 1959, beta = 0.25, gamma = 0.5
 * linearisation: newton
 * sweep: riccati
 * unknown: acceleration
 * operations of a step: 249, 124.5 per station (116 additions, 126 multiplications, 3 divisions, 4 sines and
 *     cosines)
 * operations of prepare: 38, 19 per station (10 additions, 28 multiplications)
 * number type: double
 * bytes of the structs: params 136, model 168, state 72, inputs 8, outputs 32
 *
 * Call arm2_default_params() and arm2_prepare() once, arm2_initialise() to put the arm somewhere, then
 * arm2_step() at every tick of the clock and arm2_output() to know. All memory is the caller's; nothing is
 * kept between calls, so any number of arms can be run side by side.
 *
 * @file arm2.h
 */
#ifndef TMM_GEN_KERNEL_arm2
#define TMM_GEN_KERNEL_arm2

#ifdef __cplusplus
extern "C" {
#endif

/** Number of links. */
#define ARM2_STATIONS 2

/** The scene's time step [s]. */
#define ARM2_STEP 0.001

/** Type of all numbers. */
typedef double arm2_real;

/** What a function says about its success. */
typedef enum {
    /** Success. */
    ARM2_OK = 0,
    /** An argument is infinite or not a number; nothing was changed. */
    ARM2_NON_FINITE_INPUT,
    /** The time step is not a positive number; nothing was changed. */
    ARM2_INVALID_STEP,
    /** No passive arm has such parameters (a negative inertia, say); the model is of no use. */
    ARM2_VANISHING_PIVOT,
    /** The motion has outgrown the number type; initialise anew. */
    ARM2_NON_FINITE_STATE,
    /** A pointer that is needed is NULL; nothing was changed. */
    ARM2_NULL_POINTER = 6,
    /** Parameters or time step are too large or too small for the number type; the model is of no use. */
    ARM2_NON_FINITE_MODEL = 7
} arm2_status;

/** Physical parameters. */
typedef struct {
    arm2_real length[ARM2_STATIONS]; /**< link length, base to tip [m] */
    arm2_real mass[ARM2_STATIONS]; /**< link mass, base to tip [kg] */
    arm2_real inertia[ARM2_STATIONS]; /**< link inertia about its centre of mass, base to tip [kg m^2] */
    arm2_real center[ARM2_STATIONS]; /**< centre of mass along the link, 0 to 1, base to tip */
    arm2_real stiffness[ARM2_STATIONS]; /**< joint stiffness, base to tip [N m/rad] */
    arm2_real damping[ARM2_STATIONS]; /**< joint damping, base to tip [N m s/rad] */
    arm2_real gravity; /**< gravity along -y [m/s^2] */
    arm2_real hub_inertia; /**< hub inertia [kg m^2] */
    arm2_real hub_damping; /**< viscous damping of the hub to ground [N m s/rad] */
    arm2_real tip_mass; /**< mass at the tip [kg] */
    arm2_real tip_inertia; /**< inertia at the tip [kg m^2] */
} arm2_params;

/** What prepare() derives from the parameters and the time step. */
typedef struct {
    /** time step [s] */
    arm2_real step;
    /** link length, base to tip [m] */
    arm2_real length[ARM2_STATIONS];
    /** joint stiffness, base to tip [N m/rad] */
    arm2_real stiffness[ARM2_STATIONS];
    /** joint damping, base to tip [N m s/rad] */
    arm2_real damping[ARM2_STATIONS];
    /** gravity along -y [m/s^2] */
    arm2_real gravity;
    /** hub inertia [kg m^2] */
    arm2_real hub_inertia;
    /** viscous damping of the hub to ground [N m s/rad] */
    arm2_real hub_damping;
    /** inertia at the tip [kg m^2] */
    arm2_real tip_inertia;
    /** step**2/2 [s^2] */
    arm2_real half_step_squared;
    /** angle per unit of acceleration: step**2/4 [s^2] */
    arm2_real angle_per_acceleration;
    /** rate per unit of acceleration: step/2 [s] */
    arm2_real rate_per_acceleration;
    /** mass at the outer end of each link [kg] */
    arm2_real node_mass[ARM2_STATIONS];
    /** inertia of a link that masses at its ends leave over [kg m^2] */
    arm2_real rod_inertia[ARM2_STATIONS];
    /** torque of a joint per difference of unknowns [kg m^2] */
    arm2_real joint_impedance[ARM2_STATIONS];
    /** torque of the hub per unknown [kg m^2] */
    arm2_real hub_impedance;
} arm2_model;

/** Motion of the arm, and the history its integrator needs. */
typedef struct {
    arm2_real hub_angle; /**< hub angle [rad] */
    arm2_real hub_rate; /**< hub rate [rad/s] */
    arm2_real hub_acceleration; /**< hub acceleration [rad/s^2] */
    arm2_real angle[ARM2_STATIONS]; /**< angle of each link, base to tip [rad] */
    arm2_real rate[ARM2_STATIONS]; /**< rate of each link, base to tip [rad/s] */
    arm2_real acceleration[ARM2_STATIONS]; /**< acceleration of each link, base to tip [rad/s^2] */
} arm2_state;

/** What acts on the arm. */
typedef struct {
#ifndef hub_torque
    arm2_real hub_torque; /**< torque acting at the base [N m] */
#else /* a macro would replace the name */
    arm2_real tmm_hub_torque;
#endif
} arm2_inputs;

/** What the scene asks to know. */
typedef struct {
#ifndef tip_x
    arm2_real tip_x; /**< position at the tip, x [m] */
#else /* a macro would replace the name */
    arm2_real tmm_tip_x;
#endif
#ifndef tip_y
    arm2_real tip_y; /**< position at the tip, y [m] */
#else /* a macro would replace the name */
    arm2_real tmm_tip_y;
#endif
#ifndef hub
    arm2_real hub; /**< angle at the base [rad] */
#else /* a macro would replace the name */
    arm2_real tmm_hub;
#endif
#ifndef elbow
    arm2_real elbow; /**< torque at station 2 [N m] */
#else /* a macro would replace the name */
    arm2_real tmm_elbow;
#endif
} arm2_outputs;

/**
 * Write the scene's parameters.
 *
 * @param[out] params  parameters; nothing is done where it is NULL
 */
void arm2_default_params(arm2_params *params);

/**
 * Compute what depends on parameters and step alone.
 *
 * @param[out] model   what the other functions need
 * @param[in]  params  parameters
 * @param[in]  step    time step [s]
 * @return OK, NON_FINITE_INPUT, NULL_POINTER, INVALID_STEP, VANISHING_PIVOT or NON_FINITE_MODEL
 */
arm2_status arm2_prepare(
    arm2_model *model,
    const arm2_params *params,
    arm2_real step);

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
arm2_status arm2_initialise(
    arm2_state *state,
    const arm2_params *params,
    const arm2_real initial_angle[ARM2_STATIONS],
    const arm2_real initial_rate[ARM2_STATIONS],
    const arm2_inputs *inputs);

/**
 * Advance the state by one step.
 *
 * @param[in]     model   from arm2_prepare()
 * @param[in,out] state   motion before the step, and after it
 * @param[in]     inputs  what acts, at the end of the step
 * @return OK, NON_FINITE_INPUT, NULL_POINTER, VANISHING_PIVOT or NON_FINITE_STATE
 */
arm2_status arm2_step(
    const arm2_model *model,
    arm2_state *state,
    const arm2_inputs *inputs);

/**
 * Read the outputs off the state. Nothing is done where a pointer is NULL.
 *
 * @param[in]  model    from arm2_prepare()
 * @param[in]  state    motion
 * @param[out] outputs  what the scene asks for
 */
void arm2_output(
    const arm2_model *model,
    const arm2_state *state,
    arm2_outputs *outputs);

#ifdef __cplusplus
}
#endif

#endif /* TMM_GEN_KERNEL_arm2 */

/**
 * gripper: Gripper with two fingers on a flexible wrist
 *
 * Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: c8f8226e93fd9d4e49ccbb14a6d21dfabaa9c32be55619277914a499c6eae156
 * sha256 of the rest of this file: a18a7e29cbe1b226f3f7ae1f226836cbb03842f731daf11cbb61e0df2abc2e34
 *
 * model: planar arm, large rotations, gravity
 * stations: 8
 * base: clamp
 * integrator: Newmark 1959, beta = 0.25, gamma = 0.5
 * linearisation: newton
 * sweep: riccati
 * unknown: acceleration
 * joints in arrays, from 0: left 4, left_hinge 5, right 6, right_hinge 7
 * links in arrays, from 0: wrist 0 to 3, left_finger 4, left_pad 5, right_finger 6, right_pad 7
 * operations of a step: 892, 111.5 per station (404 additions, 464 multiplications, 8 divisions, 16 sines and
 *     cosines)
 * operations of prepare: 148, 18.5 per station (42 additions, 106 multiplications)
 * number type: double
 * bytes of the structs: params 584, model 616, state 192, inputs 16, outputs 48
 *
 * Call gripper_default_params() and gripper_prepare() once, gripper_initialise() to put the arm somewhere,
 * then gripper_step() at every tick of the clock and gripper_output() to know. All memory is the caller's;
 * nothing is kept between calls, so any number of arms can be run side by side.
 *
 * @file gripper.h
 */
#ifndef TMM_GEN_KERNEL_gripper
#define TMM_GEN_KERNEL_gripper

#ifdef __cplusplus
extern "C" {
#endif

/** Number of links. */
#define GRIPPER_STATIONS 8

/** The scene's time step [s]. */
#define GRIPPER_STEP 0.00025

/** Type of all numbers. */
typedef double gripper_real;

/** What a function says about its success. */
typedef enum {
    /** Success. */
    GRIPPER_OK = 0,
    /** An argument is infinite or not a number; nothing was changed. */
    GRIPPER_NON_FINITE_INPUT,
    /** The time step is not a positive number; nothing was changed. */
    GRIPPER_INVALID_STEP,
    /** No passive arm has such parameters (a negative inertia, say); the model is of no use. */
    GRIPPER_VANISHING_PIVOT,
    /** The motion has outgrown the number type; initialise anew. */
    GRIPPER_NON_FINITE_STATE,
    /** A pointer that is needed is NULL; nothing was changed. */
    GRIPPER_NULL_POINTER = 6,
    /** Parameters or time step are too large or too small for the number type; the model is of no use. */
    GRIPPER_NON_FINITE_MODEL = 7
} gripper_status;

/** Physical parameters. */
typedef struct {
    /** link length, base to tip [m] */
    gripper_real length[GRIPPER_STATIONS];
    /** link mass, base to tip [kg] */
    gripper_real mass[GRIPPER_STATIONS];
    /** link inertia about its centre of mass, base to tip [kg m^2] */
    gripper_real inertia[GRIPPER_STATIONS];
    /** centre of mass along the link, 0 to 1, base to tip */
    gripper_real center[GRIPPER_STATIONS];
    /** joint stiffness, base to tip [N m/rad] */
    gripper_real stiffness[GRIPPER_STATIONS];
    /** joint damping, base to tip [N m s/rad] */
    gripper_real damping[GRIPPER_STATIONS];
    /** angle at which a joint's spring is slack, base to tip [rad] */
    gripper_real rest[GRIPPER_STATIONS];
    /** inertia of a joint's motor, on its own side, base to tip [kg m^2] */
    gripper_real rotor_inertia[GRIPPER_STATIONS];
    /** turns of a joint's motor per turn of the joint, base to tip */
    gripper_real gear[GRIPPER_STATIONS];
    /** gravity along -y [m/s^2] */
    gripper_real gravity;
} gripper_params;

/** What prepare() derives from the parameters and the time step. */
typedef struct {
    /** time step [s] */
    gripper_real step;
    /** link length, base to tip [m] */
    gripper_real length[GRIPPER_STATIONS];
    /** joint stiffness, base to tip [N m/rad] */
    gripper_real stiffness[GRIPPER_STATIONS];
    /** joint damping, base to tip [N m s/rad] */
    gripper_real damping[GRIPPER_STATIONS];
    /** angle at which a joint's spring is slack, base to tip [rad] */
    gripper_real rest[GRIPPER_STATIONS];
    /** turns of a joint's motor per turn of the joint, base to tip */
    gripper_real gear[GRIPPER_STATIONS];
    /** gravity along -y [m/s^2] */
    gripper_real gravity;
    /** step**2/2 [s^2] */
    gripper_real half_step_squared;
    /** angle per unit of acceleration: step**2/4 [s^2] */
    gripper_real angle_per_acceleration;
    /** rate per unit of acceleration: step/2 [s] */
    gripper_real rate_per_acceleration;
    /** mass at the outer end of each link [kg] */
    gripper_real node_mass[GRIPPER_STATIONS];
    /** inertia of a link that masses at its ends leave over [kg m^2] */
    gripper_real rod_inertia[GRIPPER_STATIONS];
    /** inertia of a joint's motor at the joint, between both sides [kg m^2] */
    gripper_real armature[GRIPPER_STATIONS];
    /** torque of a joint per difference of unknowns [kg m^2] */
    gripper_real joint_impedance[GRIPPER_STATIONS];
} gripper_model;

/** Motion of the arm, and the history its integrator needs. */
typedef struct {
    gripper_real angle[GRIPPER_STATIONS]; /**< angle of each link, base to tip [rad] */
    gripper_real rate[GRIPPER_STATIONS]; /**< rate of each link, base to tip [rad/s] */
    gripper_real acceleration[GRIPPER_STATIONS]; /**< acceleration of each link, base to tip [rad/s^2] */
} gripper_state;

/** What acts on the arm. */
typedef struct {
#ifndef left_torque
    gripper_real left_torque; /**< torque of 'left', between both sides; a motor's acts gear-fold [N m] */
#else /* a macro would replace the name */
    gripper_real tmm_left_torque;
#endif
#ifndef right_torque
    gripper_real right_torque; /**< torque of 'right', between both sides; a motor's acts gear-fold [N m] */
#else /* a macro would replace the name */
    gripper_real tmm_right_torque;
#endif
} gripper_inputs;

/** What the scene asks to know. */
typedef struct {
#ifndef left_tip_x
    gripper_real left_tip_x; /**< position at 'left_pad', x [m] */
#else /* a macro would replace the name */
    gripper_real tmm_left_tip_x;
#endif
#ifndef left_tip_y
    gripper_real left_tip_y; /**< position at 'left_pad', y [m] */
#else /* a macro would replace the name */
    gripper_real tmm_left_tip_y;
#endif
#ifndef right_tip_x
    gripper_real right_tip_x; /**< position at 'right_pad', x [m] */
#else /* a macro would replace the name */
    gripper_real tmm_right_tip_x;
#endif
#ifndef right_tip_y
    gripper_real right_tip_y; /**< position at 'right_pad', y [m] */
#else /* a macro would replace the name */
    gripper_real tmm_right_tip_y;
#endif
#ifndef left
    gripper_real left; /**< joint angle at 'left' [rad] */
#else /* a macro would replace the name */
    gripper_real tmm_left;
#endif
#ifndef right
    gripper_real right; /**< joint angle at 'right' [rad] */
#else /* a macro would replace the name */
    gripper_real tmm_right;
#endif
} gripper_outputs;

/**
 * Write the scene's parameters.
 *
 * @param[out] params  parameters; nothing is done where it is NULL
 */
void gripper_default_params(gripper_params *params);

/**
 * Compute what depends on parameters and step alone.
 *
 * @param[out] model   what the other functions need
 * @param[in]  params  parameters
 * @param[in]  step    time step [s]
 * @return OK, NON_FINITE_INPUT, NULL_POINTER, INVALID_STEP, VANISHING_PIVOT or NON_FINITE_MODEL
 */
gripper_status gripper_prepare(
    gripper_model *model,
    const gripper_params *params,
    gripper_real step);

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
gripper_status gripper_initialise(
    gripper_state *state,
    const gripper_params *params,
    const gripper_real initial_angle[GRIPPER_STATIONS],
    const gripper_real initial_rate[GRIPPER_STATIONS],
    const gripper_inputs *inputs);

/**
 * Advance the state by one step.
 *
 * @param[in]     model   from gripper_prepare()
 * @param[in,out] state   motion before the step, and after it
 * @param[in]     inputs  what acts, at the end of the step
 * @return OK, NON_FINITE_INPUT, NULL_POINTER, VANISHING_PIVOT or NON_FINITE_STATE
 */
gripper_status gripper_step(
    const gripper_model *model,
    gripper_state *state,
    const gripper_inputs *inputs);

/**
 * Read the outputs off the state. Nothing is done where a pointer is NULL.
 *
 * @param[in]  model    from gripper_prepare()
 * @param[in]  state    motion
 * @param[out] outputs  what the scene asks for
 */
void gripper_output(
    const gripper_model *model,
    const gripper_state *state,
    gripper_outputs *outputs);

#ifdef __cplusplus
}
#endif

#endif /* TMM_GEN_KERNEL_gripper */

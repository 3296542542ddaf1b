/**
 * elbow: Flexible arm with motors at shoulder and elbow
 *
 * Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: b7474d2f501b0139799e3f1e1a14aa2a3a455ea0221cabb6918551519b3600d0
 * sha256 of the rest of this file: 7044da2a3ac6d62928302863f81eca382747abc28584fb5c41506df169f98438
 *
 * model: planar arm, large rotations, gravity, tip mass
 * stations: 12
 * base: clamp
 * integrator: Newmark 1959, beta = 0.25, gamma = 0.5
 * linearisation: newton
 * sweep: riccati
 * unknown: acceleration
 * joints in arrays, from 0: shoulder 0, elbow 6
 * links in arrays, from 0: upper 0 to 5, forearm 6 to 11
 * operations of a step: 1385, 115.4 per station (638 additions, 711 multiplications, 12 divisions, 24 sines
 *     and cosines)
 * operations of prepare: 213, 17.75 per station (59 additions, 154 multiplications)
 * number type: double
 * bytes of the structs: params 792, model 816, state 288, inputs 16, outputs 32
 *
 * Call elbow_default_params() and elbow_prepare() once, elbow_initialise() to put the arm somewhere, then
 * elbow_step() at every tick of the clock and elbow_output() to know. All memory is the caller's; nothing is
 * kept between calls, so any number of arms can be run side by side.
 *
 * @file elbow.h
 */
#ifndef TMM_GEN_KERNEL_elbow
#define TMM_GEN_KERNEL_elbow

#ifdef __cplusplus
extern "C" {
#endif

/** Number of links. */
#define ELBOW_STATIONS 12

/** The scene's time step [s]. */
#define ELBOW_STEP 0.001

/** Largest angle, either way, of which a step takes sine and cosine [rad]. */
#define ELBOW_LARGEST_ANGLE 1647099.0

/** Type of all numbers. */
typedef double elbow_real;

/** What a function says about its success. */
typedef enum {
    /** Success. */
    ELBOW_OK = 0,
    /** An argument is infinite or not a number; nothing was changed. */
    ELBOW_NON_FINITE_INPUT,
    /** The time step is not a positive number; nothing was changed. */
    ELBOW_INVALID_STEP,
    /** No passive arm has such parameters (a negative inertia, say); the model is of no use. */
    ELBOW_VANISHING_PIVOT,
    /** The motion has outgrown the number type; initialise anew. */
    ELBOW_NON_FINITE_STATE,
    /** An angle is beyond ELBOW_LARGEST_ANGLE; nothing was changed. */
    ELBOW_OUT_OF_RANGE,
    /** A pointer that is needed is NULL; nothing was changed. */
    ELBOW_NULL_POINTER = 6,
    /** Parameters or time step are too large or too small for the number type; the model is of no use. */
    ELBOW_NON_FINITE_MODEL = 7
} elbow_status;

/** Physical parameters. */
typedef struct {
    /** link length, base to tip [m] */
    elbow_real length[ELBOW_STATIONS];
    /** link mass, base to tip [kg] */
    elbow_real mass[ELBOW_STATIONS];
    /** link inertia about its centre of mass, base to tip [kg m^2] */
    elbow_real inertia[ELBOW_STATIONS];
    /** centre of mass along the link, 0 to 1, base to tip */
    elbow_real center[ELBOW_STATIONS];
    /** joint stiffness, base to tip [N m/rad] */
    elbow_real stiffness[ELBOW_STATIONS];
    /** joint damping, base to tip [N m s/rad] */
    elbow_real damping[ELBOW_STATIONS];
    /** inertia of a joint's motor, on its own side, base to tip [kg m^2] */
    elbow_real rotor_inertia[ELBOW_STATIONS];
    /** turns of a joint's motor per turn of the joint, base to tip */
    elbow_real gear[ELBOW_STATIONS];
    /** gravity along -y [m/s^2] */
    elbow_real gravity;
    /** mass at the tip [kg] */
    elbow_real tip_mass;
    /** inertia at the tip [kg m^2] */
    elbow_real tip_inertia;
} elbow_params;

/** What prepare() derives from the parameters and the time step. */
typedef struct {
    /** time step [s] */
    elbow_real step;
    /** link length, base to tip [m] */
    elbow_real length[ELBOW_STATIONS];
    /** joint stiffness, base to tip [N m/rad] */
    elbow_real stiffness[ELBOW_STATIONS];
    /** joint damping, base to tip [N m s/rad] */
    elbow_real damping[ELBOW_STATIONS];
    /** turns of a joint's motor per turn of the joint, base to tip */
    elbow_real gear[ELBOW_STATIONS];
    /** gravity along -y [m/s^2] */
    elbow_real gravity;
    /** inertia at the tip [kg m^2] */
    elbow_real tip_inertia;
    /** step**2/2 [s^2] */
    elbow_real half_step_squared;
    /** angle per unit of acceleration: step**2/4 [s^2] */
    elbow_real angle_per_acceleration;
    /** rate per unit of acceleration: step/2 [s] */
    elbow_real rate_per_acceleration;
    /** mass at the outer end of each link [kg] */
    elbow_real node_mass[ELBOW_STATIONS];
    /** inertia of a link that masses at its ends leave over [kg m^2] */
    elbow_real rod_inertia[ELBOW_STATIONS];
    /** inertia of a joint's motor at the joint, between both sides [kg m^2] */
    elbow_real armature[ELBOW_STATIONS];
    /** torque of a joint per difference of unknowns [kg m^2] */
    elbow_real joint_impedance[ELBOW_STATIONS];
} elbow_model;

/** Motion of the arm, and the history its integrator needs. */
typedef struct {
    elbow_real angle[ELBOW_STATIONS]; /**< angle of each link, base to tip [rad] */
    elbow_real rate[ELBOW_STATIONS]; /**< rate of each link, base to tip [rad/s] */
    elbow_real acceleration[ELBOW_STATIONS]; /**< acceleration of each link, base to tip [rad/s^2] */
} elbow_state;

/** What acts on the arm. */
typedef struct {
    /** torque of 'shoulder', between both sides; a motor's acts gear-fold [N m] */
#ifndef shoulder_torque
    elbow_real shoulder_torque;
#else /* a macro would replace the name */
    elbow_real tmm_shoulder_torque;
#endif
    /** torque of 'elbow', between both sides; a motor's acts gear-fold [N m] */
#ifndef elbow_torque
    elbow_real elbow_torque;
#else /* a macro would replace the name */
    elbow_real tmm_elbow_torque;
#endif
} elbow_inputs;

/** What the scene asks to know. */
typedef struct {
#ifndef payload_x
    elbow_real payload_x; /**< position at 'payload', x [m] */
#else /* a macro would replace the name */
    elbow_real tmm_payload_x;
#endif
#ifndef payload_y
    elbow_real payload_y; /**< position at 'payload', y [m] */
#else /* a macro would replace the name */
    elbow_real tmm_payload_y;
#endif
#ifndef shoulder
    elbow_real shoulder; /**< joint angle at 'shoulder' [rad] */
#else /* a macro would replace the name */
    elbow_real tmm_shoulder;
#endif
#ifndef elbow
    elbow_real elbow; /**< joint angle at 'elbow' [rad] */
#else /* a macro would replace the name */
    elbow_real tmm_elbow;
#endif
} elbow_outputs;

/**
 * Write the scene's parameters.
 *
 * @param[out] params  parameters; nothing is done where it is NULL
 */
void elbow_default_params(elbow_params *params);

/**
 * Compute what depends on parameters and step alone.
 *
 * @param[out] model   what the other functions need
 * @param[in]  params  parameters
 * @param[in]  step    time step [s]
 * @return OK, NON_FINITE_INPUT, NULL_POINTER, INVALID_STEP, VANISHING_PIVOT or NON_FINITE_MODEL
 */
elbow_status elbow_prepare(
    elbow_model *model,
    const elbow_params *params,
    elbow_real step);

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
elbow_status elbow_initialise(
    elbow_state *state,
    const elbow_params *params,
    const elbow_real initial_angle[ELBOW_STATIONS],
    const elbow_real initial_rate[ELBOW_STATIONS],
    const elbow_inputs *inputs);

/**
 * Advance the state by one step.
 *
 * @param[in]     model   from elbow_prepare()
 * @param[in,out] state   motion before the step, and after it
 * @param[in]     inputs  what acts, at the end of the step
 * @return OK, NON_FINITE_INPUT, NULL_POINTER, VANISHING_PIVOT, NON_FINITE_STATE or OUT_OF_RANGE
 */
elbow_status elbow_step(
    const elbow_model *model,
    elbow_state *state,
    const elbow_inputs *inputs);

/**
 * Read the outputs off the state. Nothing is done where a pointer is NULL.
 *
 * @param[in]  model    from elbow_prepare()
 * @param[in]  state    motion
 * @param[out] outputs  what the scene asks for
 */
void elbow_output(
    const elbow_model *model,
    const elbow_state *state,
    elbow_outputs *outputs);

#ifdef __cplusplus
}
#endif

#endif /* TMM_GEN_KERNEL_elbow */

/**
 * arm50: Stiff arm of fifty links on a servo
 *
 * Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: 7e2e87b8a48332cf3886a22711bd9428eeea692a0d70cc5ae1662962d37ffc57
 * sha256 of the rest of this file: fca2406edd8b153de1c0a43e93bb73ed9cc6676d799633036a823b97f550cee6
 *
 * model: planar arm, large rotations, tip mass
 * stations: 50
 * base: prescribed
 * integrator: SDIRK, order 4, 5 stages (Hairer & Wanner 1996)
 * linearisation: newton
 * sweep: riccati
 * unknown: acceleration
 * operations of a step: 29465, 589.3 per station (13600 additions, 15115 multiplications, 250 divisions, 500
 *     sines and cosines)
 * operations of prepare: 329, 6.58 per station (55 additions, 274 multiplications)
 * number type: double
 * bytes of the structs: params 848, model 1392, state 1216, inputs 120, outputs 48
 *
 * Call arm50_default_params() and arm50_prepare() once, arm50_initialise() to put the arm somewhere, then
 * arm50_step() at every tick of the clock and arm50_output() to know. All memory is the caller's; nothing is
 * kept between calls, so any number of arms can be run side by side.
 *
 * @file arm50.h
 */
#ifndef TMM_GEN_KERNEL_arm50
#define TMM_GEN_KERNEL_arm50

#ifdef __cplusplus
extern "C" {
#endif

/** Number of links. */
#define ARM50_STATIONS 50

/** The scene's time step [s]. */
#define ARM50_STEP 0.002

/** Stages of a step, at which inputs are read: 0.25 of the step, 0.75 of the step, 0.55 of the step, 0.5 of
 * the step and the end of the step. */
#define ARM50_STAGES 5

/** Type of all numbers. */
typedef double arm50_real;

/** What a function says about its success. */
typedef enum {
    /** Success. */
    ARM50_OK = 0,
    /** An argument is infinite or not a number; nothing was changed. */
    ARM50_NON_FINITE_INPUT,
    /** The time step is not a positive number; nothing was changed. */
    ARM50_INVALID_STEP,
    /** No passive arm has such parameters (a negative inertia, say); the model is of no use. */
    ARM50_VANISHING_PIVOT,
    /** The motion has outgrown the number type; initialise anew. */
    ARM50_NON_FINITE_STATE,
    /** A pointer that is needed is NULL; nothing was changed. */
    ARM50_NULL_POINTER = 6,
    /** Parameters or time step are too large or too small for the number type; the model is of no use. */
    ARM50_NON_FINITE_MODEL = 7
} arm50_status;

/** Physical parameters. */
typedef struct {
    arm50_real length; /**< link length, the same everywhere [m] */
    arm50_real mass; /**< link mass, the same everywhere [kg] */
    arm50_real inertia; /**< link inertia about its centre of mass, the same everywhere [kg m^2] */
    arm50_real center; /**< centre of mass along the link, 0 to 1, the same everywhere */
    arm50_real stiffness[ARM50_STATIONS]; /**< joint stiffness, base to tip [N m/rad] */
    arm50_real damping[ARM50_STATIONS]; /**< joint damping, base to tip [N m s/rad] */
    arm50_real tip_mass; /**< mass at the tip [kg] */
    arm50_real tip_inertia; /**< inertia at the tip [kg m^2] */
} arm50_params;

/** What prepare() derives from the parameters and the time step. */
typedef struct {
    arm50_real length; /**< link length, the same everywhere [m] */
    arm50_real mass; /**< link mass, the same everywhere [kg] */
    arm50_real stiffness[ARM50_STATIONS]; /**< joint stiffness, base to tip [N m/rad] */
    arm50_real damping[ARM50_STATIONS]; /**< joint damping, base to tip [N m s/rad] */
    arm50_real tip_mass; /**< mass at the tip [kg] */
    arm50_real tip_inertia; /**< inertia at the tip [kg m^2] */
    arm50_real rate_per_acceleration; /**< rate per unit of acceleration: step/4 [s] */
    arm50_real half_timestep; /**< step/2 [s] */
    arm50_real angle_per_acceleration; /**< angle per unit of acceleration: step**2/16 [s^2] */
    arm50_real three_quarters_timestep; /**< 3*step/4 [s] */
    arm50_real predicted_rate_per_stage1_acceleration; /**< 17*step/50 [s] */
    arm50_real predicted_rate_per_stage2_acceleration; /**< 21*step/100 [s] */
    arm50_real predicted_angle_per_stage2_rate; /**< step/25 [s] */
    arm50_real predicted_rate_per_stage1_acceleration_2; /**< 371*step/1360 [s] */
    arm50_real predicted_rate_per_stage2_acceleration_2; /**< 137*step/2720 [s] */
    arm50_real predicted_rate_per_stage3_acceleration; /**< 151*step/544 [s] */
    arm50_real predicted_angle_per_stage3_rate; /**< 15*step/544 [s] */
    arm50_real predicted_rate_per_stage1_acceleration_3; /**< 25*step/24 [s] */
    arm50_real predicted_rate_per_stage2_acceleration_3; /**< 49*step/48 [s] */
    arm50_real predicted_rate_per_stage3_acceleration_2; /**< 125*step/16 [s] */
    arm50_real predicted_rate_per_stage4_acceleration; /**< 41*step/6 [s] */
    arm50_real predicted_angle_per_stage4_rate; /**< 85*step/12 [s] */
    arm50_real reaction_x_per_acceleration_x; /**< center*mass [N s^2/m] */
    arm50_real reaction_x_per_acceleration_x_2; /**< mass*(center - 1) [N s^2/m] */
    arm50_real end_mass; /**< mass at the tip less the share of a link beyond it [kg] */
    arm50_real rod_inertia; /**< inertia of a link that masses at its ends leave over [kg m^2] */
    arm50_real joint_impedance[ARM50_STATIONS]; /**< torque of a joint per difference of unknowns [kg m^2] */
} arm50_model;

/** Motion of the arm, and the history its integrator needs. */
typedef struct {
    arm50_real hub_angle; /**< hub angle [rad] */
    arm50_real hub_rate; /**< hub rate [rad/s] */
    arm50_real angle[ARM50_STATIONS]; /**< angle of each link, base to tip [rad] */
    arm50_real rate[ARM50_STATIONS]; /**< rate of each link, base to tip [rad/s] */
    arm50_real acceleration[ARM50_STATIONS]; /**< acceleration of each link, base to tip [rad/s^2] */
} arm50_state;

/** What acts on the arm. */
typedef struct {
    /** prescribed base angle, at each stage of the step [rad] */
#ifndef base_angle
    arm50_real base_angle[ARM50_STAGES];
#else /* a macro would replace the name */
    arm50_real tmm_base_angle[ARM50_STAGES];
#endif
    /** prescribed base rate, at each stage of the step [rad/s] */
#ifndef base_angle_rate
    arm50_real base_angle_rate[ARM50_STAGES];
#else /* a macro would replace the name */
    arm50_real tmm_base_angle_rate[ARM50_STAGES];
#endif
    /** prescribed base acceleration, at each stage of the step [rad/s^2] */
#ifndef base_angle_acceleration
    arm50_real base_angle_acceleration[ARM50_STAGES];
#else /* a macro would replace the name */
    arm50_real tmm_base_angle_acceleration[ARM50_STAGES];
#endif
} arm50_inputs;

/** What the scene asks to know. */
typedef struct {
#ifndef tip_x
    arm50_real tip_x; /**< position at the tip, x [m] */
#else /* a macro would replace the name */
    arm50_real tmm_tip_x;
#endif
#ifndef tip_y
    arm50_real tip_y; /**< position at the tip, y [m] */
#else /* a macro would replace the name */
    arm50_real tmm_tip_y;
#endif
#ifndef tip_angle
    arm50_real tip_angle; /**< angle at the tip [rad] */
#else /* a macro would replace the name */
    arm50_real tmm_tip_angle;
#endif
#ifndef reaction_x
    arm50_real reaction_x; /**< force at the base, x [N] */
#else /* a macro would replace the name */
    arm50_real tmm_reaction_x;
#endif
#ifndef reaction_y
    arm50_real reaction_y; /**< force at the base, y [N] */
#else /* a macro would replace the name */
    arm50_real tmm_reaction_y;
#endif
#ifndef drive
    arm50_real drive; /**< torque at the base [N m] */
#else /* a macro would replace the name */
    arm50_real tmm_drive;
#endif
} arm50_outputs;

/**
 * Write the scene's parameters.
 *
 * @param[out] params  parameters; nothing is done where it is NULL
 */
void arm50_default_params(arm50_params *params);

/**
 * Compute what depends on parameters and step alone.
 *
 * @param[out] model   what the other functions need
 * @param[in]  params  parameters
 * @param[in]  step    time step [s]
 * @return OK, NON_FINITE_INPUT, NULL_POINTER, INVALID_STEP, VANISHING_PIVOT or NON_FINITE_MODEL
 */
arm50_status arm50_prepare(
    arm50_model *model,
    const arm50_params *params,
    arm50_real step);

/**
 * Start from given angles and rates with the acceleration that satisfies the equations of motion.
 *
 * @param[out] state   motion at the initial instant
 * @param[in]  params  parameters
 * @param[in]  initial_angle  angles to start from [rad]; NULL for the scene's own
 * @param[in]  initial_rate  rates to start from [rad/s]; NULL for the scene's own
 * @param[in]  inputs  what acts at the initial instant; only the first stage's count
 * @return OK, NON_FINITE_INPUT, NULL_POINTER, VANISHING_PIVOT or NON_FINITE_STATE
 */
arm50_status arm50_initialise(
    arm50_state *state,
    const arm50_params *params,
    const arm50_real initial_angle[ARM50_STATIONS],
    const arm50_real initial_rate[ARM50_STATIONS],
    const arm50_inputs *inputs);

/**
 * Advance the state by one step.
 *
 * @param[in]     model   from arm50_prepare()
 * @param[in,out] state   motion before the step, and after it
 * @param[in]     inputs  what acts, at each stage of the step
 * @return OK, NON_FINITE_INPUT, NULL_POINTER, VANISHING_PIVOT or NON_FINITE_STATE
 */
arm50_status arm50_step(
    const arm50_model *model,
    arm50_state *state,
    const arm50_inputs *inputs);

/**
 * Read the outputs off the state. Nothing is done where a pointer is NULL.
 *
 * @param[in]  model    from arm50_prepare()
 * @param[in]  state    motion
 * @param[out] outputs  what the scene asks for
 */
void arm50_output(
    const arm50_model *model,
    const arm50_state *state,
    arm50_outputs *outputs);

#ifdef __cplusplus
}
#endif

#endif /* TMM_GEN_KERNEL_arm50 */

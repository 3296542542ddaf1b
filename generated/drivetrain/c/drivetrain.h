/**
 * drivetrain: Servo drive with gearbox, roller, brake and encoder
 *
 * Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: 260c88ca5ffe6b93ea5946fad67187e547942573db1dc2f710bcd9a0610b8738
 * sha256 of the rest of this file: bb17b055cac29e44ebdce3fa2958ce2431140414578e478f1297e25102fe9e34
 *
 * model: torsional chain (linear)
 * stations: 6
 * base: motor
 * integrator: Generalised alpha (Chung & Hulbert 1993), rho_inf = 0.8
 * sweep: riccati
 * unknown: acceleration
 * operations of a step: 215, 35.83 per station (107 additions, 108 multiplications)
 * operations of prepare: 88, 14.67 per station (20 additions, 61 multiplications, 7 divisions)
 * number type: double
 * bytes of the structs: params 160, model 320, state 168, inputs 16, outputs 32
 *
 * Call drivetrain_default_params() and drivetrain_prepare() once, drivetrain_initialise() to put the arm
 * somewhere, then drivetrain_step() at every tick of the clock and drivetrain_output() to know. All memory is
 * the caller's; nothing is kept between calls, so any number of arms can be run side by side.
 *
 * @file drivetrain.h
 */
#ifndef TMM_GEN_KERNEL_drivetrain
#define TMM_GEN_KERNEL_drivetrain

#ifdef __cplusplus
extern "C" {
#endif

/** Number of links. */
#define DRIVETRAIN_STATIONS 6

/** The scene's time step [s]. */
#define DRIVETRAIN_STEP 0.0001

/** Type of all numbers. */
typedef double drivetrain_real;

/** What a function says about its success. */
typedef enum {
    /** Success. */
    DRIVETRAIN_OK = 0,
    /** An argument is infinite or not a number; nothing was changed. */
    DRIVETRAIN_NON_FINITE_INPUT,
    /** The time step is not a positive number; nothing was changed. */
    DRIVETRAIN_INVALID_STEP,
    /** No passive arm has such parameters (a negative inertia, say); the model is of no use. */
    DRIVETRAIN_VANISHING_PIVOT,
    /** The motion has outgrown the number type; initialise anew. */
    DRIVETRAIN_NON_FINITE_STATE,
    /** A pointer that is needed is NULL; nothing was changed. */
    DRIVETRAIN_NULL_POINTER = 6,
    /** Parameters or time step are too large or too small for the number type; the model is of no use. */
    DRIVETRAIN_NON_FINITE_MODEL = 7
} drivetrain_status;

/** Physical parameters. */
typedef struct {
    drivetrain_real stiffness[DRIVETRAIN_STATIONS]; /**< joint stiffness, base to tip [N m/rad] */
    drivetrain_real damping[DRIVETRAIN_STATIONS]; /**< joint damping, base to tip [N m s/rad] */
    drivetrain_real inertia[DRIVETRAIN_STATIONS]; /**< link inertia, base to tip [kg m^2] */
    drivetrain_real hub_inertia; /**< hub inertia [kg m^2] */
    drivetrain_real hub_damping; /**< viscous damping of the hub to ground [N m s/rad] */
} drivetrain_params;

/** What prepare() derives from the parameters and the time step. */
typedef struct {
    /** time step [s] */
    drivetrain_real step;
    /** joint stiffness, base to tip [N m/rad] */
    drivetrain_real stiffness[DRIVETRAIN_STATIONS];
    /** joint damping, base to tip [N m s/rad] */
    drivetrain_real damping[DRIVETRAIN_STATIONS];
    /** 5*step/108 [s] */
    drivetrain_real known_rate_per_acceleration;
    /** 5*step**2/243 [s^2] */
    drivetrain_real known_angle_per_acceleration;
    /** 5*step/9 [s] */
    drivetrain_real five_ninths_timestep;
    /** hub_admittance*hub_damping [s/rad] */
    drivetrain_real unknown_per_known_rate;
    /** step**2/27 [s^2] */
    drivetrain_real angle_per_acceleration_2;
    /** 25*step**2/54 [rad] */
    drivetrain_real angle_per_unknown;
    /** step/12 [s] */
    drivetrain_real twelfth_timestep;
    /** 11*step/12 [s] */
    drivetrain_real eleven_twelfths_timestep;
    /** inverse pivot of each joint */
    drivetrain_real admittance[DRIVETRAIN_STATIONS];
    /** share of motion and torque each joint passes on */
    drivetrain_real transmission[DRIVETRAIN_STATIONS];
    /** share of its own known torque each joint passes on */
    drivetrain_real reflection[DRIVETRAIN_STATIONS];
    /** inverse pivot of the hub */
    drivetrain_real hub_admittance;
} drivetrain_model;

/** Motion of the arm, and the history its integrator needs. */
typedef struct {
    /** hub angle [rad] */
    drivetrain_real hub_angle;
    /** hub rate [rad/s] */
    drivetrain_real hub_rate;
    /** hub acceleration [rad/s^2] */
    drivetrain_real hub_acceleration;
    /** angle of each link, base to tip [rad] */
    drivetrain_real angle[DRIVETRAIN_STATIONS];
    /** rate of each link, base to tip [rad/s] */
    drivetrain_real rate[DRIVETRAIN_STATIONS];
    /** acceleration of each link, base to tip [rad/s^2] */
    drivetrain_real acceleration[DRIVETRAIN_STATIONS];
} drivetrain_state;

/** What acts on the arm. */
typedef struct {
#ifndef motor_torque
    drivetrain_real motor_torque; /**< torque acting at the base [N m] */
#else /* a macro would replace the name */
    drivetrain_real tmm_motor_torque;
#endif
#ifndef load_torque
    drivetrain_real load_torque; /**< torque acting at station 4 [N m] */
#else /* a macro would replace the name */
    drivetrain_real tmm_load_torque;
#endif
} drivetrain_inputs;

/** What the scene asks to know. */
typedef struct {
#ifndef motor_speed
    drivetrain_real motor_speed; /**< velocity at the base [rad/s] */
#else /* a macro would replace the name */
    drivetrain_real tmm_motor_speed;
#endif
#ifndef roller_speed
    drivetrain_real roller_speed; /**< velocity at station 4 [rad/s] */
#else /* a macro would replace the name */
    drivetrain_real tmm_roller_speed;
#endif
#ifndef shaft_torque
    drivetrain_real shaft_torque; /**< torque at station 4 [N m] */
#else /* a macro would replace the name */
    drivetrain_real tmm_shaft_torque;
#endif
#ifndef encoder
    drivetrain_real encoder; /**< angle at the tip [rad] */
#else /* a macro would replace the name */
    drivetrain_real tmm_encoder;
#endif
} drivetrain_outputs;

/**
 * Write the scene's parameters.
 *
 * @param[out] params  parameters; nothing is done where it is NULL
 */
void drivetrain_default_params(drivetrain_params *params);

/**
 * Compute what depends on parameters and step alone.
 *
 * @param[out] model   what the other functions need
 * @param[in]  params  parameters
 * @param[in]  step    time step [s]
 * @return OK, NON_FINITE_INPUT, NULL_POINTER, INVALID_STEP, VANISHING_PIVOT or NON_FINITE_MODEL
 */
drivetrain_status drivetrain_prepare(
    drivetrain_model *model,
    const drivetrain_params *params,
    drivetrain_real step);

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
drivetrain_status drivetrain_initialise(
    drivetrain_state *state,
    const drivetrain_params *params,
    const drivetrain_real initial_angle[DRIVETRAIN_STATIONS],
    const drivetrain_real initial_rate[DRIVETRAIN_STATIONS],
    const drivetrain_inputs *inputs);

/**
 * Advance the state by one step.
 *
 * @param[in]     model   from drivetrain_prepare()
 * @param[in,out] state   motion before the step, and after it
 * @param[in]     inputs  what acts, at 0.555556 of the step
 * @return OK, NON_FINITE_INPUT, NULL_POINTER or NON_FINITE_STATE
 */
drivetrain_status drivetrain_step(
    const drivetrain_model *model,
    drivetrain_state *state,
    const drivetrain_inputs *inputs);

/**
 * Read the outputs off the state. Nothing is done where a pointer is NULL.
 *
 * @param[in]  model    from drivetrain_prepare()
 * @param[in]  state    motion
 * @param[out] outputs  what the scene asks for
 */
void drivetrain_output(
    const drivetrain_model *model,
    const drivetrain_state *state,
    drivetrain_outputs *outputs);

#ifdef __cplusplus
}
#endif

#endif /* TMM_GEN_KERNEL_drivetrain */

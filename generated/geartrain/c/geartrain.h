/**
 * geartrain: Servo with two stages of gears on a table and a feeder
 *
 * Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: 066060c018d378c5aa38f61f583a4ed37c9ee269f8287dfe93f42445474eebe1
 * sha256 of the rest of this file: aebd80a2833700f595a388dc00308c2cc18a95503422f2856e3d3fd045ecea3d
 *
 * model: torsional chain (linear)
 * stations: 4
 * base: motor
 * integrator: Generalised alpha (Chung & Hulbert 1993), rho_inf = 0.8
 * sweep: riccati
 * unknown: acceleration
 * joints in arrays, from 0: coupling 0, belt 1, second 2, shaft 3
 * links in arrays, from 0: pinion 0, layshaft 0, feeder 1, wheel 2, table 3
 * operations of a step: 159, 39.75 per station (75 additions, 84 multiplications)
 * operations of prepare: 75, 18.75 per station (13 additions, 51 multiplications, 11 divisions)
 * number type: double
 * bytes of the structs: params 144, model 288, state 120, inputs 24, outputs 48
 *
 * Call geartrain_default_params() and geartrain_prepare() once, geartrain_initialise() to put the arm
 * somewhere, then geartrain_step() at every tick of the clock and geartrain_output() to know. All memory is
 * the caller's; nothing is kept between calls, so any number of arms can be run side by side.
 *
 * @file geartrain.h
 */
#ifndef TMM_GEN_KERNEL_geartrain
#define TMM_GEN_KERNEL_geartrain

#ifdef __cplusplus
extern "C" {
#endif

/** Number of links. */
#define GEARTRAIN_STATIONS 4

/** The scene's time step [s]. */
#define GEARTRAIN_STEP 0.0001

/** Type of all numbers. */
typedef double geartrain_real;

/** What a function says about its success. */
typedef enum {
    /** Success. */
    GEARTRAIN_OK = 0,
    /** An argument is infinite or not a number; nothing was changed. */
    GEARTRAIN_NON_FINITE_INPUT,
    /** The time step is not a positive number; nothing was changed. */
    GEARTRAIN_INVALID_STEP,
    /** No passive arm has such parameters (a negative inertia, say); the model is of no use. */
    GEARTRAIN_VANISHING_PIVOT,
    /** The motion has outgrown the number type; initialise anew. */
    GEARTRAIN_NON_FINITE_STATE,
    /** A pointer that is needed is NULL; nothing was changed. */
    GEARTRAIN_NULL_POINTER = 6,
    /** Parameters or time step are too large or too small for the number type; the model is of no use. */
    GEARTRAIN_NON_FINITE_MODEL = 7
} geartrain_status;

/** Physical parameters. */
typedef struct {
    /** joint stiffness, base to tip [N m/rad] */
    geartrain_real stiffness[GEARTRAIN_STATIONS];
    /** joint damping, base to tip [N m s/rad] */
    geartrain_real damping[GEARTRAIN_STATIONS];
    /** turns of a joint's inner side per turn of its outer one, base to tip */
    geartrain_real ratio[GEARTRAIN_STATIONS];
    /** link inertia, base to tip [kg m^2] */
    geartrain_real inertia[GEARTRAIN_STATIONS];
    /** hub inertia [kg m^2] */
    geartrain_real hub_inertia;
    /** viscous damping of the hub to ground [N m s/rad] */
    geartrain_real hub_damping;
} geartrain_params;

/** What prepare() derives from the parameters and the time step. */
typedef struct {
    geartrain_real step; /**< time step [s] */
    geartrain_real stiffness[GEARTRAIN_STATIONS]; /**< joint stiffness, base to tip [N m/rad] */
    geartrain_real damping[GEARTRAIN_STATIONS]; /**< joint damping, base to tip [N m s/rad] */
    geartrain_real known_rate_per_acceleration; /**< 5*step/108 [s] */
    geartrain_real known_angle_per_acceleration; /**< 5*step**2/243 [s^2] */
    geartrain_real five_ninths_timestep; /**< 5*step/9 [s] */
    geartrain_real unknown_per_known_rate; /**< hub_admittance*hub_damping [s/rad] */
    geartrain_real angle_per_acceleration_2; /**< step**2/27 [s^2] */
    geartrain_real angle_per_unknown; /**< 25*step**2/54 [rad] */
    geartrain_real twelfth_timestep; /**< step/12 [s] */
    geartrain_real eleven_twelfths_timestep; /**< 11*step/12 [s] */
    geartrain_real teeth_per_angle; /**< stiffness[2]/ratio[2] [N m/rad] */
    geartrain_real teeth_per_rate; /**< damping[2]/ratio[2] [N m s/rad] */
    geartrain_real turn[GEARTRAIN_STATIONS]; /**< turns of a joint's outer side per turn of its inner one */
    geartrain_real admittance[GEARTRAIN_STATIONS]; /**< inverse pivot of each joint */
    geartrain_real transmission[GEARTRAIN_STATIONS]; /**< share of motion and torque each joint passes on */
    geartrain_real reflection[GEARTRAIN_STATIONS]; /**< share of its own known torque each joint passes on */
    geartrain_real hub_admittance; /**< inverse pivot of the hub */
} geartrain_model;

/** Motion of the arm, and the history its integrator needs. */
typedef struct {
    geartrain_real hub_angle; /**< hub angle [rad] */
    geartrain_real hub_rate; /**< hub rate [rad/s] */
    geartrain_real hub_acceleration; /**< hub acceleration [rad/s^2] */
    geartrain_real angle[GEARTRAIN_STATIONS]; /**< angle of each link, base to tip [rad] */
    geartrain_real rate[GEARTRAIN_STATIONS]; /**< rate of each link, base to tip [rad/s] */
    geartrain_real acceleration[GEARTRAIN_STATIONS]; /**< acceleration of each link, base to tip [rad/s^2] */
} geartrain_state;

/** What acts on the arm. */
typedef struct {
#ifndef motor_torque
    geartrain_real motor_torque; /**< torque acting at 'servo' [N m] */
#else /* a macro would replace the name */
    geartrain_real tmm_motor_torque;
#endif
#ifndef load_torque
    geartrain_real load_torque; /**< torque acting at 'table' [N m] */
#else /* a macro would replace the name */
    geartrain_real tmm_load_torque;
#endif
#ifndef feeder_torque
    geartrain_real feeder_torque; /**< torque acting at 'feeder' [N m] */
#else /* a macro would replace the name */
    geartrain_real tmm_feeder_torque;
#endif
} geartrain_inputs;

/** What the scene asks to know. */
typedef struct {
#ifndef motor_speed
    geartrain_real motor_speed; /**< velocity at 'servo' [rad/s] */
#else /* a macro would replace the name */
    geartrain_real tmm_motor_speed;
#endif
#ifndef table
    geartrain_real table; /**< angle at 'table' [rad] */
#else /* a macro would replace the name */
    geartrain_real tmm_table;
#endif
#ifndef table_speed
    geartrain_real table_speed; /**< velocity at 'table' [rad/s] */
#else /* a macro would replace the name */
    geartrain_real tmm_table_speed;
#endif
#ifndef feeder_speed
    geartrain_real feeder_speed; /**< velocity at 'feeder' [rad/s] */
#else /* a macro would replace the name */
    geartrain_real tmm_feeder_speed;
#endif
#ifndef coupling_torque
    geartrain_real coupling_torque; /**< torque at 'coupling' [N m] */
#else /* a macro would replace the name */
    geartrain_real tmm_coupling_torque;
#endif
#ifndef teeth
    geartrain_real teeth; /**< torque at 'second' [N m] */
#else /* a macro would replace the name */
    geartrain_real tmm_teeth;
#endif
} geartrain_outputs;

/**
 * Write the scene's parameters.
 *
 * @param[out] params  parameters; nothing is done where it is NULL
 */
void geartrain_default_params(geartrain_params *params);

/**
 * Compute what depends on parameters and step alone.
 *
 * @param[out] model   what the other functions need
 * @param[in]  params  parameters
 * @param[in]  step    time step [s]
 * @return OK, NON_FINITE_INPUT, NULL_POINTER, INVALID_STEP, VANISHING_PIVOT or NON_FINITE_MODEL
 */
geartrain_status geartrain_prepare(
    geartrain_model *model,
    const geartrain_params *params,
    geartrain_real step);

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
geartrain_status geartrain_initialise(
    geartrain_state *state,
    const geartrain_params *params,
    const geartrain_real initial_angle[GEARTRAIN_STATIONS],
    const geartrain_real initial_rate[GEARTRAIN_STATIONS],
    const geartrain_inputs *inputs);

/**
 * Advance the state by one step.
 *
 * @param[in]     model   from geartrain_prepare()
 * @param[in,out] state   motion before the step, and after it
 * @param[in]     inputs  what acts, at 0.555556 of the step
 * @return OK, NON_FINITE_INPUT, NULL_POINTER or NON_FINITE_STATE
 */
geartrain_status geartrain_step(
    const geartrain_model *model,
    geartrain_state *state,
    const geartrain_inputs *inputs);

/**
 * Read the outputs off the state. Nothing is done where a pointer is NULL.
 *
 * @param[in]  model    from geartrain_prepare()
 * @param[in]  state    motion
 * @param[out] outputs  what the scene asks for
 */
void geartrain_output(
    const geartrain_model *model,
    const geartrain_state *state,
    geartrain_outputs *outputs);

#ifdef __cplusplus
}
#endif

#endif /* TMM_GEN_KERNEL_geartrain */

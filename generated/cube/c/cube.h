/**
 * cube: Satellite with two flexible panels
 *
 * Written by tmm-gen 0.2.0. Do not edit: change the scene and run `tmm-gen build`.
 * scene digest: f046f23ff154c77eb0de6f429bf04f6275910b87af75eea62b4aa0e7be8a3583
 * sha256 of the rest of this file: dce53faef960a970fbd73c75a735c436b5c5c959b072ef60328b8ec30068bbc1
 *
 * model: planar arm, large rotations
 * stations: 12
 * base: free
 * integrator: Newmark 1959, beta = 0.25, gamma = 0.5
 * linearisation: newton
 * sweep: riccati
 * unknown: acceleration
 * joints in arrays, from 0: left_latch 0, right_latch 6
 * links in arrays, from 0: left_yoke 0, left_panel 1 to 5, right_yoke 6, right_panel 7 to 11
 * operations of a step: 1462, 121.8 per station (686 additions, 734 multiplications, 18 divisions, 24 sines
 *     and cosines)
 * operations of prepare: 201, 16.75 per station (62 additions, 139 multiplications)
 * number type: double
 * bytes of the structs: params 600, model 720, state 360, inputs 16, outputs 48
 *
 * Call cube_default_params() and cube_prepare() once, cube_initialise() to put the arm somewhere, then
 * cube_step() at every tick of the clock and cube_output() to know. All memory is the caller's; nothing is
 * kept between calls, so any number of arms can be run side by side.
 *
 * @file cube.h
 */
#ifndef TMM_GEN_KERNEL_cube
#define TMM_GEN_KERNEL_cube

#ifdef __cplusplus
extern "C" {
#endif

/** Number of links. */
#define CUBE_STATIONS 12

/** The scene's time step [s]. */
#define CUBE_STEP 0.002

/** Type of all numbers. */
typedef double cube_real;

/** What a function says about its success. */
typedef enum {
    /** Success. */
    CUBE_OK = 0,
    /** An argument is infinite or not a number; nothing was changed. */
    CUBE_NON_FINITE_INPUT,
    /** The time step is not a positive number; nothing was changed. */
    CUBE_INVALID_STEP,
    /** No passive arm has such parameters (a negative inertia, say); the model is of no use. */
    CUBE_VANISHING_PIVOT,
    /** The motion has outgrown the number type; initialise anew. */
    CUBE_NON_FINITE_STATE,
    /** A pointer that is needed is NULL; nothing was changed. */
    CUBE_NULL_POINTER = 6,
    /** Parameters or time step are too large or too small for the number type; the model is of no use. */
    CUBE_NON_FINITE_MODEL = 7
} cube_status;

/** Physical parameters. */
typedef struct {
    cube_real length[CUBE_STATIONS]; /**< link length, base to tip [m] */
    cube_real mass[CUBE_STATIONS]; /**< link mass, base to tip [kg] */
    cube_real inertia[CUBE_STATIONS]; /**< link inertia about its centre of mass, base to tip [kg m^2] */
    cube_real center; /**< centre of mass along the link, 0 to 1, the same everywhere */
    cube_real stiffness[CUBE_STATIONS]; /**< joint stiffness, base to tip [N m/rad] */
    cube_real damping[CUBE_STATIONS]; /**< joint damping, base to tip [N m s/rad] */
    cube_real rest[CUBE_STATIONS]; /**< angle at which a joint's spring is slack, base to tip [rad] */
    cube_real hub_inertia; /**< hub inertia [kg m^2] */
    cube_real hub_mass; /**< mass of the bodies at the base [kg] */
} cube_params;

/** What prepare() derives from the parameters and the time step. */
typedef struct {
    /** time step [s] */
    cube_real step;
    /** link length, base to tip [m] */
    cube_real length[CUBE_STATIONS];
    /** joint stiffness, base to tip [N m/rad] */
    cube_real stiffness[CUBE_STATIONS];
    /** joint damping, base to tip [N m s/rad] */
    cube_real damping[CUBE_STATIONS];
    /** angle at which a joint's spring is slack, base to tip [rad] */
    cube_real rest[CUBE_STATIONS];
    /** hub inertia [kg m^2] */
    cube_real hub_inertia;
    /** step**2/2 [s^2] */
    cube_real half_step_squared;
    /** angle per unit of acceleration: step**2/4 [s^2] */
    cube_real angle_per_acceleration;
    /** rate per unit of acceleration: step/2 [s] */
    cube_real rate_per_acceleration;
    /** mass at the outer end of each link [kg] */
    cube_real node_mass[CUBE_STATIONS];
    /** inertia of a link that masses at its ends leave over [kg m^2] */
    cube_real rod_inertia[CUBE_STATIONS];
    /** mass at the base, its own and the shares of the links there [kg] */
    cube_real base_mass;
    /** torque of a joint per difference of unknowns [kg m^2] */
    cube_real joint_impedance[CUBE_STATIONS];
} cube_model;

/** Motion of the arm, and the history its integrator needs. */
typedef struct {
    cube_real hub_angle; /**< hub angle [rad] */
    cube_real hub_rate; /**< hub rate [rad/s] */
    cube_real hub_acceleration; /**< hub acceleration [rad/s^2] */
    cube_real angle[CUBE_STATIONS]; /**< angle of each link, base to tip [rad] */
    cube_real rate[CUBE_STATIONS]; /**< rate of each link, base to tip [rad/s] */
    cube_real acceleration[CUBE_STATIONS]; /**< acceleration of each link, base to tip [rad/s^2] */
    cube_real base_place_x; /**< place of the base along x [m] */
    cube_real base_velocity_x; /**< velocity of the base along x [m/s] */
    cube_real base_acceleration_x; /**< acceleration of the base along x [m/s^2] */
    cube_real base_place_y; /**< place of the base along y [m] */
    cube_real base_velocity_y; /**< velocity of the base along y [m/s] */
    cube_real base_acceleration_y; /**< acceleration of the base along y [m/s^2] */
} cube_state;

/** What acts on the arm. */
typedef struct {
#ifndef wheel
    cube_real wheel; /**< torque acting at 'hub' [N m] */
#else /* a macro would replace the name */
    cube_real tmm_wheel;
#endif
#ifndef thruster
    cube_real thruster; /**< force_y acting at 'hub' [N] */
#else /* a macro would replace the name */
    cube_real tmm_thruster;
#endif
} cube_inputs;

/** What the scene asks to know. */
typedef struct {
#ifndef attitude
    cube_real attitude; /**< angle at 'hub' [rad] */
#else /* a macro would replace the name */
    cube_real tmm_attitude;
#endif
#ifndef hub_x
    cube_real hub_x; /**< position at 'hub', x [m] */
#else /* a macro would replace the name */
    cube_real tmm_hub_x;
#endif
#ifndef hub_y
    cube_real hub_y; /**< position at 'hub', y [m] */
#else /* a macro would replace the name */
    cube_real tmm_hub_y;
#endif
#ifndef right_end_x
    cube_real right_end_x; /**< position at 'right_panel', x [m] */
#else /* a macro would replace the name */
    cube_real tmm_right_end_x;
#endif
#ifndef right_end_y
    cube_real right_end_y; /**< position at 'right_panel', y [m] */
#else /* a macro would replace the name */
    cube_real tmm_right_end_y;
#endif
#ifndef latch_torque
    cube_real latch_torque; /**< joint torque at 'right_latch' [N m] */
#else /* a macro would replace the name */
    cube_real tmm_latch_torque;
#endif
} cube_outputs;

/**
 * Write the scene's parameters.
 *
 * @param[out] params  parameters; nothing is done where it is NULL
 */
void cube_default_params(cube_params *params);

/**
 * Compute what depends on parameters and step alone.
 *
 * @param[out] model   what the other functions need
 * @param[in]  params  parameters
 * @param[in]  step    time step [s]
 * @return OK, NON_FINITE_INPUT, NULL_POINTER, INVALID_STEP, VANISHING_PIVOT or NON_FINITE_MODEL
 */
cube_status cube_prepare(
    cube_model *model,
    const cube_params *params,
    cube_real step);

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
cube_status cube_initialise(
    cube_state *state,
    const cube_params *params,
    const cube_real initial_angle[CUBE_STATIONS],
    const cube_real initial_rate[CUBE_STATIONS],
    const cube_inputs *inputs);

/**
 * Advance the state by one step.
 *
 * @param[in]     model   from cube_prepare()
 * @param[in,out] state   motion before the step, and after it
 * @param[in]     inputs  what acts, at the end of the step
 * @return OK, NON_FINITE_INPUT, NULL_POINTER, VANISHING_PIVOT or NON_FINITE_STATE
 */
cube_status cube_step(
    const cube_model *model,
    cube_state *state,
    const cube_inputs *inputs);

/**
 * Read the outputs off the state. Nothing is done where a pointer is NULL.
 *
 * @param[in]  model    from cube_prepare()
 * @param[in]  state    motion
 * @param[out] outputs  what the scene asks for
 */
void cube_output(
    const cube_model *model,
    const cube_state *state,
    cube_outputs *outputs);

#ifdef __cplusplus
}
#endif

#endif /* TMM_GEN_KERNEL_cube */

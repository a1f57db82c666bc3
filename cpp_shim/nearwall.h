/* nearwall.h - what happens when a particle hits a wall: the C interface of libnearwall.
 *
 * Inputs come first, outputs last. Every call returns a status, and its outputs are untouched unless that is NW_OK
 * (except a message and the index of an invalid impact).
 * A model never changes after it is loaded: any number of threads may share it without a lock. Calls keep no state:
 * the same model and impact give the same bits. The floating-point control and flags of the caller stay unchanged
 * (x86-64), whatever it traps. The process aborts if memory runs out while a model is loaded.
 *
 * Licence: MIT OR Apache-2.0. */

#ifndef NEARWALL_H
#define NEARWALL_H

/* Written by cbindgen from src/c_api; `NEARWALL_BLESS=1 cargo test --test library interface` writes it again. */

#include <stddef.h>
#include <stdint.h>

// Applies a macro to the name of every input of `nw_impact`, in the order of its fields.
#define NW_IMPACT_INPUTS(X) \
  X(v_n) \
  X(v_t) \
  X(omega) \
  X(d) \
  X(T_p) \
  X(rho_p) \
  X(conversion) \
  X(T_w) \
  X(T_under) \
  X(roughness) \
  X(coverage) \
  X(layer_thickness) \
  X(film_thickness) \
  X(melt_thickness) \
  X(v_gas)

// Version of the binary interface; it rises when a struct, a function or a constant changes.
#define NW_ABI_VERSION 1

// Length of the arrays `extra`: a model file declares at most this many inputs.
#define NW_EXTRA_INPUTS 8

// Number of processes that change a deposit.
#define NW_PROCESSES 5

// Number of directions of space.
#define NW_DIRECTIONS 3

// Bit of `flags`: a property or a fitted term was used outside its stated range.
#define NW_OUTSIDE_VALID_RANGE 1

// A loaded model: opaque, immutable, shareable between threads.
typedef struct nw_model nw_model;

// Status returned by every call.
typedef int32_t nw_status;

// Which of particle and wall is sticky.
typedef uint32_t nw_regime;

// One particle as it reaches a wall. Fill it with `nw_impact_init`, then set the known inputs.
typedef struct nw_impact {
  // `sizeof(nw_impact)`.
  uint32_t struct_size;
  // Index of the wall, from `nw_model_find_wall`.
  uint32_t wall;
  // Seed of the run's random draws.
  uint64_t seed;
  // Unique key of this impact: random draws depend only on `seed` and `key`.
  uint64_t key;
  // Speed towards the wall [m/s], not negative.
  double v_n;
  // Speed along the wall [m/s], not negative.
  double v_t;
  // Spin before the impact [rad/s], positive when the particle rolls forward along `v_t`.
  double omega;
  // Particle diameter [m], positive.
  double d;
  // Particle temperature [K], positive.
  double T_p;
  // Density of the particle [kg/m3], not negative; 0 takes that of its material.
  double rho_p;
  // Carbon conversion [1], 0 to 1; 1 for a particle without carbon.
  double conversion;
  // Wall temperature [K], positive.
  double T_w;
  // Temperature of the wall's own material under a deposit [K], not negative; 0 takes `T_w`.
  double T_under;
  // Roughness of the wall [m], not negative; kept for diagnosis, used by no built-in law.
  double roughness;
  // Share of the wall that non-sticky char covers [1], 0 to 1.
  double coverage;
  // Thickness of the powder layer on the wall [m], not negative.
  double layer_thickness;
  // Thickness of a liquid film [m], not negative; `liquid-film` uses it, or the melt if thicker.
  double film_thickness;
  // Thickness of the melt in the deposit of earlier particles [m], not negative.
  double melt_thickness;
  // Speed of the gas along the wall [m/s], not negative.
  double v_gas;
  // The inputs that the model file declares, in the order of `nw_extra_input_name`; NaN for the default.
  double extra[NW_EXTRA_INPUTS];
} nw_impact;

// Result of an impact.
typedef struct nw_outcome {
  // `sizeof(nw_outcome)`.
  uint32_t struct_size;
  // Which of particle and wall is sticky.
  nw_regime regime;
  // 1 when this particle is captured (drawn from `p_stick`), 0 when it rebounds.
  uint32_t stuck;
  // Bits: `NW_OUTSIDE_VALID_RANGE`.
  uint32_t flags;
  // Normal restitution [1] if the particle rebounds.
  double e_n;
  // Tangential restitution [1] if the particle rebounds.
  double e_t;
  // Probability of capture [1].
  double p_stick;
  // Spin after a rebound [rad/s].
  double omega;
} nw_outcome;

// Arrays of impacts, each with `count` entries. Only `v_n` is required; a null array
// means the value that `nw_impact_init` sets, and for `key` the index of the entry:
// with a null `key`, change `seed` in every call, or each call repeats the draws.
typedef struct nw_impacts {
  // `sizeof(nw_impacts)`.
  uint32_t struct_size;
  // Wall of every impact if `walls` is null.
  uint32_t wall;
  // Number of impacts.
  size_t count;
  // Seed of all draws.
  uint64_t seed;
  // Wall of each impact.
  const uint32_t *walls;
  // Unique key of each impact.
  const uint64_t *key;
  // Speed towards the wall [m/s], not negative.
  const double *v_n;
  // Speed along the wall [m/s], not negative.
  const double *v_t;
  // Spin before the impact [rad/s], positive when the particle rolls forward along `v_t`.
  const double *omega;
  // Particle diameter [m], positive.
  const double *d;
  // Particle temperature [K], positive.
  const double *T_p;
  // Density of the particle [kg/m3], not negative; 0 takes that of its material.
  const double *rho_p;
  // Carbon conversion [1], 0 to 1; 1 for a particle without carbon.
  const double *conversion;
  // Wall temperature [K], positive.
  const double *T_w;
  // Temperature of the wall's own material under a deposit [K], not negative; 0 takes `T_w`.
  const double *T_under;
  // Roughness of the wall [m], not negative; kept for diagnosis, used by no built-in law.
  const double *roughness;
  // Share of the wall that non-sticky char covers [1], 0 to 1.
  const double *coverage;
  // Thickness of the powder layer on the wall [m], not negative.
  const double *layer_thickness;
  // Thickness of a liquid film [m], not negative; `liquid-film` uses it, or the melt if thicker.
  const double *film_thickness;
  // Thickness of the melt in the deposit of earlier particles [m], not negative.
  const double *melt_thickness;
  // Speed of the gas along the wall [m/s], not negative.
  const double *v_gas;
  // The inputs that the model file declares, in the order of `nw_extra_input_name`; NaN for the default.
  const double *extra[NW_EXTRA_INPUTS];
} nw_impacts;

// Arrays that receive the outcomes, each with room for `count` entries of `nw_impacts`; null if not wanted. They must
// not overlap the inputs or each other.
typedef struct nw_outcomes {
  // `sizeof(nw_outcomes)`.
  uint32_t struct_size;
  // Normal restitution.
  double *e_n;
  // Tangential restitution.
  double *e_t;
  // Probability of capture.
  double *p_stick;
  // Spin after a rebound [rad/s].
  double *omega;
  // Which of particle and wall is sticky.
  uint32_t *regime;
  // 1 captured, 0 rebounds.
  uint32_t *stuck;
  // Bits as in `nw_outcome`.
  uint32_t *flags;
} nw_outcomes;

// What cools and heats a wall. Fill it with `nw_wall_cooling_init`, then set what there is.
typedef struct nw_wall_cooling {
  // `sizeof(nw_wall_cooling)`.
  uint32_t struct_size;
  // Zero.
  uint32_t reserved;
  // Temperature of the coolant behind the wall [K], positive.
  double coolant_temperature;
  // Heat transfer coefficient of the coolant [W/(m2 K)]; infinite where the back of the wall has its temperature.
  double coolant_coefficient;
  // Thickness of the wall over its conductivity [m2 K/W], not negative.
  double wall_resistance;
  // Temperature of the gas [K], positive.
  double gas_temperature;
  // Heat transfer coefficient of the gas [W/(m2 K)], not negative: in a flow solver the
  // conductivity of the gas over the distance between wall and cell. Infinite where the
  // temperature of the surface is known: it is `gas_temperature`.
  double gas_coefficient;
  // Emissivity of the surface [1], 0 to 1.
  double emissivity;
  // Irradiation of the surface [W/m2], not negative: 5.670374419e-8 T^4 of surroundings of one temperature.
  double irradiation;
  // Further heat flux into the surface [W/m2], of particles or the net one of a radiation model.
  double further_flux;
  // Conductivity of the gas at the wall [W/(m K)] at its own temperature `void_temperature`, positive.
  // In the voids of the powder it changes with the powder's temperature by a power, see `other_conductivity`.
  double gas_conductivity;
  // Temperature [K] for which `gas_conductivity` is given, positive.
  double void_temperature;
  // Conductivity of the same gas [W/(m K)] at another temperature, such as that of the surface: it tells
  // the power. 0 where it is not known; then, and where no gas has such a power, it is the 0.8 of air.
  double other_conductivity;
  // Temperature [K] for which `other_conductivity` is given; 0 where there is none.
  double other_temperature;
  // Mass fraction of the vapour of the table `condensation` in the gas [1], 0 to 0.5; below 0 where it is that of
  // the model file.
  double vapour_fraction;
  // Heat transfer coefficient of the gas that carries the vapour [W/(m2 K)], where `gas_coefficient` has more than
  // that gas in it, such as what lands; 0 where it is `gas_coefficient`.
  double vapour_coefficient;
} nw_wall_cooling;

// Temperatures of a wall with a deposit.
typedef struct nw_wall_heat {
  // `sizeof(nw_wall_heat)`.
  uint32_t struct_size;
  // Zero.
  uint32_t reserved;
  // Temperature of the surface that impacts meet [K].
  double surface_temperature;
  // Temperature of the wall under the deposit [K].
  double wall_temperature;
  // Heat flux from the gas into the surface [W/m2].
  double heat_flux;
  // Heat flux into the coolant [W/m2]: `heat_flux` unless slag melts or freezes.
  double coolant_flux;
  // Thermal resistance of the deposit [m2 K/W].
  double deposit_resistance;
  // Change of temperature [K] in the last round of the solver: above 1e-9 where conductivities and
  // temperatures did not come to agree.
  double disagreement;
  // Temperature of what holds it behind the surface [K]: the coolant, or slag that melts or freezes.
  double behind_temperature;
  // Thermal resistance between there and the surface [m2 K/W]: the surface gives the difference of both
  // temperatures over it.
  double behind_resistance;
} nw_wall_heat;

// The deposit on a piece of wall, per wall area. `nw_deposit_init` makes a bare wall.
typedef struct nw_deposit {
  // `sizeof(nw_deposit)`.
  uint32_t struct_size;
  // Index of the wall, from `nw_model_find_wall`.
  uint32_t wall;
  // Mass of molten slag [kg/m2].
  double molten;
  // Mass of powder [kg/m2], outside of the slag and enclosed by it.
  double powder;
  // Volume of the powder's particles without the voids between them [m3/m2].
  double solid;
  // Projected area of the powder's particles [1], overlaps included.
  double cover;
  // Carbon conversion [1], mean by mass of the whole deposit.
  double conversion;
  // Volume of the powder's voids that sintering has closed [m3/m2].
  double closed;
  // Share of the outer powder that landed and has left with the gas [1].
  double resuspended;
  // Mass of frozen slag [kg/m2], below the molten slag.
  double frozen;
  // Share of the powder that slag has enclosed [1]; it lies below the slag.
  double behind;
} nw_deposit;

// Sum of the particles that a piece of wall captured in a step, per wall area.
// `nw_deposit_source_init` makes an empty sum.
typedef struct nw_deposit_source {
  // `sizeof(nw_deposit_source)`.
  uint32_t struct_size;
  // Number of particles.
  uint32_t count;
  // Molten mass [kg/m2].
  double molten;
  // Mass of powder [kg/m2].
  double powder;
  // Volume of the powder's particles [m3/m2].
  double solid;
  // Projected area of the powder's particles [1].
  double cover;
  // Area that the molten particles cover once they have spread [1].
  double buried;
  // Mass times carbon conversion [kg/m2].
  double converted;
} nw_deposit_source;

// What surrounds a piece of wall with a deposit. Fill it with `nw_deposit_surroundings_init`, then set what there is.
typedef struct nw_deposit_surroundings {
  // `sizeof(nw_deposit_surroundings)`.
  uint32_t struct_size;
  // Zero.
  uint32_t reserved;
  // Share of voids in fresh powder [1].
  double voidage;
  // Temperature of a wall that is not cooled [K]: its slag is liquid or frozen by it. 0 where it is
  // not known, and slag stays as it is.
  double wall_temperature;
  // Density of the gas at the wall [kg/m3]; needed where it shears the wall.
  double gas_density;
  // Its kinematic viscosity [m2/s]; needed where it shears the wall.
  double kinematic_viscosity;
  // Shear stress of the gas down the slope of the wall [Pa].
  double shear_down;
  // Shear stress of the gas across the slope [Pa].
  double shear_across;
  // Component of gravity away from the wall [m/s2], negative where it presses the deposit on.
  double gravity_outward;
  // Component of gravity along the wall [m/s2], not negative.
  double gravity_along;
  // Rank of this piece of wall from the weakest, 0, to below 1, the strongest [1]; a piece keeps its rank.
  double draw;
} nw_deposit_surroundings;

// Mass that a deposit lost in a time step, and the heat that crossed it.
typedef struct nw_deposit_losses {
  // `sizeof(nw_deposit_losses)`.
  uint32_t struct_size;
  // Zero.
  uint32_t reserved;
  // Mass by process [kg/m2]; `nw_process_loss` names the entries. Negative for a process that brings mass, which
  // `nw_process_gain` names; 0 for one that conserves mass.
  double mass[NW_PROCESSES];
  // Heat that the surface of a cooled wall took from gas, radiation and `further_flux` [J/m2]: the sum
  // of the next two less `heat_released`. 0, as they are, on a wall that is not cooled.
  double heat_taken;
  // Heat that went into the coolant [J/m2].
  double heat_to_coolant;
  // Heat that melting took [J/m2], negative where slag froze.
  double heat_of_fusion;
  // Heat that processes released at the surface, such as condensation [J/m2].
  double heat_released;
  // Thermal resistance of the deposit on a cooled wall at the start of the step [m2 K/W].
  double deposit_resistance;
} nw_deposit_losses;

// The walk of the gas's fluctuating velocity along the path of a particle, and the gas at the particle's place.
// Fill it with `nw_walk_init`, then set what there is.
typedef struct nw_walk {
  // `sizeof(nw_walk)`.
  uint32_t struct_size;
  // Zero.
  uint32_t reserved;
  // Seed of the run.
  uint64_t seed;
  // Key of the particle, unique within the run.
  uint64_t key;
  // Number of the step, 0 at the start of the particle; `nw_walk_advance` adds 1.
  uint64_t step;
  // Duration of the step that has brought the particle here [s], not negative.
  double duration;
  // Relaxation time of the particle [s], not negative.
  double relaxation_time;
  // Friction velocity at the nearest wall [m/s]; 0 far from walls, where `core_fluctuation` is needed.
  double friction_velocity;
  // Kinematic viscosity of the gas [m2/s]; needed beside a wall.
  double kinematic_viscosity;
  // Distance from the wall [m], not negative.
  double wall_distance;
  // Direction away from the wall, of length 1.
  double normal[NW_DIRECTIONS];
  // Mean velocity of the gas [m/s].
  double flow[NW_DIRECTIONS];
  // Standard deviation of each component of the velocity away from walls [m/s], `sqrt(2 k/3)`; 0 where it is
  // not known, then it is the friction velocity.
  double core_fluctuation;
  // Lagrangian time scale away from walls [s], some `k/(7 epsilon)`.
  double core_time;
  // Gradient of `core_fluctuation` [1/s].
  double core_gradient[NW_DIRECTIONS];
  // The walk [1]: kept by the caller from step to step.
  double values[NW_DIRECTIONS];
  // Fluctuating velocity of the gas [m/s].
  double velocity[NW_DIRECTIONS];
  // Longest next step [s] that does not change the statistics.
  double longest_step;
} nw_walk;

// Success.
#define NW_OK 0

// A required pointer is null.
#define NW_NULL_POINTER 1

// `struct_size` is not the size that this library expects, or a count is too large.
#define NW_STRUCT_SIZE 2

// A string is not valid UTF-8.
#define NW_NOT_UTF8 3

// The model file cannot be read.
#define NW_FILE 4

// The model is invalid; the message names file, line, column, key and remedy.
#define NW_MODEL 5

// The model has no wall with this name or index.
#define NW_UNKNOWN_WALL 6

// An input is not finite or violates its bounds.
#define NW_BAD_STATE 7

// A property is needed at a temperature outside its table; `nw_temperature_ranges` returns the limits of a wall.
#define NW_OUT_OF_RANGE 8

// An internal error; please report it.
#define NW_PANIC 9

// The model file declares no input with this index; `nw_extra_input_count` returns their number.
#define NW_UNKNOWN_INPUT 10

// The material of a layer of the deposit has no `thermal_conductivity` in the model file or the library.
#define NW_NO_CONDUCTIVITY 11

// The material of the particles has no `heat_capacity`, and the caller gives none.
#define NW_NO_HEAT_CAPACITY 12

// Non-sticky particle, non-sticky wall.
#define NW_NSP_NSW 0

// Non-sticky particle, sticky wall.
#define NW_NSP_SW 1

// Sticky particle, non-sticky wall.
#define NW_SP_NSW 2

// Sticky particle, sticky wall.
#define NW_SP_SW 3

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// Returns the interface version of the loaded library; compare it with `NW_ABI_VERSION` of the header.
uint32_t nw_abi_version(void);

// Returns the version of the library, for instance `0.1.0`, as a static string.
const char *nw_version(void);

// Returns the text of a status, or of an unknown number, as a static string.
const char *nw_status_text(nw_status status);

// Returns the name of a regime, for instance `NSP-SW`, as a static string.
const char *nw_regime_name(nw_regime regime);

// Loads a model file. On success `*model` is the model; free it with `nw_model_free`.
//
// On failure `message` (may be null) receives the reason with file, line, column, key and remedy: at most
// `message_size` bytes with the closing zero, cut between characters. On success `message` is untouched.
//
// # Safety
// `path` is a zero-terminated text, `model` can be written, `message` has room for `message_size` bytes or is null.
nw_status nw_model_load(const char *path,
                        struct nw_model **model,
                        char *message,
                        size_t message_size);

// Parses a model from TOML text of `toml_size` bytes, which needs no closing zero. Messages name it `name` (may be
// null). Otherwise as `nw_model_load`.
//
// # Safety
// `toml` has `toml_size` bytes, `name` is zero-terminated or null, the rest as in `nw_model_load`.
nw_status nw_model_parse(const char *toml,
                         size_t toml_size,
                         const char *name,
                         struct nw_model **model,
                         char *message,
                         size_t message_size);

// Frees a model; does nothing for null.
//
// # Safety
// `model` came from `nw_model_load` or `nw_model_parse` and is not used again.
void nw_model_free(struct nw_model *model);

// Finds the wall of a patch: the wall of that name, otherwise the last one whose name is a regular expression that
// matches. Returns `NW_UNKNOWN_WALL` if there is none, even if the model has a wall `default`.
//
// # Safety
// `model` is a loaded model, `name` is zero-terminated, `wall` can be written.
nw_status nw_model_find_wall(const struct nw_model *model,
                             const char *name,
                             uint32_t *wall);

// Initialises an impact: its size and the default of every input; wall, seed and key 0.
//
// # Safety
// `impact` can be written.
nw_status nw_impact_init(struct nw_impact *impact);

// Initialises an outcome for `nw_resolve`: its size and zeros.
//
// # Safety
// `outcome` can be written.
nw_status nw_outcome_init(struct nw_outcome *outcome);

// Resolves one impact. The same model and impact give the same bits, on any thread and in any order.
//
// # Safety
// `model` is a loaded model; `impact` and `outcome` begin with their `struct_size`.
nw_status nw_resolve(const struct nw_model *model,
                     const struct nw_impact *impact,
                     struct nw_outcome *outcome);

// Says why an impact cannot be decided: the status of `nw_resolve`, and in `message` (may be null)
// the input and its value, or the material, property, temperature and range: at most
// `message_size` bytes with the closing zero. `NW_OK` if it can be decided.
//
// # Safety
// `model` is a loaded model; `impact` begins with its `struct_size`; `message` has room for
// `message_size` bytes or is null.
nw_status nw_explain(const struct nw_model *model,
                     const struct nw_impact *impact,
                     char *message,
                     size_t message_size);

// Says what an impact marked `NW_OUTSIDE_VALID_RANGE` uses outside of its stated range, one thing a
// line: the property or law and its range, without the impact's own value, so that impacts can be
// counted by line. `text` receives at most `text_size` bytes with the closing zero, an empty text
// if all ranges are kept. Random draws are at their median.
//
// # Safety
// `model` is a loaded model; `impact` begins with its `struct_size`; `text` has room for `text_size` bytes.
nw_status nw_beyond(const struct nw_model *model,
                    const struct nw_impact *impact,
                    char *text,
                    size_t text_size);

// Says which input of an impact is probably in another unit: a temperature below 150 K (in degrees
// Celsius?), a diameter above 5 cm. `text` receives at most `text_size` bytes with the closing
// zero, an empty text if nothing is unlikely. Call it for the first impacts of a run: a
// temperature in degrees Celsius above 150 cannot be told from one in kelvin.
//
// # Safety
// `impact` begins with its `struct_size`, `text` has room for `text_size` bytes.
nw_status nw_unlikely(const struct nw_impact *impact, char *text, size_t text_size);

// Computes a key for an impact of a code that does not number its particles, from `count` values
// that tell this impact from all others on any number of ranks, such as place and time of the
// particle's release, its diameter, and the number of its hits. Equal values have equal keys, -0
// equals 0. `NW_BAD_STATE` if `count` is 0 or a value is not finite. The key is XXH64 with seed 0
// of the values' bytes, the lowest first.
//
// # Safety
// `values` has `count` entries, `key` can be written.
nw_status nw_key_of_values(const double *values, size_t count, uint64_t *key);

// Computes the adhesive, yield and sticking velocity [m/s] of an impact's particle and wall, with random draws at
// their median. They depend on the diameter, the temperatures, and the inputs of effects on the contact. Outputs may
// be null.
//
// # Safety
// `model` is a loaded model, `impact` begins with its `struct_size`, each output can be written or is null.
nw_status nw_speeds(const struct nw_model *model,
                    const struct nw_impact *impact,
                    double *adhesive,
                    double *yielding,
                    double *sticking);

// Computes the density [kg/m3] of the particle's material for an impact, which is taken where its `rho_p` is 0.
//
// # Safety
// `model` is a loaded model, `impact` begins with its `struct_size`, `density` can be written.
nw_status nw_particle_density(const struct nw_model *model,
                              const struct nw_impact *impact,
                              double *density);

// Computes the volume of wall [m3] that particles of a total `mass` [kg] remove by impacts like
// this one; 0 if the model file gives the wall no erosion law. Independent of what becomes of the
// particles.
//
// # Safety
// `model` is a loaded model, `impact` begins with its `struct_size`, `volume` can be written.
nw_status nw_erosion(const struct nw_model *model,
                     const struct nw_impact *impact,
                     double mass,
                     double *volume);

// Returns the temperatures [K] of particle and wall for which all property tables of a wall are defined: lowest and
// highest, 0 and infinity without a limit. Outputs may be null.
//
// # Safety
// `model` is a loaded model, each output can be written or is null.
nw_status nw_temperature_ranges(const struct nw_model *model,
                                uint32_t wall,
                                double *particle_low,
                                double *particle_high,
                                double *wall_low,
                                double *wall_high);

// Resolves many impacts, with the same bits as `nw_resolve` for each.
//
// All impacts are checked first. If one of them is invalid, no outcome is written, the status is that of the first
// invalid impact, and `first_bad` (may be null) receives its index.
//
// # Safety
// `model` is a loaded model; `impacts` and `outcomes` begin with their `struct_size`; every array that is not null has
// `count` entries; `first_bad` can be written or is null.
nw_status nw_resolve_batch(const struct nw_model *model,
                           const struct nw_impacts *impacts,
                           const struct nw_outcomes *outcomes,
                           size_t *first_bad);

// Initialises what cools and heats a wall: its size, an infinite `coolant_coefficient`, 0.026 W/(m
// K) at 293.15 K for the gas in the voids (air), the vapour of the model file, zeros. The temperatures of coolant
// and gas must be set.
//
// # Safety
// `cooling` can be written.
nw_status nw_wall_cooling_init(struct nw_wall_cooling *cooling);

// Initialises the temperatures of a wall for `nw_deposit_heat`: their size and zeros.
//
// # Safety
// `heat` can be written.
nw_status nw_wall_heat_init(struct nw_wall_heat *heat);

// Computes the temperatures of a wall under its deposit: steady, but for slag that melts or freezes
// and takes heat or gives it. `voidage` is the share of voids in
// fresh powder [1]. The surface temperature is the `T_w` of the next impact. `NW_NO_CONDUCTIVITY`
// if a layer's material has none.
//
// # Safety
// `model` is a loaded model; `deposit`, `cooling` and `heat` begin with their `struct_size`.
nw_status nw_deposit_heat(const struct nw_model *model,
                          const struct nw_deposit *deposit,
                          double voidage,
                          const struct nw_wall_cooling *cooling,
                          struct nw_wall_heat *heat);

// Computes the heat [J] that one particle of this impact gives to the wall while it touches it and rebounds; negative
// for a colder particle. 0 where the model file does not ask for it (`contact_heat` of a wall), for a droplet, and on
// melt. The particle's temperature falls by the heat over mass and heat capacity.
//
// # Safety
// `model` is a loaded model; `impact` begins with its `struct_size`; `heat` can be written.
nw_status nw_contact_heat(const struct nw_model *model,
                          const struct nw_impact *impact,
                          double *heat);

// Computes the heat [J/kg] that a captured particle of this impact brings to the surface that it lands on: sensible
// heat down to the temperature of that surface, and the heat of fusion where it was liquid and lands as a solid; less
// that heat where it was solid and lands as melt. What lies on a wall has the temperature of the wall, so that this is
// all that it brings. `heat_capacity` [J/(kg K)] is that of the particle, or 0 for that of the model's material;
// `NW_NO_HEAT_CAPACITY` if that has none. The sum over what lands in a step, over area and duration, is a
// `further_flux`.
//
// # Safety
// `model` is a loaded model; `impact` begins with its `struct_size`; `heat` can be written.
nw_status nw_heat_brought(const struct nw_model *model,
                          const struct nw_impact *impact,
                          double heat_capacity,
                          double *heat);

// Initialises a deposit: its size, wall 0, a bare wall.
//
// # Safety
// `deposit` can be written.
nw_status nw_deposit_init(struct nw_deposit *deposit);

// Sets a deposit to the initial deposit that the model file states for its `wall`. `voidage` is the share of voids in
// the powder [1].
//
// # Safety
// `model` is a loaded model; `deposit` begins with its `struct_size`.
nw_status nw_deposit_initial(const struct nw_model *model,
                             double voidage,
                             struct nw_deposit *deposit);

// Initialises a deposit source: its size and zeros.
//
// # Safety
// `source` can be written.
nw_status nw_deposit_source_init(struct nw_deposit_source *source);

// Adds a captured particle: its `mass` per wall area [kg/m2] and its `density` [kg/m3]. It counts
// as molten if the wall is hotter than its material is solid, as powder otherwise. The order of
// particles affects the sums only by rounding. Sources of several threads or ranks are summed
// field by field (`count` too) before one `nw_deposit_add`.
//
// # Safety
// `model` is a loaded model; `impact` and `source` begin with their `struct_size`.
nw_status nw_deposit_source_add(const struct nw_model *model,
                                const struct nw_impact *impact,
                                double mass,
                                double density,
                                struct nw_deposit_source *source);

// Adds the source of a step to a deposit. Powder that melt buries lies below the slag then; nothing
// melts or freezes here, and mass is conserved.
//
// # Safety
// `source` and `deposit` begin with their `struct_size`.
nw_status nw_deposit_add(const struct nw_deposit_source *source, struct nw_deposit *deposit);

// Sets the `layer_thickness` and `coverage` of the powder, and the `melt_thickness` of the slag, which
// is stiff or liquid by `T_w`, of an impact on a deposit. `voidage` is the share of voids in the powder [1]. The
// wall is that of the impact.
//
// # Safety
// `model` is a loaded model; `deposit` and `impact` begin with their `struct_size`.
nw_status nw_deposit_apply(const struct nw_model *model,
                           const struct nw_deposit *deposit,
                           double voidage,
                           struct nw_impact *impact);

// Computes the mean speed [m/s] at which the melt of a deposit runs down its wall as a laminar film. `T_w` is the wall
// temperature [K], `gravity_along` the component of gravity along the wall [m/s2], not negative. The speed is 0 if the
// model has no viscosity of the melt or the melt is colder than its measured range; a hotter melt is accepted.
//
// # Safety
// `model` is a loaded model; `deposit` begins with its `struct_size`; `velocity` can be written.
nw_status nw_film_velocity(const struct nw_model *model,
                           const struct nw_deposit *deposit,
                           double T_w,
                           double gravity_along,
                           double *velocity);

// As `nw_film_velocity`, for melt through which heat flows to a cooled wall: its surface has
// `T_surface` [K], and it is colder and stiffer below, by the `heat_flux` [W/m2] of
// `nw_deposit_heat` over the conductivity of the melt. `NW_NO_CONDUCTIVITY` if the melt has none.
//
// # Safety
// `model` is a loaded model; `deposit` begins with its `struct_size`; `velocity` can be written.
nw_status nw_cooled_film_velocity(const struct nw_model *model,
                                  const struct nw_deposit *deposit,
                                  double T_surface,
                                  double heat_flux,
                                  double gravity_along,
                                  double *velocity);

// Counts the inputs that the model file declares under `[inputs]`. Their values are the first entries of `extra`.
//
// # Safety
// `model` is a loaded model, `count` can be written.
nw_status nw_extra_input_count(const struct nw_model *model,
                               uint32_t *count);

// Returns the name of an input that the model file declares: at most `name_size` bytes with the closing zero, cut
// between characters. `index` is its place in `extra`.
//
// # Safety
// `model` is a loaded model, `name` has room for `name_size` bytes.
nw_status nw_extra_input_name(const struct nw_model *model,
                              uint32_t index,
                              char *name,
                              size_t name_size);

// Returns the value that an impact takes where its entry of `extra` is NaN; NaN if the model file states no default. A
// curve over an input without value changes nothing.
//
// # Safety
// `model` is a loaded model, `value` can be written.
nw_status nw_extra_input_default(const struct nw_model *model,
                                 uint32_t index,
                                 double *value);

// Returns a word of an input of words: at most `text_size` bytes with the closing zero, cut between characters. The
// input's value for it is `word`, from 0. The status is `NW_UNKNOWN_INPUT` beyond the last one, and for a number.
//
// # Safety
// `model` is a loaded model, `text` has room for `text_size` bytes.
nw_status nw_extra_input_word(const struct nw_model *model,
                              uint32_t index,
                              uint32_t word,
                              char *text,
                              size_t text_size);

// Converts a text to the value of an input that the model file declares: a number, or one of the input's words. On
// failure `message` (may be null) receives the reason with the known words, as in `nw_model_load`.
//
// # Safety
// `model` is a loaded model, `text` is zero-terminated, `value` can be written, `message` has room for `message_size`
// bytes or is null.
nw_status nw_extra_input_value(const struct nw_model *model,
                               uint32_t index,
                               const char *text,
                               double *value,
                               char *message,
                               size_t message_size);

// Initialises surroundings: their size and zeros, so that nothing is known but that the gas is calm.
//
// # Safety
// `surroundings` can be written.
nw_status nw_deposit_surroundings_init(struct nw_deposit_surroundings *surroundings);

// Initialises losses for `nw_deposit_advance`: their size and zeros.
//
// # Safety
// `losses` can be written.
nw_status nw_deposit_losses_init(struct nw_deposit_losses *losses);

// Advances a deposit by a time step of a `duration` [s]: slag and powder melt and freeze with the heat
// that comes and goes, powder sinters; the gas carries loose powder away (table `resuspension` of the
// wall in the model file); what the wall cannot hold falls off (table `shedding`); vapour condenses on
// a surface of a known temperature (table `condensation`). `losses`
// receives the mass that each process took and the heat that crossed the deposit. Add the particles captured in the
// step first, with `nw_deposit_add`. `cooling` is null, or as it was initialised, for a wall that is not cooled;
// its `gas_coefficient` must be finite, since a surface that is held at a temperature could give any heat.
//
// # Safety
// `model` is a loaded model; `surroundings`, `deposit` and `losses` begin with their `struct_size`, and
// so does `cooling` unless it is null.
nw_status nw_deposit_advance(const struct nw_model *model,
                             const struct nw_deposit_surroundings *surroundings,
                             const struct nw_wall_cooling *cooling,
                             double duration,
                             struct nw_deposit *deposit,
                             struct nw_deposit_losses *losses);

// Finds the processes that act on a wall of the model: bit `i` of `processes` is set where process
// `i` does. Melting and sintering act on every wall whose temperatures are known, the others where
// the model file has a table of their name.
//
// # Safety
// `model` is a loaded model, `processes` can be written.
nw_status nw_wall_processes(const struct nw_model *model, uint32_t wall, uint32_t *processes);

// Returns the name of a process, for instance `resuspension`, as a static string; processes act in
// the order of their index. Null from `NW_PROCESSES` on.
const char *nw_process_name(uint32_t process);

// Returns how tables name the mass that a process takes, for instance `resuspended`, as a static
// string: empty for a process that takes none, null from `NW_PROCESSES` on.
const char *nw_process_loss(uint32_t process);

// Returns how tables name the mass that a process brings, for instance `condensed`, as a static
// string: empty for a process that brings none, null from `NW_PROCESSES` on.
const char *nw_process_gain(uint32_t process);

// Initialises a walk: its size and zeros.
//
// # Safety
// `walk` can be written.
nw_status nw_walk_init(struct nw_walk *walk);

// Takes the walk on by the step that has brought the particle to its place, or starts it at step 0, and gives the
// fluctuating velocity of the gas there. The draws depend on seed, key and step alone. `NW_BAD_STATE` if an input is
// not finite, negative or missing.
//
// # Safety
// `walk` begins with its `struct_size`.
nw_status nw_walk_advance(struct nw_walk *walk);

// Computes the thermophoretic force on a sphere over the gradient of the gas's temperature [N m/K], negative: the
// force points to the cold. Of the gas: `temperature` [K], `density` [kg/m3], `viscosity` [Pa s], `conductivity`
// [W/(m K)], `mean_free_path` [m] (0 in a dense gas); of the particle: `diameter` [m], `particle_conductivity`
// [W/(m K)]. `NW_BAD_STATE` if one is not finite or not positive.
//
// # Safety
// `force` can be written.
nw_status nw_thermophoresis(double temperature,
                            double density,
                            double viscosity,
                            double conductivity,
                            double mean_free_path,
                            double diameter,
                            double particle_conductivity,
                            double *force);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* NEARWALL_H */

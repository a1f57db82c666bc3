/* nearwall.h - what happens when a particle hits a wall: the C interface of libnearwall.
 *
 * Inputs come first, outputs last. Every call returns a status, and its outputs are untouched unless that is NW_OK
 * (but for a message, and the index of the impact at fault).
 * A model never changes once it is loaded: any number of threads may share it without a lock. A call keeps no state,
 * so the same model and impact give the same bits. The caller's floating-point control and flags stay as they are
 * (x86-64), and it may trap what it likes. Should memory run out while a model is read, the process ends.
 *
 * Licence: MIT OR Apache-2.0. */

#ifndef NEARWALL_H
#define NEARWALL_H

/* Written by cbindgen from src/c_api; `NEARWALL_BLESS=1 cargo test --test c_api header` writes it again. */

#include <stddef.h>
#include <stdint.h>

// Number of the binary interface; it changes when a struct, a function or a constant does.
#define NW_ABI_VERSION 1

// Bit of `flags`: a property or a fitted term was used outside the range it is stated for.
#define NW_OUTSIDE_VALID_RANGE 1

// A loaded model: opaque, immutable, shareable between threads.
typedef struct nw_model nw_model;

// What a call came to.
typedef int32_t nw_status;

// Which of particle and wall is sticky.
typedef uint32_t nw_regime;

// One particle as it reaches a wall. Fill it with `nw_impact_init`, then set what you know.
typedef struct nw_impact {
  // `sizeof(nw_impact)`.
  uint32_t struct_size;
  // Index of the wall, from `nw_model_find_wall`.
  uint32_t wall;
  // Speed towards the wall [m/s], not negative.
  double v_n;
  // Speed along the wall [m/s], not negative.
  double v_t;
  // Particle diameter [m], positive.
  double d;
  // Particle temperature [K], positive.
  double T_p;
  // Wall temperature [K], positive.
  double T_w;
  // Carbon conversion 0 to 1; 1 where there is no carbon.
  double conversion;
  // Thickness of powder on the wall [m].
  double layer_thickness;
  // Thickness of the liquid film on the wall [m].
  double film_thickness;
  // Speed of the gas along the wall [m/s].
  double v_gas;
  // Roughness of the wall [m].
  double roughness;
  // Spin [rad/s], positive when rolling forward along `v_t`.
  double omega;
  // Share of the wall covered by non-sticky char, 0 to 1.
  double coverage;
  // Seed of the run's random draws.
  uint64_t seed;
  // What tells this impact from all others: the draws depend on `seed` and `key` only.
  uint64_t key;
  // Thickness of the melt that earlier particles left on the wall [m].
  double melt_thickness;
} nw_impact;

// What leaves the wall.
typedef struct nw_outcome {
  // `sizeof(nw_outcome)`.
  uint32_t struct_size;
  // Which of particle and wall is sticky.
  nw_regime regime;
  // 1 when this particle is captured (drawn from `p_stick`), 0 when it rebounds.
  uint32_t stuck;
  // Bits: `NW_OUTSIDE_VALID_RANGE`.
  uint32_t flags;
  // Normal restitution of a particle that rebounds.
  double e_n;
  // Tangential restitution of a particle that rebounds.
  double e_t;
  // Probability of capture.
  double p_stick;
  // Spin after a rebound [rad/s].
  double omega;
} nw_outcome;

// Arrays of impacts, each with `count` entries. Only `v_n` is required; a null array stands for the value that
// `nw_impact_init` gives, and for `key` the entry's own index.
typedef struct nw_impacts {
  // `sizeof(nw_impacts)`.
  uint32_t struct_size;
  // Wall of every impact where `walls` is null.
  uint32_t wall;
  // Number of impacts.
  size_t count;
  // Seed of all draws.
  uint64_t seed;
  // Index of each impact's wall.
  const uint32_t *walls;
  // Speed towards the wall [m/s].
  const double *v_n;
  // Speed along the wall [m/s].
  const double *v_t;
  // Particle diameter [m].
  const double *d;
  // Particle temperature [K].
  const double *T_p;
  // Wall temperature [K].
  const double *T_w;
  // Carbon conversion.
  const double *conversion;
  // Thickness of powder on the wall [m].
  const double *layer_thickness;
  // Thickness of the liquid film [m].
  const double *film_thickness;
  // Speed of the gas along the wall [m/s].
  const double *v_gas;
  // Roughness of the wall [m].
  const double *roughness;
  // Spin [rad/s].
  const double *omega;
  // Share of the wall covered by non-sticky char.
  const double *coverage;
  // Key of each impact's draws.
  const uint64_t *key;
  // Thickness of the melt that earlier particles left on the wall [m].
  const double *melt_thickness;
} nw_impacts;

// Arrays for the outcomes, each with room for as many entries as there are impacts; null where not wanted. They must
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

// What lies on a piece of wall, per area of it. A bare wall is what `nw_deposit_init` gives.
typedef struct nw_deposit {
  // `sizeof(nw_deposit)`.
  uint32_t struct_size;
  // Index of the wall, from `nw_model_find_wall`.
  uint32_t wall;
  // Molten mass [kg/m2].
  double molten;
  // Mass of powder [kg/m2].
  double powder;
  // Volume of the powder's particles without the voids between them [m3/m2].
  double solid;
  // Projected area of the powder's particles [1], overlaps counted.
  double cover;
  // Carbon conversion of all that lies there, its mean by mass.
  double conversion;
} nw_deposit;

// What arrived on a piece of wall in a step and stayed, summed, per area of it. Nothing is what `nw_deposit_source_init` gives.
typedef struct nw_deposit_source {
  // `sizeof(nw_deposit_source)`.
  uint32_t struct_size;
  // How many were added.
  uint32_t count;
  // Molten mass [kg/m2].
  double molten;
  // Mass of powder [kg/m2].
  double powder;
  // Volume of the powder's particles [m3/m2].
  double solid;
  // Projected area of the powder's particles [1].
  double cover;
  // Projected area of the molten particles [1].
  double buried;
  // Mass times carbon conversion [kg/m2].
  double converted;
} nw_deposit_source;

// Done.
#define NW_OK 0

// A required pointer is null.
#define NW_NULL_POINTER 1

// `struct_size` (or a count) is not one that this library knows.
#define NW_STRUCT_SIZE 2

// A text is not UTF-8.
#define NW_NOT_UTF8 3

// The model file cannot be read.
#define NW_FILE 4

// The model is at fault; the message names file, line, column, key and remedy.
#define NW_MODEL 5

// The model has no such wall.
#define NW_UNKNOWN_WALL 6

// A number has no physical meaning: it is not finite or out of its bounds.
#define NW_BAD_STATE 7

// A property is not known at the temperature of the impact.
#define NW_OUT_OF_RANGE 8

// An internal fault was stopped at the boundary.
#define NW_PANIC 9

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

// The interface version of the library that is loaded; compare with `NW_ABI_VERSION` of the header.
uint32_t nw_abi_version(void);

// The version of the library, for instance `0.1.0`. Static text.
const char *nw_version(void);

// A status in words. Static text, also for numbers that are no status.
const char *nw_status_text(nw_status status);

// A regime by name, for instance `NSP-SW`. Static text.
const char *nw_regime_name(nw_regime regime);

// Reads a model file. On success `*model` is the model; free it with `nw_model_free`.
//
// On failure the reason, with file, line, column, key and remedy, goes to `message` (at most `message_size` bytes with
// the closing zero, cut at a character; may be null). On success `message` is left as it is.
//
// # Safety
// `path` is a zero-terminated text, `model` can be written, `message` has room for `message_size` bytes or is null.
nw_status nw_model_load(const char *path,
                        struct nw_model **model,
                        char *message,
                        size_t message_size);

// Reads a model from TOML text of `toml_size` bytes (no closing zero needed). `name` stands for the file in messages;
// it may be null. Otherwise as `nw_model_load`.
//
// # Safety
// `toml` has `toml_size` bytes, `name` is zero-terminated or null, the rest as in `nw_model_load`.
nw_status nw_model_parse(const char *toml,
                         size_t toml_size,
                         const char *name,
                         struct nw_model **model,
                         char *message,
                         size_t message_size);

// Frees a model; null is allowed.
//
// # Safety
// `model` came from `nw_model_load` or `nw_model_parse` and is not used again.
void nw_model_free(struct nw_model *model);

// The index of the wall that a patch name belongs to: the wall of that name, else the last whose name is a regular
// expression that fits. `NW_UNKNOWN_WALL` when there is none; the wall called `default` is not implied.
//
// # Safety
// `model` is a loaded model, `name` is zero-terminated, `wall` can be written.
nw_status nw_model_find_wall(const struct nw_model *model,
                             const char *name,
                             uint32_t *wall);

// Fills an impact with its size and the values assumed for unknown inputs: wall 0, 1e-4 m, 293.15 K, conversion 1, all
// else 0.
//
// # Safety
// `impact` can be written.
nw_status nw_impact_init(struct nw_impact *impact);

// Fills an outcome with its size and zeros, ready for `nw_resolve`.
//
// # Safety
// `outcome` can be written.
nw_status nw_outcome_init(struct nw_outcome *outcome);

// Decides one impact. The same model and impact give the same bits, on any thread and in any order.
//
// # Safety
// `model` is a loaded model; `impact` and `outcome` begin with their `struct_size`.
nw_status nw_resolve(const struct nw_model *model,
                     const struct nw_impact *impact,
                     struct nw_outcome *outcome);

// Adhesive, yield and sticking velocity [m/s] of an impact's particle and wall: size and temperatures count,
// and what effects on the contact look at; chance is at its median. Outputs may be null.
//
// # Safety
// `model` is a loaded model, `impact` begins with its `struct_size`, each output can be written or is null.
nw_status nw_speeds(const struct nw_model *model,
                    const struct nw_impact *impact,
                    double *adhesive,
                    double *yielding,
                    double *sticking);

// Temperatures [K] between which impacts on a wall can be decided, from the tables of all properties: lowest and
// highest of the particle and of the wall, 0 and infinity where nothing limits them. Outputs may be null.
//
// # Safety
// `model` is a loaded model, each output can be written or is null.
nw_status nw_temperature_ranges(const struct nw_model *model,
                                uint32_t wall,
                                double *particle_low,
                                double *particle_high,
                                double *wall_low,
                                double *wall_high);

// Decides many impacts: the same bits as `nw_resolve` one by one.
//
// All impacts are checked first. If one cannot be resolved nothing is written to the outcomes, the status is that of
// the first such impact, and its index goes to `first_bad` (may be null).
//
// # Safety
// `model` is a loaded model; `impacts` and `outcomes` begin with their `struct_size`; every array that is not null has
// `count` entries; `first_bad` can be written or is null.
nw_status nw_resolve_batch(const struct nw_model *model,
                           const struct nw_impacts *impacts,
                           const struct nw_outcomes *outcomes,
                           size_t *first_bad);

// Fills a deposit with its size and a bare wall: wall 0, all else 0.
//
// # Safety
// `deposit` can be written.
nw_status nw_deposit_init(struct nw_deposit *deposit);

// Sets a deposit to what the model file says lies on its `wall`, with a share `voidage` of voids in the powder: where a
// memory begins.
//
// # Safety
// `model` is a loaded model; `deposit` begins with its `struct_size`.
nw_status nw_deposit_initial(const struct nw_model *model,
                           double voidage,
                           struct nw_deposit *deposit);

// Fills arrivals with their size and zeros.
//
// # Safety
// `arrivals` can be written.
nw_status nw_deposit_source_init(struct nw_deposit_source *arrivals);

// Adds a particle that stayed: `mass` of it per area of wall [kg/m2], with the particle's `density` [kg/m3]. It counts as
// molten when it is sticky at the temperature of the wall, as powder otherwise. The order changes sums by rounding alone; arrivals of
// several threads or ranks are added field by field (`count` too) before one `nw_deposit_add`.
//
// # Safety
// `model` is a loaded model; `impact` and `arrivals` begin with their `struct_size`.
nw_status nw_deposit_source_add(const struct nw_model *model,
                          const struct nw_impact *impact,
                          double mass,
                          double density,
                          struct nw_deposit_source *arrivals);

// Adds the arrivals of a step to a deposit. Powder that melt buries becomes part of the melt; mass is kept.
//
// # Safety
// `arrivals` and `deposit` begin with their `struct_size`.
nw_status nw_deposit_add(const struct nw_deposit_source *arrivals, struct nw_deposit *deposit);

// Tells an impact of the deposit that it meets: sets its `layer_thickness` (powder with a share `voidage` of voids),
// `coverage` and `melt_thickness`. The wall is that of the impact.
//
// # Safety
// `model` is a loaded model; `deposit` and `impact` begin with their `struct_size`.
nw_status nw_deposit_apply(const struct nw_model *model,
                           const struct nw_deposit *deposit,
                           double voidage,
                           struct nw_impact *impact);

// Mean speed [m/s] of the melt of a deposit that runs down its wall as a laminar film: at a temperature of the wall `T_w`
// [K], with `gravity_along` the part of gravity along the wall [m/s2]. 0 where the model knows no viscosity of the melt, or
// it is colder than a measured one. `gravity_along` is not negative; a melt hotter than its measured range is answered.
//
// # Safety
// `model` is a loaded model; `deposit` begins with its `struct_size`; `velocity` can be written.
nw_status nw_film_velocity(const struct nw_model *model,
                           const struct nw_deposit *deposit,
                           double T_w,
                           double gravity_along,
                           double *velocity);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* NEARWALL_H */

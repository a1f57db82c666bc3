/* A wall that asks nearwall what becomes of each particle.
 *
 * NEARWALL_WALL=nearwall (default)  the model file nearWall.toml decides
 * NEARWALL_WALL=fouling             code_saturne's own fouling model decides (for comparison)
 *
 * Every impact is written to impacts.<rank>.csv, in the columns of `nearwall predict`. */
#include "cs_defs.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bft_error.h"
#include "bft_printf.h"
#include "cs_boundary_zone.h"
#include "cs_lagr.h"
#include "cs_lagr_event.h"
#include "cs_lagr_prototypes.h"
#include "cs_math.h"
#include "cs_mesh_quantities.h"
#include "cs_physical_constants.h"
#include "cs_time_step.h"

#include <nearwall.h>

#include "nearwall_case.h"

BEGIN_C_DECLS

#define INJECTED_PER_STEP 100
#define STEPS_OF_INJECTION 40

long long nearwall_hits = 0;
long long nearwall_captures = 0;

static nw_model *model = NULL;
static FILE *record = NULL;

/* Temperature of the walls [K]. */
static const double wall_temperature = 800.0;

static void load_model(void) {
    char message[1024] = "", name[32];

    if (nw_abi_version() != NW_ABI_VERSION)
        bft_error(__FILE__, __LINE__, 0, "libnearwall %s does not match its header", nw_version());
    if (nw_model_load("nearWall.toml", &model, message, sizeof message) != NW_OK)
        bft_error(__FILE__, __LINE__, 0, "%s", message);
    snprintf(name, sizeof name, "impacts.%d.csv", cs_glob_rank_id > 0 ? cs_glob_rank_id : 0);
    record = fopen(name, "w");
    if (record == NULL) bft_error(__FILE__, __LINE__, 0, "cannot write %s", name);
    fprintf(record, "v_n,v_t,d,T_p,rho_p,T_w,e_n_found,e_t_found,p_found,stuck,number,hit,time,x,y,z,mass\n");
}

void cs_user_lagr_boundary_conditions(const int bc_type[]) {
    cs_lagr_zone_data_t *zones = cs_lagr_get_boundary_conditions();
    cs_lagr_injection_set_t *injected;
    const char *wall = getenv("NEARWALL_WALL");
    const int own = wall != NULL && strcmp(wall, "fouling") == 0;
    const int injector = cs_boundary_zone_by_name("injector")->id;

    CS_UNUSED(bc_type);
    if (!own && model == NULL) load_model();

    zones->zone_type[injector] = CS_LAGR_INLET;
    zones->zone_type[cs_boundary_zone_by_name("inlet")->id] = CS_LAGR_INLET;
    zones->zone_type[cs_boundary_zone_by_name("outlet")->id] = CS_LAGR_OUTLET;
    zones->zone_type[cs_boundary_zone_by_name("sides")->id] = CS_LAGR_SYM;
    zones->zone_type[cs_boundary_zone_by_name("walls")->id] = own ? CS_LAGR_FOULING : CS_LAGR_BC_USER;

    injected = cs_lagr_get_injection_set(zones, injector, 0);
    injected->n_inject = cs_glob_time_step->nt_cur <= STEPS_OF_INJECTION ? INJECTED_PER_STEP : 0;
    injected->injection_frequency = 1;
    injected->velocity_profile = 1;     /* cs_user_lagr_in sets velocity, diameter and temperature */
    injected->velocity[0] = 1.0;
    injected->diameter = 1e-4;
    injected->temperature_profile = 1;
    injected->temperature = 1500.0;     /* K */
    injected->stat_weight = 1000.0;     /* particles in a parcel */
    injected->coal_number = 1;
    injected->density = 2300.0;
    injected->cp = 1200.0;
}

void cs_lagr_user_boundary_interaction(cs_lagr_particle_set_t *particles,
                                       cs_lnum_t p_id,
                                       cs_lnum_t face_id,
                                       const cs_real_t face_norm[3],
                                       const cs_real_t c_intersect[3],
                                       cs_real_t t_intersect,
                                       int b_zone_id,
                                       int *event_flag,
                                       cs_lagr_tracking_state_t *tracking_state) {
    const cs_lagr_attribute_map_t *map = particles->p_am;
    unsigned char *particle = particles->p_buffer + map->extents*p_id;
    cs_real_t *position = cs_lagr_particle_attr(particle, map, CS_LAGR_COORDS);
    cs_real_t *velocity = cs_lagr_particle_attr(particle, map, CS_LAGR_VELOCITY);
    cs_real_t *seen = cs_lagr_particle_attr(particle, map, CS_LAGR_VELOCITY_SEEN);
    const cs_real_t *temperature = cs_lagr_particle_attr_const(particle, map, CS_LAGR_TEMPERATURE);
    const cs_real_t diameter = cs_lagr_particle_get_real(particle, map, CS_LAGR_DIAMETER);
    const cs_real_t mass = cs_lagr_particle_get_real(particle, map, CS_LAGR_MASS);
    const cs_real_t weight = cs_lagr_particle_get_real(particle, map, CS_LAGR_STAT_WEIGHT);
    cs_real_t *user = cs_lagr_particle_attr(particle, map, CS_LAGR_USER);
    const cs_real_t number = user[PARTICLE_NUMBER], hit = user[PARTICLE_HITS];
    const cs_lnum_t cell = cs_lagr_particle_get_lnum(particle, map, CS_LAGR_CELL_ID);
    const double identity[2] = {number, hit};
    nw_impact impact;
    nw_outcome outcome;
    nw_status status;
    double normal[3], towards, along[3], rest[3], rest_towards;

    CS_UNUSED(b_zone_id);
    CS_UNUSED(face_id);

    /* The normal out of the gas, into the wall. face_norm points into the gas in 6.0.2, and its documentation does not say so:
     * the way across the face decides. */
    {
        double way = 0;
        for (int k = 0; k < 3; ++k) way += (position[k] - c_intersect[k])*face_norm[k];
        for (int k = 0; k < 3; ++k) normal[k] = way < 0 ? -face_norm[k] : face_norm[k];
    }
    /* A particle that drag has turned within the step may move away from the wall by the end of it. */
    towards = cs_math_3_dot_product(velocity, normal);
    for (int k = 0; k < 3; ++k) along[k] = velocity[k] - towards*normal[k];
    if (towards < 0) towards = 0;

    nw_impact_init(&impact);
    nw_outcome_init(&outcome);
    impact.v_n = towards;
    impact.v_t = cs_math_3_norm(along);
    impact.d = diameter;
    impact.T_p = temperature[map->count[0][CS_LAGR_TEMPERATURE] - 1];  /* the outermost layer [K] */
    impact.T_w = wall_temperature;
    impact.rho_p = mass/(cs_math_pi/6*diameter*diameter*diameter);
    impact.seed = 1;
    status = nw_key_of_values(identity, 2, &impact.key);
    nw_model_find_wall(model, "default", &impact.wall);
    if (status == NW_OK) status = nw_resolve(model, &impact, &outcome);
    if (status != NW_OK) {
        char message[512] = "";
        nw_explain(model, &impact, message, sizeof message);
        bft_error(__FILE__, __LINE__, 0, "%s: %s", nw_status_text(status), message);
    }
    if (nearwall_hits == 0) {
        char unlikely[256] = "";
        if (nw_unlikely(&impact, unlikely, sizeof unlikely) == NW_OK && unlikely[0])
            bft_printf("nearwall: first impact: %s\n", unlikely);
    }
    nearwall_hits += 1;
    user[PARTICLE_HITS] += 1;
    fprintf(record, "%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%u,%.17g,%.0f,%.17g,%.17g,%.17g,%.17g,%.17g\n",
            impact.v_n, impact.v_t, impact.d, impact.T_p, impact.rho_p, impact.T_w, outcome.e_n, outcome.e_t, outcome.p_stick,
            outcome.stuck, number, hit, cs_glob_time_step->t_cur, c_intersect[0], c_intersect[1], c_intersect[2], mass*weight);

    if (outcome.stuck) {
        nearwall_captures += 1;
        particles->n_part_dep += 1;
        particles->weight_dep += weight;
        cs_lagr_particles_set_flag(particles, p_id, CS_LAGR_PART_DEPOSITED);
        for (int k = 0; k < 3; ++k) {
            position[k] = c_intersect[k];
            velocity[k] = 0;
        }
        *event_flag |= CS_EVENT_OUTFLOW | CS_EVENT_DEPOSITION;
        *tracking_state = CS_LAGR_PART_OUT;
        return;
    }

    /* The rest of the step is flown with the new velocity, from the point of impact. The tracking begins its next segment at a
     * private attribute, the first three numbers of a particle; the test makes sure that they still are. */
    {
        cs_real_t *start = (cs_real_t *)particle;
        const cs_real_t *centre = cs_glob_mesh_quantities->cell_cen + 3*cell;

        for (int k = 0; k < 3; ++k) {
            const double expected = start[k] + t_intersect*(position[k] - start[k]);
            if (!(fabs(expected - c_intersect[k]) <= 1e-9*(1 + fabs(c_intersect[k]))))
                bft_error(__FILE__, __LINE__, 0, "this version of code_saturne keeps the start of a segment elsewhere");
            start[k] = c_intersect[k] + 1e-2*(centre[k] - c_intersect[k]);  /* as for its own rebounds */
        }
    }
    for (int k = 0; k < 3; ++k) rest[k] = position[k] - c_intersect[k];
    rest_towards = cs_math_3_dot_product(rest, normal);
    for (int k = 0; k < 3; ++k) {
        const double rest_along = rest[k] - rest_towards*normal[k];
        position[k] = c_intersect[k] + outcome.e_t*rest_along - outcome.e_n*rest_towards*normal[k];
        velocity[k] = outcome.e_t*along[k] - outcome.e_n*towards*normal[k];
    }
    /* The gas that the particle sees loses nothing in the impact: it is reflected as code_saturne does, whatever e_n is. */
    {
        const double seen_towards = cs_math_3_dot_product(seen, normal);
        for (int k = 0; k < 3; ++k) seen[k] -= 2*seen_towards*normal[k];
    }
    *event_flag |= CS_EVENT_REBOUND;
    *tracking_state = CS_LAGR_PART_TO_SYNC;
}

END_C_DECLS

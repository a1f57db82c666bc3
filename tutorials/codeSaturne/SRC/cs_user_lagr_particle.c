/* Release of the particles, and the totals at the end. */
#include "cs_defs.h"

#include <math.h>
#include <stdio.h>

#include "bft_error.h"
#include "cs_boundary_zone.h"
#include "cs_lagr.h"
#include "cs_lagr_prototypes.h"
#include "cs_lagr_sde.h"
#include "cs_math.h"
#include "cs_mesh.h"
#include "cs_mesh_quantities.h"
#include "cs_parall.h"
#include "cs_time_step.h"

#include <nearwall.h>

#include "nearwall_case.h"

BEGIN_C_DECLS

/* A number from low to high that depends on the count of released particles alone: an additive sequence that fills the
 * interval evenly. code_saturne's own random numbers depend on the rank. */
static double spread(double count, int dimension, double low, double high) {
    static const double ratio = 1.1673039782614187; /* root of x^6 = x + 1 */
    const double turns = 0.5 + count*pow(ratio, -(dimension + 1.0));
    return low + (high - low)*(turns - floor(turns));
}

void cs_user_lagr_in(cs_lagr_particle_set_t *particles,
                     const cs_lagr_injection_set_t *zis,
                     const cs_lnum_t particle_range[2],
                     const cs_lnum_t particle_face_id[],
                     const cs_real_t visc_length[]) {
    const cs_real_t *face_centre;
    const double pi = cs_math_pi;

    CS_UNUSED(visc_length);
    for (cs_lnum_t p_id = particle_range[0]; p_id < particle_range[1]; ++p_id) {
        /* From 1: in the very middle of a face the tracking loses a particle. */
        const double count = 1 + (cs_glob_time_step->nt_cur - 1)*(double)zis->n_inject + (p_id - particle_range[0]);
        const double slope = spread(count, 0, -60, 60)*pi/180, speed = spread(count, 1, 3, 15);
        const double d = spread(count, 2, 20e-6, 120e-6);
        cs_real_t *velocity = cs_lagr_particles_attr(particles, p_id, CS_LAGR_VELOCITY);
        cs_real_t *position = cs_lagr_particles_attr(particles, p_id, CS_LAGR_COORDS);
        cs_real_t *temperature = cs_lagr_particles_attr(particles, p_id, CS_LAGR_TEMPERATURE);
        cs_real_t *coal = cs_lagr_particles_attr(particles, p_id, CS_LAGR_COAL_MASS);
        const double ash = cs_glob_lagr_coal_comb->xashch[0]*cs_glob_lagr_coal_comb->rho0ch[0]*pi/6*d*d*d;
        cs_real_t *user = cs_lagr_particles_attr(particles, p_id, CS_LAGR_USER);
        uint64_t key = 0;

        face_centre = cs_glob_mesh_quantities->b_face_cog + 3*particle_face_id[p_id - particle_range[0]];
        position[0] = face_centre[0];
        position[1] = face_centre[1] + spread(count, 3, -4e-3, 4e-3);
        position[2] = face_centre[2] + spread(count, 4, -2e-3, 2e-3);
        velocity[0] = speed*cos(slope);
        velocity[1] = 0;
        velocity[2] = speed*sin(slope);
        cs_lagr_particles_set_real(particles, p_id, CS_LAGR_DIAMETER, d);
        cs_lagr_particles_set_real(particles, p_id, CS_LAGR_INITIAL_DIAMETER, d);
        cs_lagr_particles_set_real(particles, p_id, CS_LAGR_SHRINKING_DIAMETER, d);
        cs_lagr_particles_set_real(particles, p_id, CS_LAGR_MASS, ash);
        cs_lagr_particles_set_real(particles, p_id, CS_LAGR_WATER_MASS, 0);
        cs_lagr_particles_set_real(particles, p_id, CS_LAGR_RESIDENCE_TIME, 0);  /* a random part of the step before */
        for (int layer = 0; layer < cs_glob_lagr_model->n_temperature_layers; ++layer) {
            temperature[layer] = spread(count, 5, 1100, 1700);
            coal[layer] = 0;
        }

        /* A number from what tells the particle from all others, on any rank: when and where it was released, and its diameter.
         * The upper 53 bits of the key fit into a user variable. */
        {
            const double release[5] = {cs_glob_time_step->t_cur, position[0], position[1], position[2], d};
            if (nw_key_of_values(release, 5, &key) != NW_OK)
                bft_error(__FILE__, __LINE__, 0, "a particle was released with a number that is not finite");
        }
        user[PARTICLE_NUMBER] = (double)(key >> 11);
        user[PARTICLE_HITS] = -1;  /* not yet in flight */
    }
}

/* Called before particles move. code_saturne moves a new particle from the random place on the injector that it had before
 * cs_user_lagr_in; this lets it start from where that function put it. */
void cs_user_lagr_ef(cs_real_t dt_p,
                     const cs_real_t taup[],
                     const cs_real_3_t tlag[],
                     const cs_real_3_t piil[],
                     const cs_real_33_t bx[],
                     const cs_real_t tsfext[],
                     const cs_real_33_t vagaus[],
                     const cs_real_3_t gradpr[],
                     const cs_real_33_t gradvf[],
                     cs_real_t rho_p[],
                     cs_real_3_t fextla[]) {
    cs_lagr_particle_set_t *particles = cs_lagr_get_particle_set();

    CS_UNUSED(dt_p); CS_UNUSED(taup); CS_UNUSED(tlag); CS_UNUSED(piil); CS_UNUSED(bx); CS_UNUSED(tsfext);
    CS_UNUSED(vagaus); CS_UNUSED(gradpr); CS_UNUSED(gradvf); CS_UNUSED(rho_p);
    for (cs_lnum_t p_id = 0; p_id < particles->n_particles; ++p_id) {
        for (int k = 0; k < 3; ++k) fextla[p_id][k] = 0;
        cs_real_t *user = cs_lagr_particles_attr(particles, p_id, CS_LAGR_USER);
        if (user[PARTICLE_HITS] < 0) {
            const cs_real_t *position = cs_lagr_particles_attr_const(particles, p_id, CS_LAGR_COORDS);
            cs_real_t *start = cs_lagr_particles_attr_n(particles, p_id, 1, CS_LAGR_COORDS);
            for (int k = 0; k < 3; ++k) start[k] = position[k];
            user[PARTICLE_HITS] = 0;
        }
    }
}

/* Sums, with code_saturne's own counters, and writes totals.csv at the last step. */
void cs_user_lagr_extra_operations(const cs_real_t dt[]) {
    enum { released, deposited, fouled, left, own_hits, hits, captures, airborne, lost,
           mass_released, mass_walls, mass_left, mass_airborne, count };
    static const char *const names[count] = {
        "released", "deposited", "fouled", "left", "own_hits", "hits", "captures", "airborne", "lost",
        "mass_released", "mass_walls", "mass_left", "mass_airborne"};
    static double sums[count];
    const cs_lagr_particle_set_t *particles = cs_lagr_get_particle_set();
    const double *flow = cs_lagr_get_boundary_conditions()->particle_flow_rate;
    const double weight = 1000.0;
    double totals[count];
    FILE *file;

    CS_UNUSED(dt);
    sums[released] += particles->n_part_new;
    sums[deposited] += particles->n_part_dep;
    sums[fouled] += particles->n_part_fou;
    sums[left] += particles->n_part_out;
    sums[lost] += particles->n_failed_part;
    for (cs_lnum_t face = 0; face < cs_glob_mesh->n_b_faces; ++face) {
        const int column = cs_glob_lagr_boundary_interactions->inbr;
        sums[own_hits] += bound_stat[column*cs_glob_mesh->n_b_faces + face]/weight;
    }
    for (int zone = 0; zone < cs_boundary_zone_n_zones(); ++zone) {
        const int walls = zone == cs_boundary_zone_by_name("walls")->id;
        if (flow[zone] > 0) sums[mass_released] += flow[zone];
        else sums[walls ? mass_walls : mass_left] -= flow[zone];
    }
    if (cs_glob_time_step->nt_cur < cs_glob_time_step->nt_max) return;

    for (int n = 0; n < count; ++n) totals[n] = sums[n];
    totals[hits] = (double)nearwall_hits;
    totals[captures] = (double)nearwall_captures;
    totals[airborne] = particles->n_particles;
    for (cs_lnum_t p_id = 0; p_id < particles->n_particles; ++p_id)
        totals[mass_airborne] += cs_lagr_particles_get_real(particles, p_id, CS_LAGR_STAT_WEIGHT)
            *cs_lagr_particles_get_real(particles, p_id, CS_LAGR_MASS);
    cs_parall_sum(count, CS_DOUBLE, totals);
    if (cs_glob_rank_id > 0) return;
    file = fopen("totals.csv", "w");
    if (file == NULL) bft_error(__FILE__, __LINE__, 0, "cannot write totals.csv");
    for (int n = 0; n < count; ++n) fprintf(file, "%s%s", n ? "," : "", names[n]);
    for (int n = 0; n < count; ++n) fprintf(file, "%s%.17g", n ? "," : "\n", totals[n]);
    fprintf(file, "\n");
    fclose(file);
}

END_C_DECLS

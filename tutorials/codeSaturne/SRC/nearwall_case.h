/* What the user functions share. */
#ifndef NEARWALL_CASE_H
#define NEARWALL_CASE_H

#include "cs_lagr_particle.h"

/* Places in the user attribute CS_LAGR_USER of a particle, which is one array. */
enum { PARTICLE_NUMBER, PARTICLE_HITS, USER_VARIABLES };

/* Impacts and captures that this rank has passed to nearwall. */
extern long long nearwall_hits;
extern long long nearwall_captures;

#endif

/* A wall for the particles of a commercial solver that hands over one particle at a time.
 *
 * It loads the model file that NEARWALL_MODEL names, else nearWall.toml in the case folder, once, with the function
 * library. Every face is the model's wall "default"; for other walls write a function each, or look up the thread's
 * name. Spin is not tracked. The path of a captured particle ends.
 *
 * Compiled and tested against stand_in.h, never against a vendor's header: with the solver include its own (udf.h)
 * and compare the names. The tests' driver is driver.c. */
#ifdef NEARWALL_VENDOR_HEADER
#include NEARWALL_VENDOR_HEADER
#else
#include "stand_in.h"
#endif

#include <nearwall.h>

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

static nw_model *model = NULL;

DEFINE_EXECUTE_ON_LOADING(nearwall_load, libname) {
    const char *path = getenv("NEARWALL_MODEL");
    char message[512] = "";
    (void)libname;
    if (nw_abi_version() != NW_ABI_VERSION) {
        fprintf(stderr, "libnearwall %s does not match the header of this function\n", nw_version());
    } else if (nw_model_load(path ? path : "nearWall.toml", &model, message, sizeof message) != NW_OK) {
        fprintf(stderr, "%s\n", message);
    }
}

DEFINE_DPM_BC(nearwall_wall, tp, t, f, f_normal, dim) {
    nw_impact impact;
    nw_outcome outcome;
    real towards = 0, along = 0;
    int i;

    nw_impact_init(&impact);
    nw_outcome_init(&outcome);

    /* The velocity towards the wall and what is left of it along the wall; the normal may point either way. */
    for (i = 0; i < dim; ++i) towards += TP_VEL(tp)[i] * f_normal[i];
    for (i = 0; i < dim; ++i) {
        const real part = TP_VEL(tp)[i] - towards * f_normal[i];
        along += part * part;
    }
    impact.v_n = fabs(towards);
    impact.v_t = sqrt(along);
    impact.d = TP_DIAM(tp);
    impact.T_p = TP_T(tp);
    impact.T_w = F_T(f, t);
    /* Unique for each impact and independent of the order of calls: the particle and the number of its hits. */
    impact.seed = 1;
    impact.key = ((uint64_t)TP_ID(tp) << 20) + (uint64_t)TP_USER_REAL(tp, 0);
    TP_USER_REAL(tp, 0) += 1;

    if (!model || nw_model_find_wall(model, "default", &impact.wall) != NW_OK
        || nw_resolve(model, &impact, &outcome) != NW_OK) {
        return PATH_ABORT; /* the solver counts it as aborted */
    }
    if (outcome.stuck) return PATH_END;

    for (i = 0; i < dim; ++i) {
        const real part = TP_VEL(tp)[i] - towards * f_normal[i];
        TP_VEL(tp)[i] = outcome.e_t * part - outcome.e_n * towards * f_normal[i];
        TP_VEL0(tp)[i] = TP_VEL(tp)[i];
    }
    return PATH_ACTIVE;
}

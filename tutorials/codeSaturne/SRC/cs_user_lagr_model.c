/* The particles: ash, as particles of code_saturne's coal model without coal, and code_saturne's own fouling.
 * REFERENCE_VISCOSITY [Pa s] replaces that of the fouling model, 100. */
#include "cs_defs.h"

#include <stdlib.h>

#include "cs_lagr.h"
#include "cs_lagr_prototypes.h"

#include "nearwall_case.h"

BEGIN_C_DECLS

void cs_user_lagr_model(void) {
    /* Composition of the ash: `fly-ash` of nearwall, scaled to 100 wt% of these five. */
    const double five = (49.2 + 28.4 + 11.1 + 2.1 + 0.8)/100;
    const double silica = 49.2/five, alumina = 28.4/five, iron = 11.1/five, lime = 2.1/five;
    const char *reference = getenv("REFERENCE_VISCOSITY");

    cs_glob_lagr_time_scheme->iilagr = CS_LAGR_ONEWAY_COUPLING;
    cs_glob_lagr_time_scheme->t_order = 1;
    cs_glob_lagr_time_scheme->idistu = 0;  /* no turbulent dispersion, whose random walk depends on ranks */

    cs_glob_lagr_model->physical_model = 2;  /* coal: its temperatures are in kelvin, those of model 1 in degrees Celsius */
    cs_glob_lagr_model->fouling = 1;
    cs_glob_lagr_encrustation->tprenc[0] = 600.0;   /* no fouling below, in degrees Celsius */
    cs_glob_lagr_encrustation->visref[0] = reference ? atof(reference) : 100.0;  /* Pa s */
    cs_glob_lagr_encrustation->enc1[0] = 0.00835*silica + 0.00601*alumina - 0.109;
    cs_glob_lagr_encrustation->enc2[0] = 0.0415*silica + 0.0192*alumina + 0.0276*iron + 0.016*lime - 3.92;

    /* What nearwall needs of each particle: a number for its keys, and the number of its hits. */
    cs_lagr_set_n_user_variables(USER_VARIABLES);
    /* Lets code_saturne count hits of its own walls. */
    cs_glob_lagr_boundary_interactions->has_part_impact_nbr = 1;
    cs_glob_lagr_log_frequency_n = 50;
}

END_C_DECLS

/* A duct of hot air whose flow is given and stays: particles move, the gas does not notice them. */
#include "cs_defs.h"

#include "cs_domain.h"
#include "cs_log.h"
#include "cs_mesh_location.h"
#include "cs_parameters.h"
#include "cs_physical_constants.h"
#include "cs_physical_model.h"
#include "cs_prototypes.h"
#include "cs_stokes_model.h"
#include "cs_thermal_model.h"
#include "cs_time_step.h"
#include "cs_turbulence_model.h"

BEGIN_C_DECLS

void cs_user_model(void) {
    /* The fouling model belongs to the Lagrangian model of coal, which needs the gas of the coal model. */
    cs_glob_physical_model_flag[CS_COMBUSTION_COAL] = 0;
    /* The coal model stops in a laminar gas (cs_coal_fp2st). Dispersion is off in cs_user_lagr_model. */
    cs_get_glob_turb_model()->iturb = CS_TURB_K_EPSILON;
    /* The radiation that coal particles meet. Without a radiation model the coal particles read a field that is not there. */
    cs_parameters_add_property("luminance", 1, CS_MESH_LOCATION_CELLS);
}

void cs_user_parameters(cs_domain_t *domain) {
    cs_fluid_properties_t *fluid = cs_get_glob_fluid_properties();

    domain->time_step->dt_ref = 5e-4;  /* s */
    domain->time_step->nt_max = 110;
    cs_glob_log_frequency = 50;
    cs_get_glob_stokes_model()->iccvfg = 1;  /* keeps the velocity of cs_user_initialization */
    fluid->t0 = 1600.0;   /* K */
    fluid->viscl0 = 5.8e-5;  /* Pa s */
    cs_get_glob_turb_ref_values()->uref = 5.0;
}

END_C_DECLS

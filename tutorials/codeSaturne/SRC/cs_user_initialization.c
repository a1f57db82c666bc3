/* The gas: 5 m/s along the duct everywhere, and some turbulence, which the particles do not see. */
#include "cs_defs.h"

#include "cs_domain.h"
#include "cs_field.h"
#include "cs_field_pointer.h"
#include "cs_mesh.h"
#include "cs_physical_constants.h"
#include "cs_prototypes.h"

BEGIN_C_DECLS

void cs_user_initialization(cs_domain_t *domain) {
    cs_real_3_t *velocity = (cs_real_3_t *)CS_F_(vel)->val;
    cs_real_t *irradiation = cs_field_by_name("luminance")->val;
    const double T = cs_glob_fluid_properties->t0;

    for (cs_lnum_t cell = 0; cell < domain->mesh->n_cells; ++cell) {
        velocity[cell][0] = 5.0;
        velocity[cell][1] = velocity[cell][2] = 0.0;
        irradiation[cell] = 4*5.670374e-8*T*T*T*T;  /* W/m2, of surroundings as hot as the gas */
        CS_F_(k)->val[cell] = 0.1;     /* m2/s2 */
        CS_F_(eps)->val[cell] = 1.0;   /* m2/s3 */
    }
}

END_C_DECLS

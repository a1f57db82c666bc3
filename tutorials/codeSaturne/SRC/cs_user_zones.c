/* Names of the boundary groups of duct.awk. */
#include "cs_defs.h"

#include "cs_boundary_zone.h"
#include "cs_prototypes.h"

BEGIN_C_DECLS

void cs_user_zones(void) {
    cs_boundary_zone_define("inlet", "1", 0);
    cs_boundary_zone_define("injector", "2", 0);
    cs_boundary_zone_define("outlet", "3", 0);
    cs_boundary_zone_define("walls", "4 or 5", 0);
    cs_boundary_zone_define("sides", "6", 0);
}

END_C_DECLS

/* A wall with a growing deposit, in C: the other languages have to print the same, bit for bit.
 * Takes a model and a table of impacts as the examples do; a step is four rows. Prints for each row whether the particle is
 * captured, the deposit at the impact (layer, coverage, melt) and after it (molten, powder, solid, cover, conversion), the
 * speed of the film, the void volume that sintering closed, the share of the powder that the gas carried away, and the wall of
 * the last step (temperatures of surface, wall and powder, heat flux, resistance of the deposit), and the mass that each process
 * took after the impact. At the end of a step all processes act for a second; a bare wall gets its initial deposit. After every
 * other impact the gas may carry powder away. */
#include <nearwall.h>

#include <stdio.h>
#include <stdlib.h>

static void must(nw_status status) {
    if (status == NW_OK) return;
    fprintf(stderr, "%s\n", nw_status_text(status));
    exit(1);
}

int main(int argc, char **argv) {
    char header[256];
    nw_model *model = NULL;
    nw_impact impact;
    nw_outcome outcome;
    nw_deposit deposit;
    nw_deposit_source source;
    nw_wall_cooling cooling;
    nw_wall_heat heat;
    nw_deposit_surroundings around;
    nw_deposit_losses losses;
    unsigned process;
    double velocity = 0;
    FILE *table;

    if (argc != 3) return 2;
    must(nw_model_load(argv[1], &model, NULL, 0));
    table = fopen(argv[2], "r");
    if (!table || !fgets(header, sizeof header, table)) return 2;
    must(nw_impact_init(&impact));
    must(nw_outcome_init(&outcome));
    must(nw_deposit_source_init(&source));
    must(nw_deposit_init(&deposit));
    must(nw_model_find_wall(model, "default", &deposit.wall));
    must(nw_deposit_initial(model, 0.4, &deposit));
    must(nw_wall_cooling_init(&cooling));
    cooling.coolant_temperature = 600;
    cooling.coolant_coefficient = 2000;
    cooling.wall_resistance = 1e-3;
    cooling.gas_coefficient = 300;
    cooling.emissivity = 0.8;
    cooling.irradiation = 4e5;
    must(nw_wall_heat_init(&heat));
    must(nw_deposit_losses_init(&losses));
    impact.wall = deposit.wall;
    impact.seed = 1;
    for (; fscanf(table, "%lf,%lf,%lf,%lf,%lf", &impact.v_n, &impact.v_t, &impact.d, &impact.T_p, &impact.T_w) == 5;
         impact.key += 1) {
        impact.conversion = impact.key % 2 ? 0.5 : 1.0;
        must(nw_deposit_apply(model, &deposit, 0.4, &impact));
        must(nw_resolve(model, &impact, &outcome));
        if (outcome.stuck) must(nw_deposit_source_add(model, &impact, (double)(1 + impact.key % 7) / 1024, 2300, &source));
        if (impact.key % 4 == 3) {
            must(nw_deposit_add(&source, &deposit));
            must(nw_deposit_source_init(&source));
            cooling.gas_temperature = impact.key % 64 == 63 ? 4000 : 1500;
            must(nw_deposit_heat(model, &deposit, 0.4, &cooling, &heat));
        }
        must(nw_deposit_surroundings_init(&around));
        around.voidage = 0.4;
        around.gas_density = 0.25;
        around.kinematic_viscosity = 2.5e-4;
        if (impact.key % 4 == 3) {
            around.gravity_along = 9.81;
            around.shear_down = 0.5;
            around.shear_across = 0.25;
            around.draw = 0.5;
        } else {
            const double friction_velocity = 0.25 * (double)(1 + impact.key % 5);
            around.shear_down = 0.25 * friction_velocity * friction_velocity;
        }
        must(nw_deposit_advance(model, &around, impact.key % 4 == 3 ? &cooling : NULL, 1, &deposit, &losses));
        if (impact.key % 4 == 3 && deposit.molten + deposit.frozen + deposit.powder <= 0) must(nw_deposit_initial(model, 0.4, &deposit));
        must(nw_film_velocity(model, &deposit, impact.T_w, 9.81, &velocity));
        printf("%u %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g", (unsigned)outcome.stuck, impact.layer_thickness,
               impact.coverage, impact.melt_thickness, deposit.molten, deposit.powder, deposit.solid, deposit.cover,
               deposit.conversion, velocity);
        printf(" %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g", deposit.frozen, deposit.behind, deposit.closed,
               deposit.resuspended, heat.surface_temperature, heat.wall_temperature, heat.heat_flux, heat.coolant_flux,
               heat.deposit_resistance);
        for (process = 0; process < NW_PROCESSES; ++process) printf(" %.17g", losses.mass[process]);
        printf("\n");
    }
    fclose(table);
    nw_model_free(model);
    return 0;
}

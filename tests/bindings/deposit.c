/* A wall with a growing deposit, in C: the other languages have to print the same, bit for bit.
 * Takes a model and a table of impacts as the examples do; a step is four rows. Prints for each row whether the particle is
 * captured, the deposit at the impact (layer, coverage, melt) and after it (molten, powder, solid, cover, conversion), and
 * the speed of the film. */
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
        }
        must(nw_film_velocity(model, &deposit, impact.T_w, 9.81, &velocity));
        printf("%u %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g\n", (unsigned)outcome.stuck, impact.layer_thickness,
               impact.coverage, impact.melt_thickness, deposit.molten, deposit.powder, deposit.solid, deposit.cover,
               deposit.conversion, velocity);
    }
    fclose(table);
    nw_model_free(model);
    return 0;
}

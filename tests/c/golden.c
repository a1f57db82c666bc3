/* The golden table through the C interface: a model for each line, and the bits of what it says.
 *
 *     golden thornton_ning.csv
 *
 * Prints e_n, adhesive, yield and sticking velocity of each case as 16 hexadecimal digits. */
#include "nearwall.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { E1, NU1, E2, NU2, RHO, D, GAMMA, P_Y, V_N, COLUMNS };

static const char *const MODEL =
    "[particle]\nmaterial = \"p\"\n"
    "[walls.default]\nmaterial = \"w\"\n"
    "[normal]\nmodel = \"thornton-ning\"\nyield_ratio = 1\nwork_of_adhesion = %s\n"
    "[tangential]\nmodel = \"constant\"\ne_t = 1\n"
    "[materials.p]\ndensity = %s\nyoungs_modulus = %s\npoisson_ratio = %s\nyield_strength = %s\nsurface_energy = 0\n"
    "[materials.w]\ndensity = %s\nyoungs_modulus = %s\npoisson_ratio = %s\nyield_strength = %s\nsurface_energy = 0\n";

static void print_bits(double number) {
    uint64_t bits;
    memcpy(&bits, &number, sizeof bits);
    printf("%016" PRIx64 " ", bits);
}

static nw_status resolve(char *cells[COLUMNS], char *message, size_t message_size) {
    char toml[2048];
    nw_model *model = NULL;
    nw_impact impact;
    nw_outcome outcome;
    double speeds[3];
    nw_status status;

    const int length = snprintf(toml, sizeof toml, MODEL, cells[GAMMA], cells[RHO], cells[E1], cells[NU1], cells[P_Y],
                                cells[RHO], cells[E2], cells[NU2], cells[P_Y]);
    status = nw_model_parse(toml, (size_t)length, "golden.c", &model, message, message_size);
    if (status != NW_OK) return status;

    nw_impact_init(&impact);
    nw_outcome_init(&outcome);
    impact.v_n = strtod(cells[V_N], NULL);
    impact.d = strtod(cells[D], NULL);
    status = nw_model_find_wall(model, "default", &impact.wall);
    if (status == NW_OK) status = nw_resolve(model, &impact, &outcome);
    if (status == NW_OK) status = nw_speeds(model, &impact, &speeds[0], &speeds[1], &speeds[2]);
    nw_model_free(model);
    if (status != NW_OK) return status;

    print_bits(outcome.e_n);
    print_bits(speeds[0]);
    print_bits(speeds[1]);
    print_bits(speeds[2]);
    printf("\n");
    return NW_OK;
}

int main(int argc, char **argv) {
    char line[4096];
    char message[512] = "";
    FILE *table = argc == 2 ? fopen(argv[1], "r") : NULL;

    if (nw_abi_version() != NW_ABI_VERSION || !table || !fgets(line, sizeof line, table)) return 2;
    while (fgets(line, sizeof line, table)) {
        char *cells[COLUMNS];
        nw_status status;
        int column;
        for (column = 0; column < COLUMNS; ++column) cells[column] = strtok(column == 0 ? line : NULL, ",\n");
        status = resolve(cells, message, sizeof message);
        if (status != NW_OK) {
            fprintf(stderr, "%s: %s\n", nw_status_text(status), message);
            return 1;
        }
    }
    fclose(table);
    return 0;
}

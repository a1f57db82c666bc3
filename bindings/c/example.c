/* Resolves the impacts of a file, one at a time, in C99.
 *
 *     cc -std=c99 example.c $(pkg-config --cflags --libs nearwall) -o example
 *     ./example nearWall.toml impacts.csv
 *
 * The table has the columns v_n,v_t,d,T_p,T_w (SI units) and one header line; more pairs of model and table may follow.
 * Prints e_n, e_t, the capture probability and 1 (captured) or 0 for each impact. */
#include <nearwall.h>

#include <stdio.h>

static int decide(const char *model_file, const char *table_file) {
    char message[512] = "";
    char header[256];
    nw_model *model = NULL;
    nw_impact impact;
    nw_outcome outcome;
    nw_status status;
    FILE *table;

    if (nw_model_load(model_file, &model, message, sizeof message) != NW_OK) {
        fprintf(stderr, "%s\n", message);
        return 1;
    }
    table = fopen(table_file, "r");
    if (!table || !fgets(header, sizeof header, table)) {
        fprintf(stderr, "%s cannot be read\n", table_file);
        if (table) fclose(table);
        nw_model_free(model);
        return 1;
    }

    nw_impact_init(&impact);
    nw_outcome_init(&outcome);
    impact.seed = 1;
    status = nw_model_find_wall(model, "default", &impact.wall);
    while (status == NW_OK && fscanf(table, "%lf,%lf,%lf,%lf,%lf", &impact.v_n, &impact.v_t, &impact.d, &impact.T_p,
                                     &impact.T_w) == 5) {
        status = nw_resolve(model, &impact, &outcome);
        if (status == NW_OK) printf("%.17g %.17g %.17g %u\n", outcome.e_n, outcome.e_t, outcome.p_stick, (unsigned)outcome.stuck);
        impact.key += 1; /* unique: random draws depend only on seed and key */
    }
    if (status != NW_OK) fprintf(stderr, "impact %lu: %s\n", (unsigned long)impact.key, nw_status_text(status));

    fclose(table);
    nw_model_free(model);
    return status != NW_OK;
}

int main(int argc, char **argv) {
    int i;
    if (nw_abi_version() != NW_ABI_VERSION) {
        fprintf(stderr, "libnearwall %s does not match this header\n", nw_version());
        return 1;
    }
    for (i = 1; i + 1 < argc; i += 2) {
        if (decide(argv[i], argv[i + 1]) != 0) return 1;
    }
    return 0;
}

/* Callers that break their promises, so that tests/hard knows that each of its tools sees it.
 *
 *     broken leak|beyond|unset|freed|misaligned|undefined|race MODEL */
#include "nearwall.h"

#include <limits.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define COUNT 8

static nw_model *model;
static nw_impact impact;
static nw_outcome outcome;

static void *resolve(void *unused) {
    int i;
    for (i = 0; i < 1000; ++i) nw_resolve(model, &impact, &outcome);
    return unused;
}

static int batch(const double *speeds, size_t count) {
    nw_impacts impacts;
    nw_outcomes outcomes;
    memset(&impacts, 0, sizeof impacts);
    memset(&outcomes, 0, sizeof outcomes);
    impacts.struct_size = sizeof impacts;
    outcomes.struct_size = sizeof outcomes;
    impacts.count = count;
    impacts.v_n = speeds;
    return (int)nw_resolve_batch(model, &impacts, &outcomes, NULL);
}

int main(int argc, char **argv) {
    double *speeds = malloc(COUNT * sizeof *speeds);
    int i, wrong = argc;
    if (argc != 3 || !speeds) return 2;
    nw_impact_init(&impact);
    nw_outcome_init(&outcome);
    if (nw_model_load(argv[2], &model, NULL, 0) != NW_OK) return 2;
    for (i = 0; i < COUNT; ++i) speeds[i] = 1;
    if (!strcmp(argv[1], "leak")) {
        nw_model_load(argv[2], &model, NULL, 0);
    } else if (!strcmp(argv[1], "beyond")) {
        wrong += batch(speeds, COUNT + 1);
    } else if (!strcmp(argv[1], "unset")) {
        double *unset = malloc(COUNT * sizeof *unset);
        wrong += batch(unset, COUNT);
        free(unset);
    } else if (!strcmp(argv[1], "freed")) {
        double *volatile gone = speeds;
        free(speeds);
        wrong += (int)gone[3];
        speeds = NULL;
    } else if (!strcmp(argv[1], "misaligned")) {
        wrong += (int)nw_resolve((const nw_model *)((const char *)model + 1), &impact, &outcome);
    } else if (!strcmp(argv[1], "undefined")) {
        wrong += INT_MAX;
    } else if (!strcmp(argv[1], "race")) {
        pthread_t other;
        if (pthread_create(&other, NULL, resolve, NULL)) return 2;
        resolve(NULL);
        pthread_join(other, NULL);
    }
    printf("%d\n", wrong);
    free(speeds);
    nw_model_free(model);
    model = NULL;
    return 0;
}

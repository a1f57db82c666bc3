/* A caller with any floating-point state: nothing it traps is raised, its state is as before after every call, and the
 * answers have the bits they have under the default state.
 *
 *     floating_point_state FOLDER
 *
 * FOLDER has models 0.toml, 1.toml, ... and for each the raw nw_impact structs in 0.bin, 1.bin, ... */
#define _GNU_SOURCE
#include "nearwall.h"

#include <fenv.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <xmmintrin.h>

#define MAX_IMPACTS 20000

/* What the two floating-point units hold. */
typedef struct {
    unsigned mxcsr, x87_control, x87_status, x87_tags;
} fp_state;

static fp_state current(void) {
    struct { unsigned words[7]; } x87;
    fp_state state;
    /* The first instruction masks all traps, the second brings them back. */
    __asm__ volatile("fnstenv %0\n\tfldenv %0" : "=m"(x87));
    state.mxcsr = _mm_getcsr();
    state.x87_control = x87.words[0] & 0xFFFFu;
    state.x87_status = x87.words[1] & 0xFFFFu;
    state.x87_tags = x87.words[2] & 0xFFFFu;
    return state;
}

enum { TRAP_NOTHING, TRAP_AS_OPENFOAM, TRAP_EVERYTHING, TRAPS };
static const int ROUNDINGS[4] = {FE_TONEAREST, FE_DOWNWARD, FE_UPWARD, FE_TOWARDZERO};

static void enter(int rounding, int traps, int raised, int flush) {
    fesetenv(FE_DFL_ENV);
    /* A raised flag that is trapped as well kills at the next x87 instruction; SSE minds only new ones. */
    if (raised && traps == TRAP_NOTHING) feraiseexcept(FE_ALL_EXCEPT);
    fesetround(rounding);
    if (traps == TRAP_AS_OPENFOAM) feenableexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW);
    if (traps == TRAP_EVERYTHING) feenableexcept(FE_ALL_EXCEPT);
    _mm_setcsr(_mm_getcsr() | (raised ? 0x3Fu : 0u) | (flush ? 0x8040u : 0u));
}

static long calls;

static void die(const char *what, long index) {
    fesetenv(FE_DFL_ENV);
    fprintf(stderr, "%s (%ld)\n", what, index);
    exit(1);
}

/* Counts a call and checks that the state is the one it was made in. */
static void unchanged(const fp_state *before, const char *call, long index) {
    const fp_state after = current();
    ++calls;
    if (memcmp(before, &after, sizeof after) != 0) {
        fesetenv(FE_DFL_ENV);
        fprintf(stderr, "%s %ld: mxcsr %x -> %x, x87 control %x -> %x, status %x -> %x, tags %x -> %x\n", call, index,
                before->mxcsr, after.mxcsr, before->x87_control, after.x87_control, before->x87_status,
                after.x87_status, before->x87_tags, after.x87_tags);
        exit(1);
    }
}

static nw_impact impacts[MAX_IMPACTS];
static double v_n[MAX_IMPACTS];

/* All that the library says about one model. */
typedef struct {
    nw_status status[MAX_IMPACTS];
    nw_outcome outcome[MAX_IMPACTS];
    double speeds[MAX_IMPACTS][3];
    double batch_e_n[MAX_IMPACTS];
    nw_status batch_status;
    char message[256];
} answers;

static void ask(const char *path, const char *toml, size_t size, size_t count, answers *said) {
    const fp_state before = current();
    nw_impacts batch;
    nw_outcomes columns;
    nw_model *model = NULL, *parsed = NULL;
    uint32_t wall = 0;
    size_t i, first_bad = 0;
    nw_status status;

    memset(said, 0, sizeof *said);
    status = nw_model_load(path, &model, NULL, 0);
    unchanged(&before, "load", 0);
    if (status != NW_OK) die(path, status);
    status = nw_model_parse(toml, size, "text", &parsed, NULL, 0);
    unchanged(&before, "parse", 0);
    if (status != NW_OK) die("parse", status);
    nw_model_free(parsed);
    unchanged(&before, "free", 0);
    status = nw_model_parse("x = 1e400", 9, NULL, &parsed, said->message, sizeof said->message);
    unchanged(&before, "parse", 1);
    if (status != NW_MODEL) die("parse of 1e400", status);
    status = nw_model_find_wall(model, "quenchRing", &wall);
    unchanged(&before, "find_wall", status);

    for (i = 0; i < count; ++i) {
        nw_outcome_init(&said->outcome[i]);
        said->status[i] = nw_resolve(model, &impacts[i], &said->outcome[i]);
        unchanged(&before, "resolve", (long)i);
        nw_speeds(model, &impacts[i], &said->speeds[i][0], &said->speeds[i][1], &said->speeds[i][2]);
        unchanged(&before, "speeds", (long)i);
    }

    memset(&batch, 0, sizeof batch);
    memset(&columns, 0, sizeof columns);
    batch.struct_size = sizeof batch;
    batch.count = count;
    batch.v_n = v_n;
    columns.struct_size = sizeof columns;
    columns.e_n = said->batch_e_n;
    said->batch_status = nw_resolve_batch(model, &batch, &columns, &first_bad);
    unchanged(&before, "batch", said->batch_status);
    nw_model_free(model);
    unchanged(&before, "free", 1);
}

static size_t read_all(const char *path, void *buffer, size_t size) {
    FILE *file = fopen(path, "rb");
    size_t length;
    if (!file) return 0;
    length = fread(buffer, 1, size, file);
    fclose(file);
    return length;
}

static answers expected, said;

int main(int argc, char **argv) {
    static char toml[65536], path[4096];
    long models = 0, states = 0;
    if (argc != 2) return 2;
    for (;; ++models) {
        size_t size, count, i;
        int rounding, traps, raised, flush;
        snprintf(path, sizeof path, "%s/%ld.bin", argv[1], models);
        count = read_all(path, impacts, sizeof impacts) / sizeof impacts[0];
        if (count == 0) break;
        for (i = 0; i < count; ++i) v_n[i] = impacts[i].v_n;
        snprintf(path, sizeof path, "%s/%ld.toml", argv[1], models);
        size = read_all(path, toml, sizeof toml);

        fesetenv(FE_DFL_ENV);
        ask(path, toml, size, count, &expected);
        for (rounding = 0; rounding < 4; ++rounding)
            for (traps = 0; traps < TRAPS; ++traps)
                for (raised = 0; raised < 2; ++raised)
                    for (flush = 0; flush < 2; ++flush, ++states) {
                        enter(ROUNDINGS[rounding], traps, raised, flush);
                        ask(path, toml, size, count, &said);
                        if (memcmp(&expected, &said, sizeof said) != 0) die("other bits in state", states);
                    }
        fesetenv(FE_DFL_ENV);
    }
    printf("%ld models, %ld states, %ld calls\n", models, states, calls);
    return models > 0 ? 0 : 2;
}

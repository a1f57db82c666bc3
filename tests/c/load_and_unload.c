/* Loads and unloads the library many times, also in threads that end, and asks it the same each time.
 *
 *     load_and_unload LIBRARY MODEL */
#include "nearwall.h"

#include <dlfcn.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>

#define ROUNDS 1000

static const char *library, *model_file;

/* One round; the outcome goes to `result`, which stays zero when something fails. */
static void *once(void *result) {
    nw_status (*load)(const char *, nw_model **, char *, size_t);
    nw_status (*impact_init)(nw_impact *);
    nw_status (*outcome_init)(nw_outcome *);
    nw_status (*resolve)(const nw_model *, const nw_impact *, nw_outcome *);
    void (*release)(nw_model *);
    nw_model *model = NULL;
    nw_impact impact;
    nw_outcome outcome;
    char message[200] = "";
    void *handle = dlopen(library, RTLD_NOW | RTLD_LOCAL);
    if (!handle) {
        fprintf(stderr, "%s\n", dlerror());
        return NULL;
    }
    *(void **)&load = dlsym(handle, "nw_model_load");
    *(void **)&impact_init = dlsym(handle, "nw_impact_init");
    *(void **)&outcome_init = dlsym(handle, "nw_outcome_init");
    *(void **)&resolve = dlsym(handle, "nw_resolve");
    *(void **)&release = dlsym(handle, "nw_model_free");
    impact_init(&impact);
    outcome_init(&outcome);
    impact.v_n = 2;
    if (load("/nowhere", &model, message, sizeof message) != NW_FILE || !message[0]) return NULL;
    if (load(model_file, &model, message, sizeof message) != NW_OK) return NULL;
    if (resolve(model, &impact, &outcome) != NW_OK) return NULL;
    release(model);
    if (dlclose(handle) != 0) return NULL;
    memcpy(result, &outcome, sizeof outcome);
    return NULL;
}

int main(int argc, char **argv) {
    nw_outcome first;
    int round;
    if (argc != 3) return 2;
    library = argv[1];
    model_file = argv[2];
    memset(&first, 0, sizeof first);
    once(&first);
    if (first.struct_size == 0) return 1;
    for (round = 1; round < ROUNDS; ++round) {
        nw_outcome outcome;
        memset(&outcome, 0, sizeof outcome);
        if (round % 2) {
            pthread_t thread;
            if (pthread_create(&thread, NULL, once, &outcome) || pthread_join(thread, NULL)) return 1;
        } else {
            once(&outcome);
        }
        if (memcmp(&first, &outcome, sizeof first) != 0) return 1;
    }
    if (!dlopen(library, RTLD_NOW | RTLD_NOLOAD)) {
        fprintf(stderr, "it was unloaded\n");
        return 1;
    }
    printf("%d rounds\n", ROUNDS);
    return 0;
}

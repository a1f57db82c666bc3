/* A program linked to one version of the library loads another with all its symbols visible: each answers for itself.
 *
 *     two_versions OTHER_LIBRARY FOLDER
 *
 * FOLDER has 0.toml and the raw nw_impact structs 0.bin. */
#include "nearwall.h"

#include <dlfcn.h>
#include <stdio.h>
#include <string.h>

#define MAX_IMPACTS 1000

typedef struct {
    uint32_t (*abi_version)(void);
    const char *(*version)(void);
    nw_status (*load)(const char *, nw_model **, char *, size_t);
    nw_status (*outcome_init)(nw_outcome *);
    nw_status (*resolve)(const nw_model *, const nw_impact *, nw_outcome *);
    void (*release)(nw_model *);
} library;

static nw_impact impacts[MAX_IMPACTS];

int main(int argc, char **argv) {
    library linked = {nw_abi_version, nw_version, nw_model_load, nw_outcome_init, nw_resolve, nw_model_free};
    library loaded;
    nw_model *mine = NULL, *other = NULL;
    char path[4096];
    size_t count, i;
    void *handle;
    FILE *file;
    if (argc != 3) return 2;
    handle = dlopen(argv[1], RTLD_NOW | RTLD_GLOBAL);
    if (!handle) {
        fprintf(stderr, "%s\n", dlerror());
        return 2;
    }
    *(void **)&loaded.abi_version = dlsym(handle, "nw_abi_version");
    *(void **)&loaded.version = dlsym(handle, "nw_version");
    *(void **)&loaded.load = dlsym(handle, "nw_model_load");
    *(void **)&loaded.outcome_init = dlsym(handle, "nw_outcome_init");
    *(void **)&loaded.resolve = dlsym(handle, "nw_resolve");
    *(void **)&loaded.release = dlsym(handle, "nw_model_free");
    if (loaded.resolve == linked.resolve) {
        fprintf(stderr, "both are the same\n");
        return 1;
    }
    snprintf(path, sizeof path, "%s/0.bin", argv[2]);
    file = fopen(path, "rb");
    if (!file) return 2;
    count = fread(impacts, sizeof impacts[0], MAX_IMPACTS, file);
    fclose(file);
    snprintf(path, sizeof path, "%s/0.toml", argv[2]);
    if (linked.load(path, &mine, NULL, 0) != NW_OK || loaded.load(path, &other, NULL, 0) != NW_OK) return 1;
    for (i = 0; i < count; ++i) {
        nw_outcome a, b;
        linked.outcome_init(&a);
        loaded.outcome_init(&b);
        if (linked.resolve(mine, &impacts[i], &a) != loaded.resolve(other, &impacts[i], &b)) return 1;
        if (memcmp(&a, &b, sizeof a) != 0) return 1;
    }
    loaded.release(other);
    if (dlclose(handle) != 0) return 1;
    linked.release(mine);
    printf("%u %s and %u %s, %u impacts\n", (unsigned)linked.abi_version(), linked.version(),
           (unsigned)loaded.abi_version(), loaded.version(), (unsigned)count);
    return 0;
}

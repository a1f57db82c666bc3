/*---------------------------------------------------------------------------*\
    nearwall: particle-wall interaction for OpenFOAM
    Copyright (C) 2026 the nearwall authors

    This file is free software: you can redistribute it and/or modify it under
    the terms of the GNU General Public License as published by the Free
    Software Foundation, either version 3 of the License, or (at your option)
    any later version. It comes WITHOUT ANY WARRANTY. See LICENSE.

    Description
        See nearWallLibrary.H. The functions of nearwall.h are defined here for
        this library alone (hidden) and pass each call on.
\*---------------------------------------------------------------------------*/

#include "nearWallLibrary.H"
#include "nearwall.h"

#include <dlfcn.h>

namespace
{

void* handle = nullptr;

// One pointer for each function of nearwall.h that is used
#define NEARWALL_FUNCTIONS(APPLY)                                              \
    APPLY(nw_abi_version)                                                      \
    APPLY(nw_version)                                                          \
    APPLY(nw_status_text)                                                      \
    APPLY(nw_regime_name)                                                      \
    APPLY(nw_model_load)                                                       \
    APPLY(nw_model_parse)                                                      \
    APPLY(nw_model_free)                                                       \
    APPLY(nw_model_find_wall)                                                  \
    APPLY(nw_impact_init)                                                      \
    APPLY(nw_outcome_init)                                                     \
    APPLY(nw_temperature_ranges)                                               \
    APPLY(nw_deposit_init)                                                     \
    APPLY(nw_deposit_initial)                                                    \
    APPLY(nw_deposit_source_init)                                                    \
    APPLY(nw_deposit_source_add)                                                     \
    APPLY(nw_deposit_add)                                                      \
    APPLY(nw_deposit_apply)                                                    \
    APPLY(nw_film_velocity)                                                    \
    APPLY(nw_resolve)

#define DECLARE(name) decltype(&::name) real_##name = nullptr;
NEARWALL_FUNCTIONS(DECLARE)
#undef DECLARE


template<class Function>
bool find(Function& f, const char* name)
{
    // POSIX promises that a function fits into the object pointer of dlsym
    void* const symbol = dlsym(handle, name);
    f = reinterpret_cast<Function>(symbol);
    return symbol != nullptr;
}


//- The folder of the shared object that this code is in
std::string ownFolder()
{
    Dl_info info;
    if (dladdr(&handle, &info) && info.dli_fname)
    {
        const std::string file(info.dli_fname);
        const std::string::size_type slash = file.rfind('/');
        if (slash != std::string::npos) return file.substr(0, slash + 1);
    }
    return std::string();
}

} // End anonymous namespace


std::string Foam::nearWall::libraryPath()
{
    return ownFolder() + "libnearwall.so";
}


std::string Foam::nearWall::openLibrary()
{
    if (handle) return std::string();

    handle = dlopen(libraryPath().c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!handle)
    {
        const char* const why = dlerror();
        return why ? why : "unknown reason";
    }

    #define FIND(name)                                                         \
        if (!find(real_##name, #name))                                         \
        {                                                                      \
            return "it has no function " #name;                                \
        }
    NEARWALL_FUNCTIONS(FIND)
    #undef FIND

    return std::string();
}


#define HIDDEN extern "C" __attribute__((visibility("hidden")))

HIDDEN uint32_t nw_abi_version(void)
{
    return real_nw_abi_version();
}

HIDDEN const char* nw_version(void)
{
    return real_nw_version();
}

HIDDEN const char* nw_status_text(nw_status status)
{
    return real_nw_status_text(status);
}

HIDDEN const char* nw_regime_name(nw_regime regime)
{
    return real_nw_regime_name(regime);
}

HIDDEN nw_status nw_model_load
(
    const char* path, nw_model** model, char* message, size_t size
)
{
    return real_nw_model_load(path, model, message, size);
}

HIDDEN nw_status nw_model_parse
(
    const char* toml, size_t length, const char* name,
    nw_model** model, char* message, size_t size
)
{
    return real_nw_model_parse(toml, length, name, model, message, size);
}

HIDDEN void nw_model_free(nw_model* model)
{
    real_nw_model_free(model);
}

HIDDEN nw_status nw_model_find_wall
(
    const nw_model* model, const char* name, uint32_t* wall
)
{
    return real_nw_model_find_wall(model, name, wall);
}

HIDDEN nw_status nw_impact_init(nw_impact* impact)
{
    return real_nw_impact_init(impact);
}

HIDDEN nw_status nw_outcome_init(nw_outcome* outcome)
{
    return real_nw_outcome_init(outcome);
}

HIDDEN nw_status nw_temperature_ranges
(
    const nw_model* model, uint32_t wall,
    double* particleLow, double* particleHigh, double* wallLow, double* wallHigh
)
{
    return real_nw_temperature_ranges
    (
        model, wall, particleLow, particleHigh, wallLow, wallHigh
    );
}

HIDDEN nw_status nw_deposit_init(nw_deposit* deposit)
{
    return real_nw_deposit_init(deposit);
}

HIDDEN nw_status nw_deposit_initial
(
    const nw_model* model, double voidage, nw_deposit* deposit
)
{
    return real_nw_deposit_initial(model, voidage, deposit);
}

HIDDEN nw_status nw_deposit_source_init(nw_deposit_source* arrivals)
{
    return real_nw_deposit_source_init(arrivals);
}

HIDDEN nw_status nw_deposit_source_add
(
    const nw_model* model, const nw_impact* impact,
    double mass, double density, nw_deposit_source* arrivals
)
{
    return real_nw_deposit_source_add(model, impact, mass, density, arrivals);
}

HIDDEN nw_status nw_deposit_add
(
    const nw_deposit_source* arrivals, nw_deposit* deposit
)
{
    return real_nw_deposit_add(arrivals, deposit);
}

HIDDEN nw_status nw_deposit_apply
(
    const nw_model* model, const nw_deposit* deposit,
    double voidage, nw_impact* impact
)
{
    return real_nw_deposit_apply(model, deposit, voidage, impact);
}

HIDDEN nw_status nw_film_velocity
(
    const nw_model* model, const nw_deposit* deposit,
    double T_w, double gravity, double* velocity
)
{
    return real_nw_film_velocity(model, deposit, T_w, gravity, velocity);
}

HIDDEN nw_status nw_resolve
(
    const nw_model* model, const nw_impact* impact, nw_outcome* outcome
)
{
    return real_nw_resolve(model, impact, outcome);
}

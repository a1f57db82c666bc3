// What the handwritten C++ of this folder shares with benches/common.rs: impacts, outcomes and the random number.
#pragma once

#include <cstddef>
#include <cstdint>

struct Impact
{
    double vn, vt, d, Tp, omega;
    std::uint64_t key;
};

struct Outcome
{
    double en, et, pStick, omega;
    std::uint32_t stuck, regime;
};

// Many impacts, one array for each quantity; the key of an impact is its index.
struct Columns
{
    std::size_t count;
    const double *vn, *vt, *d, *Tp, *omega;
    double *en, *et, *pStick, *omegaOut;
    std::uint32_t *stuck, *regime;
};

// Philox4x32-10, the generator of src/rng.rs: the same draws as nearwall's.
inline double uniform(std::uint64_t seed, std::uint64_t key)
{
    std::uint32_t c0 = std::uint32_t(key), c1 = std::uint32_t(key >> 32), c2 = 0, c3 = 0;
    std::uint32_t k0 = std::uint32_t(seed), k1 = std::uint32_t(seed >> 32);
    for (int round = 0; round < 10; ++round)
    {
        const std::uint64_t first = std::uint64_t(0xD2511F53)*c0;
        const std::uint64_t second = std::uint64_t(0xCD9E8D57)*c2;
        c0 = std::uint32_t(second >> 32) ^ c1 ^ k0;
        c1 = std::uint32_t(second);
        c2 = std::uint32_t(first >> 32) ^ c3 ^ k1;
        c3 = std::uint32_t(first);
        k0 += 0x9E3779B9;
        k1 += 0xBB67AE85;
    }
    const std::uint64_t bits = (std::uint64_t(c0) << 32 | c1) >> 11;
    return (double(bits) + 0.5)*(1.0/9007199254740992.0);
}

// The law of one impact for all columns.
template<class Constants, class Law>
inline void forEach(const Constants& constants, const Columns& c, Law law)
{
    for (std::size_t i = 0; i < c.count; ++i)
    {
        Outcome outcome;
        law(constants, Impact{c.vn[i], c.vt[i], c.d[i], c.Tp[i], c.omega[i], i}, outcome);
        c.en[i] = outcome.en;
        c.et[i] = outcome.et;
        c.pStick[i] = outcome.pStick;
        c.omegaOut[i] = outcome.omega;
        c.stuck[i] = outcome.stuck;
        c.regime[i] = outcome.regime;
    }
}

// The wax impact of benches/impacts.rs as one would write it into a solver by hand: Thornton & Ning, sliding and rolling,
// capture by melting, one draw. Nothing is checked and the constants are ready. Compiled with -O3 by the benchmark.
#include <cmath>
#include <cstdint>

struct Constants
{
    double size, adhesive, yielding; // E*/2W, C1^2 E*/rho, v_y
    double friction, stiffnessRatio;
    double middle, width;
    std::uint64_t seed;
};

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

namespace
{

double uniform(std::uint64_t seed, std::uint64_t key)
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

double normalRestitution(const Constants& c, double v, double d)
{
    const double root = 1.0/std::cbrt(d*c.size);
    const double adhesion = c.adhesive*std::pow(root, 5)/(v*v);
    if (adhesion >= 1.0)
    {
        return 0.0;
    }
    const double w = c.yielding/v;
    double elastic = 1.0;
    if (w < 1.0)
    {
        elastic = 1.2*std::sqrt(3.0)*(1.0 - w*w/6.0)*std::sqrt(w/(w + 2.0*std::sqrt((6.0 - w*w)/5.0)));
    }
    return elastic > adhesion ? std::sqrt(elastic - adhesion) : 0.0;
}

}

extern "C" void impact_by_hand(const Constants* constants, const Impact* impact, Outcome* outcome)
{
    const Constants& c = *constants;
    const Impact& i = *impact;
    const double plain = normalRestitution(c, i.vn, i.d);
    const double sticky = 1.0/(1.0 + std::exp((c.middle - i.Tp)/c.width));
    const double en = plain*(1.0 - sticky);
    const double p = plain > 0.0 ? sticky : 1.0;

    const double slip = i.vt - 0.5*i.d*i.omega;
    const double impulse = c.friction*(1.0 + en)*i.vn;
    const double limit = (7.0 - 1.0/c.stiffnessRatio)*0.5*impulse;
    if (std::fabs(slip) > limit)
    {
        const double keeps = 4.0/7.0*std::fabs(slip);
        const double most = std::fmax(std::fmin(i.vt, slip), keeps);
        const double change = std::copysign(std::fmin(impulse, most), slip);
        const double turning = std::fmax(std::fmin(change, keeps), -keeps);
        outcome->omega = i.omega + 5.0*turning/i.d;
        outcome->et = i.vt > 0.0 ? 1.0 - change/i.vt : 0.0;
    }
    else
    {
        const double speed = (5.0*i.vt + i.d*i.omega)/7.0;
        outcome->omega = 2.0*speed/i.d;
        outcome->et = i.vt > 0.0 ? speed/i.vt : 5.0/7.0;
    }
    outcome->en = en;
    outcome->pStick = p;
    outcome->regime = sticky >= 0.5 ? 2 : 0;
    outcome->stuck = uniform(c.seed, i.key) < p ? 1 : 0;
}

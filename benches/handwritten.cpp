// The wax impact of benches/common.rs as one would write it into a solver by hand: Thornton & Ning,
// sliding and rolling, capture by melting, one draw. Nothing is checked and the constants are
// ready. Compiled with -O3 by the benchmark, once with the C library's exponential and cube root,
// and once (-DOWN_ELEMENTARY) with those of src/vector_math.rs.
#include "handwritten.h"

#include <cmath>
#include <cstring>

struct Constants
{
    double size, adhesive, yielding; // E*/2W, C1^2 E*/rho, v_y
    double friction, stiffnessRatio;
    double middle, width;
    std::uint64_t seed;
};

namespace
{

#ifdef OWN_ELEMENTARY
std::uint64_t bits(double x)
{
    std::uint64_t word;
    std::memcpy(&word, &x, sizeof(x));
    return word;
}

double number(std::uint64_t word)
{
    double x;
    std::memcpy(&x, &word, sizeof(x));
    return x;
}

const double inverseFactorials[14] = {
    1.0, 1.0, 1.0/2.0, 1.0/6.0, 1.0/24.0, 1.0/120.0, 1.0/720.0, 1.0/5040.0, 1.0/40320.0, 1.0/362880.0, 1.0/3628800.0,
    1.0/39916800.0, 1.0/479001600.0, 1.0/6227020800.0};

double exponential(double x)
{
    x = x > -708.0 ? x : -708.0;
    x = x < 709.0 ? x : 709.0;
    const double* c = inverseFactorials;
    const double shifted = x*1.4426950408889634 + 6755399441055744.0;
    const double n = shifted - 6755399441055744.0;
    const double r = (x - n*6.931471803691238e-1) - n*1.9082149292705877e-10;
    const double r2 = r*r, r4 = r2*r2;
    const double low = ((c[0] + c[1]*r) + (c[2] + c[3]*r)*r2) + ((c[4] + c[5]*r) + (c[6] + c[7]*r)*r2)*r4;
    const double high = ((c[8] + c[9]*r) + (c[10] + c[11]*r)*r2) + (c[12] + c[13]*r)*r4;
    return number(bits(low + high*(r4*r4)) + (bits(shifted) << 52));
}

double inverseCubeRoot(double x)
{
    double y = number((0x553ef0e8 - (((bits(x) >> 32)*0x55555556) >> 32)) << 32);
    for (int step = 0; step < 2; ++step)
    {
        const double h = 1.0 - ((x*y)*y)*y;
        y = y + y*(h*(1.0/3.0 + h*(2.0/9.0 + h*(14.0/81.0))));
    }
    return y;
}
#else
double exponential(double x) { return std::exp(x); }

double inverseCubeRoot(double x) { return 1.0/std::cbrt(x); }
#endif

double normalRestitution(const Constants& c, double v, double d)
{
    const double root = inverseCubeRoot(d*c.size);
    const double square = root*root;
    const double adhesion = c.adhesive*(square*square*root)/(v*v);
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

inline void rebound(const Constants& c, const Impact& i, Outcome& outcome)
{
    const double plain = normalRestitution(c, i.vn, i.d);
    const double sticky = 1.0/(1.0 + exponential((c.middle - i.Tp)/c.width));
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
        outcome.omega = i.omega + 5.0*turning/i.d;
        outcome.et = i.vt > 0.0 ? 1.0 - change/i.vt : 0.0;
    }
    else
    {
        const double speed = (5.0*i.vt + i.d*i.omega)/7.0;
        outcome.omega = 2.0*speed/i.d;
        outcome.et = i.vt > 0.0 ? speed/i.vt : 5.0/7.0;
    }
    outcome.en = en;
    outcome.pStick = p;
    outcome.regime = sticky >= 0.5 ? 2 : 0;
    outcome.stuck = uniform(c.seed, i.key) < p ? 1 : 0;
}

}

extern "C" void impact_by_hand(const Constants* constants, const Impact* impact, Outcome* outcome)
{
    rebound(*constants, *impact, *outcome);
}

extern "C" void impacts_by_hand(const Constants* constants, const Columns* columns)
{
    forEach(*constants, *columns, rebound);
}

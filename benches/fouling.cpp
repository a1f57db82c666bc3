// Fouling by molten ash as code_saturne has it, written here from the equations: the viscosity of
// Watt & Fereday (1969), a probability of sticking of critical viscosity over viscosity, one draw;
// what does not stick is reflected without loss. Nothing is checked and the constants are ready.
#include "handwritten.h"

#include <cmath>

struct Constants
{
    double slope, intercept; // m and c at the head of src/slag/watt_fereday.rs
    double critical;         // critical viscosity [Pa s]
    double coldest;          // temperature [K] below which nothing sticks
    double unused[3];
    std::uint64_t seed;
};

namespace
{

inline void rebound(const Constants& c, const Impact& i, Outcome& outcome)
{
    double p = 0.0;
    if (i.Tp > c.coldest)
    {
        const double above = i.Tp - 273.15 - 150.0;
        const double viscosity = 0.1*std::pow(10.0, 1e7*c.slope/(above*above) + c.intercept);
        p = viscosity > c.critical ? c.critical/viscosity : 1.0;
    }
    outcome.pStick = p;
    outcome.stuck = uniform(c.seed, i.key) < p ? 1 : 0;
    outcome.en = 1.0;
    outcome.et = 1.0;
    outcome.omega = i.omega;
    outcome.regime = p >= 0.5 ? 2 : 0;
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

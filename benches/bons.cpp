// The model of Bons, Prenter & Whitaker (2017) as a gas solver codes it (FLEXI, for one, has such a
// model), written here from the equations at the head of src/normal/bons.rs and
// src/tangential/bons.rs: an elastic–plastic cylinder with adhesion, and friction that weakens
// towards head-on. Nothing is checked and the constants are ready.
#include "handwritten.h"

#include <cmath>

struct Constants
{
    double yielding;         // v_y [m/s]
    double adhesive;         // 2 W d/((l - w_crit) rho) [m3/s2]: over d, the squared speed that adhesion takes
    double offset, slope, exponent; // a, b, c of the area of contact
    double friction;
    double unused;
    std::uint64_t seed;      // no draw
};

namespace
{

inline void rebound(const Constants& c, const Impact& i, Outcome& outcome)
{
    const double deformation = i.vn/c.yielding;
    const double plain = deformation > 1.0 ? 1.0/deformation : 1.0;
    const double area = c.offset + c.slope*std::pow(deformation, c.exponent);
    const double square = plain*plain - c.adhesive/i.d*area/(i.vn*i.vn);
    const bool sticks = !(square > 0.0);
    outcome.en = sticks ? 0.0 : std::sqrt(std::fmin(square, 1.0));
    // sin b cos b, b the angle between path and surface
    const double product = i.vn*i.vt/(i.vn*i.vn + i.vt*i.vt);
    outcome.et = std::fmax(1.0 - c.friction*(1.0 + outcome.en)*product, 0.0);
    outcome.pStick = sticks ? 1.0 : 0.0;
    outcome.omega = i.omega;
    outcome.stuck = sticks ? 1 : 0;
    outcome.regime = 0;
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

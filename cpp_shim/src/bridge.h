// What the test asks of nearwall.hpp, in the types that cxx can carry.
#ifndef NEARWALL_BRIDGE_H
#define NEARWALL_BRIDGE_H

#include "nearwall.hpp"

#include "rust/cxx.h"

#include <array>
#include <memory>

namespace nearwall_bridge {

std::unique_ptr<nearwall::model> from_file(rust::Str path);
std::unique_ptr<nearwall::model> from_toml(rust::Str text, rust::Str name);
std::uint32_t find_wall(const nearwall::model& model, rust::Str name);
nw_outcome resolve(const nearwall::model& model, const nw_impact& impact);
std::int32_t resolve_status(const nearwall::model& model, const nw_impact& impact, nw_outcome& outcome) noexcept;
void resolve_arrays(const nearwall::model& model, const nw_impacts& impacts, const nw_outcomes& outcomes);
void resolve_each(const nearwall::model& model, rust::Slice<const nw_impact> impacts, rust::Slice<nw_outcome> outcomes);
std::array<double, 4> ranges(const nearwall::model& model, std::uint32_t wall);
std::array<double, 3> speeds(const nearwall::model& model, const nw_impact& impact);

// What moving does to models; throws with a word on what went wrong.
void move_about(rust::Str text);

}  // namespace nearwall_bridge

#endif  // NEARWALL_BRIDGE_H

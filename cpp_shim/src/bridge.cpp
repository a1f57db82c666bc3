// Hands each call on to nearwall.hpp, nothing else: what is tested is the shim.
#include "src/bridge.h"

#include <algorithm>
#include <type_traits>
#include <utility>

namespace nearwall_bridge {

static_assert(!std::is_copy_constructible<nearwall::model>::value, "a model is not copied");
static_assert(!std::is_copy_assignable<nearwall::model>::value, "a model is not copied");
static_assert(std::is_nothrow_move_constructible<nearwall::model>::value, "a model moves");
static_assert(std::is_nothrow_move_assignable<nearwall::model>::value, "a model moves");
static_assert(std::is_base_of<std::runtime_error, nearwall::error>::value, "errors are std::exceptions");
static_assert(std::is_nothrow_copy_constructible<nearwall::batch_error>::value, "errors may be caught by value");

std::unique_ptr<nearwall::model> from_file(rust::Str path) {
    return std::unique_ptr<nearwall::model>(new nearwall::model(nearwall::model::from_file(std::string(path))));
}

std::unique_ptr<nearwall::model> from_toml(rust::Str text, rust::Str name) {
    return std::unique_ptr<nearwall::model>(
        new nearwall::model(nearwall::model::from_toml(std::string(text), std::string(name))));
}

std::uint32_t find_wall(const nearwall::model& model, rust::Str name) {
    const std::string text(name);
    std::uint32_t asked = 12345;
    const bool there = model.find_wall(text, asked);
    if (!there && asked != 12345) {
        throw std::logic_error("an index was written for a wall that is not there");
    }
    const std::uint32_t wall = model.find_wall(text);
    if (!there || asked != wall) {
        throw std::logic_error("the two ways to find a wall disagree");
    }
    return wall;
}

nw_outcome resolve(const nearwall::model& model, const nw_impact& impact) {
    return model.resolve(impact);
}

std::int32_t resolve_status(const nearwall::model& model, const nw_impact& impact, nw_outcome& outcome) noexcept {
    return model.resolve(impact, outcome);
}

void resolve_arrays(const nearwall::model& model, const nw_impacts& impacts, const nw_outcomes& outcomes) {
    model.resolve_batch(impacts, outcomes);
}

void resolve_each(const nearwall::model& model, rust::Slice<const nw_impact> impacts, rust::Slice<nw_outcome> outcomes) {
    const std::vector<nw_impact> copies(impacts.begin(), impacts.end());
    const std::vector<nw_outcome> found = model.resolve_batch(copies);
    std::copy(found.begin(), found.end(), outcomes.begin());
}

std::array<double, 4> ranges(const nearwall::model& model, std::uint32_t wall) {
    const nearwall::temperature_ranges found = model.ranges(wall);
    return {found.particle_low, found.particle_high, found.wall_low, found.wall_high};
}

std::array<double, 3> speeds(const nearwall::model& model, const nw_impact& impact) {
    const nearwall::velocities found = model.speeds(impact);
    return {{found.adhesive, found.yield, found.sticking}};
}

void move_about(rust::Str text) {
    nearwall::model first = nearwall::model::from_toml(std::string(text));
    const nw_model* handle = first.get();
    nearwall::model second = std::move(first);
    if (first.get() != nullptr || second.get() != handle) {
        throw std::logic_error("move construction");
    }
    nearwall::model third = nearwall::model::from_toml(std::string(text));
    third = std::move(second);
    if (second.get() != nullptr || third.get() != handle) {
        throw std::logic_error("move assignment");
    }
    nearwall::model& itself = third;
    third = std::move(itself);
    if (third.get() != handle) {
        throw std::logic_error("move assignment to itself");
    }
    nw_outcome outcome = nearwall::make_outcome();
    if (second.resolve(nearwall::make_impact(), outcome) != NW_NULL_POINTER) {
        throw std::logic_error("a model that was moved from is refused, not followed");
    }
    if (third.resolve(nearwall::make_impact(), outcome) != NW_OK) {
        throw std::logic_error("a model that was moved to is whole");
    }
}

}  // namespace nearwall_bridge

// nearwall.hpp - C++11 over the C interface of nearwall.h, header only.
//
// A model is loaded once, is immutable, and may be used by many threads at
// once: what is `const` here is `&T` in Rust. A fault is thrown as
// nearwall::error; the overloads with a status do not throw and are meant for
// the inside of a loop over impacts.
//
//     nearwall::model model = nearwall::model::from_file("nearWall.toml");
//     nw_impact impact = nearwall::make_impact();
//     impact.wall = model.find_wall("default");
//     impact.v_n = 2.0;
//     nw_outcome outcome = model.resolve(impact);
//
// Many impacts at once, from arrays that are there already:
//
//     nw_impacts impacts = nearwall::make_impacts(v_n.size(), v_n.data());
//     impacts.T_p = T_p.data();
//     nw_outcomes outcomes = nearwall::make_outcomes();
//     outcomes.e_n = e_n.data();
//     model.resolve_batch(impacts, outcomes);
//
// Licence: MIT OR Apache-2.0, as the library it wraps.
#ifndef NEARWALL_HPP
#define NEARWALL_HPP

#include "nearwall.h"

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace nearwall {

// A fault with the status that caused it; what() is the library's own message.
class error : public std::runtime_error {
public:
    error(nw_status status, const std::string& message)
        : std::runtime_error(message), status_(status) {}

    nw_status status() const noexcept { return status_; }

private:
    nw_status status_;
};

// A fault of one impact among many.
class batch_error : public error {
public:
    batch_error(nw_status status, std::size_t index)
        : error(status, "impact " + std::to_string(index) + ": " + nw_status_text(status)),
          index_(index) {}

    // Which impact, counted from 0.
    std::size_t index() const noexcept { return index_; }

private:
    std::size_t index_;
};

// Adhesive, yield and sticking velocity [m/s].
struct velocities {
    double adhesive;
    double yield;
    double sticking;
};

// Temperatures [K] between which impacts can be decided; 0 and infinity where nothing limits them.
struct temperature_ranges {
    double particle_low;
    double particle_high;
    double wall_low;
    double wall_high;
};

namespace detail {

// Room for a message; the library cuts what does not fit.
struct message {
    char text[2048];
    message() { text[0] = '\0'; }
};

inline void check(nw_status status, const std::string& context) {
    if (status != NW_OK) {
        throw error(status, context + ": " + nw_status_text(status));
    }
}

inline void check(nw_status status, const message& m) {
    if (status != NW_OK) {
        throw error(status, m.text[0] ? m.text : nw_status_text(status));
    }
}

// The library that was loaded has to be the one that this header describes.
inline void check_interface() {
    const std::uint32_t loaded = nw_abi_version();
    if (loaded != NW_ABI_VERSION) {
        throw error(NW_STRUCT_SIZE,
                    "libnearwall " + std::string(nw_version()) + " has interface version " +
                        std::to_string(loaded) + ", this program was built for version " +
                        std::to_string(NW_ABI_VERSION) + "; rebuild it with the library's nearwall.h");
    }
}

// A text for C, which would end it at a zero inside and so mean another file or wall.
inline const char* c_text(const std::string& text, nw_status status, const char* what) {
    if (text.find('\0') != std::string::npos) {
        throw error(status, std::string(what) + " has a zero in it: " + text.c_str());
    }
    return text.c_str();
}

}  // namespace detail

// An impact with every field at the library's default.
inline nw_impact make_impact() {
    nw_impact impact;
    detail::check(nw_impact_init(&impact), std::string("nw_impact_init"));
    return impact;
}

// An outcome ready to be filled.
inline nw_outcome make_outcome() {
    nw_outcome outcome;
    detail::check(nw_outcome_init(&outcome), std::string("nw_outcome_init"));
    return outcome;
}

// Arrays of impacts: `count` speeds towards the wall, every other array not given. They are not copied.
inline nw_impacts make_impacts(std::size_t count, const double* v_n) noexcept {
    nw_impacts impacts = nw_impacts();
    impacts.struct_size = sizeof(impacts);
    impacts.count = count;
    impacts.v_n = v_n;
    return impacts;
}

// Arrays for outcomes, none of them wanted yet.
inline nw_outcomes make_outcomes() noexcept {
    nw_outcomes outcomes = nw_outcomes();
    outcomes.struct_size = sizeof(outcomes);
    return outcomes;
}

// The deposit on a piece of a wall that is bare yet.
inline nw_deposit make_deposit(std::uint32_t wall) {
    nw_deposit deposit;
    detail::check(nw_deposit_init(&deposit), std::string("nw_deposit_init"));
    deposit.wall = wall;
    return deposit;
}

// What arrived on a piece of wall: nothing yet.
inline nw_deposit_source make_arrivals() {
    nw_deposit_source arrivals;
    detail::check(nw_deposit_source_init(&arrivals), std::string("nw_deposit_source_init"));
    return arrivals;
}

// Adds the arrivals of a step to a deposit; it is untouched on failure.
inline nw_status add(const nw_deposit_source& arrivals, nw_deposit& deposit) noexcept {
    return nw_deposit_add(&arrivals, &deposit);
}

// A loaded model. Moves, does not copy; share it by reference or smart pointer.
class model {
public:
    // From a TOML file.
    static model from_file(const std::string& path) {
        detail::check_interface();
        const char* c_path = detail::c_text(path, NW_FILE, "the path");
        nw_model* raw = nullptr;
        detail::message m;
        detail::check(nw_model_load(c_path, &raw, m.text, sizeof(m.text)), m);
        return model(raw);
    }

    // From TOML text; `name` stands for the file in messages.
    static model from_toml(const std::string& text, const std::string& name = "model") {
        detail::check_interface();
        nw_model* raw = nullptr;
        detail::message m;
        detail::check(
            nw_model_parse(text.data(), text.size(), name.c_str(), &raw, m.text, sizeof(m.text)), m);
        return model(raw);
    }

    model(model&& other) noexcept : raw_(other.raw_) { other.raw_ = nullptr; }

    model& operator=(model&& other) noexcept {
        nw_model* raw = other.raw_;
        other.raw_ = nullptr;
        nw_model_free(raw_);
        raw_ = raw;
        return *this;
    }

    model(const model&) = delete;
    model& operator=(const model&) = delete;

    ~model() { nw_model_free(raw_); }

    // Index of a wall; throws NW_UNKNOWN_WALL when the model has none of that name.
    std::uint32_t find_wall(const std::string& name) const {
        const char* c_name = detail::c_text(name, NW_UNKNOWN_WALL, "the wall's name");
        std::uint32_t wall = 0;
        detail::check(nw_model_find_wall(raw_, c_name, &wall), "wall '" + name + "'");
        return wall;
    }

    // The same, asking: true and `wall` set when there is one.
    bool find_wall(const std::string& name, std::uint32_t& wall) const noexcept {
        return name.find('\0') == std::string::npos &&
               nw_model_find_wall(raw_, name.c_str(), &wall) == NW_OK;
    }

    // What becomes of one impact; throws on an unusable state.
    nw_outcome resolve(const nw_impact& impact) const {
        nw_outcome outcome = make_outcome();
        detail::check(nw_resolve(raw_, &impact, &outcome), std::string("nw_resolve"));
        return outcome;
    }

    // The same without exceptions; `outcome` (from make_outcome) is untouched on failure.
    nw_status resolve(const nw_impact& impact, nw_outcome& outcome) const noexcept {
        return nw_resolve(raw_, &impact, &outcome);
    }

    // What the model file says lies on a wall, where a memory begins; throws for a wall that is not there.
    nw_deposit initial_deposit(std::uint32_t wall, double voidage) const {
        nw_deposit deposit = make_deposit(wall);
        detail::check(nw_deposit_initial(raw_, voidage, &deposit), std::string("nw_deposit_initial"));
        return deposit;
    }

    // Tells an impact of the deposit that it meets, powder with a share `voidage` of voids; no exceptions.
    nw_status apply_deposit(const nw_deposit& deposit, double voidage, nw_impact& impact) const noexcept {
        return nw_deposit_apply(raw_, &deposit, voidage, &impact);
    }

    // Adds a particle that stayed, `mass` of it per area [kg/m2] and its `density` [kg/m3]; no exceptions.
    nw_status add_captured(const nw_impact& impact, double mass, double density,
                     nw_deposit_source& arrivals) const noexcept {
        return nw_deposit_source_add(raw_, &impact, mass, density, &arrivals);
    }

    // Mean speed [m/s] of a deposit's melt that runs down a wall of `T_w` [K]; no exceptions.
    nw_status film_velocity(const nw_deposit& deposit, double T_w, double gravity_along,
                            double& velocity) const noexcept {
        return nw_film_velocity(raw_, &deposit, T_w, gravity_along, &velocity);
    }

    // Many impacts from arrays to arrays; throws batch_error for the first that is unusable, with no outcome written.
    void resolve_batch(const nw_impacts& impacts, const nw_outcomes& outcomes) const {
        std::size_t first_bad = SIZE_MAX;
        const nw_status status = resolve_batch(impacts, outcomes, first_bad);
        if (status != NW_OK && first_bad != SIZE_MAX) {
            throw batch_error(status, first_bad);
        }
        detail::check(status, std::string("nw_resolve_batch"));
    }

    // The same without exceptions; `first_bad` is set when one impact is at fault.
    nw_status resolve_batch(const nw_impacts& impacts, const nw_outcomes& outcomes,
                            std::size_t& first_bad) const noexcept {
        return nw_resolve_batch(raw_, &impacts, &outcomes, &first_bad);
    }

    // Many impacts, each with its own wall, seed and key; throws batch_error for the first that is unusable.
    std::vector<nw_outcome> resolve_batch(const std::vector<nw_impact>& impacts) const {
        std::vector<nw_outcome> outcomes(impacts.size(), make_outcome());
        for (std::size_t i = 0; i < impacts.size(); ++i) {
            const nw_status status = resolve(impacts[i], outcomes[i]);
            if (status != NW_OK) {
                throw batch_error(status, i);
            }
        }
        return outcomes;
    }

    // Velocities that mark the impacts of this particle and wall: size and temperatures count, and what effects on the
    // contact look at; chance is at its median.
    velocities speeds(const nw_impact& impact) const {
        velocities found = velocities();
        detail::check(nw_speeds(raw_, &impact, &found.adhesive, &found.yield, &found.sticking),
                      std::string("nw_speeds"));
        return found;
    }

    // Lowest and highest temperature [K] at which impacts on a wall can be decided.
    temperature_ranges ranges(std::uint32_t wall) const {
        temperature_ranges found = temperature_ranges();
        detail::check(nw_temperature_ranges(raw_, wall, &found.particle_low, &found.particle_high,
                                            &found.wall_low, &found.wall_high),
                      std::string("nw_temperature_ranges"));
        return found;
    }

    // The C handle, still owned by this object; null after being moved from.
    const nw_model* get() const noexcept { return raw_; }

private:
    explicit model(nw_model* raw) noexcept : raw_(raw) {}

    nw_model* raw_;
};

}  // namespace nearwall

#endif  // NEARWALL_HPP

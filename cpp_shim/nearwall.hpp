// nearwall.hpp - C++11 over the C interface of nearwall.h, header only.
//
// A model is loaded once, is immutable, and many threads may use it at once.
// Errors are thrown as nearwall::error; the overloads that return a status do
// not throw and suit loops over impacts.
//
//     nearwall::model model = nearwall::model::from_file("nearWall.toml");
//     nw_impact impact = nearwall::make_impact();
//     impact.wall = model.find_wall("default");
//     impact.v_n = 2.0;
//     nw_outcome outcome = model.resolve(impact);
//
// Many impacts at once, from existing arrays:
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

// An error with its status; what() is the library's message.
class error : public std::runtime_error {
public:
    error(nw_status status, const std::string& message)
        : std::runtime_error(message), status_(status) {}

    nw_status status() const noexcept { return status_; }

private:
    nw_status status_;
};

// An error of one impact among many.
class batch_error : public error {
public:
    batch_error(nw_status status, std::size_t index)
        : error(status, "impact " + std::to_string(index) + ": " + nw_status_text(status)),
          index_(index) {}

    // Index of the impact, from 0.
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

// Temperatures [K] for which the properties of particle and wall are defined; 0 and infinity without a limit.
struct temperature_ranges {
    double particle_low;
    double particle_high;
    double wall_low;
    double wall_high;
};

namespace detail {

// Buffer for a message; the library truncates longer ones.
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

// Refuses a library with another interface than this header's.
inline void check_interface() {
    const std::uint32_t loaded = nw_abi_version();
    if (loaded != NW_ABI_VERSION) {
        throw error(NW_STRUCT_SIZE,
                    "libnearwall " + std::string(nw_version()) + " has interface version " +
                        std::to_string(loaded) + ", this program was built for version " +
                        std::to_string(NW_ABI_VERSION) + "; rebuild it with the library's nearwall.h");
    }
}

// A string for C; refuses a zero, at which C would end it.
inline const char* c_text(const std::string& text, nw_status status, const char* what) {
    if (text.find('\0') != std::string::npos) {
        throw error(status, std::string(what) + " has a zero in it: " + text.c_str());
    }
    return text.c_str();
}

}  // namespace detail

// An impact with the default of every input.
inline nw_impact make_impact() {
    nw_impact impact;
    detail::check(nw_impact_init(&impact), std::string("nw_impact_init"));
    return impact;
}

// An outcome for model::resolve.
inline nw_outcome make_outcome() {
    nw_outcome outcome;
    detail::check(nw_outcome_init(&outcome), std::string("nw_outcome_init"));
    return outcome;
}

// Arrays of impacts: `count` speeds towards the wall, no other array. They are not copied.
inline nw_impacts make_impacts(std::size_t count, const double* v_n) noexcept {
    nw_impacts impacts = nw_impacts();
    impacts.struct_size = sizeof(impacts);
    impacts.count = count;
    impacts.v_n = v_n;
    return impacts;
}

// Arrays for outcomes, none requested yet.
inline nw_outcomes make_outcomes() noexcept {
    nw_outcomes outcomes = nw_outcomes();
    outcomes.struct_size = sizeof(outcomes);
    return outcomes;
}

// The deposit on a bare piece of a wall.
inline nw_deposit make_deposit(std::uint32_t wall) {
    nw_deposit deposit;
    detail::check(nw_deposit_init(&deposit), std::string("nw_deposit_init"));
    deposit.wall = wall;
    return deposit;
}

// An empty sum of captured particles.
inline nw_deposit_source make_deposit_source() {
    nw_deposit_source source;
    detail::check(nw_deposit_source_init(&source), std::string("nw_deposit_source_init"));
    return source;
}

// What cools and heats a wall: set at least the temperatures of coolant and gas.
inline nw_wall_cooling make_wall_cooling() {
    nw_wall_cooling cooling;
    detail::check(nw_wall_cooling_init(&cooling), std::string("nw_wall_cooling_init"));
    return cooling;
}

// Temperatures of a wall, for model::heat.
inline nw_wall_heat make_wall_heat() {
    nw_wall_heat heat;
    detail::check(nw_wall_heat_init(&heat), std::string("nw_wall_heat_init"));
    return heat;
}

// What surrounds a deposit, for model::advance, with a share `voidage` of voids in fresh powder.
inline nw_deposit_surroundings make_deposit_surroundings(double voidage) {
    nw_deposit_surroundings surroundings;
    detail::check(nw_deposit_surroundings_init(&surroundings), std::string("nw_deposit_surroundings_init"));
    surroundings.voidage = voidage;
    return surroundings;
}

// Mass that a deposit lost in a step, for model::advance.
inline nw_deposit_losses make_deposit_losses() {
    nw_deposit_losses losses;
    detail::check(nw_deposit_losses_init(&losses), std::string("nw_deposit_losses_init"));
    return losses;
}

// A process that changes a deposit: its name, and how tables name the mass that it takes, empty if it takes none.
struct process {
    std::string name, loss, gain;
};

// All processes, in the order of nw_deposit_losses.mass.
inline std::vector<process> processes() {
    std::vector<process> found;
    for (std::uint32_t i = 0; i < NW_PROCESSES; ++i) {
        found.push_back(process{nw_process_name(i), nw_process_loss(i), nw_process_gain(i)});
    }
    return found;
}

// Which input of an impact is probably in another unit; empty if none is. A temperature in degrees
// Celsius above 150 is not seen.
inline std::string unlikely(const nw_impact& impact) {
    detail::message m;
    detail::check(nw_unlikely(&impact, m.text, sizeof(m.text)), std::string("nw_unlikely"));
    return m.text;
}

// A key from `count` values that tell an impact from all others on any number of ranks, for codes
// that do not number their particles; throws if there are none or one is not finite.
inline std::uint64_t key_of_values(const double* values, std::size_t count) {
    std::uint64_t key = 0;
    detail::check(nw_key_of_values(values, count, &key), std::string("nw_key_of_values"));
    return key;
}

// A walk of the gas's fluctuation; its step, values and velocity are zero.
inline nw_walk make_walk() noexcept {
    nw_walk walk;
    nw_walk_init(&walk);
    return walk;
}

// Takes a walk on by the step that has brought the particle to its place; it is untouched on failure.
inline nw_status advance(nw_walk& walk) noexcept {
    return nw_walk_advance(&walk);
}

// Thermophoretic force over the gradient of the gas's temperature [N m/K]; see nw_thermophoresis.
inline double thermophoresis(double temperature, double density, double viscosity, double conductivity,
                             double mean_free_path, double diameter, double particle_conductivity) {
    double force = 0.0;
    detail::check(nw_thermophoresis(temperature, density, viscosity, conductivity, mean_free_path, diameter,
                                    particle_conductivity, &force),
                  std::string("nw_thermophoresis"));
    return force;
}

// Adds the captured particles of a step to a deposit, which is untouched on failure.
inline nw_status add(const nw_deposit_source& source, nw_deposit& deposit) noexcept {
    return nw_deposit_add(&source, &deposit);
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

    // From TOML text; messages name it `name`.
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

    // Index of the wall of a patch; throws NW_UNKNOWN_WALL if there is none.
    std::uint32_t find_wall(const std::string& name) const {
        const char* c_name = detail::c_text(name, NW_UNKNOWN_WALL, "the wall's name");
        std::uint32_t wall = 0;
        detail::check(nw_model_find_wall(raw_, c_name, &wall), "wall '" + name + "'");
        return wall;
    }

    // The same without exceptions: returns whether there is one, and if so sets `wall`.
    bool find_wall(const std::string& name, std::uint32_t& wall) const noexcept {
        return name.find('\0') == std::string::npos &&
               nw_model_find_wall(raw_, name.c_str(), &wall) == NW_OK;
    }

    // Names of the inputs that the model file declares, in the order of nw_impact.extra.
    std::vector<std::string> extra_inputs() const {
        std::uint32_t count = 0;
        detail::check(nw_extra_input_count(raw_, &count), std::string("nw_extra_input_count"));
        std::vector<std::string> names;
        for (std::uint32_t i = 0; i < count; ++i) {
            detail::message m;
            detail::check(nw_extra_input_name(raw_, i, m.text, sizeof(m.text)),
                          std::string("nw_extra_input_name"));
            names.push_back(m.text);
        }
        return names;
    }

    // Value where the entry of nw_impact.extra is NaN; NaN if the model file states none.
    double extra_input_default(std::uint32_t index) const {
        double value = 0;
        detail::check(nw_extra_input_default(raw_, index, &value), std::string("nw_extra_input_default"));
        return value;
    }

    // Words of an input of words, the value of each being its place; empty for a number.
    std::vector<std::string> extra_input_words(std::uint32_t index) const {
        std::vector<std::string> words;
        detail::message m;
        while (nw_extra_input_word(raw_, index, static_cast<std::uint32_t>(words.size()), m.text,
                                   sizeof(m.text)) == NW_OK) {
            words.push_back(m.text);
        }
        return words;
    }

    // Value of a text, a number or one of the input's words; throws with the known words.
    double extra_input_value(std::uint32_t index, const std::string& text) const {
        const char* c_text = detail::c_text(text, NW_BAD_STATE, "the value");
        double value = 0;
        detail::message m;
        detail::check(nw_extra_input_value(raw_, index, c_text, &value, m.text, sizeof(m.text)), m);
        return value;
    }

    // Resolves one impact; throws if it is invalid.
    nw_outcome resolve(const nw_impact& impact) const {
        nw_outcome outcome = make_outcome();
        detail::check(nw_resolve(raw_, &impact, &outcome), std::string("nw_resolve"));
        return outcome;
    }

    // The same without exceptions; `outcome` (from make_outcome) is untouched on failure.
    nw_status resolve(const nw_impact& impact, nw_outcome& outcome) const noexcept {
        return nw_resolve(raw_, &impact, &outcome);
    }

    // Why an impact cannot be decided; empty if it can be.
    std::string explain(const nw_impact& impact) const {
        detail::message m;
        const nw_status status = nw_explain(raw_, &impact, m.text, sizeof(m.text));
        return status == NW_OK ? std::string() : m.text[0] ? m.text : nw_status_text(status);
    }

    // What a marked impact uses outside of its stated range, one thing a line; empty if all ranges are kept.
    std::string beyond(const nw_impact& impact) const {
        detail::message m;
        detail::check(nw_beyond(raw_, &impact, m.text, sizeof(m.text)), std::string("nw_beyond"));
        return m.text;
    }

    // Density [kg/m3] of the particle's material, which is taken where the impact's `rho_p` is 0; no exceptions.
    nw_status particle_density(const nw_impact& impact, double& density) const noexcept {
        return nw_particle_density(raw_, &impact, &density);
    }

    // Volume of wall [m3] that particles of a total `mass` [kg] remove by impacts like this one; no exceptions.
    nw_status erosion(const nw_impact& impact, double mass, double& volume) const noexcept {
        return nw_erosion(raw_, &impact, mass, &volume);
    }

    // The initial deposit of a wall in the model file; throws for an unknown wall.
    nw_deposit initial_deposit(std::uint32_t wall, double voidage) const {
        nw_deposit deposit = make_deposit(wall);
        detail::check(nw_deposit_initial(raw_, voidage, &deposit), std::string("nw_deposit_initial"));
        return deposit;
    }

    // Sets the thicknesses and the coverage of an impact on a deposit, with a share `voidage` of
    // voids in the powder; no exceptions.
    nw_status apply_deposit(const nw_deposit& deposit, double voidage, nw_impact& impact) const noexcept {
        return nw_deposit_apply(raw_, &deposit, voidage, &impact);
    }

    // Adds a captured particle, its `mass` per wall area [kg/m2] and its `density` [kg/m3]; no exceptions.
    nw_status add_captured(const nw_impact& impact, double mass, double density,
                           nw_deposit_source& source) const noexcept {
        return nw_deposit_source_add(raw_, &impact, mass, density, &source);
    }

    // The steady temperatures of a wall under a deposit, with a share `voidage` of voids in fresh
    // powder; no exceptions.
    nw_status heat(const nw_deposit& deposit, double voidage, const nw_wall_cooling& cooling,
                   nw_wall_heat& found) const noexcept {
        return nw_deposit_heat(raw_, &deposit, voidage, &cooling, &found);
    }

    // Heat [J/kg] that a captured particle brings to the surface, with its heat capacity [J/(kg K)] or 0; no exceptions.
    nw_status heat_brought(const nw_impact& impact, double heat_capacity, double& heat) const noexcept {
        return nw_heat_brought(raw_, &impact, heat_capacity, &heat);
    }

    // Heat [J] that one particle gives to the wall while it touches it and rebounds; no exceptions.
    nw_status contact_heat(const nw_impact& impact, double& heat) const noexcept {
        return nw_contact_heat(raw_, &impact, &heat);
    }

    // Advances a deposit by a step of a `duration` [s] and sets what each process took from it; no exceptions.
    nw_status advance(const nw_deposit_surroundings& surroundings, double duration, nw_deposit& deposit,
                      nw_deposit_losses& losses) const noexcept {
        return nw_deposit_advance(raw_, &surroundings, nullptr, duration, &deposit, &losses);
    }

    // As advance, on a cooled wall, whose deposit melts, freezes and sinters.
    nw_status advance(const nw_deposit_surroundings& surroundings, const nw_wall_cooling& cooling,
                      double duration, nw_deposit& deposit, nw_deposit_losses& losses) const noexcept {
        return nw_deposit_advance(raw_, &surroundings, &cooling, duration, &deposit, &losses);
    }

    // Processes that act on a wall, one bit for each of processes(); throws for an unknown wall.
    std::uint32_t wall_processes(std::uint32_t wall) const {
        std::uint32_t found = 0;
        detail::check(nw_wall_processes(raw_, wall, &found), std::string("nw_wall_processes"));
        return found;
    }

    // Mean speed [m/s] at which the melt of a deposit runs down a wall of `T_w` [K]; no exceptions.
    nw_status film_velocity(const nw_deposit& deposit, double T_w, double gravity_along,
                            double& velocity) const noexcept {
        return nw_film_velocity(raw_, &deposit, T_w, gravity_along, &velocity);
    }

    // The same for melt through which a heat flux [W/m2] flows to a cooled wall; `T_surface` [K]; no exceptions.
    nw_status film_velocity(const nw_deposit& deposit, double T_surface, double heat_flux, double gravity_along,
                            double& velocity) const noexcept {
        return nw_cooled_film_velocity(raw_, &deposit, T_surface, heat_flux, gravity_along, &velocity);
    }

    // Resolves arrays of impacts; throws batch_error for the first invalid one, with no outcome written.
    void resolve_batch(const nw_impacts& impacts, const nw_outcomes& outcomes) const {
        std::size_t first_bad = SIZE_MAX;
        const nw_status status = resolve_batch(impacts, outcomes, first_bad);
        if (status != NW_OK && first_bad != SIZE_MAX) {
            throw batch_error(status, first_bad);
        }
        detail::check(status, std::string("nw_resolve_batch"));
    }

    // The same without exceptions; sets `first_bad` to the first invalid impact.
    nw_status resolve_batch(const nw_impacts& impacts, const nw_outcomes& outcomes,
                            std::size_t& first_bad) const noexcept {
        return nw_resolve_batch(raw_, &impacts, &outcomes, &first_bad);
    }

    // Resolves impacts with a wall, seed and key each; throws batch_error for the first invalid one.
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

    // Characteristic velocities of an impact's particle and wall, with random draws at their median.
    velocities speeds(const nw_impact& impact) const {
        velocities found = velocities();
        detail::check(nw_speeds(raw_, &impact, &found.adhesive, &found.yield, &found.sticking),
                      std::string("nw_speeds"));
        return found;
    }

    // Lowest and highest temperature [K] for which the properties of particle and wall are defined.
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

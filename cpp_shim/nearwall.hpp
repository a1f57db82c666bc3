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
// Licence: MIT OR Apache-2.0, as the library it wraps.
#ifndef NEARWALL_HPP
#define NEARWALL_HPP

#include "nearwall.h"

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

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

// A loaded model. Moves, does not copy; share it by reference or smart pointer.
class model {
public:
    // From a TOML file.
    static model from_file(const std::string& path) {
        nw_model* raw = nullptr;
        detail::message m;
        detail::check(nw_model_load(path.c_str(), &raw, m.text, sizeof(m.text)), m);
        return model(raw);
    }

    // From TOML text; `name` stands for the file in messages.
    static model from_toml(const std::string& text, const std::string& name = "model") {
        nw_model* raw = nullptr;
        detail::message m;
        detail::check(
            nw_model_parse(text.data(), text.size(), name.c_str(), &raw, m.text, sizeof(m.text)), m);
        return model(raw);
    }

    model(model&& other) noexcept : raw_(other.raw_) { other.raw_ = nullptr; }

    model& operator=(model&& other) noexcept {
        std::swap(raw_, other.raw_);
        return *this;
    }

    model(const model&) = delete;
    model& operator=(const model&) = delete;

    ~model() { nw_model_free(raw_); }

    // Index of a wall; throws NW_UNKNOWN_WALL when the model has none of that name.
    std::uint32_t find_wall(const std::string& name) const {
        std::uint32_t wall = 0;
        detail::check(nw_model_find_wall(raw_, name.c_str(), &wall), "wall '" + name + "'");
        return wall;
    }

    // The same, asking: true and `wall` set when there is one.
    bool find_wall(const std::string& name, std::uint32_t& wall) const noexcept {
        return nw_model_find_wall(raw_, name.c_str(), &wall) == NW_OK;
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

    // The C handle, still owned by this object; null after being moved from.
    const nw_model* get() const noexcept { return raw_; }

private:
    explicit model(nw_model* raw) noexcept : raw_(raw) {}

    nw_model* raw_;
};

}  // namespace nearwall

#endif  // NEARWALL_HPP

// nearwall.hpp in a C++11 program: loads, asks one by one, in a batch and from eight threads, and
// catches what is thrown.
//
//     shim FOLDER
//
// FOLDER has 0.toml and the raw nw_impact structs 0.bin; the outcomes go to outcomes.bin.
#include "nearwall.hpp"

#include <cmath>
#include <cstring>
#include <fstream>
#include <iostream>
#include <memory>
#include <thread>

namespace {

const int THREADS = 8;

std::vector<nw_impact> read_impacts(const std::string& path) {
    std::ifstream file(path.c_str(), std::ios::binary);
    std::vector<nw_impact> impacts;
    nw_impact impact;
    while (file.read(reinterpret_cast<char*>(&impact), sizeof(impact))) {
        impacts.push_back(impact);
    }
    return impacts;
}

bool same(const std::vector<nw_outcome>& a, const std::vector<nw_outcome>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(nw_outcome)) == 0;
}

// What `body` throws: the status, or NW_OK for nothing.
template <class Body>
nw_status thrown(Body body) {
    try {
        body();
        return NW_OK;
    } catch (const nearwall::error& fault) {
        return std::strlen(fault.what()) > 10 ? fault.status() : -1;
    }
}

#define REQUIRE(condition)                                                 \
    if (!(condition)) {                                                    \
        std::cerr << "line " << __LINE__ << ": " #condition << std::endl;  \
        return 1;                                                          \
    }

int faults(const nearwall::model& model, std::vector<nw_impact> impacts) {
    REQUIRE(thrown([] { nearwall::model::from_file("/nowhere/at/all"); }) == NW_FILE);
    REQUIRE(thrown([] { nearwall::model::from_toml("x = "); }) == NW_MODEL);
    REQUIRE(thrown([] { nearwall::model::from_toml("x = \"\xff\""); }) == NW_NOT_UTF8);
    REQUIRE(thrown([&] { model.find_wall("roof"); }) == NW_UNKNOWN_WALL);
    REQUIRE(thrown([&] { model.find_wall("\xff"); }) == NW_NOT_UTF8);
    nw_impact hot = nearwall::make_impact();
    hot.T_w = 900;
    hot.wall = model.find_wall("quenchRing");
    REQUIRE(thrown([&] { model.resolve(hot); }) == NW_OUT_OF_RANGE);
    REQUIRE(thrown([&] { model.speeds(hot); }) == NW_OUT_OF_RANGE);
    impacts[3].d = 0;
    impacts[5].wall = 99;
    try {
        model.resolve_batch(impacts);
        return 1;
    } catch (const nearwall::batch_error& fault) {
        REQUIRE(fault.index() == 3 && fault.status() == NW_BAD_STATE);
    }
    return 0;
}

int arrays(const nearwall::model& model) {
    std::vector<double> v_n(10, 2.0), e_n(10, -1.0);
    const nw_impacts impacts = nearwall::make_impacts(v_n.size(), v_n.data());
    nw_outcomes outcomes = nearwall::make_outcomes();
    outcomes.e_n = e_n.data();
    v_n[7] = -1.0;
    try {
        model.resolve_batch(impacts, outcomes);
        return 1;
    } catch (const nearwall::batch_error& fault) {
        REQUIRE(fault.index() == 7 && e_n == std::vector<double>(10, -1.0));
    }
    v_n[7] = 2.0;
    model.resolve_batch(impacts, outcomes);
    nw_impact one = nearwall::make_impact();
    one.v_n = 2.0;
    REQUIRE(e_n == std::vector<double>(10, model.resolve(one).e_n));
    model.resolve_batch(nearwall::make_impacts(0, nullptr), nearwall::make_outcomes());
    REQUIRE(thrown([&] { model.resolve_batch(nearwall::make_impacts(1, nullptr), outcomes); }) == NW_NULL_POINTER);
    return 0;
}

// One char of 60 um and 1000 kg/m3 on each square millimetre: its projected area, and twice its volume as a layer.
int deposit(const nearwall::model& model) {
    nw_impact impact = nearwall::make_impact();
    impact.wall = model.find_wall("slag");
    impact.v_n = 1;
    impact.d = 60e-6;
    impact.T_p = impact.T_w = 1000;
    const double volume = 3.14159265358979 / 6 * 60e-6 * 60e-6 * 60e-6 * 1e6;
    nw_deposit_source source = nearwall::make_deposit_source();
    REQUIRE(model.add_captured(impact, 1000 * volume, 1000, source) == NW_OK);
    nw_deposit deposit = nearwall::make_deposit(impact.wall);
    REQUIRE(nearwall::add(source, deposit) == NW_OK);
    REQUIRE(model.apply_deposit(deposit, 0.5, impact) == NW_OK);
    REQUIRE(std::fabs(deposit.cover / (3.14159265358979 / 4 * 60e-6 * 60e-6 * 1e6) - 1) < 1e-13);
    REQUIRE(std::fabs(impact.layer_thickness / (2 * volume) - 1) < 1e-13);
    double velocity = -1;
    REQUIRE(model.film_velocity(deposit, 1600, 9.81, velocity) == NW_OK && velocity == 0);
    REQUIRE(model.apply_deposit(deposit, 1, impact) == NW_BAD_STATE);
    REQUIRE(model.initial_deposit(impact.wall, 0.5).cover == 0);
    REQUIRE(thrown([&] { model.initial_deposit(99, 0.5); }) == NW_UNKNOWN_WALL);
    nw_wall_cooling cooling = nearwall::make_wall_cooling();
    nw_wall_heat heat = nearwall::make_wall_heat();
    REQUIRE(model.heat(deposit, 0.5, cooling, heat) == NW_BAD_STATE && heat.surface_temperature == 0);
    cooling.coolant_temperature = 600;
    cooling.gas_temperature = 1600;
    cooling.gas_coefficient = 100;
    // The back of the deposit has the temperature of the coolant: only the deposit and the gas resist.
    REQUIRE(model.heat(deposit, 0.5, cooling, heat) == NW_OK && std::fabs(heat.wall_temperature - 600) < 1e-9);
    REQUIRE(std::fabs(heat.heat_flux * (heat.deposit_resistance + 0.01) - 1000) < 1e-9);
    const nw_deposit before = deposit;
    nw_deposit_surroundings around = nearwall::make_deposit_surroundings(0.5);
    nw_deposit_losses losses = nearwall::make_deposit_losses();
    around.gravity_along = 9.81;
    around.draw = 0.5;
    REQUIRE(model.advance(around, cooling, 60, deposit, losses) == NW_OK && deposit.powder == before.powder);
    around.draw = 1;
    REQUIRE(model.advance(around, cooling, 60, deposit, losses) == NW_BAD_STATE);
    // This model has no table of adhesion.
    around = nearwall::make_deposit_surroundings(0.5);
    around.gas_density = 1.2;
    around.kinematic_viscosity = 1.5e-5;
    around.shear_down = 12000;
    REQUIRE(model.advance(around, 60, deposit, losses) == NW_OK && deposit.powder == before.powder);
    around.gas_density = 0;
    REQUIRE(deposit.resuspended == 0 && model.advance(around, 60, deposit, losses) == NW_BAD_STATE);
    const std::vector<nearwall::process> all = nearwall::processes();
    std::string names;
    for (std::size_t i = 0; i < all.size(); ++i) {
        REQUIRE(losses.mass[i] == 0);
        if (model.wall_processes(impact.wall) >> i & 1) names += all[i].name + " ";
    }
    REQUIRE(names == "melting sintering " && all[3].loss == "resuspended" && all[0].loss.empty());
    return 0;
}

// Inputs that a model file declares: e_n = 0.5 + 0.2 humidity, e_t = 0.76, or 0.66 on glass.
int extra_inputs(const nearwall::model& without) {
    const nearwall::model model = nearwall::model::from_toml(
        "[particle]\nmaterial = \"montan-wax\"\n[walls.default]\nmaterial = \"pyrex\"\n"
        "[normal]\nmodel = \"constant\"\ne_n = 0.5\n[tangential]\nmodel = \"constant\"\ne_t = 0.76\n"
        "[inputs.humidity]\ndefault = 0.4\n[inputs.plate]\nlabels = [\"steel\", \"glass\"]\n"
        "[[effects]]\nkind = \"fitted-curve\"\ninput = \"humidity\"\non = \"e_n\"\nknots = [0, 1]\nvalues = [0, 0.2]\n"
        "[[effects]]\nkind = \"fitted-curve\"\ninput = \"plate\"\non = \"e_t\"\nknots = [\"steel\", \"glass\"]\n"
        "values = [0, -0.1]\n");
    const std::vector<std::string> names = model.extra_inputs();
    REQUIRE(names.size() == 2 && names[0] == "humidity" && names[1] == "plate");
    REQUIRE(without.extra_inputs().empty());
    REQUIRE(model.extra_input_words(0).empty() && model.extra_input_words(1).at(1) == "glass");
    REQUIRE(model.extra_input_default(0) == 0.4 && std::isnan(model.extra_input_default(1)));
    REQUIRE(thrown([&] { model.extra_input_default(2); }) == NW_UNKNOWN_INPUT);
    REQUIRE(thrown([&] { model.extra_input_value(1, "glas"); }) == NW_BAD_STATE);
    nw_impact impact = nearwall::make_impact();
    impact.v_n = impact.v_t = 2.0;
    REQUIRE(std::fabs(model.resolve(impact).e_n - 0.58) < 1e-15 && std::fabs(model.resolve(impact).e_t - 0.76) < 1e-15);
    impact.extra[0] = 0.9;
    impact.extra[1] = model.extra_input_value(1, "glass");
    REQUIRE(std::fabs(model.resolve(impact).e_n - 0.68) < 1e-15 && std::fabs(model.resolve(impact).e_t - 0.66) < 1e-15);
    return 0;
}

}  // namespace

int main(int argc, char** argv) try {
    REQUIRE(argc == 2);
    const std::string folder = argv[1];
    const std::shared_ptr<const nearwall::model> model =
        std::make_shared<const nearwall::model>(nearwall::model::from_file(folder + "/0.toml"));
    const std::vector<nw_impact> impacts = read_impacts(folder + "/0.bin");
    REQUIRE(impacts.size() > 10);

    const std::vector<nw_outcome> outcomes = model->resolve_batch(impacts);
    std::vector<std::vector<nw_outcome>> found(THREADS);
    std::vector<std::thread> threads;
    for (int t = 0; t < THREADS; ++t) {
        threads.push_back(std::thread([&, t] { found[static_cast<std::size_t>(t)] = model->resolve_batch(impacts); }));
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
    for (const std::vector<nw_outcome>& each : found) {
        REQUIRE(same(each, outcomes));
    }
    REQUIRE(faults(*model, impacts) == 0);
    REQUIRE(arrays(*model) == 0);
    REQUIRE(deposit(*model) == 0);
    REQUIRE(extra_inputs(*model) == 0);

    std::ofstream file((folder + "/outcomes.bin").c_str(), std::ios::binary);
    file.write(reinterpret_cast<const char*>(outcomes.data()),
               static_cast<std::streamsize>(outcomes.size() * sizeof(nw_outcome)));
    std::cout << impacts.size() << " impacts, " << THREADS << " threads" << std::endl;
    return 0;
} catch (const std::exception& fault) {
    std::cerr << fault.what() << std::endl;
    return 1;
}

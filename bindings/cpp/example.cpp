// Resolves the impacts of a file, all at once from arrays, in C++11 or later.
//
//     c++ -std=c++11 example.cpp $(pkg-config --cflags --libs nearwall) -o example
//     ./example nearWall.toml impacts.csv
//
// The table has the columns v_n,v_t,d,T_p,T_w (SI units) and one header line; more pairs of model and table may follow.
// Prints e_n, e_t, the capture probability and 1 (captured) or 0 for each impact.
#include <nearwall.hpp>

#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

struct table {
    std::vector<double> v_n, v_t, d, T_p, T_w;
};

table read(const std::string& path) {
    std::ifstream file(path);
    std::string line;
    if (!std::getline(file, line)) {
        throw std::runtime_error(path + " cannot be read");
    }
    table rows;
    while (std::getline(file, line)) {
        std::size_t start = 0;
        for (std::vector<double>* column : {&rows.v_n, &rows.v_t, &rows.d, &rows.T_p, &rows.T_w}) {
            const std::size_t comma = line.find(',', start);
            column->push_back(std::stod(line.substr(start, comma - start)));
            start = comma + 1;
        }
    }
    return rows;
}

void decide(const std::string& model_file, const std::string& table_file) {
    const nearwall::model model = nearwall::model::from_file(model_file);
    const table rows = read(table_file);
    const std::size_t count = rows.v_n.size();

    nw_impacts impacts = nearwall::make_impacts(count, rows.v_n.data());
    impacts.wall = model.find_wall("default");
    impacts.seed = 1;  // and each impact's key is its index
    impacts.v_t = rows.v_t.data();
    impacts.d = rows.d.data();
    impacts.T_p = rows.T_p.data();
    impacts.T_w = rows.T_w.data();

    std::vector<double> e_n(count), e_t(count), p_stick(count);
    std::vector<std::uint32_t> stuck(count);
    nw_outcomes outcomes = nearwall::make_outcomes();
    outcomes.e_n = e_n.data();
    outcomes.e_t = e_t.data();
    outcomes.p_stick = p_stick.data();
    outcomes.stuck = stuck.data();
    model.resolve_batch(impacts, outcomes);

    for (std::size_t i = 0; i < count; ++i) {
        std::printf("%.17g %.17g %.17g %u\n", e_n[i], e_t[i], p_stick[i], static_cast<unsigned>(stuck[i]));
    }
}

}  // namespace

int main(int argc, char** argv) {
    try {
        for (int i = 1; i + 1 < argc; i += 2) {
            decide(argv[i], argv[i + 1]);
        }
    } catch (const std::exception& fault) {
        std::fprintf(stderr, "%s\n", fault.what());
        return 1;
    }
    return 0;
}

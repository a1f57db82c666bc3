// Included before everything (-include) where tests/hard asks whether UBSan sees the code that cxx
// generates: overflows an integer in that file, and in that file alone, when the program starts.
#include <climits>
#include <cstring>

static int planted() {
    volatile int most = INT_MAX;
    return std::strstr(__BASE_FILE__, "lib.rs.cc") ? most + 1 : 0;
}
static const int planted_value = planted();

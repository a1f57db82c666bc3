// What rustc's thread sanitizer calls and that of older GCC does not have: they end in functions that GCC's watches.
#include <cstddef>
#include <cstring>

extern "C" {
void* __tsan_memcpy(void* to, const void* from, std::size_t size);
void* __tsan_memmove(void* to, const void* from, std::size_t size);
void* __tsan_memset(void* to, int byte, std::size_t size);

void* __tsan_memcpy(void* to, const void* from, std::size_t size) { return std::memcpy(to, from, size); }
void* __tsan_memmove(void* to, const void* from, std::size_t size) { return std::memmove(to, from, size); }
void* __tsan_memset(void* to, int byte, std::size_t size) { return std::memset(to, byte, size); }
}

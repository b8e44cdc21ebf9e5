// Loaded before a program: no block of 3 MiB or more can be had, as where memory is short.
#include <cstdlib>
#include <new>

[[gnu::visibility("default")]] void* operator new(std::size_t size) {
  constexpr std::size_t least_refused = std::size_t{3} << 20;
  void* const block = size < least_refused ? std::malloc(size) : nullptr;
  if (block == nullptr) throw std::bad_alloc();
  return block;
}

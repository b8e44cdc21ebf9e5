// Loaded before a program: aligned blocks of 2 MiB or more cannot be had. Mesa's llvmpipe asks for textures so, and
// says GL_OUT_OF_MEMORY.
#include <cerrno>
#include <cstdlib>

extern "C" [[gnu::visibility("default")]] int posix_memalign(void** block, std::size_t alignment, std::size_t size) {
  constexpr std::size_t least_refused = std::size_t{2} << 20;
  if (size >= least_refused) return ENOMEM;
  *block = std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
  return *block == nullptr ? ENOMEM : 0;
}

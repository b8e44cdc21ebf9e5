// A Vulkan driver that crashes at its first call.
#include <cstdlib>

extern "C" [[gnu::visibility("default")]] void* vk_icdGetInstanceProcAddr(void*, const char*) { std::abort(); }

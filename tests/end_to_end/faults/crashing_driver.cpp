// A Vulkan driver that crashes as soon as it is asked for anything.
#include <cstdlib>

extern "C" [[gnu::visibility("default")]] void* vk_icdGetInstanceProcAddr(void*, const char*) { std::abort(); }

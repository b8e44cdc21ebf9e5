// Loaded before a program: its OpenGL context is lost at the first query of an error, as if the GPU was reset.
#include <dlfcn.h>

#include <string_view>

namespace {

unsigned context_lost() { return 0x0507; }  // OpenGL 4.5, section 2.3.1

}  // namespace

extern "C" [[gnu::visibility("default")]] auto eglGetProcAddress(const char* name) -> void (*)() {
  if (std::string_view(name) == "glGetError") return reinterpret_cast<void (*)()>(context_lost);
  using Find = void (*(*)(const char*))();
  return reinterpret_cast<Find>(dlsym(RTLD_NEXT, "eglGetProcAddress"))(name);
}

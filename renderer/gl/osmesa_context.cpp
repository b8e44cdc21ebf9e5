// A context by OSMesa, Mesa's off-screen software library, opened at run time so that a machine may lack it.
#include <dlfcn.h>

#include <array>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/core/error.hpp"
#include "renderer/gl/native_context.hpp"

namespace footprint::gl {
namespace {

// Declared by hand: <GL/osmesa.h> includes <GL/gl.h>, which clashes with <GL/glcorearb.h>.
using OsMesaHandle = struct OsMesaContextTag*;
using CreateContextAttribs = OsMesaHandle (*)(const int* attributes, OsMesaHandle share);
using DestroyContext = void (*)(OsMesaHandle context);
using MakeCurrent = unsigned char (*)(OsMesaHandle context, void* buffer, unsigned type, int width, int height);
using GetProcAddress = auto(*)(const char* function) -> void (*)();
constexpr int osmesa_format = 0x22, osmesa_rgba = 0x1908;
constexpr int osmesa_profile = 0x33, osmesa_core_profile = 0x34;
constexpr int osmesa_major_version = 0x36, osmesa_minor_version = 0x37;
constexpr unsigned gl_unsigned_byte = 0x1401;
constexpr int buffer_side = 16;

[[noreturn]] void fail(const std::string& message) {
  throw Error(ErrorKind::machine, "OSMesa", message,
              "install libosmesa6, which Mesa has no more from 25.1 on, or use --backend egl");
}

/// libOSMesa.so.8 and the functions of it that are used here. Never unloaded: the LLVM within keeps per-thread state
/// that outlives the contexts.
class Library {
 public:
  /// Throws Error (machine): the library or one of the functions is not there; the next call tries again.
  static const Library& instance() {
    static const Library library;
    return library;
  }

  CreateContextAttribs create_context = nullptr;
  DestroyContext destroy_context = nullptr;
  MakeCurrent make_current = nullptr;
  GetProcAddress get_proc_address = nullptr;

 private:
  Library() : library_(dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE)) {
    if (library_ == nullptr) fail(dlerror());
    find(create_context, "OSMesaCreateContextAttribs");
    find(destroy_context, "OSMesaDestroyContext");
    find(make_current, "OSMesaMakeCurrent");
    find(get_proc_address, "OSMesaGetProcAddress");
  }

  template <class Function>
  void find(Function& function, const char* name) {
    function = reinterpret_cast<Function>(dlsym(library_, name));
    if (function == nullptr) fail(std::string("libOSMesa.so.8 lacks ") + name);
  }

  void* library_;
};

/// Hides GALLIUM_DRIVER where it names a driver other than OSMesa's own two, as long as it lives: OSMesa of Mesa 22.3
/// takes any driver's word for it, and crashes on those that need a device (zink).
class OwnDriverOnly {
 public:
  OwnDriverOnly() {
    const char* named = std::getenv(variable);
    if (named == nullptr || std::string_view(named) == "llvmpipe" || std::string_view(named) == "softpipe") return;
    hidden_ = named;
    unsetenv(variable);
  }
  OwnDriverOnly(const OwnDriverOnly&) = delete;
  OwnDriverOnly& operator=(const OwnDriverOnly&) = delete;
  ~OwnDriverOnly() {
    if (hidden_) setenv(variable, hidden_->c_str(), 1);
  }

 private:
  static constexpr const char* variable = "GALLIUM_DRIVER";
  std::optional<std::string> hidden_;
};

OsMesaHandle create_context(const Library& library) {
  constexpr std::array<int, 9> attributes = {osmesa_format,
                                             osmesa_rgba,
                                             osmesa_profile,
                                             osmesa_core_profile,
                                             osmesa_major_version,
                                             4,
                                             osmesa_minor_version,
                                             5,
                                             0};
  const OwnDriverOnly own_driver_only;
  OsMesaHandle context = library.create_context(attributes.data(), nullptr);
  if (context == nullptr) fail("the library gives no OpenGL 4.5 core context");
  return context;
}

}  // namespace

NativeContext open_osmesa() {
  const Library& library = Library::instance();
  const std::shared_ptr<OsMesaContextTag> context(create_context(library), library.destroy_context);
  // OSMesa insists on a default framebuffer; nothing draws into it.
  const auto buffer = std::make_shared<std::vector<unsigned char>>(std::size_t{4} * buffer_side * buffer_side);
  const auto make_current = [&library, context, buffer] {
    if (library.make_current(context.get(), buffer->data(), gl_unsigned_byte, buffer_side, buffer_side) == 0)
      fail("the context cannot be made current");
  };
  return {make_current, [&library] { library.make_current(nullptr, nullptr, 0, 0, 0); }, library.get_proc_address};
}

}  // namespace footprint::gl

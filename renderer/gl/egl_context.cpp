// Contexts by EGL without a window system: the surfaceless platform and the device platform.
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <fmt/format.h>

#include <array>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/core/error.hpp"
#include "renderer/gl/native_context.hpp"

namespace footprint::gl {
namespace {

constexpr const char* install_hint = "install libegl1 and a driver: libgl1-mesa-dri for software, or the GPU's own";

std::string egl_error_name() {
  static constexpr std::array<std::string_view, 15> names = {
      "EGL_SUCCESS",       "EGL_NOT_INITIALIZED", "EGL_BAD_ACCESS",        "EGL_BAD_ALLOC",
      "EGL_BAD_ATTRIBUTE", "EGL_BAD_CONFIG",      "EGL_BAD_CONTEXT",       "EGL_BAD_CURRENT_SURFACE",
      "EGL_BAD_DISPLAY",   "EGL_BAD_MATCH",       "EGL_BAD_NATIVE_PIXMAP", "EGL_BAD_NATIVE_WINDOW",
      "EGL_BAD_PARAMETER", "EGL_BAD_SURFACE",     "EGL_CONTEXT_LOST"};
  const EGLint code = eglGetError();
  const auto index = static_cast<std::size_t>(code - EGL_SUCCESS);
  return index < names.size() ? std::string(names[index]) : fmt::format("EGL error {:#x}", code);
}

[[noreturn]] void fail(const std::string& platform, const std::string& message) {
  throw Error(ErrorKind::machine, platform, message, install_hint);
}

/// Whether the extensions of `display` (EGL_NO_DISPLAY: the client's) have `name`.
bool has_extension(EGLDisplay display, std::string_view name) {
  const char* list = eglQueryString(display, EGL_EXTENSIONS);
  if (list == nullptr) return false;
  // Whole words: one extension's name may begin another's.
  return fmt::format(" {} ", list).find(fmt::format(" {} ", name)) != std::string::npos;
}

void require_extension(EGLDisplay display, const std::string& platform, std::string_view name) {
  if (!has_extension(display, name)) fail(platform, fmt::format("the EGL library lacks {}", name));
}

/// How many contexts use each display. EGL gives every caller the same display and ends it at the first eglTerminate,
/// contexts of others included, so the last user alone may call that.
class DisplayUsers {
 public:
  static DisplayUsers& instance() {
    static DisplayUsers users;
    return users;
  }

  void add(EGLDisplay display, const std::string& platform) {
    const std::scoped_lock lock(mutex_);
    EGLint major = 0, minor = 0;
    if (eglInitialize(display, &major, &minor) == EGL_FALSE) {
      fail(platform, fmt::format("the display does not initialise ({})", egl_error_name()));
    }
    if (major == 1 && minor < 5) {
      if (!counts_.contains(display)) eglTerminate(display);
      fail(platform, fmt::format("EGL 1.5 is needed, the driver has {}.{}", major, minor));
    }
    ++counts_[display];
  }

  void remove(EGLDisplay display) {
    const std::scoped_lock lock(mutex_);
    if (--counts_[display] > 0) return;
    counts_.erase(display);
    if (!FOOTPRINT_KEEP_EGL_DISPLAYS) eglTerminate(display);
  }

 private:
  std::mutex mutex_;
  std::map<EGLDisplay, int> counts_;
};

/// One use of a display.
class Display {
 public:
  Display(EGLenum kind, void* native, const std::string& platform)
      : display_(eglGetPlatformDisplay(kind, native, nullptr)) {
    if (display_ == EGL_NO_DISPLAY) fail(platform, fmt::format("no such display ({})", egl_error_name()));
    DisplayUsers::instance().add(display_, platform);
  }
  Display(const Display&) = delete;
  Display& operator=(const Display&) = delete;
  ~Display() { DisplayUsers::instance().remove(display_); }
  [[nodiscard]] EGLDisplay get() const { return display_; }

 private:
  EGLDisplay display_;
};

EGLContext create_context(EGLDisplay display, const std::string& platform) {
  require_extension(display, platform, "EGL_KHR_surfaceless_context");
  // EGL requests window surfaces by default, which these platforms lack.
  constexpr std::array<EGLint, 5> wanted = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                            EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (eglChooseConfig(display, wanted.data(), &config, 1, &count) == EGL_FALSE || count == 0) {
    fail(platform, "the driver has no configuration for OpenGL");
  }
  if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) fail(platform, "the driver has no desktop OpenGL");
  constexpr std::array<EGLint, 9> attributes = {EGL_CONTEXT_MAJOR_VERSION,
                                                4,
                                                EGL_CONTEXT_MINOR_VERSION,
                                                5,
                                                EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                                EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                                EGL_CONTEXT_OPENGL_DEBUG,
                                                EGL_TRUE,
                                                EGL_NONE};
  const EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, attributes.data());
  if (context == EGL_NO_CONTEXT) {
    fail(platform, fmt::format("the driver gives no OpenGL 4.5 core context ({})", egl_error_name()));
  }
  return context;
}

NativeContext open_egl(EGLenum kind, void* native, const std::string& platform) {
  const auto display = std::make_shared<const Display>(kind, native, platform);
  const std::shared_ptr<void> context(create_context(display->get(), platform),
                                      [display](EGLContext created) { eglDestroyContext(display->get(), created); });
  const auto make_current = [=](EGLContext wanted) {
    eglBindAPI(EGL_OPENGL_API);
    return eglMakeCurrent(display->get(), EGL_NO_SURFACE, EGL_NO_SURFACE, wanted);
  };
  const auto require_current = [=] {
    if (make_current(context.get()) == EGL_FALSE)
      fail(platform, fmt::format("the context cannot be made current ({})", egl_error_name()));
  };
  return {require_current, [=] { make_current(EGL_NO_CONTEXT); }, eglGetProcAddress};
}

std::vector<EGLDeviceEXT> egl_devices() {
  // EGL_EXT_device_base is the older name of enumeration and query together; NVIDIA's driver lists it alone.
  if (!has_extension(EGL_NO_DISPLAY, "EGL_EXT_device_base"))
    require_extension(EGL_NO_DISPLAY, "EGL device", "EGL_EXT_device_enumeration");
  require_extension(EGL_NO_DISPLAY, "EGL device", "EGL_EXT_platform_device");
  const auto query = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
  EGLint count = 0;
  if (query(0, nullptr, &count) == EGL_FALSE) {
    fail("EGL device", fmt::format("the devices cannot be listed ({})", egl_error_name()));
  }
  std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
  if (count > 0 && query(count, devices.data(), &count) == EGL_FALSE) {
    fail("EGL device", fmt::format("the devices cannot be listed ({})", egl_error_name()));
  }
  devices.resize(static_cast<std::size_t>(count));
  return devices;
}

}  // namespace

NativeContext open_egl_surfaceless() {
  const std::string platform = "EGL surfaceless";
  require_extension(EGL_NO_DISPLAY, platform, "EGL_MESA_platform_surfaceless");
  return open_egl(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, platform);
}

NativeContext open_egl_device(int device) {
  const auto devices = egl_devices();
  if (devices.empty()) fail("EGL device", "the machine has no EGL device");
  if (device < 0 || static_cast<std::size_t>(device) >= devices.size()) {
    throw Error(ErrorKind::usage, fmt::format("EGL device {}", device),
                fmt::format("no such device; there are {}, counted from 0", devices.size()),
                "`footprint info` lists them");
  }
  return open_egl(EGL_PLATFORM_DEVICE_EXT, devices[static_cast<std::size_t>(device)],
                  fmt::format("EGL device {}", device));
}

int egl_device_count() { return static_cast<int>(egl_devices().size()); }

}  // namespace footprint::gl

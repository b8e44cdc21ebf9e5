// What the window-system side of a context must do; internal to renderer/gl.
#pragma once

#include <memory>

namespace footprint::gl {

/// A 4.5 core context of one backend, with debug output if the backend supports it. Release it before destruction if it
/// is current.
class NativeContext {
 public:
  NativeContext() = default;
  NativeContext(const NativeContext&) = delete;
  NativeContext& operator=(const NativeContext&) = delete;
  virtual ~NativeContext() = default;

  /// Throws Error{machine}.
  virtual void make_current() = 0;
  /// Leaves the calling thread without a context; this context must be the current one.
  virtual void release() noexcept = 0;
  /// The address of a GL function; not null does not mean that the context has the function.
  [[nodiscard]] virtual auto address_of(const char* function) const -> void (*)() = 0;
};

/// All three throw Error (machine) with the reason; open_egl_device also Error (usage): no such index.
[[nodiscard]] std::unique_ptr<NativeContext> open_egl_surfaceless();
[[nodiscard]] std::unique_ptr<NativeContext> open_egl_device(int device);
[[nodiscard]] std::unique_ptr<NativeContext> open_osmesa();

/// How many EGL devices the machine has. Throws Error (machine): EGL cannot list devices here.
[[nodiscard]] int egl_device_count();

}  // namespace footprint::gl

// What the window-system side of a context must do; internal to renderer/gl.
#pragma once

#include <functional>

#include "renderer/gl/functions.hpp"

namespace footprint::gl {

/// A 4.5 core context of one backend, with debug output if the backend supports it. Release it before destruction if it
/// is current.
struct NativeContext {
  std::function<void()> make_current;  ///< throws Error (machine)
  std::function<void()> release;       ///< leaves the calling thread without a context; it must be the current one
  AddressOf address_of;                ///< not null does not mean that the context has the function
};

/// All three throw Error (machine) with the reason; open_egl_device also Error (usage): no such index.
[[nodiscard]] NativeContext open_egl_surfaceless();
[[nodiscard]] NativeContext open_egl_device(int device);
[[nodiscard]] NativeContext open_osmesa();

/// How many EGL devices the machine has. Throws Error (machine): EGL cannot list devices here.
[[nodiscard]] int egl_device_count();

}  // namespace footprint::gl

// A headless OpenGL 4.5 core context, and the messages of its debug output.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/core/names.hpp"

namespace footprint::gl {

/// Errors and messages of high severity since the last `take`. It must outlive its context.
class DebugLog {
 public:
  DebugLog() = default;
  DebugLog(const DebugLog&) = delete;
  DebugLog& operator=(const DebugLog&) = delete;

  /// Listens to the current context synchronously, so that messages come from the faulty call.
  void listen();
  /// Stores a message; only the first few, because an error in a loop would fill the memory.
  void add(std::string message);
  [[nodiscard]] std::vector<std::string> take();

 private:
  DebugLog* const self_ = this;  // GL passes a pointer to const to its callback; this one is writable
  std::vector<std::string> messages_;
  std::size_t dropped_ = 0;
};

/// "GL_INVALID_ENUM" for 0x0500, and so on.
[[nodiscard]] std::string gl_error_name(unsigned code);

enum class Backend { egl, egl_device, osmesa };

/// The names of backends; `auto` is none.
inline constexpr std::array<Word<std::optional<Backend>>, 4> backend_words{{
    {std::nullopt, "auto"},
    {Backend::egl, "egl"},
    {Backend::egl_device, "egl-device"},
    {Backend::osmesa, "osmesa"},
}};

[[nodiscard]] constexpr std::string_view backend_name(Backend backend) {
  return word_for(backend_words, std::optional(backend));
}

/// The properties of a context.
struct ContextInfo {
  Backend backend = Backend::egl;
  std::string vendor, renderer, version, glsl_version;
  int max_texture_size = 0;
  int max_framebuffer_size = 0;  ///< the smaller of the largest viewport and renderbuffer, texels per side
  int max_uniform_block_bytes = 0;
  int max_texture_units = 0;  ///< for the fragment stage
  int max_anisotropy = 1;     ///< of a sampler; 1: no anisotropic filter
  bool software = false;      ///< is_software_renderer; timer queries are meaningless there
};

/// Whether a GL_RENDERER draws on the CPU: Mesa's software drivers, also below a translating driver (zink over
/// lavapipe, D3D12 over Microsoft's), SwiftShader, OpenSWR, and names with "software".
[[nodiscard]] bool is_software_renderer(std::string_view renderer);

/// The requested context. The order of backends is fixed, so equal requests give equal backends on the same machine. To
/// use a GPU that only egl_device reaches, request egl_device explicitly.
struct ContextRequest {
  std::optional<Backend> backend;  ///< none: the first of egl, egl_device, osmesa that works
  int device = 0;                  ///< egl_device only: index in `footprint info`'s list
};

/// A context, current on its thread until it is destroyed or another becomes current. KHR_debug is on and synchronous;
/// messages of high severity or of type error are collected.
class Context {
 public:
  /// Throws Error (machine): each tried backend with its reason; or a limited address space is nearly full, in which
  /// drivers may crash. (usage): no such device, or a device other than 0 for a backend without devices. After an error
  /// the previous context is still current.
  explicit Context(const ContextRequest& request);
  Context(Context&&) noexcept;
  Context& operator=(Context&&) noexcept;
  ~Context();

  [[nodiscard]] const ContextInfo& info() const;
  void make_current() const;

  /// The KHR_debug errors since the last call.
  [[nodiscard]] std::vector<std::string> take_debug_errors() const;
  /// Throws Error (machine) with the collected KHR_debug errors, if any.
  /// doing: the activity, for the message.
  void check(std::string_view doing) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// A line of `footprint info`: a backend, or an EGL device, with its context or the reason why there is none.
struct BackendReport {
  Backend backend = Backend::egl;
  int device = 0;
  std::optional<ContextInfo> info;
  std::string why_not;
};

/// Tries every backend and every EGL device.
[[nodiscard]] std::vector<BackendReport> probe_backends();

}  // namespace footprint::gl

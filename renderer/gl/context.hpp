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

/// Errors and messages of high severity since the last `take`. Must outlive the context that it listens to.
class DebugLog {
 public:
  DebugLog() = default;
  DebugLog(const DebugLog&) = delete;
  DebugLog& operator=(const DebugLog&) = delete;

  /// Listens to the current context, synchronously: a message comes from within the call that is at fault.
  void listen();
  /// Keeps a message; only the first few, since a bad call in a loop would fill the memory.
  void add(std::string message);
  [[nodiscard]] std::vector<std::string> take();

 private:
  DebugLog* const self_ = this;  // GL hands its callback a pointer to const; the log behind this one can be written
  std::vector<std::string> messages_;
  std::size_t dropped_ = 0;
};

/// "GL_INVALID_ENUM" for 0x0500, and so on.
[[nodiscard]] std::string gl_error_name(unsigned code);

enum class Backend { egl, egl_device, osmesa };

/// As users write them; `auto` is none.
inline constexpr std::array<Word<std::optional<Backend>>, 4> backend_words{{
    {std::nullopt, "auto"},
    {Backend::egl, "egl"},
    {Backend::egl_device, "egl-device"},
    {Backend::osmesa, "osmesa"},
}};

[[nodiscard]] constexpr std::string_view backend_name(Backend backend) {
  return word_for(backend_words, std::optional(backend));
}

/// What a context says of itself.
struct ContextInfo {
  Backend backend = Backend::egl;
  std::string vendor, renderer, version, glsl_version;
  int max_texture_size = 0;
  int max_framebuffer_size = 0;  ///< the smaller of the largest viewport and renderbuffer, texels per side
  int max_uniform_block_bytes = 0;
  int max_texture_units = 0;  ///< for the fragment stage
  int max_anisotropy = 1;     ///< probes of a sampler; 1: it has no anisotropic filter
  bool software = false;      ///< is_software_renderer: timer queries mean nothing there
};

/// Whether a GL_RENDERER draws on the processor: Mesa's software drivers, also below one that translates (zink over
/// lavapipe, D3D12 over Microsoft's), SwiftShader, OpenSWR, and what calls itself software.
[[nodiscard]] bool is_software_renderer(std::string_view renderer);

/// Which context is wanted. The order is fixed, so that the same request gives the same backend on the same machine: a
/// user who wants a GPU that only egl_device reaches asks for egl_device, though egl gives a software renderer.
struct ContextRequest {
  std::optional<Backend> backend;  ///< none: the first of egl, egl_device, osmesa that works
  int device = 0;                  ///< for egl_device alone: index into `footprint info`'s list
};

/// A context, current on the thread that made it until destroyed or another is made current. KHR_debug is on and
/// synchronous: messages of severity high or of type error are collected.
class Context {
 public:
  /// Throws Error (machine): says for each backend that was tried why it is not there; too little is left of a limited
  /// address space, in which a driver may crash instead of failing; (usage): no such device, or a device other than 0
  /// for a backend that has none. What was current before stays so after an error.
  explicit Context(const ContextRequest& request);
  Context(Context&&) noexcept;
  Context& operator=(Context&&) noexcept;
  ~Context();

  [[nodiscard]] const ContextInfo& info() const;
  void make_current() const;

  /// The KHR_debug errors since the last call; empty when all is well.
  [[nodiscard]] std::vector<std::string> take_debug_errors() const;
  /// Throws Error{machine} with the collected KHR_debug errors, if any; `doing` names what was being done.
  void check(std::string_view doing) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// One line of `footprint info`: a backend (each EGL device has its own line) with its context or why it is not there.
struct BackendReport {
  Backend backend = Backend::egl;
  int device = 0;
  std::optional<ContextInfo> info;
  std::string why_not;
};

/// Tries every backend and every EGL device.
[[nodiscard]] std::vector<BackendReport> probe_backends();

}  // namespace footprint::gl

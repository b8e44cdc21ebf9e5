// Collects what KHR_debug reports for one context; internal to renderer/gl.
#pragma once

#include <string>
#include <vector>

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

}  // namespace footprint::gl

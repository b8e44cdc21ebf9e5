// How long a stretch of GL work takes.
#pragma once

#include <chrono>

#include "renderer/gl/context.hpp"
#include "renderer/gl/objects.hpp"

namespace footprint::gl {

/// Measures the GL work between `begin` and `end_ms`: by a GL_TIME_ELAPSED query on a GPU, by wall clock around
/// glFinish on a software renderer, whose queries see the last tile alone. One measurement at a time in a context.
class FrameTimer {
 public:
  /// For the current context, whose `info` this is.
  explicit FrameTimer(const ContextInfo& info);

  void begin();
  /// Waits for the work; milliseconds since `begin`.
  [[nodiscard]] double end_ms();

 private:
  Query query_;  ///< owns nothing on a software renderer
  std::chrono::steady_clock::time_point start_;
};

}  // namespace footprint::gl

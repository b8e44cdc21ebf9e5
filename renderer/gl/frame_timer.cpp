// A GL_TIME_ELAPSED query; on a software renderer the wall clock between two calls of glFinish.
#include "renderer/gl/frame_timer.hpp"

namespace footprint::gl {

FrameTimer::FrameTimer(const ContextInfo& info) {
  if (info.software) return;
  GLuint name = 0;
  api().CreateQueries(GL_TIME_ELAPSED, 1, &name);
  query_ = Query(name);
}

void FrameTimer::begin() {
  if (query_) {
    api().BeginQuery(GL_TIME_ELAPSED, query_.name());
    return;
  }
  api().Finish();
  start_ = std::chrono::steady_clock::now();
}

double FrameTimer::end_ms() {
  if (query_) {
    api().EndQuery(GL_TIME_ELAPSED);
    GLuint64 nanoseconds = 0;
    api().GetQueryObjectui64v(query_.name(), GL_QUERY_RESULT, &nanoseconds);
    return 1e-6 * static_cast<double>(nanoseconds);
  }
  api().Finish();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count();
}

}  // namespace footprint::gl

// Keeps messages that are errors or of high severity, a few dozen at most, and counts the rest.
#include "renderer/gl/debug_log.hpp"

#include <fmt/format.h>

#include <string_view>
#include <utility>

#include "renderer/gl/functions.hpp"

namespace footprint::gl {
namespace {

constexpr std::size_t max_messages = 32;

void APIENTRY on_message(GLenum /*source*/, GLenum type, GLuint /*id*/, GLenum severity, GLsizei length,
                         const GLchar* text, const void* user) noexcept {
  if (type != GL_DEBUG_TYPE_ERROR && severity != GL_DEBUG_SEVERITY_HIGH) return;
  const std::string_view message = length < 0 ? std::string_view(text) : std::string_view(text, length);
  (*static_cast<DebugLog* const*>(user))->add(std::string(message));
}

}  // namespace

void DebugLog::listen() {
  const Functions& gl = api();
  gl.Enable(GL_DEBUG_OUTPUT);
  gl.Enable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  gl.DebugMessageCallback(on_message, &self_);
  gl.DebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DEBUG_SEVERITY_NOTIFICATION, 0, nullptr, GL_FALSE);
  // Program asks for the compiler's log itself and throws it.
  gl.DebugMessageControl(GL_DEBUG_SOURCE_SHADER_COMPILER, GL_DONT_CARE, GL_DONT_CARE, 0, nullptr, GL_FALSE);
}

void DebugLog::add(std::string message) {
  while (!message.empty() && (message.back() == '\n' || message.back() == '\0')) message.pop_back();
  if (messages_.size() < max_messages) {
    messages_.push_back(std::move(message));
  } else {
    ++dropped_;
  }
}

std::vector<std::string> DebugLog::take() {
  if (dropped_ > 0) messages_.push_back(fmt::format("and {} more", std::exchange(dropped_, 0)));
  return std::exchange(messages_, {});
}

std::string gl_error_name(unsigned code) {
  switch (code) {
    case GL_NO_ERROR:
      return "GL_NO_ERROR";
    case GL_INVALID_ENUM:
      return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE:
      return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION:
      return "GL_INVALID_OPERATION";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
      return "GL_INVALID_FRAMEBUFFER_OPERATION";
    case GL_OUT_OF_MEMORY:
      return "GL_OUT_OF_MEMORY";
    case GL_CONTEXT_LOST:
      return "GL_CONTEXT_LOST: the driver was reset";
    default:
      return fmt::format("GL error {:#06x}", code);
  }
}

}  // namespace footprint::gl

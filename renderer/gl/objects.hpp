// RAII owners of OpenGL objects. The context that created an object must be current, also at destruction, or be gone
// with no other one current. Functions come from gl/functions.hpp.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "renderer/gl/context.hpp"
#include "renderer/gl/functions.hpp"

namespace footprint::gl {

/// Owns a GL name. Movable, not copyable; 0 owns nothing.
/// Create, Delete: members of Functions, for one object each or for several.
template <auto Create, auto Delete>
class Handle {
 public:
  Handle() = default;
  /// A new object.
  /// kind: the first argument of Create, such as a texture's target, if it has one.
  template <class... Kind>
  [[nodiscard]] static Handle make(Kind... kind) {
    Handle made;
    if constexpr (std::is_invocable_r_v<GLuint, decltype(std::declval<Functions>().*Create), Kind...>) {
      made.name_ = (api().*Create)(kind...);
    } else {
      (api().*Create)(kind..., 1, &made.name_);
    }
    return made;
  }
  Handle(Handle&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    // A context takes its objects with it, so a name that outlives every context is gone already.
    if (name_ == 0 || !has_current_context()) return;
    if constexpr (std::is_invocable_v<decltype(std::declval<Functions>().*Delete), GLuint>) {
      (api().*Delete)(name_);
    } else {
      (api().*Delete)(1, &name_);
    }
  }
  [[nodiscard]] GLuint name() const { return name_; }
  [[nodiscard]] explicit operator bool() const { return name_ != 0; }

 private:
  GLuint name_ = 0;
};

using VertexArray = Handle<&Functions::CreateVertexArrays, &Functions::DeleteVertexArrays>;
using Sampler = Handle<&Functions::CreateSamplers, &Functions::DeleteSamplers>;
using Query = Handle<&Functions::CreateQueries, &Functions::DeleteQueries>;
using Framebuffer = Handle<&Functions::CreateFramebuffers, &Functions::DeleteFramebuffers>;
using BufferName = Handle<&Functions::CreateBuffers, &Functions::DeleteBuffers>;
using TextureName = Handle<&Functions::CreateTextures, &Functions::DeleteTextures>;
using ProgramName = Handle<&Functions::CreateProgram, &Functions::DeleteProgram>;

/// Linear magnification, linear minification within and between mip levels.
/// wrap_s, wrap_t: GL_REPEAT, GL_CLAMP_TO_EDGE, ...
/// probes: of its anisotropic filter, at most ContextInfo::max_anisotropy.
[[nodiscard]] Sampler trilinear_sampler(GLenum wrap_s, GLenum wrap_t, int probes = 1);

/// Nearest texel of the nearest level.
[[nodiscard]] Sampler nearest_sampler(GLenum wrap_s, GLenum wrap_t);

/// Compares a reference with the four nearest texels of a depth texture (1 if it is not greater) and blends the
/// results; outside of the texture they are 1.
[[nodiscard]] Sampler comparing_sampler();

/// A buffer of constant size.
class Buffer {
 public:
  enum class Content { constant, changing };

  Buffer() = default;
  /// bytes: copied; an empty span gives 16 zero bytes, because GL has no empty buffers.
  /// use: `changing` can be written again.
  /// Throws Error (machine): out of memory.
  explicit Buffer(std::span<const std::byte> bytes, Content use = Content::constant);
  /// Replaces all content. Throws std::logic_error: the buffer is constant or of another size.
  void write(std::span<const std::byte> bytes) const;
  [[nodiscard]] GLuint name() const { return handle_.name(); }

 private:
  BufferName handle_;
  std::size_t writable_bytes_ = 0;
};

/// A 2D texture, or an array of them, with immutable storage.
class Texture {
 public:
  Texture() = default;
  /// internal_format: sized, such as GL_RGBA32F.
  /// layers: 0 for a plain 2D texture.
  /// Throws Error (machine): over the GL limits, out of memory.
  Texture(GLenum internal_format, int width, int height, int levels = 1, int layers = 0);
  /// texels: rows from v = 0, tightly packed, layer after layer.
  /// format, type: as for glTextureSubImage2D.
  void upload(int level, int width, int height, GLenum format, GLenum type, const void* texels);
  /// Uploads a level of a plain texture in a compressed format: its blocks of 4 x 4 texels.
  void upload_blocks(int level, int width, int height, GLenum internal_format, std::span<const std::uint8_t> blocks);
  [[nodiscard]] GLuint name() const { return handle_.name(); }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }

 private:
  TextureName handle_;
  int width_ = 0, height_ = 0, layers_ = 0;
};

/// Colour textures to draw into, with an optional 32-bit float depth buffer.
class RenderTarget {
 public:
  RenderTarget() = default;
  /// At most 5 colour formats. Throws Error (machine): as Texture, or the driver cannot draw into these together.
  RenderTarget(int width, int height, std::span<const GLenum> color_formats, bool depth);
  [[nodiscard]] GLuint framebuffer() const { return framebuffer_.name(); }
  [[nodiscard]] const Texture& color(std::size_t attachment) const { return colors_[attachment]; }
  [[nodiscard]] const Texture& depth() const { return depth_; }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  /// Reads channels x width x height floats of an attachment, the row of window y = 0 first. Binds framebuffer 0 for
  /// reading. Throws std::logic_error: `out` has another size.
  void read(std::size_t attachment, int channels, std::span<float> out) const;

 private:
  static constexpr std::size_t max_attachments = 5;
  Framebuffer framebuffer_;
  std::array<Texture, max_attachments> colors_;
  Texture depth_;
  int width_ = 0, height_ = 0;
};

/// Draws three vertices that cover the viewport.
class ScreenTriangle {
 public:
  /// program: the current one, whose vertex stage needs no attributes.
  void draw() const;
  /// Into the first width x height texels of `target`, without depth test and culling.
  void draw_into(const RenderTarget& target, int width, int height) const;

 private:
  VertexArray no_vertices_ = VertexArray::make();
};

/// sampler: 0 for the texture's own.
void bind_texture(GLuint unit, const Texture& texture, GLuint sampler = 0);

/// The smallest line number that a compiler's log names; 0: it names none.
[[nodiscard]] int smallest_line_in(std::string_view log);

/// A linked program.
class Program {
 public:
  Program() = default;
  /// Throws Error (machine): the compiler's log with the offending source lines and their numbers.
  /// name: of the program, for messages.
  Program(const std::string& name, std::string_view vertex_source, std::string_view fragment_source);
  /// A compute program.
  Program(const std::string& name, std::string_view compute_source);
  [[nodiscard]] GLuint name() const { return handle_.name(); }

  /// An active uniform that is not in a block.
  struct Uniform {
    GLenum type = 0;
    GLint location = -1;
  };
  /// By name, found when the program was linked. An array is listed as `name` and as each `name[i]`.
  [[nodiscard]] const std::map<std::string, Uniform, std::less<>>& uniforms() const { return uniforms_; }
  /// A uniform's location; -1 if it is not active, because compilers may remove it.
  [[nodiscard]] GLint uniform(std::string_view uniform_name) const;
  /// The texts of a raster program.
  [[nodiscard]] const std::string& vertex_source() const { return vertex_; }
  [[nodiscard]] const std::string& fragment_source() const { return fragment_; }

 private:
  std::string vertex_, fragment_;
  ProgramName handle_;
  std::map<std::string, Uniform, std::less<>> uniforms_;
};

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

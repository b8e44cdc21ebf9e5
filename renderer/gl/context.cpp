// Tries the backends in order, makes a context current, and checks versions and limits.
#include "renderer/gl/context.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string_view>
#include <thread>
#include <utility>

#include "renderer/core/error.hpp"
#include "renderer/core/memory.hpp"
#include "renderer/core/names.hpp"
#include "renderer/gl/functions.hpp"
#include "renderer/gl/native_context.hpp"

namespace footprint::gl {
namespace {

constexpr std::size_t max_messages = 32;

void APIENTRY on_message(GLenum /*source*/, GLenum type, GLuint /*id*/, GLenum severity, GLsizei length,
                         const GLchar* text, const void* user) noexcept {
  if (type != GL_DEBUG_TYPE_ERROR && severity != GL_DEBUG_SEVERITY_HIGH) return;
  const std::string_view message = length < 0 ? std::string_view(text) : std::string_view(text, length);
  (*static_cast<DebugLog* const*>(user))->add(std::string(message));
}

/// The order in which `auto` tries them.
constexpr std::array<Backend, 3> all_backends = {Backend::egl, Backend::egl_device, Backend::osmesa};

/// The current context of a thread, tracked because GL has one per thread.
struct Current {
  const NativeContext* native = nullptr;
  const Functions* functions = nullptr;
};
thread_local Current current;

/// Makes `next` current. The one before is released first, because EGL and OSMesa do not know of each other and each
/// would take its own for current still.
void switch_to(Current next) {
  if (current.native == next.native) return;
  const Current before = std::exchange(current, {});
  if (before.native != nullptr) before.native->release();
  if (next.native == nullptr) return;
  next.native->make_current();
  current = next;
}

/// Makes a previous context current again. If that fails, api() reports that none is current.
void restore(const Current& before) noexcept {
  try {
    switch_to(before);
  } catch (const Error&) {
    return;
  }
}

std::string text(GLenum name) {
  const GLubyte* value = api().GetString(name);
  return value == nullptr ? std::string() : std::string(reinterpret_cast<const char*>(value));
}

int integer(GLenum name) {
  GLint value = 0;
  api().GetIntegerv(name, &value);
  return value;
}

bool has_extension(std::string_view name) {
  for (GLuint i = 0; i < static_cast<GLuint>(integer(GL_NUM_EXTENSIONS)); ++i) {
    if (name == reinterpret_cast<const char*>(api().GetStringi(GL_EXTENSIONS, i))) return true;
  }
  return false;
}

/// The properties of the current context.
ContextInfo describe(Backend backend) {
  ContextInfo info;
  info.backend = backend;
  info.vendor = text(GL_VENDOR);
  info.renderer = text(GL_RENDERER);
  info.version = text(GL_VERSION);
  info.glsl_version = text(GL_SHADING_LANGUAGE_VERSION);
  info.max_texture_size = integer(GL_MAX_TEXTURE_SIZE);
  std::array<GLint, 2> viewport{};
  api().GetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport.data());
  info.max_framebuffer_size = std::min({viewport[0], viewport[1], integer(GL_MAX_RENDERBUFFER_SIZE)});
  info.max_uniform_block_bytes = integer(GL_MAX_UNIFORM_BLOCK_SIZE);
  info.max_texture_units = integer(GL_MAX_TEXTURE_IMAGE_UNITS);
  if (has_extension("GL_EXT_texture_filter_anisotropic") || has_extension("GL_ARB_texture_filter_anisotropic"))
    info.max_anisotropy = integer(GL_MAX_TEXTURE_MAX_ANISOTROPY);
  info.software = is_software_renderer(info.renderer);
  return info;
}

NativeContext open_native(Backend backend, int device) {
  if (backend == Backend::osmesa) return open_osmesa();
  return backend == Backend::egl ? open_egl_surfaceless() : open_egl_device(device);
}

}  // namespace

void DebugLog::listen() {
  const Functions& gl = api();
  gl.Enable(GL_DEBUG_OUTPUT);
  gl.Enable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  gl.DebugMessageCallback(on_message, &self_);
  gl.DebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DEBUG_SEVERITY_NOTIFICATION, 0, nullptr, GL_FALSE);
  // Program reads and throws the compiler's log itself.
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
  static constexpr std::array<Word<unsigned>, 10> names{{
      {GL_NO_ERROR, "GL_NO_ERROR"},
      {GL_INVALID_ENUM, "GL_INVALID_ENUM"},
      {GL_INVALID_VALUE, "GL_INVALID_VALUE"},
      {GL_INVALID_OPERATION, "GL_INVALID_OPERATION"},
      {GL_INVALID_FRAMEBUFFER_OPERATION, "GL_INVALID_FRAMEBUFFER_OPERATION"},
      {GL_OUT_OF_MEMORY, "GL_OUT_OF_MEMORY"},
      {GL_CONTEXT_LOST, "GL_CONTEXT_LOST: the driver was reset"},
      {GL_FRAMEBUFFER_UNSUPPORTED, "GL_FRAMEBUFFER_UNSUPPORTED"},
      {GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT, "GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT"},
      {GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT, "GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT"},
  }};
  const auto* const found = std::ranges::find(names, code, &Word<unsigned>::value);
  return found != names.end() ? std::string(found->name) : fmt::format("GL error {:#06x}", code);
}

bool is_software_renderer(std::string_view renderer) {
  // zink names the Vulkan device that it draws by: lavapipe calls its own "llvmpipe", as "zink (llvmpipe (LLVM ...))".
  constexpr std::array<std::string_view, 9> names = {"llvmpipe",   "lavapipe",    "softpipe", "swrast",
                                                     "openswr",    "swiftshader", "software", "basic render driver",
                                                     "gdi generic"};
  const std::string lower = lower_case(std::string(renderer));
  return std::ranges::any_of(names, [&](std::string_view name) { return lower.find(name) != std::string::npos; });
}

const Functions& api() {
  if (current.functions == nullptr) throw std::logic_error("an OpenGL call where no context is current");
  return *current.functions;
}

bool has_current_context() noexcept { return current.functions != nullptr; }

namespace {

// Mesa 22.3's llvmpipe does not look whether its allocations succeed: where `ulimit -v` leaves it too little,
// eglCreateContext writes through null pointers, or frees what it never got (docs/reference/command-line.md). What it
// takes was measured with 1, 2, 4 and 8 threads: 385, 528, 816 and 1201 MiB until the context is there, and 100 for the
// first frame. Each thread comes with a heap of its own.
void require_address_space() {
  constexpr std::uint64_t mebibyte = 1 << 20, at_least = 512 * mebibyte, a_thread = 160 * mebibyte;
  constexpr unsigned most_threads = 16;  // of llvmpipe
  const auto space = limited_address_space();
  const std::uint64_t threads = std::clamp(std::thread::hardware_concurrency(), 1U, most_threads);
  const std::uint64_t needed = at_least + threads * a_thread;
  if (!space || space->left >= needed) return;
  throw Error(ErrorKind::machine, "OpenGL",
              fmt::format("it needs up to {} of address space to draw by {} threads, and {} is left of the {} that "
                          "`ulimit -v` grants",
                          readable_bytes(needed), threads, readable_bytes(space->left), readable_bytes(space->limit)),
              "raise the limit, or lift it with `ulimit -v unlimited`");
}

// Whether a folder is there or could be made: the nearest one that exists can be written to.
bool can_be_made(std::filesystem::path folder) {
  std::error_code unknown;
  while (!folder.empty() && !std::filesystem::exists(folder, unknown) && folder != folder.parent_path())
    folder = folder.parent_path();
  return access(folder.c_str(), W_OK | X_OK) == 0;
}

// Switches Mesa's cache of shaders off where its folder cannot be made: Mesa 25.0 prints a line on standard error then.
void leave_out_unusable_shader_cache() {
  if (std::getenv("MESA_SHADER_CACHE_DISABLE") != nullptr) return;
  for (const auto& [variable, below] :
       {std::pair{"MESA_SHADER_CACHE_DIR", ""}, {"XDG_CACHE_HOME", ""}, {"HOME", ".cache"}}) {
    const char* const folder = std::getenv(variable);
    if (folder == nullptr || *folder == '\0') continue;
    if (!can_be_made(std::filesystem::path(folder) / below)) setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
    return;
  }
}

}  // namespace

struct Context::Impl {
  // The log and the table come first: the context may use them until it is gone.
  DebugLog log;
  Functions functions;
  ContextInfo info;
  NativeContext native;

  Impl(Backend backend, int device) : native(open_native(backend, device)) {
    try {
      become_current();
      load(backend);
    } catch (...) {
      leave();
      throw;
    }
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl() { leave(); }

  [[nodiscard]] bool is_current() const { return current.native == &native; }
  void become_current() const { switch_to({&native, &functions}); }
  void leave() const {
    if (is_current()) switch_to({});
  }

  void load(Backend backend) {
    // OSMesa has some functions of GL_ARB_robustness only under their old names.
    const auto missing = load_functions(functions, [this](const char* name) {
      const auto address = native.address_of(name);
      return address != nullptr ? address : native.address_of((std::string(name) + "ARB").c_str());
    });
    const auto place = fmt::format("OpenGL by {}", backend_name(backend));
    // A loader may hand out an address for a function that the driver lacks, so the version has the last word.
    const int version =
        functions.GetIntegerv == nullptr ? 0 : 10 * integer(GL_MAJOR_VERSION) + integer(GL_MINOR_VERSION);
    if (version < 45) {
      throw Error(ErrorKind::machine, place,
                  fmt::format("version 4.5 is needed, not {}.{}", version / 10, version % 10),
                  "use a newer driver or another backend");
    }
    if (!missing.empty()) {
      throw Error(ErrorKind::machine, place, fmt::format("the driver lacks {}", fmt::join(missing, ", ")),
                  "use a newer driver or another backend");
    }
    log.listen();
    functions.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);  // for reversed depth, which -1 to 1 would round away
    info = describe(backend);
  }

  /// The first backend that works.
  static std::unique_ptr<Impl> open_any() {
    std::string reasons;
    for (const Backend backend : all_backends) {
      try {
        return std::make_unique<Impl>(backend, 0);
      } catch (const Error& error) {
        reasons += fmt::format("{}{}: {}", reasons.empty() ? "" : "; ", backend_name(backend), error.message());
      }
    }
    throw Error(ErrorKind::machine, "OpenGL", "no backend gives an OpenGL 4.5 core context: " + reasons,
                "for software OpenGL install libegl1 and libgl1-mesa-dri");
  }
};

Context::Context(const ContextRequest& request) {
  if (request.device != 0 && request.backend != Backend::egl_device) {
    throw Error(ErrorKind::usage, fmt::format("device {}", request.device), "only the backend egl-device has devices",
                "choose `--backend egl-device`");
  }
  require_address_space();
  leave_out_unusable_shader_cache();
  const Current before = current;
  try {
    impl_ = request.backend ? std::make_unique<Impl>(*request.backend, request.device) : Impl::open_any();
  } catch (...) {
    restore(before);
    throw;
  }
}

Context::Context(Context&&) noexcept = default;
Context& Context::operator=(Context&&) noexcept = default;
Context::~Context() = default;

const ContextInfo& Context::info() const { return impl_->info; }

void Context::make_current() const { impl_->become_current(); }

std::vector<std::string> Context::take_debug_errors() const {
  auto messages = impl_->log.take();
  if (!impl_->is_current()) return messages;
  // A driver may set an error flag without a message; after a message, the flag adds nothing.
  const bool silent = messages.empty();
  for (GLenum code = api().GetError(); code != GL_NO_ERROR; code = api().GetError()) {
    const bool lost = code == GL_CONTEXT_LOST;
    if (silent || lost) messages.push_back(gl_error_name(code));
    if (lost) break;  // all further calls fail
  }
  return messages;
}

void Context::check(std::string_view doing) const {
  const auto messages = take_debug_errors();
  if (messages.empty()) return;
  throw Error(ErrorKind::machine, fmt::format("OpenGL, {}", doing), fmt::format("{}", fmt::join(messages, "; ")));
}

std::vector<BackendReport> probe_backends() {
  const Current before = current;
  std::vector<BackendReport> reports;
  const auto probe = [&reports](Backend backend, int device) {
    BackendReport report{.backend = backend, .device = device, .info = {}, .why_not = {}};
    try {
      report.info = Context({.backend = backend, .device = device}).info();
    } catch (const Error& error) {
      report.why_not = error.what();
    }
    reports.push_back(std::move(report));
  };
  for (const Backend backend : all_backends) {
    // A machine without devices, or that cannot list them, gets one line with the reason.
    int devices = 1;
    if (backend == Backend::egl_device) {
      try {
        devices = std::max(1, egl_device_count());
      } catch (const Error&) {
        devices = 1;
      }
    }
    for (int device = 0; device < devices; ++device) probe(backend, device);
  }
  restore(before);
  return reports;
}

}  // namespace footprint::gl

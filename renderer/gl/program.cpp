// Compiles and links programs; a compiler's log comes with the source lines that it complains about.
#include <fmt/format.h>

#include <initializer_list>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "renderer/core/error.hpp"
#include "renderer/gl/objects.hpp"

namespace footprint::gl {
namespace {

void delete_shader(GLuint name) {
  if (has_current_context()) api().DeleteShader(name);
}
using Shader = Handle<delete_shader>;

struct Stage {
  GLenum type;
  std::string_view source;
};

std::string_view stage_name(GLenum type) {
  switch (type) {
    case GL_VERTEX_SHADER:
      return "vertex shader";
    case GL_FRAGMENT_SHADER:
      return "fragment shader";
    default:
      return "compute shader";
  }
}

/// Where the compiler takes a line to be: a source string's number (0 unless #line says otherwise) and a line in it.
using Location = std::pair<int, int>;

struct SourceLine {
  Location location;
  std::string text;
};

/// The lines of a shader with the numbers that the compiler gives them.
std::vector<SourceLine> number_lines(std::string_view source) {
  static const std::regex line_directive(R"(^\s*#\s*line\s+(\d{1,8})(?:\s+(\d{1,8}))?)");
  std::vector<SourceLine> lines;
  Location next{0, 1};
  while (!source.empty()) {
    const std::size_t length = source.find('\n');
    std::string text(source.substr(0, length));
    source.remove_prefix(length == std::string_view::npos ? source.size() : length + 1);
    std::smatch match;
    const bool renumbers = std::regex_search(text, match, line_directive);
    const Location after = renumbers
                               ? Location{match[2].matched ? std::stoi(match[2]) : next.first, std::stoi(match[1])}
                               : Location{next.first, next.second + 1};
    lines.push_back({next, std::move(text)});
    next = after;
  }
  return lines;
}

/// The places that a log names. Mesa writes "0:12(5): error", NVIDIA "0(12) : error", others "ERROR: 0:12: ".
std::set<Location> locations_in(const std::string& log) {
  static const std::regex place(R"((?:^|\n|ERROR: |WARNING: )(\d{1,8})(?::(\d{1,8})|\((\d{1,8})\)))");
  std::set<Location> locations;
  for (std::sregex_iterator match(log.begin(), log.end(), place), end; match != end; ++match) {
    const auto& line = (*match)[2].matched ? (*match)[2] : (*match)[3];
    locations.emplace(std::stoi((*match)[1]), std::stoi(line));
  }
  return locations;
}

/// `log`, then each source line that it names with its number.
std::string log_with_lines(std::string log, std::string_view source) {
  while (!log.empty() && (log.back() == '\n' || log.back() == '\0')) log.pop_back();
  const auto wanted = locations_in(log);
  for (const auto& [location, text] : number_lines(source)) {
    if (!wanted.contains(location)) continue;
    const std::string string_number = location.first == 0 ? "" : fmt::format("{}:", location.first);
    log += fmt::format("\n{:>6} | {}", string_number + std::to_string(location.second), text);
  }
  return log;
}

template <class GetLog>
std::string info_log(GLuint name, GLint length, const GetLog& get_log) {
  std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
  GLsizei written = 0;
  get_log(name, static_cast<GLsizei>(log.size()), &written, log.data());
  log.resize(static_cast<std::size_t>(written));
  return log;
}

[[noreturn]] void throw_broken(const std::string& program, std::string_view what, const std::string& log) {
  throw Error(ErrorKind::machine, fmt::format("program {}", program), fmt::format("the {}:\n{}", what, log));
}

Shader compile(const std::string& program, const Stage& stage) {
  Shader shader(api().CreateShader(stage.type));
  const GLchar* text = stage.source.data();
  const auto length = static_cast<GLint>(stage.source.size());
  api().ShaderSource(shader.name(), 1, &text, &length);
  api().CompileShader(shader.name());
  GLint compiled = GL_FALSE, log_length = 0;
  api().GetShaderiv(shader.name(), GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_TRUE) return shader;
  api().GetShaderiv(shader.name(), GL_INFO_LOG_LENGTH, &log_length);
  const std::string log = info_log(shader.name(), log_length, api().GetShaderInfoLog);
  throw_broken(program, fmt::format("{} does not compile", stage_name(stage.type)), log_with_lines(log, stage.source));
}

Handle<delete_program> link(const std::string& name, std::initializer_list<Stage> stages) {
  Handle<delete_program> program(api().CreateProgram());
  for (const Stage& stage : stages) {
    const Shader shader = compile(name, stage);
    // The program keeps an attached shader alive after its owner here has let go of it.
    api().AttachShader(program.name(), shader.name());
  }
  api().LinkProgram(program.name());
  GLint linked = GL_FALSE, log_length = 0;
  api().GetProgramiv(program.name(), GL_LINK_STATUS, &linked);
  if (linked == GL_TRUE) return program;
  api().GetProgramiv(program.name(), GL_INFO_LOG_LENGTH, &log_length);
  throw_broken(name, "stages do not link", info_log(program.name(), log_length, api().GetProgramInfoLog));
}

}  // namespace

Program::Program(const std::string& name, std::string_view vertex_source, std::string_view fragment_source)
    : handle_(link(name, {{GL_VERTEX_SHADER, vertex_source}, {GL_FRAGMENT_SHADER, fragment_source}})) {}

Program::Program(const std::string& name, std::string_view compute_source)
    : handle_(link(name, {{GL_COMPUTE_SHADER, compute_source}})) {}

GLint Program::uniform(const char* uniform_name) const { return api().GetUniformLocation(name(), uniform_name); }

}  // namespace footprint::gl

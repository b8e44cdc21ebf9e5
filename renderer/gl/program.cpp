// Compiles and links programs; a compiler's log comes with the source lines that it complains about.
#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <regex>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "renderer/core/error.hpp"
#include "renderer/core/numbers.hpp"
#include "renderer/gl/objects.hpp"

namespace footprint::gl {
namespace {

using Shader = Handle<&Functions::CreateShader, &Functions::DeleteShader>;

struct Stage {
  GLenum type;
  std::string_view source;
};

std::string_view stage_name(GLenum type) {
  if (type == GL_COMPUTE_SHADER) return "compute shader";
  return type == GL_VERTEX_SHADER ? "vertex shader" : "fragment shader";
}

/// A line by the compiler's count: the number of a source string (0 without #line) and of a line in it.
using Location = std::pair<int, int>;

struct SourceLine {
  Location location;
  std::string text;
};

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines = parts_of(text, '\n');
  if (lines.back().empty()) lines.pop_back();
  return lines;
}

int number_in(const std::ssub_match& digits) { return parse_whole_of<int>(digits.str()).value_or(0); }

/// The lines of a shader with the numbers that the compiler gives them.
std::vector<SourceLine> number_lines(std::string_view source) {
  static const std::regex directive(R"(^\s*#\s*line\s+(\d+)(?:\s+(\d+))?)");
  std::vector<SourceLine> lines;
  Location next{0, 1};
  for (const std::string& line : lines_of(source)) {
    lines.push_back({next, line});
    ++next.second;
    std::smatch match;
    if (!std::regex_search(line, match, directive)) continue;
    next.second = number_in(match[1]);
    if (match[2].matched) next.first = number_in(match[2]);
  }
  return lines;
}

/// The locations that a log names. Mesa writes "0:12(5): error", NVIDIA "0(12) : error", others "ERROR: 0:12: ".
std::set<Location> locations_in(std::string_view log) {
  static const std::regex place(R"(^\s*(?:ERROR:|WARNING:)?\s*(\d+)\s*[:(]\s*(\d+))");
  std::set<Location> locations;
  std::smatch match;
  for (const std::string& line : lines_of(log)) {
    if (std::regex_search(line, match, place)) locations.emplace(number_in(match[1]), number_in(match[2]));
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
  Shader shader = Shader::make(stage.type);
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

ProgramName link(const std::string& name, std::initializer_list<Stage> stages) {
  ProgramName program = ProgramName::make();
  for (const Stage& stage : stages) {
    const Shader shader = compile(name, stage);
    // The program keeps attached shaders alive after they are deleted here.
    api().AttachShader(program.name(), shader.name());
  }
  api().LinkProgram(program.name());
  GLint linked = GL_FALSE, log_length = 0;
  api().GetProgramiv(program.name(), GL_LINK_STATUS, &linked);
  if (linked == GL_TRUE) return program;
  api().GetProgramiv(program.name(), GL_INFO_LOG_LENGTH, &log_length);
  throw_broken(name, "stages do not link", info_log(program.name(), log_length, api().GetProgramInfoLog));
}

/// Queries all uniforms once, because drivers search names as text, which is too slow for a timed draw.
std::map<std::string, Program::Uniform, std::less<>> active_uniforms(GLuint program) {
  GLint count = 0, longest = 0;
  api().GetProgramiv(program, GL_ACTIVE_UNIFORMS, &count);
  api().GetProgramiv(program, GL_ACTIVE_UNIFORM_MAX_LENGTH, &longest);
  std::map<std::string, Program::Uniform, std::less<>> uniforms;
  for (GLint i = 0; i < count; ++i) {
    std::string name(static_cast<std::size_t>(longest), '\0');
    GLsizei length = 0;
    GLint elements = 0;
    GLenum type = 0;
    api().GetActiveUniform(program, static_cast<GLuint>(i), longest, &length, &elements, &type, name.data());
    name.resize(static_cast<std::size_t>(length));
    const auto add = [&](const std::string& uniform) {
      const GLint location = api().GetUniformLocation(program, uniform.c_str());
      if (location >= 0) uniforms.emplace(uniform, Program::Uniform{type, location});  // members of blocks have none
    };
    add(name);
    if (!name.ends_with("[0]")) continue;
    name.resize(name.size() - 3);
    add(name);
    for (GLint element = 1; element < elements; ++element) add(fmt::format("{}[{}]", name, element));
  }
  return uniforms;
}

}  // namespace

int smallest_line_in(std::string_view log) {
  const std::set<Location> locations = locations_in(log);
  return locations.empty() ? 0 : locations.begin()->second;
}

Program::Program(const std::string& name, std::string_view vertex_source, std::string_view fragment_source)
    : vertex_(vertex_source),
      fragment_(fragment_source),
      handle_(link(name, {{GL_VERTEX_SHADER, vertex_source}, {GL_FRAGMENT_SHADER, fragment_source}})),
      uniforms_(active_uniforms(handle_.name())) {}

Program::Program(const std::string& name, std::string_view compute_source)
    : handle_(link(name, {{GL_COMPUTE_SHADER, compute_source}})), uniforms_(active_uniforms(handle_.name())) {}

GLint Program::uniform(std::string_view uniform_name) const {
  const auto found = uniforms_.find(uniform_name);
  return found != uniforms_.end() ? found->second.location : -1;
}

}  // namespace footprint::gl

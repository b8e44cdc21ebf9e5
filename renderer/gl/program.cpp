// Compiles and links programs; a compiler's log comes with the source lines that it complains about.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <initializer_list>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "renderer/core/error.hpp"
#include "renderer/gl/objects.hpp"

namespace footprint::gl {
namespace {

using Shader = Handle<&Functions::CreateShader, &Functions::DeleteShader>;

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

/// A line by the compiler's count: the number of a source string (0 without #line) and of a line in it.
using Location = std::pair<int, int>;

struct SourceLine {
  Location location;
  std::string_view text;
};

/// Takes the first line off `text`, without its end.
std::string_view take_line(std::string_view& text) {
  const std::size_t length = text.find('\n');
  const std::string_view line = text.substr(0, length);
  text.remove_prefix(length == std::string_view::npos ? text.size() : length + 1);
  return line;
}

/// Takes `word` off the front of `text`, spaces before it too, if it is there.
bool take_word(std::string_view& text, std::string_view word) {
  const std::size_t start = text.find_first_not_of(" \t");
  if (start == std::string_view::npos || !text.substr(start).starts_with(word)) return false;
  text.remove_prefix(start + word.size());
  return true;
}

/// Takes a whole number off the front of `text`, spaces before it too, if there is one.
std::optional<int> take_number(std::string_view& text) {
  std::string_view rest = text;
  take_word(rest, "");
  int number = 0;
  const auto [end, failure] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
  if (failure != std::errc()) return std::nullopt;
  text = rest.substr(static_cast<std::size_t>(end - rest.data()));
  return number;
}

/// The lines of a shader with the numbers that the compiler gives them.
std::vector<SourceLine> number_lines(std::string_view source) {
  std::vector<SourceLine> lines;
  Location next{0, 1};
  while (!source.empty()) {
    const std::string_view line = take_line(source);
    lines.push_back({next, line});
    ++next.second;
    std::string_view directive = line;
    if (!take_word(directive, "#") || !take_word(directive, "line")) continue;
    next.second = take_number(directive).value_or(next.second);
    next.first = take_number(directive).value_or(next.first);
  }
  return lines;
}

/// The locations that a log names. Mesa writes "0:12(5): error", NVIDIA "0(12) : error", others "ERROR: 0:12: ".
std::set<Location> locations_in(std::string_view log) {
  std::set<Location> locations;
  while (!log.empty()) {
    std::string_view line = take_line(log);
    if (!take_word(line, "ERROR:")) take_word(line, "WARNING:");
    const auto source = take_number(line);
    if (!source || !(take_word(line, ":") || take_word(line, "("))) continue;
    if (const auto number = take_number(line)) locations.emplace(*source, *number);
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
    : handle_(link(name, {{GL_VERTEX_SHADER, vertex_source}, {GL_FRAGMENT_SHADER, fragment_source}})),
      uniforms_(active_uniforms(handle_.name())) {}

Program::Program(const std::string& name, std::string_view compute_source)
    : handle_(link(name, {{GL_COMPUTE_SHADER, compute_source}})), uniforms_(active_uniforms(handle_.name())) {}

GLint Program::uniform(std::string_view uniform_name) const {
  const auto found = uniforms_.find(uniform_name);
  return found != uniforms_.end() ? found->second.location : -1;
}

}  // namespace footprint::gl

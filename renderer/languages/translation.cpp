// Over SPIRV-Cross's C interface, of which Debian has a shared library.
#include "renderer/languages/translation.hpp"

#include <fmt/format.h>
#include <spirv_cross/spirv_cross_c.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <regex>
#include <span>
#include <sstream>
#include <vector>

#include "renderer/core/error.hpp"

namespace footprint {
namespace {

constexpr const char* uniforms = "uniforms";  // the block of all plain uniforms

struct ContextDestroyer {
  void operator()(spvc_context context) const { spvc_context_destroy(context); }
};

// One shader in SPIRV-Cross.
class Compiler {
 public:
  Compiler(const Spirv& code, spvc_backend backend) {
    spvc_context made = nullptr;
    if (spvc_context_create(&made) != SPVC_SUCCESS)
      throw Error(ErrorKind::machine, "SPIRV-Cross", "no memory", "free memory");
    context_.reset(made);
    spvc_parsed_ir parsed = nullptr;
    require(spvc_context_parse_spirv(made, code.data(), code.size(), &parsed));
    require(spvc_context_create_compiler(made, backend, parsed, SPVC_CAPTURE_MODE_TAKE_OWNERSHIP, &compiler_));
    require(spvc_compiler_create_shader_resources(compiler_, &resources_));
  }

  [[nodiscard]] spvc_compiler get() const { return compiler_; }

  [[nodiscard]] std::span<const spvc_reflected_resource> resources(spvc_resource_type type) const {
    const spvc_reflected_resource* list = nullptr;
    std::size_t count = 0;
    require(spvc_resources_get_resource_list_for_type(resources_, type, &list, &count));
    return {list, count};
  }

  void require(spvc_result result) const {
    if (result != SPVC_SUCCESS)
      throw Error(ErrorKind::machine, "SPIRV-Cross", spvc_context_get_last_error_string(context_.get()));
  }

 private:
  std::unique_ptr<std::remove_pointer_t<spvc_context>, ContextDestroyer> context_;
  spvc_compiler compiler_ = nullptr;
  spvc_resources resources_ = nullptr;
};

spvc_backend backend_of(ShaderLanguage language) {
  if (language == ShaderLanguage::hlsl) return SPVC_BACKEND_HLSL;
  return language == ShaderLanguage::msl ? SPVC_BACKEND_MSL : SPVC_BACKEND_GLSL;
}

unsigned number(const Compiler& compiler, const spvc_reflected_resource& resource, SpvDecoration decoration) {
  return spvc_compiler_get_decoration(compiler.get(), resource.id, decoration);
}

// The number of a texture among the textures: fragment_spirv binds them behind the block of uniforms.
unsigned texture_number(const Compiler& compiler, const spvc_reflected_resource& texture) {
  return number(compiler, texture, SpvDecorationBinding) - 1;
}

// Numbers textures from 0, and names the block, which has the number 0 too.
void separate_bindings(const Compiler& compiler) {
  for (const auto& each : compiler.resources(SPVC_RESOURCE_TYPE_SAMPLED_IMAGE))
    spvc_compiler_set_decoration(compiler.get(), each.id, SpvDecorationBinding, texture_number(compiler, each));
  for (const auto& each : compiler.resources(SPVC_RESOURCE_TYPE_UNIFORM_BUFFER)) {
    spvc_compiler_set_name(compiler.get(), each.id, uniforms);
    spvc_compiler_set_name(compiler.get(), each.base_type_id, "Uniforms");
  }
}

void set_options(const Compiler& compiler, ShaderLanguage language) {
  spvc_compiler_options options = nullptr;
  compiler.require(spvc_compiler_create_compiler_options(compiler.get(), &options));
  const auto set = [&](spvc_compiler_option option, unsigned value) {
    compiler.require(spvc_compiler_options_set_uint(options, option, value));
  };
  constexpr unsigned glsl_version = 450, es_version = 310, shader_model = 50;
  const bool es = language == ShaderLanguage::essl;
  if (backend_of(language) == SPVC_BACKEND_GLSL) {
    set(SPVC_COMPILER_OPTION_GLSL_VERSION, es ? es_version : glsl_version);
    set(SPVC_COMPILER_OPTION_GLSL_ES, es ? 1 : 0);
    set(SPVC_COMPILER_OPTION_GLSL_ES_DEFAULT_FLOAT_PRECISION_HIGHP, 1);
    set(SPVC_COMPILER_OPTION_GLSL_EMIT_UNIFORM_BUFFER_AS_PLAIN_UNIFORMS, 1);
  } else if (language == ShaderLanguage::hlsl) {
    set(SPVC_COMPILER_OPTION_HLSL_SHADER_MODEL, shader_model);
  } else {
    set(SPVC_COMPILER_OPTION_MSL_VERSION, SPVC_MAKE_MSL_VERSION(2, 0, 0));
    set(SPVC_COMPILER_OPTION_MSL_ENABLE_DECORATION_BINDING, 1);
  }
  compiler.require(spvc_compiler_install_compiler_options(compiler.get(), options));
}

std::string glsl_type(spvc_type type, const std::string& structure) {
  const unsigned rows = spvc_type_get_vector_size(type), columns = spvc_type_get_columns(type);
  const spvc_basetype base = spvc_type_get_basetype(type);
  if (base == SPVC_BASETYPE_SAMPLED_IMAGE) return spvc_type_get_image_arrayed(type) ? "sampler2DArray" : "sampler2D";
  if (base == SPVC_BASETYPE_STRUCT) return structure;
  if (columns > 1) return fmt::format("mat{}", columns);
  if (rows > 1) return fmt::format("{}vec{}", base == SPVC_BASETYPE_FP32 ? "" : "i", rows);
  return base == SPVC_BASETYPE_FP32 ? "float" : "int";
}

void add_members(const Compiler& compiler, const spvc_reflected_resource& block, std::vector<ShaderInput>& inputs) {
  const spvc_type type = spvc_compiler_get_type_handle(compiler.get(), block.base_type_id);
  for (unsigned i = 0; i < spvc_type_get_num_member_types(type); ++i) {
    const spvc_type member = spvc_compiler_get_type_handle(compiler.get(), spvc_type_get_member_type(type, i));
    const char* const structure = spvc_compiler_get_name(compiler.get(), spvc_type_get_base_type_id(member));
    std::string name = spvc_compiler_get_member_name(compiler.get(), block.base_type_id, i);
    if (spvc_type_get_num_array_dimensions(member) > 0)
      name += fmt::format("[{}]", spvc_type_get_array_dimension(member, 0));
    inputs.push_back({.kind = "uniform", .type = glsl_type(member, structure), .name = name});
  }
}

using Comments = std::map<std::string, std::string>;  // by "name()", "struct name" and "name.member"

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

// The key of what a line without indentation begins to define.
std::optional<std::string> defined(const std::string& line) {
  static const std::regex function(R"(^\w+ (\w+)\(.*(\)|\{|\}|,)$)"), structure(R"(^struct (\w+)( \{)?$)");
  std::smatch match;
  if (std::regex_match(line, match, structure)) return "struct " + match[1].str();
  if (std::regex_match(line, match, function)) return match[1].str() + "()";
  return std::nullopt;
}

// The key of a member of `structure`.
std::optional<std::string> member(const std::string& structure, const std::string& line, std::string& comment) {
  static const std::regex declaration(R"(^\s+[\w ]+ (\w+)(\[\w+\])?;(\s*//.*)?$)");
  std::smatch match;
  if (structure.empty() || !std::regex_match(line, match, declaration)) return std::nullopt;
  comment = match[3];
  return structure + "." + match[1].str();
}

// Follows which structure a line is in.
void enter(std::string& structure, const std::string& line) {
  constexpr std::string_view word = "struct ";
  const auto key = defined(line);
  if (key && key->starts_with(word)) structure = key->substr(word.size());
  if (line.starts_with("}")) structure.clear();
}

Comments collect_comments(const std::string& glsl) {
  Comments comments;
  std::string above, structure, beside;
  for (const std::string& line : lines_of(glsl)) {
    if (line.starts_with("//")) {
      above += line + "\n";
      continue;
    }
    if (const auto key = defined(line); key && !above.empty()) comments.try_emplace(*key, above);
    enter(structure, line);
    if (const auto key = member(structure, line, beside); key && !beside.empty()) comments.try_emplace(*key, beside);
    above.clear();
  }
  return comments;
}

}  // namespace

std::string with_comments(const std::string& text, const std::string& glsl) {
  Comments comments = collect_comments(glsl);
  const std::vector<std::string> lines = lines_of(text);
  std::string out, structure, none, attributes;  // attributes: Metal's line above a function
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string& line = lines[i];
    if (line.starts_with("static inline __attribute__")) {
      attributes = line + "\n";
      continue;
    }
    const bool is_definition = i + 1 < lines.size() && lines[i + 1] == "{";
    const auto key = is_definition ? defined(line) : std::nullopt;
    if (const auto found = comments.find(key.value_or("")); found != comments.end()) {
      out += found->second;
      comments.erase(found);
    }
    enter(structure, line);
    const auto field = member(structure, line, none);
    const auto beside = comments.find(field.value_or(""));
    out += attributes + line + (beside == comments.end() ? "" : beside->second) + "\n";
    attributes.clear();
  }
  return out;
}

std::vector<ShaderInput> shader_inputs(const Spirv& code) {
  const Compiler compiler(code, SPVC_BACKEND_NONE);
  std::vector<ShaderInput> inputs;
  const auto add = [&](spvc_resource_type kind, const char* word) {
    const std::size_t first = inputs.size();
    for (const auto& each : compiler.resources(kind)) {
      const bool is_texture = kind == SPVC_RESOURCE_TYPE_SAMPLED_IMAGE;
      const unsigned place =
          is_texture ? texture_number(compiler, each) : number(compiler, each, SpvDecorationLocation);
      const spvc_type type = spvc_compiler_get_type_handle(compiler.get(), each.type_id);
      inputs.push_back(
          {.kind = word, .type = glsl_type(type, ""), .name = each.name, .place = static_cast<int>(place)});
    }
    std::ranges::sort(std::span(inputs).subspan(first), {}, &ShaderInput::place);
  };
  add(SPVC_RESOURCE_TYPE_SAMPLED_IMAGE, "texture");
  add(SPVC_RESOURCE_TYPE_STAGE_INPUT, "attribute");
  for (const auto& block : compiler.resources(SPVC_RESOURCE_TYPE_UNIFORM_BUFFER)) add_members(compiler, block, inputs);
  add(SPVC_RESOURCE_TYPE_STAGE_OUTPUT, "output");
  return inputs;
}

std::string translate(const Spirv& code, ShaderLanguage language, const std::string& glsl) {
  const Compiler compiler(code, backend_of(language));
  separate_bindings(compiler);
  set_options(compiler, language);
  const char* text = nullptr;
  compiler.require(spvc_compiler_compile(compiler.get(), &text));
  return with_comments(text, glsl);
}

}  // namespace footprint

// The program's conditions and includes against glslang's preprocessor: with the flags as macros, both leave the same
// tokens of every shader text, whichever flags are on.
#include <fmt/format.h>
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <random>
#include <set>
#include <string>
#include <string_view>

#include "methods/registry.hpp"
#include "renderer/pipeline/shader_flags.hpp"
#include "renderer/pipeline/shader_text.hpp"

namespace footprint {

extern const EmbeddedTexts shared_glsl;

namespace {

// Gives each file once, as the program does.
class OnceIncluder : public glslang::TShader::Includer {
 public:
  explicit OnceIncluder(const ShaderModule& module) : module_(module) {}

  IncludeResult* includeLocal(const char* file, const char* /*from*/, std::size_t /*depth*/) override {
    const std::string_view text = included_.insert(file).second ? text_of(file) : "";
    return new IncludeResult(file, text.data(), text.size(), nullptr);
  }

  void releaseInclude(IncludeResult* result) override { delete result; }

 private:
  [[nodiscard]] std::string_view text_of(std::string_view file) const {
    if (file == method_module || file == module_.file) return module_.text;
    const EmbeddedText* const shared = find_text(shared_glsl, file);
    const EmbeddedText* const text = shared != nullptr ? shared : find_text(module_.folder, file);
    EXPECT_NE(text, nullptr) << file;
    return text == nullptr ? "" : text->text;
  }

  const ShaderModule& module_;
  std::set<std::string, std::less<>> included_;
};

// The tokens that are left of a text, without blanks and lines of directives.
std::string preprocessed(const std::string& text, const ShaderModule& module) {
  static const bool is_started = glslang::InitializeProcess();
  EXPECT_TRUE(is_started);
  glslang::TShader shader(EShLangFragment);
  const std::string whole = "#version 450\n#extension GL_GOOGLE_include_directive : require\n" + text;
  const char* const source = whole.c_str();
  shader.setStrings(&source, 1);
  OnceIncluder includer(module);
  std::string out;
  EXPECT_TRUE(shader.preprocess(GetDefaultResources(), 450, ENoProfile, false, false, EShMsgDefault, &out, includer))
      << shader.getInfoLog();
  std::string tokens;
  for (std::string_view rest = out; !rest.empty();) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    if (!line.starts_with('#'))
      std::ranges::remove_copy_if(line, std::back_inserter(tokens),
                                  [](unsigned char c) { return std::isspace(c) != 0; });
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
  }
  return tokens;
}

ShaderFlags random_flags(ShaderFlags flags, unsigned seed) {
  std::mt19937 random(seed);
  for (auto& [name, is_on] : flags) is_on = random() % 2 == 1;
  return flags;
}

std::string macros(const ShaderFlags& flags) {
  std::string text;
  for (const auto& [name, is_on] : flags) text += fmt::format("#define {} {}\n", macro_name(name), is_on ? 1 : 0);
  return text;
}

// `file`: shared; or empty, for the module itself.
void expect_equal(std::string_view file, const ShaderModule& module, const ShaderFlags& known) {
  constexpr unsigned draws = 6;
  for (unsigned seed = 0; seed < draws; ++seed) {
    const ShaderFlags flags = random_flags(known, seed);
    ShaderModule fixed = module;
    fixed.flags.clear();
    ShaderText ours(flags, fixed);
    if (file.empty()) {
      ours.include_module();
    } else {
      ours.include(file);
    }
    const std::string_view start = file.empty() ? method_module : file;
    const std::string theirs = preprocessed(fmt::format("{}#include \"{}\"\n", macros(flags), start), fixed);
    EXPECT_EQ(preprocessed(ours.text(), fixed), theirs) << start << " of " << module.file << ", flags " << seed;
  }
}

TEST(Preprocessor, LeavesTheSameOfSharedTexts) {
  ShaderFlags flags = shader_flags({});
  flags.insert({{"clamp_box", false}, {"clamp_variance", false}});  // of history.glsl
  for (const EmbeddedText& text : shared_glsl) expect_equal(text.file, {"mine.glsl", "float mine;\n"}, flags);
}

TEST(Preprocessor, LeavesTheSameOfModules) {
  for (const Method* const method : all_methods()) {
    ShaderFlags flags = shader_flags({}, Options(method->info.options, {}, method->info.name));
    flags.insert({{"guard", false}, {"camera", false}});              // of passes of a frame build
    flags.insert({{"clamp_box", false}, {"clamp_variance", false}});  // of history.glsl
    for (const EmbeddedText& text : method->shader.folder)
      expect_equal("", {text.file, text.text, method->shader.folder}, flags);
  }
}

// A fault in a condition is seen.
TEST(Preprocessor, SeesADifference) {
  const ShaderModule module{"mine.glsl", "#if FRESNEL && !DIFFUSE\nfloat a;\n#else\nfloat b;\n#endif\n"};
  const ShaderFlags flags{{"fresnel", true}, {"diffuse", false}}, others{{"fresnel", true}, {"diffuse", true}};
  ShaderText text(flags, module);
  text.include_module();
  const std::string start = fmt::format("#include \"{}\"\n", method_module);
  EXPECT_EQ(preprocessed(text.text(), module), preprocessed(macros(flags) + start, module));
  EXPECT_NE(preprocessed(text.text(), module), preprocessed(macros(others) + start, module));
}

}  // namespace
}  // namespace footprint

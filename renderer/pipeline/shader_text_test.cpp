// The directives of the shader text: conditions, includes, the numbers of lines, and the errors of each.
#include "renderer/pipeline/shader_text.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <utility>

#include "renderer/core/error.hpp"
#include "renderer/pipeline/shader_flags.hpp"

namespace footprint {

extern const EmbeddedTexts shared_glsl;

namespace {

// A module's text without the numbers of its lines.
std::string selected(std::string_view text, const ShaderFlags& flags, EmbeddedTexts folder = {}) {
  ShaderText out(flags, {"module.glsl", text, folder});
  out.include_module();
  std::string lines;
  for (std::string_view rest = out.text(); !rest.empty();) {
    const std::size_t size = rest.find('\n') + 1;
    if (!rest.starts_with("#line")) lines += rest.substr(0, size);
    rest.remove_prefix(size);
  }
  return lines;
}

Error refusal(std::string_view text, const ShaderFlags& flags = {{"fresnel", true}}) {
  try {
    (void)selected(text, flags);
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << "no error: " << text;
  return {ErrorKind::check, {}, {}};
}

TEST(ShaderText, KeepsWhatIsOn) {
  constexpr std::string_view text = "a\n#if X\nb\n#if !Y\nc\n#else\nd\n#endif\n#else\ne\n#endif\nf\n";
  EXPECT_EQ(selected(text, {{"x", true}, {"y", false}}), "a\nb\nc\nf\n");
  EXPECT_EQ(selected(text, {{"x", true}, {"y", true}}), "a\nb\nd\nf\n");
  EXPECT_EQ(selected(text, {{"x", false}, {"y", true}}), "a\ne\nf\n");
  EXPECT_EQ(selected(text, {{"x", false}, {"y", false}}), "a\ne\nf\n");
}

TEST(ShaderText, KeepsTheFirstPartThatIsTrue) {
  constexpr std::string_view text = "#if X\na\n#elif Y\nb\n#elif Z\nc\n#else\nd\n#endif\n";
  for (int bits = 0; bits < 8; ++bits) {
    const bool x = (bits & 1) != 0, y = (bits & 2) != 0, z = (bits & 4) != 0;
    EXPECT_EQ(selected(text, {{"x", x}, {"y", y}, {"z", z}}), x ? "a\n" : y ? "b\n" : z ? "c\n" : "d\n") << bits;
  }
}

TEST(ShaderText, KeepsNothingOfAPartWhoseParentIsOff) {
  constexpr std::string_view text = "#if X\n#if Y\na\n#elif Y\nb\n#else\nc\n#endif\n#endif\nd\n";
  EXPECT_EQ(selected(text, {{"x", false}, {"y", false}}), "d\n");
}

// Blanks and comments are as in C, and a directive within a comment is none.
TEST(ShaderText, ReadsDirectivesAsThePreprocessorDoes) {
  constexpr std::string_view text =
      "/* a\n#if X\n */\n  #  if X  // here\nb\n#\tendif /* X */\n// #if X\n/* c */ #if X\nd\n#endif\n";
  EXPECT_EQ(selected(text, {{"x", true}}), "/* a\n#if X\n */\nb\n// #if X\nd\n");
  EXPECT_EQ(selected(text, {{"x", false}}), "/* a\n#if X\n */\n// #if X\n");
}

// `!` before `&&` before `||`, and parentheses before all.
TEST(ShaderText, ReadsConditionsByPrecedence) {
  struct Case {
    std::string_view condition;
    bool (*expected)(bool x, bool y, bool z);
  };
  constexpr auto cases = std::to_array<Case>({
      {"X && Y", [](bool x, bool y, bool) { return x && y; }},
      {"X || Y && Z", [](bool x, bool y, bool z) { return x || (y && z); }},
      {"X && Y || Z", [](bool x, bool y, bool z) { return (x && y) || z; }},
      {"(X || Y)&&Z", [](bool x, bool y, bool z) { return (x || y) && z; }},
      {"!X && Y", [](bool x, bool y, bool) { return !x && y; }},
      {"!(X && Y) || ! Z", [](bool x, bool y, bool z) { return !(x && y) || !z; }},
      {"!!X && 1 || 0", [](bool x, bool, bool) { return x; }},
  });
  for (const Case& c : cases) {
    for (int bits = 0; bits < 8; ++bits) {
      const bool x = (bits & 1) != 0, y = (bits & 2) != 0, z = (bits & 4) != 0;
      const std::string text = "#if " + std::string(c.condition) + "\na\n#endif\n";
      EXPECT_EQ(selected(text, {{"x", x}, {"y", y}, {"z", z}}), c.expected(x, y, z) ? "a\n" : "")
          << c.condition << bits;
    }
  }
}

// Macros of the text itself and of the compiler are its own to evaluate, next to flags.
TEST(ShaderText, LeavesConditionsOfOtherMacrosToTheCompiler) {
  constexpr std::string_view text =
      "#define N 3\n#if N > 2 && X\na\n#if Y\nb\n#endif\n#elif X\nc\n#else\nd\n#endif\n#ifdef GL_ES\n#ifndef N\ne\n"
      "#endif\n#endif\n";
  EXPECT_EQ(
      selected(text, {{"x", true}, {"y", false}}),
      "#define N 3\n#if N > 2 && 1\na\n#elif 1\nc\n#else\nd\n#endif\n#ifdef GL_ES\n#ifndef N\ne\n#endif\n#endif\n");
  constexpr std::string_view guarded = "#ifndef MINE\n#define MINE\na\n#endif\n";
  EXPECT_EQ(selected(guarded, {}), guarded);
  EXPECT_EQ(selected("#if X\n#if defined(GL_ES)\na\n#endif\n#endif\n", {{"x", false}}), "");
  EXPECT_EQ(selected("#define N 3\n#if X\n#else\n#if N\na\n#endif\n#endif\n", {{"x", false}}),
            "#define N 3\n#if N\na\n#endif\n");
}

TEST(ShaderText, AnUnknownFlagIsAnErrorWithTheNearest) {
  for (const std::string_view text :
       {"a\n#if FRESNLE\n#endif\n", "a\n#if FRESNEL || FRESNLE\n#endif\n", "#if FRESNEL\n#elif !FRESNLE\n#endif\n"}) {
    const Error error = refusal(text);
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    EXPECT_EQ(error.place(), "module.glsl, line 2");
    EXPECT_EQ(error.message(), "unknown flag `FRESNLE`");
    EXPECT_TRUE(error.hint().starts_with("did you mean `FRESNEL`?")) << error.hint();
  }
  EXPECT_EQ(refusal("#if fresnel\n#endif\n").message(), "unknown flag `fresnel`");
  // Nor does one hide in text that is left out.
  EXPECT_EQ(refusal("#if !FRESNEL\n#if FRESNLE\n#endif\n#endif\n").message(), "unknown flag `FRESNLE`");
}

TEST(ShaderText, NamesFileAndLineOfABadDirective) {
  const auto cases = std::to_array<std::pair<std::string_view, std::string_view>>({
      {"a\n#iff FRESNEL\n", "`#iff` is not a directive"},
      {"a\n#endif\n", "`#endif` without an `#if`"},
      {"a\n#else\n", "`#else` without an `#if`"},
      {"a\n#elif FRESNEL\n", "`#elif` without an `#if`"},
      {"#if FRESNEL &&\n#endif\n", "a condition ends too early"},
      {"#if\n#endif\n", "a condition ends too early"},
      {"#if (FRESNEL\n#endif\n", "a condition ends too early"},
      {"#if FRESNEL FRESNEL\n#endif\n", "`1` is out of place here"},
      {"#if || FRESNEL\n#endif\n", "`||` is out of place here"},
      {"#if FRESNEL\n#else\n#elif FRESNEL\n#endif\n", "`#elif` behind an `#else`"},
      {"#if FRESNEL\n#else\n#else\n#endif\n", "`#else` behind an `#else`"},
      {"a\nb\n#if FRESNEL\nc\n", "an `#if` is not closed"},
      {"a\n#include \"none.glsl\"\n", "`none.glsl` is not a shader text"},
      {"a\n#include octahedral.glsl\n", "`#include octahedral.glsl` names no file in quotes"},
      {"#ifdef FRESNEL\n#endif\n", "`FRESNEL` is always defined"},
      {"a\n#if !defined(FRESNEL)\n#endif\n", "`FRESNEL` is always defined"},
      {"#define N 1\n#if FRESNEL\n#elif N\n#endif\n", "`N` has more than flags behind an `#if` of flags"},
  });
  constexpr std::array lines{2, 2, 2, 2, 1, 1, 1, 1, 1, 3, 3, 3, 2, 2, 1, 2, 3};
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Error error = refusal(cases[i].first);
    EXPECT_EQ(error.place(), "module.glsl, line " + std::to_string(lines.at(i))) << cases[i].first;
    EXPECT_EQ(error.message(), cases[i].second);
  }
  EXPECT_TRUE(refusal("#include \"octahedrl.glsl\"\n").hint().starts_with("did you mean `octahedral.glsl`?"));
}

// A file for an earlier version gets what to write instead.
TEST(ShaderText, TranslatesDirectivesOfEarlierVersions) {
  const auto cases = std::to_array<std::pair<std::string_view, std::string_view>>({
      {"//? if fresnel and (not diffuse or x)", "write `#if FRESNEL && (!DIFFUSE || X)`"},
      {"//? elif not x", "write `#elif !X`"},
      {"//? else", "write `#else`"},
      {"//? end", "write `#endif`"},
      {"//? include mean_normal.glsl", "write `#include \"mean_normal.glsl\"`"},
      {"//? include mean_normal.glsl if not x", "write `#if !X`, `#include \"mean_normal.glsl\"` and `#endif`"},
      {"  return x;  //? if fresnel", "write `#if FRESNEL` in the line before, and `#endif` behind the last branch"},
  });
  for (const auto& [former, hint] : cases) {
    const Error error = refusal("a\n" + std::string(former) + "\n");
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    EXPECT_EQ(error.place(), "module.glsl, line 2");
    EXPECT_TRUE(error.message().ends_with("is a directive of earlier versions")) << error.message();
    EXPECT_EQ(error.hint(), hint);
  }
  EXPECT_EQ(selected("a  //? why\n// no //? if\n", {}), "a  //? why\n// no //? if\n");
}

constexpr auto folder = std::to_array<EmbeddedText>(
    {{"first.glsl", "#include \"second.glsl\"\none\n"}, {"second.glsl", "#if X\ntwo\n#endif\n"}});

TEST(ShaderText, IncludesEachFileOnceIfItIsUsed) {
  constexpr std::string_view text = "#include \"second.glsl\"\na\n#include \"first.glsl\"\n#include \"first.glsl\"\n";
  EXPECT_EQ(selected(text, {{"x", true}}, folder), "two\na\none\n");
  EXPECT_EQ(selected("#if X\n#include \"first.glsl\"\n#endif\na\n", {{"x", false}}, folder), "a\n");
  EXPECT_EQ(selected("#if X\n#include \"first.glsl\"\n#endif\na\n", {{"x", true}}, folder), "two\none\na\n");
}

TEST(ShaderText, SharedTextsAreThereForAllAndOnce) {
  ShaderText text({}, {"module.glsl", "#include \"octahedral.glsl\"\n#include \"octahedral.glsl\"\n"});
  text.include("octahedral.glsl");
  text.include_module();
  const std::string_view function = "vec2 octahedral(vec3 d)";
  const std::size_t found = text.text().find(function);
  ASSERT_NE(found, std::string::npos);
  EXPECT_EQ(text.text().find(function, found + 1), std::string::npos);
}

// A module's lines have the numbers of its own file, its folder's other files numbers of their own, and all else is
// out of their way.
TEST(ShaderText, NumbersTheLinesOfAModule) {
  ShaderText text({{"x", false}}, {"module.glsl", "a\n#include \"first.glsl\"\nb\n#if X\nc\n#endif\nd\n", folder});
  text.add("shared\n");
  text.include_module();
  EXPECT_EQ(text.text(), "shared\n#line 1\na\n#line 1002\none\n#line 3\nb\n#line 7\nd\n#line 100010\n");
  EXPECT_EQ(text.lines(),
            "lines from 1 on are of module.glsl, from 1001 on are of first.glsl, from 2001 on are of second.glsl, from "
            "100001 on shared");
  EXPECT_EQ(text.origin(0), nullptr);
  const ShaderText::Origin* const origin = text.origin(text.text().find("one"));
  ASSERT_NE(origin, nullptr);
  EXPECT_EQ(origin->file, "first.glsl");
  EXPECT_EQ(origin->line, 2);
}

// A shared text takes functions and constants that a module defines, so it may know no option and no flag of a method.
TEST(ShaderText, SharedTextsTestNoFlagOfAMethod) {
  for (const EmbeddedText& file : shared_glsl) {
    ShaderFlags flags = shader_flags({});
    if (file.file == "history.glsl") flags.insert({{"clamp_box", false}, {"clamp_variance", false}});  // of its pass
    ShaderText text(std::move(flags), {"module.glsl", "\n"});
    EXPECT_NO_THROW(text.include(file.file)) << file.file;
  }
}

}  // namespace
}  // namespace footprint

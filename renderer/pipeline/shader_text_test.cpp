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
  constexpr std::string_view text = "a\n//? if x\nb\n//? if not y\nc\n//? else\nd\n//? end\n//? else\ne\n//? end\nf\n";
  EXPECT_EQ(selected(text, {{"x", true}, {"y", false}}), "a\nb\nc\nf\n");
  EXPECT_EQ(selected(text, {{"x", true}, {"y", true}}), "a\nb\nd\nf\n");
  EXPECT_EQ(selected(text, {{"x", false}, {"y", true}}), "a\ne\nf\n");
  EXPECT_EQ(selected(text, {{"x", false}, {"y", false}}), "a\ne\nf\n");
}

TEST(ShaderText, KeepsTheFirstPartThatIsTrue) {
  constexpr std::string_view text = "//? if x\na\n//? elif y\nb\n//? elif z\nc\n//? else\nd\n//? end\n";
  for (int bits = 0; bits < 8; ++bits) {
    const bool x = (bits & 1) != 0, y = (bits & 2) != 0, z = (bits & 4) != 0;
    EXPECT_EQ(selected(text, {{"x", x}, {"y", y}, {"z", z}}), x ? "a\n" : y ? "b\n" : z ? "c\n" : "d\n") << bits;
  }
}

TEST(ShaderText, KeepsNothingOfAPartWhoseParentIsOff) {
  constexpr std::string_view text = "//? if x\n//? if y\na\n//? elif y\nb\n//? else\nc\n//? end\n//? end\nd\n";
  EXPECT_EQ(selected(text, {{"x", false}, {"y", false}}), "d\n");
}

// A condition at the end of a line is for that line alone; lines in sequence are the branches of one `if`.
TEST(ShaderText, KeepsSingleLines) {
  constexpr std::string_view text =
      "a  //? if x\nb //? elif y\n  c  // d  //? else\n// no //? directive\ne //? if y\nf\n";
  for (int bits = 0; bits < 4; ++bits) {
    const bool x = (bits & 1) != 0, y = (bits & 2) != 0;
    EXPECT_EQ(selected(text, {{"x", x}, {"y", y}}), std::string(x   ? "a\n"
                                                                : y ? "b\n"
                                                                    : "  c  // d\n") +
                                                        "// no //? directive\n" + (y ? "e\nf\n" : "f\n"));
  }
  constexpr std::string_view inner = "//? if x\na //? if y\n//? else\nb //? if y\nc //? else\n//? end\n";
  EXPECT_EQ(selected(inner, {{"x", true}, {"y", false}}), "");
  EXPECT_EQ(selected(inner, {{"x", false}, {"y", false}}), "c\n");
}

// `not` before `and` before `or`, and parentheses before all.
TEST(ShaderText, ReadsConditionsByPrecedence) {
  struct Case {
    std::string_view condition;
    bool (*expected)(bool x, bool y, bool z);
  };
  constexpr auto cases = std::to_array<Case>({
      {"x and y", [](bool x, bool y, bool) { return x && y; }},
      {"x or y and z", [](bool x, bool y, bool z) { return x || (y && z); }},
      {"x and y or z", [](bool x, bool y, bool z) { return (x && y) || z; }},
      {"(x or y) and z", [](bool x, bool y, bool z) { return (x || y) && z; }},
      {"not x and y", [](bool x, bool y, bool) { return !x && y; }},
      {"not (x and y) or not z", [](bool x, bool y, bool z) { return !(x && y) || !z; }},
      {"not not x", [](bool x, bool, bool) { return x; }},
  });
  for (const Case& c : cases) {
    for (int bits = 0; bits < 8; ++bits) {
      const bool x = (bits & 1) != 0, y = (bits & 2) != 0, z = (bits & 4) != 0;
      const std::string text = "//? if " + std::string(c.condition) + "\na\n//? end\n";
      EXPECT_EQ(selected(text, {{"x", x}, {"y", y}, {"z", z}}), c.expected(x, y, z) ? "a\n" : "")
          << c.condition << bits;
    }
  }
}

TEST(ShaderText, AnUnknownFlagIsAnErrorWithTheNearest) {
  for (const std::string_view text : {"a\n//? if fresnle\n//? end\n", "a\n//? if fresnel or fresnle\n//? end\n",
                                      "//? if fresnel\n//? elif not fresnle\n//? end\n"}) {
    const Error error = refusal(text);
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    EXPECT_EQ(error.place(), "module.glsl, line 2");
    EXPECT_EQ(error.message(), "unknown flag `fresnle`");
    EXPECT_TRUE(error.hint().starts_with("did you mean `fresnel`?")) << error.hint();
  }
  // Nor does one hide in text that is left out.
  EXPECT_EQ(refusal("//? if not fresnel\n//? if fresnle\n//? end\n//? end\n").message(), "unknown flag `fresnle`");
}

TEST(ShaderText, NamesFileAndLineOfABadDirective) {
  const auto cases = std::to_array<std::pair<std::string_view, std::string_view>>({
      {"a\n//? iff fresnel\n", "`iff fresnel` is not a directive here"},
      {"a\n//? end\n", "`end` is not a directive here"},
      {"a\n//? else\n", "`else` without an `if`"},
      {"a\n//? elif fresnel\n", "`elif fresnel` without an `if`"},
      {"//? if fresnel and\n//? end\n", "a condition ends too early"},
      {"//? if (fresnel\n//? end\n", "a condition ends too early"},
      {"//? if fresnel fresnel\n//? end\n", "`fresnel` is out of place here"},
      {"//? if or fresnel\n//? end\n", "`or` is out of place here"},
      {"//? if fresnel\n//? else\n//? elif fresnel\n//? end\n", "`elif fresnel` behind an `else`"},
      {"//? if fresnel\n//? else\n//? else\n//? end\n", "`else` behind an `else`"},
      {"a\nb\n//? if fresnel\nc\n", "an `if` is not closed"},
      {"a\n//? include none.glsl\n", "`none.glsl` is not a shader text"},
      {"//? if fresnel\na //? else\n//? end\n", "`else` is not a directive here"},
      {"a //? if fresnel\nb\nc //? elif fresnel\n", "`elif fresnel` is not a directive here"},
      {"a //? if fresnel\nb //? else\nc //? else\n", "`else` behind an `else`"},
      {"a //? end\n", "`end` is not a directive here"},
  });
  constexpr std::array lines{2, 2, 2, 2, 1, 1, 1, 1, 3, 3, 3, 2, 2, 3, 3, 1};
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Error error = refusal(cases[i].first);
    EXPECT_EQ(error.place(), "module.glsl, line " + std::to_string(lines[i])) << cases[i].first;
    EXPECT_EQ(error.message(), cases[i].second);
  }
  EXPECT_TRUE(refusal("//? include octahedrl.glsl\n").hint().starts_with("did you mean `octahedral.glsl`?"));
}

constexpr auto folder = std::to_array<EmbeddedText>(
    {{"first.glsl", "//? include second.glsl\none\n"}, {"second.glsl", "//? if x\ntwo\n//? end\n"}});

TEST(ShaderText, IncludesEachFileOnceIfItIsUsed) {
  constexpr std::string_view text = "//? include second.glsl\na\n//? include first.glsl\n//? include first.glsl\n";
  EXPECT_EQ(selected(text, {{"x", true}}, folder), "two\na\none\n");
  EXPECT_EQ(selected("//? if x\n//? include first.glsl\n//? end\na\n", {{"x", false}}, folder), "a\n");
  EXPECT_EQ(selected("//? include first.glsl if not x\na\n", {{"x", true}}, folder), "a\n");
  EXPECT_EQ(selected("//? include first.glsl if x\na\n", {{"x", true}}, folder), "two\none\na\n");
}

TEST(ShaderText, SharedTextsAreThereForAllAndOnce) {
  ShaderText text({}, {"module.glsl", "//? include octahedral.glsl\n//? include octahedral.glsl\n"});
  text.include("octahedral.glsl");
  text.include_module();
  const std::string_view function = "vec2 octahedral(vec3 d)";
  const std::size_t found = text.text().find(function);
  ASSERT_NE(found, std::string::npos);
  EXPECT_EQ(text.text().find(function, found + 1), std::string::npos);
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

// A module's lines have the numbers of its own file, its folder's other files numbers of their own, and all else is
// out of their way.
TEST(ShaderText, NumbersTheLinesOfAModule) {
  ShaderText text({{"x", false}}, {"module.glsl", "a\n//? include first.glsl\nb\n//? if x\nc\n//? end\nd\n", folder});
  text.add("shared\n");
  text.include_module();
  EXPECT_EQ(text.text(),
            "shared\n#line 1\na\n"
            "#line 1001\n#line 2001\n#line 2002\n#line 2004\n#line 1002\none\n"
            "#line 3\nb\n#line 5\n#line 7\nd\n#line 100015\n");
  EXPECT_EQ(text.lines(),
            "lines from 1 on are of module.glsl, from 1001 on are of first.glsl, from 2001 on are of second.glsl, from "
            "100001 on shared");
}

}  // namespace
}  // namespace footprint

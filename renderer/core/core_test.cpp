// Errors, suggestions, options, content hashes, interrupts and the processor.
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <csignal>
#include <functional>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "renderer/core/bytes.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/names.hpp"
#include "renderer/core/options.hpp"
#include "renderer/core/process.hpp"
#include "tests/support/says.hpp"

namespace footprint {
namespace {

using test::says;

// The text of the usage error that `action` ends in.
std::string refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage) << error.what();
    return error.what();
  }
  return "no error";
}

// --- error.hpp

TEST(DriverWatch, EndsTheProcessWithOneMessage) {
  { const DriverWatch enough(std::chrono::seconds(60), "b.glsl", "compile"); }
  const auto overrun = [] {
    const DriverWatch watch(std::chrono::milliseconds(20), "a.glsl", "compile");
    std::this_thread::sleep_for(std::chrono::seconds(60));
  };
  EXPECT_EXIT(overrun(), ::testing::ExitedWithCode(3),
              "^footprint: a.glsl: takes more than 0.02 s to compile [^\n]*\n$");
}

TEST(Error, ReadsPlaceMessageHint) {
  EXPECT_STREQ(Error(ErrorKind::usage, "a.toml", "wrong key", "remove it").what(), "a.toml: wrong key (remove it)");
  EXPECT_STREQ(Error(ErrorKind::usage, "", "wrong key", "remove it").what(), "wrong key (remove it)");
  EXPECT_STREQ(Error(ErrorKind::usage, "a.toml", "wrong key").what(), "a.toml: wrong key");
}

TEST(Error, SeenFromFurtherOutKeepsItsKindAndHint) {
  const Error inner(ErrorKind::machine, "material 3", "too large", "scale it down");
  const Error outer = inner.within("scene.gltf");
  EXPECT_EQ(outer.kind(), ErrorKind::machine);
  EXPECT_STREQ(outer.what(), "scene.gltf, material 3: too large (scale it down)");
  EXPECT_EQ(Error(ErrorKind::usage, "", "empty").within("scene.gltf").place(), "scene.gltf");
}

TEST(Error, KindsAreExitCodes) {
  EXPECT_EQ(static_cast<int>(ErrorKind::check), 1);
  EXPECT_EQ(static_cast<int>(ErrorKind::usage), 2);
  EXPECT_EQ(static_cast<int>(ErrorKind::machine), 3);
  EXPECT_EQ(static_cast<int>(ErrorKind::interrupted), 128 + SIGINT);
}

// --- names.hpp: suggestions

const std::vector<std::string> methods{"direct", "naive_mip", "toksvig"};

TEST(NearestName, FindsTheNearest) {
  EXPECT_EQ(nearest_name("toksvik", methods), "toksvig");
  EXPECT_EQ(nearest_name("tokvsig", methods), "toksvig") << "neighbours swapped";
  EXPECT_EQ(nearest_name("DIRECT", methods), "direct") << "case";
  EXPECT_EQ(nearest_name("naive-mip", methods), "naive_mip");
  EXPECT_EQ(nearest_name("naivemip", methods), "naive_mip");
  EXPECT_EQ(nearest_name("direct", methods), "direct");
}

TEST(NearestName, NamesNothingThatIsFar) {
  EXPECT_EQ(nearest_name("lean", methods), "");
  EXPECT_EQ(nearest_name("zzzzzzzzzzzz", methods), "");
  EXPECT_EQ(nearest_name("", methods), "");
  EXPECT_EQ(nearest_name("direct", std::vector<std::string>{}), "");
  EXPECT_EQ(nearest_name(std::string(100000, 'x'), methods), "");
}

TEST(NearestName, ShortNamesMayDifferByTwo) {
  const std::vector<std::string> keys{"n", "align"};
  EXPECT_EQ(nearest_name("m", keys), "n");
  EXPECT_EQ(nearest_name("algn", keys), "align");
}

TEST(Suggestion, NamesTheNearestAndAllKnown) {
  EXPECT_EQ(suggestion("toksvik", methods), "did you mean `toksvig`? known: direct, naive_mip, toksvig");
  EXPECT_EQ(suggestion("zzzzzzzzzz", methods), "known: direct, naive_mip, toksvig");
}

TEST(Suggestion, ListsTheFirstOfMany) {
  const std::vector<std::string> many(23, "name");
  const std::string text = suggestion("zzzzzzzzzz", many);
  EXPECT_TRUE(text.ends_with("name, name and 3 more")) << text;
  EXPECT_EQ(std::ranges::count(text, ','), 19);
}

// --- names.hpp: words

constexpr std::array<Word<int>, 3> sizes{{{10, "small"}, {20, "medium"}, {30, "large"}}};

TEST(Words, StandForTheirValues) {
  EXPECT_EQ(word_names(sizes), (std::vector<std::string>{"small", "medium", "large"}));
  EXPECT_EQ(word_value(sizes, "medium", "size", "--size"), 20);
  EXPECT_EQ(word_for(sizes, 30), "large");
}

TEST(Words, AWrongOneIsRefusedWithTheNearest) {
  try {
    (void)word_value(sizes, "lagre", "size", "--size");
    FAIL() << "an unknown word was taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    EXPECT_STREQ(error.what(), "--size: unknown size `lagre` (did you mean `large`? known: small, medium, large)");
  }
}

// --- options.hpp

std::vector<OptionSpec> table() {
  return {whole_option("n", 4, 1, 8, "lobes"), number_option("scale", 0.5, -1, 2.5, "a factor"),
          word_option("storage", {"fp32", "fp16", "unorm8"}, "texel format")};
}

Options given(const std::map<std::string, std::string>& values) { return {table(), values, "toksvig"}; }

TEST(OptionSpec, ChecksItsRangeOrItsChoices) {
  const OptionSpec number = number_option("scale", 0.5, -1, 2.5, "a factor");
  EXPECT_EQ(number.name, "scale");
  EXPECT_EQ(std::get<double>(number.default_value), 0.5);
  EXPECT_EQ(number.minimum, -1);
  EXPECT_EQ(number.maximum, 2.5);
  EXPECT_TRUE(number.choices.empty());
  EXPECT_EQ(number.meaning, "a factor");
  EXPECT_FALSE(number.integer);
  const OptionSpec whole = whole_option("n", 4, 1, 8, "lobes");
  EXPECT_EQ(whole.name, "n");
  EXPECT_EQ(std::get<double>(whole.default_value), 4.0);
  EXPECT_EQ(whole.minimum, 1);
  EXPECT_EQ(whole.maximum, 8);
  EXPECT_TRUE(whole.choices.empty());
  EXPECT_EQ(whole.meaning, "lobes");
  EXPECT_TRUE(whole.integer);
}

TEST(Options, DefaultsFillWhatIsNotGiven) {
  const Options options = given({{"n", "6"}});
  EXPECT_EQ(options.number("n"), 6);
  EXPECT_EQ(options.number("scale"), 0.5);
  EXPECT_EQ(options.word("storage"), "fp32");
  EXPECT_EQ(options.all().size(), 3U);
}

TEST(Options, RangesAreInclusive) {
  EXPECT_EQ(given({{"n", "1"}}).number("n"), 1);
  EXPECT_EQ(given({{"n", "8"}}).number("n"), 8);
  EXPECT_EQ(given({{"scale", "-1"}}).number("scale"), -1);
  EXPECT_EQ(given({{"scale", "2.5"}}).number("scale"), 2.5);
  EXPECT_EQ(given({{"scale", "2.5e-1"}}).number("scale"), 0.25);
  EXPECT_EQ(given({{"storage", "unorm8"}}).word("storage"), "unorm8");
}

TEST(Options, WhatDoesNotFitIsNamedWithTheRange) {
  for (const std::string bad : {"0", "9", "-1", "1.5", "nan", "inf", "", "six", "6x", " 6", "1e999"}) {
    const std::string text = refusal([&] { (void)given({{"n", bad}}); });
    EXPECT_TRUE(says(text, "toksvig, option n: `" + bad + "` is not valid"));
    EXPECT_TRUE(says(text, "a whole number from 1 to 8"));
  }
  EXPECT_TRUE(says(refusal([] { (void)given({{"scale", "2.6"}}); }), "a number from -1 to 2.5"));
}

TEST(Options, UnknownWordsAndNamesSuggestTheNearest) {
  EXPECT_TRUE(says(refusal([] { (void)given({{"storage", "fp23"}}); }), "did you mean `fp32`?"));
  EXPECT_TRUE(says(refusal([] { (void)given({{"storage", ""}}); }), "known: fp32, fp16, unorm8"));
  const std::string text = refusal([] { (void)given({{"storge", "fp32"}}); });
  EXPECT_TRUE(says(text, "toksvig: unknown option `storge`"));
  EXPECT_TRUE(says(text, "did you mean `storage`?"));
  EXPECT_TRUE(says(refusal([] { (void)Options({}, {{"n", "1"}}, "direct"); }), "it takes no options"));
}

TEST(ParseMethods, SplitsMethodsAndOptions) {
  const std::vector<MethodSpec> parsed = parse_methods("direct,toksvig:storage=fp16:n=6,x:a=");
  ASSERT_EQ(parsed.size(), 3U);
  EXPECT_EQ(parsed[0].name, "direct");
  EXPECT_TRUE(parsed[0].options.empty());
  EXPECT_EQ(parsed[1].text, "toksvig:storage=fp16:n=6");
  EXPECT_EQ(parsed[1].name, "toksvig");
  EXPECT_EQ(parsed[1].options, (std::map<std::string, std::string>{{"n", "6"}, {"storage", "fp16"}}));
  EXPECT_EQ(parsed[2].options.at("a"), "");
}

TEST(ParseMethods, OneMethodMayComeWithSeveralSettings) {
  EXPECT_EQ(parse_methods("toksvig:n=1,toksvig:n=2,toksvig").size(), 3U);
}

TEST(ParseMethods, EmptyNamesAreRefused) {
  for (const std::string bad : {"", ",", "direct,", ",direct", "direct,,toksvig", ":n=1"}) {
    EXPECT_TRUE(says(refusal([&] { (void)parse_methods(bad); }), "no name")) << bad;
  }
}

TEST(ParseMethods, MalformedOptionsAreRefused) {
  EXPECT_TRUE(says(refusal([] { (void)parse_methods("toksvig:n"); }), "option `n` is not name=value"));
  EXPECT_TRUE(says(refusal([] { (void)parse_methods("toksvig:"); }), "is not name=value"));
  EXPECT_TRUE(says(refusal([] { (void)parse_methods("toksvig:=3"); }), "is not name=value"));
  EXPECT_TRUE(says(refusal([] { (void)parse_methods("toksvig:n=1:n=2"); }), "option `n` is given twice"));
  EXPECT_TRUE(says(refusal([] { (void)parse_methods("direct,direct"); }), "given twice"));
}

// --- hash.hpp

std::uint64_t plain_fnv1a(std::string_view text) { return fnv1a(std::as_bytes(std::span(text))); }

// Test vectors of the FNV reference code (draft-eastlake-fnv, appendix C).
TEST(ContentHash, IsFnv1a) {
  EXPECT_EQ(plain_fnv1a(""), 0xcbf29ce484222325U);
  EXPECT_EQ(plain_fnv1a("a"), 0xaf63dc4c8601ec8cU);
  EXPECT_EQ(plain_fnv1a("foobar"), 0x85944171f73967e8U);
}

std::string hash_of(const std::vector<std::string>& fields) {
  ContentHash hash;
  for (const std::string& field : fields) hash.add(field);
  return hash.hex();
}

TEST(ContentHash, TellsFieldsApart) {
  const std::vector<std::vector<std::string>> sequences{{},      {""},        {"", ""},    {"ab", "c"}, {"a", "bc"},
                                                        {"abc"}, {"abc", ""}, {"", "abc"}, {"c", "ab"}};
  std::set<std::string> hashes;
  for (const auto& fields : sequences) hashes.insert(hash_of(fields));
  EXPECT_EQ(hashes.size(), sequences.size());
}

TEST(ContentHash, IsSixteenDigitsAndRepeatable) {
  EXPECT_EQ(hash_of({"x"}), hash_of({"x"}));
  EXPECT_EQ(hash_of({}), "cbf29ce484222325");
  EXPECT_EQ(hash_of({"x"}).find_first_not_of("0123456789abcdef"), std::string::npos);
  EXPECT_EQ(hash_of({"x"}).size(), 16U);
}

TEST(ContentHash, BytesAndTextOfTheSameContentAgree) {
  const std::vector<float> numbers{1.0F, 2.0F};
  ContentHash bytes, text;
  bytes.add(std::as_bytes(std::span(numbers)));
  text.add(std::string_view(reinterpret_cast<const char*>(numbers.data()), 2 * sizeof(float)));
  EXPECT_EQ(bytes.hex(), text.hex());
}

// --- interrupt.hpp

TEST(Interrupt, IsAnErrorAtTheNextSafePoint) {
  watch_interrupts();
  EXPECT_NO_THROW(throw_if_interrupted());
  std::raise(SIGINT);
  try {
    throw_if_interrupted();
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::interrupted);
  }
  watch_interrupts();
  EXPECT_NO_THROW(throw_if_interrupted());
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  std::signal(SIGHUP, SIG_DFL);
}

TEST(Interrupt, AClosedTerminalCountsUnlessItIsIgnored) {
  watch_interrupts();
  std::raise(SIGHUP);
  EXPECT_THROW(throw_if_interrupted(), Error);
  std::signal(SIGHUP, SIG_IGN);
  watch_interrupts();
  std::raise(SIGHUP);
  EXPECT_NO_THROW(throw_if_interrupted());
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_DFL);
}

// --- the processor, by /proc/cpuinfo of several architectures

TEST(CpuInfo, CountsProcessorsAndTakesTheFirstModel) {
  std::istringstream in(
      "processor\t: 0\nmodel name\t: A (R) Processor: fast \ncpu cores\t: 1\n\n"
      "processor\t: 1\nmodel name\t: B\nflags\t\t: fpu vme\n");
  const CpuInfo cpu = parse_cpu_info(in);
  EXPECT_EQ(cpu.model, "A (R) Processor: fast");
  EXPECT_EQ(cpu.logical_cores, 2);
}

TEST(CpuInfo, NamesTheArchitectureWhereThereIsNoModel) {
  std::istringstream in("processor\t: 0\nBogoMIPS\t: 243.75\nCPU implementer\t: 0x41\n");
  const CpuInfo cpu = parse_cpu_info(in);
  EXPECT_FALSE(cpu.model.empty());
  EXPECT_EQ(cpu.logical_cores, 1);
}

TEST(CpuInfo, SurvivesAnEmptyFile) {
  std::istringstream in;
  EXPECT_EQ(parse_cpu_info(in).logical_cores, 1);
}

}  // namespace
}  // namespace footprint

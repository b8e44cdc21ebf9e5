// The table of a run's settings: values that options take and refuse, and that every row is complete.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "experiments/settings/setting.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/toml_table.hpp"
#include "tests/support/says.hpp"

namespace footprint {
namespace {

using test::says;

// The row of a subcommand's option.
const Setting& row_of(std::string_view command, std::string_view option) {
  for (const Setting& setting : run_settings()) {
    const bool has_it = std::ranges::find(setting.commands, command) != setting.commands.end();
    if (has_it && option_name(setting) == option) return setting;
  }
  throw std::out_of_range(std::string(command) + " has no option " + std::string(option));
}

// The settings after `option TEXT` of a subcommand.
RunSettings read(std::string_view command, std::string_view option, const std::string& text) {
  RunSettings run;
  row_of(command, option).type.read(run, option, text);
  return run;
}

// The text of the usage error that `option TEXT` ends in; fails the test if it is taken or ends otherwise.
std::string refusal(std::string_view command, std::string_view option, const std::string& text) {
  try {
    (void)read(command, option, text);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage) << error.what();
    EXPECT_FALSE(error.hint().empty()) << error.what();
    return error.what();
  }
  ADD_FAILURE() << option << " took `" << text << "`";
  return {};
}

std::string refused_size(const std::string& text) { return refusal("compare", "--size", text); }

// An option that may be given several times adds to the values before.
TEST(BakesSetting, TakesAFolderEachTime) {
  const SettingType& type = row_of("compare", "--bakes").type;
  EXPECT_TRUE(type.repeats);
  RunSettings run;
  for (const char* folder : {"maps,1", "more"}) type.read(run, "--bakes", folder);
  EXPECT_EQ(run.bakes, (std::vector<std::filesystem::path>{"maps,1", "more"}));
  EXPECT_TRUE(says(refusal("render", "--bakes", ""), "--bakes: `` is empty"));
}

TEST(SizeSetting, TakesWidthThenHeight) {
  EXPECT_EQ(read("compare", "--size", "640x480").view.size, glm::ivec2(640, 480));
  EXPECT_EQ(read("render", "--size", "1x1").view.size, glm::ivec2(1, 1));
}

TEST(SizeSetting, RefusesWhatIsNoSize) {
  for (const std::string text :
       {"", "x", "512", "512x", "x512", "512 x 512", "-5x5", "+5x5", "1.5x2", "3x4x5", "5X5", "axb", "5x5 "}) {
    EXPECT_TRUE(says(refused_size(text), "--size: `" + text + "` is not a frame size")) << text;
  }
  EXPECT_TRUE(says(refused_size("0x0"), "has no pixels"));
  EXPECT_TRUE(says(refused_size("512x0"), "has no pixels"));
  EXPECT_TRUE(says(refused_size("10000001x1"), "more than 10000000 pixels"));
  EXPECT_TRUE(says(refused_size("1x99999999999999999999999"), "more than 10000000 pixels"));
}

TEST(SizeSetting, ChecksThatAnImageFitsMemory) {
  try {
    (void)read("compare", "--size", "10000000x10000000");
    ADD_FAILURE() << "was taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::machine) << error.what();
  }
}

TEST(DistancesSetting, KeepsTheOrder) {
  EXPECT_EQ(read("compare", "--distance", "4,1,0.5,1e2").view.distances, (std::vector<double>{4.0, 1.0, 0.5, 100.0}));
}

TEST(DistancesSetting, RefusesWhatIsNoDistance) {
  for (const char* text : {"", ",", "1,", ",1", "0", "-1", "1,nan", "inf", "1e400", "one", "1;2", "1, 2"}) {
    EXPECT_TRUE(says(refusal("compare", "--distance", text), "is not a positive number")) << text;
  }
  for (const char* text : {"1e-4", "1,1000001", "1e300"}) {
    EXPECT_TRUE(says(refusal("compare", "--distance", text), "is not within 0.001 to 1000000")) << text;
  }
  EXPECT_TRUE(says(refusal("compare", "--distance", "1,2,1.0"), "given twice"));
  EXPECT_TRUE(says(refusal("render", "--distance", "1,2"), "more than one distance"));
}

TEST(ExposureSetting, TakesAutoOrAFactorThatTheCommandLineSet) {
  EXPECT_FALSE(read("compare", "--exposure", "auto").view.exposure);
  const auto exposure = read("compare", "--exposure", "2.5").view.exposure;
  ASSERT_TRUE(exposure);
  EXPECT_EQ(exposure->factor, 2.5F);
  EXPECT_EQ(exposure->source, ExposureSource::command_line);
}

TEST(ExposureSetting, RefusesWhatIsNoExposure) {
  for (const char* text : {"", "0", "-1", "nan", "inf", "1e60", "1e-60", "Auto", "1x"}) {
    EXPECT_TRUE(says(refusal("compare", "--exposure", text), "is not an exposure")) << text;
  }
}

TEST(WholeSetting, HasARange) {
  EXPECT_EQ(read("compare", "--spp", "4096").reference.spp, 4096);
  EXPECT_EQ(read("compare", "--seed", "18446744073709551615").reference.seed, 18446744073709551615U);
  for (const char* text : {"0", "4097", "-1", "1.5", "many", "", "99999999999"}) {
    EXPECT_TRUE(says(refusal("compare", "--spp", text), "give a whole number, 1 to 4096")) << text;
  }
  EXPECT_TRUE(says(refusal("compare", "--seed", "-1"), "0 or more"));
}

TEST(WordSetting, NamesTheNearestWord) {
  EXPECT_EQ(read("compare", "--filter", "nearest").reference.filter, Sampling::nearest);
  EXPECT_EQ(read("compare", "--backend", "auto").backend.context.backend, std::nullopt);
  const std::string text = refusal("compare", "--filter", "bilinaer");
  EXPECT_TRUE(says(text, "--filter: unknown filter `bilinaer`")) << text;
  EXPECT_TRUE(says(text, "did you mean `bilinear`")) << text;
}

TEST(EffectsSetting, TakesNamesWithCommasBetween) {
  const EffectSet without = read("compare", "--without", "fresnel,cast_shadow").without;
  EXPECT_EQ(without.count(), 2U);
  EXPECT_TRUE(has(without, Effect::fresnel) && has(without, Effect::cast_shadow));
  EXPECT_TRUE(says(refusal("compare", "--without", "fresnell"), "did you mean `fresnel`"));
}

TEST(MethodSetting, IsOneMethodOrTheReference) {
  EXPECT_EQ(read("render", "--method", "reference").methods.front().name, "reference");
  EXPECT_EQ(read("compare", "--methods", "direct,toksvig").methods.size(), 2U);
  EXPECT_TRUE(says(refusal("render", "--method", "direct,toksvig"), "more than one method"));
}

// The settings of [`name`] in a file with these lines.
RunSettings read_file(std::string_view name, std::string_view lines) {
  RunSettings run;
  read_settings(TomlTable("run.toml", lines, setting_keys(name)), name, run);
  return run;
}

std::string refused_file(std::string_view name, std::string_view lines) {
  try {
    (void)read_file(name, lines);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage) << error.what();
    return error.what();
  }
  ADD_FAILURE() << lines << " was taken";
  return {};
}

// 2^53 + 1 is no double.
TEST(SettingsOfAFile, KeepTheirType) {
  EXPECT_EQ(read_file("reference", "seed = 9007199254740993").reference.seed, 9007199254740993U);
  EXPECT_EQ(read_file("reference", "seed = 9223372036854775807").reference.seed, 9223372036854775807U);
  EXPECT_EQ(read_file("reference", "spp = 64.0").reference.spp, 64);
  EXPECT_EQ(read_file("reference", "spp = \"64\"").reference.spp, 64);
  EXPECT_EQ(read_file("reference", "noise = 1e-3").reference.noise, 1e-3);
  EXPECT_EQ(read_file("reference", "noise = 1").reference.noise, 1.0);
  EXPECT_EQ(read_file("zoom", "distances = [1, 0.1, \"2\"]").view.distances, (std::vector<double>{1.0, 0.1, 2.0}));
  EXPECT_EQ(read_file("reference", "other_spp = [16, 4]").reference.other_spp, (std::vector<int>{16, 4}));
}

TEST(SettingsOfAFile, RefuseOtherTypes) {
  for (const char* line : {"spp = 64.5", "spp = -1", "spp = 1e300", "spp = nan", "spp = 4097"})
    EXPECT_TRUE(says(refused_file("reference", line), "give a whole number, 1 to 4096")) << line;
  for (const char* line : {"noise = inf", "noise = nan", "noise = 0", "noise = -1.0"})
    EXPECT_TRUE(says(refused_file("reference", line), "is not a positive number")) << line;
  EXPECT_TRUE(says(refused_file("reference", "spp = true"), "run.toml:1: `spp` must be a number"));
  EXPECT_TRUE(says(refused_file("reference", "spp = [64]"), "run.toml:1: `spp` must be a string or a number"));
  EXPECT_TRUE(says(refused_file("zoom", "distances = 2"), "must be a list of strings or numbers"));
  EXPECT_TRUE(says(refused_file("zoom", "distances = [\"1,2\"]"), "write each value on its own"));
  EXPECT_TRUE(says(refused_file("reference", "seed = -1"), "0 or more"));
}

TEST(SettingsOfAFile, TakeSizesAsListsAndTexts) {
  const std::string required = "scene = \"s\"\nmethods = [\"direct\"]\n";
  for (const char* line : {"size = [640, 480]", "size = \"640x480\"", "size = [\"640\", 480.0]"})
    EXPECT_EQ(read_file("experiment", required + line).view.size, glm::ivec2(640, 480)) << line;
  for (const char* line : {"size = [640]", "size = [640, 480, 1]", "size = [640, -480]", "size = [640, 0.5]"})
    EXPECT_TRUE(says(refused_file("experiment", required + line), "is not a frame size")) << line;
}

TEST(FlagSetting, IsSetByItsOption) {
  EXPECT_FALSE(RunSettings().output.video);
  EXPECT_TRUE(read("animate", "--video", "true").output.video);
  EXPECT_TRUE(read("compare", "--verbose", "true").output.verbose);
  EXPECT_TRUE(read("check", "--fresh", "true").output.fresh);
  EXPECT_FALSE(read("animate", "--video", "false").output.video);
}

TEST(SwitchSetting, TakesWordsAndBooleans) {
  EXPECT_FALSE(read("compare", "--history-jitter", "off").history.jitter);
  const std::string required = "scene = \"s\"\nmethods = [\"direct\"]\n";
  EXPECT_FALSE(read_file("experiment", required + "history_jitter = false").history.jitter);
  EXPECT_TRUE(read_file("experiment", required + "history_jitter = true").history.jitter);
  EXPECT_FALSE(read_file("experiment", required + "history_jitter = \"off\"").history.jitter);
}

// Every row has the fields that reading, help and documents need.
TEST(SettingsTable, EveryRowIsWhole) {
  std::set<std::pair<std::string_view, std::string_view>> seen;
  for (const Setting& setting : run_settings()) {
    const std::string row =
        std::string(setting.option) + " [" + std::string(setting.key.table) + "] " + std::string(setting.key.name);
    EXPECT_FALSE(setting.help.empty()) << row;
    EXPECT_EQ(setting.option.empty(), setting.commands.empty()) << row;
    EXPECT_EQ(setting.key.table.empty(), setting.key.empty()) << row;
    EXPECT_FALSE(setting.option.empty() && setting.key.empty()) << row;
    EXPECT_TRUE(setting.type.read) << row;
    EXPECT_TRUE(setting.key.empty() || seen.emplace(setting.key.table, setting.key.name).second)
        << row << " is there twice";
    for (const std::string_view command : setting.commands) {
      EXPECT_TRUE(seen.emplace(command, option_name(setting)).second) << command << " has " << row << " twice";
    }
  }
}

// A setting accepts the default that the table gives.
TEST(SettingsTable, EveryDefaultIsTaken) {
  for (const Setting& setting : run_settings()) {
    if (setting.option.empty() || default_text(setting).empty()) continue;
    RunSettings run;
    EXPECT_NO_THROW(setting.type.read(run, setting.option, default_text(setting))) << setting.option;
    EXPECT_EQ(setting.type.text(run), default_text(setting)) << setting.option;
  }
}

}  // namespace
}  // namespace footprint

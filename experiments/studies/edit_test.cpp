// `--set KIND.PARAMETER=FROM:TO`: what it means in each frame, and every way to get it wrong.
#include "experiments/studies/edit.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "renderer/core/error.hpp"

namespace footprint {
namespace {

using Values = std::map<std::string, std::string>;

TEST(ParameterSweep, GoesFromTheFirstValueToTheLastAtEqualSteps) {
  const std::vector<ParameterSweep> sweeps{parse_sweep("weave.warp_width=0.5:0.1"), parse_sweep("weave.height=0.25"),
                                           parse_sweep("weave.steps_along=4:7")};
  EXPECT_EQ(values_at(sweeps, 0, 3), (Values{{"height", "0.25"}, {"steps_along", "4"}, {"warp_width", "0.5"}}));
  EXPECT_EQ(values_at(sweeps, 1, 3), (Values{{"height", "0.25"}, {"steps_along", "6"}, {"warp_width", "0.3"}}));
  EXPECT_EQ(values_at(sweeps, 2, 3), (Values{{"height", "0.25"}, {"steps_along", "7"}, {"warp_width", "0.1"}}));
  EXPECT_EQ(values_at(sweeps, 0, 1).at("warp_width"), "0.5");
  const std::vector<ParameterSweep> word{parse_sweep("grooves.profile=round")};
  EXPECT_EQ(values_at(word, 1, 2), (Values{{"profile", "round"}}));
}

TEST(ParameterSweep, RefusesWhatDoesNotFit) {
  const std::vector<std::pair<std::string, std::string>> wrong{
      {"warp_width=0.1:0.5", "KIND.PARAMETER=FROM:TO"},
      {"weave.warp_width", "KIND.PARAMETER=FROM:TO"},
      {".warp_width=1", "KIND.PARAMETER=FROM:TO"},
      {"weeve.warp_width=0.1:0.5", "did you mean `weave`"},
      {"weave.warp_widht=0.1:0.5", "did you mean `warp_width`"},
      {"weave.warp_width=0.1:2", "`2` is not valid"},
      {"weave.warp_width=0.1:", "`` is not valid"},
      {"weave.warp_width=nan:0.5", "`nan` is not valid"},
      {"weave.steps_along=4.5:8", "whole number"},
      {"grooves.profile=v:round", "a word has nothing between"},
      {"grooves.profile=w", "unknown value"},
      {"flat.depth=1", "it has none"}};
  for (const auto& [text, expected] : wrong) {
    try {
      (void)parse_sweep(text);
      ADD_FAILURE() << text << " was taken";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage);
      EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("--set " + text), std::string::npos) << error.what();
    }
  }
}

TEST(ParameterSweep, BelongsToTheScenesKindOnce) {
  const std::vector<ParameterSweep> twice{parse_sweep("weave.height=0.1"), parse_sweep("weave.height=0.2")};
  EXPECT_THROW(check_sweeps(twice, find_patch_kind("weave")), Error);
  const std::vector<ParameterSweep> other{parse_sweep("noise.slope=0.1")};
  EXPECT_THROW(check_sweeps(other, find_patch_kind("weave")), Error);
  EXPECT_NO_THROW(check_sweeps(other, find_patch_kind("noise")));
}

}  // namespace
}  // namespace footprint

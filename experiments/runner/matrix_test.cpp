// [matrix] of an experiment's file: its members, what is said over slices of it, presets, and the one error of a wrong
// one.
#include "experiments/runner/experiment.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "experiments/runner/matrix.hpp"
#include "experiments/runner/run_experiment.hpp"
#include "experiments/settings/setting.hpp"
#include "renderer/core/error.hpp"
#include "scenes/surfaces/registry.hpp"
#include "tests/support/fresh_folder.hpp"
#include "tests/support/source_folder.hpp"

namespace footprint {
namespace {

namespace fs = std::filesystem;

const std::string no_scene = "[experiment]\ntitle = \"T\"\nmethods = [\"direct\", \"tan_gmm\"]\n";
const std::string varied =
    "[matrix]\nscene = [\"ribbed_plane\", \"bumps\"]\nsize = [\"16x16\", \"32x16\"]\n"
    "footprint = [\"trilinear\", \"box:3\"]\nseed = [1, 2]\n[zoom]\ndistances = [1, 4]\n";

class MatrixFile : public ::testing::Test {
 protected:
  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }

  // Reads the experiment as a command does: its scenes too.
  Experiment read(const std::string& text) const {
    Experiment experiment = read_experiment(write("mine.toml", text));
    experiment.run.scene_library = {.folder = testing::source_folder() / "scenes", .surfaces = all_surfaces()};
    check_against_scenes(experiment);
    return experiment;
  }

  void expect_complaint(const std::string& text, const std::string& place, const std::string& part) const {
    try {
      (void)read(text);
      ADD_FAILURE() << "was taken:\n" << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage);
      const std::string found = error.what();
      EXPECT_NE(found.find(place), std::string::npos) << found;
      EXPECT_NE(found.find(part), std::string::npos) << found;
    }
  }

  const fs::path folder_ = test::fresh_folder();
};

std::string claim(const std::string& inequality) {
  return "[[claim]]\nname = \"n\"\ntext = \"t\"\nreason = \"r\"\nexpect = \"reproduced\"\ninequality = \"" +
         inequality + "\"\n";
}

TEST_F(MatrixFile, MultipliesItsAxesOut) {
  const Experiment whole = read(no_scene + varied + claim("error(direct) > 0"));
  const std::vector<Experiment> members = members_of_matrix(whole);
  ASSERT_EQ(members.size(), 16U);
  EXPECT_EQ(members.front().name, "ribbed_plane-16x16-trilinear-seed1");
  EXPECT_EQ(members[1].name, "ribbed_plane-16x16-trilinear-seed2");
  EXPECT_EQ(members.back().name, "bumps-32x16-box_3-seed2");
  EXPECT_EQ(members.back().title, "T: scene bumps, size 32x16, footprint box:3, seed 2");
  EXPECT_EQ(members.back().run.scene, "bumps");
  EXPECT_EQ(members.back().run.view.size, glm::ivec2(32, 16));
  EXPECT_EQ(members.back().run.footprint, (FootprintFilter{FootprintFilterKind::box, 3}));
  EXPECT_EQ(members.back().run.reference.seed, 2U);
  std::set<std::string> names;
  for (const Experiment& member : members) {
    names.insert(member.name);
    EXPECT_TRUE(member.claims.empty()) << "it is said of the whole";
    EXPECT_TRUE(member.axes.empty());
  }
  EXPECT_EQ(names.size(), members.size());
}

TEST_F(MatrixFile, MethodsAreMultipliedByTheirOptions) {
  const Experiment experiment =
      read(no_scene + "scene = \"bumps\"\n[matrix.options]\ntan_gmm = { n = [1, 2], align = [\"on\", \"off\"] }\n");
  const std::vector<std::string> expected{"direct", "tan_gmm:align=on:n=1", "tan_gmm:align=on:n=2",
                                          "tan_gmm:align=off:n=1", "tan_gmm:align=off:n=2"};
  EXPECT_EQ(texts_of(experiment.run.methods), expected);
  EXPECT_TRUE(experiment.axes.empty()) << "one run: no members";
}

TEST_F(MatrixFile, HistoriesAreOptionsOfMethods) {
  const Experiment experiment = read(no_scene + "scene = \"bumps\"\nhistory_clamp = \"box\"\n[matrix.options]\n" +
                                     "direct = { history = [0, 24], history_alpha = [0.2] }\n" +
                                     claim("error(direct:history=24:history_alpha=0.2) < 1"));
  const std::vector<std::string> expected{"direct:history=0:history_alpha=0.2", "direct:history=24:history_alpha=0.2",
                                          "tan_gmm"};
  ASSERT_EQ(texts_of(experiment.run.methods), expected);
  const HistorySettings history = history_of(experiment.run.methods[1], experiment.run.history);
  EXPECT_EQ(history, (HistorySettings{.frames = 24, .alpha = 0.2, .clamp = HistoryClamp::box}));
  EXPECT_EQ(count_histories(experiment.run.methods, experiment.run.history), 1U);
  expect_complaint(no_scene + "scene = \"bumps\"\n[matrix.options]\ndirect = { history = [-1] }\n",
                   "mine.toml:", "history of method direct");
}

TEST_F(MatrixFile, IsRefusedAtItsLineBeforeAnythingIsRendered) {
  const auto complains = [&](const std::string& matrix, const std::string& part) {
    expect_complaint(no_scene + "[matrix]\n" + matrix, "mine.toml:", part);
  };
  complains("", "varies nothing");
  complains("scene = []\n", "list of strings or numbers");
  complains("scene = \"bumps\"\n", "list of strings or numbers");
  complains("scene = [\"bumps\", \"bumps\"]\n", "has `bumps` twice");
  complains("scene = [\"bumps\", \"\"]\n", "empty value");
  complains("scene = [\"bumps\"]\nfootprint = [\"box:3\", \"boks:3\"]\n", "did you mean");
  complains("scene = [\"bumps\"]\nsize = [\"16x16\", \"16\"]\n", "`16` is not a frame size");
  complains("scene = [\"bumps\"]\nseed = [1, -2]\n", "is not valid");
  complains("scenes = [\"bumps\"]\n", "did you mean `scene`");
  complains("scene = [\"bumps\"]\noptions = { toksvig = { storage = [\"fp16\"] } }\n", "no method `toksvig`");
  complains("scene = [\"bumps\"]\noptions = { tan_gmm = { m = [1] } }\n", "option");
  complains("scene = [\"bumps\"]\noptions = { tan_gmm = { n = [1, 1] } }\n", "twice");
  complains("scene = [\"bumps\"]\noptions = { tan_gmm = { n = [] } }\n", "list of strings or numbers");
  complains("scene = [\"bumps\"]\noptions = { tan_gmm = 1 }\n", "varies nothing");
  expect_complaint(no_scene + "scene = \"bumps\"\n[matrix]\nscene = [\"bumps\"]\n", "mine.toml:4", "also in [matrix]");
  expect_complaint(no_scene + "[matrix]\nscene = [\"bumps\"]\nseed = [1]\n[reference]\nseed = 2\n", "mine.toml:8",
                   "also in [matrix]");
  expect_complaint(no_scene + "[matrix]\nseed = [1]\n", "mine.toml:1", "`scene` in [experiment] is missing");
  expect_complaint(no_scene + "[matrix]\nscene = [\"bumps\", \"bumbs\"]\n", "bumbs: no such scene",
                   "did you mean `bumps`");
  std::string seeds = "1";
  for (int i = 2; i <= 501; ++i) seeds += "," + std::to_string(i);
  complains("scene = [\"bumps\", \"ribbed_plane\"]\nseed = [" + seeds + "]\n", "1002 members, 1000 at most");
  complains("scene = [\"bumps\"]\noptions = { tan_gmm = { n = [" + seeds + "] } }\n", "more than 200 methods");
}

TEST_F(MatrixFile, WhatItLacksIsRefused) {
  const auto complains = [&](const std::string& inequality, const std::string& part) {
    expect_complaint(no_scene + varied + claim(inequality), "mine.toml:", part);
  };
  EXPECT_EQ(read(no_scene + varied +
                 claim("error(tan_gmm, scene=bumps, size=32x16, footprint=box:3, seed=2, distance=4) < error(direct)"))
                .claims.size(),
            1U);
  complains("error(tan_gmm, scene=bump) < 1", "the matrix has no scene `bump`");
  complains("error(tan_gmm, scene=bump) < 1", "did you mean `bumps`");
  complains("error(tan_gmm, size=64x64) < 1", "no size `64x64`");
  complains("error(tan_gmm, footprint=ewa:8) < 1", "no footprint `ewa:8`");
  complains("error(tan_gmm, seed=3) < 1", "no seed `3`");
  complains("error(tan_gmm, distance=2) < 1", "it has 1, 4");
  complains("error(toksvig, scene=bumps) < 1", "no method `toksvig`");
  complains("error(tan_gmm, scene=bumps, scene=bumps) < 1", "the second one");
  expect_complaint(no_scene + "scene = \"bumps\"\n" + claim("error(direct, seed=1) < 1"),
                   "mine.toml:", "no matrix varies `seed`");
  expect_complaint(no_scene + varied + "[threshold]\n\"error(*, scene=bump)\" = 1\n", "mine.toml:", "no scene `bump`");
}

// Where scenes have zoom paths of their own, each slice has the distances of its scenes.
TEST_F(MatrixFile, DistancesAreThoseOfTheScenesOfTheSlice) {
  std::ifstream bumps(testing::source_folder() / "scenes/bumps/scene.toml");
  const std::string text{std::istreambuf_iterator<char>(bumps), {}};
  const std::string path = "distances = [1.0, 2.0, 4.0, 8.0, 16.0]";
  ASSERT_NE(text.find(path), std::string::npos);
  for (const auto& [name, own] : {std::pair("near", "distances = [1]"), std::pair("far", "distances = [7]")}) {
    fs::create_directories(folder_ / name);
    write(std::string(name) + "/scene.toml", std::string(text).replace(text.find(path), path.size(), own));
  }
  const std::string scenes = no_scene + "[matrix]\nscene = [\"near\", \"far\"]\n";
  EXPECT_EQ(read(scenes + claim("error(direct, distance=7) > 0")).claims.size(), 1U);
  EXPECT_EQ(read(scenes + claim("error(direct, scene=far, distance=7) > 0")).claims.size(), 1U);
  expect_complaint(scenes + claim("error(direct, scene=near, distance=7) > 0"), "mine.toml", "it has 1");
}

Results member_results(const Experiment& member, double error) {
  Results results;
  results.coordinates = member.coordinates;
  for (const double distance : {1.0, 4.0}) {
    Record& record = results.records.emplace_back();
    record.method = "direct";
    record.distance = distance;
    record.error.emplace().normalized_color = error * distance;
  }
  return results;
}

// Errors 1, 2, ... times the distance, by member: each slice has a mean of its own.
TEST_F(MatrixFile, SlicesAreMeansOverWhatTheSelectorsLeave) {
  const Experiment whole = read(no_scene +
                                "[matrix]\nscene = [\"bumps\", \"ribbed_plane\"]\nseed = [1, 2]\n[zoom]\n"
                                "distances = [1, 4]\n[threshold]\n\"error(direct)\" = 6\n"
                                "\"error(direct, scene=bumps)\" = 3.75\n\"error(direct, seed=2, distance=4)\" = 12\n"
                                "\"error(direct, scene=ribbed_plane, seed=1)\" = 7\n");
  std::vector<Results> runs;
  for (const Experiment& member : members_of_matrix(whole))
    runs.push_back(member_results(member, static_cast<double>(runs.size() + 1)));
  const ExperimentReport report = judge(whole, runs);
  std::map<std::string, double> measured;
  for (const ThresholdOutcome& outcome : report.thresholds) measured[outcome.measure] = outcome.measured.value();
  EXPECT_DOUBLE_EQ(measured.at("error(direct)"), 6.25);
  EXPECT_DOUBLE_EQ(measured.at("error(direct, scene=bumps)"), 3.75);
  EXPECT_DOUBLE_EQ(measured.at("error(direct, distance=4, seed=2)"), 12);
  EXPECT_DOUBLE_EQ(measured.at("error(direct, scene=ribbed_plane, seed=1)"), 7.5);
  EXPECT_EQ(report.shortfalls().size(), 2U) << "the first and the last";
}

TEST_F(MatrixFile, WhatIsOverMembersThatAreLeftOutIsNotJudged) {
  Experiment whole =
      read(no_scene + "[matrix]\nscene = [\"bumps\", \"ribbed_plane\"]\n[threshold]\n\"error(direct)\" = 1\n" +
           "\"error(direct, scene=bumps)\" = 1\n");
  EXPECT_EQ(leave_out(whole, {{{"scene", "ribbed_plane"}}}), std::vector<std::string>{"error(direct)"});
  ASSERT_EQ(whole.thresholds.size(), 1U);
  EXPECT_EQ(whole.thresholds[0].measure.text(), "error(direct, scene=bumps)");
}

TEST_F(MatrixFile, PresetsApplyWhereTheFileSaysNothing) {
  write("shared.toml",
        "[experiment]\nmethods = [\"direct\"]\nrepeats = 3\n[reference]\nspp = 8\nseed = 5\n[zoom]\ndistances = [1]\n"
        "[matrix]\nscene = [\"bumps\"]\nsize = [\"8x8\"]\n");
  const std::string with_presets = "[experiment]\ntitle = \"T\"\npresets = \"shared.toml\"\n";
  const Experiment experiment =
      read(with_presets + "repeats = 2\n[reference]\nspp = 4\n[matrix]\nscene = [\"ribbed_plane\"]\n");
  EXPECT_EQ(texts_of(experiment.run.methods), std::vector<std::string>{"direct"});
  EXPECT_EQ(experiment.run.timing.repeats, 2);
  EXPECT_EQ(experiment.run.reference.spp, 4);
  EXPECT_EQ(experiment.run.reference.seed, 5U);
  EXPECT_EQ(experiment.run.view.distances, std::vector<double>{1});
  EXPECT_EQ(members_of_matrix(experiment).front().name, "ribbed_plane-8x8");
  const Experiment zooms = read(with_presets + "[zoom]\nfrom = 1\nto = 2\nframes = 2\n");
  EXPECT_TRUE(zooms.run.view.distances.empty()) << "a zoom is taken whole or not at all";
  expect_complaint(with_presets + "scene = \"bumps\"\n", "mine.toml:4", "also in [matrix]");
  expect_complaint("[experiment]\ntitle = \"T\"\npresets = \"none.toml\"\n", "mine.toml:3", "which is not a file");
  expect_complaint("[experiment]\ntitle = \"T\"\npresets = \"shared.toml\"\nmembers = [\"a\"]\n", "mine.toml:3",
                   "excludes `members`");
  write("shared.toml", "[experiment]\ntitle = \"shared\"\n");
  expect_complaint(with_presets, "shared.toml:2", "unknown key `title`");
  write("shared.toml", "[[claim]]\nname = \"n\"\n");
  expect_complaint(with_presets, "shared.toml:1", "unknown key `claim`");
  write("shared.toml", "[experiment]\nscene = \"bumps\"\nmethods = [\"toksvg\"]\n");
  expect_complaint(with_presets, "shared.toml:3", "did you mean `toksvig`");
}

}  // namespace
}  // namespace footprint

// Thresholds within the reference's noise: refused while the run goes on, as soon as nothing that is to come can help.
#include "experiments/runner/matrix.hpp"
#include "experiments/runner/run_experiment.hpp"

#include <gtest/gtest.h>

#include "renderer/core/error.hpp"

namespace footprint {
namespace {

Experiment experiment_with(const std::string& measure, double limit) {
  Experiment experiment;
  experiment.name = "mine";
  experiment.run.view.distances = {1, 2};
  experiment.run.methods = {{.text = "direct", .name = "direct", .options = {}}};
  experiment.thresholds.push_back({.measure = Expression(measure, ""), .limit = limit, .place = "mine.toml:7"});
  return experiment;
}

// The records of a distance as soon as its reference is rendered.
Record floor_at(double distance, double floor) {
  Record record;
  record.method = "direct";
  record.distance = distance;
  record.frame = distance > 1 ? 1 : 0;
  RecordError& error = record.error.emplace();
  error.noise_floor = floor;
  error.causes.shading = 0.0;
  error.causes.shading_floor = floor / 2;
  return record;
}

std::string refusal(const RecordWatch& watch, const Record& record) {
  try {
    watch(std::span(&record, 1));
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    return error.what();
  }
  return {};
}

TEST(NoiseGuard, RefusesABoundOnOneDistanceAtOnce) {
  const Experiment experiment = experiment_with("error(direct, distance=2)", 0.01);
  NoiseGuard guard(experiment, std::span(&experiment, 1));
  const RecordWatch watch = guard.watch(experiment);
  EXPECT_EQ(refusal(watch, floor_at(1, 0.5)), "") << "not its distance";
  const std::string said = refusal(watch, floor_at(2, 0.01));
  EXPECT_NE(said.find("mine.toml:7"), std::string::npos) << said;
  EXPECT_NE(said.find("error(direct, distance=2) = 0.01"), std::string::npos) << said;
  EXPECT_NE(said.find("within the reference's noise"), std::string::npos) << said;
}

TEST(NoiseGuard, AMeanIsRefusedOnceTheRestCannotHelp) {
  const Experiment experiment = experiment_with("error(direct)", 0.01);
  NoiseGuard few(experiment, std::span(&experiment, 1));
  EXPECT_EQ(refusal(few.watch(experiment), floor_at(1, 0.018)), "") << "0.009 at least";
  EXPECT_NE(refusal(few.watch(experiment), floor_at(2, 0.003)), "");
  NoiseGuard many(experiment, std::span(&experiment, 1));
  EXPECT_NE(refusal(many.watch(experiment), floor_at(1, 0.02)), "") << "0.01 for any second distance";
}

TEST(NoiseGuard, HeedsWhatTheBoundIsOn) {
  const Experiment shading = experiment_with("shading_error(direct, distance=1)", 0.01);
  NoiseGuard guard(shading, std::span(&shading, 1));
  EXPECT_EQ(refusal(guard.watch(shading), floor_at(1, 0.018)), "") << "half of it over interior pixels";
  EXPECT_NE(refusal(guard.watch(shading), floor_at(1, 0.02)), "");
  const Experiment several = experiment_with("error(direct) / 2", 0.001);
  NoiseGuard arithmetic(several, std::span(&several, 1));
  EXPECT_EQ(refusal(arithmetic.watch(several), floor_at(1, 0.5)), "") << "not a bound on one error";
}

TEST(NoiseGuard, FlickerIsBetweenFrames) {
  const Experiment experiment = experiment_with("flicker(direct)", 0.01);
  NoiseGuard guard(experiment, std::span(&experiment, 1));
  const RecordWatch watch = guard.watch(experiment);
  EXPECT_EQ(refusal(watch, floor_at(1, 0.9)), "") << "a first frame, which has no flicker";
  Record second = floor_at(2, 0.9);
  second.flicker = Flicker{.mean = 0.02, .p99 = 0.1, .noise_floor = 0.009};
  EXPECT_EQ(refusal(watch, second), "");
  second.flicker->noise_floor = 0.01;
  EXPECT_NE(refusal(watch, second), "") << "it is over the second frame alone";
}

TEST(NoiseGuard, SlicesOfAMatrixHaveTheirOwnNoise) {
  Experiment whole = experiment_with("error(direct, scene=b)", 0.01);
  whole.axes = {{.key = "scene", .values = {"a", "b"}}};
  const std::vector<Experiment> members = members_of_matrix(whole);
  NoiseGuard guard(whole, members);
  EXPECT_EQ(refusal(guard.watch(members[0]), floor_at(1, 0.9)), "");
  EXPECT_NE(refusal(guard.watch(members[1]), floor_at(1, 0.02)), "");
}

TEST(NoiseGuard, AQuickRunIsNoMeasurement) {
  Experiment experiment = experiment_with("error(direct)", 1e-6);
  experiment.quick = true;
  NoiseGuard guard(experiment, std::span(&experiment, 1));
  EXPECT_FALSE(guard.watch(experiment));
}

}  // namespace
}  // namespace footprint

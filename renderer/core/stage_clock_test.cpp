// What a StageClock makes of progress reports.
#include "renderer/core/progress.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace footprint {
namespace {

TEST(StageClock, AddsUpAStageThatComesBack) {
  StageClock clock;
  std::vector<double> passed_on;
  const auto start = std::chrono::steady_clock::now();
  const Progress report = clock.callback([&](std::string_view, double fraction) { passed_on.push_back(fraction); });
  report("a", 0.0);
  std::this_thread::sleep_for(std::chrono::milliseconds(2));
  report("a", 0.25);
  report("b", 0.5);
  report("a", 0.75);
  std::this_thread::sleep_for(std::chrono::milliseconds(2));
  clock.stop();
  clock.stop();
  const std::chrono::duration<double> whole = std::chrono::steady_clock::now() - start;
  ASSERT_EQ(clock.times().size(), 2U);
  EXPECT_EQ(clock.times()[0].stage, "a");
  EXPECT_EQ(clock.times()[1].stage, "b");
  EXPECT_GE(clock.times()[0].seconds, 0.004);
  EXPECT_LE(clock.times()[0].seconds + clock.times()[1].seconds, whole.count());
  EXPECT_EQ(passed_on, (std::vector<double>{0.0, 0.25, 0.5, 0.75}));
}

TEST(StageClock, HasNoStagesBeforeTheFirstReport) {
  StageClock clock;
  clock.stop();
  EXPECT_TRUE(clock.times().empty());
}

}  // namespace
}  // namespace footprint

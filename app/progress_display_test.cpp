// The progress display on a made-up clock.
#include "app/messages.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <stdexcept>
#include <vector>

#include "renderer/core/error.hpp"
#include "renderer/core/process.hpp"

namespace footprint {
namespace {

using namespace std::chrono_literals;

// A display whose time the test sets and whose writes it keeps.
class ProgressDisplayTest : public testing::Test {
 protected:
  [[nodiscard]] ProgressDisplay display(ProgressStyle style, std::size_t columns = 80) {
    return {style, [this](std::string_view text) { written_.emplace_back(text); }, [this] { return now_; }, columns};
  }

  std::chrono::steady_clock::time_point now_;
  std::vector<std::string> written_;
};

TEST_F(ProgressDisplayTest, QuietWritesNothing) {
  {
    auto shown = display(ProgressStyle::quiet);
    shown.report("baking", 0.5);
  }
  EXPECT_TRUE(written_.empty());
}

TEST_F(ProgressDisplayTest, LinesAtTheEndOfEachStage) {
  {
    auto shown = display(ProgressStyle::lines);
    shown.report("baking", 0.0);
    shown.report("baking", 0.25);
    now_ += 600ms;
    shown.report("a short stage", 0.27);
    now_ += 100ms;
    shown.report("reference", 0.3);
    shown.report("reference", 1.0);
  }
  EXPECT_EQ(written_, (std::vector<std::string>{" 25 %  baking: done\n", "100 %  reference: done\n"}));
}

TEST_F(ProgressDisplayTest, LinesAtMostEveryTwoSeconds) {
  auto shown = display(ProgressStyle::lines);
  for (int i = 0; i <= 60; ++i) {
    shown.report("reference", i / 120.0);
    now_ += 100ms;
  }
  ASSERT_EQ(written_.size(), 3U);  // at 2, 4 and 6 of 6.1 seconds
  EXPECT_EQ(written_[2], " 50 %  reference, 6 s left\n");
}

TEST_F(ProgressDisplayTest, BarIsRedrawnTenTimesASecondAndCleared) {
  {
    auto shown = display(ProgressStyle::bar);
    for (int i = 0; i < 1000; ++i) {
      shown.report("reference", 0.5);
      now_ += 1ms;
    }
  }
  EXPECT_EQ(written_.size(), 11U);
  EXPECT_EQ(written_.front(), "\r\x1b[K[############------------]  50 %  reference");
  EXPECT_EQ(written_.back(), "\r\x1b[K");
}

// A stage that is slower than those before it: its own rate gives the time left, which counts down.
TEST_F(ProgressDisplayTest, TheTimeLeftNeverCountsUpWithinAStage) {
  auto shown = display(ProgressStyle::lines);
  shown.report("quick", 0.0);
  now_ += 2s;
  shown.report("quick", 0.5);
  double before = 1e9;
  int estimates = 0;
  for (int i = 0; i <= 100; ++i) {
    written_.clear();
    shown.report("slow", 0.5 + 0.001 * i);
    now_ += 2s;
    const auto at = written_.empty() ? std::string::npos : written_.back().find("slow, ");
    if (at == std::string::npos) continue;
    const std::string left = written_.back().substr(at + 6);
    double minutes = 0, seconds = 0;
    if (left.find("min") != std::string::npos) {
      minutes = std::stod(left);
      seconds = std::stod(left.substr(left.find("min") + 3));
    } else {
      seconds = std::stod(left);
    }
    EXPECT_LE(60 * minutes + seconds, before) << written_.back();
    before = 60 * minutes + seconds;
    ++estimates;
  }
  EXPECT_GT(estimates, 80);
  EXPECT_NEAR(before, 800, 10);
}

TEST_F(ProgressDisplayTest, BarFitsTheTerminal) {
  auto shown = display(ProgressStyle::bar, 20);
  shown.report("a stage with quite a long name", 0.0);
  EXPECT_EQ(written_.front().size(), std::string_view("\r\x1b[K").size() + 19);
}

TEST_F(ProgressDisplayTest, EstimatesLongTimesInMinutesAndHours) {
  auto shown = display(ProgressStyle::bar);
  shown.report("sweep", 0.0);
  now_ += 60s;
  shown.report("sweep", 0.25);
  EXPECT_NE(written_.back().find(", 3 min 00 s left"), std::string::npos) << written_.back();
  now_ += 60s;
  shown.report("sweep", 0.01);
  EXPECT_NE(written_.back().find(", 3 h 18 min left"), std::string::npos) << written_.back();
}

TEST_F(ProgressDisplayTest, FractionsOutOfRangeAreClamped) {
  auto shown = display(ProgressStyle::bar);
  for (const double fraction : {-1.0, 2.0, std::numeric_limits<double>::quiet_NaN()}) {
    now_ += 1s;
    shown.report("x", fraction);
  }
  ASSERT_EQ(written_.size(), 3U);
  EXPECT_NE(written_[0].find("   0 %"), std::string::npos);
  EXPECT_NE(written_[1].find(" 100 %"), std::string::npos);
  EXPECT_NE(written_[2].find("   0 %"), std::string::npos);
}

TEST_F(ProgressDisplayTest, FailedWorkIsNotCalledDone) {
  try {
    auto shown = display(ProgressStyle::lines);
    shown.report("reference", 0.5);
    throw std::runtime_error("failed");
  } catch (const std::runtime_error&) {
    EXPECT_TRUE(written_.empty());
  }
}

TEST_F(ProgressDisplayTest, ControlCComesThroughEvenIfQuiet) {
  watch_interrupts();
  auto shown = display(ProgressStyle::quiet);
  const Progress progress = shown.callback();
  EXPECT_NO_THROW(progress("x", 0.1));
  ASSERT_EQ(std::raise(SIGINT), 0);
  try {
    progress("x", 0.2);
    ADD_FAILURE() << "went on";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::interrupted);
  }
  watch_interrupts();  // forgets the signal
}

}  // namespace
}  // namespace footprint

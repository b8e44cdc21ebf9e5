// How long the stages of a piece of work take, told by its own progress reports.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "renderer/core/progress.hpp"

namespace footprint {

/// A stage by its name and the wall-clock seconds that it took.
struct StageTime {
  std::string stage;
  double seconds = 0.0;
};

/// A stage lasts from the report that names it to the next report of another name. One that comes back adds to its
/// time. Reports come from one thread.
class StageClock {
 public:
  /// A Progress that takes the time and passes every report on to `next`. Refers to this clock.
  [[nodiscard]] Progress callback(Progress next);

  /// Ends the stage that is running, if one is.
  void stop();

  /// The stages in the order in which they first came.
  [[nodiscard]] const std::vector<StageTime>& times() const { return times_; }

 private:
  using Clock = std::chrono::steady_clock;

  void report(std::string_view stage);

  std::vector<StageTime> times_;
  std::string running_;  // empty: none
  Clock::time_point start_;
};

}  // namespace footprint

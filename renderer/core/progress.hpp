// Progress reports of long work, and the time that its stages take.
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace footprint {

/// Called with what is being done and the fraction done of the whole job, 0 to 1. May throw Error{interrupted}.
using Progress = std::function<void(std::string_view what, double fraction)>;

/// A Progress that reports nothing.
inline void no_progress(std::string_view /*what*/, double /*fraction*/) {}

/// Shares one Progress among the parts of a job: each part takes a weight of the whole and reports 0 to 1 of itself.
class ProgressParts {
 public:
  ProgressParts(Progress whole, double total_weight) : whole_(std::move(whole)), total_(total_weight) {}

  /// The Progress of the next part; `prefix` goes before what it says.
  [[nodiscard]] Progress next(double weight, const std::string& prefix) {
    const double start = done_;
    done_ += weight;
    return [this, start, weight, prefix](std::string_view what, double fraction) {
      whole_(prefix + std::string(what), (start + weight * fraction) / total_);
    };
  }

 private:
  Progress whole_;
  double total_;
  double done_ = 0;
};

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

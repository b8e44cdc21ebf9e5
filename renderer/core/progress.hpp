// Progress reports of long work, and the time that its stages take.
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace footprint {

/// Called with the current activity and the finished fraction of the whole job, 0 to 1. May throw Error (interrupted).
using Progress = std::function<void(std::string_view what, double fraction)>;

/// A Progress that reports nothing.
inline void no_progress(std::string_view /*what*/, double /*fraction*/) {}

/// Splits one Progress into parts of given weights; each part reports 0 to 1 of itself.
class ProgressParts {
 public:
  ProgressParts(Progress whole, double total_weight) : whole_(std::move(whole)), total_(total_weight) {}

  /// The Progress of the next part.
  /// prefix: precedes its activities.
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

/// A stage and its wall-clock seconds.
struct StageTime {
  std::string stage;
  double seconds = 0.0;
};

/// Measures stages of work by its progress reports. A stage lasts from the report that names it to the next report of
/// another name; times of equal names add up. Reports must come from one thread.
class StageClock {
 public:
  /// A Progress that measures and forwards reports to `next`. It refers to this clock.
  [[nodiscard]] Progress callback(Progress next);

  /// Ends the current stage, if any.
  void stop();

  /// The stages in the order of their first report.
  [[nodiscard]] const std::vector<StageTime>& times() const { return times_; }

 private:
  using Clock = std::chrono::steady_clock;

  void report(std::string_view stage);

  std::vector<StageTime> times_;
  std::string running_;  // empty: none
  Clock::time_point start_;
};

}  // namespace footprint

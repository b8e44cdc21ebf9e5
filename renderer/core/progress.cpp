// A stage lasts from the report that names it to the next report of another; times of a stage that recurs add up.
#include "renderer/core/progress.hpp"

#include <algorithm>

namespace footprint {

Progress StageClock::callback(Progress next) {
  return [this, next = std::move(next)](std::string_view what, double fraction) {
    report(what);
    next(what, fraction);
  };
}

void StageClock::report(std::string_view stage) {
  if (stage == running_) return;
  stop();
  running_ = stage;
  start_ = Clock::now();
}

void StageClock::stop() {
  if (running_.empty()) return;
  const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
  const auto known = std::ranges::find(times_, running_, &StageTime::stage);
  if (known == times_.end()) {
    times_.push_back({running_, seconds});
  } else {
    known->seconds += seconds;
  }
  running_.clear();
}

}  // namespace footprint

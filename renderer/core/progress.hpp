// How long work reports how far it is; what becomes of the report is the caller's business.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>

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

}  // namespace footprint

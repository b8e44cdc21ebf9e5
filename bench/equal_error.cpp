// Errors are normalised colour errors over the object's pixels (docs/metrics.md), as the papers have them.
#include "bench/equal_error.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/bench_scene.hpp"
#include "experiments/studies/exposure.hpp"
#include "renderer/core/error.hpp"
#include "renderer/image/metrics.hpp"
#include "renderer/pipeline/timing.hpp"

namespace footprint::bench {
namespace {

constexpr std::uint64_t other_seed = 0x9e3779b97f4a7c15;  // keeps the samples that are judged apart from the truth's
constexpr std::uint64_t noise_seed = 0xbf58476d1ce4e5b9;  // and those of the second reference

}  // namespace

EqualErrors::EqualErrors(const Stage& stage, const View& view, int truth_samples) : stage_(&stage), view_(view) {
  if (truth_samples < 4 || truth_samples > 4096) {
    throw Error(ErrorKind::usage, fmt::format("{} samples", truth_samples),
                "errors need a reference of 4 to 4096 samples per pixel", "give as many");
  }
  truth_ = stage.reference().render(view, truth_samples, reference_seed, no_progress).mean;
  exposure_ = choose_exposure({}, stage.scene(), truth_).factor;
  for (int samples = 1; samples <= truth_samples / 4; samples *= 2) {
    errors_.push_back(error_of(stage.reference().render_mean(view, samples, reference_seed ^ other_seed, no_progress)));
  }
  noise_ = error_of(stage.reference().render(view, truth_samples, reference_seed ^ noise_seed, no_progress).mean);
}

double EqualErrors::error_of(const Image& picture) const {
  const std::optional<double> error = normalized_color(picture, truth_, exposure_);
  if (!error) {
    throw Error(ErrorKind::usage, stage_->scene().name, "no pixel shows the object, so that there is no error",
                "go nearer");
  }
  return *error;
}

EqualError EqualErrors::of(const StagedMethod& method) const {
  EqualError found{.error = error_of(method.frames().render(view_)), .noise = noise_, .samples = {}};
  const auto reached = std::ranges::find_if(errors_, [&](double error) { return error <= found.error; });
  if (reached != errors_.end()) found.samples = 1 << (reached - errors_.begin());
  return found;
}

int EqualErrors::most_samples() const { return 1 << (errors_.size() - 1); }

std::string described(const EqualError& found, int most_samples, const std::vector<double>& frame_ms,
                      const std::vector<double>& samples_ms) {
  const std::string samples =
      found.samples ? fmt::format("{} samples", *found.samples) : fmt::format("better than {} samples", most_samples);
  return fmt::format("error {:.4f} (noise {:.4f}): {}, {:.2f} x their time", found.error, found.noise, samples,
                     quantile(paired_ratios(frame_ms, samples_ms), 0.5));
}

}  // namespace footprint::bench

// Scales in round figures, so that pictures of several runs often share one.
#include "experiments/studies/error_pictures.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "renderer/pipeline/timing.hpp"

namespace footprint {
namespace {

constexpr double scale_quantile = 0.99;
constexpr double smallest_error_scale = 0.01;

std::string write_on_scale(const std::filesystem::path& folder, const Draft& draft, const std::string& end,
                           double top) {
  return write_error_picture(folder, draft.stem + end, draft.exhibit.error, static_cast<float>(top));
}

}  // namespace

double error_scale(std::span<const Draft> drafts, const std::optional<double>& asked) {
  if (asked) return *asked;
  double scale = smallest_error_scale;
  for (const Draft& draft : drafts) {
    std::vector<double> values;
    std::ranges::copy_if(draft.exhibit.error.texels, std::back_inserter(values), [](float v) { return v > 0.0F; });
    if (!values.empty()) scale = std::max(scale, quantile(std::move(values), scale_quantile));
  }
  const double step = std::pow(10.0, std::floor(std::log10(scale)) - 1.0);
  return std::ceil(scale / step) * step;
}

void write_error_pictures(const std::filesystem::path& folder, std::span<Draft> drafts, double scale) {
  for (Draft& draft : drafts) {
    if (draft.record.failure) continue;
    RecordImages& images = draft.record.images;
    images.error = write_on_scale(folder, draft, "_error", scale);
    images.error_shared = images.error;
  }
}

void write_shared_error_pictures(const std::filesystem::path& folder, std::span<Draft> drafts, double shared) {
  for (Draft& draft : drafts) {
    if (!draft.record.failure)
      draft.record.images.error_shared = write_on_scale(folder, draft, "_error_shared", shared);
  }
}

void write_distance_strips(const std::filesystem::path& folder, Exhibit reference, std::span<const Draft> drafts,
                           float exposure, double scale) {
  std::vector<Exhibit> exhibits{std::move(reference)};
  for (const Draft& draft : drafts) {
    if (!draft.record.failure) exhibits.push_back(draft.exhibit);
  }
  write_strips(folder, distance_stem(drafts.front().record.distance, "all"), exhibits, exposure,
               static_cast<float>(scale));
}

}  // namespace footprint

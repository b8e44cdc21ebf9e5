// Scales in round figures, so that images of several runs often share one.
#include "experiments/studies/error_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

#include "experiments/studies/picture_files.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/image/metrics.hpp"
#include "renderer/pipeline/supersample.hpp"
#include "renderer/pipeline/timing.hpp"

namespace footprint {
namespace {

constexpr double scale_quantile = 0.99;
constexpr double smallest_error_scale = 0.01;

Image read_back(const std::filesystem::path& folder, const std::string& file) {
  return read_image(folder / file, Transfer::linear);
}

// The reference without the pixels that no figure includes.
Image counted_reference(const std::filesystem::path& folder, const DistanceResult& result) {
  Image reference = read_back(folder, result.reference);
  Image mask(reference.width, reference.height, 1);
  for (const std::uint32_t pixel : result.unresolved) {
    if (pixel < mask.texels.size()) mask.texels[pixel] = 1.0F;
  }
  uncover(reference, mask);
  return reference;
}

std::string error_file(const std::filesystem::path& folder, const Record& record, const std::string& end,
                       const Image& error, double top) {
  const std::string stem = std::filesystem::path(record.images.color).stem().string();
  return write_error_picture(folder, stem + end, error, static_cast<float>(top));
}

}  // namespace

double error_percentile(const Image& error) {
  std::vector<double> values;
  std::ranges::copy_if(error.texels, std::back_inserter(values), [](float v) { return v > 0.0F; });
  return values.empty() ? 0.0 : quantile(std::move(values), scale_quantile);
}

double error_scale(double largest, const std::optional<double>& given) {
  if (given) return *given;
  const double scale = std::max(largest, smallest_error_scale);
  const double step = std::pow(10.0, std::floor(std::log10(scale)) - 1.0);
  return std::ceil(scale / step) * step;
}

void write_error_images(const std::filesystem::path& folder, DistanceResult& result, double top) {
  const Image reference = counted_reference(folder, result);
  std::vector<StripPanel> panels{{.caption = fmt::format("reference, {:.0f} spp", result.samples),
                                  .picture = read_back(folder, result.reference),
                                  .error = {}}};
  for (Record& record : result.records) {
    if (record.failure) continue;
    Image picture = read_back(folder, record.images.color);
    Image error = error_map(picture, reference, result.exposure.factor);
    record.images.error = error_file(folder, record, "_error", error, top);
    record.images.error_shared = record.images.error;
    panels.push_back({.caption = record.method, .picture = std::move(picture), .error = std::move(error)});
  }
  write_strips(folder, distance_stem(result.distance, "all"), panels, result.exposure.factor, static_cast<float>(top));
}

void write_shared_error_images(const std::filesystem::path& folder, DistanceResult& result, double top) {
  const Image reference = counted_reference(folder, result);
  for (Record& record : result.records) {
    if (record.failure) continue;
    const Image error = error_map(read_back(folder, record.images.color), reference, result.exposure.factor);
    record.images.error_shared = error_file(folder, record, "_error_shared", error, top);
  }
}

}  // namespace footprint

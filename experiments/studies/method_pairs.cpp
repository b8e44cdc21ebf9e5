// One picture of verdicts for each two methods.
#include "experiments/studies/method_pairs.hpp"

#include <fmt/format.h>

#include "experiments/studies/picture_files.hpp"
#include "experiments/studies/score.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/image/metrics.hpp"

namespace footprint {
namespace {

std::string write_verdicts(const std::filesystem::path& folder, const std::string& stem, const Image& verdicts,
                           const Image& object) {
  std::string file = fmt::format("images/{}.png", stem);
  write_png(folder / file, verdict_picture(verdicts, object));
  return file;
}

std::vector<std::array<double, 2>> shares_by_material(const Image& verdicts, const ReferenceView& target) {
  std::vector<std::array<double, 2>> shares;
  for (const Image& mask : target.materials) {
    const CloserShares own = closer_shares(verdicts, mask).value_or(CloserShares{});
    shares.push_back({own.a, own.b});
  }
  return shares;
}

}  // namespace

std::vector<MethodPair> compare_pairs(const std::filesystem::path& folder, std::span<const Record> records,
                                      std::span<const Image> images, std::span<const std::string> names,
                                      const ReferenceView& target, float exposure) {
  const Image object = object_pixels(target.reference.mean);
  std::vector<MethodPair> pairs;
  for (std::size_t i = 0; i < records.size(); ++i) {
    for (std::size_t j = i + 1; j < records.size(); ++j) {
      if (records[i].failure || records[j].failure) continue;
      const std::optional<Image> verdicts = closer_beyond_noise(images[i], images[j], target.reference, exposure);
      const auto shares = verdicts ? closer_shares(*verdicts, target.parts.interior) : std::nullopt;
      if (!shares) continue;
      const std::string stem = fmt::format("{}_or_{}", distance_stem(target.at.distance, names[i]), names[j]);
      pairs.push_back({.distance = target.at.distance,
                       .methods = {records[i].method, records[j].method},
                       .closer = {shares->a, shares->b},
                       .materials = shares_by_material(*verdicts, target),
                       .picture = write_verdicts(folder, stem, *verdicts, object)});
    }
  }
  return pairs;
}

}  // namespace footprint

// One picture of verdicts for each two methods.
#include "experiments/studies/method_pairs.hpp"

#include <fmt/format.h>

#include "experiments/studies/significance.hpp"
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

std::vector<std::array<double, 2>> shares_by_material(const Image& verdicts, const Truth& truth) {
  std::vector<std::array<double, 2>> shares;
  for (const Image& mask : truth.materials) {
    const CloserShares own = closer_shares(verdicts, mask).value_or(CloserShares{});
    shares.push_back({own.a, own.b});
  }
  return shares;
}

}  // namespace

std::vector<MethodPair> compare_pairs(const std::filesystem::path& folder, std::span<const Draft> drafts,
                                      const Truth& truth, float exposure) {
  const Image object = object_pixels(truth.reference.mean);
  std::vector<MethodPair> pairs;
  for (std::size_t i = 0; i < drafts.size(); ++i) {
    for (std::size_t j = i + 1; j < drafts.size(); ++j) {
      if (drafts[i].record.failure || drafts[j].record.failure) continue;
      const std::optional<Image> verdicts =
          closer_beyond_noise(drafts[i].exhibit.picture, drafts[j].exhibit.picture, truth.reference, exposure);
      const auto shares = verdicts ? closer_shares(*verdicts, truth.parts.interior) : std::nullopt;
      if (!shares) continue;
      const std::string stem = fmt::format("{}_or_{}", drafts[i].stem, drafts[j].name);
      pairs.push_back({.distance = truth.distance,
                       .methods = {drafts[i].record.method, drafts[j].record.method},
                       .closer = {shares->a, shares->b},
                       .materials = shares_by_material(*verdicts, truth),
                       .picture = write_verdicts(folder, stem, *verdicts, object)});
    }
  }
  return pairs;
}

}  // namespace footprint

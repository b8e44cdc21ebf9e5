// Verdicts in Okabe and Ito's colours, which every kind of colour vision tells apart.
#include "experiments/studies/method_pairs.hpp"

#include <fmt/format.h>

#include <array>

#include "experiments/studies/significance.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/image/metrics.hpp"

namespace footprint {
namespace {

using Color = std::array<float, 3>;  // display values; results/report/page.css has them too

constexpr Color first_closer{0.0F, 0.447F, 0.698F}, second_closer{0.835F, 0.369F, 0.0F}, undecided{0.8F, 0.8F, 0.8F};
constexpr Color outside{1.0F, 1.0F, 1.0F};

Color color_of(float verdict, bool on_object) {
  if (!on_object) return outside;
  return verdict > 0.0F ? first_closer : verdict < 0.0F ? second_closer : undecided;
}

std::string write_verdicts(const std::filesystem::path& folder, const std::string& stem, const Image& verdicts,
                           const Image& object) {
  Image picture(verdicts.width, verdicts.height, 3);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x)
      std::ranges::copy(color_of(verdicts.at(x, y)[0], object.at(x, y)[0] > 0.0F), picture.at(x, y).begin());
  }
  std::string file = fmt::format("images/{}.png", stem);
  write_png(folder / file, picture);
  return file;
}

}  // namespace

std::vector<MethodPair> compare_pairs(const std::filesystem::path& folder, std::span<const Draft> drafts,
                                      const Truth& truth, float exposure) {
  const Image object = object_pixels(truth.reference.mean);
  std::vector<MethodPair> pairs;
  for (std::size_t i = 0; i < drafts.size(); ++i) {
    for (std::size_t j = i + 1; j < drafts.size(); ++j) {
      const std::optional<Image> verdicts =
          closer_beyond_noise(drafts[i].exhibit.picture, drafts[j].exhibit.picture, truth.reference, exposure);
      const auto shares = verdicts ? closer_shares(*verdicts, truth.parts.interior) : std::nullopt;
      if (!shares) continue;
      const std::string stem = fmt::format("{}_or_{}", drafts[i].stem, drafts[j].name);
      pairs.push_back({.distance = truth.distance,
                       .methods = {drafts[i].record.method, drafts[j].record.method},
                       .closer = {shares->a, shares->b},
                       .picture = write_verdicts(folder, stem, *verdicts, object)});
    }
  }
  return pairs;
}

}  // namespace footprint

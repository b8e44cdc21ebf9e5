// Bins of the logarithm of the variance.
#include "methods/best_lobes/roughness_groups.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "methods/cells/halves.hpp"

namespace footprint::best_lobes {

RoughnessGroups roughness_groups(const Material& material, int width, int height) {
  constexpr double bins_per_octave = 1024.0;
  struct Bin {
    std::uint32_t group;
    double sum, count;
  };
  const std::vector<double> variances = cells::texel_variances(material, width, height);
  std::map<double, Bin> bins;
  RoughnessGroups out{.narrowest = std::numeric_limits<double>::infinity(), .of_texels = {}, .spreads = {}};
  for (const double variance : variances) {
    const double key = std::floor(bins_per_octave * std::log2(std::max(variance, 1e-12)));
    Bin& bin = bins.try_emplace(key, static_cast<std::uint32_t>(bins.size()), 0.0, 0.0).first->second;
    bin.sum += variance;
    bin.count += 1.0;
    out.of_texels.push_back(bin.group);
  }
  for (const auto& [key, bin] : bins) out.narrowest = std::min(out.narrowest, bin.sum / bin.count);
  out.spreads.resize(bins.size());
  for (const auto& [key, bin] : bins) out.spreads[bin.group] = bin.sum / bin.count - out.narrowest;
  return out;
}

}  // namespace footprint::best_lobes

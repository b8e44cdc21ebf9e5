// The narrowest lobe of a material against what rounding makes of normals.
#include "renderer/bake/storage_range.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "renderer/bake/facet_lobes.hpp"
#include "renderer/bake/normal_chain.hpp"

namespace footprint {
namespace {

// Slope variances from which on every method holds the lobe over a tilted map.
constexpr double least_in_half_floats = 2e-4;
constexpr double least_in_bytes = 0.02;

double narrowest_variance(const Material& material) {
  if (!material.lobes.empty()) return mean_lobe_variance(material);
  const Image variances = lobe_variance_map(material);
  return *std::ranges::min_element(variances.texels);
}

}  // namespace

std::optional<std::string> storage_range_note(const Material& material, const MethodInfo& info, const Options& options,
                                              const EffectSet& effects) {
  if (info.lobes_as_given || !has(effects, Effect::normal_variation) || !options.all().contains("storage")) return {};
  const std::string& storage = options.word("storage");
  const double least = storage == "unorm8" ? least_in_bytes : storage == "fp16" ? least_in_half_floats : 0.0;
  if (least == 0.0) return {};
  const double narrowest = narrowest_variance(material);
  if (narrowest >= least) return {};
  return fmt::format(
      "storage={} can store slope variances from {:g} on, but this material's narrowest lobe has {:.2g}: its "
      "highlights "
      "are off (docs/stability.md)",
      storage, least, narrowest);
}

}  // namespace footprint

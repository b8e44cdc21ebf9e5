// Footprints and mixtures: shares that sum to one, however a rectangle cuts texels or a filter weighs them, and fits
// that never become less likely.
#include <algorithm>
#include <numeric>

#include "methods/tan_gmm/em.hpp"
#include "renderer/ndf/footprint_texels.hpp"
#include "tests/properties/inputs.hpp"
#include "tests/support/filter_kernel.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

Material any_material() { return square_scene(normal_map(), {}).materials.front(); }

FootprintRect any_rect() {
  const glm::dvec2 lower(number(-3, 3), number(-3, 3));
  return {lower, lower + glm::dvec2(magnitude(1e-3, 4), magnitude(1e-3, 4))};
}

RC_GTEST_PROP(Clipping, CoversAllOfARectangle, ()) {
  const Material material = any_material();
  const FootprintRect rect = any_rect();
  const FootprintTexels under = texels_under(material, rect);
  const double sum = std::accumulate(under.facets.begin(), under.facets.end(), 0.0,
                                     [](double so_far, const WeightedFacet& facet) { return so_far + facet.share; });
  const Image map = material.normal_map->image.decoded();
  const double texels = rect.size().x * map.width * rect.size().y * map.height;
  RC_ASSERT(std::abs(sum - 1.0) <= 1e-9);
  RC_ASSERT(std::abs(under.texels - texels) <= 1e-9 * texels);
  for (const WeightedFacet& facet : under.facets) RC_ASSERT(facet.share > 0.0);
}

// Halves of a rectangle together have the texels of the whole: no texel is counted twice, none is lost at the cut.
RC_GTEST_PROP(Clipping, OfHalvesIsThatOfTheWhole, ()) {
  const Material material = any_material();
  const FootprintRect rect = any_rect();
  const double cut = rect.lower.x + number(0.1, 0.9) * rect.size().x;
  const auto mean = [&](const FootprintRect& part) {
    glm::dvec3 sum(0.0);
    for (const WeightedFacet& facet : texels_under(material, part).facets) sum += facet.share * facet.normal;
    return sum;
  };
  const double left = (cut - rect.lower.x) / rect.size().x;
  const glm::dvec3 halves =
      left * mean({rect.lower, {cut, rect.upper.y}}) + (1.0 - left) * mean({{cut, rect.lower.y}, rect.upper});
  RC_ASSERT(glm::length(halves - mean(rect)) <= 1e-8);
}

RC_GTEST_PROP(Merging, KeepsSharesAndTheMeanNormal, ()) {
  const std::vector<WeightedFacet> facets = texels_under(any_material(), any_rect()).facets;
  const std::vector<WeightedFacet> merged = merged_facets(facets, magnitude(1e-4, 1.0));
  const auto sums = [](const std::vector<WeightedFacet>& of) {
    glm::dvec4 sum(0.0);
    for (const WeightedFacet& facet : of) sum += facet.share * glm::dvec4(facet.normal, 1.0);
    return sum;
  };
  RC_ASSERT(merged.size() <= facets.size());
  RC_ASSERT(glm::length(sums(merged) - sums(facets)) <= 1e-9);
}

FootprintFilter any_filter() {
  const auto words = footprint_filter_words();
  const FootprintFilterWord& word =
      words[static_cast<std::size_t>(*rc::gen::inRange<int>(0, static_cast<int>(words.size())))];
  RC_PRE(!word.stochastic);  // without a fixed set of lookups
  return {word.kind, *rc::gen::inRange(word.least, word.most + 1)};
}

RC_GTEST_PROP(FilterKernels, SumToOne, ()) {
  const FootprintFilter filter = any_filter();
  const double angle = number(0.0, 2.0 * std::numbers::pi), other = angle + number(0.05, 3.0);
  const double length = magnitude(0.01, 100), width = magnitude(0.01, 100);
  const TexelFootprint footprint{{number(-40, 40), number(-40, 40)},
                                 length * glm::dvec2(std::cos(angle), std::sin(angle)),
                                 width * glm::dvec2(std::cos(other), std::sin(other))};
  const ProbeSet set = probes_of(filter, footprint);
  double weights = 0.0;
  for (const Probe& probe : set.probes) {
    RC_ASSERT(probe.weight >= 0.0);
    weights += probe.weight;
  }
  RC_ASSERT(std::isfinite(set.level));
  RC_ASSERT(std::abs(weights - 1.0) <= 1e-9);
  const Image kernel = filter_kernel(filter, footprint, 16);
  RC_ASSERT(std::abs(std::accumulate(kernel.texels.begin(), kernel.texels.end(), 0.0) - 1.0) <= 1e-5);
  RC_ASSERT(*std::ranges::min_element(kernel.texels) >= 0.0F);
}

tan_gmm::Samples any_samples() {
  tan_gmm::Samples samples;
  const int count = *rc::gen::inRange(1, 60);
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 n = upper_direction();
    samples.add(static_cast<float>(n.x), static_cast<float>(n.y), 0.0F, static_cast<float>(magnitude(0.01, 10)));
  }
  return samples;
}

RC_GTEST_PROP(Mixtures, BecomeNoLessLikelyAndStaySums, ()) {
  const tan_gmm::Samples samples = any_samples();
  std::vector<tan_gmm::Gaussian> mixture(static_cast<std::size_t>(*rc::gen::inRange(1, 5)));
  for (tan_gmm::Gaussian& g : mixture)
    g = {1.0F / static_cast<float>(mixture.size()), static_cast<float>(number(-0.7, 0.7)),
         static_cast<float>(number(-0.7, 0.7)), static_cast<float>(magnitude(1e-3, 1))};
  double before = tan_gmm::expectation(samples, mixture).log_likelihood;
  for (int step = 0; step < 5; ++step) {
    tan_gmm::maximise(tan_gmm::expectation(samples, mixture), tan_gmm::Prior(0.0), tan_gmm::MStep::exact, mixture);
    double sum = 0.0;
    for (const tan_gmm::Gaussian& g : mixture) {
      RC_ASSERT(std::isfinite(g.x) && std::isfinite(g.y) && g.variance >= tan_gmm::variance_floor);
      RC_ASSERT(g.alpha >= 0.0F);
      sum += g.alpha;
    }
    RC_ASSERT(std::abs(sum - 1.0) <= 1e-5);
    const double after = tan_gmm::expectation(samples, mixture).log_likelihood;
    // Parameters are 32 bits; the floor of the variance may cost likelihood, of a single point alone.
    RC_ASSERT(std::isfinite(after));
    RC_ASSERT(after >= before - 1e-3 * (1.0 + std::abs(before)));
    before = after;
  }
}

}  // namespace
}  // namespace footprint::testing

// Fits the normalised luminance as a density of directions by the EM of the NDF, and divides the colours by its shares.
#include "methods/iwasaki_sg/environment_gaussians.hpp"

#include <algorithm>
#include <cmath>

#include "methods/iwasaki_sg/lobe_fit.hpp"
#include "renderer/environment/reference_tables.hpp"
#include "renderer/scene/small_sun.hpp"

namespace footprint::iwasaki_sg {
namespace {

constexpr double even_sharpness = 1e-2;  // of light from all sides alike

// log of a Gaussian of integral 1 at a direction.
double log_density(const SphericalGaussian& lobe, const glm::dvec3& direction) {
  return -lobe.sharpness * one_minus_dot(lobe.axis, direction) - std::log(vmf_integral(lobe.sharpness));
}

// Adds the light of a direction to the Gaussians, by their shares there.
void divide(const DenseLight& light, const std::vector<double>& shares, std::vector<LightGaussian>& gaussians) {
  std::vector<double> weights;
  for (std::size_t k = 0; k < gaussians.size(); ++k)
    weights.push_back(std::log(shares[k]) + log_density(gaussians[k].lobe, glm::dvec3(light.direction)));
  const double largest = *std::ranges::max_element(weights);
  double sum = 0.0;
  for (double& weight : weights) sum += weight = std::exp(weight - largest);
  for (std::size_t k = 0; k < gaussians.size(); ++k)
    gaussians[k].light += weights[k] / sum * glm::dvec3(light.irradiance);
}

}  // namespace

std::vector<LightGaussian> light_gaussians(const Environment& environment) {
  const std::vector<DenseLight> lights = dense_lights(suns_apart(environment).rest);
  std::vector<WeightedNormal> directions;
  for (const DenseLight& light : lights) {
    const glm::dvec3 color(light.irradiance);
    directions.push_back({glm::normalize(glm::dvec3(light.direction)), color.x + color.y + color.z});
  }
  if (directions.empty()) return {};
  const NdfFit fit = fit_ndf(directions, environment_gaussians);
  std::vector<LightGaussian> gaussians;
  for (const SphericalGaussian& lobe : fit.lobes) gaussians.push_back({.lobe = lobe});
  for (const DenseLight& light : lights) divide(light, fit.shares, gaussians);
  return gaussians;
}

PrefilteredTexture environment_texture(const Environment& environment) {
  std::vector<LightGaussian> gaussians = light_gaussians(environment);
  if (gaussians.empty()) gaussians.push_back({.lobe = {.axis = {0.0, 0.0, 1.0}, .sharpness = even_sharpness}});
  Image image(static_cast<int>(gaussians.size()), 2, 4);
  for (int k = 0; k < image.width; ++k) {
    const LightGaussian& gaussian = gaussians[static_cast<std::size_t>(k)];
    const glm::vec4 lobe(glm::vec3(gaussian.lobe.axis), static_cast<float>(gaussian.lobe.sharpness));
    const glm::vec4 light(glm::vec3(gaussian.light), 0.0F);
    std::copy_n(&lobe.x, 4, image.at(k, 0).begin());
    std::copy_n(&light.x, 4, image.at(k, 1).begin());
  }
  return make_texture("iwasaki_environment", {image}, Storage::fp32, {});
}

}  // namespace footprint::iwasaki_sg

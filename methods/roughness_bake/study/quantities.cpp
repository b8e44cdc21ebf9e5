// What a constant leaves of the true distribution of normals, and the best one, as experiments ask for them.
#include "methods/quantities.hpp"

#include <array>

#include "methods/roughness_bake/presets.hpp"
#include "methods/roughness_bake/study/best_constant.hpp"

namespace footprint {
namespace {

using namespace roughness_bake;

const std::vector<OptionSpec>& surface_parameters() {
  static const std::vector<OptionSpec> parameters{
      number_option("alpha", 0.2, 0.01, 1.0, "Of the base lobe: its square is twice its slope variance per axis."),
      number_option("sigma", 0.2, 0.001, 1.0, "Deviation per axis of the texels' slopes, an even Gaussian.")};
  return parameters;
}

double measured_best(const Material& material, const Options& /*options*/, const Options& parameters) {
  const std::array<double, 1> sigma{parameters.number("sigma")};
  return best_constant(material.brdf.distribution, parameters.number("alpha"), sigma);
}

double measured_error(const Material& material, const Options& options, const Options& parameters) {
  const Formula formula = formula_of(options);
  const double alpha = parameters.number("alpha");
  const WidenedLobe lobe(material.brdf.distribution, alpha, parameters.number("sigma"));
  const double stored = stored_spread(formula.preset, lobe.shortfall());
  return lobe.error_of(widened_alpha2(formula, material.brdf.distribution, alpha * alpha, stored));
}

}  // namespace

std::span<const Quantity> roughness_bake_quantities() {
  static const std::vector<Quantity> quantities{
      {.name = "best_constant",
       .summary = "The constant c of alpha^2 + c / kappa whose lobe is closest to the true distribution of normals.",
       .parameters = surface_parameters(),
       .measure = measured_best},
      {.name = "ndf_error",
       .summary = "Relative L2 difference over solid angle of the preset's lobe from the true distribution of normals.",
       .parameters = surface_parameters(),
       .measure = measured_error}};
  return quantities;
}

}  // namespace footprint

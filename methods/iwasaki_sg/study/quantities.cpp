// Measures the fit, the effective BRDF, a dense table of it and the time of each stage.
#include <algorithm>
#include <chrono>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "methods/iwasaki_sg/material_table.hpp"
#include "methods/iwasaki_sg/study/effective_brdf.hpp"
#include "methods/registry.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/progress.hpp"
#include "renderer/microgeometry/microgeometry.hpp"

namespace footprint::iwasaki_sg {
namespace {

// A material with a patch, its settings by the options, and the parameters of the quantity.
struct Measured {
  const Material& material;
  const Options& options;
  const Options& parameters;
  TableSettings settings;

  [[nodiscard]] const Patch& patch() const { return material.microgeometry->patch; }
  [[nodiscard]] int side() const { return static_cast<int>(parameters.number("side")); }
  [[nodiscard]] Prefiltered baked() const {
    return baked_material(material, options, patch_effects(material), no_progress);
  }
};

template <class Work>
double milliseconds(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  (void)work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

Quantity of_patch(std::string name, std::string summary, std::vector<OptionSpec> parameters,
                  std::function<double(const Measured&)> measure) {
  return {std::move(name), std::move(summary), std::move(parameters),
          [measure = std::move(measure)](const Material& material, const Options& options, const Options& given) {
            if (!material.microgeometry) {
              throw Error(ErrorKind::usage, "material " + material.name, "has no patch of small-scale geometry",
                          "take a scene with [microgeometry]");
            }
            return measure({material, options, given, table_settings(material, options, patch_effects(material))});
          }};
}

// The largest error of an approximation of a convolution.
Quantity convolution_quantity(std::string name, std::string summary, double (*error)(double, double)) {
  const auto sharpness = [](std::string eta) {
    return number_option(std::move(eta), 100.0, 1e-3, 1e6, "Sharpness of one of the two spherical Gaussians.");
  };
  return {std::move(name),
          std::move(summary),
          {sharpness("eta1"), sharpness("eta2")},
          [error](const Material& /*material*/, const Options& /*options*/, const Options& parameters) {
            return error(parameters.number("eta1"), parameters.number("eta2"));
          }};
}

std::vector<Quantity> lobe_quantities() {
  return {
      convolution_quantity("convolution_error",
                           "Largest difference of Eq. 14 from Eq. 11 over all angles, amplitudes of 1.",
                           convolution_error),
      of_patch("fit_rms",
               "Root mean square difference of the lobes from the BVNDF over all cells of normals and pairs of "
               "directions; 1 is all that is seen.",
               {}, [](const Measured& it) { return fit_errors(it.patch(), it.settings).rms; }),
      of_patch("relative_fit_rms", "The same over the root mean square of the BVNDF.", {},
               [](const Measured& it) { return fit_errors(it.patch(), it.settings).relative; }),
      of_patch("occupied_fit_rms", "fit_rms over the cells of normals that contain facets.", {},
               [](const Measured& it) { return fit_errors(it.patch(), it.settings).occupied; }),
      of_patch("convolved_fit_rms", "relative_fit_rms over the sphere after a convolution of both sides with a lobe.",
               {number_option("sharpness", 513.0, 1e-3, 1e5, "Sharpness of that lobe.")},
               [](const Measured& it) {
                 return convolved_fit_rms(it.patch(), it.settings, it.parameters.number("sharpness"));
               }),
      convolution_quantity("jakob_convolution_error", "The same of Jakob's (2012) one spherical Gaussian.",
                           jakob_convolution_error)};
}

// The time of one stage of the patch's table, measured once.
Quantity stage_quantity(std::string name, const std::string& of, std::string stage) {
  return of_patch(std::move(name), "Time of " + of + " of the patch, once, milliseconds.", {},
                  [stage = std::move(stage)](const Measured& it) {
                    StageClock clock;
                    (void)patch_table(it.patch(), it.settings, clock.callback(no_progress));
                    clock.stop();
                    return 1e3 * std::ranges::find(clock.times(), stage, &StageTime::stage)->seconds;
                  });
}

std::vector<Quantity> stage_quantities() {
  return {stage_quantity("visibility_ms", "the visibility", "visibility"),
          stage_quantity("bvndf_ms", "the BVNDF and its sums", "BVNDF"),
          stage_quantity("ndf_ms", "the fit of the NDF", "NDF"),
          stage_quantity("amplitudes_ms", "the amplitudes", "amplitudes")};
}

double brdf_error(const Measured& it) {
  const MaterialTable table = patch_table(it.patch(), it.settings, no_progress);
  return relative_error(it.material, it.settings,
                        effective_brdf(table, it.settings, facet_reflection(it.material, it.options),
                                       it.options.word("convolution") == "approximate"));
}

LowRank sizes_of(const Options& parameters) {
  const auto whole = [&](const char* name) { return static_cast<int>(parameters.number(name)); };
  return {.side = whole("side"), .normals = whole("normals"), .values = whole("values")};
}

BrdfFunction table_of(const Measured& it, const std::optional<LowRank>& compressed = {}) {
  return dense_table(it.material, it.settings, it.side(), no_progress, compressed);
}

std::vector<Quantity> brdf_quantities() {
  const OptionSpec side =
      whole_option("side", 12, 2, 96, "Side of the table's grids of directions; its time grows as the fourth power.");
  const std::vector<OptionSpec> compression{
      side, whole_option("normals", 40, 2, 96, "Side of the grid of normals; time grows as its fourth power."),
      whole_option("values", 70, 1, 1024, "Singular values that are stored.")};
  return {of_patch("brdf_error",
                   "Root mean square difference of the effective BRDF from the sum over facets, for random pairs of "
                   "directions, over the root mean square of the sum.",
                   {}, brdf_error),
          of_patch("brdf_bytes", "Bytes of what is baked of the material.", {},
                   [](const Measured& it) { return static_cast<double>(byte_count(it.baked())); }),
          of_patch("brdf_ms", "Time of baking the material, once, milliseconds.", {},
                   [](const Measured& it) { return milliseconds([&] { return it.baked(); }); }),
          of_patch("table_error", "brdf_error of a dense table of the effective BRDF.", {side},
                   [](const Measured& it) { return relative_error(it.material, it.settings, table_of(it)); }),
          of_patch("table_bytes", "Bytes of that table.", {side},
                   [](const Measured& it) {
                     const std::size_t channels = is_tabulated(it.material) ? 3 : it.settings.channels;
                     return static_cast<double>(dense_table_bytes(it.side(), channels));
                   }),
          of_patch("table_ms", "Time of making that table, once, milliseconds.", {side},
                   [](const Measured& it) { return milliseconds([&] { return table_of(it); }); }),
          of_patch("compressed_error",
                   "table_error where the base lobe is a matrix of few singular values, as Wu et al. 2011 compress it.",
                   compression,
                   [](const Measured& it) {
                     return relative_error(it.material, it.settings, table_of(it, sizes_of(it.parameters)));
                   }),
          {"compressed_bytes", "Bytes of that matrix: both factors.", compression,
           [](const Material& /*material*/, const Options& /*options*/, const Options& parameters) {
             return static_cast<double>(LowRankLobe::byte_count(sizes_of(parameters)));
           }}};
}

std::vector<Quantity> quantity_table() {
  std::vector<Quantity> all = lobe_quantities();
  for (const auto& more : {stage_quantities(), brdf_quantities()}) all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace
}  // namespace footprint::iwasaki_sg

namespace footprint {

std::span<const Quantity> iwasaki_sg_quantities() {
  static const std::vector<Quantity> table = iwasaki_sg::quantity_table();
  return table;
}

}  // namespace footprint

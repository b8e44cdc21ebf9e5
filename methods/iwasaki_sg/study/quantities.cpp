// Measures the fit, the effective BRDF, a dense table of it and the time of each stage.
#include <algorithm>
#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "methods/iwasaki_sg/material_table.hpp"
#include "methods/iwasaki_sg/study/effective_brdf.hpp"
#include "methods/iwasaki_sg/study/fit_error.hpp"
#include "methods/registry.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/progress.hpp"
#include "renderer/microgeometry/microgeometry.hpp"

namespace footprint::iwasaki_sg {
namespace {

// A material with a patch, and its settings by the options.
struct Measured {
  const Material& material;
  const Options& options;
  TableSettings settings;

  [[nodiscard]] const Patch& patch() const { return material.microgeometry->patch; }
};

Measured measured(const Material& material, const Options& options) {
  if (!material.microgeometry) {
    throw Error(ErrorKind::usage, "material " + material.name, "has no patch of small-scale geometry",
                "take a scene with [microgeometry]");
  }
  return {material, options, table_settings(material, options, patch_effects(material))};
}

template <class Work>
double milliseconds(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  (void)work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

double measured_convolution_error(const Material& /*material*/, const Options& /*options*/, const Options& parameters) {
  return convolution_error(parameters.number("eta1"), parameters.number("eta2"));
}

double measured_jakob_error(const Material& /*material*/, const Options& /*options*/, const Options& parameters) {
  return jakob_convolution_error(parameters.number("eta1"), parameters.number("eta2"));
}

double measured_fit_rms(const Material& material, const Options& options, const Options& /*parameters*/) {
  const Measured it = measured(material, options);
  return fit_rms(it.patch(), it.settings);
}

double measured_relative_fit_rms(const Material& material, const Options& options, const Options& /*parameters*/) {
  const Measured it = measured(material, options);
  return relative_fit_rms(it.patch(), it.settings);
}

double measured_occupied_fit_rms(const Material& material, const Options& options, const Options& /*parameters*/) {
  const Measured it = measured(material, options);
  return occupied_fit_rms(it.patch(), it.settings);
}

double measured_convolved_fit_rms(const Material& material, const Options& options, const Options& parameters) {
  const Measured it = measured(material, options);
  return convolved_fit_rms(it.patch(), it.settings, parameters.number("sharpness"));
}

// Milliseconds of one stage of the patch's table, measured once.
double stage_ms(const Material& material, const Options& options, std::string_view stage) {
  const Measured it = measured(material, options);
  StageClock clock;
  (void)patch_table(it.patch(), it.settings, clock.callback(no_progress));
  clock.stop();
  return 1e3 * std::ranges::find(clock.times(), stage, &StageTime::stage)->seconds;
}

double measured_brdf_error(const Material& material, const Options& options, const Options& /*parameters*/) {
  const Measured it = measured(material, options);
  const MaterialTable table = patch_table(it.patch(), it.settings, no_progress);
  const EffectiveBrdf brdf(table, it.settings, facet_reflection(material, options),
                           options.word("convolution") == "approximate");
  return relative_error(material, it.settings, brdf);
}

double measured_brdf_ms(const Material& material, const Options& options, const Options& /*parameters*/) {
  const Measured it = measured(material, options);
  return milliseconds([&] { return baked_material(material, options, patch_effects(material), no_progress); });
}

double measured_brdf_bytes(const Material& material, const Options& options, const Options& /*parameters*/) {
  const Measured it = measured(material, options);
  return static_cast<double>(byte_count(baked_material(material, options, patch_effects(material), no_progress)));
}

int side_of(const Options& parameters) { return static_cast<int>(parameters.number("side")); }

double measured_table_error(const Material& material, const Options& options, const Options& parameters) {
  const Measured it = measured(material, options);
  return relative_error(material, it.settings, DenseTable(material, it.settings, side_of(parameters), no_progress));
}

double measured_table_ms(const Material& material, const Options& options, const Options& parameters) {
  const Measured it = measured(material, options);
  return milliseconds([&] { return DenseTable(material, it.settings, side_of(parameters), no_progress); });
}

double measured_table_bytes(const Material& material, const Options& options, const Options& parameters) {
  const Measured it = measured(material, options);
  const std::size_t channels = is_tabulated(material) ? 3 : it.settings.channels;
  return static_cast<double>(DenseTable::byte_count(side_of(parameters), channels));
}

LowRank sizes_of(const Options& parameters) {
  const auto whole = [&](const char* name) { return static_cast<int>(parameters.number(name)); };
  return {.side = whole("side"), .normals = whole("normals"), .values = whole("values")};
}

double measured_compressed_error(const Material& material, const Options& options, const Options& parameters) {
  const Measured it = measured(material, options);
  const LowRank sizes = sizes_of(parameters);
  return relative_error(material, it.settings, DenseTable(material, it.settings, sizes.side, no_progress, sizes));
}

double compressed_bytes(const Material& /*material*/, const Options& /*options*/, const Options& parameters) {
  return static_cast<double>(LowRankLobe::byte_count(sizes_of(parameters)));
}

OptionSpec sharpness(std::string name) {
  return number_option(std::move(name), 100.0, 1e-3, 1e6, "Sharpness of one of the two spherical Gaussians.");
}

std::vector<Quantity> lobe_quantities() {
  return {{"convolution_error",
           "Largest difference of Eq. 14 from Eq. 11 over all angles, amplitudes of 1.",
           {sharpness("eta1"), sharpness("eta2")},
           measured_convolution_error},
          {"fit_rms",
           "Root mean square difference of the lobes from the BVNDF over all cells of normals and pairs of directions; "
           "1 is all that is seen.",
           {},
           measured_fit_rms},
          {"relative_fit_rms", "The same over the root mean square of the BVNDF.", {}, measured_relative_fit_rms},
          {"occupied_fit_rms", "fit_rms over the cells of normals that contain facets.", {}, measured_occupied_fit_rms},
          {"convolved_fit_rms",
           "relative_fit_rms over the sphere after a convolution of both sides with a lobe.",
           {number_option("sharpness", 513.0, 1e-3, 1e5, "Sharpness of that lobe.")},
           measured_convolved_fit_rms},
          {"jakob_convolution_error",
           "The same of Jakob's (2012) one spherical Gaussian.",
           {sharpness("eta1"), sharpness("eta2")},
           measured_jakob_error}};
}

Quantity stage_quantity(std::string name, const std::string& of, decltype(Quantity::measure) measure) {
  return {std::move(name), "Time of " + of + " of the patch, once, milliseconds.", {}, measure};
}

std::vector<Quantity> stage_quantities() {
  return {
      stage_quantity("visibility_ms", "the visibility",
                     [](const Material& m, const Options& o, const Options&) { return stage_ms(m, o, "visibility"); }),
      stage_quantity("bvndf_ms", "the BVNDF and its sums",
                     [](const Material& m, const Options& o, const Options&) { return stage_ms(m, o, "BVNDF"); }),
      stage_quantity("ndf_ms", "the fit of the NDF",
                     [](const Material& m, const Options& o, const Options&) { return stage_ms(m, o, "NDF"); }),
      stage_quantity("amplitudes_ms", "the amplitudes",
                     [](const Material& m, const Options& o, const Options&) { return stage_ms(m, o, "amplitudes"); })};
}

std::vector<Quantity> brdf_quantities() {
  const OptionSpec side =
      whole_option("side", 12, 2, 96, "Side of the table's grids of directions; its time grows as the fourth power.");
  const std::vector<OptionSpec> compression{
      side, whole_option("normals", 40, 2, 96, "Side of the grid of normals; time grows as its fourth power."),
      whole_option("values", 70, 1, 1024, "Singular values that are stored.")};
  return {{"brdf_error",
           "Root mean square difference of the effective BRDF from the sum over facets, for random pairs of "
           "directions, over the root mean square of the sum.",
           {},
           measured_brdf_error},
          {"brdf_bytes", "Bytes of what is baked of the material.", {}, measured_brdf_bytes},
          {"brdf_ms", "Time of baking the material, once, milliseconds.", {}, measured_brdf_ms},
          {"table_error", "brdf_error of a dense table of the effective BRDF.", {side}, measured_table_error},
          {"table_bytes", "Bytes of that table.", {side}, measured_table_bytes},
          {"table_ms", "Time of making that table, once, milliseconds.", {side}, measured_table_ms},
          {"compressed_error",
           "table_error where the base lobe is a matrix of few singular values, as Wu et al. 2011 compress it.",
           compression, measured_compressed_error},
          {"compressed_bytes", "Bytes of that matrix: both factors.", compression, compressed_bytes}};
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

// `recommend --quick`: which method to take for each material, by errors that a model predicts from each map's
// statistics without a frame.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "renderer/core/options.hpp"
#include "renderer/scene/scene.hpp"
#include "results/report/recommendation.hpp"

namespace footprint {

/// How far off the model is under a footprint filter, over maps that it was not fitted on.
struct QuickCalibration {
  std::string footprint;
  int scenes = 0;                       ///< maps with an alpha
  double median_factor = 1;             ///< half of the errors are within this factor of the prediction
  std::array<double, 2> interval_80{};  ///< error over prediction: eight of ten are in between
  double order_factor = 1;              ///< predictions closer than this count as equal
  double order_right = 0;               ///< share of pairs of methods in the right order
  double choice_right = 0;              ///< share of maps whose best prediction is within 10% of the best method
};
void fields(auto& archive, Is<QuickCalibration> auto& value) {
  archive("footprint", value.footprint);
  archive("scenes", value.scenes);
  archive("median_factor", value.median_factor);
  archive("interval_80", value.interval_80);
  archive("order_factor", value.order_factor);
  archive("order_right", value.order_right);
  archive("choice_right", value.choice_right);
}

/// A method under a footprint filter.
struct QuickFilter {
  std::string footprint;
  std::vector<double> weights;          ///< of the inputs (quick_prediction)
  std::map<std::string, double> costs;  ///< by GPU, over `direct` under trilinear lookups
};
void fields(auto& archive, Is<QuickFilter> auto& value) {
  archive("footprint", value.footprint);
  archive("weights", value.weights);
  archive("costs", value.costs);
}

struct QuickMethod {
  std::string method;  ///< as written
  double bytes_per_texel = 0;
  std::vector<QuickFilter> filters;
};
void fields(auto& archive, Is<QuickMethod> auto& value) {
  archive("method", value.method);
  archive("bytes_per_texel", value.bytes_per_texel);
  archive("filters", value.filters);
}

/// The model, which scripts/studies/quick_model.py fits and writes.
struct QuickModel {
  std::vector<int> texels_per_pixel;  ///< powers of two
  int scenes = 0;                     ///< that it was fitted on
  std::vector<QuickCalibration> calibration;
  std::vector<QuickCalibration> surfaces = {};  ///< the calibration over generated surfaces
  /// Per level, the range of the logarithms of mean alpha and of the lobe errors over the maps that it was fitted on.
  std::vector<std::vector<std::array<double, 2>>> domain = {};
  std::vector<QuickMethod> methods;
};
void fields(auto& archive, Is<QuickModel> auto& value) {
  archive("texels_per_pixel", value.texels_per_pixel);
  archive("scenes", value.scenes);
  archive("calibration", value.calibration);
  archive("surfaces", value.surfaces);
  archive("domain", value.domain);
  archive("methods", value.methods);
}

/// Reads results/quick_model.json; each calibration becomes the worse of the two. Throws Error (machine): unreadable,
/// or not such a document.
[[nodiscard]] QuickModel read_quick_model(const std::filesystem::path& file);

/// What is wanted of the model.
struct QuickQuestion {
  std::vector<MethodSpec> methods;        ///< the candidates, under each of the filters
  std::vector<std::string> filters = {};  ///< as written
  Limits limits;                          ///< with a GPU, whose costs count
};

/// The advice for each material with a normal map. Only its material, candidates and choice are set, and the distances,
/// which are texels per pixel.
struct QuickAdvice {
  std::string scene;
  QuickModel model;
  Limits limits;
  std::vector<LeftOutMethod> left_out = {};
  std::vector<MaterialAdvice> materials = {};
};

/// The shading error: the exponential of the weighted sum of 1 at the place of the level, the logarithm of the mean
/// alpha and those of lobe_errors at that level.
/// level: 0 or more, the index into texels_per_pixel; log_inputs: those logarithms.
[[nodiscard]] double quick_prediction(const std::vector<double>& weights, std::size_t level,
                                      const std::vector<double>& log_inputs);

/// A material's words say where its map lies outside the domain, and where `direct` may be as accurate as the choice.
/// Throws Error (usage): the model has none of the methods, or not the GPU; no material has a normal map.
[[nodiscard]] QuickAdvice quick_advice(const Scene& scene, QuickModel model, const QuickQuestion& question);

/// The text that the program prints, and the same as JSON ("schema": "footprint-quick/1").
[[nodiscard]] std::string quick_advice_text(const QuickAdvice& advice);
[[nodiscard]] std::string quick_advice_json(const QuickAdvice& advice);

}  // namespace footprint

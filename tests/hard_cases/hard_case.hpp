// The types of hard cases. Each case is an entry of a table, and every method of the registry is tested with it.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/effects/effects.hpp"
#include "renderer/ndf/footprint_texels.hpp"
#include "renderer/pipeline/history_settings.hpp"
#include "renderer/scene/footprint_filter.hpp"
#include "renderer/scene/scene.hpp"

namespace footprint::hard_cases {

/// A material under one footprint. A method's shader evaluates the distribution of normals, which is compared with a
/// sum over texels in double precision that shares no code with it.
struct NdfCase {
  std::string name;         ///< unique; letters, digits and `_`
  std::string group;        ///< column of the table of verdicts
  std::string description;  ///< one phrase for the page
  std::function<Material()> material;
  FootprintRect footprint{};
  double energy = 0.02;  ///< largest relative error of the integral over the hemisphere
  std::optional<double>
      limit{};          ///< largest difference from the sum, relative to its peak, if the method must equal it
  bool narrow = false;  ///< lobes too narrow for a grid over the hemisphere: only directions near the facets' normals
  bool texels_only = false;      ///< only for methods that resolve texels
  std::optional<Effect> asks{};  ///< only for methods that honour this effect
};

/// The comparison of an image under a clear coat with the coat's formula over the method's own image without the coat
/// (coat_sum.hpp).
struct CoatCheck {
  int points = 1;      ///< per pixel side; 1: one coat per pixel, and each pixel is compared, else only the mean
  double most = 1e-3;  ///< largest relative difference
  bool steps = false;  ///< pixels are steps of a parameter, at most four times the formula's own steps
};

/// A scene drawn in one frame. All values must be finite and at least 0.
struct PictureCase {
  std::string name;
  std::string description;
  std::function<Scene()> scene;
  bool equals_direct = false;     ///< nothing to filter: the image equals that of `direct`
  std::function<Scene()> twin{};  ///< another scene with the same image
  std::optional<double> mean{};   ///< mean of the first channel over the surface in closed form, to 0.05
  FootprintFilter filter = default_footprint_filter;
  std::string group = "pictures";
  std::optional<CoatCheck> coat{};
  std::optional<HistoryClamp> history{};  ///< also drawn in histories with this clamp
  bool wide = false;                      ///< only with --wide: its programs take long to compile
};

/// A parameter that passes a hard value in small steps. A step of the distribution is at most `most` of the whole, or
/// four times the sum's own step. At each step the integral's relative error is at most `energy`, if given.
struct Sweep {
  std::string name;
  std::string description;
  std::function<Material(double)> material;
  double from = 0.0, to = 1.0;
  int steps = 8;
  double most = 0.1;
  std::optional<double> energy{};  ///< only if the directions find every lobe
  std::string also{};              ///< a further method with options
};

[[nodiscard]] std::span<const NdfCase> ndf_cases();
[[nodiscard]] std::span<const PictureCase> picture_cases();
[[nodiscard]] std::span<const PictureCase> coat_cases();  ///< cases of clear coats
[[nodiscard]] std::span<const Sweep> sweeps();

}  // namespace footprint::hard_cases

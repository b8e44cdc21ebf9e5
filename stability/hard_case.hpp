// What a hard case is: a small value in a table. A new one is one entry there; every method of the registry meets it.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/effects/effects.hpp"
#include "renderer/ndf/footprint_texels.hpp"
#include "renderer/scene/footprint_filter.hpp"
#include "renderer/scene/scene.hpp"

namespace footprint::stability {

/// A material under one footprint, whose distribution of normals a method evaluates by its own shader. Held against a
/// sum over texels in double precision that shares no code with it.
struct NdfCase {
  std::string name;   ///< unique; letters, digits and `_`
  std::string group;  ///< a column of the table
  std::string what;   ///< in words
  std::function<Material()> material;
  FootprintRect footprint{};
  double energy = 0.02;  ///< the most that the integral over the hemisphere may be off by, relative
  std::optional<double>
      limit{};          ///< where the method must meet the sum itself: the most difference, relative to the sum's peak
  bool narrow = false;  ///< lobes that no grid over the hemisphere finds: looked at about the facets' normals alone
  bool texels_only = false;      ///< only for methods that show texels where they are large
  std::optional<Effect> asks{};  ///< only for methods that honour it
};

/// How a picture under a clear coat is held against the coat's formula over what the method itself draws without the
/// coat (coat_sum.hpp).
struct CoatCheck {
  int points = 1;      ///< across a pixel: 1 where each sees one coat alone, and each is held; else their mean is
  double most = 1e-3;  ///< the difference, relative
  bool steps = false;  ///< the pixels are steps of a parameter: none is more than four of the formula's own
};

/// A scene as a whole, drawn in one frame: every number finite, none below 0.
struct PictureCase {
  std::string name;
  std::string what;
  std::function<Scene()> scene;
  bool equals_direct = false;     ///< there is nothing to filter: the picture is `direct`'s
  std::function<Scene()> twin{};  ///< another scene of which a method draws the same picture
  std::optional<double> mean{};   ///< of the first channel over the surface, in closed form; held to 0.05
  FootprintFilter filter = default_footprint_filter;
  std::string group = "pictures";
  std::optional<CoatCheck> coat{};
  bool wide = false;  ///< only where every storage is asked for: its programs take long to compile
};

/// A parameter that goes through a hard value in small steps: a step of the distribution is no larger than `most` of
/// all of it, nor than four times the sum's own step; where `energy` is
/// given, at none is the integral off by more.
struct Sweep {
  std::string name;
  std::string what;
  std::function<Material(double)> material;
  double from = 0.0, to = 1.0;
  int steps = 8;
  double most = 0.1;
  std::optional<double> energy{};  ///< where the directions find every lobe
  std::string also{};              ///< a method with options that has another course there
};

[[nodiscard]] std::span<const NdfCase> ndf_cases();
[[nodiscard]] std::span<const PictureCase> picture_cases();
[[nodiscard]] std::span<const PictureCase> coat_cases();  ///< those of clear coats
[[nodiscard]] std::span<const Sweep> sweeps();

}  // namespace footprint::stability

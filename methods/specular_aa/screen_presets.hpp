// The formulas by which engines widen lobes where normals and half vectors change over the screen, one per preset, in
// double precision. specular_aa.glsl has their twins.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <string_view>

#include "renderer/lobes/lobe.hpp"

namespace footprint::specular_aa {

enum class Preset {
  filament,
  unity,
  o3de,
  godot,
  bevy,
  unreal,
  three,
  babylon,
  tokuyoshi_kaplanyan_2019,
  tokuyoshi_kaplanyan_2021,
  free
};

/// In the order of Preset, as users write them.
inline constexpr std::array<std::string_view, 11> preset_names{"filament",
                                                               "unity",
                                                               "o3de",
                                                               "godot",
                                                               "bevy",
                                                               "unreal",
                                                               "three",
                                                               "babylon",
                                                               "tokuyoshi_kaplanyan_2019",
                                                               "tokuyoshi_kaplanyan_2021",
                                                               "free"};

/// The preset of a name. Errors: std::out_of_range if there is none.
[[nodiscard]] Preset preset_of(std::string_view name);

/// A preset, with the parameters of `free`: alpha'^2 = alpha^2 + min(constant S, cap).
struct Formula {
  Preset preset = Preset::filament;
  double constant = 0.3;
  double cap = 0.04;
};

/// Changes of the unit normal to the right and to the upper pixel, in the axes of the camera (`three` reads the axes,
/// others only lengths).
struct NormalSteps {
  glm::dvec3 dx, dy;
};

/// The kind of light; `babylon` has another formula for an environment.
enum class LightKind { punctual, environment };

/// alpha'^2 of a lobe whose alpha^2 is twice its slope variance; at least alpha^2. Sums are limited to 1, where engines
/// saturate, unless the lobe is wider before. Errors: std::invalid_argument for a preset of half vectors.
[[nodiscard]] double widened_alpha2(const Formula& formula, double alpha2, const NormalSteps& steps,
                                    LightKind light = LightKind::punctual);

/// Whether the preset widens by half vectors, to an elliptical lobe.
[[nodiscard]] bool takes_half_vectors(Preset preset);

/// For presets of half vectors: alpha^2 as a matrix, twice the covariance of slopes, about the normal z. `here`,
/// `right` and `above` are unit half vectors of one light at the pixel and two neighbours, each in the frame of its own
/// pixel.
[[nodiscard]] glm::dmat2 widened_matrix(Preset preset, double alpha2, const glm::dvec3& here, const glm::dvec3& right,
                                        const glm::dvec3& above);

/// The density over solid angle of GGX or Beckmann normals with that matrix, about z (Heitz 2014, equations 85 and 87,
/// in any axes).
[[nodiscard]] double matrix_density(NormalDistribution distribution, const glm::dmat2& alpha2, const glm::dvec3& h);

}  // namespace footprint::specular_aa

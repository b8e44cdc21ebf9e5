// Test support for `specular_aa`: its presets in double precision, one formula per preset. They share no code with
// specular_aa.glsl.
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

/// In the order of Preset, as on the command line.
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

/// Errors: std::out_of_range for another word.
[[nodiscard]] Preset preset_of(std::string_view name);

/// A preset, and the numbers of `free`: alpha'^2 = alpha^2 + min(constant S, cap).
struct Formula {
  Preset preset = Preset::filament;
  double constant = 0.3;
  double cap = 0.04;
};

/// Differences of the unit normal to the next pixel on the right and to the next above, in the camera's axes. Only
/// `three` depends on the axes.
struct NormalSteps {
  glm::dvec3 dx, dy;
};

/// The kind of light: `babylon` has another formula for an environment.
enum class LightKind { punctual, environment };

/// alpha'^2 of a lobe whose alpha^2 is twice its slope variance; at least alpha^2. It saturates at 1, as in engines,
/// unless the lobe is wider already. Errors: std::invalid_argument for a preset of half vectors.
[[nodiscard]] double widened_alpha2(const Formula& formula, double alpha2, const NormalSteps& steps,
                                    LightKind light = LightKind::punctual);

/// Whether the preset widens by half vectors, to an elliptical lobe.
[[nodiscard]] bool takes_half_vectors(Preset preset);

/// alpha^2 as a matrix for a preset of half vectors: twice the covariance of slopes, about the normal z. `here`,
/// `right` and `above` are unit half vectors of one light at a pixel and at the next two, each in its own pixel's
/// frame.
[[nodiscard]] glm::dmat2 widened_matrix(Preset preset, double alpha2, const glm::dvec3& here, const glm::dvec3& right,
                                        const glm::dvec3& above);

/// Density over solid angle of GGX or Beckmann normals with that matrix, about z (Heitz 2014, equations 85 and 87, in
/// any axes).
[[nodiscard]] double matrix_density(NormalDistribution distribution, const glm::dmat2& alpha2, const glm::dvec3& h);

}  // namespace footprint::specular_aa

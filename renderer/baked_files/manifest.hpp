// What is read of a manifest of `footprint bake`, and the words that its writer and its reader share.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "renderer/bake/prefiltered.hpp"
#include "renderer/core/names.hpp"
#include "renderer/core/options.hpp"
#include "renderer/effects/effects.hpp"
#include "renderer/scene/material.hpp"

namespace footprint {

inline constexpr const char* manifest_schema = "footprint-bake/1";

inline constexpr auto manifest_wraps = std::to_array<Word<Wrap>>(
    {{Wrap::repeat, "repeat"}, {Wrap::mirrored_repeat, "mirrored_repeat"}, {Wrap::clamp_to_edge, "clamp_to_edge"}});
inline constexpr auto manifest_lookups = std::to_array<Word<TextureFilter>>({{TextureFilter::trilinear, "trilinear"},
                                                                             {TextureFilter::nearest, "nearest"},
                                                                             {TextureFilter::linear, "linear"},
                                                                             {TextureFilter::by_level, "by_level"}});

/// A text or a number of JSON as a text; a number is written in one way.
template <class Json>
[[nodiscard]] std::string manifest_word(const Json& value) {
  return value.is_string() ? value.template get<std::string>() : value.dump();
}

/// One material of a manifest.
struct ManifestMaterial {
  std::string name;
  std::map<std::string, std::vector<float>> uniforms;  ///< a number, or a vector's components, by the name in GLSL
  /// Textures without texels, the method's notes and surface coordinates. Scalars and vectors are in `uniforms`.
  Prefiltered maps{};
  std::vector<std::string> ktx2{};  ///< a file per texture, as a path below the manifest's folder
};

/// A manifest, apart from what only other programs need.
struct BakeManifest {
  std::string method;                            ///< as it was written, with its options
  std::string module;                            ///< the method's name and `.glsl`
  std::optional<std::string> method_file{};      ///< Method::file_content of a method from a file
  std::map<std::string, std::string> options{};  ///< as words_of
  std::map<std::string, std::string> brdf{};     ///< as words_of
  std::vector<std::string> effects{};            ///< that the method simulates
  std::vector<ManifestMaterial> materials{};     ///< in the order of the scene
};

/// Reads and checks a manifest. Throws Error (usage) that names file and member: missing, damaged, a value of another
/// type or out of range, a file outside of the manifest's folder.
[[nodiscard]] BakeManifest read_manifest(const std::filesystem::path& file);

/// Base BRDF and options as a manifest has them, by their names.
[[nodiscard]] std::map<std::string, std::string> words_of(const BaseBrdf& brdf);
[[nodiscard]] std::map<std::string, std::string> words_of(const Options& options);

/// The uniforms that a manifest has of the model's material; the others are the method's.
/// effects: those that the method honours.
[[nodiscard]] std::vector<std::string> material_uniform_names(const Material& material, const EffectSet& effects);

/// The scalars and vectors of the method: `uniforms` without those of `of_material`.
/// into: gets them.
/// Throws Error (usage), with the place `uniforms`: one of `of_material` is missing, or another is neither a number nor
/// one of several pairs from 0 on.
void take_uniforms(const ManifestMaterial& from, const std::vector<std::string>& of_material, Prefiltered& into);

}  // namespace footprint

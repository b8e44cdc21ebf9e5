// A method's precompute over a whole scene, from the disk cache or given maps if possible, and the entries of that
// cache.
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "renderer/bake/method.hpp"
#include "renderer/bake/prefiltered.hpp"
#include "renderer/core/bytes.hpp"
#include "renderer/core/disk_cache.hpp"
#include "renderer/core/options.hpp"
#include "renderer/effects/effects.hpp"
#include "renderer/scene/material.hpp"

namespace footprint {

/// Writes the value with a checksum, in this machine's byte order. Equal values give equal bytes.
void write_bytes(const Prefiltered& prefiltered, const ByteSink& sink);

/// The value that `write_bytes` wrote; none if the bytes are truncated, too long, damaged or of another form.
[[nodiscard]] std::optional<Prefiltered> from_bytes(const ByteSource& bytes);

/// The key of a bake in a DiskCache: the method's name, and a hash of this program's executable, the options, the
/// effects and the material's values and maps. Another build of the program therefore bakes again.
[[nodiscard]] std::string bake_key(const std::string& method, const Material& material, const Options& options,
                                   const EffectSet& effects);

/// A note if a lobe of the material is too narrow for the precision of the option `storage` (stability.md). None
/// if the method has no such option or does not round lobes, normals do not vary, or all lobes are wide enough.
[[nodiscard]] std::optional<std::string> storage_range_note(const Material& material, const MethodInfo& info,
                                                            const Options& options, const EffectSet& effects);

/// The notes that every bake of a material gets, besides those of the method itself: on storage and on lobes.
/// effects: the scene's.
[[nodiscard]] std::vector<std::string> common_notes(const Method& method, const Material& material,
                                                    const Options& options, const EffectSet& effects);

/// A method's precompute for every material of a scene, with its cost.
struct BakedMethod {
  const Method* method = nullptr;
  MethodSpec spec;
  Options options;
  std::vector<Prefiltered> materials{};  ///< one per material of the scene
  /// Material and number of each texture whose texels an earlier material has: on the GPU they are stored once.
  std::set<std::pair<std::size_t, std::size_t>> shared{};
  double seconds = 0;
  std::size_t bytes = 0;   ///< on the GPU; texels that several materials share count once
  std::size_t texels = 0;  ///< of the finest levels, over all materials (`finest_texels`)
  bool cached = false;     ///< every material was read from disk; `seconds` is then the time of reading
  std::string given_by{};  ///< the folder whose maps replace the precompute and the frame build; empty: none
};

/// Called with a material's number when it is baked; may free the texels.
using MaterialBaked = std::function<void(std::size_t)>;

/// The options of `spec`, checked against the method's table, with defaults. Throws Error (usage): an unknown option,
/// or a value out of range.
[[nodiscard]] Options options_of(const Method& method, const MethodSpec& spec);

/// A method with its options, without any baked material. Throws Error (usage): those of options_of.
[[nodiscard]] BakedMethod make_bake(const Method& method, const MethodSpec& spec);

/// The given maps of a material, by its number.
using GivenMaps = std::function<Prefiltered(std::size_t material)>;

/// What replaces a precompute: at most one of these.
struct BakeSource {
  const DiskCache* cache = nullptr;     ///< has slow bakes, and gets those that it lacks
  const BakedMethod* before = nullptr;  ///< the bake of a scene that differs in the base BRDF alone
  GivenMaps given = nullptr;            ///< the maps of BakedMethod::given_by
};

/// Runs the precompute of `baked` for one material after the other, as `bake` does. `seconds` excludes `when_baked`.
void bake_materials(BakedMethod& baked, const Scene& scene, const EffectSet& effects, const Progress& progress,
                    const BakeSource& source, const MaterialBaked& when_baked);

/// Runs the precompute of `spec` for every material, or reads it from the cache.
/// effects: the scene's; the method gets those that it honours.
/// cache: may be null; damaged bakes count as missing.
[[nodiscard]] BakedMethod bake(const Method& method, const MethodSpec& spec, const Scene& scene,
                               const EffectSet& effects, const Progress& progress, const DiskCache* cache = nullptr);

/// Bakes a method again after the base BRDF of its materials changed: only what depends on it
/// (Method::precompute_brdf). before: the bake with the BRDF before, of the same effects.
[[nodiscard]] BakedMethod bake_after_brdf(const BakedMethod& before, const Scene& scene, const EffectSet& effects,
                                          const Progress& progress);

}  // namespace footprint

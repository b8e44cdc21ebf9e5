// Maps that `footprint bake` wrote, read back for the method and the scene that they were baked for.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "renderer/bake/baked_method.hpp"
#include "renderer/baked_files/manifest.hpp"
#include "renderer/scene/scene.hpp"

namespace footprint {

/// A folder of `footprint bake`, whose maps another program may have changed. Texels are those of the KTX2 files.
class BakeFolder {
 public:
  /// Reads the manifest. Throws as read_manifest.
  explicit BakeFolder(std::filesystem::path folder);

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  /// The method as it was written, with its options.
  [[nodiscard]] const std::string& method() const { return manifest_.method; }

  /// How the maps' method differs from another, in words such as "option storage is fp16 there and fp32 here". Empty:
  /// the maps are those of that method.
  [[nodiscard]] std::string difference(const Method& method, const Options& options) const;

  /// Checks everything but texels: method, scene, materials and the headers of all files.
  /// effects: the scene's.
  /// Throws Error (usage) that names the difference, or the file and its fault.
  void require_fit(const BakedMethod& wanted, const Scene& scene, const EffectSet& effects) const;

  /// The maps of a material of a scene that fits, without common_notes.
  /// effects: the scene's.
  /// Throws as require_fit and read_ktx2.
  [[nodiscard]] Prefiltered read(const BakedMethod& wanted, const Scene& scene, std::size_t material,
                                 const EffectSet& effects) const;

  /// A hash of the manifest and of all texels' files. Throws Error (usage): one is missing.
  [[nodiscard]] std::string content() const;

 private:
  void require_run(const BakedMethod& wanted, const Scene& scene, const EffectSet& honoured) const;
  void require_materials(const Scene& scene, const EffectSet& honoured) const;
  /// The maps of a material without texels.
  [[nodiscard]] Prefiltered form(const Scene& scene, std::size_t material, const EffectSet& honoured) const;

  std::filesystem::path folder_;
  BakeManifest manifest_;
};

}  // namespace footprint

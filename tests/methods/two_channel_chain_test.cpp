// What each method makes of mean normals whose z was rebuilt from x and y at every level, as an engine does that keeps
// a mip chain in two channels: drawn from a bake's files, beside the same bake as it is. Prints a row per method, which
// scripts/two_channel_maps takes over.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "methods/registry.hpp"
#include "renderer/bake/normal_chain.hpp"
#include "renderer/baked_files/baked_files.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/image/metrics.hpp"
#include "tests/methods/bare_renderer.hpp"
#include "tests/support/fresh_folder.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/sweep.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

namespace fs = std::filesystem;

constexpr glm::ivec2 picture_size{48, 48};
constexpr int reference_samples = 256;

// Metal: the mean normal that some use only for a diffuse term is not part of it.
Scene two_channel_square() {
  Scene scene = receding_grooves();
  Material& material = scene.materials.front();
  material.brdf.diffuse = false;
  material.base_color = glm::vec4(1.0F);
  material.metallic = 1.0F;
  material.roughness = 0.4F;
  material.normal_map->image = std::make_shared<const Image>(random_normals(64, 64, 0.5F, 3));
  return scene;
}

// The length of every mean normal becomes 1.
void rebuild_z(ExrChain& chain) {
  for (Image& level : chain.levels) {
    for (std::size_t i = 0; i < level.texel_count(); ++i) {
      float* const n = &level.texels[3 * i];
      n[2] = std::sqrt(std::max(1.0F - n[0] * n[0] - n[1] * n[1], 0.0F));
    }
  }
}

// Whether a texture of a bake is the chain of mean normals, under any name.
bool holds_mean_normals(const PrefilteredTexture& texture, const std::vector<Image>& chain) {
  return texture.channels == 3 && texture.storage == Storage::fp32 && texture.levels.size() == chain.size() &&
         decode_level(texture, texture.levels.size() - 1) == chain.back();
}

struct Errors {
  double stored = 0, rebuilt = 0;  // normalised colour error
  double changed = 0;              // the most that a channel of a pixel changes by, exposed
};

class TwoChannelChains : public ::testing::Test {
 protected:
  Errors errors_of(const Method& method) {
    const std::string& name = method.info.name;
    const MethodSpec spec = parse_methods(name).front();
    const EffectSet effects = effects_on(derive_effects(scene_));
    const BakedMethod baked = bake(method, spec, scene_, effects, no_progress);
    const fs::path folder = test::fresh_folder();
    write_bake({.scene = scene_, .baked = baked, .effects = effects, .footprint = filter_, .version = "0"}, folder);
    const Image stored = render_from_files(folder, scene_, picture_size, MapFiles::exr);
    const std::vector<Image> chain = mean_normal_chain(scene_.materials.front());
    for (const PrefilteredTexture& texture : baked.materials.front().textures) {
      if (!holds_mean_normals(texture, chain)) continue;
      const fs::path file = folder / "maps/square" / (texture.name + ".exr");
      ExrChain read = read_exr_chain(file);
      rebuild_z(read);
      write_exr_chain(file, read, ExrTexel::full);
    }
    const Image rebuilt = render_from_files(folder, scene_, picture_size, MapFiles::exr);
    return {error(stored), error(rebuilt), exposure_ * largest_difference(stored, rebuilt)};
  }

  [[nodiscard]] double error(const Image& picture) const {
    return normalized_color(picture, reference_.mean, exposure_).value();
  }

  const Scene scene_ = two_channel_square();
  const FootprintFilter filter_{FootprintFilterKind::anisotropic, 8};
  const Supersampled reference_ = TestRenderer(scene_, picture_size).reference(reference_samples);
  const float exposure_ = static_cast<float>(0.4 / covered_mean(reference_.mean));  // as a picture is shown
};

// The page's claims. Methods that read no mean normal do not change by a bit. Methods that take the spread from its
// length lose the texels' part of it, and keep the filter's part. Means that lean little change little.
TEST_F(TwoChannelChains, ChangeThoseWhoReadAMeanNormal) {
  const std::set<std::string> readers{"naive_mip", "fixed_brdf", "toksvig", "roughness_bake", "specular_aa"};
  std::map<std::string, Errors> found;
  for (const Method* method : all_methods()) {
    const std::string& name = method->info.name;
    if (name == "xu_vmf") continue;                      // nothing of it is baked; it reads the finest level alone
    if (!all_tests() && name == "best_lobes") continue;  // fits take long
    const Errors errors = found[name] = errors_of(*method);
    std::printf("two channels | `%s` | %.4f | %.4f | %.4f |\n", name.c_str(), errors.stored, errors.rebuilt,
                errors.changed);
    EXPECT_EQ(errors.changed > 0.0, readers.contains(name)) << name;
  }
  for (const std::string& name : readers) {
    const double change = std::abs(found.at(name).rebuilt - found.at(name).stored);
    if (name == "toksvig") {
      EXPECT_GT(change, 0.004);
    } else {
      EXPECT_LT(change, 0.001) << name;
    }
  }
}

}  // namespace
}  // namespace footprint::testing

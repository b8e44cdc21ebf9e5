// `naive_mip`: the mean normal, renormalised, and the mean roughness. What most renderers do, and what makes far
// surfaces too shiny: the spread of the normals is lost.
#include "renderer/image/mipmap.hpp"
#include "renderer/pipeline/base_surface.hpp"
#include "renderer/pipeline/normal_chain.hpp"

namespace footprint {

namespace embedded {
extern const std::string_view naive_mip_glsl;
}

namespace {

class NaiveMip final : public Method {
 public:
  [[nodiscard]] const MethodInfo& info() const override { return info_; }

  [[nodiscard]] Prefiltered precompute(const Material& material, const Options& options, const EffectSet& effects,
                                       const Progress& /*progress*/) const override {
    const Storage storage = parse_storage(options.word("storage"));
    Prefiltered out;
    if (has(effects, Effect::normal_variation)) {
      out.textures.push_back(
          make_texture("naive_normal", mean_normal_chain(material), storage, normal_coordinates(material), true));
    }
    if (has(effects, Effect::normal_layers)) {
      out.textures.push_back(make_texture("naive_layer", mean_normal_chain(layer_map_of(material)), storage,
                                          layer_coordinates(material), true));
    }
    if (has(effects, Effect::roughness_variation)) {
      out.textures.push_back(make_texture("naive_roughness", mip_chain(roughness_map_of(material)), storage,
                                          roughness_coordinates(material)));
    }
    return out;
  }

  [[nodiscard]] std::string_view shader() const override { return embedded::naive_mip_glsl; }

 private:
  MethodInfo info_{
      .name = "naive_mip",
      .summary = "Mip maps of normal and roughness: the mean normal, renormalised, and the mean roughness.",
      .paper = "Williams 1983, Pyramidal Parametrics (the mip map itself)",
      .options = {storage_option()},
      .honours = EffectSet{}.set()};
};

}  // namespace

const Method& naive_mip_method() {
  static const NaiveMip method;
  return method;
}

}  // namespace footprint

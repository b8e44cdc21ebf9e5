// `direct`: the finest level at the pixel's centre, without filtering. Every method must equal its image where there is
// nothing to filter.
#include "renderer/pipeline/base_surface.hpp"

namespace footprint {
namespace {

class Direct final : public Method {
 public:
  [[nodiscard]] const MethodInfo& info() const override { return info_; }

  [[nodiscard]] Prefiltered precompute(const Material& material, const Options& options, const EffectSet& effects,
                                       const Progress& progress) const override {
    return base_surface().precompute(material, options, effects, progress);
  }

  [[nodiscard]] ShaderModule shader() const override { return base_surface().shader(); }

 private:
  MethodInfo info_{.name = "direct",
                   .summary = "The finest level of every map at the pixel's centre: no filtering.",
                   .paper = "",
                   .options = {},
                   .honours = map_effects_but({}),
                   .reads_finest_level = true};
};

}  // namespace

const Method& direct_method() {
  static const Direct method;
  return method;
}

}  // namespace footprint

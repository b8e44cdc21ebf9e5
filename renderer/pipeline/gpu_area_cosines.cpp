// Uploads the table as the layers of one array texture.
#include "renderer/pipeline/gpu_area_cosines.hpp"

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "renderer/bake/prefiltered.hpp"
#include "renderer/gl/functions.hpp"
#include "renderer/pipeline/gpu_scene.hpp"

namespace footprint {
namespace {

// Fitted once per kind and process: every scene on the GPU needs it again.
const CosineTable& table_of_kind(const ReflectedLobeKind& kind) {
  static std::mutex guard;
  static std::vector<std::pair<ReflectedLobeKind, std::unique_ptr<const CosineTable>>> tables;
  const std::scoped_lock lock(guard);
  for (const auto& [of, table] : tables) {
    if (of == kind) return *table;
  }
  tables.emplace_back(kind, std::make_unique<const CosineTable>(make_cosine_table(kind)));
  return *tables.back().second;
}

PrefilteredTexture table_of(const BaseBrdf& brdf) {
  std::vector<std::vector<Image>> layers;
  const auto add = [&](NormalDistribution distribution) {
    for (const Image& layer : table_of_kind(reflected_lobe_kind(brdf, distribution)).layers) layers.push_back({layer});
  };
  add(brdf.distribution);
  if (brdf.distribution == NormalDistribution::ggx) add(NormalDistribution::beckmann);
  return make_array_texture("area_cosines", std::move(layers), Storage::fp32, {});
}

}  // namespace

ReflectedLobeKind reflected_lobe_kind(const BaseBrdf& brdf, NormalDistribution distribution) {
  switch (brdf.geometry) {
    case GeometryTerm::none:
      break;
    case GeometryTerm::tan:
      return {distribution, TabulatedGeometry::tan};
    case GeometryTerm::ward:
      return {distribution, TabulatedGeometry::ward};
    case GeometryTerm::smith:
      return {distribution, brdf.distribution == NormalDistribution::ggx ? TabulatedGeometry::smith_ggx
                                                                         : TabulatedGeometry::smith_beckmann};
  }
  return {distribution, TabulatedGeometry::none};
}

GpuAreaCosines::GpuAreaCosines(const BaseBrdf& brdf)
    : sampler_(gl::trilinear_sampler(GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE)) {
  const PrefilteredTexture table = table_of(brdf);
  bytes_ = byte_count(table);
  table_ = upload_texels(table);
}

void GpuAreaCosines::bind(GLuint unit) const {
  gl::api().BindTextureUnit(unit, table_.name());
  gl::api().BindSampler(unit, sampler_.name());
}

}  // namespace footprint

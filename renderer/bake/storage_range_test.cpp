// The note appears if a lobe is too narrow for what a method stores, and only then.
#include "renderer/bake/baked_method.hpp"

#include <gtest/gtest.h>

#include "renderer/bake/normal_chain.hpp"

namespace footprint {
namespace {

bool noted(const std::string& storage, float exponent, bool bumpy = true, bool lobes_as_given = false) {
  Material material;
  material.brdf.distribution = NormalDistribution::blinn_phong;
  material.lobe_parameter = exponent;
  EffectSet effects;
  effects.set(static_cast<std::size_t>(Effect::normal_variation), bumpy);
  MethodInfo info;
  info.lobes_as_given = lobes_as_given;
  const Options options({storage_option()}, {{"storage", storage}}, "test");
  return storage_range_note(material, info, options, effects).has_value();
}

TEST(StorageRange, IsNotedWhereALobeIsTooNarrow) {
  EXPECT_TRUE(noted("unorm8", 100.0F));
  EXPECT_FALSE(noted("unorm8", 40.0F));
  EXPECT_TRUE(noted("fp16", 1e4F));
  EXPECT_FALSE(noted("fp16", 1e3F));
  EXPECT_FALSE(noted("fp32", 1e6F));
  EXPECT_FALSE(noted("unorm8", 1e6F, false));
  EXPECT_FALSE(noted("fp16", 1e4F, true, true));
}

TEST(StorageRange, IsNotedOfNoMethodWithoutStorages) {
  EffectSet effects;
  effects.set(static_cast<std::size_t>(Effect::normal_variation));
  EXPECT_FALSE(storage_range_note(Material{}, MethodInfo{}, Options({}, {}, "test"), effects));
}

}  // namespace
}  // namespace footprint

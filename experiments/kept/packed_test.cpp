// Values packed and unpacked: everything comes back to the bit, and nothing else is taken for it.
#include "experiments/kept/packed.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "results/report/record_fields.hpp"

namespace footprint {
namespace {

Record whole_record() {
  Record record;
  record.scene = "a scene";
  record.options = {{"n", 4.0}, {"storage", std::string("fp16")}};
  record.distance = 0.1;
  record.pixels.bound = 7;
  record.error = RecordError{.psnr = std::numeric_limits<double>::infinity(), .noise_floor = 1e-5};
  record.error->causes.shading = 0.3;
  record.other_references = {{.spp = 16, .normalized_color = 0.25, .noise_floor = {}}};
  record.node = "a machine";
  record.frame_build = FrameBuildTime{.ms = 3, .timing = BuildTiming::reused};
  record.effects_on = {"normal_map", ""};
  record.images.color = "images/a.exr";
  return record;
}

TEST(Packed, ARecordComesBackWhole) {
  const auto back = unpacked<Record>(packed(whole_record(), "record"), "record");
  ASSERT_TRUE(back);
  EXPECT_EQ(packed(*back, "record"), packed(whole_record(), "record"));
  EXPECT_EQ(back->scene, "a scene");
  EXPECT_EQ(back->options, whole_record().options);
  EXPECT_TRUE(std::isinf(back->error->psnr));
  EXPECT_EQ(back->error->causes.shading, 0.3);
  EXPECT_FALSE(back->error->causes.edges);
  EXPECT_EQ(back->pixels.bound, 7U);
  EXPECT_FALSE(back->pixels.light);
  EXPECT_EQ(back->frame_build->timing, BuildTiming::reused);
  EXPECT_EQ(back->node, "a machine");
  EXPECT_THAT(back->effects_on, ::testing::ElementsAre("normal_map", ""));
}

TEST(Packed, AnotherFormIsRefused) { EXPECT_FALSE(unpacked<Record>(packed(whole_record(), "record"), "truth")); }

TEST(Packed, AnotherTypeIsRefused) {
  EXPECT_FALSE(unpacked<MethodPair>(packed(whole_record(), "record"), "record"));
  EXPECT_FALSE(unpacked<double>(packed(std::vector<double>{1, 2}, "f"), "f"));
}

TEST(Packed, EveryFlippedBitIsFound) {
  std::vector<std::uint8_t> bytes = packed(whole_record(), "record");
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    bytes[i] ^= 4;
    EXPECT_FALSE(unpacked<Record>(bytes, "record")) << "byte " << i;
    bytes[i] ^= 4;
  }
}

}  // namespace
}  // namespace footprint

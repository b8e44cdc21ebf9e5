// Values written as JSON and read back: equal to the last bit.
#include "results/report/json_archive.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "results/report/record_fields.hpp"
#include "tests/report/example_results.hpp"

namespace footprint {
namespace {

using Json = nlohmann::ordered_json;

template <class T>
Json again(const T& value) {
  return to_json_value(from_json_value<T>(Json::parse(to_json_value(value).dump())));
}

TEST(JsonArchive, EveryRecordComesBackWhole) {
  for (const Record& record : example_results().records) EXPECT_EQ(again(record), to_json_value(record));
}

TEST(JsonArchive, FiguresComeBackToTheBit) {
  Record record = example_results().records.front();
  record.options = {{"n", 4.0}, {"storage", std::string("fp16")}};
  record.distance = 0.1;
  record.error->psnr = std::numeric_limits<double>::infinity();
  record.error->causes.edges.reset();
  record.equivalent = EquivalentSamples{.spp = 64, .side = CurveSide::above};
  record.frame_build = BuildTiming::reused;
  record.materials = {{.material = "a", .pixels = 3, .shading = 1.0 / 3.0, .noise = {}, .bytes = 7}};
  const Record back = from_json_value<Record>(Json::parse(to_json_value(record).dump()));
  EXPECT_EQ(back.options, record.options);
  EXPECT_EQ(back.distance, 0.1);
  EXPECT_TRUE(std::isinf(back.error->psnr));
  EXPECT_FALSE(back.error->causes.edges);
  EXPECT_EQ(back.equivalent->spp, 64);
  EXPECT_EQ(back.equivalent->side, CurveSide::above);
  EXPECT_EQ(back.frame_build, BuildTiming::reused);
  ASSERT_EQ(back.materials.size(), 1U);
  EXPECT_EQ(back.materials[0].shading, 1.0 / 3.0);
  EXPECT_EQ(back.width, record.width);
}

TEST(JsonArchive, TheCurveSideComesBack) {
  for (const CurveSide side : {CurveSide::within, CurveSide::below, CurveSide::above}) {
    Record record;
    record.equivalent = EquivalentSamples{.spp = 41.5, .side = side};
    const Record back = from_json_value<Record>(to_json_value(record));
    ASSERT_TRUE(back.equivalent);
    EXPECT_EQ(back.equivalent->side, side);
    EXPECT_EQ(back.equivalent->spp, 41.5);
  }
  EXPECT_FALSE(from_json_value<Record>(to_json_value(Record{})).equivalent);
}

TEST(JsonArchive, FieldsAreInTheOrderOfTheirList) {
  std::vector<std::string> names;
  const Json pair = to_json_value(MethodPair{});
  for (const auto& [name, value] : pair.items()) names.push_back(name);
  EXPECT_THAT(names, testing::ElementsAre("distance", "methods", "closer", "materials", "picture"));
}

struct Renamed {
  int now = 3;
};
void fields(auto& archive, Is<Renamed> auto& value) { archive("before", value.now); }

TEST(JsonArchive, AFieldKeepsItsNameWhenItsMemberIsRenamed) {
  EXPECT_EQ(to_json_value(Renamed{}).dump(), R"({"before":3})");
  EXPECT_EQ(from_json_value<Renamed>(Json{{"before", 5}}).now, 5);
}

struct Unlisted {
  int value = 0;
};

template <class T>
concept Listed = requires(JsonWriter& writer, const T& value) {
  fields(writer, value);
};

TEST(JsonArchive, AStructureWithoutAListIsNotWritten) {
  EXPECT_TRUE(Listed<Renamed>);
  EXPECT_FALSE(Listed<Unlisted>);
}

struct FieldCount {
  std::size_t count = 0;
  void operator()(const char* /*name*/, const auto& /*value*/) { ++count; }
};

template <class T>
void expect_every_member() {
  FieldCount fields_of_it;
  const T value{};
  fields(fields_of_it, value);
  EXPECT_EQ(fields_of_it.count, member_count<T>()) << to_json_value(value).dump();
}

TEST(JsonArchive, NoMemberIsForgotten) {
  expect_every_member<FrameTime>();
  expect_every_member<TimeRatio>();
  expect_every_member<ErrorCauses>();
  expect_every_member<PixelCounts>();
  expect_every_member<FlickerCauses>();
  expect_every_member<OtherReference>();
  expect_every_member<RecordImages>();
  expect_every_member<MaterialError>();
  expect_every_member<MethodPair>();
  expect_every_member<SupersamplingPoint>();
  expect_every_member<FootprintNdf>();
  expect_every_member<QuantityFigure>();
  expect_every_member<PublishedFigure>();
  expect_every_member<SecondVerdict>();
  expect_every_member<ExperimentReport>();
  expect_every_member<SceneInfo>();
  expect_every_member<ReferenceInfo>();
  expect_every_member<HistorySettings>();
}

TEST(JsonArchive, AnotherDocumentIsRefused) {
  EXPECT_THROW((void)from_json_value<Record>(Json::array()), Json::exception);
  EXPECT_THROW((void)from_json_value<Record>(Json::object()), Json::exception);
  EXPECT_THROW((void)from_json_value<MethodPair>(to_json_value(Record{})), Json::exception);
  Json unknown = to_json_value(example_results().records.front());
  unknown["time"]["frame_build"] = "sometimes";
  EXPECT_ANY_THROW((void)from_json_value<Record>(unknown));
}

}  // namespace
}  // namespace footprint

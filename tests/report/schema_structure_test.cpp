// The schema of a small structure, a schema that differs from it in one place each, and the schema that is written.
#include "tests/report/schema_structure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "results/report/records.hpp"
#include "tests/report/schema_archive.hpp"

namespace footprint::test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::StartsWith;
using Json = nlohmann::ordered_json;

struct Point {
  double x = 0;
  std::optional<double> y;
};

struct Example {
  int count = 0;
  bool whole = false;
  std::string name;
  std::optional<BuildTiming> timing;
  std::array<std::uint32_t, 3> bins{};
  std::vector<Point> points;
  std::map<std::string, std::variant<double, std::string>> options;
  int width = 1, height = 1;
};

template <class Archive>
void fields(Archive& archive, Is<Point> auto& value) {
  archive("x", value.x);
  archive("y", value.y);
}

template <class Archive>
void fields(Archive& archive, Is<Example> auto& value) {
  archive("count", value.count);
  archive.group("names", [&](auto& names) {
    names("whole", value.whole);
    names("name", value.name);
  });
  archive("timing", value.timing);
  archive("bins", value.bins);
  archive("points", value.points);
  archive("options", value.options);
  archive("size", std::tie(value.width, value.height));
  archive.derived("area", value.width * value.height);
}

Json structure() { return SchemaArchive::schema_of(Example{}); }

void describe(Json& schema) {
  schema["description"] = "A value.";
  if (!schema.contains("properties")) return;
  for (auto& property : schema["properties"]) describe(property);
}

Json described() {
  Json schema = structure();
  describe(schema);
  for (const char* key : {"bins", "points", "size"}) describe(schema["properties"][key]["items"]);
  describe(schema["properties"]["options"]["additionalProperties"]);
  return schema;
}

TEST(SchemaArchive, EachTypeHasItsSchema) {
  const Json properties = structure()["properties"];
  EXPECT_EQ(properties["count"], Json({{"type", "integer"}}));
  EXPECT_EQ(properties["names"]["required"], Json({"whole", "name"}));
  EXPECT_EQ(properties["names"]["properties"]["whole"], Json({{"type", "boolean"}}));
  EXPECT_EQ(properties["names"]["properties"]["name"], Json({{"type", "string"}}));
  EXPECT_EQ(properties["timing"], Json({{"type", {"string", "null"}}, {"enum", {"every frame", "reused", nullptr}}}));
  EXPECT_EQ(properties["bins"]["maxItems"], 3);
  EXPECT_EQ(properties["points"]["items"]["properties"]["y"]["type"], Json({"number", "null"}));
  EXPECT_EQ(properties["options"]["additionalProperties"], Json({{"type", {"number", "string"}}}));
  EXPECT_EQ(properties["size"]["minItems"], 2);
  EXPECT_EQ(properties["size"]["items"]["type"], "integer");
  EXPECT_EQ(properties["area"]["type"], "integer");
  EXPECT_EQ(structure()["additionalProperties"], false);
}

TEST(SchemaDifferences, AnEqualSchemaHasNone) { EXPECT_THAT(schema_differences(structure(), described()), IsEmpty()); }

TEST(SchemaDifferences, ByHandTheRestIsFree) {
  Json schema = described();
  Json& properties = schema["properties"];
  schema["title"] = "Example";
  schema["definitions"]["point"] = properties["points"]["items"];
  properties["points"]["items"] = {{"$ref", "#/definitions/point"}, {"description", "One point."}};
  properties["points"]["minItems"] = 1;
  properties["names"]["properties"]["name"]["enum"] = {"a", "b"};
  properties["count"]["minimum"] = 0;
  schema["definitions"]["point"]["properties"]["x"]["type"] = {"number", "null"};
  EXPECT_THAT(schema_differences(structure(), schema), IsEmpty());
  EXPECT_EQ(with_structure(structure(), schema), schema);
}

TEST(SchemaDifferences, EachIsAtItsPlace) {
  const std::vector<std::pair<std::string, void (*)(Json&)>> changes{
      {"/bins: the fields have it", [](Json& s) { s["properties"].erase("bins"); }},
      {"/extra: the schema has it",
       [](Json& s) {
         s["properties"]["extra"] = {{"type", "null"}};
       }},
      {"/: its properties have another order",
       [](Json& s) {
         const Json first = s["properties"]["count"];
         s["properties"].erase("count");
         s["properties"]["count"] = first;
       }},
      {"/names: required is [\"whole\"]", [](Json& s) { s["properties"]["names"]["required"].erase(1); }},
      {"/names: additionalProperties is true",
       [](Json& s) { s["properties"]["names"]["additionalProperties"] = true; }},
      {"/count: type is \"number\"", [](Json& s) { s["properties"]["count"]["type"] = "number"; }},
      {"/timing: enum is", [](Json& s) { s["properties"]["timing"]["enum"].erase(1); }},
      {"/bins: maxItems is 4", [](Json& s) { s["properties"]["bins"]["maxItems"] = 4; }},
      {"/points/*/y: type is \"number\"",
       [](Json& s) { s["properties"]["points"]["items"]["properties"]["y"]["type"] = "number"; }},
      {"/options/*: type is", [](Json& s) { s["properties"]["options"]["additionalProperties"]["type"] = "number"; }},
      {"/names/name: its description is missing",
       [](Json& s) { s["properties"]["names"]["properties"]["name"]["description"] = ""; }}};
  for (const auto& [difference, change] : changes) {
    Json schema = described();
    change(schema);
    EXPECT_THAT(schema_differences(structure(), schema), ElementsAre(StartsWith(difference)));
    Json written = with_structure(structure(), schema);
    describe(written);
    for (const char* key : {"bins", "points", "size"}) describe(written["properties"][key]["items"]);
    EXPECT_THAT(schema_differences(structure(), written), IsEmpty()) << difference;
  }
}

TEST(WithStructure, ANewPropertyHasTheDescriptionOfItsStructure) {
  Json known = structure();
  known["properties"]["count"]["description"] = "How many.";
  Json schema = described();
  EXPECT_EQ(with_structure(known, schema), schema) << "a description that is there remains";
  schema["properties"].erase("count");
  EXPECT_EQ(with_structure(known, schema)["properties"]["count"]["description"], "How many.");
}

TEST(WithStructure, DescriptionsAndLimitsRemain) {
  Json schema = described();
  schema["properties"]["points"]["items"]["properties"]["x"] = {{"description", "Left."}, {"minimum", 0}};
  schema["properties"].erase("area");
  const Json properties = with_structure(structure(), schema)["properties"];
  EXPECT_EQ(properties["points"]["items"]["properties"]["x"],
            Json({{"description", "Left."}, {"minimum", 0}, {"type", "number"}}));
  EXPECT_EQ(properties["area"], Json({{"type", "integer"}, {"description", ""}}));
}

}  // namespace
}  // namespace footprint::test

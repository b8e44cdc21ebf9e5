// Walks a structure and a schema together, node by node.
#include "tests/report/schema_structure.hpp"

#include <fmt/format.h>

namespace footprint::test {
namespace {

using Json = nlohmann::ordered_json;

Json::json_pointer target_of(const Json& schema) {
  return Json::json_pointer(schema["$ref"].get<std::string>().substr(1));
}

Json value_at(const Json& schema, const char* key) { return schema.contains(key) ? schema[key] : Json(); }

Json names_of(const Json& properties) {
  Json names = Json::array();
  for (const auto& [name, property] : properties.items()) names.push_back(name);
  return names;
}

bool may_be_type(const Json& type, const Json& structure) {
  return type == structure["type"] || (structure["type"] == "number" && type == Json::array({"number", "null"}));
}

class Comparison {
 public:
  explicit Comparison(const Json& root) : root_(root) {}

  void compare(const Json& structure, const Json& schema, const std::string& place) {
    if (schema.value("description", "").empty()) report(place, "its description is missing");
    if (schema.contains("$ref")) return compare(structure, root_.at(target_of(schema)), place);
    if (!may_be_type(value_at(schema, "type"), structure)) differs(structure, schema, place, "type");
    for (const char* key : {"enum", "minItems", "maxItems"}) {
      if (structure.contains(key) && structure[key] != value_at(schema, key)) differs(structure, schema, place, key);
    }
    if (structure.contains("properties")) compare_properties(structure, schema, place);
    for (const char* key : {"items", "additionalProperties"}) {
      if (!structure.contains(key)) continue;
      if (structure[key].is_object() && value_at(schema, key).is_object()) {
        compare(structure[key], schema[key], place + "/*");
      } else if (structure[key] != value_at(schema, key)) {
        differs(structure, schema, place, key);
      }
    }
  }

  [[nodiscard]] std::vector<std::string> found() && { return std::move(found_); }

 private:
  void compare_properties(const Json& structure, const Json& schema, const std::string& place) {
    const Json properties = schema.value("properties", Json::object());
    for (const auto& [name, property] : structure["properties"].items()) {
      if (properties.contains(name)) {
        compare(property, properties[name], fmt::format("{}/{}", place, name));
      } else {
        report(fmt::format("{}/{}", place, name), "the fields have it, but the schema does not");
      }
    }
    bool same = properties.size() == structure["properties"].size();
    for (const auto& [name, property] : properties.items()) {
      if (structure["properties"].contains(name)) continue;
      report(fmt::format("{}/{}", place, name), "the schema has it, but the fields do not");
      same = false;
    }
    if (!same) return;
    if (names_of(properties) != names_of(structure["properties"])) report(place, "its properties have another order");
    if (structure["required"] != value_at(schema, "required")) differs(structure, schema, place, "required");
  }

  void differs(const Json& structure, const Json& schema, const std::string& place, const char* key) {
    report(place, fmt::format("{} is {}, but {} by the fields", key, value_at(schema, key).dump(),
                              structure[key].is_object() ? "a schema" : structure[key].dump()));
  }

  void report(const std::string& place, const std::string& difference) {
    found_.push_back(fmt::format("{}: {}", place.empty() ? "/" : place, difference));
  }

  const Json& root_;
  std::vector<std::string> found_;
};

void restructure(const Json& structure, Json& schema, Json& root) {
  if (schema.contains("$ref")) return restructure(structure, root.at(target_of(schema)), root);
  if (!may_be_type(value_at(schema, "type"), structure)) schema["type"] = structure["type"];
  if (!schema.contains("description")) schema["description"] = structure.value("description", "");
  for (const char* key : {"enum", "minItems", "maxItems", "required"}) {
    if (structure.contains(key)) schema[key] = structure[key];
  }
  if (structure.contains("properties")) {
    Json properties = Json::object();
    for (const auto& [name, property] : structure["properties"].items()) {
      Json inner = schema.contains("properties") ? value_at(schema["properties"], name.c_str()) : Json();
      if (!inner.is_object()) inner = Json::object();
      restructure(property, inner, root);
      properties[name] = std::move(inner);
    }
    schema["properties"] = std::move(properties);
  }
  for (const char* key : {"items", "additionalProperties"}) {
    if (!structure.contains(key)) continue;
    if (!structure[key].is_object()) {
      schema[key] = structure[key];
      continue;
    }
    Json inner = value_at(schema, key).is_object() ? schema[key] : Json::object();
    restructure(structure[key], inner, root);
    schema[key] = std::move(inner);
  }
  for (const char* key : {"items", "properties", "required", "additionalProperties"}) {
    if (!structure.contains(key)) schema.erase(key);
  }
}

}  // namespace

std::vector<std::string> schema_differences(const Json& structure, const Json& schema) {
  Comparison comparison(schema);
  comparison.compare(structure, schema, "");
  return std::move(comparison).found();
}

Json with_structure(const Json& structure, Json schema) {
  restructure(structure, schema, schema);
  return schema;
}

}  // namespace footprint::test

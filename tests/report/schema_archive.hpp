// The JSON schema of a document from the fields of its value: the third archive beside the writer and the reader of
// results/report/json_archive.hpp.
#pragma once

#include <string>
#include <type_traits>

#include "results/report/json_archive.hpp"

namespace footprint::test {

/// Builds the schema of an object, field by field in their order. A field's type decides its schema; values are only
/// used for figures that follow from others.
class SchemaArchive {
 public:
  using Json = nlohmann::ordered_json;
  static constexpr bool reads = false;

  template <class T>
  [[nodiscard]] static Json schema_of(const T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      return {{"type", "boolean"}};
    } else if constexpr (std::is_arithmetic_v<T>) {
      return {{"type", std::is_floating_point_v<T> ? "number" : "integer"}};
    } else if constexpr (std::is_enum_v<T>) {
      Json schema{{"type", "string"}, {"enum", Json::array()}};
      for (const auto& [one, word] : words_of(value)) schema["enum"].push_back(word);
      return schema;
    } else if constexpr (std::is_convertible_v<T, std::string_view>) {
      return {{"type", "string"}};
    } else {
      SchemaArchive inner;
      fields(inner, value);
      return std::move(inner.schema_);
    }
  }
  template <class T>
  [[nodiscard]] static Json schema_of(const std::optional<T>& value) {
    Json schema = schema_of(value.value_or(T{}));
    schema["type"] = Json::array({schema["type"], "null"});
    if (schema.contains("enum")) schema["enum"].push_back(nullptr);
    return schema;
  }
  template <class T>
  [[nodiscard]] static Json schema_of(const std::vector<T>& /*values*/) {
    return {{"type", "array"}, {"items", schema_of(T{})}};
  }
  template <class T, std::size_t count>
  [[nodiscard]] static Json schema_of(const std::array<T, count>& /*values*/) {
    return {{"type", "array"}, {"minItems", count}, {"maxItems", count}, {"items", schema_of(T{})}};
  }
  template <class... T>
  [[nodiscard]] static Json schema_of(const std::variant<T...>& /*value*/) {
    return {{"type", Json::array({schema_of(T{})["type"]...})}};
  }
  template <class T, class... More>
  [[nodiscard]] static Json schema_of(const std::tuple<T, More...>& /*values*/) {
    static_assert((std::is_same_v<T, More> && ...), "elements of one type");
    return schema_of(std::array<std::decay_t<T>, 1 + sizeof...(More)>{});
  }
  template <class T>
  [[nodiscard]] static Json schema_of(const std::map<std::string, T>& /*values*/) {
    return {{"type", "object"}, {"additionalProperties", schema_of(T{})}};
  }
  template <class T>
  [[nodiscard]] static Json schema_of(const std::vector<std::pair<std::string, T>>& /*values*/) {
    return {{"type", "object"}, {"additionalProperties", schema_of(T{})}};
  }

  template <class T>
  void operator()(const char* name, const T& value) {
    add(name, schema_of(value));
  }
  template <class Add>
  void group(const char* name, Add add_fields) {
    SchemaArchive inner;
    add_fields(inner);
    add(name, std::move(inner.schema_));
  }
  template <class T>
  void derived(const char* name, const T& value) {
    add(name, schema_of(value));
  }

 private:
  void add(const char* name, Json schema) {
    schema_["required"].push_back(name);
    schema_["properties"][name] = std::move(schema);
  }

  Json schema_{
      {"type", "object"}, {"additionalProperties", false}, {"required", Json::array()}, {"properties", Json::object()}};
};

}  // namespace footprint::test

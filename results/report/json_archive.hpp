// Values as JSON and back. A structure lists its fields once, by `fields(archive, value)` in its namespace:
//   void fields(auto& archive, Is<Flicker> auto& value) { archive("mean", value.mean); ... }
// An enumeration gives its words by `words_of(value)`. A number that is not finite is null, like an absent value.
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "renderer/core/names.hpp"

namespace footprint {

/// `Value` is `Type` or const `Type`: one list of fields serves the writer and the reader.
template <class Value, class Type>
concept Is = std::same_as<std::remove_const_t<Value>, Type>;

/// Builds an object, field by field in their order.
class JsonWriter {
 public:
  using Json = nlohmann::ordered_json;
  static constexpr bool reads = false;

  template <class T>
  [[nodiscard]] static Json json_of(const T& value) {
    if constexpr (std::is_floating_point_v<T>) {
      return std::isfinite(value) ? Json(value) : Json();
    } else if constexpr (std::is_enum_v<T>) {
      return word_for(words_of(value), value);
    } else if constexpr (std::is_arithmetic_v<T> || std::is_convertible_v<T, std::string_view> || Is<T, Json>) {
      return value;
    } else {
      JsonWriter writer;
      fields(writer, value);
      return std::move(writer.json_);
    }
  }
  template <class T>
  [[nodiscard]] static Json json_of(const std::optional<T>& value) {
    return value ? json_of(*value) : Json();
  }
  template <class T>
  [[nodiscard]] static Json json_of(const std::vector<T>& values) {
    return array_of(values);
  }
  template <class T, std::size_t count>
  [[nodiscard]] static Json json_of(const std::array<T, count>& values) {
    return array_of(values);
  }
  template <class... T>
  [[nodiscard]] static Json json_of(const std::variant<T...>& value) {
    return std::visit([](const auto& one) { return json_of(one); }, value);
  }
  template <class... T>
  [[nodiscard]] static Json json_of(const std::tuple<T...>& values) {
    return std::apply([](const auto&... each) { return Json::array({json_of(each)...}); }, values);
  }
  template <class T>
  [[nodiscard]] static Json json_of(const std::map<std::string, T>& values) {
    return object_of(values);
  }
  template <class T>
  [[nodiscard]] static Json json_of(const std::vector<std::pair<std::string, T>>& values) {
    return object_of(values);
  }

  template <class T>
  void operator()(const char* name, const T& value) {
    json_[name] = json_of(value);
  }
  /// An object within the object.
  template <class Add>
  void group(const char* name, Add add) {
    JsonWriter inner;
    add(inner);
    json_[name] = std::move(inner.json_);
  }
  /// A figure that follows from others: written, never read.
  template <class T>
  void derived(const char* name, const T& value) {
    json_[name] = json_of(value);
  }

 private:
  [[nodiscard]] static Json array_of(const auto& values) {
    Json array = Json::array();
    for (const auto& value : values) array.push_back(json_of(value));
    return array;
  }
  [[nodiscard]] static Json object_of(const auto& values) {
    Json object = Json::object();
    for (const auto& [name, value] : values) object[name] = json_of(value);
    return object;
  }

  Json json_ = Json::object();
};

/// Reads such an object. Throws nlohmann::json::exception if a field is missing or of another type.
class JsonReader {
 public:
  using Json = nlohmann::ordered_json;
  static constexpr bool reads = true;

  explicit JsonReader(const Json& json) : json_(json) {}

  template <class T>
  void operator()(const char* name, T&& value) const {
    read(json_.at(name), value);
  }
  template <class Add>
  void group(const char* name, Add add) const {
    JsonReader inner(json_.at(name));
    add(inner);
  }
  template <class T>
  void derived(const char* /*name*/, const T& /*value*/) const {}
  [[nodiscard]] const Json& at(const char* name) const { return json_.at(name); }

  template <class T>
  static void read(const Json& json, T& value) {
    if constexpr (std::is_floating_point_v<T>) {
      value = json.is_null() ? std::numeric_limits<T>::infinity() : json.get<T>();
    } else if constexpr (std::is_enum_v<T>) {
      value = word_value(words_of(value), json.get<std::string>(), "word", "JSON");
    } else if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>) {
      value = json.get<T>();
    } else {
      JsonReader reader(json);
      fields(reader, value);
    }
  }
  template <class T>
  static void read(const Json& json, std::optional<T>& value) {
    value.reset();
    if (!json.is_null()) read(json, value.emplace());
  }
  template <class T>
  static void read(const Json& json, std::vector<T>& values) {
    values.clear();
    for (const Json& element : json) read(element, values.emplace_back());
  }
  template <class T, std::size_t count>
  static void read(const Json& json, std::array<T, count>& values) {
    for (std::size_t i = 0; i < count; ++i) read(json.at(i), values.at(i));
  }
  template <class... T>
  static void read(const Json& json, std::tuple<T&...>& values) {
    std::size_t i = 0;
    std::apply([&](auto&... each) { (read(json.at(i++), each), ...); }, values);
  }
  template <class T>
  static void read(const Json& json, std::map<std::string, T>& values) {
    for (const auto& [name, value] : json.items()) read(value, values[name]);
  }
  template <class T>
  static void read(const Json& json, std::vector<std::pair<std::string, T>>& values) {
    for (const auto& [name, value] : json.items()) read(value, values.emplace_back(name, T{}).second);
  }
  static void read(const Json& json, std::variant<double, std::string>& value) {
    if (json.is_string()) {
      value = json.get<std::string>();
    } else {
      value = json.get<double>();
    }
  }

 private:
  const Json& json_;
};

/// A value as JSON.
template <class T>
[[nodiscard]] nlohmann::ordered_json to_json_value(const T& value) {
  return JsonWriter::json_of(value);
}

/// A value from JSON. Throws nlohmann::json::exception, or Error for an unknown word.
template <class T>
[[nodiscard]] T from_json_value(const nlohmann::ordered_json& json) {
  T value{};
  JsonReader::read(json, value);
  return value;
}

}  // namespace footprint

// Values as JSON and back. A structure lists its fields once, beside it, by a function of its namespace:
//   void fields(auto& archive, Is<Flicker> auto& value) { archive("mean", value.mean); ... }
// An enumeration gives its words by `words_of(value)`. A number that is not finite is null, like an absent value.
#pragma once

#include <cmath>
#include <concepts>
#include <limits>
#include <nlohmann/json.hpp>
#include <ranges>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>

#include "renderer/core/members.hpp"
#include "renderer/core/names.hpp"
#include "results/report/fields.hpp"

namespace footprint {

/// Pairs of a name and a value: a map, or a list in its own order.
template <class T>
concept IsObject = std::ranges::range<T> && std::is_convertible_v<decltype(T::value_type::first), std::string>;

/// Whether a structure lists no fields, and has its members by their C++ names as fields. For documents that only this
/// program reads, such as caches and hashes, where a renamed member does no harm.
template <class T>
inline constexpr bool is_private_document = false;

/// The address of a member as an argument of a template, whose name the compiler then writes out.
template <class T>
struct MemberAddress {
  const T* address;
  constexpr explicit MemberAddress(const T& member) : address(&member) {}
};

/// The name in C++ of the member at an address.
template <MemberAddress member>
[[nodiscard]] std::string member_name() {
  const std::string_view text = __PRETTY_FUNCTION__;  // "... = {(& example<Flicker>.footprint::Flicker::mean)}; ..."
  const std::size_t end = text.find_last_not_of(')', text.rfind('}') - 1) + 1;
  const std::size_t start = text.find_last_of(":.", end) + 1;
  return std::string(text.substr(start, end - start));
}

/// A structure to take the addresses of members of; its values are not used.
template <class T>
inline const T example{};

/// The name of member `i` of a structure.
template <class T, std::size_t i>
[[nodiscard]] std::string member_name_of() {
  constexpr MemberAddress member(std::get<i>(members_of(example<T>)));
  return member_name<member>();
}

/// Every member of the structure of a private document.
template <class Archive, class Structure>
requires is_private_document<std::remove_const_t<Structure>>
void fields(Archive& archive, Structure& value) {
  const auto members = members_of(value);
  const auto add = [&]<std::size_t... i>(std::index_sequence<i...> /*all*/) {
    (archive(member_name_of<std::remove_const_t<Structure>, i>().c_str(), std::get<i>(members)), ...);
  };
  add(std::make_index_sequence<std::tuple_size_v<decltype(members)>>());
}

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
    } else if constexpr (requires { value.has_value(); }) {
      return value ? json_of(*value) : Json();
    } else if constexpr (IsObject<T>) {
      Json object = Json::object();
      for (const auto& [name, inner] : value) object[name] = json_of(inner);
      return object;
    } else if constexpr (std::ranges::range<T>) {
      Json array = Json::array();
      for (const auto& inner : value) array.push_back(json_of(inner));
      return array;
    } else {
      JsonWriter writer;
      fields(writer, value);
      return std::move(writer.json_);
    }
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
    } else if constexpr (requires { value.has_value(); }) {
      value.reset();
      if (!json.is_null()) read(json, value.emplace());
    } else if constexpr (IsObject<T>) {
      for (const auto& [name, inner] : json.items())
        read(inner, value.insert(value.end(), typename T::value_type(name, {}))->second);
    } else if constexpr (requires { value.emplace_back(); }) {
      value.clear();
      for (const Json& inner : json) read(inner, value.emplace_back());
    } else if constexpr (std::ranges::range<T>) {
      std::size_t i = 0;
      for (auto& inner : value) read(json.at(i++), inner);
    } else {
      JsonReader reader(json);
      fields(reader, value);
    }
  }
  template <class... T>
  static void read(const Json& json, std::tuple<T&...>& values) {
    std::size_t i = 0;
    std::apply([&](auto&... each) { (read(json.at(i++), each), ...); }, values);
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

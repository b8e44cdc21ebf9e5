// A JSON value with the place it stands at, so that every complaint about a document can name it.
#pragma once

#include <concepts>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "renderer/core/error.hpp"

namespace footprint {

/// Reads one value strictly: a wrong type, a missing or an unknown key is an Error (usage) that names the file and the
/// JSON pointer. Refers to the document and to the file name, which must outlive it.
class JsonNode {
 public:
  using Json = nlohmann::ordered_json;

  JsonNode(const Json& value, const std::string& source) : JsonNode(value, source, Json::json_pointer()) {}

  /// Checks that this is an object with exactly `keys`; an unknown key is answered with the nearest right one.
  const JsonNode& with_keys(const std::vector<std::string>& keys) const;

  [[nodiscard]] bool has(const std::string& key) const { return value_->is_object() && value_->contains(key); }

  /// A member of an object that has it.
  [[nodiscard]] JsonNode operator[](const std::string& key) const {
    return {value_->at(key), *source_, pointer_ / key};
  }

  [[nodiscard]] std::vector<JsonNode> elements() const;                         ///< of an array
  [[nodiscard]] std::vector<std::pair<std::string, JsonNode>> members() const;  ///< of an object with free keys

  [[nodiscard]] bool is_null() const { return value_->is_null(); }
  [[nodiscard]] bool is_text() const { return value_->is_string(); }
  [[nodiscard]] double number() const;
  [[nodiscard]] double number_or(double when_null) const { return is_null() ? when_null : number(); }
  [[nodiscard]] std::optional<double> optional_number() const;
  [[nodiscard]] std::string text() const;
  [[nodiscard]] std::vector<std::string> texts() const;
  [[nodiscard]] bool flag() const;

  /// A whole number of T's range, not below `minimum`.
  template <std::integral T>
  [[nodiscard]] T whole(T minimum = 0) const {
    if (value_->is_number_unsigned() && value_->get<std::uint64_t>() <= static_cast<std::uint64_t>(maximum<T>())) {
      const auto held = value_->get<T>();
      if (held >= minimum) return held;
    }
    fail("must be a whole number from " + std::to_string(minimum) + " to " + std::to_string(maximum<T>()));
  }

  [[noreturn]] void fail(const std::string& message, const std::string& mend = {}) const;

 private:
  JsonNode(const Json& value, const std::string& source, Json::json_pointer pointer)
      : value_(&value), source_(&source), pointer_(std::move(pointer)) {}

  template <std::integral T>
  static constexpr T maximum() {
    return std::numeric_limits<T>::max();
  }

  const Json* value_;
  const std::string* source_;
  Json::json_pointer pointer_;
};

}  // namespace footprint

// Lists of three numbers as vectors, colours and unit directions.
#include "renderer/scene/settings/toml_values.hpp"

#include <fmt/format.h>

namespace footprint {

std::optional<glm::dvec3> read_vector(const TomlTable& table, std::string_view key, NumberRange range) {
  const auto values = table.numbers(key, 3, range);
  if (!values) return std::nullopt;
  return glm::dvec3{(*values)[0], (*values)[1], (*values)[2]};
}

std::optional<glm::vec3> read_color(const TomlTable& table, std::string_view key) {
  const auto value = read_vector(table, key, unit_range);
  if (!value) return std::nullopt;
  return glm::vec3{*value};
}

/// A unit vector.
std::optional<glm::dvec3> read_direction(const TomlTable& table, std::string_view key) {
  const auto value = read_vector(table, key, coordinate_range);
  if (!value) return std::nullopt;
  if (glm::length(*value) < 1e-9) throw table.error_at(key, "has no length", "give a direction such as [0, 0, 1]");
  return glm::normalize(*value);
}

void refuse_missing(const TomlTable& table, std::string_view key, std::string_view document) {
  throw table.error_at(key, "is missing", fmt::format("add it ({})", document));
}

}  // namespace footprint

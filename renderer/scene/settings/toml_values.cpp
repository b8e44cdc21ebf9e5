// Lists of numbers as vectors, colours and unit directions; names as paths.
#include "renderer/scene/settings/toml_values.hpp"

#include <fmt/format.h>

namespace footprint {

std::optional<std::filesystem::path> read_path(const TomlTable& table, std::string_view key,
                                               const std::filesystem::path& folder) {
  const auto name = table.word(key);
  return name ? std::optional(folder / *name) : std::nullopt;
}

std::optional<glm::dvec2> read_pair(const TomlTable& table, std::string_view key, NumberRange range) {
  const auto values = table.numbers(key, 2, range);
  return values ? std::optional(glm::dvec2((*values)[0], (*values)[1])) : std::nullopt;
}

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

std::vector<std::filesystem::path> read_candidates(const TomlTable& table, const std::filesystem::path& folder,
                                                   const std::string& hint) {
  if (table.has("file") == table.has("files"))
    throw table.error_at("file", "or `files` must be given, and only one of them", hint);
  std::vector<std::filesystem::path> candidates;
  for (const std::string& name : table.has("file") ? std::vector{*table.word("file")} : *table.words("files"))
    candidates.push_back(folder / name);
  return candidates;
}

Error missing_candidates(std::span<const std::filesystem::path> candidates, const std::string& message,
                         const std::string& package, const std::string& check) {
  std::string tried;
  for (const auto& candidate : candidates) tried += (tried.empty() ? "" : ", ") + candidate.string();
  return {ErrorKind::usage, tried, message, package.empty() ? check : "install the package " + package};
}

void refuse_missing(const TomlTable& table, std::string_view key, std::string_view document) {
  throw table.error_at(key, "is missing", fmt::format("add it ({})", document));
}

}  // namespace footprint

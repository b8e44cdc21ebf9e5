// Directions, colours and points of TOML tables, which several readers share.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string_view>

#include "renderer/core/toml_table.hpp"

namespace footprint {

inline constexpr NumberRange unit_range{0.0, 1.0};
inline constexpr NumberRange length_range{1e-6, 1e6};      ///< metres, above 0
inline constexpr NumberRange coordinate_range{-1e9, 1e9};  ///< metres

/// Three numbers. Nothing where the key is absent; errors (usage) as of TomlTable, here and below.
[[nodiscard]] std::optional<glm::dvec3> read_vector(const TomlTable& table, std::string_view key, NumberRange range);

/// A colour, each channel 0 to 1.
[[nodiscard]] std::optional<glm::vec3> read_color(const TomlTable& table, std::string_view key);

/// A unit vector, from one of any length but 0.
[[nodiscard]] std::optional<glm::dvec3> read_direction(const TomlTable& table, std::string_view key);

/// Refuses a table without a key that it must have, which `document` explains.
[[noreturn]] void refuse_missing(const TomlTable& table, std::string_view key,
                                 std::string_view document = "docs/scenes.md");

}  // namespace footprint

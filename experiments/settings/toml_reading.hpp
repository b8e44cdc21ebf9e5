// What readers of experiment files share beyond TomlTable: the error of a key that is missing.
#pragma once

#include <string_view>

#include "renderer/core/error.hpp"
#include "renderer/core/toml_table.hpp"

namespace footprint {

/// Throws that a required key is missing.
[[noreturn]] inline void refuse_absent(const TomlTable& table, std::string_view key) {
  throw table.error_at(key, "is missing", "add it (docs/experiments.md)");
}

}  // namespace footprint

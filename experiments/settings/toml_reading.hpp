// What readers of experiment files share beyond TomlTable: errors of other readers, and of keys that are missing.
#pragma once

#include <string_view>

#include "renderer/core/error.hpp"
#include "renderer/core/toml_table.hpp"

namespace footprint {

/// Throws that a required key is missing.
[[noreturn]] inline void refuse_absent(const TomlTable& table, std::string_view key) {
  throw table.error_at(key, "is missing", "add it (docs/experiments.md)");
}

/// What `read` makes of a key's value; what it found wrong becomes an error at the line of the key.
template <typename Read>
auto at_key(const TomlTable& table, std::string_view key, Read read) {
  try {
    return read();
  } catch (const Error& error) {
    const std::string place = error.place().empty() ? "" : error.place() + ": ";
    throw table.error_at(key, "cannot be taken: " + place + error.message(), error.hint());
  }
}

}  // namespace footprint

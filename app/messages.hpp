// What the program tells people on standard error, beside its progress.
#pragma once

#include <string>
#include <string_view>

#include "renderer/scene/scene.hpp"

namespace footprint {

/// `text` as one line that any terminal can show: control characters become spaces, bytes that are no UTF-8 become
/// U+FFFD. Names in files are anyone's.
[[nodiscard]] std::string printable_line(std::string_view text);

/// Writes "footprint: TEXT" as one line to standard error.
void write_message(std::string_view text);

/// Writes one message for each of the scene's warnings and, unless `quiet`, for what was supplied because it has none.
void write_scene_notes(const Scene& scene, bool quiet);

}  // namespace footprint

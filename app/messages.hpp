// Text on standard output and, besides the progress, on standard error.
#pragma once

#include <string>
#include <string_view>

#include "renderer/scene/scene.hpp"

namespace footprint {

/// `text` as one line that any terminal can show: control characters become spaces, and bytes that are not UTF-8 become
/// U+FFFD, because names in files can contain anything.
[[nodiscard]] std::string printable_line(std::string_view text);

/// Writes "footprint: TEXT" as one line to standard error.
void write_message(std::string_view text);

/// Writes a message per warning of the scene and, unless `quiet`, per default that was supplied for it.
void write_scene_notes(const Scene& scene, bool quiet);

/// Writes the whole text and flushes it. A reader that closed the pipe (`| head`) is not an error. Errors (machine):
/// the text cannot be written.
void write_output(std::string_view text);

}  // namespace footprint

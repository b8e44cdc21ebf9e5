// Lines on standard error that any terminal can show.
#include "app/messages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace footprint {
namespace {

// The JSON library replaces bytes that are not UTF-8 when it writes.
std::string valid_utf8(std::string_view text) {
  using nlohmann::json;
  return json::parse(json(text).dump(-1, ' ', false, json::error_handler_t::replace)).get<std::string>();
}

}  // namespace

std::string printable_line(std::string_view text) {
  std::string line = valid_utf8(text);
  std::ranges::replace_if(
      line, [](unsigned char c) { return c < 0x20 || c == 0x7f; }, ' ');
  return line;
}

void write_message(std::string_view text) {
  // If standard error is closed, there is nowhere left to report that.
  (void)std::fputs(("footprint: " + printable_line(text) + "\n").c_str(), stderr);
}

void write_scene_notes(const Scene& scene, bool quiet) {
  for (const std::string& warning : scene.warnings) write_message("warning: " + warning);
  if (quiet) return;
  for (const std::string& supplied : scene.defaults) write_message("supplied " + supplied);
}

}  // namespace footprint

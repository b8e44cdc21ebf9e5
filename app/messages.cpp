// Makes messages lines that any terminal can show, and flushes results at once, so that a full disk is an error here.
#include "app/messages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <system_error>

#include "renderer/core/error.hpp"

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

void write_output(std::string_view text) {
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (written && std::fflush(stdout) == 0) return;
  const int reason = errno;
  if (reason == EPIPE) return;
  throw Error(ErrorKind::machine, "standard output", "cannot be written: " + std::generic_category().message(reason),
              "free the disk, or write elsewhere");
}

}  // namespace footprint

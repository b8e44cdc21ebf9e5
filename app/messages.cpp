// Messages are lines that any terminal can show; results are flushed at once, so that a full disk is an error here.
#include "app/messages.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "renderer/core/error.hpp"
#include "renderer/core/process.hpp"

namespace footprint {
namespace {

// The JSON library replaces bytes that are not UTF-8 when it writes.
std::string valid_utf8(std::string_view text) {
  using nlohmann::json;
  return json::parse(json(text).dump(-1, ' ', false, json::error_handler_t::replace)).get<std::string>();
}

using namespace std::chrono_literals;

constexpr std::string_view clear_line = "\r\x1b[K";
constexpr int bar_cells = 24;

// If standard error is closed, there is nowhere left to report that.
void write_to_stderr(std::string_view text) {
  (void)std::fwrite(text.data(), 1, text.size(), stderr);
  (void)std::fflush(stderr);
}

std::size_t terminal_columns() {
  winsize size{};
  const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : 80;
}

double clamped(double fraction) { return std::isfinite(fraction) ? std::clamp(fraction, 0.0, 1.0) : 0.0; }

}  // namespace

std::string printable_line(std::string_view text) {
  std::string line = valid_utf8(text);
  std::ranges::replace_if(
      line, [](unsigned char c) { return c < 0x20 || c == 0x7f; }, ' ');
  return line;
}

void write_message(std::string_view text) { write_to_stderr("footprint: " + printable_line(text) + "\n"); }

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

ProgressStyle progress_style(bool quiet) {
  if (quiet) return ProgressStyle::quiet;
  const char* terminal = std::getenv("TERM");
  const bool redraws = terminal != nullptr && std::string_view(terminal) != "dumb" && isatty(STDERR_FILENO) == 1;
  return redraws ? ProgressStyle::bar : ProgressStyle::lines;
}

ProgressDisplay::ProgressDisplay(ProgressStyle style)
    : ProgressDisplay(style, write_to_stderr, std::chrono::steady_clock::now, terminal_columns()) {}

ProgressDisplay::ProgressDisplay(ProgressStyle style, Sink sink, Clock clock, std::size_t columns)
    : style_(style),
      sink_(std::move(sink)),
      clock_(std::move(clock)),
      columns_(columns),
      last_shown_(clock_()),
      stage_started_(last_shown_) {}

ProgressDisplay::~ProgressDisplay() {
  // Work that failed has not finished its stage: clear the bar, and write no line about an end.
  const bool failed = std::uncaught_exceptions() > 0;
  if (failed && style_ == ProgressStyle::lines) return;
  finish();
}

void ProgressDisplay::report(std::string_view what, double fraction) {
  throw_if_interrupted();
  if (style_ == ProgressStyle::quiet) return;
  if (stage_ != what) rate_since_ = {clock_(), clamped(fraction)};
  if (style_ == ProgressStyle::bar) draw_bar(what, clamped(fraction));
  if (style_ == ProgressStyle::lines) write_lines(what, clamped(fraction));
}

void ProgressDisplay::finish() {
  if (!stage_.empty() && style_ == ProgressStyle::bar) sink_(clear_line);
  if (!stage_.empty() && style_ == ProgressStyle::lines) sink_(fmt::format("100 %  {}: done\n", stage_));
  stage_.clear();
}

Progress ProgressDisplay::callback() {
  return [this](std::string_view what, double fraction) { report(what, fraction); };
}

void ProgressDisplay::draw_bar(std::string_view what, double fraction) {
  const auto now = clock_();
  const bool first = stage_.empty();
  stage_ = what;
  if (!first && now - last_shown_ < 100ms) return;
  last_shown_ = now;
  const auto full = static_cast<int>(std::floor(fraction * bar_cells));
  std::string line = fmt::format("[{:#<{}}{:->{}}] {:3.0f} %  {}{}", "", full, "", bar_cells - full,
                                 std::floor(100.0 * fraction), what, time_left(fraction));
  if (columns_ > 0 && line.size() >= columns_) line.resize(columns_ - 1);  // a full line would wrap and not clear
  sink_(fmt::format("{}{}", clear_line, line));
}

void ProgressDisplay::write_lines(std::string_view what, double fraction) {
  const auto now = clock_();
  if (stage_ != what) {
    // Short stages get no line, because they would hide the others.
    if (!stage_.empty() && now - stage_started_ >= 500ms) {
      sink_(fmt::format("{:3.0f} %  {}: done\n", std::floor(100.0 * stage_fraction_), stage_));
      last_shown_ = now;
    }
    stage_started_ = now;
    stage_ = what;
  } else if (now - last_shown_ >= 2s) {
    sink_(fmt::format("{:3.0f} %  {}{}\n", std::floor(100.0 * fraction), what, time_left(fraction)));
    last_shown_ = now;
  }
  stage_fraction_ = fraction;
}

// Extrapolates the stage's own rate: with that of a faster stage before it, the estimate would count up.
std::string ProgressDisplay::time_left(double fraction) const {
  const double elapsed = std::chrono::duration<double>(clock_() - rate_since_.time).count();
  const double done = fraction - rate_since_.fraction;
  if (elapsed < 1.0 || done < 0.01) return {};
  const double seconds = std::ceil(elapsed * (1.0 - fraction) / done);
  if (seconds < 60.0) return fmt::format(", {:.0f} s left", seconds);
  const double minutes = std::floor(seconds / 60.0);
  if (minutes < 60.0) return fmt::format(", {:.0f} min {:02.0f} s left", minutes, seconds - 60.0 * minutes);
  return fmt::format(", {:.0f} h {:02.0f} min left", std::floor(minutes / 60.0), std::fmod(minutes, 60.0));
}

}  // namespace footprint

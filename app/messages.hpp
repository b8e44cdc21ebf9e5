// What a person sees on the terminal: text, messages and progress.
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <string_view>

#include "renderer/core/progress.hpp"
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

/// How progress is shown.
enum class ProgressStyle {
  quiet,  ///< not at all
  lines,  ///< a line at most every two seconds and one at the end of each stage that took half a second
  bar,    ///< one line, redrawn at most ten times per second, cleared at the end
};

/// The style for standard error: a bar if it is a terminal that can redraw a line, else lines.
[[nodiscard]] ProgressStyle progress_style(bool quiet);

/// Shows the progress of one job with an estimate of the time left, and reacts to Ctrl-C at every report. For one
/// thread at a time.
class ProgressDisplay {
 public:
  using Clock = std::function<std::chrono::steady_clock::time_point()>;
  using Sink = std::function<void(std::string_view text)>;

  /// Shows on standard error.
  explicit ProgressDisplay(ProgressStyle style);
  /// Shows on `sink` by the time of `clock`; a bar's line has at most `columns` characters.
  ProgressDisplay(ProgressStyle style, Sink sink, Clock clock, std::size_t columns);
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;
  ~ProgressDisplay();

  /// Reports the current step and the fraction of the whole job that is done, 0 to 1. Errors (interrupted).
  void report(std::string_view what, double fraction);

  /// Ends the display: clears the bar, or writes the last stage's line. Later reports start a new one.
  void finish();

  /// This display as the callback that long work takes; the display must outlive it.
  [[nodiscard]] Progress callback();

 private:
  void draw_bar(std::string_view what, double fraction);
  void write_lines(std::string_view what, double fraction);
  [[nodiscard]] std::string time_left(double fraction) const;

  ProgressStyle style_;
  Sink sink_;
  Clock clock_;
  std::size_t columns_;
  std::chrono::steady_clock::time_point last_shown_, stage_started_;
  struct {
    std::chrono::steady_clock::time_point time;
    double fraction = 0;
  } rate_since_;               // when the stage began
  std::string stage_;          // of the last report; empty before the first
  double stage_fraction_ = 0;  // of the last report
};

}  // namespace footprint

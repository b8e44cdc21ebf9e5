// How frames are accumulated over time (docs/explanation/temporal.md).
#pragma once

#include <array>

#include "renderer/core/names.hpp"

namespace footprint {

/// The limits of a history, from the 3 x 3 pixels of the new frame.
enum class HistoryClamp {
  off,
  box,      ///< their range
  variance  ///< their range, and one deviation from their mean
};

inline constexpr auto history_clamps = std::to_array<Word<HistoryClamp>>(
    {{HistoryClamp::off, "off"}, {HistoryClamp::box, "box"}, {HistoryClamp::variance, "variance"}});
constexpr const auto& words_of(HistoryClamp /*clamp*/) { return history_clamps; }

struct HistorySettings {
  int frames = 0;      ///< of the first view, one after the other, until its image is shown; 0: without a history
  double alpha = 0.1;  ///< share of the newest frame, above 0 and at most 1
  HistoryClamp clamp = HistoryClamp::off;
  bool jitter = true;  ///< whether samples move within the pixels from frame to frame

  friend bool operator==(const HistorySettings&, const HistorySettings&) = default;
};

}  // namespace footprint

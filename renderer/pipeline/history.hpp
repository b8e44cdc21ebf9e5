// Temporal accumulation: frames blended into a history that follows the surface (docs/explanation/temporal.md).
#pragma once

#include <array>
#include <optional>

#include "renderer/pipeline/frame.hpp"
#include "renderer/pipeline/history_settings.hpp"

namespace footprint {

/// The offset of frame `frame` from the pixels' centres, pixels: a point of a scrambled Sobol sequence.
[[nodiscard]] glm::dvec2 jitter_of(std::uint64_t seed, std::uint32_t frame);

/// The history of one method's frames.
class History {
 public:
  /// size: of the frames, pixels.
  History(const glm::ivec2& size, const HistorySettings& settings);

  /// Forgets all frames.
  void restart() { last_.reset(); }

  /// Draws the next frame and blends it in.
  /// frames: of the history's size. Throws Error (usage): they are drawn in tiles.
  /// view: its number decides what the frame draws at random, and its jitter.
  void add(const FrameRenderer& frames, const View& view);

  /// RGBA as FrameRenderer::render. Only after a frame.
  [[nodiscard]] Image image() const;

 private:
  [[nodiscard]] const gl::RenderTarget& newest() const { return targets_[newest_]; }

  HistorySettings settings_;
  gl::Program blend_;
  std::array<gl::RenderTarget, 2> targets_;  // the last history and the one before, each with its frame's depth
  std::size_t newest_ = 0;
  gl::ScreenTriangle triangle_;
  std::optional<View> last_;  // that was blended in
};

}  // namespace footprint

// What frame times are taken on: every method over Khronos' ClearCoatTest at 512 x 512, on one context.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "bench/bare_frame.hpp"
#include "experiments/runner/stage.hpp"

namespace footprint::bench {

inline constexpr glm::ivec2 frame_pixels{512, 512};
inline constexpr int reference_spp = 64;
inline constexpr std::uint64_t reference_seed = 1;

/// The model; none where its package (assimp-testmodels) is not installed, after a line on stderr that says so.
[[nodiscard]] std::optional<Scene> load_bench_scene();

/// What footprint_bench draws with: all methods of the registry at 512 x 512.
[[nodiscard]] StageSettings bench_settings();

/// The scene, its methods, its reference and the bare yardstick, ready to draw at the camera's own distance.
class BenchScene {
 public:
  /// Errors: those of Stage.
  explicit BenchScene(Scene scene);

  [[nodiscard]] const Stage& stage() const { return stage_; }
  [[nodiscard]] const View& view() const { return view_; }

  void draw_bare() const { bare_.draw(view_); }
  void draw(const StagedMethod& method) const { method.frames().draw(view_); }
  /// The reference at 64 samples a pixel, not read back.
  void draw_reference() const;
  /// The staged method of a name. Errors: std::logic_error where the registry has none.
  [[nodiscard]] const StagedMethod& method(std::string_view name) const;

 private:
  Stage stage_;
  View view_;
  BareFrame bare_;
};

}  // namespace footprint::bench

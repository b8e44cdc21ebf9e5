// The images that a run shows of its methods: single frames, or histories of them.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "experiments/studies/stage.hpp"
#include "renderer/pipeline/history.hpp"

namespace footprint {

/// Draws a stage's methods, each as the settings of its history say.
class MethodFrames {
 public:
  MethodFrames(Stage& stage, const RunSettings& settings);

  /// The image of a method in view `index` of a run, which the stage is at. On a path its history has all frames before
  /// it, which are drawn again unless the last call for this method was the view before.
  [[nodiscard]] Image render(std::size_t method, const std::vector<RunView>& views, std::size_t index,
                             const View& view);

 private:
  // The history of a method, and the number of views on the path that it contains.
  struct Sequence {
    std::optional<History> history;
    std::size_t views = 0;
  };

  void add_view(Sequence& sequence, const StagedMethod& method, View view);

  Stage& stage_;
  bool is_path_;
  std::vector<Sequence> sequences_;  // of each method
};

/// A frame of a method in a view, or what a history of that view alone shows.
[[nodiscard]] Image image_of(const StagedMethod& method, const View& view);

}  // namespace footprint

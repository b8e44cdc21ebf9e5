// On a path, a history continues from view to view; elsewhere each view has one of its own.
#include "experiments/studies/method_frames.hpp"

namespace footprint {
namespace {

// The view before the path begins, and its first frame, which all have the same camera.
void add_still_frames(History& history, const StagedMethod& method, View view) {
  for (int i = 0; i < method.history().frames; ++i) {
    view.frame = static_cast<std::uint32_t>(i);
    history.add(method.frames(), view);
  }
}

void restart(std::optional<History>& history, const StagedMethod& method, const View& view) {
  if (!history) history.emplace(view.size, method.history());
  history->restart();
  add_still_frames(*history, method, view);
}

}  // namespace

Image image_of(const StagedMethod& method, const View& view) {
  if (method.history().frames == 0) return method.frames().render(view);
  std::optional<History> history;
  restart(history, method, view);
  return history->image();
}

MethodFrames::MethodFrames(Stage& stage, const RunSettings& settings)
    : stage_(stage), is_path_(settings.view.zoom.frames > 0), sequences_(stage.methods().size()) {}

void MethodFrames::add_view(Sequence& sequence, const StagedMethod& method, View view) {
  if (sequence.views++ == 0) return restart(sequence.history, method, view);
  view.frame += static_cast<std::uint32_t>(method.history().frames) - 1;
  sequence.history->add(method.frames(), view);
}

Image MethodFrames::render(std::size_t method, const std::vector<RunView>& views, std::size_t index, const View& view) {
  const StagedMethod& staged = stage_.methods()[method];
  if (!is_path_ || staged.history().frames == 0) return image_of(staged, view);
  Sequence& sequence = sequences_[method];
  if (sequence.views > index) sequence.views = 0;
  const bool goes_back = sequence.views < index;
  while (sequence.views < index) add_view(sequence, staged, stage_.move_to(views[sequence.views]));
  add_view(sequence, staged, goes_back ? stage_.move_to(views[index]) : view);
  return sequence.history->image();
}

}  // namespace footprint

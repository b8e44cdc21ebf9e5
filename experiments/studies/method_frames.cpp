// On a path, a history continues from view to view; elsewhere each view has one of its own.
#include "experiments/studies/method_frames.hpp"

namespace footprint {
namespace {

// The view before the path begins, and its first frame, which all have the same camera.
void add_still_frames(History& history, const StagedMethod& method, View view, const HistorySettings& settings) {
  for (int i = 0; i < settings.frames; ++i) {
    view.frame = static_cast<std::uint32_t>(i);
    history.add(method.frames(), view);
  }
}

}  // namespace

Image image_of(const StagedMethod& method, const View& view, const HistorySettings& settings) {
  if (settings.frames == 0) return method.frames().render(view);
  History history(view.size, settings);
  add_still_frames(history, method, view, settings);
  return history.image();
}

MethodFrames::MethodFrames(Stage& stage, const RunSettings& settings)
    : stage_(stage), settings_(settings.history), is_path_(settings.view.zoom.frames > 0) {
  if (settings_.frames > 0 && is_path_) sequences_.resize(stage.methods().size());
}

void MethodFrames::add_view(Sequence& sequence, const StagedMethod& method, View view) {
  if (!sequence.history) sequence.history = std::make_unique<History>(view.size, settings_);
  if (sequence.views++ == 0) {
    sequence.history->restart();
    return add_still_frames(*sequence.history, method, view, settings_);
  }
  view.frame += static_cast<std::uint32_t>(settings_.frames) - 1;
  sequence.history->add(method.frames(), view);
}

Image MethodFrames::render(std::size_t method, const std::vector<RunView>& views, std::size_t index, const View& view) {
  const StagedMethod& staged = stage_.methods()[method];
  if (sequences_.empty()) return image_of(staged, view, settings_);
  Sequence& sequence = sequences_[method];
  if (sequence.views > index) sequence.views = 0;
  const bool goes_back = sequence.views < index;
  while (sequence.views < index) add_view(sequence, staged, stage_.move_to(views[sequence.views]));
  add_view(sequence, staged, goes_back ? stage_.move_to(views[index]) : view);
  return sequence.history->image();
}

}  // namespace footprint

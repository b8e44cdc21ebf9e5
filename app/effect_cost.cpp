// Frames of the whole scene and of each scene without one effect, timed in turn.
#include "app/effect_cost.hpp"

#include <algorithm>
#include <functional>
#include <memory>
#include <utility>

#include "experiments/studies/frame_times.hpp"
#include "renderer/pipeline/timing.hpp"

namespace footprint {
namespace {

EffectCost cost_of(Effect effect, const std::vector<double>& with, const std::vector<double>& without) {
  std::vector<double> added(with.size());
  std::ranges::transform(with, without, added.begin(), std::minus{});
  return {.effect = effect,
          .with_ms = quantile(with, 0.5),
          .without_ms = quantile(without, 0.5),
          .added_ms = quantile(added, 0.5)};
}

// Whether more rounds would change little: the interval of the ratio to the frame with all effects is narrow.
bool are_known(const RepeatedTimes& times) {
  return std::ranges::all_of(times, [&](const auto& own) { return is_ratio_known(own, times.front()); });
}

// The scene drawn with some of its effects. Pinned: the method keeps the scene's address.
struct Variant {
  std::unique_ptr<GpuScene> scene;
  StagedMethod method;
};

Variant make_variant(const Stage& stage, const RunSettings& run, const EffectSet& effects, const glm::ivec2& size,
                     const Progress& progress) {
  const gl::ContextInfo& context = stage.context().info();
  auto scene = std::make_unique<GpuScene>(context, stage.scene(), effects, progress, nullptr, &stage.gpu_scene());
  StagedMethod method(context, *scene, stage.scene(), effects, run.methods.front(),
                      footprint_filter_of(run, stage.scene()), size, run, no_progress);
  return {std::move(scene), std::move(method)};
}

}  // namespace

std::vector<EffectCost> measure_effect_costs(const Stage& stage, const RunSettings& run, const Progress& progress) {
  const View view = stage.view(1.0);
  std::vector<Effect> measured;
  std::vector<Variant> variants;
  ProgressParts parts([&](std::string_view what, double done) { progress(what, 0.5 * done); },
                      static_cast<double>(stage.effects().count()));
  for (const Effect effect : all_effects()) {
    if (!has(stage.effects(), effect)) continue;
    measured.push_back(effect);
    const EffectSet kept = EffectSet(stage.effects()).reset(static_cast<std::size_t>(effect));
    const Progress preparing = parts.next(1, "preparing: ");
    preparing(effect_name(effect), 0.0);
    variants.push_back(make_variant(stage, run, kept, view.size, preparing));
  }
  std::vector<DrawFrame> frames{[&] { stage.methods().front().frames().draw(view); }};
  for (const Variant& variant : variants) frames.emplace_back([&] { variant.method.frames().draw(view); });
  const auto times = interleaved_times(
      stage.context().info(), frames, run.timing.repeats,
      [&](std::string_view what, double done) { progress(what, 0.5 + 0.5 * done); }, are_known);
  stage.context().check("timing the effects");

  std::vector<EffectCost> costs;
  for (std::size_t i = 0; i < measured.size(); ++i) costs.push_back(cost_of(measured[i], times[0], times[i + 1]));
  return costs;
}

}  // namespace footprint

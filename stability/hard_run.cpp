// Cases on the outside, methods on the inside: what a case takes to the GPU serves all of them.
#include "stability/hard_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "methods/registry.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/file_names.hpp"
#include "renderer/image/false_color.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/image/metrics.hpp"
#include "renderer/pipeline/frame.hpp"
#include "stability/ndf_bench.hpp"

namespace footprint::stability {
namespace {

namespace fs = std::filesystem;

constexpr int rings = 96;  // of directions over the hemisphere
constexpr int sweep_rings = 48;
constexpr int disc = 96;  // side of the pictures of distributions
constexpr glm::ivec2 frame{24, 24};

// Numbers that are not finite, or below 0. Before any clamp.
double bad_numbers(std::span<const float> values) {
  return static_cast<double>(
      std::ranges::count_if(values, [](float value) { return !std::isfinite(value) || value < 0.0F; }));
}

double largest_difference(std::span<const float> values, std::span<const double> truth) {
  double most = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double difference = std::abs(values[i] - truth[i]);
    if (!(difference <= most)) most = difference;
    if (std::isnan(difference)) return difference;
  }
  return most / *std::ranges::max_element(truth);
}

double integral(const HemisphereGrid& grid, auto value_at) {
  double sum = 0.0;
  for (std::size_t i = 0; i < grid.solid_angles.size(); ++i) sum += value_at(i) * grid.solid_angles[i];
  return sum;
}

double energy_error(const Directions& directions, std::span<const float> values) {
  const double own = integral(directions.grid, [&](std::size_t i) { return values[i]; });
  const double truth = integral(directions.grid, [&](std::size_t i) { return directions.truth[i]; });
  return std::abs(own / truth - 1.0);
}

// What changes from one distribution to the next, of all of the latter.
template <class Values>
double step_between(const HemisphereGrid& grid, const Values& before, const Values& after) {
  return integral(grid, [&](std::size_t i) { return std::abs(static_cast<double>(after[i]) - before[i]); }) /
         integral(grid, [&](std::size_t i) { return static_cast<double>(after[i]); });
}

class Run {
 public:
  Run(const HardSettings& settings, const fs::path& folder)
      : settings_(settings), folder_(folder), context_(settings.context) {
    methods_ = settings.methods;
    if (!methods_.empty()) return;
    for (const Method* const method : all_methods()) methods_.push_back(parse_methods(method->info().name).front());
  }

  void run(const NdfCase& hard, const Progress& progress) {
    context_.make_current();
    NdfBench bench(context_, hard.material(), hard.footprint);
    const Directions directions = hard.narrow ? bench.about_the_facets() : bench.over_the_hemisphere(rings);
    const bool every_storage = settings_.wide || hard.group == "lobes";
    for (const MethodSpec& spec : every_storage ? with_storages() : methods_) {
      progress(fmt::format("{}, {}", hard.name, spec.text), 0.0);
      if (hard.texels_only && !find_method(spec.name).info().resolves_texels) continue;
      const std::vector<float> values = bench.densities(spec, directions);
      const std::size_t first = rows_.size();
      const auto add = [&](const char* figure, double value, double bound) {
        rows_.push_back({spec.text, hard.name, hard.group, hard.what, figure, value, bound});
        judge(rows_.back(), known_limits());
      };
      add("finite", bad_numbers(values), 0.0);
      if (!hard.narrow) add("energy", energy_error(directions, values), hard.energy);
      if (hard.limit) add("limit", largest_difference(values, directions.truth), *hard.limit);
      if (!hard.narrow) show(bench, spec, hard.name, std::span(rows_).subspan(first));
    }
  }

  void run(const PictureCase& hard, const Progress& progress) {
    context_.make_current();
    const Scene scene = hard.scene();
    const EffectSet effects = effects_on(derive_effects(scene));
    GpuScene gpu(context_.info(), scene, effects);
    std::optional<Image> direct;
    if (hard.equals_direct) direct = draw(parse_methods("direct").front(), scene, effects, gpu);
    for (const MethodSpec& spec : settings_.wide ? with_storages() : methods_) {
      progress(fmt::format("{}, {}", hard.name, spec.text), 0.0);
      const Image picture = draw(spec, scene, effects, gpu);
      const auto add = [&](const char* figure, double value, double bound) {
        HardRow& row = rows_.emplace_back(HardRow{spec.text, hard.name, "pictures", hard.what, figure, value, bound});
        judge(row, known_limits());
        if (row.verdict == Verdict::held) return;
        row.picture = fmt::format("images/{}_{}.exr", hard.name, file_stem(spec.text));
        write_exr(folder_ / row.picture, picture);
      };
      add("finite", bad_numbers(picture.texels), 0.0);
      if (direct) add("direct", compare_images(picture, *direct, 1.0F).value().relative_rmse, 1e-3);
    }
  }

  void run(const Sweep& sweep, const Progress& progress) {
    context_.make_current();
    std::vector<std::optional<std::vector<float>>> before(methods_.size());
    std::vector<double> largest(methods_.size(), 0.0);
    std::vector<double> truth;
    double true_step = 0.0;
    for (int i = 0; i <= sweep.steps; ++i) {
      NdfBench bench(context_, sweep.material(std::lerp(sweep.from, sweep.to, static_cast<double>(i) / sweep.steps)),
                     {});
      const Directions directions = bench.over_the_hemisphere(sweep_rings);
      if (i > 0) true_step = std::max(true_step, step_between(directions.grid, truth, directions.truth));
      truth = directions.truth;
      for (std::size_t m = 0; m < methods_.size(); ++m) {
        progress(fmt::format("{}, {}", sweep.name, methods_[m].text), 0.0);
        std::vector<float> values = bench.densities(methods_[m], directions);
        if (before[m]) {
          const double step = step_between(directions.grid, *before[m], values);
          if (!(step <= largest[m])) largest[m] = step;
        }
        before[m] = std::move(values);
      }
    }
    for (std::size_t m = 0; m < methods_.size(); ++m) {
      HardRow& row = rows_.emplace_back(HardRow{methods_[m].text, sweep.name, "steps", sweep.what, "step", largest[m],
                                                std::max(sweep.most, 4.0 * true_step)});
      judge(row, known_limits());
    }
  }

  // The same numbers by another way to OpenGL, where the machine has it and neither is a GPU.
  void compare_backends(const NdfCase& hard, const Progress& progress) {
    if (!context_.info().software || context_.info().backend == gl::Backend::osmesa) return;
    std::optional<gl::Context> other;
    try {
      other.emplace(gl::ContextRequest{gl::Backend::osmesa, 0});
    } catch (const Error&) {
      return;  // `footprint info` says why
    }
    for (const MethodSpec& spec : methods_) {
      progress(fmt::format("backends, {}", spec.text), 0.0);
      std::vector<std::vector<float>> values;
      for (const gl::Context* const context : {&context_, &*other}) {
        context->make_current();
        NdfBench bench(*context, hard.material(), hard.footprint);
        values.push_back(bench.densities(spec, bench.over_the_hemisphere(sweep_rings)));
      }
      double different = 0.0;
      for (std::size_t i = 0; i < values[0].size(); ++i) different += values[0][i] == values[1][i] ? 0.0 : 1.0;
      HardRow& row = rows_.emplace_back(HardRow{spec.text, hard.name + "_backends", "backends",
                                                "the same numbers by EGL and by OSMesa", "backends", different, 0.0});
      judge(row, known_limits());
    }
    context_.make_current();
  }

  [[nodiscard]] std::vector<HardRow> take_rows() { return std::move(rows_); }

 private:
  // Every method, and again with each storage that is not its default.
  [[nodiscard]] std::vector<MethodSpec> with_storages() const {
    std::vector<MethodSpec> out;
    for (const MethodSpec& spec : methods_) {
      out.push_back(spec);
      if (spec.options.contains("storage")) continue;
      for (const OptionSpec& option : find_method(spec.name).info().options) {
        if (option.name != "storage") continue;
        for (const std::string& choice : option.choices) {
          if (option.default_value == std::variant<double, std::string>(choice)) continue;
          out.push_back(parse_methods(spec.text + ":storage=" + choice).front());
        }
      }
    }
    return out;
  }

  [[nodiscard]] Image draw(const MethodSpec& spec, const Scene& scene, const EffectSet& effects, GpuScene& gpu) {
    const BakedMethod baked = bake(find_method(spec.name), spec, scene, effects, no_progress);
    const GpuMethod method(gpu, baked);
    const FrameRenderer frames(context_.info(), gpu, method, frame, {.footprint = default_footprint_filter});
    Image picture = frames.render({.size = frame, .camera = scene.camera});
    context_.check("drawing " + spec.text);
    return picture;
  }

  // A method's distribution beside the sum, where a figure of it did not hold.
  void show(NdfBench& bench, const MethodSpec& spec, const std::string& name, std::span<HardRow> rows) {
    const bool held = std::ranges::all_of(rows, [](const HardRow& row) { return row.verdict == Verdict::held; });
    if (held) return;
    const Directions directions = bench.over_the_disc(disc);
    const auto scale = static_cast<float>(*std::ranges::max_element(directions.truth));
    const auto shown = [&](const auto& values) {
      Image image(disc, disc, 1);
      std::ranges::transform(values, image.texels.begin(), [](auto value) { return static_cast<float>(value); });
      return false_color(image, scale);
    };
    const Image strip = labelled_strip({shown(directions.truth), shown(bench.densities(spec, directions))},
                                       {"sum over texels", spec.text});
    const std::string file = fmt::format("images/{}_{}.png", name, file_stem(spec.text));
    write_png(folder_ / file, strip);
    for (HardRow& row : rows) {
      if (row.verdict != Verdict::held) row.picture = file;
    }
  }

  HardSettings settings_;
  fs::path folder_;
  gl::Context context_;
  std::vector<MethodSpec> methods_;
  std::vector<HardRow> rows_;
};

}  // namespace

std::vector<HardRow> run_hard_cases(const HardSettings& settings, const fs::path& folder, const Progress& progress) {
  fs::create_directories(folder / "images");
  Run run(settings, folder);
  ProgressParts parts(progress,
                      static_cast<double>(ndf_cases().size() + picture_cases().size() + 7 * sweeps().size() + 2));
  for (const NdfCase& hard : ndf_cases()) run.run(hard, parts.next(1.0, ""));
  for (const PictureCase& hard : picture_cases()) run.run(hard, parts.next(1.0, ""));
  for (const Sweep& sweep : sweeps()) run.run(sweep, parts.next(7.0, ""));
  const auto plain = std::ranges::find(ndf_cases(), "noise_0_5", &NdfCase::name);
  run.compare_backends(*plain, parts.next(2.0, ""));
  return run.take_rows();
}

}  // namespace footprint::stability

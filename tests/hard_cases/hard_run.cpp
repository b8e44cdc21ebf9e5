// The outer loop is over cases and the inner over methods, so each case is uploaded once for all methods.
#include "tests/hard_cases/hard_run.hpp"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>
#include <string>
#include <utility>

#include "methods/registry.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/names.hpp"
#include "renderer/image/false_color.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/image/metrics.hpp"
#include "renderer/ndf/method_ndf.hpp"
#include "renderer/pipeline/frame.hpp"
#include "renderer/pipeline/history.hpp"
#include "tests/hard_cases/coat_sum.hpp"
#include "tests/hard_cases/hard_scenes.hpp"
#include "tests/hard_cases/ndf_bench.hpp"
#include "tests/hard_cases/worst.hpp"

namespace footprint::hard_cases {
namespace {

namespace fs = std::filesystem;

constexpr int rings = 96;  // rings of directions over the hemisphere
constexpr int sweep_rings = 48;
constexpr int disc = 96;  // side of the images of distributions, pixels
constexpr glm::ivec2 frame{picture_edge, picture_edge};

// The number of values that are not finite or below 0, before any clamp.
double bad_numbers(std::span<const float> values) {
  return static_cast<double>(
      std::ranges::count_if(values, [](float value) { return !std::isfinite(value) || value < 0.0F; }));
}

double largest_difference(std::span<const float> values, std::span<const double> exact) {
  double most = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) keep_worst(most, std::abs(values[i] - exact[i]));
  return most / *std::ranges::max_element(exact);
}

double integral(const HemisphereGrid& grid, auto value_at) {
  double sum = 0.0;
  for (std::size_t i = 0; i < grid.solid_angles.size(); ++i) sum += value_at(i) * grid.solid_angles[i];
  return sum;
}

double energy_error(const Directions& directions, std::span<const float> values) {
  const double own = integral(directions.grid, [&](std::size_t i) { return values[i]; });
  const double exact = integral(directions.grid, [&](std::size_t i) { return directions.exact[i]; });
  return std::abs(own / exact - 1.0);
}

// The change from one distribution to the next, as a share of the latter.
template <class Values>
double step_between(const HemisphereGrid& grid, const Values& before, const Values& after) {
  return integral(grid, [&](std::size_t i) { return std::abs(static_cast<double>(after[i]) - before[i]); }) /
         integral(grid, [&](std::size_t i) { return static_cast<double>(after[i]); });
}

// The mean of the first channel over the fully covered pixels.
double surface_mean(const Image& picture) {
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < picture.texel_count(); ++i) {
    if (picture.texels[4 * i + 3] < 1.0F) continue;
    sum += picture.texels[4 * i];
    count += 1.0;
  }
  return sum / count;
}

// A scene on the GPU, drawn in one frame by any method.
class Drawing {
 public:
  Drawing(const gl::Context& context, Scene scene, const FootprintFilter& filter)
      : context_(&context),
        scene_(std::move(scene)),
        effects_(effects_on(derive_effects(scene_))),
        filter_(filter),
        gpu_(context.info(), scene_, effects_) {}

  [[nodiscard]] Image draw(const MethodSpec& spec) {
    return with_frames(spec, [&](const FrameRenderer& frames) { return frames.render(view()); });
  }

  // What a history shows after three frames.
  // turn: of the camera from frame to frame, radians.
  [[nodiscard]] Image draw_history(const MethodSpec& spec, const HistorySettings& settings, float turn) {
    return with_frames(spec, [&](const FrameRenderer& frames) {
      History history(frame, settings);
      for (View next = view(); next.frame < 3; ++next.frame) {
        history.add(frames, next);
        next.camera.world = glm::rotate(next.camera.world, turn, {0.0F, 1.0F, 0.0F});
      }
      return history.image();
    });
  }

 private:
  [[nodiscard]] View view() const { return {.size = frame, .camera = scene_.camera}; }

  [[nodiscard]] Image with_frames(const MethodSpec& spec, auto draw) {
    const BakedMethod baked = bake(find_method(spec), spec, scene_, effects_, no_progress);
    const GpuMethod method(gpu_, baked);
    const FrameRenderer frames(context_->info(), gpu_, method, frame, {.footprint = filter_});
    Image picture = draw(frames);
    context_->check("drawing " + spec.text);
    return picture;
  }

  const gl::Context* context_;
  Scene scene_;
  EffectSet effects_;
  FootprintFilter filter_;
  GpuScene gpu_;
};

// The expected image under a coat: the coat's formula over the method's own image without the coat.
class CoatedPicture {
 public:
  CoatedPicture(const gl::Context& context, const PictureCase& hard) : check_(*hard.coat) {
    Scene scene = hard.scene();
    sum_ = coat_sum(scene, frame, check_.points);
    for (Material& material : scene.materials) material.coat.reset();
    bare_.emplace(context, std::move(scene), hard.filter);
  }

  /// add(figure, value, bound)
  void judge(const MethodSpec& spec, const Image& picture, auto add) {
    const CoatError error = coat_error(sum_, bare_->draw(spec), picture);
    if (check_.points == 1) {
      add("coat", error.each, check_.most);
    } else {
      add("energy", error.mean, check_.most);
    }
    if (check_.steps) add("step", error.step, 4.0 * error.true_step);
  }

 private:
  CoatCheck check_;
  std::vector<CoatedPixel> sum_;
  std::optional<Drawing> bare_;
};

// Sets an environment variable while a library reads it.
class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) {
    if (const char* const before = std::getenv(name)) before_ = before;
    ::setenv(name, value, 1);
  }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;
  ~Variable() {
    if (before_) {
      ::setenv(name_, before_->c_str(), 1);
    } else {
      ::unsetenv(name_);
    }
  }

 private:
  const char* name_;
  std::optional<std::string> before_;
};

class Run {
 public:
  Run(const HardSettings& settings, RunFolder folder)
      : settings_(settings), folder_(std::move(folder)), context_(settings.context) {
    methods_ = settings.methods;
    if (!methods_.empty()) return;
    for (const Method* const method : all_methods()) methods_.push_back(parse_methods(method->info.name).front());
  }

  void run(const NdfCase& hard, const Progress& progress) {
    context_.make_current();
    NdfBench bench(context_, hard.material(), hard.footprint);
    const Directions directions = hard.narrow ? bench.about_the_facets() : bench.over_the_hemisphere(rings);
    const bool every_storage = settings_.wide || hard.group == "lobes";
    for (const MethodSpec& spec : every_storage ? with_storages() : methods_) {
      progress(fmt::format("{}, {}", hard.name, spec.text), 0.0);
      if (hard.texels_only && !find_method(spec).info.resolves_texels) continue;
      if (hard.asks && !has(find_method(spec).info.honours, *hard.asks)) continue;
      const std::vector<float> values = bench.densities(spec, directions);
      const std::size_t first = rows_.size();
      const auto add = [&](const char* figure, double value, double bound) {
        judged({spec.text, hard.name, hard.group, hard.description, figure, value, bound});
      };
      add("finite", bad_numbers(values), 0.0);
      if (!hard.narrow) add("energy", energy_error(directions, values), hard.energy);
      if (hard.limit) add("limit", largest_difference(values, directions.exact), *hard.limit);
      if (!hard.narrow) show(bench, spec, hard.name, std::span(rows_).subspan(first));
    }
  }

  void run(const PictureCase& hard, const Progress& progress) {
    if (hard.wide && !settings_.wide) return;
    context_.make_current();
    Drawing drawing(context_, hard.scene(), hard.filter);
    std::optional<Drawing> twin;
    if (hard.twin) twin.emplace(context_, hard.twin(), hard.filter);
    std::optional<Image> direct;
    if (hard.equals_direct) direct = drawing.draw(parse_methods("direct").front());
    std::optional<CoatedPicture> coated;
    if (hard.coat) coated.emplace(context_, hard);
    for (const MethodSpec& spec : settings_.wide ? with_storages() : methods_) {
      progress(fmt::format("{}, {}", hard.name, spec.text), 0.0);
      const Image picture = drawing.draw(spec);
      const auto add = [&](const char* figure, double value, double bound) {
        HardRow& row = judged({spec.text, hard.name, hard.group, hard.description, figure, value, bound});
        if (row.verdict == Verdict::passed) return;
        row.picture = fmt::format("images/{}_{}.exr", hard.name, file_stem(spec.text));
        folder_.attempt(row.picture, [&] { write_exr(folder_ / row.picture, picture); });
      };
      add("finite", bad_numbers(picture.texels), 0.0);
      if (direct) add("direct", compare_images(picture, *direct, 1.0F).value().relative_rmse, 1e-3);
      if (twin) add("twin", compare_images(twin->draw(spec), picture, 1.0F).value().relative_rmse, 1e-3);
      if (hard.mean) add("mean", std::abs(surface_mean(picture) / *hard.mean - 1.0), 0.05);
      if (coated) coated->judge(spec, picture, add);
      if (!hard.history) continue;
      const Image still = drawing.draw_history(spec, {.clamp = *hard.history, .jitter = false}, 0.0F);
      add("history", compare_images(still, picture, 1.0F).value().relative_rmse, 1e-5);
      add("moving", bad_numbers(drawing.draw_history(spec, {.clamp = *hard.history}, 0.01F).texels), 0.0);
    }
  }

  void run(const Sweep& sweep, const Progress& progress) {
    context_.make_current();
    std::vector<MethodSpec> methods = methods_;
    if (!sweep.also.empty()) {
      const MethodSpec also = parse_methods(sweep.also).front();
      const std::string& name = find_method(also).info.name;
      if (std::ranges::any_of(methods, [&](const MethodSpec& spec) { return spec.text == name; }))
        methods.push_back(also);
    }
    std::vector<std::optional<std::vector<float>>> before(methods.size());
    std::vector<double> largest(methods.size(), 0.0), most_lost(methods.size(), 0.0);
    std::vector<double> exact;
    double true_step = 0.0;
    for (int i = 0; i <= sweep.steps; ++i) {
      NdfBench bench(context_, sweep.material(std::lerp(sweep.from, sweep.to, static_cast<double>(i) / sweep.steps)),
                     {});
      const Directions directions = bench.over_the_hemisphere(sweep_rings);
      if (i > 0) true_step = std::max(true_step, step_between(directions.grid, exact, directions.exact));
      exact = directions.exact;
      for (std::size_t m = 0; m < methods.size(); ++m) {
        progress(fmt::format("{}, {}", sweep.name, methods[m].text), 0.0);
        std::vector<float> values = bench.densities(methods[m], directions);
        keep_worst(most_lost[m], energy_error(directions, values));
        if (before[m]) keep_worst(largest[m], step_between(directions.grid, *before[m], values));
        before[m] = std::move(values);
      }
    }
    for (std::size_t m = 0; m < methods.size(); ++m) {
      const auto add = [&](const char* figure, double value, double bound) {
        judged({methods[m].text, sweep.name, "steps", sweep.description, figure, value, bound});
      };
      add("step", largest[m], std::max(sweep.most, 4.0 * true_step));
      if (sweep.energy) add("energy", most_lost[m], *sweep.energy);
    }
  }

  // Bakes of a material by one thread and by two.
  void compare_threads(const NdfCase& hard, const Progress& progress) {
    const Scene scene = scene_of_facets(hard.material());
    const EffectSet effects = effects_on(derive_effects(scene));
    for (const MethodSpec& spec : with_storages()) {
      progress(fmt::format("threads, {}", spec.text), 0.0);
      std::vector<BakedMethod> baked;
      for (const std::size_t threads : {1U, 2U}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        baked.push_back(bake(find_method(spec), spec, scene, effects, no_progress));
      }
      double different = 0.0;
      for (std::size_t i = 0; i < baked[0].materials.size(); ++i)
        different += baked[0].materials[i] == baked[1].materials[i] ? 0.0 : 1.0;
      judged(
          {spec.text, hard.name + "_threads", "threads", "bakes by one thread and by two", "threads", different, 0.0});
    }
  }

  // Compares the numbers by EGL with all threads and by OSMesa with one, if the machine has it and neither uses a GPU.
  void compare_backends(const NdfCase& hard, const Progress& progress) {
    if (!context_.info().software || context_.info().backend == gl::Backend::osmesa) return;
    std::optional<gl::Context> other;
    try {
      const Variable threads("LP_NUM_THREADS", "1");  // read once, as llvmpipe starts
      other.emplace(gl::ContextRequest{gl::Backend::osmesa, 0});
    } catch (const Error&) {
      return;  // `footprint info` gives the reason
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
      judged({spec.text, hard.name + "_backends", "backends", "the same numbers by EGL and, by one thread, by OSMesa",
              "backends", different, 0.0});
    }
    context_.make_current();
  }

  [[nodiscard]] std::vector<HardRow> take_rows() { return std::move(rows_); }

 private:
  HardRow& judged(HardRow row) {
    judge(row, known_limits(), context_.info().software);
    return rows_.emplace_back(std::move(row));
  }

  // Every method, by default and with each other storage.
  [[nodiscard]] std::vector<MethodSpec> with_storages() const {
    std::vector<MethodSpec> out;
    for (const MethodSpec& spec : methods_) {
      out.push_back(spec);
      if (spec.options.contains("storage")) continue;
      for (const OptionSpec& option : find_method(spec).info.options) {
        if (option.name != "storage") continue;
        for (const std::string& choice : option.choices) {
          if (option.default_value == std::variant<double, std::string>(choice)) continue;
          MethodSpec& other = out.emplace_back(spec);
          other.text += ":storage=" + choice;
          other.options["storage"] = choice;
        }
      }
    }
    return out;
  }

  // Writes an image of a method's distribution next to the sum if one of its figures did not pass.
  void show(NdfBench& bench, const MethodSpec& spec, const std::string& name, std::span<HardRow> rows) {
    const bool passed = std::ranges::all_of(rows, [](const HardRow& row) { return row.verdict == Verdict::passed; });
    if (passed) return;
    const Directions directions = bench.over_the_disc(disc);
    const auto scale = static_cast<float>(*std::ranges::max_element(directions.exact));
    const auto shown = [&](const auto& values) {
      Image image(disc, disc, 1);
      std::ranges::transform(values, image.texels.begin(), [](auto value) { return static_cast<float>(value); });
      return false_color(image, scale);
    };
    const std::string file = fmt::format("images/{}_{}.png", name, file_stem(spec.text));
    const std::vector<Image> densities{shown(directions.exact), shown(bench.densities(spec, directions))};
    folder_.attempt(file, [&] {
      write_png(folder_ / file, labelled_strip(densities, {"sum over texels", spec.text}));
    });
    for (HardRow& row : rows) {
      if (row.verdict != Verdict::passed) row.picture = file;
    }
  }

  HardSettings settings_;
  RunFolder folder_;
  gl::Context context_;
  std::vector<MethodSpec> methods_;
  std::vector<HardRow> rows_;
};

}  // namespace

std::vector<HardRow> run_hard_cases(const HardSettings& settings, const RunFolder& folder, const Progress& progress) {
  fs::create_directories(folder / "images");
  Run run(settings, folder);
  ProgressParts parts(progress, static_cast<double>(ndf_cases().size() + picture_cases().size() + coat_cases().size() +
                                                    7 * sweeps().size() + 3));
  for (const NdfCase& hard : ndf_cases()) run.run(hard, parts.next(1.0, ""));
  for (const std::span<const PictureCase> pictures : {picture_cases(), coat_cases()}) {
    for (const PictureCase& hard : pictures) run.run(hard, parts.next(1.0, ""));
  }
  for (const Sweep& sweep : sweeps()) run.run(sweep, parts.next(7.0, ""));
  const auto plain = std::ranges::find(ndf_cases(), "noise_0_5", &NdfCase::name);
  run.compare_threads(*plain, parts.next(1.0, ""));
  run.compare_backends(*plain, parts.next(2.0, ""));
  return run.take_rows();
}

}  // namespace footprint::hard_cases

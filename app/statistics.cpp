// `footprint statistics`: what a normal map is like, by the size of a footprint.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/commands.hpp"
#include "app/messages.hpp"
#include "app/run_options.hpp"
#include "renderer/bake/map_statistics.hpp"
#include "renderer/core/error.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/scene/assembly/surface_maps.hpp"

namespace footprint {
namespace {

using Json = nlohmann::ordered_json;

constexpr int correlated_level = 3;  // blocks of 8 x 8 texels
constexpr const char* statistics_examples =
    "Per level, over all blocks of 2^level x 2^level texels: the mean length of the mean normal, the slope variance "
    "per\n"
    "axis, its anisotropy (0 round, 1 a line), and tails: fourth moments over a Gaussian's. With --alpha or "
    "--roughness\n"
    "also the errors of simple GGX lobes, relative to the mean: one texel's, one about the mean normal, one that the\n"
    "variance widens, and one that the covariance widens.\n"
    "\n"
    "Examples:\n"
    "  footprint statistics normals.png\n"
    "  footprint statistics normals.png --gloss gloss.png --json\n"
    "  footprint statistics normals.png --alpha 0.2";

struct StatisticsArguments {
  MapOptions how;
  std::string map, gloss, roughness;
  std::optional<double> alpha;
  bool json = false;
};

struct Statistics {
  int width = 0, height = 0;
  double unit_share = 0;
  std::optional<double> correlation;  // with the gloss map
  std::optional<double> mean_alpha;
  std::vector<LevelStatistics> levels;
  std::vector<LobeErrors> lobe_errors;  // per level; empty without a roughness
};

// An error of the work names its file.
template <class Work>
auto of_file(const std::string& file, Work work) {
  try {
    return work();
  } catch (const Error& error) {
    throw error.within(file);
  }
}

// The alphas of --alpha or --roughness; empty without either.
Image alphas_of(const StatisticsArguments& arguments) {
  if (arguments.alpha) return {1, 1, 1, static_cast<float>(*arguments.alpha)};
  if (arguments.roughness.empty()) return {};
  const Image roughness = read_image(arguments.roughness, Transfer::linear);
  Image alphas(roughness.width, roughness.height, 1);
  for (std::size_t i = 0; i < alphas.texel_count(); ++i) {
    const float value = roughness.texels[i * static_cast<std::size_t>(roughness.channels)];
    alphas.texels[i] = std::max(value * value, static_cast<float>(smallest_alpha));
  }
  return alphas;
}

Statistics statistics_of(const StatisticsArguments& arguments) {
  const NormalFile file = arguments.how.of(arguments.map);
  std::vector<std::string> faults;  // the share of unit vectors tells them
  const Image normals = read_normals(file, faults).decoded();
  const bool encoded = !file.heights && !is_exr(file.path);
  Statistics statistics{.width = normals.width,
                        .height = normals.height,
                        .unit_share = encoded ? unit_share(read_image(file.path, Transfer::linear)) : 1.0,
                        .correlation = {},
                        .mean_alpha = {},
                        .levels = map_statistics(normals),
                        .lobe_errors = {}};
  if (!arguments.gloss.empty()) {
    const Image gloss = read_image(arguments.gloss, Transfer::linear);
    statistics.correlation =
        of_file(arguments.gloss, [&] { return correlation_with_spread(normals, gloss, correlated_level); });
  }
  const Image alphas = alphas_of(arguments);
  if (alphas.empty()) return statistics;
  statistics.mean_alpha = mean_of(alphas);
  for (const LevelStatistics& level : statistics.levels)
    statistics.lobe_errors.push_back(
        of_file(arguments.roughness, [&] { return lobe_errors(normals, alphas, level.level); }));
  return statistics;
}

std::string text_of(const Statistics& statistics) {
  std::string text = fmt::format("{}x{} texels, {:.1f}% of them unit vectors\n", statistics.width, statistics.height,
                                 100.0 * statistics.unit_share);
  if (statistics.correlation)
    text += fmt::format("correlation of gloss with slope variance, 8x8 texels: {:.2f}\n", *statistics.correlation);
  text += fmt::format("\n{:>5} {:>10} {:>10} {:>11} {:>7}", "level", "length", "variance", "anisotropy", "tails");
  if (!statistics.lobe_errors.empty())
    text += fmt::format(" {:>9} {:>9} {:>9} {:>10}", "texel", "mean", "round", "elliptical");
  for (std::size_t i = 0; i < statistics.levels.size(); ++i) {
    const LevelStatistics& level = statistics.levels[i];
    text += fmt::format("\n{:>5} {:>10.5f} {:>10.3g} {:>11.3f} {:>7.2f}", level.level, level.resultant, level.variance,
                        level.anisotropy, level.tails);
    if (statistics.lobe_errors.empty()) continue;
    const LobeErrors& errors = statistics.lobe_errors[i];
    text += fmt::format(" {:>9.4g} {:>9.4g} {:>9.4g} {:>10.4g}", errors[0], errors[1], errors[2], errors[3]);
  }
  return text + "\n";
}

std::string json_of(const Statistics& statistics) {
  Json json{{"schema", "footprint-statistics/1"},
            {"size", {statistics.width, statistics.height}},
            {"unit_share", statistics.unit_share},
            {"gloss_correlation", statistics.correlation ? Json(*statistics.correlation) : Json()},
            {"mean_alpha", statistics.mean_alpha ? Json(*statistics.mean_alpha) : Json()},
            {"levels", Json::array()}};
  for (std::size_t i = 0; i < statistics.levels.size(); ++i) {
    const LevelStatistics& level = statistics.levels[i];
    json["levels"].push_back({{"level", level.level},
                              {"resultant", level.resultant},
                              {"variance", level.variance},
                              {"anisotropy", level.anisotropy},
                              {"tails", level.tails}});
    if (!statistics.lobe_errors.empty()) json["levels"].back()["lobe_errors"] = statistics.lobe_errors[i];
  }
  return json.dump(2) + "\n";
}

}  // namespace

void add_statistics_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("statistics", "Describe a normal map by numbers, per footprint size");
  const auto arguments = std::make_shared<StatisticsArguments>();
  command->add_option("map", arguments->map, "A normal map, or heights with --height-scale")
      ->type_name("FILE")
      ->required();
  arguments->how.add_to(*command);
  command->add_option("--gloss", arguments->gloss, "A gloss map of the same size, for its correlation with the spread")
      ->type_name("FILE");
  auto* roughness = command
                        ->add_option("--roughness", arguments->roughness,
                                     "A roughness map of the same size: GGX's alpha is its square")
                        ->type_name("FILE");
  command->add_option("--alpha", arguments->alpha, "GGX's alpha, above 0 to 1")
      ->type_name("X")
      ->check(within(smallest_alpha, 1.0))
      ->excludes(roughness);
  command->add_flag("--json", arguments->json, "JSON instead of text, for programs");
  command->footer(statistics_examples);
  command->callback([arguments] {
    const Statistics statistics = statistics_of(*arguments);
    write_output(arguments->json ? json_of(statistics) : text_of(statistics));
  });
}

}  // namespace footprint

// `footprint statistics`: what a normal map is like, by the size of a footprint.
#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "app/subcommand.hpp"
#include "experiments/studies/ndf_inspection.hpp"
#include "renderer/bake/map_statistics.hpp"
#include "renderer/core/names.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/scene/assembly/surface_maps.hpp"
#include "results/report/json_archive.hpp"

namespace footprint {
namespace {

using Json = nlohmann::ordered_json;

constexpr int correlated_level = 3;  // blocks of 8 x 8 texels
constexpr const char* statistics_examples =
    R"(Per level, over all blocks of 2^level x 2^level texels: the mean length of the mean normal, the slope variance per
axis, its anisotropy (0 round, 1 a line), and tails: fourth moments over a Gaussian's. With --alpha or --roughness
also the errors of simple GGX lobes, relative to the mean: one texel's, one about the mean normal, one that the
variance widens, and one that the covariance widens.

Examples:
  footprint statistics normals.png
  footprint statistics normals.png --gloss gloss.png --json
  footprint statistics normals.png --alpha 0.2)";

struct StatisticsArguments {
  explicit StatisticsArguments(CLI::App& command) {
    add_value(command, "map", map, "FILE", "A normal map, or heights with --height-scale")->required();
    how.add_to(command);
    add_value(command, "--gloss", gloss, "FILE", "A gloss map of the same size, for its correlation with the spread");
    auto* squared = add_value(command, "--roughness", roughness, "FILE",
                              "A roughness map of the same size: GGX's alpha is its square");
    add_value(command, "--alpha", alpha, "X", "GGX's alpha, above 0 to 1")
        ->check(within(smallest_alpha, 1.0))
        ->excludes(squared);
    command.add_flag("--json", json, "JSON instead of text, for programs");
  }

  MapOptions how;
  std::string map, gloss, roughness;
  std::optional<double> alpha;
  bool json = false;
};

struct Statistics {
  int width = 0, height = 0;
  double unit_share = 0;
  std::optional<double> correlation = {};  // with the gloss map
  std::optional<double> mean_alpha = {};
  std::vector<LevelStatistics> levels;
  std::vector<LobeErrors> lobe_errors = {};  // per level; empty without a roughness
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

// A map beside the normal map, whose first channel must be finite and within 0 to `most`.
Image read_values(const std::string& file, float most) {
  Image map = read_image(file, Transfer::linear);
  for_each_texel(map, [&](int x, int y) {
    const float value = map.at(x, y)[0];
    if (value >= 0.0F && value <= most) return;
    throw Error(ErrorKind::usage, fmt::format("{}: texel ({}, {})", file, x, y),
                fmt::format("contains {}, which is not within 0 to {:g}", value, most), "fix the map");
  });
  return map;
}

// The alphas of --alpha or --roughness; empty without either.
Image read_alphas(const StatisticsArguments& arguments) {
  if (arguments.alpha) return {1, 1, 1, static_cast<float>(*arguments.alpha)};
  if (arguments.roughness.empty()) return {};
  const Image roughness = read_values(arguments.roughness, 1.0F);
  Image alphas(roughness.width, roughness.height, 1);
  for (std::size_t i = 0; i < alphas.texel_count(); ++i) {
    const float value = roughness.texels[i * static_cast<std::size_t>(roughness.channels)];
    alphas.texels[i] = std::max(value * value, static_cast<float>(smallest_alpha));
  }
  return alphas;
}

Statistics compute_statistics(const StatisticsArguments& arguments) {
  const NormalFile file = arguments.how.of(arguments.map);
  std::vector<std::string> faults;
  const Image normals = read_normals(file, faults).decoded();
  for (const std::string& fault : faults) write_message("warning: " + fault);
  const bool encoded = !file.heights && !is_exr(file.path);
  Statistics statistics{.width = normals.width,
                        .height = normals.height,
                        .unit_share = encoded ? unit_share(read_image(file.path, Transfer::linear)) : 1.0,
                        .levels = map_statistics(normals)};
  if (!arguments.gloss.empty()) {
    const Image gloss = read_values(arguments.gloss, std::numeric_limits<float>::max());
    statistics.correlation =
        of_file(arguments.gloss, [&] { return correlation_with_spread(normals, gloss, correlated_level); });
  }
  const Image alphas = read_alphas(arguments);
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
            {"gloss_correlation", to_json_value(statistics.correlation)},
            {"mean_alpha", to_json_value(statistics.mean_alpha)},
            {"levels", Json::array()}};
  for (std::size_t i = 0; i < statistics.levels.size(); ++i) {
    const auto& [level, resultant, variance, anisotropy, tails] = statistics.levels[i];
    json["levels"].push_back({{"level", level},
                              {"resultant", resultant},
                              {"variance", variance},
                              {"anisotropy", anisotropy},
                              {"tails", tails}});
    if (!statistics.lobe_errors.empty()) json["levels"].back()["lobe_errors"] = statistics.lobe_errors[i];
  }
  return json.dump(2) + "\n";
}

void run_statistics(const StatisticsArguments& arguments) {
  const Statistics statistics = compute_statistics(arguments);
  write_output(arguments.json ? json_of(statistics) : text_of(statistics));
}

}  // namespace

void add_statistics_command(CLI::App& app) {
  add_command(app, "statistics", "Describe a normal map by numbers, per footprint size", statistics_examples,
              run_statistics);
}

}  // namespace footprint

// `footprint statistics`: what a normal map is like, by the size of a footprint.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/commands.hpp"
#include "app/messages.hpp"
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
    "axis, its anisotropy (0 round, 1 a line), and tails: fourth moments over a Gaussian's.\n"
    "\n"
    "Examples:\n"
    "  footprint statistics normals.png\n"
    "  footprint statistics normals.png --gloss gloss.png --json";

struct StatisticsArguments {
  std::string map, gloss;
  bool json = false;
};

struct Statistics {
  int width = 0, height = 0;
  double unit_share = 0;
  std::optional<double> correlation;  // with the gloss map
  std::vector<LevelStatistics> levels;
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

Statistics statistics_of(const StatisticsArguments& arguments) {
  const Image stored = read_image(arguments.map, Transfer::linear);
  const bool is_exr = std::filesystem::path(arguments.map).extension() == ".exr";
  const Image normals = of_file(arguments.map, [&] {
                          return is_exr ? decode_unit_normals(stored) : decode_normal_map(stored, 1.0);
                        }).image;
  Statistics statistics{.width = stored.width,
                        .height = stored.height,
                        .unit_share = is_exr ? 1.0 : unit_share(stored),
                        .correlation = {},
                        .levels = map_statistics(normals)};
  if (!arguments.gloss.empty()) {
    const Image gloss = read_image(arguments.gloss, Transfer::linear);
    statistics.correlation =
        of_file(arguments.gloss, [&] { return correlation_with_spread(normals, gloss, correlated_level); });
  }
  return statistics;
}

std::string text_of(const Statistics& statistics) {
  std::string text = fmt::format("{}x{} texels, {:.1f}% of them unit vectors\n", statistics.width, statistics.height,
                                 100.0 * statistics.unit_share);
  if (statistics.correlation)
    text += fmt::format("correlation of gloss with slope variance, 8x8 texels: {:.2f}\n", *statistics.correlation);
  text += fmt::format("\n{:>5} {:>10} {:>10} {:>11} {:>7}\n", "level", "length", "variance", "anisotropy", "tails");
  for (const LevelStatistics& level : statistics.levels) {
    text += fmt::format("{:>5} {:>10.5f} {:>10.3g} {:>11.3f} {:>7.2f}\n", level.level, level.resultant, level.variance,
                        level.anisotropy, level.tails);
  }
  return text;
}

std::string json_of(const Statistics& statistics) {
  Json json{{"schema", "footprint-statistics/1"},
            {"size", {statistics.width, statistics.height}},
            {"unit_share", statistics.unit_share},
            {"gloss_correlation", statistics.correlation ? Json(*statistics.correlation) : Json()},
            {"levels", Json::array()}};
  for (const LevelStatistics& level : statistics.levels) {
    json["levels"].push_back({{"level", level.level},
                              {"resultant", level.resultant},
                              {"variance", level.variance},
                              {"anisotropy", level.anisotropy},
                              {"tails", level.tails}});
  }
  return json.dump(2) + "\n";
}

}  // namespace

void add_statistics_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("statistics", "Describe a normal map by numbers, per footprint size");
  const auto arguments = std::make_shared<StatisticsArguments>();
  command->add_option("map", arguments->map, "A normal map")->type_name("FILE")->required();
  command->add_option("--gloss", arguments->gloss, "A gloss map of the same size, for its correlation with the spread")
      ->type_name("FILE");
  command->add_flag("--json", arguments->json, "JSON instead of text, for programs");
  command->footer(statistics_examples);
  command->callback([arguments] {
    const Statistics statistics = statistics_of(*arguments);
    write_output(arguments->json ? json_of(statistics) : text_of(statistics));
  });
}

}  // namespace footprint

// `footprint surface`, `footprint statistics` and `footprint ndf`: the normal map of a procedural surface for other
// tools, what a normal map is like by the size of a footprint, and each method's NDF of the facets under one.
#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "app/subcommand.hpp"
#include "experiments/studies/ndf_inspection.hpp"
#include "renderer/bake/map_statistics.hpp"
#include "renderer/core/memory.hpp"
#include "renderer/core/names.hpp"
#include "renderer/core/numbers.hpp"
#include "renderer/core/process.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/ndf/reference_ndf.hpp"
#include "renderer/scene/assembly/surface_maps.hpp"
#include "results/report/json_archive.hpp"
#include "scenes/surfaces/registry.hpp"

namespace footprint {
namespace {

constexpr const char* surface_examples =
    R"(`footprint list surfaces` names the surfaces and their parameters. EXR stores unit normals as 32-bit floats,
-1 to 1: x right, y up, z out of the surface. PNG stores (n + 1) / 2 in 8 bits, green up, as glTF does.

Examples:
  footprint surface v_grooves -o grooves.exr
  footprint surface scales --resolution 1024 --seed 7 --parameter count=16 --parameter fill=0.8 -o scales.exr
  footprint surface desert --resolution 2048 -o desert.png)";

struct SurfaceArguments {
  explicit SurfaceArguments(CLI::App& command) {
    add_value(command, "name", surface, "SURFACE", "Name of the surface")->required();
    add_value(command, "-o,--output", output, "FILE", "The map, .exr or .png")->required();
    command.add_option("--resolution", resolution, "Texels per side; default: the surface's own")
        ->check(CLI::Range(1, largest_surface_resolution));
    command.add_option("--seed", seed, "Random seed: same seed, same bytes")->capture_default_str();
    add_value(command, "--parameter", parameters, "NAME=VALUE", "A parameter of the surface; may be repeated")
        ->allow_extra_args(false);
  }

  std::string surface;
  int resolution = 0;  // 0: the surface's own
  std::uint32_t seed = 1;
  std::vector<std::string> parameters;  // NAME=VALUE
  std::string output;
};

std::map<std::string, std::string> parse_parameters(const std::vector<std::string>& words) {
  std::map<std::string, std::string> parameters;
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw Error(ErrorKind::usage, "--parameter", fmt::format("`{}` is not NAME=VALUE", word), "write it as count=16");
    }
    if (!parameters.emplace(word.substr(0, equals), word.substr(equals + 1)).second) {
      throw Error(ErrorKind::usage, "--parameter", fmt::format("`{}` is given twice", word.substr(0, equals)),
                  "give it once");
    }
  }
  return parameters;
}

// x, y and z only: the weight is 1 everywhere.
Image normals_only(const Image& map) {
  Image normals(map.width, map.height, 3);
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) std::ranges::copy(map.at(x, y).first(3), normals.at(x, y).begin());
  }
  return normals;
}

void save(const std::filesystem::path& path, Image normals) {
  throw_if_interrupted();
  if (lower_extension(path) == ".exr") return write_exr(path, normals);
  for (float& value : normals.texels) value = 0.5F * value + 0.5F;
  write_png(path, normals);
}

void run_surface(const SurfaceArguments& arguments) {
  const std::filesystem::path path =
      image_path(arguments.output, "use the extension .exr for float normals, or .png for 8 bits");
  const Surface& surface = find_surface(all_surfaces(), arguments.surface);
  SurfaceSettings settings = surface_settings(surface, parse_parameters(arguments.parameters));
  if (arguments.resolution != 0) settings.resolution = arguments.resolution;
  settings.seed = arguments.seed;
  const auto side = static_cast<std::uint64_t>(settings.resolution);
  constexpr std::uint64_t texel_bytes = (4 + 3) * sizeof(float);  // the map, and its written channels
  require_memory(frame_bytes(side, side, texel_bytes), fmt::format("a map of {} x {} texels", side, side),
                 "give a smaller --resolution, or free memory");
  Image normals = normals_only(surface_normals(surface, settings));
  save(path, std::move(normals));
  write_output(fmt::format("{}\n", path.string()));
}

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
Image alphas_of(const StatisticsArguments& arguments) {
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

Statistics statistics_of(const StatisticsArguments& arguments) {
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
            {"gloss_correlation", to_json_value(statistics.correlation)},
            {"mean_alpha", to_json_value(statistics.mean_alpha)},
            {"levels", Json::array()}};
  for (std::size_t i = 0; i < statistics.levels.size(); ++i) {
    json["levels"].push_back(to_json_value(statistics.levels[i]));
    if (!statistics.lobe_errors.empty()) json["levels"].back()["lobe_errors"] = statistics.lobe_errors[i];
  }
  return json.dump(2) + "\n";
}

void run_statistics(const StatisticsArguments& arguments) {
  const Statistics statistics = statistics_of(arguments);
  write_output(arguments.json ? json_of(statistics) : text_of(statistics));
}

constexpr const char* ndf_examples =
    R"(MAP is an EXR of unit normals (x, y, z, each -1 to 1) or a normal map as an image (OpenGL convention), or heights
with --height-scale. Texture coordinates start with (0, 0) at the top left.

Examples:
  footprint ndf normals.png -o ndf
  footprint ndf normals.exr --lobe ggx:0.1 --methods toksvig,naive_mip --region 0,0,0.25,0.25 -o ndf
  footprint ndf heights.png --height-scale 0.02 -o ndf
  footprint ndf model.gltf --material 2 --texels 256,128,320,192 -o ndf)";

struct NdfArguments : RunArguments {
  explicit NdfArguments(CLI::App& command) : RunArguments(command) {
    add_value(command, "source", source, "SCENE|MAP", "Scene, model or normal map")->required();
    map.add_to(command);
    auto* region = add_value(command, "--region", footprint, "U0,V0,U1,V1",
                             "Footprint in texture coordinates; default: the whole map");
    add_value(command, "--texels", texels, "X0,Y0,X1,Y1", "Footprint in texels of the normal map")->excludes(region);
    add_value(command, "--lobe", lobe, "LOBE",
              "blinn_phong:EXPONENT, beckmann:ALPHA, ggx:ALPHA or vmf:KAPPA; default: the scene's, or "
              "blinn_phong:64 for a map");
    add_value(command, "--material", material, "NAME", "Material of the scene, by name or number from 0");
    command
        .add_option("--resolution", resolution,
                    "Rings of directions on the hemisphere; default: as the narrowest lobe needs")
        ->check(CLI::Range(smallest_resolution, largest_resolution));
    command.add_option("--picture-size", picture_size, "Side of the images in pixels")
        ->check(CLI::Range(16, 4096))
        ->capture_default_str();
    add_output_folder(command, output, "Folder for index.html, ndf.json, ndf.png, images/")->required();
  }

  std::string source;
  MapOptions map;
  std::string material;
  std::string footprint, texels;
  std::string lobe;
  int resolution = NdfSettings{}.resolution;
  int picture_size = NdfSettings{}.picture;
  std::string output;
};

FootprintRect parse_rectangle(const std::string& option, const std::string& text) {
  const std::vector<std::string> parts = parts_of(text);
  std::vector<double> values;
  for (const std::string& part : parts) {
    if (const auto value = parse_whole_of<double>(part)) values.push_back(*value);
  }
  if (parts.size() == 4 && values.size() == 4) return {{values[0], values[1]}, {values[2], values[3]}};
  throw Error(ErrorKind::usage, option, fmt::format("`{}` is not a rectangle", text),
              "give four numbers u0,v0,u1,v1 comma-separated, for example 0,0,0.5,0.5");
}

// The footprint in texture coordinates, given in them or in texels.
FootprintRect footprint_of(const NdfArguments& arguments, const Material& material) {
  FootprintRect rect;
  if (!arguments.footprint.empty()) rect = parse_rectangle("--region", arguments.footprint);
  if (!arguments.texels.empty()) {
    rect = parse_rectangle("--texels", arguments.texels);
    const glm::dvec2 size = material.normal_map
                                ? glm::dvec2(material.normal_map->image.width(), material.normal_map->image.height())
                                : glm::dvec2(1.0);
    rect = {rect.lower / size, rect.upper / size};
  }
  check_footprint(rect, arguments.texels.empty() ? "--region" : "--texels " + arguments.texels);
  return rect;
}

void run_ndf(const NdfArguments& arguments) {
  NdfSettings settings{
      .run = arguments.settings(), .resolution = arguments.resolution, .picture = arguments.picture_size};
  if (!arguments.footprint.empty()) (void)parse_rectangle("--region", arguments.footprint);
  if (!arguments.texels.empty()) (void)parse_rectangle("--texels", arguments.texels);
  const std::optional<Lobe> lobe =
      arguments.lobe.empty() ? std::nullopt : std::optional(parse_lobe("--lobe", arguments.lobe));
  NdfSource source =
      load_ndf_source(arguments.map.of(arguments.source), arguments.material, settings.run.scene_library);
  if (lobe) source.material = with_lobe(std::move(source.material), *lobe);
  settings.footprint = footprint_of(arguments, source.material);

  ProgressDisplay display(progress_style(arguments.quiet));
  warn_without_captions();
  const auto [results, path, lost] = write_whole(arguments.output, [&](OutputFolder& folder) {
    std::filesystem::create_directories(folder.path() / "images");
    NdfResults measured = inspect_ndf(source, settings, folder.run(), display.callback());
    measured.tool.version = FOOTPRINT_VERSION;
    folder.run().write_document("ndf.json", ndf_json(measured));
    folder.run().write_text("index.html", [&] {
      NdfResults shown = measured;
      if (std::string text = folder.run().losses_text(); !text.empty()) shown.notes.push_back(std::move(text));
      return ndf_page(shown);
    });
    keep(folder);
    return measured;
  });
  display.finish();
  for (const std::string& note : results.notes) write_message(note);
  if (!results.grid.fine_enough) {
    write_message(fmt::format(
        "the grid of directions is too coarse for {}: the exact NDF integrates to {:.4g} instead of {:.4g}; "
        "give a larger --resolution",
        results.lobe.narrowest, results.truth.energy, results.truth.expected_energy));
  }
  write_output(fmt::format("{}\nimages: {}\n", ndf_table(results), (path / results.pictures.strip).string()));
  throw_first({lost});
}

}  // namespace

void add_surface_command(CLI::App& app) {
  add_command(app, "surface", "Write the normal map of a procedural surface", surface_examples, run_surface);
}

void add_statistics_command(CLI::App& app) {
  add_command(app, "statistics", "Describe a normal map by numbers, per footprint size", statistics_examples,
              run_statistics);
}

void add_ndf_command(CLI::App& app) {
  add_command(app, "ndf", "Show each method's NDF of one footprint next to the exact one", ndf_examples, run_ndf);
}

}  // namespace footprint

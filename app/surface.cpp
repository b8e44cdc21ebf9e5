// `footprint surface`: the normal map of a procedural surface, for other tools.
#include <algorithm>
#include <cstdint>
#include <map>

#include "app/subcommand.hpp"
#include "renderer/core/memory.hpp"
#include "renderer/core/names.hpp"
#include "renderer/core/process.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/scene/assembly/surface_maps.hpp"
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
        ->check(within(1, largest_surface_resolution));
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

}  // namespace

void add_surface_command(CLI::App& app) {
  add_command(app, "surface", "Write the normal map of a procedural surface", surface_examples, run_surface);
}

}  // namespace footprint

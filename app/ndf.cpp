// `footprint ndf`: each method's NDF of the facets under one footprint, next to the exact one.
#include "app/subcommand.hpp"
#include "experiments/studies/ndf_inspection.hpp"
#include "renderer/core/names.hpp"
#include "renderer/core/numbers.hpp"
#include "renderer/ndf/reference_ndf.hpp"
#include "results/report/json_archive.hpp"

namespace footprint {
namespace {

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
        ->check(within(smallest_resolution, largest_resolution));
    command.add_option("--picture-size", picture_size, "Side of the images in pixels")
        ->check(within(16, 4096))
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

void add_ndf_command(CLI::App& app) {
  add_command(app, "ndf", "Show each method's NDF of one footprint next to the exact one", ndf_examples, run_ndf);
}

}  // namespace footprint

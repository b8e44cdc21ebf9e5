// The material that is looked into, of a normal map alone or of a scene; the exact NDF of a footprint on a grid of
// directions, and what each method makes of it; discs of the hemisphere in false colour, side by side and each alone.
#include "experiments/studies/ndf_inspection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "experiments/settings/setting.hpp"
#include "experiments/studies/picture_files.hpp"
#include "experiments/studies/stage.hpp"
#include "methods/registry.hpp"
#include "renderer/core/memory.hpp"
#include "renderer/core/names.hpp"
#include "renderer/image/false_color.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/image/pixel_script.hpp"
#include "renderer/ndf/method_ndf.hpp"
#include "renderer/ndf/reference_ndf.hpp"
#include "renderer/scene/assembly/load_scene.hpp"
#include "renderer/scene/assembly/surface_maps.hpp"

namespace footprint {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 3> scene_extensions{".toml", ".gltf", ".glb"};
constexpr double default_exponent = 64.0;

// By its extension, or because it is a file and not a scene.
bool names_a_map(const std::string& path) {
  if (names_an_image(path)) return true;
  std::error_code ignored;
  return fs::is_regular_file(path, ignored) &&
         std::ranges::find(scene_extensions, lower_extension(path)) == scene_extensions.end();
}

NdfSource load_map(const NormalFile& map) {
  NdfSource source{map.path.string(), true, {}, {}};
  source.material.name = map.path.stem().string();
  source.material.brdf = {NormalDistribution::blinn_phong, GeometryTerm::none, FresnelTerm::none, false};
  source.material.normal_map = {map.path.filename().string(), read_normals(map, source.notes), {}};
  source.material = with_lobe(std::move(source.material), {NormalDistribution::blinn_phong, default_exponent});
  return source;
}

std::size_t material_index(const Scene& scene, const std::string& wanted) {
  std::vector<std::string> names;
  for (const Material& material : scene.materials) names.push_back(material.name);
  if (wanted.empty() && names.size() == 1) return 0;
  if (wanted.empty()) {
    throw Error(ErrorKind::usage, scene.source, fmt::format("it has {} materials", names.size()),
                fmt::format("name one with --material: {}, or a number from 0", fmt::join(names, ", ")));
  }
  if (const auto found = find_entry(wanted, names)) return *found;
  throw Error(ErrorKind::usage, "--material", fmt::format("{} has no material `{}`", scene.source, wanted),
              suggestion(wanted, names));
}

constexpr float around = 0.18F;  // grey outside of the disc, so that its edge shows

Image one_channel(int size, std::span<const float> densities) {
  Image image(size, size, 1);
  std::ranges::copy(densities, image.texels.begin());
  return image;
}

bool outside_disc(int size, int column, int row) {
  const double x = 2.0 * (column + 0.5) / size - 1.0;
  const double y = 2.0 * (row + 0.5) / size - 1.0;
  return x * x + y * y >= 1.0;
}

Image colored(int size, std::span<const float> values, float scale) {
  Image picture = false_color(one_channel(size, values), scale);
  for (int row = 0; row < size; ++row) {
    for (int column = 0; column < size; ++column) {
      if (outside_disc(size, column, row)) std::ranges::fill(picture.at(column, row), around);
    }
  }
  return picture;
}

std::vector<float> differences(std::span<const float> a, std::span<const float> b) {
  std::vector<float> out(a.size());
  std::ranges::transform(a, b, out.begin(), [](float x, float y) { return std::abs(x - y); });
  return out;
}

// A density at the pixels of a disc (`disc_directions`), with its caption.
struct NdfPicture {
  std::string stem;     // of its files
  std::string caption;  // ASCII
  std::vector<float> densities;
};

// Writes images/STEM.exr, STEM.png and STEM_values.js for the exact NDF and every method, images/STEM_difference.png
// for every method, and ndf.png, all of them side by side over the scale, below `folder`; fills in the paths and the
// scale of `results`, which has the same methods. The scale runs from 0 to the exact NDF's largest density.
void write_ndf_pictures(const RunFolder& folder, int size, const NdfPicture& exact, std::span<const NdfPicture> methods,
                        NdfResults& results) {
  const float scale = *std::ranges::max_element(exact.densities);
  results.pictures.scale = scale;
  const auto write = [&](const NdfPicture& picture, auto& images) {
    images.density = "images/" + picture.stem + ".exr";
    images.picture = "images/" + picture.stem + ".png";
    Image shown = colored(size, picture.densities, scale);
    const Image densities = one_channel(size, picture.densities);
    folder.attempt(images.density, [&] { write_exr(folder / images.density, densities); });
    folder.attempt(picture.stem,
                   [&] { write_pixel_script(folder / "images" / (picture.stem + "_values.js"), densities); });
    folder.attempt(images.picture, [&] { write_png(folder / images.picture, shown); });
    return shown;
  };
  Strip densities, errors;
  densities.add(write(exact, results.truth.images), exact.caption);
  errors.add(Image(size, size, 3, around), "| method - truth |");
  for (std::size_t i = 0; i < methods.size(); ++i) {
    NdfImages& images = results.methods.at(i).second.images;
    densities.add(write(methods[i], images), methods[i].caption);
    images.difference = "images/" + methods[i].stem + "_difference.png";
    errors.add(colored(size, differences(methods[i].densities, exact.densities), scale), methods[i].caption);
    folder.attempt(images.difference, [&] { write_png(folder / images.difference, errors.pictures.back()); });
  }
  results.pictures.strip = "ndf.png";
  folder.attempt(results.pictures.strip, [&] {
    const Image strip = stacked(densities.drawn(), errors.drawn());
    const Image legend = false_color_legend(strip.width, std::max(24, size / 12), scale);
    write_png(folder / results.pictures.strip, stacked(strip, legend));
  });
}

// Pictures are of facets merged within this part of the narrowest lobe's width: within 1e-3 of a lobe's peak.
constexpr double part_in_pictures = 1.0 / 16.0;
// Sufficient for the part below the horizon.
constexpr double part_in_energy = 1.0 / 8.0;

FootprintFilter filter_of(const std::optional<FootprintFilter>& given) {
  const FootprintFilter filter = given.value_or(default_footprint_filter);
  require_one_lookup(filter, "NDFs");
  return filter;
}

// The directions, and the exact densities there.
struct Grid {
  HemisphereGrid hemisphere;
  std::vector<glm::vec3> disc;
  std::vector<double> exact;   // at the hemisphere's directions
  std::vector<float> picture;  // at the disc's
};

void require_grid_memory(int resolution, int picture) {
  // Directions, solid angles, the exact and one method's densities, and the growth of vectors.
  constexpr std::uint64_t bytes_per_direction = 2 * (sizeof(glm::vec3) + 2 * sizeof(double) + sizeof(float));
  const double directions = std::max(direction_count(resolution), static_cast<double>(picture) * picture);
  require_memory(frame_bytes(static_cast<std::uint64_t>(directions), 1, bytes_per_direction),
                 fmt::format("{:.0f} directions", directions), "give a smaller --resolution or --picture-size");
}

Grid exact_grid(const Material& material, const NdfSettings& settings, const FootprintTexels& texels,
                NdfResults& results, const Progress& progress) {
  ProgressParts parts(progress, 2);
  const NormalDistribution distribution = material.brdf.distribution;
  const ReferenceNdf exact(distribution, texels.facets);
  const Lobe narrowest = exact.narrowest();
  const auto merged = [&](double part) {
    return ReferenceNdf(distribution, merged_facets(texels.facets, part * lobe_width(narrowest)));
  };
  results.lobe.narrowest = lobe_text(narrowest);
  results.grid.resolution = settings.resolution > 0 ? settings.resolution : resolution_for(narrowest);
  require_grid_memory(results.grid.resolution, settings.picture);
  Grid grid{hemisphere_grid(results.grid.resolution), disc_directions(settings.picture), {}, {}};
  grid.exact = exact.densities(grid.hemisphere.directions, parts.next(1, ""));
  const std::vector<double> picture = merged(part_in_pictures).densities(grid.disc, parts.next(1, ""));
  grid.picture.assign(picture.begin(), picture.end());
  const NdfTotals totals = ndf_totals(grid.hemisphere, grid.exact);
  results.grid.directions = grid.hemisphere.directions.size();
  results.truth.energy = totals.energy;
  results.truth.peak = std::max(totals.peak, largest_density(grid.picture));
  results.truth.expected_energy = merged(part_in_energy).expected_energy();
  results.grid.fine_enough =
      std::abs(totals.energy - results.truth.expected_energy) <= ndf_energy_tolerance * results.truth.expected_energy;
  return grid;
}

NdfResults described(const NdfSource& source, const NdfSettings& settings, const FootprintTexels& texels) {
  const FootprintRect& rect = settings.footprint;
  NdfResults results;
  results.source = {.path = source.path, .kind = source.is_map ? "map" : "scene", .material = source.material.name};
  if (source.material.normal_map) {
    const MapTexels& map = source.material.normal_map->image;
    results.source.width = map.width();
    results.source.height = map.height();
  }
  results.lobe.varies = texels.facets.front().parameter != texels.facets.back().parameter;  // sorted by it
  results.footprint = {rect.lower.x, rect.lower.y, rect.upper.x, rect.upper.y};
  results.texels = {.area = texels.texels, .valid_share = texels.valid_share, .distinct = texels.facets.size()};
  results.fetch = {.level = footprint_level(source.material, rect),
                   .filter = footprint_filter_text(filter_of(settings.run.footprint))};
  results.notes = source.notes;
  return results;
}

// The share of the normal map's texels that a method bakes if a part is enough.
double share_baked(const Material& material, const std::optional<FootprintPart>& part) {
  if (!part) return 1.0;
  return static_cast<double>(part->material.normal_map->image.texel_count()) /
         static_cast<double>(material.normal_map->image.texel_count());
}

// The scene that a method bakes and draws.
struct BakeTarget {
  Scene scene;
  FootprintRect footprint;
  GpuScene gpu;

  BakeTarget(const gl::Context& context, const Material& material, const FootprintRect& rect, const EffectSet& effects,
             const DiskCache* cache)
      : scene(scene_of_facets(material)), footprint(rect), gpu(context.info(), scene, effects, no_progress, cache) {}
};

// Evaluates NDFs of one material on the GPU: of the whole map, or of the part under the footprint for methods that can
// bake a part.
class NdfEvaluator {
 public:
  NdfEvaluator(const NdfSettings& settings, const Material& material)
      : settings_(settings),
        part_(part_under(material, settings.footprint, filter_of(settings.run.footprint))),
        share_(share_baked(material, part_)),
        context_(settings.run.backend.context),
        effects_(effects_on(derive_effects(scene_of_facets(material)))),
        cache_(cache_in(settings.run.cache)),
        whole_(context_, material, settings.footprint, effects_, cache_ ? &*cache_ : nullptr) {
    if (cache_) bakes_.emplace(*cache_);
  }

  // The weight of a method in progress; 1 for a bake of milliseconds.
  [[nodiscard]] double weight_of(const MethodSpec& spec) const {
    const MethodInfo& info = find_method(spec).info;
    if (!info.slow_precompute) return 1.0;
    constexpr double slow = 30.0;
    return info.bakes_by_texel ? std::max(slow * share_, 1.0) : slow;
  }

  // Adds the figures of a method to `results` and gives its picture.
  NdfPicture inspect(const MethodSpec& spec, const Grid& grid, NdfResults& results, const Progress& progress) {
    const Method& method = find_method(spec);
    BakeTarget& target = target_of(method);
    const BakedMethod baked = bake(method, spec, target.scene, effects_, progress, bakes_ ? &*bakes_ : nullptr);
    const MethodNdf ndf(context_.info(), target.gpu, baked, target.scene.materials.front(),
                        filter_of(settings_.run.footprint), settings_.run.backend.tile);
    for (const std::string& note : baked.materials.front().notes)
      results.notes.push_back(fmt::format("{}: {}", spec.text, note));
    const std::vector<float> densities = ndf.densities(target.footprint, grid.hemisphere.directions);
    const NdfFigures figures = compare_ndfs(grid.hemisphere, densities, grid.exact);
    NdfRecord record{figures.l2, figures.energy, figures.peak, method.lobe_count(baked.options), {}, {}};
    for (const auto& [name, value] : baked.options.all()) record.options[name] = value;
    results.methods.emplace_back(spec.text, std::move(record));
    NdfPicture picture{file_stem(spec.text), fmt::format("{}  L2 {:.3g}", spec.text, figures.l2),
                       ndf.densities(target.footprint, grid.disc)};
    context_.check("evaluating the NDF of " + spec.text);
    const double peak = largest_density(picture.densities);
    results.methods.back().second.peak = std::isfinite(peak) ? figures.peak + std::max(peak - figures.peak, 0.0) : peak;
    return picture;
  }

 private:
  BakeTarget& target_of(const Method& method) {
    if (!part_ || !method.info.bakes_by_texel) return whole_;
    if (!partial_) partial_.emplace(context_, part_->material, part_->rect, effects_, cache_ ? &*cache_ : nullptr);
    return *partial_;
  }

  const NdfSettings& settings_;
  std::optional<FootprintPart> part_;
  double share_;
  gl::Context context_;
  EffectSet effects_;  // those of the whole map, for any part of it
  std::optional<DiskCache> cache_;
  BakeTarget whole_;
  std::optional<BakeTarget> partial_;
  std::optional<DiskCache> bakes_;
};

}  // namespace

Material with_lobe(Material material, const Lobe& lobe) {
  material.brdf.distribution = lobe.distribution;
  material.lobes.clear();
  material.anisotropy.reset();
  material.anisotropy_map.reset();
  material.lobe_parameter = static_cast<float>(lobe.parameter);
  return material;
}

NdfSource load_ndf_source(const NormalFile& map, const std::string& material, const SceneLibrary& library) {
  const std::string path = map.path.string();
  if (names_a_map(path)) {
    if (material.empty()) return load_map(map);
    throw Error(ErrorKind::usage, "--material", fmt::format("{} is a map and has no materials", path), "leave it out");
  }
  if (map.heights) {
    throw Error(ErrorKind::usage, path, "is a scene, which says itself what its heights are",
                "name the map, or give the scene a `height_map`");
  }
  const Scene scene = load_scene(path, library);
  NdfSource source{path, false, scene.materials.at(material_index(scene, material)), scene.warnings};
  if (source.material.layer_map) source.notes.emplace_back("the detail layer is left out: one normal map is inspected");
  return source;
}

NdfResults inspect_ndf(const NdfSource& source, const NdfSettings& settings, const RunFolder& folder,
                       const Progress& progress) {
  check_footprint(settings.footprint, "--region");
  const std::vector<MethodSpec> methods = settings.run.methods.empty() ? every_method() : settings.run.methods;
  const FootprintTexels texels = texels_under(source.material, settings.footprint);
  NdfResults results = described(source, settings, texels);
  NdfEvaluator evaluator(settings, source.material);
  constexpr double weight_of_exact = 10.0;
  double weight = weight_of_exact;
  for (const MethodSpec& spec : methods) weight += evaluator.weight_of(spec);
  ProgressParts parts(progress, weight);
  const Grid grid = exact_grid(source.material, settings, texels, results, parts.next(weight_of_exact, ""));
  std::vector<NdfPicture> pictures;
  for (const MethodSpec& spec : methods) {
    try {
      pictures.push_back(evaluator.inspect(spec, grid, results, parts.next(evaluator.weight_of(spec), "")));
    } catch (const Error& error) {
      if (!settings.run.methods.empty() || error.kind() != ErrorKind::usage) throw;
      results.notes.push_back(fmt::format("{} is left out: {}", spec.text, error.what()));
    }
  }
  const NdfPicture exact{"truth", "truth", grid.picture};
  write_ndf_pictures(folder, settings.picture, exact, pictures, results);
  return results;
}

}  // namespace footprint

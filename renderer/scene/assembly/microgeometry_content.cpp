// Builds a patch by its kind or from a model's triangles; its maps give a material normals and mean colour.
#include "renderer/scene/assembly/microgeometry_content.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include "renderer/core/bytes.hpp"
#include "renderer/core/error.hpp"
#include "renderer/scene/model.hpp"

namespace footprint {
namespace {

constexpr std::array<std::int32_t, 3> sizes{TabulatedBrdf::theta_h_cells, TabulatedBrdf::theta_d_cells,
                                            TabulatedBrdf::phi_d_cells};
constexpr std::array<double, 3> units{1.0 / 1500.0, 1.15 / 1500.0, 1.66 / 1500.0};
constexpr std::size_t header_bytes = sizeof(sizes);
constexpr std::size_t file_bytes = header_bytes + 3 * TabulatedBrdf::cell_count * sizeof(double);

// A model's triangles: y out of the surface becomes z. Colours are those of its materials.
Patch patch_of_model(const MicrogeometrySettings& settings) {
  const Model model = load_gltf(settings.model);
  const std::string file = settings.model.filename().string();
  if (model.materials.size() > std::numeric_limits<std::uint8_t>::max()) {
    throw Error(ErrorKind::usage, settings.model.string(), "has more than 255 materials", "join some of them");
  }
  Patch patch;
  patch.name = file;
  patch.palette.clear();
  for (const Material& material : model.materials) patch.palette.emplace_back(material.base_color);
  glm::vec3 lower(std::numeric_limits<float>::max()), upper(std::numeric_limits<float>::lowest());
  for (const Mesh& mesh : model.meshes) {
    const auto base = static_cast<std::uint32_t>(patch.vertices.size());
    for (const Vertex& vertex : mesh.vertices) {
      const glm::vec3 p(vertex.position.x, -vertex.position.z, vertex.position.y);
      patch.vertices.push_back(p);
      lower = glm::min(lower, p);
      upper = glm::max(upper, p);
    }
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
      patch.triangles.push_back(base + glm::uvec3(mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]));
      patch.paints.push_back(static_cast<std::uint8_t>(mesh.material));
    }
  }
  patch.period = settings.period.value_or(glm::vec2(upper - lower));
  // Moves the tiling near the origin, because large coordinates would lose digits of the facets.
  const glm::dvec2 zero(model.origin.x, -model.origin.z), period(patch.period);
  const glm::vec3 corner(glm::vec2(glm::floor((glm::dvec2(lower) + zero) / period) * period - zero), lower.z);
  for (glm::vec3& vertex : patch.vertices) vertex -= corner;
  return patch;
}

// The BRDF of the facets if it replaces the base BRDF.
std::shared_ptr<const TabulatedBrdf> brdf_of(const MicrogeometrySettings& settings) {
  if (settings.measured) return std::make_shared<const TabulatedBrdf>(read_merl(*settings.measured));
  if (!settings.ward) return nullptr;
  const WardSettings& ward = *settings.ward;
  return std::make_shared<const TabulatedBrdf>(ward_brdf(ward.diffuse, ward.specular, ward.alpha));
}

}  // namespace

TabulatedBrdf read_merl(const std::filesystem::path& file) {
  const std::vector<std::uint8_t> bytes = read_file_bytes(file, 2 * file_bytes);
  const auto refuse = [&](const std::string& message) {
    return Error(ErrorKind::usage, file.string(), message, "give a .binary file of the MERL database");
  };
  std::array<std::int32_t, 3> found{};
  if (bytes.size() < header_bytes) throw refuse(fmt::format("has {} bytes, not even its three sizes", bytes.size()));
  std::memcpy(found.data(), bytes.data(), header_bytes);
  if (found != sizes) {
    throw refuse(fmt::format("has {} x {} x {} cells, not 90 x 90 x 180", found[0], found[1], found[2]));
  }
  if (bytes.size() != file_bytes) throw refuse(fmt::format("has {} bytes, not {}", bytes.size(), file_bytes));
  TabulatedBrdf brdf;
  brdf.values.resize(TabulatedBrdf::cell_count);
  for (std::size_t c = 0; c < 3; ++c) {
    const std::uint8_t* const plane = bytes.data() + header_bytes + c * TabulatedBrdf::cell_count * sizeof(double);
    for (std::size_t i = 0; i < TabulatedBrdf::cell_count; ++i) {
      double value = 0.0;
      std::memcpy(&value, plane + i * sizeof(double), sizeof(double));
      if (!std::isfinite(value)) throw refuse(fmt::format("value {} is not finite", c * TabulatedBrdf::cell_count + i));
      brdf.values[i][static_cast<int>(c)] = static_cast<float>(std::max(value, 0.0) * units.at(c));
    }
  }
  return brdf;
}

MicrogeometryContent load_microgeometry(const MicrogeometrySettings& settings) {
  Patch patch = settings.kind != nullptr ? make_patch(*settings.kind, settings.parameters, settings.seed)
                                         : patch_of_model(settings);
  check_patch(patch, settings.kind != nullptr ? "[microgeometry]" : settings.model.string());
  PatchMaps maps = patch_maps(patch, settings.resolution);
  return {std::make_shared<const Microgeometry>(Microgeometry{std::move(patch), maps.mean_color, brdf_of(settings)}),
          std::make_shared<const Image>(std::move(maps.normals))};
}

void apply(const MicrogeometryContent& content, Material& material) {
  const TextureCoordinates coordinates = material.normal_map ? material.normal_map->coordinates : TextureCoordinates{};
  material.normal_map = TextureMap{content.microgeometry->patch.name, content.normals, coordinates};
  material.base_color *= glm::vec4(content.microgeometry->mean_color, 1.0F);
  material.microgeometry = content.microgeometry;
}

}  // namespace footprint

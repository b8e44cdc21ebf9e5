// Collects all statements, then resolves faces, because these may come before their vertices.
#include "renderer/scene/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "renderer/core/error.hpp"
#include "renderer/core/numbers.hpp"
#include "renderer/core/process.hpp"
#include "renderer/scene/geometry.hpp"
#include "renderer/scene/obj/mtl.hpp"
#include "renderer/scene/obj/polygon.hpp"
#include "renderer/scene/obj/statements.hpp"
#include "renderer/scene/origin.hpp"
#include "renderer/scene/tangents.hpp"

namespace footprint {
namespace {

constexpr std::uint64_t largest_obj = std::uint64_t{1} << 31U;
constexpr std::size_t most_triangles = std::size_t{1} << 26U;
constexpr double farthest = 1e15;   // metres, as for glTF
constexpr double largest_uv = 1e6;  // as for glTF

/// Position, texture coordinate and normal of a corner, from 0; `no_index` of what it lacks.
using Corner = std::array<std::int32_t, 3>;
constexpr std::int32_t no_index = -1;
constexpr std::array<std::string_view, 3> corner_parts{"v", "vt", "vn"};

struct Face {
  std::size_t line, first_corner;
  std::uint32_t material;
};

/// Numbers of a statement: as many as it has, at most seven.
struct Numbers {
  std::array<double, 7> values{};
  std::size_t count = 0;
};

bool is_within(const glm::dvec3& values, double largest) {
  return std::abs(values.x) <= largest && std::abs(values.y) <= largest && std::abs(values.z) <= largest;
}

class ObjReader {
 public:
  ObjReader(const std::filesystem::path& file, Model& model)
      : text_(file, largest_obj), model_(model), library_(model.warnings) {
    names_.push_back(utf8_text(file.stem().string()));
  }

  void read() {
    while (const auto statement = text_.next()) take(*statement);
    for (std::size_t i = 0; i < faces_.size(); ++i) add_face(i);
    move_positions();
    const std::size_t repaired = repair_normals(vertices_, indices_, positions_of_vertices_);
    warn(repaired);
    make_meshes();
  }

 private:
  void take(const WavefrontStatement& statement) {
    const std::string_view keyword = statement.keyword;
    line_ = statement.line;
    if (keyword == "v") return add_position(statement.rest);
    if (keyword == "vn") return add_normal(statement.rest);
    if (keyword == "vt") return add_coordinates(statement.rest);
    if (keyword == "f" || keyword == "fo") return keep_face(statement.rest);
    if (keyword == "usemtl") use_material(utf8_text(statement.rest));
    if (keyword == "mtllib") read_library(statement.rest);
    if (keyword == "s") smoothing_groups_.emplace(statement.rest);
    if (keyword == "l" || keyword == "p") add_once(model_.warnings, "points and lines are left out");
    if (keyword == "curv" || keyword == "surf") add_once(model_.warnings, "free-form curves and surfaces are left out");
  }

  [[nodiscard]] Error fault(const std::string& message) const { return text_.fault(line_, message); }

  [[nodiscard]] Numbers numbers(std::string_view rest, std::size_t least) const {
    Numbers out;
    for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest)) {
      const auto value = wavefront_number(word);
      if (!value && word.find(',') != std::string_view::npos)
        throw fault(fmt::format("`{:.40}` has a comma, where numbers have a decimal point", utf8_text(word)));
      if (!value) throw fault(fmt::format("`{:.40}` is not a number", utf8_text(word)));
      if (out.count == out.values.size()) throw fault("more numbers than a vertex can have");
      out.values.at(out.count++) = *value;
    }
    if (out.count < least) throw fault(fmt::format("{} of at least {} numbers", out.count, least));
    return out;
  }

  // Three numbers, or four with a weight; six with a colour, or seven with its alpha.
  void add_position(std::string_view rest) {
    const auto [n, count] = numbers(rest, 3);
    if (count == 5) throw fault("5 numbers are neither a weighted position nor one with a colour");
    glm::dvec3 position(n[0], n[1], n[2]);
    if (count == 4 && n[3] != 1.0) position /= n[3];
    if (!is_within(position, farthest)) unusable_.emplace(positions_.size(), line_);
    positions_.push_back(position);
    if (count < 6) return;
    colors_.resize(positions_.size() - 1, glm::vec4(1.0F));
    colors_.emplace_back(n[3], n[4], n[5], count == 7 ? n[6] : 1.0);
    largest_color_ = std::max({largest_color_, colors_.back().x, colors_.back().y, colors_.back().z});
  }

  void add_normal(std::string_view rest) {
    const std::array<double, 7> n = numbers(rest, 3).values;
    normals_.emplace_back(n[0], n[1], n[2]);
  }

  void add_coordinates(std::string_view rest) {
    const std::array<double, 7> n = numbers(rest, 1).values;
    uvs_.emplace_back(n[0], 1.0F - static_cast<float>(n[1]));
  }

  void keep_face(std::string_view rest) {
    faces_.push_back({line_, corners_.size(), material_});
    for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest))
      corners_.push_back(corner(word));
    const std::size_t count = corners_.size() - faces_.back().first_corner;
    if (count < 3) throw fault(fmt::format("a face of {} corners", count));
    triangle_count_ += count - 2;
    if (triangle_count_ > most_triangles) throw fault("more than 2^26 triangles");
  }

  /// A corner as written: "7", "7/2", "7//3" or "7/2/3".
  [[nodiscard]] Corner corner(const std::string_view word) const {
    const std::array<std::size_t, 3> lengths{positions_.size(), uvs_.size(), normals_.size()};
    Corner indices{no_index, no_index, no_index};
    std::string_view rest = word;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::string_view part = rest.substr(0, rest.find('/'));
      if (!part.empty() || i == 0) indices.at(i) = index_of(part, lengths.at(i), word);
      if (part.size() == rest.size()) return indices;
      rest.remove_prefix(part.size() + 1);
    }
    throw fault(fmt::format("`{:.40}` is not a corner of a face", utf8_text(word)));
  }

  // Indices count from 1; negative ones from the statement back, of which there are `size` before it.
  [[nodiscard]] std::int32_t index_of(std::string_view part, std::size_t size, std::string_view word) const {
    if (part.starts_with('+')) part.remove_prefix(1);
    const auto index = parse_whole_of<std::int32_t>(part);
    if (!index || *index == 0)
      throw fault(fmt::format("`{:.40}` is not a corner of a face: indices are whole numbers, not 0", utf8_text(word)));
    const std::int64_t found = *index < 0 ? static_cast<std::int64_t>(size) + *index : *index - 1;
    if (found < 0) throw fault(fmt::format("`{:.40}` is out of range: only {} are before it", word, size));
    return static_cast<std::int32_t>(found);
  }

  void use_material(const std::string& name) {
    const auto [entry, is_new] = numbers_of_names_.emplace(name, static_cast<std::uint32_t>(names_.size()));
    if (is_new) names_.push_back(name);
    material_ = entry->second;
  }

  // One file whose name may have blanks, or several files.
  void read_library(std::string_view rest) {
    const std::filesystem::path folder = text_.path().parent_path();
    if (const auto file = find_named_file(folder, std::string(rest)); !file.empty()) return library_.read(file);
    for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest)) {
      const auto file = find_named_file(folder, std::string(word));
      if (!file.empty()) library_.read(file);
      if (file.empty())
        add_once(model_.warnings, fmt::format("there is no material file `{:.120}`: it is left out", utf8_text(word)));
    }
  }

  void add_face(std::size_t index) {
    const Face& face = faces_[index];
    line_ = face.line;
    if (index % 4096 == 0) throw_if_interrupted();
    const std::size_t end = index + 1 < faces_.size() ? faces_[index + 1].first_corner : corners_.size();
    std::vector<std::uint32_t> ring;
    for (std::size_t i = face.first_corner; i < end; ++i) {
      require_in_range(corners_[i]);
      ring.push_back(vertex_of(corners_[i]));
    }
    for (const std::uint32_t corner : triangles_over(ring)) indices_.push_back(ring[corner]);
    materials_of_triangles_.resize(indices_.size() / 3, face.material);
  }

  void require_in_range(const Corner& corner) const {
    const std::array<std::size_t, 3> lengths{positions_.size(), uvs_.size(), normals_.size()};
    for (std::size_t i = 0; i < 3; ++i) {
      if (corner.at(i) < static_cast<std::int64_t>(lengths.at(i))) continue;
      throw fault(
          fmt::format("`{}` {} is out of range: the file has {}", corner_parts.at(i), corner.at(i) + 1, lengths.at(i)));
    }
    const auto found = unusable_.find(static_cast<std::size_t>(corner[0]));
    if (found == unusable_.end()) return;
    throw fault(fmt::format("the position of line {} is not finite, or beyond {:g} m", found->second, farthest));
  }

  [[nodiscard]] std::vector<std::uint32_t> triangles_over(const std::vector<std::uint32_t>& ring) const {
    if (ring.size() == 3) return {0, 1, 2};
    std::vector<glm::dvec3> positions;
    for (const std::uint32_t vertex : ring) positions.push_back(positions_[positions_of_vertices_[vertex]]);
    if (ring.size() > most_concave_corners && !is_fan(positions))
      throw fault(fmt::format("a concave face of {} corners, more than {}", ring.size(), most_concave_corners));
    return triangulated(positions);
  }

  std::uint32_t vertex_of(const Corner& corner) {
    const auto [entry, is_new] = vertices_of_corners_.emplace(corner, static_cast<std::uint32_t>(vertices_.size()));
    if (!is_new) return entry->second;
    const auto at = [](const auto& values, std::int32_t index) { return values[static_cast<std::size_t>(index)]; };
    Vertex& vertex = vertices_.emplace_back();
    positions_of_vertices_.push_back(static_cast<std::uint32_t>(corner[0]));
    vertex.normal = corner[2] == no_index ? glm::vec3{0.0F} : at(normals_, corner[2]);
    without_normal_ += corner[2] == no_index ? 1 : 0;
    glm::vec2 uv = corner[1] == no_index ? glm::vec2{0.0F} : at(uvs_, corner[1]);
    if (!is_within(glm::dvec3(uv, 0.0), largest_uv)) {
      ++replaced_uvs_;
      uv = glm::vec2{0.0F};
    }
    vertex.uv0 = vertex.uv1 = uv;
    if (static_cast<std::size_t>(corner[0]) < colors_.size()) vertex.color = color_of(at(colors_, corner[0]));
    return entry->second;
  }

  // Rounds positions to 32 bits only once they are near the model.
  void move_positions() {
    WideBounds bounds;
    for (const std::uint32_t position : positions_of_vertices_) bounds.add(positions_[position]);
    model_.origin = origin_for(bounds);
    for (std::size_t i = 0; i < vertices_.size(); ++i)
      vertices_[i].position = glm::vec3{positions_[positions_of_vertices_[i]] - model_.origin};
  }

  // Colours are 0 to 1, or 0 to 255 in files with larger ones.
  [[nodiscard]] glm::vec4 color_of(const glm::vec4& color) const {
    const glm::vec4 scaled = largest_color_ > 1.0F ? glm::vec4(glm::vec3(color) / 255.0F, color.a) : color;
    glm::vec4 out(0.0F);
    for (int c = 0; c < 4; ++c) out[c] = scaled[c] > 0.0F ? std::min(scaled[c], 1.0F) : 0.0F;  // NaN is 0
    return out;
  }

  void warn(std::size_t repaired_normals) {
    const auto count = [&](std::size_t n, std::string_view fault) {
      if (n > 0) add_once(model_.warnings, fmt::format("{} {}", n, fault));
    };
    count(repaired_normals - without_normal_, "normals without a direction were replaced by the triangles' own");
    count(replaced_uvs_, "texture coordinates that are not usable were set to 0");
    if (largest_color_ > 1.0F) add_once(model_.warnings, "vertex colours above 1 are taken for 0 to 255");
    const bool is_faceted = smoothing_groups_.contains("off") || smoothing_groups_.contains("0");
    if (without_normal_ > 0 && (smoothing_groups_.size() > 1 || is_faceted))
      add_once(model_.warnings, "smoothing groups are not read: vertices without a normal are smooth");
  }

  // One mesh per material that faces use, in order of first use.
  void make_meshes() {
    std::vector<std::size_t> meshes(names_.size(), names_.size());
    for (std::size_t t = 0; t < materials_of_triangles_.size(); ++t) {
      std::size_t& mesh = meshes[materials_of_triangles_[t]];
      if (mesh == names_.size()) mesh = start_mesh(materials_of_triangles_[t]);
      std::vector<std::uint32_t>& indices = model_.meshes[mesh].indices;
      indices.insert(indices.end(), &indices_[3 * t], &indices_[3 * t] + 3);
    }
    std::vector<std::uint32_t> owners(vertices_.size(), std::numeric_limits<std::uint32_t>::max());
    std::vector<std::uint32_t> places(vertices_.size());
    for (Mesh& mesh : model_.meshes) take_vertices(mesh, owners, places);
    if (model_.materials.empty()) model_.materials.push_back(material_of(0));
  }

  std::size_t start_mesh(std::uint32_t material) {
    Mesh& mesh = model_.meshes.emplace_back();
    mesh.name = names_[material];
    mesh.material = static_cast<int>(model_.materials.size());
    model_.materials.push_back(material_of(material));
    return model_.meshes.size() - 1;
  }

  // Faces before any `usemtl` have the default material, whatever the libraries have.
  [[nodiscard]] Material material_of(std::uint32_t number) {
    return number == 0 ? MtlLibrary(model_.warnings).material(names_[0]) : library_.material(names_[number]);
  }

  // Gives a mesh its own copies of the vertices that it names, and tangents. owners: the mesh that took a vertex last.
  void take_vertices(Mesh& mesh, std::vector<std::uint32_t>& owners, std::vector<std::uint32_t>& places) const {
    const auto own = static_cast<std::uint32_t>(mesh.material);
    for (std::uint32_t& index : mesh.indices) {
      if (owners[index] != own) {
        owners[index] = own;
        places[index] = static_cast<std::uint32_t>(mesh.vertices.size());
        mesh.vertices.push_back(vertices_[index]);
      }
      index = places[index];
    }
    const Material& material = model_.materials[own];
    compute_tangents(mesh.vertices, mesh.indices,
                     material.normal_map ? material.normal_map->coordinates : TextureCoordinates{});
  }

  WavefrontFile text_;
  Model& model_;
  MtlLibrary library_;
  std::size_t line_ = 0;

  std::vector<glm::dvec3> positions_;
  std::vector<glm::vec3> normals_;
  std::vector<glm::vec2> uvs_;
  std::vector<glm::vec4> colors_;  // of the first positions
  float largest_color_ = 0.0F;
  std::map<std::size_t, std::size_t> unusable_;  // positions, and their lines

  std::vector<std::string> names_;  // of materials; the first is the default's
  std::map<std::string, std::uint32_t> numbers_of_names_;
  std::uint32_t material_ = 0;
  std::set<std::string> smoothing_groups_;

  std::vector<Face> faces_;
  std::vector<Corner> corners_;
  std::size_t triangle_count_ = 0;

  std::map<Corner, std::uint32_t> vertices_of_corners_;
  std::vector<Vertex> vertices_;
  std::vector<std::uint32_t> positions_of_vertices_, indices_, materials_of_triangles_;
  std::size_t without_normal_ = 0, replaced_uvs_ = 0;
};

}  // namespace

Model load_obj(const std::filesystem::path& file) {
  Model model;
  ObjReader(file, model).read();
  return model;
}

}  // namespace footprint

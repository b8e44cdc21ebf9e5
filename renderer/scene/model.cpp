// Reads models: glTF by renderer/scene/gltf, and OBJ files with their materials here.
#include "renderer/scene/model.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <string_view>

#include "renderer/core/bytes.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/names.hpp"
#include "renderer/core/numbers.hpp"
#include "renderer/core/process.hpp"
#include "renderer/scene/geometry.hpp"
#include "renderer/scene/origin.hpp"
#include "renderer/scene/tangents.hpp"

namespace footprint {
namespace {

constexpr std::uint64_t largest_file = std::uint64_t{1} << 31U;
constexpr std::size_t most_triangles = std::size_t{1} << 26U;
constexpr float farthest = 1e15F;  // metres, as for glTF

constexpr std::string_view blanks = " \t\r\v\f";

/// Takes the next word off a line; empty at its end.
std::string_view next_word(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(blanks));
  line.remove_prefix(word.size());
  return word;
}

/// Reads statement by statement.
class ObjReader {
 public:
  explicit ObjReader(const std::filesystem::path& file) : file_(file) { mesh_.name = file.stem().string(); }

  Mesh read(std::string_view text) {
    while (!text.empty()) {
      ++line_number_;
      const std::size_t end = std::min(text.find('\n'), text.size());
      statement(text.substr(0, end));
      text.remove_prefix(std::min(end + 1, text.size()));
      if (line_number_ % 4096 == 0) throw_if_interrupted();
    }
    move_positions();
    repair_normals(mesh_.vertices, mesh_.indices);
    compute_tangents(mesh_.vertices, mesh_.indices, {});
    return std::move(mesh_);
  }

  /// What the mesh's positions are measured from.
  [[nodiscard]] const glm::dvec3& origin() const { return origin_; }

 private:
  /// Indices of a corner's position, texture coordinates and normal; -1: none.
  using Corner = std::array<int, 3>;

  [[nodiscard]] Error fault(const std::string& message) const {
    return {ErrorKind::usage, fmt::format("{}:{}", file_.string(), line_number_), message,
            "repair the file or export it again"};
  }

  void statement(std::string_view line) {
    line = line.substr(0, line.find('#'));
    const std::string_view keyword = next_word(line);
    if (keyword == "v") positions_.push_back(numbers<3, double>(line));
    if (keyword == "vn") normals_.push_back(numbers<3, float>(line));
    if (keyword == "vt") {
      const auto uv = numbers<2, float>(line);
      uvs_.emplace_back(uv.x, 1.0F - uv.y);
    }
    if (keyword == "f") face(line);
  }

  template <int Count, class Number>
  [[nodiscard]] glm::vec<Count, Number> numbers(std::string_view& line) const {
    glm::vec<Count, Number> values{0};
    for (int i = 0; i < Count; ++i) {
      const std::string_view word = next_word(line);
      const auto value = parse_whole_of<Number>(word);
      if (!value || !(std::abs(*value) <= static_cast<Number>(farthest)))
        throw fault(fmt::format("`{:.40}` is not a number within 1e15", word));
      values[i] = *value;
    }
    return values;
  }

  void face(std::string_view line) {
    std::vector<std::uint32_t> corners;
    for (std::string_view word = next_word(line); !word.empty(); word = next_word(line)) {
      corners.push_back(vertex_of(corner(word)));
    }
    if (corners.size() < 3) throw fault(fmt::format("a face of {} corners", corners.size()));
    if (mesh_.indices.size() / 3 + corners.size() - 2 > most_triangles) throw fault("more than 2^26 triangles");
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
      mesh_.indices.insert(mesh_.indices.end(), {corners[0], corners[i], corners[i + 1]});
    }
  }

  /// A corner as written: "7", "7/2", "7//3" or "7/2/3".
  [[nodiscard]] Corner corner(const std::string_view word) const {
    const std::array<std::size_t, 3> lengths{positions_.size(), uvs_.size(), normals_.size()};
    Corner indices{-1, -1, -1};
    std::string_view rest = word;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::string_view part = rest.substr(0, rest.find('/'));
      if (!part.empty() || i == 0) indices[i] = index_of(part, lengths[i], word);
      if (part.size() == rest.size()) return indices;
      rest.remove_prefix(part.size() + 1);
    }
    throw fault(fmt::format("`{:.40}` is not a corner of a face", word));
  }

  [[nodiscard]] int index_of(std::string_view part, std::size_t size, std::string_view word) const {
    const auto index = parse_whole_of<std::int64_t>(part);
    const auto count = static_cast<std::int64_t>(size);
    const std::int64_t found = !index ? -1 : *index < 0 ? count + *index : *index - 1;
    if (found < 0 || found >= count) throw fault(fmt::format("`{:.40}` is not a vertex of an earlier line", word));
    return static_cast<int>(found);
  }

  std::uint32_t vertex_of(const Corner& corner) {
    const auto [entry, is_new] =
        vertices_of_corners_.emplace(corner, static_cast<std::uint32_t>(mesh_.vertices.size()));
    if (!is_new) return entry->second;
    const auto at = [](const auto& values, int index) { return values[static_cast<std::size_t>(index)]; };
    Vertex vertex;
    vertex.normal = corner[2] < 0 ? glm::vec3{0.0F} : at(normals_, corner[2]);
    vertex.uv0 = vertex.uv1 = corner[1] < 0 ? glm::vec2{0.0F} : at(uvs_, corner[1]);
    mesh_.vertices.push_back(vertex);
    position_of_vertex_.push_back(static_cast<std::size_t>(corner[0]));
    return entry->second;
  }

  /// Rounds positions to 32 bits only once they are near the mesh.
  void move_positions() {
    WideBounds bounds;
    for (const std::size_t position : position_of_vertex_) bounds.add(positions_[position]);
    origin_ = origin_for(bounds);
    for (std::size_t i = 0; i < mesh_.vertices.size(); ++i)
      mesh_.vertices[i].position = glm::vec3{positions_[position_of_vertex_[i]] - origin_};
  }

  std::filesystem::path file_;
  std::size_t line_number_ = 0;
  std::vector<glm::dvec3> positions_;
  std::vector<std::size_t> position_of_vertex_;
  std::vector<glm::vec3> normals_;
  std::vector<glm::vec2> uvs_;
  std::map<Corner, std::uint32_t> vertices_of_corners_;
  Mesh mesh_;
  glm::dvec3 origin_{0.0};
};

}  // namespace

std::size_t find_choice(const ModelChoice& choice, const std::string& wanted) {
  if (const auto found = find_entry(wanted, choice.names)) return *found;
  throw Error(ErrorKind::usage, choice.kind, fmt::format("the model has none that is called `{:.80}`", wanted),
              choice.names.empty() ? fmt::format("it has no {} to choose: leave it out", choice.kind)
                                   : suggestion(wanted, choice.names) + fmt::format("; or a number from 0"));
}

bool names_model(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  return extension == ".gltf" || extension == ".glb" || extension == ".obj";
}

Model load_model(const std::filesystem::path& file, const ModelSelection& selection) {
  if (lower_extension(file) != ".obj") return load_gltf(file, selection);
  if (!selection.empty()) {
    throw Error(ErrorKind::usage, file.string(), "an OBJ file has no scenes, cameras or variants to choose from",
                "leave the choice out, or give a glTF file");
  }
  return load_obj(file);
}

Model load_obj(const std::filesystem::path& file) {
  const std::vector<std::uint8_t> bytes = read_file_bytes(file, largest_file);
  Model model;
  ObjReader reader(file);
  Mesh mesh = reader.read({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  model.origin = reader.origin();
  if (!mesh.indices.empty()) model.meshes.push_back(std::move(mesh));
  Material material;
  material.name = file.stem().string();
  material.roughness = 0.5F;
  material.metallic = 0.0F;
  model.materials.push_back(std::move(material));
  return model;
}

}  // namespace footprint

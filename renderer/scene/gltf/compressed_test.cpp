// Geometry compressed by Draco and by meshoptimizer: twins of plain files, encoded by the libraries themselves, load as
// those do; what is damaged gives an error.
#include <draco/compression/expert_encode.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

#include "renderer/scene/model.hpp"
#include "tests/support/gltf_builder.hpp"

namespace footprint {
namespace {

using test::GltfBuilder;
using test::usage_error;
using Bytes = std::vector<std::uint8_t>;

// A bumpy grid of side x side squares.
struct Bumps {
  std::vector<float> positions, normals, uvs;
  std::vector<std::uint16_t> indices;

  explicit Bumps(int side) {
    for (int y = 0; y <= side; ++y) {
      for (int x = 0; x <= side; ++x) {
        const float u = static_cast<float>(x) / static_cast<float>(side);
        const float v = static_cast<float>(y) / static_cast<float>(side);
        const glm::vec3 normal = glm::normalize(glm::vec3(std::sin(9.0F * u), std::cos(7.0F * v), 2.0F));
        positions.insert(positions.end(), {u, v, 0.1F * std::sin(8.0F * u * v)});
        normals.insert(normals.end(), {normal.x, normal.y, normal.z});
        uvs.insert(uvs.end(), {u, 1.0F - v});
      }
    }
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        const auto at = static_cast<std::uint16_t>(y * (side + 1) + x);
        const auto up = static_cast<std::uint16_t>(at + side + 1);
        const auto next = static_cast<std::uint16_t>(at + 1), across = static_cast<std::uint16_t>(up + 1);
        for (const std::uint16_t i : {at, next, up, next, across, up}) indices.push_back(i);
      }
    }
  }
  [[nodiscard]] std::size_t count() const { return positions.size() / 3; }
};

// The file without compression. Accessors 0 to 3: positions, normals, texture coordinates, indices.
GltfBuilder plain(const Bumps& bumps) {
  GltfBuilder file;
  file.add_floats(bumps.positions, "VEC3");
  file.add_floats(bumps.normals, "VEC3");
  file.add_floats(bumps.uvs, "VEC2");
  file.add_indices(bumps.indices);
  file.json["meshes"] = {
      {{"primitives", {{{"attributes", {{"POSITION", 0}, {"NORMAL", 1}, {"TEXCOORD_0", 2}}}, {"indices", 3}}}}}};
  file.json["nodes"] = {{{"mesh", 0}}};
  return file;
}

Model loaded(const GltfBuilder& file) { return load_gltf(file.write(), {}); }

void use(GltfBuilder& file, const char* extension) {
  file.json["extensionsUsed"] = {extension};
  file.json["extensionsRequired"] = {extension};
}

int add_draco_attribute(draco::Mesh& mesh, draco::GeometryAttribute::Type type, const std::vector<float>& values,
                        int components) {
  const auto width = static_cast<std::size_t>(components);
  draco::GeometryAttribute attribute;
  attribute.Init(type, nullptr, static_cast<std::int8_t>(components), draco::DT_FLOAT32, false,
                 static_cast<std::int64_t>(sizeof(float) * width), 0);
  const int id = mesh.AddAttribute(attribute, true, static_cast<std::uint32_t>(values.size() / width));
  for (std::size_t i = 0; i < values.size() / width; ++i)
    mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(static_cast<std::uint32_t>(i)),
                                          &values[width * i]);
  return id;
}

constexpr int quantization = 14;  // bits

// The mesh as Draco stores it, and the numbers of its attributes.
struct DracoBytes {
  Bytes bytes;
  std::array<int, 3> ids{};  // POSITION, NORMAL, TEXCOORD_0
  std::size_t points = 0;
};

DracoBytes draco_bytes(const Bumps& bumps, draco::MeshEncoderMethod method) {
  draco::Mesh mesh;
  mesh.set_num_points(static_cast<std::uint32_t>(bumps.count()));
  for (std::size_t i = 0; i < bumps.indices.size(); i += 3) {
    mesh.AddFace({draco::PointIndex(bumps.indices[i]), draco::PointIndex(bumps.indices[i + 1]),
                  draco::PointIndex(bumps.indices[i + 2])});
  }
  const std::array<int, 3> made{add_draco_attribute(mesh, draco::GeometryAttribute::POSITION, bumps.positions, 3),
                                add_draco_attribute(mesh, draco::GeometryAttribute::NORMAL, bumps.normals, 3),
                                add_draco_attribute(mesh, draco::GeometryAttribute::TEX_COORD, bumps.uvs, 2)};
  draco::ExpertEncoder encoder(mesh);
  encoder.SetEncodingMethod(method);
  encoder.SetTrackEncodedProperties(true);
  DracoBytes out;
  for (std::size_t i = 0; i < made.size(); ++i) {
    encoder.SetAttributeQuantization(made[i], quantization);
    out.ids[i] = static_cast<int>(mesh.attribute(made[i])->unique_id());
  }
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeToBuffer(&buffer).ok());
  out.bytes.assign(buffer.data(), buffer.data() + buffer.size());
  out.points = encoder.num_encoded_points();
  return out;
}

// A file with only the Draco data.
GltfBuilder draco_file(const Bumps& bumps, const DracoBytes& encoded) {
  GltfBuilder file;
  const int view = file.add_view(encoded.bytes);
  const auto accessor = [&](int type, std::size_t count, const char* shape) {
    file.json["accessors"].push_back({{"componentType", type}, {"count", count}, {"type", shape}});
  };
  accessor(5126, encoded.points, "VEC3");
  accessor(5126, encoded.points, "VEC3");
  accessor(5126, encoded.points, "VEC2");
  accessor(5123, bumps.indices.size(), "SCALAR");
  const nlohmann::json extension = {
      {"bufferView", view},
      {"attributes", {{"POSITION", encoded.ids[0]}, {"NORMAL", encoded.ids[1]}, {"TEXCOORD_0", encoded.ids[2]}}}};
  file.json["meshes"] = {{{"primitives",
                           {{{"attributes", {{"POSITION", 0}, {"NORMAL", 1}, {"TEXCOORD_0", 2}}},
                             {"indices", 3},
                             {"extensions", {{"KHR_draco_mesh_compression", extension}}}}}}}};
  file.json["nodes"] = {{{"mesh", 0}}};
  use(file, "KHR_draco_mesh_compression");
  return file;
}

// The corners of all triangles, each triangle from its least corner on, in an order that does not depend on how they
// are stored.
std::vector<std::array<Vertex, 3>> triangles_in_order(const Mesh& mesh) {
  const auto key = [](const Vertex& v) {
    return std::pair(std::lround(64.0F * v.uv0.x), std::lround(64.0F * v.uv0.y));
  };
  std::vector<std::array<Vertex, 3>> triangles;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    std::array<Vertex, 3> corners{mesh.vertices[mesh.indices[i]], mesh.vertices[mesh.indices[i + 1]],
                                  mesh.vertices[mesh.indices[i + 2]]};
    std::ranges::rotate(corners, std::ranges::min_element(corners, {}, key));
    triangles.push_back(corners);
  }
  std::ranges::sort(triangles, {}, [&](const auto& t) { return std::tuple(key(t[0]), key(t[1]), key(t[2])); });
  return triangles;
}

// Same triangles, same way round, every corner within `tolerance`.
void expect_same_surface(const Model& found, const Model& expected, float tolerance) {
  ASSERT_EQ(found.meshes.size(), 1U);
  const auto a = triangles_in_order(found.meshes[0]), b = triangles_in_order(expected.meshes[0]);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      EXPECT_LE(glm::distance(a[i].at(corner).position, b[i].at(corner).position), tolerance) << i;
      EXPECT_LE(glm::distance(a[i].at(corner).normal, b[i].at(corner).normal), tolerance) << i;
      EXPECT_LE(glm::distance(a[i].at(corner).uv0, b[i].at(corner).uv0), tolerance) << i;
    }
  }
}

TEST(GltfDraco, TwinsLoadAsThePlainFileDoes) {
  const Bumps bumps(8);
  const Model expected = loaded(plain(bumps));
  for (const auto method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING})
    expect_same_surface(loaded(draco_file(bumps, draco_bytes(bumps, method))), expected, 4.0F / (1 << quantization));
}

// A file that somebody else compressed, and the same model as it was before. Degenerate triangles are gone from it.
TEST(GltfDraco, ThePackagesEngineHasTheSurfaceOfThePlainOne) {
  const std::filesystem::path models = "/usr/share/assimp/models/glTF2";
  if (!std::filesystem::exists(models)) GTEST_SKIP() << "the package assimp-testmodels is not installed";
  const auto measured = [](const std::filesystem::path& file) {
    double area = 0.0;
    glm::vec3 low(1e30F), high(-1e30F);
    for (const Mesh& mesh : load_gltf(file, {}).meshes) {
      for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const auto corner = [&](std::size_t k) { return glm::dvec3(mesh.vertices[mesh.indices[i + k]].position); };
        area += 0.5 * glm::length(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
      }
      for (const Vertex& vertex : mesh.vertices) {
        low = glm::min(low, vertex.position);
        high = glm::max(high, vertex.position);
      }
    }
    return std::tuple(area, low, high);
  };
  const auto [area, low, high] = measured(models / "draco/2CylinderEngine.gltf");
  const auto [plain_area, plain_low, plain_high] = measured(models / "2CylinderEngine-glTF-Binary/2CylinderEngine.glb");
  EXPECT_NEAR(area / plain_area, 1.0, 1e-3);
  const float size = glm::distance(plain_low, plain_high);
  EXPECT_LE(glm::distance(low, plain_low), 1e-3F * size);
  EXPECT_LE(glm::distance(high, plain_high), 1e-3F * size);
}

TEST(GltfDraco, WhatDoesNotFitIsAnError) {
  const Bumps bumps(4);
  const DracoBytes encoded = draco_bytes(bumps, draco::MESH_EDGEBREAKER_ENCODING);
  const auto error = [&](auto change) {
    GltfBuilder file = draco_file(bumps, encoded);
    change(file);
    const std::string message = usage_error([&] { return loaded(file); });
    EXPECT_NE(message.find("primitive 0"), std::string::npos) << message;
    return message;
  };
  const auto extension = [](GltfBuilder& file) -> nlohmann::json& {
    return file.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"];
  };
  const auto has = [](const std::string& text, const char* words) { return text.find(words) != std::string::npos; };
  EXPECT_TRUE(has(error([](GltfBuilder& f) { f.json["accessors"][0]["count"] = 24; }), "accessors[0] has 24"));
  EXPECT_TRUE(has(error([](GltfBuilder& f) { f.json["accessors"][3]["count"] = 93; }), "accessors[3] has 93"));
  EXPECT_TRUE(has(error([](GltfBuilder& f) { f.json["accessors"][2]["type"] = "VEC3"; }), "2 components"));
  EXPECT_TRUE(has(error([&](GltfBuilder& f) { extension(f)["attributes"]["NORMAL"] = 77; }), "no attribute 77"));
  EXPECT_TRUE(has(error([](GltfBuilder& f) { f.json["meshes"][0]["primitives"][0]["mode"] = 5; }), "no strips"));
  EXPECT_TRUE(has(error([](GltfBuilder& f) { f.json["meshes"][0]["primitives"][0].erase("indices"); }), "indices"));
  EXPECT_TRUE(has(error([](GltfBuilder& f) { f.json["bufferViews"][0]["byteLength"] = 30; }), "cannot be decoded"));
  EXPECT_TRUE(has(error([](GltfBuilder& f) { std::ranges::fill(f.data, 0); }), "cannot be decoded"));
}

// Replaces a buffer view by its bytes compressed; what is decoded belongs to a buffer without bytes.
void compress_view(GltfBuilder& file, std::size_t view, std::size_t count, const char* mode, const Bytes& bytes,
                   const char* filter = "NONE") {
  const std::size_t length = file.json["bufferViews"][view]["byteLength"];
  const int stored = file.add_view(bytes);
  const nlohmann::json place = file.json["bufferViews"][static_cast<std::size_t>(stored)];
  file.json["bufferViews"].erase(static_cast<std::size_t>(stored));
  file.json["bufferViews"][view] = {{"buffer", 1},
                                    {"byteOffset", 0},
                                    {"byteLength", length},
                                    {"extensions",
                                     {{"EXT_meshopt_compression",
                                       {{"buffer", 0},
                                        {"byteOffset", place["byteOffset"]},
                                        {"byteLength", bytes.size()},
                                        {"byteStride", length / count},
                                        {"count", count},
                                        {"mode", mode},
                                        {"filter", filter}}}}}};
}

Bytes encoded_vertices(const void* values, std::size_t count, std::size_t stride) {
  Bytes bytes(meshopt_encodeVertexBufferBound(count, stride));
  bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), values, count, stride));
  return bytes;
}

GltfBuilder meshopt_file(const Bumps& bumps, const char* index_mode) {
  GltfBuilder file = plain(bumps);
  const std::size_t count = bumps.count(), indices = bumps.indices.size();
  compress_view(file, 0, count, "ATTRIBUTES", encoded_vertices(bumps.positions.data(), count, 12));
  compress_view(file, 1, count, "ATTRIBUTES", encoded_vertices(bumps.normals.data(), count, 12));
  compress_view(file, 2, count, "ATTRIBUTES", encoded_vertices(bumps.uvs.data(), count, 8));
  Bytes bytes(
      std::max(meshopt_encodeIndexBufferBound(indices, count), meshopt_encodeIndexSequenceBound(indices, count)));
  const bool triangles = std::string_view(index_mode) == "TRIANGLES";
  bytes.resize(triangles ? meshopt_encodeIndexBuffer(bytes.data(), bytes.size(), bumps.indices.data(), indices)
                         : meshopt_encodeIndexSequence(bytes.data(), bytes.size(), bumps.indices.data(), indices));
  compress_view(file, 3, indices, index_mode, bytes);
  use(file, "EXT_meshopt_compression");
  return file;
}

// `text` and `glb` write the one buffer that has bytes; the other is only named.
std::filesystem::path write_with_fallback(const GltfBuilder& file) {
  nlohmann::json document = nlohmann::json::parse(file.text());
  document["buffers"].push_back(
      {{"byteLength", 1 << 20}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
  return test::write_file("compressed.gltf", document.dump());
}

TEST(GltfMeshopt, TwinsLoadAsThePlainFileDoes) {
  const Bumps bumps(8);
  const Model expected = loaded(plain(bumps));
  for (const char* mode : {"TRIANGLES", "INDICES"})
    expect_same_surface(load_gltf(write_with_fallback(meshopt_file(bumps, mode)), {}), expected, 0.0F);
}

TEST(GltfMeshopt, GlbFilesKeepTheirBinaryChunk) {
  const Bumps bumps(8);
  GltfBuilder file = meshopt_file(bumps, "TRIANGLES");
  const std::string whole = file.glb();
  std::uint32_t length = 0;
  std::memcpy(&length, &whole[12], 4);
  nlohmann::json document = nlohmann::json::parse(whole.substr(20, length));
  document["buffers"].push_back(
      {{"byteLength", 1 << 20}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
  std::string text = document.dump();
  while (text.size() % 4 != 0) text += ' ';
  std::string out = whole.substr(0, 20) + text + whole.substr(20 + length);
  const auto set = [&](std::size_t at, std::size_t value) {
    const auto word = static_cast<std::uint32_t>(value);
    std::memcpy(&out[at], &word, 4);
  };
  set(8, out.size());
  set(12, text.size());
  expect_same_surface(load_gltf(test::write_file("compressed.glb", out), {}), loaded(plain(bumps)), 0.0F);
}

TEST(GltfMeshopt, FiltersAreUndone) {
  const Bumps bumps(8);
  const std::size_t count = bumps.count();
  GltfBuilder file = meshopt_file(bumps, "TRIANGLES");
  Bytes filtered(count * 12);
#if MESHOPTIMIZER_VERSION >= 200
  meshopt_encodeFilterExp(filtered.data(), count, 12, 16, bumps.positions.data(), meshopt_EncodeExpSharedVector);
#else
  meshopt_encodeFilterExp(filtered.data(), count, 12, 16, bumps.positions.data());
#endif
  compress_view(file, 0, count, "ATTRIBUTES", encoded_vertices(filtered.data(), count, 12), "EXPONENTIAL");
  std::vector<float> four;
  for (std::size_t i = 0; i < count; ++i)
    four.insert(four.end(), {bumps.normals[3 * i], bumps.normals[3 * i + 1], bumps.normals[3 * i + 2], 0.0F});
  filtered.resize(count * 8);
  meshopt_encodeFilterOct(filtered.data(), count, 8, 14, four.data());
  file.json["bufferViews"][1]["byteLength"] = count * 8;
  compress_view(file, 1, count, "ATTRIBUTES", encoded_vertices(filtered.data(), count, 8), "OCTAHEDRAL");
  file.json["bufferViews"][1]["byteStride"] = 8;
  file.json["accessors"][1]["componentType"] = 5122;
  file.json["accessors"][1]["normalized"] = true;
  expect_same_surface(load_gltf(write_with_fallback(file), {}), loaded(plain(bumps)), 1e-3F);
}

TEST(GltfMeshopt, WhatDoesNotFitIsAnError) {
  const Bumps bumps(4);
  const auto error = [&](auto change) {
    GltfBuilder file = meshopt_file(bumps, "TRIANGLES");
    change(file, file.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]);
    const std::string message = usage_error([&] { return load_gltf(write_with_fallback(file), {}); });
    EXPECT_NE(message.find("bufferViews[0]"), std::string::npos) << message;
    return message;
  };
  using Json = nlohmann::json;
  const auto has = [](const std::string& text, const char* words) { return text.find(words) != std::string::npos; };
  EXPECT_TRUE(has(error([](GltfBuilder&, Json& e) { e["count"] = 24; }), "are not the 300 bytes"));
  EXPECT_TRUE(has(error([](GltfBuilder&, Json& e) { e["mode"] = "POINTS"; }), "none of ATTRIBUTES"));
  EXPECT_TRUE(has(error([](GltfBuilder&, Json& e) { e["filter"] = "OCTAHEDRAL"; }), "does not go with"));
  EXPECT_TRUE(has(error([](GltfBuilder&, Json& e) { e["byteLength"] = 1 << 20; }), "within its buffer"));
  EXPECT_TRUE(has(error([](GltfBuilder&, Json& e) { e["buffer"] = 7; }), "out of range"));
  EXPECT_TRUE(has(error([](GltfBuilder&, Json& e) { e.erase("count"); }), "is missing"));
  EXPECT_TRUE(has(error([](GltfBuilder& f, Json&) {
                    f.data[f.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]["byteOffset"]] = 0;
                  }),
                  "damaged"));
  EXPECT_TRUE(
      has(error([](GltfBuilder& f, Json&) { f.json["bufferViews"][0].erase("extensions"); }), "no bytes of its own"));
}

// Compressed bytes with some of them changed: each file loads with sound indices, or is refused.
template <typename Write>
void expect_errors_alone(const GltfBuilder& whole, std::size_t first, std::size_t length, Write write) {
  std::mt19937 random(20);
  int refused = 0;
  for (int i = 0; i < 300; ++i) {
    GltfBuilder file = whole;
    for (std::size_t change = 0; change <= random() % 3; ++change)
      file.data[first + random() % length] = static_cast<std::uint8_t>(random());
    const auto path = write(file);
    try {
      for (const Mesh& mesh : load_gltf(path, {}).meshes)
        for (const std::uint32_t index : mesh.indices) ASSERT_LT(index, mesh.vertices.size());
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage) << error.what();
      ++refused;
    }
  }
  EXPECT_GT(refused, 10);
}

TEST(GltfDraco, DamagedBytesLoadOrAreRefused) {
  const Bumps bumps(4);
  for (const auto method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
    const DracoBytes encoded = draco_bytes(bumps, method);
    expect_errors_alone(draco_file(bumps, encoded), 0, encoded.bytes.size(), [](auto& file) { return file.write(); });
  }
}

TEST(GltfMeshopt, DamagedBytesLoadOrAreRefused) {
  const GltfBuilder file = meshopt_file(Bumps(4), "TRIANGLES");
  const std::size_t first = file.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]["byteOffset"];
  expect_errors_alone(file, first, file.data.size() - first, write_with_fallback);
}

}  // namespace
}  // namespace footprint

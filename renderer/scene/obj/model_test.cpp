// Wavefront OBJ files: what is read, and what is refused with its line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "renderer/core/error.hpp"
#include "renderer/scene/model.hpp"
#include "tests/support/fresh_folder.hpp"

namespace footprint {
namespace {

std::filesystem::path write_obj(const std::string& text) {
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  const auto file = test::process_folder() / (std::string(test->name()) + ".obj");
  std::ofstream(file, std::ios::binary) << text;
  return file;
}

TEST(ObjModel, ReadsPositionsNormalsCoordinatesAndFaces) {
  const Model model =
      load_obj(write_obj("# a comment\nmtllib none.mtl\no square\n\nv 0 0 0\nv 1 0 0 # another\nv 1 1 0\r\nv 0 1 0\nvt "
                         "0 0\nvt 1 0\nvt 1 1\n"
                         "vt 0 1\nvn 0 0 2\ns off\nf 1/1/1 2/2/1 3/3/1 4/4/1\n"));
  ASSERT_EQ(model.meshes.size(), 1U);
  const Mesh& mesh = model.meshes.front();
  ASSERT_EQ(mesh.vertices.size(), 4U);
  EXPECT_THAT(mesh.indices, ::testing::ElementsAre(0, 1, 2, 0, 2, 3));
  EXPECT_EQ(mesh.vertices[2].position, glm::vec3(1, 1, 0));
  EXPECT_EQ(mesh.vertices[2].uv0, glm::vec2(1, 0));  // v points down
  EXPECT_EQ(mesh.vertices[0].normal, glm::vec3(0, 0, 1));
  EXPECT_EQ(mesh.vertices[0].tangent, glm::vec4(1, 0, 0, 1));
  ASSERT_EQ(model.materials.size(), 1U);
  EXPECT_EQ(model.materials.front().metallic, 0.0F);
}

TEST(ObjModel, CountsNegativeIndicesFromTheEndAndSmoothsNormals) {
  const Model model = load_obj(write_obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 0 0 1\nf 1//  2// -1//\nf 1 3 2\n"));
  const Mesh& mesh = model.meshes.front();
  EXPECT_THAT(mesh.indices, ::testing::ElementsAre(0, 1, 2, 0, 1, 3, 0, 2, 1));
  for (const Vertex& vertex : mesh.vertices) EXPECT_NEAR(glm::length(vertex.normal), 1.0F, 1e-6F);
}

TEST(ObjModel, MayHoldNoTriangle) { EXPECT_TRUE(load_obj(write_obj("v 0 0 0\n")).meshes.empty()); }

void expect_fault(const std::string& text, const std::string& place, const std::string& message) {
  const auto file = write_obj(text);
  try {
    (void)load_obj(file);
    ADD_FAILURE() << text;
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    EXPECT_THAT(error.what(), ::testing::HasSubstr(file.string() + place));
    EXPECT_THAT(error.what(), ::testing::HasSubstr(message));
  }
}

TEST(ObjModel, NamesTheLineOfAFault) {
  const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  expect_fault(three + "f 1 2 4\n", ":4", "`v` 4 is out of range: the file has 3");
  expect_fault(three + "f 1 2 0\n", ":4", "`0` is not a corner");
  expect_fault(three + "f 1 2 -4\n", ":4", "`-4` is out of range: only 3 are before it");
  expect_fault("f -1 -2 -3\n" + three, ":1", "`-1` is out of range");
  expect_fault(three + "f 1 2\n", ":4", "a face of 2 corners");
  expect_fault(three + "f 1/1 2/1 3/1\n", ":4", "`vt` 1 is out of range: the file has 0");
  expect_fault(three + "f 1/2/3/4 2 3\n", ":4", "1/2/3/4");
  expect_fault(three + "f a b c\n", ":4", "`a` is not a corner");
  expect_fault("v 0 0\n", ":1", "2 of at least 3 numbers");
  expect_fault("v 1 2 3 4 5\n", ":1", "5 numbers");
  expect_fault("v 0 1x 0\n", ":1", "`1x` is not a number");
  expect_fault("v 0,5 1 0\n", ":1", "`0,5` has a comma");
  expect_fault("v 0 1 0\nvn 0 0 1\nvt 0,25 1\n", ":3", "`0,25` has a comma");
  expect_fault("f 99999999999999999999 1 1\n", ":1", "is not a corner");
  expect_fault("", "", "the file is empty");
}

TEST(ObjModel, RefusesUnusablePositionsOnlyWhereFacesUseThem) {
  const std::string unused = "v nan -nan nan\nv 1.#IND 0 -1.#QNAN0\nv 0 1e30 0\nv 0 0 0 0\n";
  const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  EXPECT_EQ(load_obj(write_obj(unused + three + "f 5 6 7\n")).meshes.at(0).vertices.size(), 3U);
  for (int i = 1; i <= 4; ++i) {
    expect_fault(unused + three + "f 5 6 " + std::to_string(i) + "\n", ":8",
                 "the position of line " + std::to_string(i) + " is not finite, or beyond 1e+15 m");
  }
}

void expect_same(const std::string& text, const Mesh& wanted) {
  const Model model = load_obj(write_obj(text));
  ASSERT_EQ(model.meshes.size(), 1U) << text;
  const Mesh& mesh = model.meshes.front();
  EXPECT_EQ(mesh.indices, wanted.indices) << text;
  ASSERT_EQ(mesh.vertices.size(), wanted.vertices.size()) << text;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    EXPECT_EQ(mesh.vertices[i].position, wanted.vertices[i].position) << text;
    EXPECT_EQ(mesh.vertices[i].normal, wanted.vertices[i].normal) << text;
    EXPECT_EQ(mesh.vertices[i].uv0, wanted.vertices[i].uv0) << text;
    EXPECT_EQ(mesh.vertices[i].color, wanted.vertices[i].color) << text;
  }
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

TEST(ObjModel, ReadsOneSquareHoweverItIsWritten) {
  const std::string corners = "v 0 -0.5 0\nv 0.5 0 0\nv 0 0.5 0\nv -0.5 0 0\n";
  const std::string uvs = "vt 0 0\nvt 1 0\nvt 1 0\nvt 0 0\n", face = "f 1/1 2/2 3/3 4/4\n",
                    plain = corners + uvs + face;
  const Mesh wanted = load_obj(write_obj(plain)).meshes.at(0);
  expect_same("\xEF\xBB\xBF" + plain, wanted);
  for (const char* end : {"\r", "\r\n", "\n\n", "  \t\n", " # a comment \\\n", "#glued\n", "\n#\n"})
    expect_same(replaced(plain, "\n", end), wanted);
  expect_same(plain.substr(0, plain.size() - 1), wanted);
  for (const char* cut : {" \\\n", " \\\r\n", " \\\r", " \\ \n\t", " \\\n\\\n"})
    expect_same(replaced(plain, " ", cut), wanted);
  expect_same(replaced(plain, " ", "\t"), wanted);
  expect_same(face + corners + uvs, wanted);
  expect_same(corners + "v nan 0 0\n" + uvs + "f -5/-4 -4/-3 -3/-2 -2/-1\n", wanted);
  expect_same(replaced(plain, " 0.5", " +0.5"), wanted);
  expect_same(replaced(plain, "0.5", "5.0E-1"), wanted);
  expect_same(replaced(plain, "0.5", ".5"), wanted);
  expect_same(replaced(plain, " 0 0.5 0", " 0 1 1e-60 2"), wanted);
  expect_same(corners + "vt 0\nvt 1\nvt 1\nvt 0\n" + face, wanted);
  expect_same(replaced(plain, "vt 1 0", "vt 1 0 0.5"), wanted);
  expect_same(replaced(plain, "f ", "fo "), wanted);
  expect_same(replaced(plain, "/4", "/4/"), wanted);
  expect_same("o a # b\ng a#b\ns 1\nl 1 2\np 1\n" + plain, wanted);
}

TEST(ObjModel, NamesTheEncodingOfForeignText) {
  const auto wide = [](const std::string& start, std::size_t zeros_before, std::size_t zeros_after) {
    std::string out = start;
    for (const char c : std::string("v 0 0 0\nv 1 0 0\n"))
      out += std::string(zeros_before, '\0') + c + std::string(zeros_after, '\0');
    return out;
  };
  expect_fault(wide("\xFF\xFE", 0, 1), "", "is UTF-16 text");
  expect_fault(wide("\xFE\xFF", 1, 0), "", "is UTF-16 text");
  expect_fault(wide("", 0, 1), "", "is UTF-16 text without a byte order mark");
  expect_fault(wide(std::string("\xFF\xFE\0\0", 4), 0, 3), "", "is UTF-32 text");
  expect_fault("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n" + std::string(1, '\0') + "\n", "", "has bytes of 0");
}

// A ring of quads, with and without a seam of texture coordinates, as indices and as one material per half.
std::string ring(bool seam, bool split) {
  std::string text, faces;
  for (int i = 0; i < 8; ++i) {
    const double angle = i * 0.7853981633974483;
    for (const int y : {-1, 1})
      text += fmt::format("v {} {} {}\nvt {} {}\n", std::sin(angle), y, std::cos(angle), i, y);
  }
  text += "vt 8 -1\nvt 8 1\n";
  for (int i = 0; i < 8; ++i) {
    const int a = 2 * i + 1, b = 2 * ((i + 1) % 8) + 1, t = seam ? a + 2 : b;
    if (split && i % 4 == 0) faces += i == 0 ? "usemtl near\n" : "usemtl far\n";
    faces += fmt::format("f {}/{} {}/{} {}/{} {}/{}\n", a, a, b, t, b + 1, t + 1, a + 1, a + 1);
  }
  return text + faces;
}

TEST(ObjModel, SmoothsNormalsAcrossSeamsAndMaterials) {
  const Model smooth = load_obj(write_obj(ring(false, false)));
  std::map<std::array<float, 3>, glm::vec3> normals;
  const auto key = [](const Vertex& v) { return std::array{v.position.x, v.position.y, v.position.z}; };
  for (const Vertex& vertex : smooth.meshes.at(0).vertices) normals[key(vertex)] = vertex.normal;
  ASSERT_EQ(normals.size(), 16U);
  for (const bool split : {false, true}) {
    const Model seamed = load_obj(write_obj(ring(true, split)));
    EXPECT_EQ(seamed.meshes.size(), split ? 2U : 1U);
    for (const Mesh& mesh : seamed.meshes)
      for (const Vertex& vertex : mesh.vertices)
        EXPECT_LT(glm::distance(vertex.normal, normals.at(key(vertex))), 1e-6F);
  }
}

TEST(ObjModel, ReadsVertexColors) {
  const std::string faces = "f 1 2 3\n";
  const Model model = load_obj(write_obj("v 0 0 0 0.5 0.25 1\nv 1 0 0\nv 0 1 0 0 0 0 0.5\n" + faces));
  const std::vector<Vertex>& vertices = model.meshes.at(0).vertices;
  EXPECT_EQ(vertices.at(0).color, glm::vec4(0.5F, 0.25F, 1.0F, 1.0F));
  EXPECT_EQ(vertices.at(1).color, glm::vec4(1.0F));
  EXPECT_EQ(vertices.at(2).color, glm::vec4(0.0F, 0.0F, 0.0F, 0.5F));
  const Model bytes = load_obj(write_obj("v 0 0 0 255 51 nan\nv 1 0 0 0 0 0\nv 0 1 0 0 0 0\n" + faces));
  EXPECT_EQ(bytes.meshes.at(0).vertices.at(0).color, glm::vec4(1.0F, 0.2F, 0.0F, 1.0F));
  EXPECT_THAT(bytes.warnings, ::testing::ElementsAre("vertex colours above 1 are taken for 0 to 255"));
}

TEST(ObjModel, WarnsOfWhatItLeavesOut) {
  const Model model =
      load_obj(write_obj("mtllib none.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvn nan 0 0\nvt inf 0\ns off\nf 1/1/1 2 3\nl 1 "
                         "2\nsurf 0 1 0 1 1 2\n"));
  EXPECT_THAT(model.warnings,
              ::testing::ElementsAre("there is no material file `none.mtl`: it is left out",
                                     "points and lines are left out", "free-form curves and surfaces are left out",
                                     "1 normals without a direction were replaced by the triangles' own",
                                     "1 texture coordinates that are not usable were set to 0",
                                     "smoothing groups are not read: vertices without a normal are smooth"));
}

TEST(ObjModel, CoversConcaveFacesAlone) {
  // A polygon of area 0.6 from each of its corners.
  const std::array<const char*, 5> corners{"v 0 0 0\n", "v 1 0 0\n", "v 1 1 0\n", "v 0.5 0.2 0\n", "v 0 1 0\n"};
  for (std::size_t first = 0; first < corners.size(); ++first) {
    std::string text;
    for (std::size_t i = 0; i < corners.size(); ++i) text += corners.at((first + i) % corners.size());
    const Mesh mesh = load_obj(write_obj(text + "f 1 2 3 4 5\n")).meshes.at(0);
    double area = 0.0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
      const auto at = [&](std::size_t corner) { return mesh.vertices[mesh.indices[i + corner]].position; };
      const glm::vec3 normal = glm::cross(at(1) - at(0), at(2) - at(0));
      EXPECT_GE(normal.z, 0.0F);
      area += 0.5 * normal.z;
    }
    EXPECT_NEAR(area, 0.6, 1e-6);
  }
}

}  // namespace
}  // namespace footprint

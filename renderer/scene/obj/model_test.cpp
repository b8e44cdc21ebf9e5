// Wavefront OBJ files: what is read, and what is refused with its line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "renderer/core/error.hpp"
#include "renderer/scene/model.hpp"
#include "tests/support/fresh_folder.hpp"

namespace footprint {
namespace {

std::filesystem::path write_obj(const std::string& text) {
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  const auto file = test::process_folder() / (std::string(test->name()) + ".obj");
  std::ofstream(file) << text;
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
  expect_fault(three + "f 1 2 4\n", ":4", "`4` is not a vertex");
  expect_fault(three + "f 1 2 0\n", ":4", "`0` is not a vertex");
  expect_fault(three + "f 1 2 -4\n", ":4", "`-4` is not a vertex");
  expect_fault(three + "f 1 2\n", ":4", "a face of 2 corners");
  expect_fault(three + "f 1/1 2/1 3/1\n", ":4", "`1/1` is not a vertex");
  expect_fault(three + "f 1/2/3/4 2 3\n", ":4", "1/2/3/4");
  expect_fault(three + "f a b c\n", ":4", "`a` is not a vertex");
  expect_fault("v 0 0\n", ":1", "is not a number");
  expect_fault("v 0 nan 0\n", ":1", "`nan` is not a number within 1e15");
  expect_fault("v 0 1e30 0\n", ":1", "`1e30` is not a number");
  expect_fault("v 0 1x 0\n", ":1", "`1x` is not a number");
  expect_fault("f 99999999999999999999 1 1\n", ":1", "is not a vertex");
  expect_fault("", "", "the file is empty");
}

}  // namespace
}  // namespace footprint

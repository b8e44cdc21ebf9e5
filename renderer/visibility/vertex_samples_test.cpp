// Samples of a fine sphere: how many, how near, and that a smooth function of the surface is interpolated.
#include "renderer/visibility/signed_distance.hpp"

#include <gtest/gtest.h>

#include "tests/support/shadow_scenes.hpp"

namespace footprint::testing {
namespace {

std::vector<const Vertex*> vertices_of(const Mesh& mesh) {
  std::vector<const Vertex*> vertices;
  for (const Vertex& vertex : mesh.vertices) vertices.push_back(&vertex);
  return vertices;
}

float interpolated(const VertexSamples& samples, const Vertex& vertex, auto value) {
  float sum = 0, total = 0;
  samples.interpolate(vertex, [&](std::size_t sample, float weight) {
    sum += weight * value(*samples.samples()[sample]);
    total += weight;
  });
  EXPECT_NEAR(total, 1.0F, 1e-5F);
  return sum;
}

TEST(VertexSamples, DoNotGrowWithTheMesh) {
  const Mesh coarse = sphere_mesh({0, 0, 0}, 1.0F, 64), fine = sphere_mesh({0, 0, 0}, 1.0F, 256);
  const VertexSamples of_coarse(vertices_of(coarse), 0.2F), of_fine(vertices_of(fine), 0.2F);
  EXPECT_GT(fine.vertices.size(), 15 * coarse.vertices.size());
  EXPECT_LT(of_fine.samples().size(), of_coarse.samples().size() * 3 / 2);
  EXPECT_LT(of_fine.samples().size(), 1000U);
}

TEST(VertexSamples, InterpolateASmoothFunction) {
  const Mesh mesh = sphere_mesh({0, 0, 0}, 1.0F, 128);
  const VertexSamples samples(vertices_of(mesh), 0.2F);
  const auto value = [](const Vertex& vertex) { return vertex.position.x + 2.0F * vertex.position.y; };
  for (const Vertex& vertex : mesh.vertices) {
    EXPECT_NEAR(interpolated(samples, vertex, value), value(vertex), 0.15F);  // a third of what it changes by in 0.2
  }
  for (const Vertex* sample : samples.samples()) EXPECT_EQ(interpolated(samples, *sample, value), value(*sample));
}

TEST(VertexSamples, KeepTheSidesOfASheetApart) {
  const std::vector<Vertex> vertices{{.position = {0, 0, 0}, .normal = {0, 0, 1}},
                                     {.position = {0, 0, 0}, .normal = {0, 0, -1}},
                                     {.position = {0.01F, 0, 0}, .normal = {0, 0, 1}}};
  const VertexSamples samples({vertices.data(), vertices.data() + 1, vertices.data() + 2}, 0.2F);
  EXPECT_EQ(samples.samples().size(), 2U);
  const auto up = [](const Vertex& vertex) { return vertex.normal.z; };
  EXPECT_EQ(interpolated(samples, vertices[2], up), 1.0F);
}

}  // namespace
}  // namespace footprint::testing

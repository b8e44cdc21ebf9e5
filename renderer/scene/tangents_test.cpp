// Tangents against frames worked out by hand, and against the definition of MikkTSpace, summed corner by corner.
#include "renderer/scene/tangents.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>

#include "renderer/scene/geometry.hpp"
#include "tests/support/expect_near.hpp"

namespace footprint {
namespace {

using test::expect_near;

glm::vec3 bitangent(const Vertex& vertex) {
  return glm::cross(vertex.normal, glm::vec3{vertex.tangent}) * vertex.tangent.w;
}

TEST(Tangents, ComputedTangentsOfThePlaneAreItsOwn) {
  Mesh plane = make_plane({2.0F, 3.0F}, {1.0F, 1.0F});
  for (Vertex& vertex : plane.vertices) vertex.tangent = glm::vec4{0.0F};
  compute_tangents(plane.vertices, plane.indices, {});
  EXPECT_EQ(plane.vertices.size(), 4U);
  for (const Vertex& vertex : plane.vertices) {
    expect_near(glm::vec3{vertex.tangent}, {1.0F, 0.0F, 0.0F});
    expect_near(bitangent(vertex), {0.0F, 1.0F, 0.0F});  // green is up in the image, v is down
  }
}

TEST(Tangents, MirroredCoordinatesTurnTheHandedness) {
  Mesh plane = make_plane({2.0F, 2.0F}, {1.0F, 1.0F});
  for (Vertex& vertex : plane.vertices) vertex.uv0.x = 1.0F - vertex.uv0.x;
  compute_tangents(plane.vertices, plane.indices, {});
  for (const Vertex& vertex : plane.vertices) {
    expect_near(glm::vec3{vertex.tangent}, {-1.0F, 0.0F, 0.0F});
    EXPECT_EQ(vertex.tangent.w, -1.0F);
    expect_near(bitangent(vertex), {0.0F, 1.0F, 0.0F});
  }
}

TEST(Tangents, RotatedTransformTurnsTheFrame) {
  Mesh plane = make_plane({2.0F, 2.0F}, {1.0F, 1.0F});
  TextureCoordinates turned;  // u' = v, v' = -u: u' grows downwards, v' grows to the left
  turned.transform = glm::mat3x2{0.0F, -1.0F, 1.0F, 0.0F, 0.0F, 0.0F};
  compute_tangents(plane.vertices, plane.indices, turned);
  for (const Vertex& vertex : plane.vertices) {
    expect_near(glm::vec3{vertex.tangent}, {0.0F, -1.0F, 0.0F});
    expect_near(bitangent(vertex), {1.0F, 0.0F, 0.0F});  // against v'
  }
}

TEST(Tangents, SharedVerticesOfOppositeHandednessAreSplit) {
  // Two triangles over one edge; u = |x|, so the map is mirrored at x = 0.
  std::vector<Vertex> vertices(4);
  const std::vector<glm::vec3> positions{{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {1, 0, 0}};
  for (std::size_t i = 0; i < 4; ++i) {
    vertices[i].position = positions[i];
    vertices[i].uv0 = {std::abs(positions[i].x), 1.0F - positions[i].y};
  }
  std::vector<std::uint32_t> indices{0, 1, 2, 0, 3, 1};
  compute_tangents(vertices, indices, {});
  EXPECT_EQ(vertices.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) {
    const Vertex& vertex = vertices[indices[i]];
    expect_near(glm::vec3{vertex.tangent}, {i < 3 ? -1.0F : 1.0F, 0.0F, 0.0F});
    EXPECT_EQ(vertex.tangent.w, i < 3 ? -1.0F : 1.0F);
  }
}

TEST(Tangents, DegenerateCoordinatesGetSomeOrthonormalFrame) {
  Mesh plane = make_plane({2.0F, 2.0F}, {0.0F, 0.0F});
  compute_tangents(plane.vertices, plane.indices, {});
  for (const Vertex& vertex : plane.vertices) {
    EXPECT_NEAR(glm::length(glm::vec3{vertex.tangent}), 1.0F, 1e-6F);
    EXPECT_NEAR(glm::dot(glm::vec3{vertex.tangent}, vertex.normal), 0.0F, 1e-6F);
    EXPECT_EQ(std::abs(vertex.tangent.w), 1.0F);
  }
}

TEST(Tangents, GivenTangentsAreMadeOrthonormal) {
  std::vector<Vertex> vertices(3);
  vertices[0].tangent = {3.0F, 0.0F, 4.0F, -0.5F};
  vertices[1].tangent = {0.0F, 0.0F, 1.0F, 1.0F};  // along the normal
  vertices[2].tangent = {std::numeric_limits<float>::infinity(), 0.0F, 0.0F, 1.0F};
  EXPECT_EQ(repair_tangents(vertices), 2U);
  expect_near(glm::vec3{vertices[0].tangent}, {1, 0, 0});
  EXPECT_EQ(vertices[0].tangent.w, -1.0F);
  for (const Vertex& vertex : vertices) EXPECT_NEAR(glm::length(glm::vec3{vertex.tangent}), 1.0F, 1e-6F);
}

// At the shared corner a triangle of 90 degrees says +x, and the one beside it, of 45 degrees, (1, 1) / sqrt 2.
TEST(Tangents, TrianglesOverAnEdgeAreWeighedByAngle) {
  std::vector<Vertex> vertices(4);
  const std::array<glm::vec3, 4> positions{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 1, 0}}};
  const std::array<glm::vec2, 4> uvs{{{0, 0}, {1, 0}, {0, -1}, {-1, -2}}};
  for (std::size_t i = 0; i < 4; ++i) {
    vertices[i].position = positions.at(i);
    vertices[i].uv0 = uvs.at(i);
  }
  std::vector<std::uint32_t> indices{0, 1, 2, 0, 2, 3};
  compute_tangents(vertices, indices, {});
  EXPECT_EQ(vertices.size(), 4U);
  const float r = std::numbers::sqrt2_v<float> / 2.0F;
  expect_near(glm::vec3{vertices[0].tangent}, glm::normalize(glm::vec3{2.0F + r, r, 0}));
}

TEST(Tangents, TrianglesThatMeetInAPointAloneHaveTheirOwn) {
  std::vector<Vertex> vertices(5);
  const std::array<glm::vec3, 5> positions{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {-1, -1, 0}}};
  for (std::size_t i = 0; i < 5; ++i) {
    const glm::vec3& at = vertices[i].position = positions.at(i);
    vertices[i].uv0 = i < 3 ? glm::vec2{at.x, -at.y} : glm::vec2{at.x + at.y, at.x - at.y};  // turned by 45 degrees
  }
  std::vector<std::uint32_t> indices{0, 1, 2, 0, 3, 4};
  compute_tangents(vertices, indices, {});
  EXPECT_EQ(vertices.size(), 6U);
  const float r = std::numbers::sqrt2_v<float> / 2.0F;
  expect_near(glm::vec3{vertices[indices[0]].tangent}, {1, 0, 0});
  expect_near(glm::vec3{vertices[indices[3]].tangent}, {r, r, 0});
}

// Triangles over a grid of bumps, whose coordinates wind and are mirrored along a line, and turn near it.
struct Bumps {
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
};

constexpr int grid = 7;

Bumps make_bumps() {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> shift(-0.3F, 0.3F);
  Bumps bumps;
  for (int y = 0; y < grid; ++y) {
    for (int x = 0; x < grid; ++x) {
      Vertex& vertex = bumps.vertices.emplace_back();
      const glm::vec2 at{static_cast<float>(x), static_cast<float>(y)};
      vertex.position = {at.x + shift(random), at.y + shift(random), 2.0F * shift(random)};
      vertex.normal = glm::normalize(glm::vec3{shift(random), shift(random), 0.6F});
      vertex.uv0 = {std::abs(at.x - 3.0F) + 0.2F * at.y, -at.y + 0.5F * shift(random)};
    }
  }
  for (std::uint32_t y = 0; y + 1 < grid; ++y) {
    for (std::uint32_t x = 0; x + 1 < grid; ++x) {
      const std::uint32_t a = y * grid + x, b = a + 1, c = a + grid, d = c + 1;
      bumps.indices.insert(bumps.indices.end(), {a, b, d, a, d, c});
    }
  }
  return bumps;
}

Bumps unindexed(const Bumps& from) {
  Bumps out;
  for (const std::uint32_t index : from.indices) {
    out.indices.push_back(static_cast<std::uint32_t>(out.vertices.size()));
    out.vertices.push_back(from.vertices[index]);
  }
  return out;
}

// Some corners get vertices of their own.
Bumps partly_indexed(const Bumps& from) {
  Bumps out = from;
  for (std::size_t corner = 0; corner < out.indices.size(); corner += 5) {
    out.vertices.push_back(Vertex{out.vertices[out.indices[corner]]});
    out.indices[corner] = static_cast<std::uint32_t>(out.vertices.size()) - 1;
  }
  return out;
}

// The definition, corner against corner and in double precision throughout.
class Definition {
 public:
  explicit Definition(const Bumps& bumps) : bumps_(bumps) {}

  // xyz of the tangent at a corner, and its handedness.
  [[nodiscard]] glm::dvec4 tangent(std::size_t corner) const {
    glm::dvec3 sum{0.0};
    for (const std::size_t other : group(corner)) {
      const glm::dvec3 own = flat(derivative(other), corner);
      const glm::dvec3 one = flat(at(other, 1) - at(other, 0), corner), two = flat(at(other, 2) - at(other, 0), corner);
      sum += std::atan2(glm::length(glm::cross(one, two)), glm::dot(one, two)) * own;
    }
    return {glm::normalize(sum), handedness(corner)};
  }

 private:
  [[nodiscard]] const Vertex& vertex(std::size_t corner, std::size_t steps) const {
    return bumps_.vertices[bumps_.indices[corner - corner % 3 + (corner + steps) % 3]];
  }
  [[nodiscard]] glm::dvec3 at(std::size_t corner, std::size_t steps) const {
    return glm::dvec3{vertex(corner, steps).position};
  }
  static bool are_equal(const Vertex& a, const Vertex& b) {
    return a.position == b.position && a.normal == b.normal && a.uv0 == b.uv0;
  }
  [[nodiscard]] glm::dmat2 uv_edges(std::size_t corner) const {
    const glm::dvec2 origin{vertex(corner, 0).uv0};
    return {glm::dvec2{vertex(corner, 1).uv0} - origin, glm::dvec2{vertex(corner, 2).uv0} - origin};
  }
  [[nodiscard]] double handedness(std::size_t corner) const {
    return glm::determinant(uv_edges(corner)) > 0.0 ? -1.0 : 1.0;
  }
  // d position / d u: what the edges' combination with the uv (1, 0) is.
  [[nodiscard]] glm::dvec3 derivative(std::size_t corner) const {
    const glm::dvec2 shares = glm::inverse(uv_edges(corner)) * glm::dvec2{1.0, 0.0};
    return shares.x * (at(corner, 1) - at(corner, 0)) + shares.y * (at(corner, 2) - at(corner, 0));
  }
  [[nodiscard]] glm::dvec3 flat(const glm::dvec3& vector, std::size_t corner) const {
    const glm::dvec3 normal = glm::normalize(glm::dvec3{vertex(corner, 0).normal});
    return glm::normalize(vector - normal * glm::dot(normal, vector));
  }
  [[nodiscard]] bool touch(std::size_t a, std::size_t b) const {
    return are_equal(vertex(a, 0), vertex(b, 0)) && handedness(a) == handedness(b) &&
           (are_equal(vertex(a, 1), vertex(b, 2)) || are_equal(vertex(a, 2), vertex(b, 1)));
  }
  [[nodiscard]] std::vector<std::size_t> group(std::size_t corner) const {
    std::vector<std::size_t> found{corner};
    for (std::size_t i = 0; i < found.size(); ++i) {
      for (std::size_t other = 0; other < bumps_.indices.size(); ++other) {
        if (touch(found[i], other) && std::ranges::find(found, other) == found.end()) found.push_back(other);
      }
    }
    return found;
  }

  const Bumps& bumps_;
};

double largest_error(const Bumps& with_tangents, const Definition& definition) {
  double largest = 0.0;
  for (std::size_t corner = 0; corner < with_tangents.indices.size(); ++corner) {
    const glm::dvec4 tangent{with_tangents.vertices[with_tangents.indices[corner]].tangent};
    largest = std::max(largest, glm::length(tangent - definition.tangent(corner)));
  }
  return largest;
}

TEST(Tangents, FollowTheDefinitionHoweverVerticesAreIndexed) {
  const Bumps bumps = make_bumps();
  const Definition definition(bumps);
  for (const Bumps& form : {bumps, unindexed(bumps), partly_indexed(bumps)}) {
    Bumps own = form;
    compute_tangents(own.vertices, own.indices, {});
    EXPECT_LT(largest_error(own, definition), 1e-6) << form.vertices.size() << " vertices";
  }
  Bumps alone = unindexed(bumps);  // must fail: no corner is equal to another one
  for (std::size_t i = 0; i < alone.vertices.size(); ++i) alone.vertices[i].uv0 += 1e-5F * static_cast<float>(i);
  compute_tangents(alone.vertices, alone.indices, {});
  EXPECT_GT(largest_error(alone, definition), 0.05);
}

TEST(Tangents, EqualVerticesMayDifferInTheSignOfZero) {
  const Bumps bumps = make_bumps();
  Bumps signs = unindexed(bumps), plain = signs;
  for (std::size_t i = 0; i < signs.vertices.size(); ++i) {
    plain.vertices[i].uv0.y = 0.0F;
    plain.vertices[i].uv1 = bumps.vertices[bumps.indices[i]].uv0;
    plain.vertices[i].normal = {0.0F, 0.0F, 1.0F};
    signs.vertices[i] = plain.vertices[i];
    if (i % 2 == 0) signs.vertices[i].normal.x = -0.0F;
  }
  compute_tangents(plain.vertices, plain.indices, {.set = 1});
  compute_tangents(signs.vertices, signs.indices, {.set = 1});
  for (std::size_t i = 0; i < plain.vertices.size(); ++i)
    EXPECT_EQ(plain.vertices[i].tangent, signs.vertices[i].tangent) << i;
}

// A file's tangents, which follow the coordinates as they are, become those of the transformed ones.
TEST(Tangents, GivenOnesTurnAsComputedOnesDo) {
  Bumps given = make_bumps();
  compute_tangents(given.vertices, given.indices, {});
  for (const double degrees : {0.0, 90.0, 35.0, -160.0}) {
    for (const glm::dvec2 scale : {glm::dvec2{1, 1}, {-1, 1}, {0.5, -3}, {-2, -0.7}}) {
      const double c = std::cos(glm::radians(degrees)), s = std::sin(glm::radians(degrees));
      TextureCoordinates coordinates;
      coordinates.transform = glm::mat3x2{glm::vec2{glm::dvec2{c, -s} * scale.x}, glm::vec2{glm::dvec2{s, c} * scale.y},
                                          glm::vec2{0.3F, 0.1F}};
      Bumps turned = given, computed = given;
      turn_tangents(turned.vertices, turned.indices, coordinates);
      compute_tangents(computed.vertices, computed.indices, coordinates);
      double largest = 0.0;
      for (std::size_t i = 0; i < given.vertices.size(); ++i)
        largest = std::max<double>(largest, glm::length(turned.vertices[i].tangent - computed.vertices[i].tangent));
      EXPECT_LT(largest, 1e-5) << degrees << " degrees, scale " << scale.x << ", " << scale.y;
    }
  }
}

TEST(Tangents, GivenOnesStayUnderScalesAndShifts) {
  Bumps given = make_bumps();
  for (Vertex& vertex : given.vertices) vertex.tangent = {0.3F, 0.4F, 0.5F, -1.0F};
  const Bumps before = given;
  TextureCoordinates coordinates;
  coordinates.transform = glm::mat3x2{2.0F, 0.0F, 0.0F, 7.0F, 0.3F, 0.1F};
  turn_tangents(given.vertices, given.indices, coordinates);
  for (std::size_t i = 0; i < given.vertices.size(); ++i)
    EXPECT_EQ(given.vertices[i].tangent, before.vertices[i].tangent);
}

// Triangles without extent in uv tell nothing: texels count as square.
TEST(Tangents, GivenOnesTurnWithoutTextureCoordinatesToo) {
  Mesh plane = make_plane({1.0F, 1.0F}, {0.0F, 0.0F});
  TextureCoordinates turned;  // u' = v, v' = -u
  turned.transform = glm::mat3x2{0.0F, -1.0F, 1.0F, 0.0F, 0.0F, 0.0F};
  turn_tangents(plane.vertices, plane.indices, turned);
  for (const Vertex& vertex : plane.vertices) {
    expect_near(glm::vec3{vertex.tangent}, {0.0F, -1.0F, 0.0F});
    expect_near(bitangent(vertex), {1.0F, 0.0F, 0.0F});
  }
}

}  // namespace
}  // namespace footprint

// Kernels of the footprint filters: sums, means and widths, the box that they approach, and the shaders' own texels.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>
#include <string>

#include "renderer/image/mipmap.hpp"
#include "renderer/pipeline/gpu_scene.hpp"
#include "renderer/pipeline/shader_source.hpp"
#include "tests/support/filter_kernel.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/shader_probe.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

constexpr int map_edge = 64;
constexpr std::array<const char*, 11> filters{"trilinear", "anisotropic:4", "anisotropic:16", "box:2",
                                              "box:5",     "area:2",        "area:5",         "ewa:1",
                                              "ewa:4",     "ewa:16",        "shaded:3"};

// Even, sheared, flat and magnified ones, none at a round place.
std::vector<TexelFootprint> some_footprints() {
  std::vector<TexelFootprint> out;
  for (const glm::dvec2 centre : {glm::dvec2(31.3, 30.1), glm::dvec2(32.77, 33.49)}) {
    out.push_back({centre, {6.0, 0.0}, {0.0, 6.0}});
    out.push_back({centre, {7.0, 2.0}, {4.5, 5.0}});
    out.push_back({centre, {1.1, -0.2}, {-3.0, 9.0}});
    out.push_back({centre, {0.3, 0.1}, {0.0, 0.2}});
    out.push_back({centre, {2.0, 0.0}, {0.0, 0.0}});
  }
  return out;
}

FootprintFilter filter_of(const std::string& text) { return parse_footprint_filter(text, ""); }

double sum_of(const Image& kernel) { return std::accumulate(kernel.texels.begin(), kernel.texels.end(), 0.0); }

// Half of the difference: 0 equal, 1 without overlap.
double apart(const Image& a, const Image& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.texels.size(); ++i) sum += std::abs(a.texels[i] - b.texels[i]);
  return 0.5 * sum;
}

// By what a kernel may be off its place. Whole texels of a coarse level are not where the footprint has its part of
// them.
double place_bound(const std::string& text, const TexelFootprint& footprint) {
  const double width = std::max(glm::length(footprint.dx), glm::length(footprint.dy));
  return filter_of(text).kind == FootprintFilterKind::area ? 0.025 * width : 1e-4;
}

TEST(FilterKernel, SumsToOneAndStaysWhereTheFootprintIs) {
  for (const char* const text : filters) {
    for (const TexelFootprint& footprint : some_footprints()) {
      const Image kernel = filter_kernel(filter_of(text), footprint, map_edge);
      EXPECT_NEAR(sum_of(kernel), 1.0, 1e-5) << text;
      const glm::dvec2 shift = kernel_moments(kernel, footprint).mean - footprint.centre;
      EXPECT_LT(glm::length(shift), place_bound(text, footprint))
          << text << " is off by " << shift.x << ", " << shift.y;
    }
  }
}

// A probe that counts twice moves the mean: the test above can fail.
TEST(FilterKernel, AProbeThatCountsTwiceIsSeen) {
  const TexelFootprint footprint = some_footprints()[1];
  Image kernel = filter_kernel(filter_of("box:2"), footprint, map_edge);
  const Image corner =
      filter_kernel(filter_of("trilinear"),
                    {footprint.centre - 0.25 * footprint.dx, 0.5 * footprint.dx, 0.5 * footprint.dy}, map_edge);
  for (std::size_t i = 0; i < kernel.texels.size(); ++i)
    kernel.texels[i] = 0.8F * kernel.texels[i] + 0.2F * corner.texels[i];
  EXPECT_GT(glm::length(kernel_moments(kernel, footprint).mean - footprint.centre), 0.1);
}

// So does the wider bound of areas close: on a kernel that is off by a sixteenth of the footprint's edge.
TEST(FilterKernel, AnAreaBesideItsPlaceIsSeen) {
  for (const TexelFootprint& footprint : some_footprints()) {
    const TexelFootprint beside{footprint.centre + footprint.dx / 16.0 + footprint.dy / 16.0, footprint.dx,
                                footprint.dy};
    const Image kernel = filter_kernel(filter_of("area:2"), beside, map_edge);
    EXPECT_GT(glm::length(kernel_moments(kernel, footprint).mean - footprint.centre), place_bound("area:2", footprint));
  }
}

TEST(FilterKernel, BoxesApproachTheParallelogram) {
  for (const TexelFootprint& footprint : {TexelFootprint{{31.3, 30.1}, {14.0, 3.0}, {6.0, 12.0}},
                                          TexelFootprint{{31.3, 30.1}, {20.0, -4.0}, {1.0, 5.0}}}) {
    const Image box = box_kernel(footprint, map_edge);
    const auto last = [&](std::initializer_list<const char*> finer_and_finer) {
      double before = 1.0;
      for (const char* const text : finer_and_finer) {
        const double now = apart(filter_kernel(filter_of(text), footprint, map_edge), box);
        EXPECT_LT(now, 0.95 * before) << text;
        before = now;
      }
      return before;
    };
    EXPECT_LT(last({"trilinear", "box:2", "box:4", "box:8"}), 0.25);
    EXPECT_LT(last({"area:1", "area:2", "area:4", "area:8"}), 0.15);
  }
}

// Areas take as many lookups as they are called for, at every size: pairs of texels of the level are never too few, nor
// many too many.
TEST(FilterKernel, AreasTakeTheLookupsThatTheyAreCalledFor) {
  for (const int lookups : {1, 2, 3, 8}) {
    double most = 0.0;
    for (double size = 0.01; size < 1000.0; size *= 1.03) {
      const TexelFootprint even{{31.3, 30.1}, {size, 0.0}, {0.0, size}};
      const TexelFootprint sheared{{31.3, 30.1}, {size, 0.4 * size}, {-0.3 * size, 0.2 * size}};
      for (const TexelFootprint& footprint : {even, sheared})
        most = std::max(most,
                        static_cast<double>(probes_of({FootprintFilterKind::area, lookups}, footprint).probes.size()));
    }
    EXPECT_GE(most, lookups * lookups);
    EXPECT_LE(most, (lookups + 1) * (lookups + 1)) << lookups;
  }
}

// The weights of one texel of the finest level or less are those of a bilinear lookup.
TEST(FilterKernel, AreasOfNoExtentAreBilinear) {
  const TexelFootprint footprint{{31.3, 30.1}, {1e-3, 2e-4}, {-1e-4, 5e-4}};
  const Image kernel = filter_kernel(filter_of("area:3"), footprint, map_edge);
  EXPECT_LT(apart(kernel, filter_kernel(filter_of("trilinear"), footprint, map_edge)), 0.005);
  EXPECT_EQ(probes_of(filter_of("area:3"), footprint).probes.size(), 1U);
}

// Heckbert's Gaussian, exp(-2 r^2) over the ellipse: cut off at r = 1 its deviation per axis is 0.414 radii. The
// trilinear lookup's own adds up to it along the ellipse, and is it across.
TEST(FilterKernel, TheEllipseHasItsWidths) {
  const TexelFootprint footprint{{32.4, 31.7}, {10.0, 4.0}, {-2.0, 3.0}};
  const Image kernel = filter_kernel(filter_of("ewa:16"), footprint, map_edge);
  const KernelMoments moments = kernel_moments(kernel, footprint);
  const double major = std::sqrt(0.5 * (129.0 + std::sqrt(129.0 * 129.0 - 4.0 * 38.0 * 38.0)));
  EXPECT_NEAR(moments.along / major, 0.45, 0.05);
  EXPECT_NEAR(moments.across / (38.0 / major), 0.55, 0.1);
}

// What the shared shader text blends, texel by texel, over a random map.
std::vector<glm::vec4> by_shader(const FootprintFilter& filter, const Image& map) {
  const std::vector<std::vector<Image>> layers{mip_chain(map)};
  const Prefiltered prefiltered{
      .textures = {make_array_texture("map", layers, Storage::fp32, {}, TextureFilter::nearest)}, .scalars = {}};
  const GpuTexture texture = upload(prefiltered.textures[0]);
  SamplerCache samplers;
  gl::api().BindTextureUnit(0, texture.texture->name());
  gl::api().BindSampler(0, samplers.sampler(texture.coordinates, SamplerState::nearest));
  ShaderVariant variant;
  variant.footprint = filter;
  const std::string text = "layout(binding = 0) uniform sampler2DArray map;\n" + footprint_constants(filter) +
                           shared_functions(shader_flags(variant, Options({}, {}, "test"), prefiltered));
  std::vector<std::array<glm::vec4, 3>> inputs;
  for (const TexelFootprint& f : some_footprints()) {
    const auto uv = [](const glm::dvec2& v) { return glm::vec4(glm::vec2(v / double(map_edge)), 0.0F, 0.0F); };
    inputs.push_back({uv(f.centre), uv(f.dx), uv(f.dy)});
  }
  return evaluate_glsl(text,
                       "Footprint f = Footprint(a.xy, b.xy, c.xy); vec4 sum = vec4(0.0);\n"
                       "for (int i = 0; i < footprintTexelCount(map, f); ++i) { FootprintTexel t = footprintTexel(map, "
                       "f, i); sum += t.weight * fetchTexel(map, 0, t); }\nreturn sum;",
                       inputs);
}

TEST(FilterKernel, IsWhatTheShadersBlend) {
  const gl::Context& context = shared_context();
  const Image map = random_normals(map_edge, map_edge, 0.9F, 5);
  for (const char* const text : filters) {
    if (filter_of(text).kind == FootprintFilterKind::shaded) continue;  // parts of a footprint, not of a fetch
    const std::vector<glm::vec4> got = by_shader(filter_of(text), map);
    context.check("blending texels");
    for (std::size_t i = 0; i < got.size(); ++i) {
      const Image kernel = filter_kernel(filter_of(text), some_footprints()[i], map_edge);
      glm::dvec3 expected(0.0);
      for (std::size_t k = 0; k < kernel.texels.size(); ++k) {
        for (int c = 0; c < 3; ++c)
          expected[c] +=
              kernel.texels[k] * map.texels[static_cast<std::size_t>(map.channels) * k + static_cast<std::size_t>(c)];
      }
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(got[i][c], expected[c], 2e-4) << text << " " << i;
    }
  }
}

}  // namespace
}  // namespace footprint::testing

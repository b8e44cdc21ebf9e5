// Materials with a map of specular colours, and E[c f(n)] over their texels in doubles: for tests of methods that
// filter colour with the lobe.
#pragma once

#include <memory>
#include <vector>

#include "renderer/bake/material_maps.hpp"
#include "tests/support/method_probe.hpp"
#include "tests/support/slope_twin.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {

/// A method over a material of GGX lobes with these maps, of one size; with the effects of maps that vary.
/// alphas: of each texel's lobe, one channel, or empty: 0.2.
/// colours: RGB.
struct ColouredLobes {
  Image normals, alphas, colours;

  [[nodiscard]] double alpha_at(int x, int y) const { return alphas.empty() ? 0.2 : alphas.at(x, y)[0]; }
  [[nodiscard]] glm::dvec3 colour_at(int x, int y) const {
    return {colours.at(x, y)[0], colours.at(x, y)[1], colours.at(x, y)[2]};
  }

  [[nodiscard]] Material material() const {
    Material out = lobe_material(normals, NormalDistribution::ggx, 0.2F);
    out.specular_map = TextureMap{"colours", std::make_shared<const Image>(colours), {}};
    if (alphas.empty()) return out;
    out.lobe_parameter.reset();
    out.lobe_parameter_map = TextureMap{"alphas", std::make_shared<const Image>(alphas), {}};
    return out;
  }

  [[nodiscard]] glm::dvec3 mean_colour() const {
    glm::dvec3 sum(0.0);
    for (int y = 0; y < colours.height; ++y) {
      for (int x = 0; x < colours.width; ++x) sum += colour_at(x, y);
    }
    return sum / static_cast<double>(colours.texel_count());
  }

  /// E[c D(h; n, alpha)] at each direction.
  [[nodiscard]] std::vector<glm::dvec3> exact(const std::vector<glm::dvec3>& directions) const {
    std::vector<glm::dvec3> out;
    for (const glm::dvec3& h : directions) {
      glm::dvec3 sum(0.0);
      for (int y = 0; y < normals.height; ++y) {
        for (int x = 0; x < normals.width; ++x)
          sum += colour_at(x, y) * base_density(NormalDistribution::ggx, alpha_at(x, y), normal_at(normals, x, y), h);
      }
      out.push_back(sum / static_cast<double>(normals.texel_count()));
    }
    return out;
  }

  /// The specular term of a method over the whole map, with light and view along each direction.
  [[nodiscard]] std::vector<glm::dvec3> specular(const Method& method,
                                                 const std::map<std::string, std::string>& options,
                                                 const std::vector<glm::dvec3>& directions,
                                                 bool normals_vary = true) const {
    const Material own = material();
    ProbedMethod probed{.method = &method, .material = &own, .options = options};
    probed.effects.set(static_cast<std::size_t>(Effect::normal_variation), normals_vary);
    probed.effects.set(static_cast<std::size_t>(Effect::specular_variation));
    probed.effects.set(static_cast<std::size_t>(Effect::roughness_variation), !alphas.empty());
    std::vector<std::array<glm::vec4, 3>> inputs;
    inputs.reserve(directions.size());
    for (const glm::dvec3& h : directions)
      inputs.push_back({glm::vec4(glm::vec3(h), 0), glm::vec4(glm::vec3(mean_colour()), 0), glm::vec4(0)});
    std::vector<glm::dvec3> out;
    for (const glm::vec4& v :
         probe_method(probed, "return vec4(shade(e, Surface(vec3(0.5), b.xyz), a.xyz, a.xyz).specular, 0.0);", inputs))
      out.emplace_back(v);
    return out;
  }
};

/// |found - exact| over |exact|, of all channels.
[[nodiscard]] inline double relative_l2(const std::vector<glm::dvec3>& found, const std::vector<glm::dvec3>& exact) {
  double sum = 0.0, norm = 0.0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    sum += glm::dot(found[i] - exact[i], found[i] - exact[i]);
    norm += glm::dot(exact[i], exact[i]);
  }
  return std::sqrt(sum / norm);
}

/// Two walls that lean by `lean` to either side, in stripes of 4 texels, with a colour each.
[[nodiscard]] inline ColouredLobes coloured_walls(float lean, const glm::vec3& left, const glm::vec3& right) {
  ColouredLobes out{Image(32, 32, 4, 1.0F), {}, Image(32, 32, 3)};
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) {
      const bool is_left = (x / 4) % 2 == 0;
      const glm::vec3 n = glm::normalize(glm::vec3(is_left ? lean : -lean, 0.0F, 1.0F));
      std::copy_n(&n.x, 3, out.normals.at(x, y).data());
      std::copy_n(is_left ? &left.x : &right.x, 3, out.colours.at(x, y).data());
    }
  }
  return out;
}

/// Colours that lie elsewhere are not joined: a note, and the lobes of the `separate` options.
inline void expect_separate_where_colours_lie_elsewhere(const Method& method,
                                                        const std::map<std::string, std::string>& joint,
                                                        const std::map<std::string, std::string>& separate) {
  Material material = coloured_walls(0.4F, glm::vec3(0.8F), glm::vec3(0.08F)).material();
  material.specular_map->coordinates.set = 1;
  EffectSet effects = ProbedMethod::default_effects();
  effects.set(static_cast<std::size_t>(Effect::specular_variation));
  const auto baked = [&](const std::map<std::string, std::string>& words) {
    return method.precompute(material, Options(method.info.options, words, method.info.name), effects, no_progress);
  };
  const Prefiltered own = baked(joint);
  ASSERT_EQ(own.notes.size(), 1U);
  EXPECT_NE(own.notes[0].find("cannot be joined"), std::string::npos);
  EXPECT_EQ(own.textures[0], baked(separate).textures[0]);
}

/// The diffuse term has the mean normal by area, though the dark wall weighs a tenth in the highlight.
inline void expect_diffuse_light_by_area(const Method& method, const std::map<std::string, std::string>& joint) {
  const Material material = coloured_walls(0.4F, glm::vec3(0.8F), glm::vec3(0.08F)).material();
  ProbedMethod probed{.method = &method, .material = &material, .options = joint};
  probed.effects.set(static_cast<std::size_t>(Effect::specular_variation));
  const std::array<std::array<glm::vec4, 3>, 1> input{};
  const glm::vec3 mean(probe_method(probed, "return vec4(e.mean_normal, 0.0);", input)[0]);
  EXPECT_LT(glm::length(mean - glm::vec3(0.0F, 0.0F, 1.0F / std::sqrt(1.16F))), 1e-6F);
}

}  // namespace footprint::testing

// Channel by channel from one layout to the other.
#include "renderer/baked_files/baked_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <stdexcept>
#include <utility>

#include "renderer/core/error.hpp"
#include "renderer/image/mipmap.hpp"

namespace footprint {
namespace {

enum Channel : std::size_t { height, along_u, along_v, square_u, square_v, product, channel_count };

constexpr float of_a_normal_map = -1.0F;  // OpenImageIO's height if there is none

const PrefilteredTexture* find_texture(const Prefiltered& prefiltered, const char* name) {
  const auto found = std::ranges::find(prefiltered.textures, name, &PrefilteredTexture::name);
  return found != prefiltered.textures.end() ? &*found : nullptr;
}

bool is_of_heights(const Image& finest) {
  for (std::size_t i = 0; i < finest.texel_count(); ++i) {
    if (finest.texels[channel_count * i + height] != of_a_normal_map) return true;
  }
  return false;
}

void require_layout(const ExrChain& chain, const std::string& file) {
  if (chain.channels != bumpslopes_channels()) {
    throw Error(ErrorKind::usage, file,
                fmt::format("has the channels {}, which are not slopes", fmt::join(chain.channels, ", ")),
                "make it by `maketx --bumpslopes`");
  }
  const Image& finest = chain.levels.front();
  if (static_cast<int>(chain.levels.size()) != mip_level_count(finest.width, finest.height)) {
    throw Error(
        ErrorKind::usage, file,
        fmt::format("has {} of {} mip levels", chain.levels.size(), mip_level_count(finest.width, finest.height)),
        "make it by `maketx --bumpslopes`");
  }
  for (const Image& level : chain.levels) {
    if (std::ranges::all_of(level.texels, [](float v) { return std::isfinite(v); })) continue;
    throw Error(ErrorKind::usage, file,
                fmt::format("level {}x{} contains a value that is not finite", level.width, level.height),
                "fix the map that it was made from");
  }
}

// The chain with v up the rows, whichever way it came.
std::vector<Image> upward(const ExrChain& chain) {
  std::vector<Image> levels = chain.levels;
  if (!is_of_heights(levels.front())) return levels;
  for (Image& level : levels) {
    for (std::size_t i = 0; i < level.texel_count(); ++i) {
      level.texels[channel_count * i + along_v] *= -1.0F;
      level.texels[channel_count * i + product] *= -1.0F;
    }
  }
  return levels;
}

// Writes channels of the chain into a texture's first ones; the others stay.
void replace(Prefiltered& prefiltered, const char* name, const std::vector<Image>& chain,
             const std::vector<std::size_t>& channels) {
  const auto found = std::ranges::find(prefiltered.textures, name, &PrefilteredTexture::name);
  if (found == prefiltered.textures.end() || found->levels.size() != chain.size() ||
      found->levels.front().width != chain.front().width || found->levels.front().height != chain.front().height ||
      found->channels < static_cast<int>(channels.size()))
    throw std::logic_error(fmt::format("the bake has no texture {} of that size", name));
  std::vector<Image> levels;
  for (std::size_t level = 0; level < chain.size(); ++level) {
    Image& to = levels.emplace_back(decode_level(*found, level));
    const auto step = static_cast<std::size_t>(to.channels);
    for (std::size_t i = 0; i < to.texel_count(); ++i) {
      for (std::size_t c = 0; c < channels.size(); ++c)
        to.texels[step * i + c] = chain[level].texels[channel_count * i + channels[c]];
    }
  }
  *found = make_texture(found->name, std::move(levels), found->storage, found->coordinates);
}

}  // namespace

const std::vector<std::string>& bumpslopes_channels() {
  static const std::vector<std::string> channels{"b0_h", "b1_dhds", "b2_dhdt", "b3_dhds2", "b4_dhdt2", "b5_dh2dsdt"};
  return channels;
}

bool holds_slope_moments(const Prefiltered& prefiltered) {
  const PrefilteredTexture* const moments = find_texture(prefiltered, "slope_moments");
  return moments != nullptr && moments->channels == 4 && find_texture(prefiltered, "slope_rest") != nullptr;
}

std::optional<ExrChain> make_bumpslopes(const Prefiltered& prefiltered) {
  if (!holds_slope_moments(prefiltered)) return {};
  const PrefilteredTexture& moments = *find_texture(prefiltered, "slope_moments");
  const PrefilteredTexture& rest = *find_texture(prefiltered, "slope_rest");
  const auto rest_step = static_cast<std::size_t>(rest.channels);
  ExrChain chain{.levels = {}, .channels = bumpslopes_channels()};
  for (std::size_t level = 0; level < moments.levels.size(); ++level) {
    const Image four = decode_level(moments, level), others = decode_level(rest, level);
    Image& to = chain.levels.emplace_back(four.width, four.height, static_cast<int>(channel_count));
    for (std::size_t i = 0; i < four.texel_count(); ++i) {
      float* const texel = &to.texels[channel_count * i];
      texel[height] = of_a_normal_map;
      std::copy_n(&four.texels[4 * i], 4, texel + along_u);
      texel[product] = others.texels[rest_step * i];
    }
  }
  return chain;
}

Image normals_of_bumpslopes(const ExrChain& chain, const std::string& file) {
  require_layout(chain, file);
  const auto write = [](const auto& texel, const auto& out) {
    const glm::vec3 n(glm::normalize(glm::dvec3(-texel[along_u], -texel[along_v], 1.0)));
    std::copy_n(&n.x, 3, out.begin());
  };
  return mapped(upward(chain).front(), 4, write, 1.0F);
}

void replace_moments(const ExrChain& chain, Prefiltered& prefiltered) {
  const std::vector<Image> levels = upward(chain);
  replace(prefiltered, "slope_moments", levels, {along_u, along_v, square_u, square_v});
  replace(prefiltered, "slope_rest", levels, {product});
}

}  // namespace footprint

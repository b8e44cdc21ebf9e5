// Groups channels by layer, and finds the known names in each.
#include "renderer/image/channel_names.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "renderer/core/error.hpp"
#include "renderer/core/names.hpp"

namespace footprint {
namespace {

// Channels of one layer by their short names in lower case: "r" for "R", "red" and "diffuse.R".
using Layer = std::map<std::string, int, std::less<>>;

std::string short_name(const std::string& word) {
  const std::string lower = lower_case(word);
  for (const char* const color : {"red", "green", "blue", "alpha"}) {
    if (lower == color) return lower.substr(0, 1);
  }
  return lower;
}

std::map<std::string, Layer> layers_of(const std::vector<std::string>& names) {
  std::map<std::string, Layer> layers;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::size_t dot = names[i].rfind('.');
    const std::string layer = dot == std::string::npos ? "" : names[i].substr(0, dot);
    layers[layer].emplace(short_name(names[i].substr(dot == std::string::npos ? 0 : dot + 1)), static_cast<int>(i));
  }
  return layers;
}

bool has(const Layer& layer, const std::vector<std::string>& names) {
  return std::ranges::all_of(names, [&](const std::string& name) { return layer.contains(name); });
}

// The first known combination of names in a layer; none without one.
std::optional<std::vector<std::string>> known_names(const Layer& layer) {
  static const std::vector<std::vector<std::string>> known{{"r", "g", "b"}, {"x", "y", "z"}, {"r", "g"},
                                                           {"x", "y"},      {"y"},           {"r"}};
  const auto found = std::ranges::find_if(known, [&](const auto& names) { return has(layer, names); });
  return found == known.end() ? std::nullopt : std::optional(*found);
}

// The layer with the image: the main one, or else the only one that has an image.
std::string image_layer(const std::map<std::string, Layer>& layers, const std::string& place) {
  std::vector<std::string> candidates;
  for (const auto& [name, layer] : layers) {
    if (known_names(layer)) candidates.push_back(name);
  }
  if (candidates.empty()) return layers.begin()->first;
  if (candidates.size() == 1 || candidates.front().empty()) return candidates.front();
  throw Error(ErrorKind::usage, place,
              fmt::format("stores the layers {} and no main image", fmt::join(candidates, ", ")),
              "save one of them with channels called R, G and B");
}

void require_colors(const Layer& layer, const std::vector<std::string>& names, bool takes_vectors,
                    const std::string& place) {
  if (layer.contains("ry") || layer.contains("by")) {
    throw Error(ErrorKind::usage, place, "stores luminance and chroma (Y, RY, BY), which are not read",
                "save it as RGB");
  }
  if (names.front() == "x" && !takes_vectors) {
    throw Error(ErrorKind::usage, place,
                fmt::format("stores {}: a vector or CIE XYZ, not RGB", names.size() == 3 ? "X, Y and Z" : "X and Y"),
                "save it as linear RGB of Rec. 709");
  }
}

std::vector<int> indices_of(const Layer& layer, const std::vector<std::string>& names) {
  std::vector<int> indices;
  for (const std::string& name : names) indices.push_back(layer.find(name)->second);
  return indices;
}

}  // namespace

ChosenChannels choose_channels(const std::vector<std::string>& names, bool takes_vectors, const std::string& place) {
  constexpr std::size_t most = 4;
  ChosenChannels chosen;
  const std::map<std::string, Layer> layers = layers_of(names);
  chosen.layer = names.empty() ? "" : image_layer(layers, place);
  const Layer layer = names.empty() ? Layer() : layers.at(chosen.layer);
  if (const auto known = known_names(layer)) {
    require_colors(layer, *known, takes_vectors, place);
    chosen.indices = indices_of(layer, *known);
    const auto alpha = layer.find("a");
    chosen.has_coverage = alpha != layer.end() && known->size() != 2;  // a vector of two has none
    if (chosen.has_coverage) chosen.indices.push_back(alpha->second);
  } else if (!names.empty() && names.size() <= most) {
    for (std::size_t i = 0; i < names.size(); ++i) chosen.indices.push_back(static_cast<int>(i));
  } else {
    throw Error(ErrorKind::usage, place, fmt::format("has {} channels, none of them R, G, B or Y", names.size()),
                "give one with 1 to 4 channels, or name those that count R, G, B and A");
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (std::ranges::find(chosen.indices, static_cast<int>(i)) == chosen.indices.end())
      chosen.left_out.push_back(names[i]);
  }
  return chosen;
}

bool names_rgb(const std::vector<std::string>& names) { return has(layers_of(names)[""], {"r", "g", "b"}); }

}  // namespace footprint

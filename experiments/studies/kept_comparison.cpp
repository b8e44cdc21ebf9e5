// Which settings enter which key.
#include "experiments/studies/kept_comparison.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <utility>

#include "experiments/studies/picture_files.hpp"
#include "experiments/studies/stage.hpp"
#include "renderer/scene/material_content.hpp"

namespace footprint {
namespace {

std::string number(double value) { return fmt::format("{}", value); }  // as many digits as it takes

// What the scene is and how it is looked at, whatever is measured of it.
std::string seen_content(const RunSettings& settings, const Scene& scene, const std::string& content) {
  const auto& [size, quick_size, distances, zoom, exposure, error_scale] = settings.view;
  const glm::ivec2 pixels = frame_size(scene, size);
  ContentHash hash;
  hash.add(content);
  hash.add(settings.without.to_string());
  hash.add(fmt::format("{}x{}", pixels.x, pixels.y));
  hash.add(footprint_filter_text(footprint_filter_of(settings, scene)));
  hash.add(fmt::format("{}", settings.backend.tile));
  hash.add(settings.by_material ? "by material" : "");
  return hash.hex();
}

// Empty: that of the methods.
std::string unit_text(const RunSettings& settings) {
  return settings.timing.unit ? footprint_filter_text(*settings.timing.unit) : "";
}

// Everything that errors are measured against, but for the distance. An automatic exposure is that of the first one.
std::string reference_content(const RunSettings& settings, const Scene& scene, double first_distance) {
  const auto& [spp, by_noise, fixed_spp, noise, spp_max, other_spp, supersampling, seed, filter, environment, bound,
               by_cause] = settings.reference;
  ContentHash hash;
  const bool adapts = by_noise && !fixed_spp;
  hash.add(fmt::format("{} {} {} {}", spp, adapts, noise ? number(*noise) : "auto", spp_max));
  hash.add(fmt::format("{} / {}", fmt::join(other_spp, " "), fmt::join(supersampling, " ")));
  hash.add(unit_text(settings));
  hash.add(fmt::format("{} {} {} {} {}", seed, static_cast<int>(filter), static_cast<int>(environment),
                       static_cast<int>(bound), by_cause));
  if (adapts && !noise) {
    for (const MethodSpec& method : settings.methods) hash.add(method.text);  // their differences say how many samples
  }
  const std::optional<Exposure>& given = settings.view.exposure;
  if (given) {
    hash.add(fmt::format("{} {}", given->factor, static_cast<int>(given->source)));
  } else {
    hash.add(scene.exposure ? "the scene's" : "automatic at " + number(first_distance));
  }
  return hash.hex();
}

}  // namespace

std::string scene_content(const Scene& scene) {
  ContentHash hash;
  add_content(hash, scene);
  return hash.hex();
}

ComparisonKeys::ComparisonKeys(const KeptWork& work, const RunSettings& settings, const Scene& scene,
                               const std::string& content, std::vector<double> distances)
    : work_(&work),
      settings_(&settings),
      distances_(std::move(distances)),
      scene_(seen_content(settings, scene, content)),
      reference_(reference_content(settings, scene, distances_.front())),
      source_(scene.source) {}

std::string ComparisonKeys::truth(std::size_t distance) const {
  return work_->key("truth", std::vector{scene_, reference_, number(distances_[distance])});
}

// In a zoom the frame before counts too: flicker is measured against it.
std::string ComparisonKeys::record(std::size_t distance, std::size_t method) const {
  const bool has_before = settings_->view.zoom.frames > 0 && distance > 0;
  return work_->key("record", std::vector{scene_, reference_, number(distances_[distance]),
                                          has_before ? number(distances_[distance - 1]) : std::string("alone"),
                                          settings_->methods[method].text, method_stem(settings_->methods, method)});
}

std::string ComparisonKeys::pairs(std::size_t distance) const {
  return work_->key("pairs", with_methods({scene_, reference_, number(distances_[distance])}));
}

std::string ComparisonKeys::times(std::size_t distance) const {
  return work_->key("times",
                    with_methods({scene_, number(distances_[distance]), unit_text(*settings_),
                                  fmt::format("{} {}", settings_->timing.repeats, settings_->timing.processes)}));
}

std::string ComparisonKeys::head() const {
  return work_->key("head",
                    with_methods({scene_, source_, fmt::format("{}", static_cast<int>(settings_->reference.bound))}));
}

std::string ComparisonKeys::shared_truth(const std::string& first, std::size_t distance) const {
  return work_->key("shared", std::vector{first, number(distances_[distance])});
}

std::string ComparisonKeys::of_scene(std::string_view kind, const std::vector<std::string>& more) const {
  std::vector<std::string> fields{scene_};
  fields.insert(fields.end(), more.begin(), more.end());
  return work_->key(kind, with_methods(std::move(fields)));
}

std::vector<std::string> ComparisonKeys::all_of(std::size_t distance) const {
  std::vector<std::string> keys{truth(distance), pairs(distance), times(distance), head()};
  for (std::size_t m = 0; m < settings_->methods.size(); ++m) keys.push_back(record(distance, m));
  return keys;
}

std::vector<std::string> ComparisonKeys::with_methods(std::vector<std::string> fields) const {
  for (std::size_t m = 0; m < settings_->methods.size(); ++m) {
    fields.push_back(settings_->methods[m].text);
    fields.push_back(method_stem(settings_->methods, m));
  }
  return fields;
}

std::vector<std::string> exposable_files(const std::string& exr) {
  const std::string stem = exr.substr(0, exr.size() - std::string_view(".exr").size());
  return {exr, stem + ".png", stem + "_dark.png"};
}

std::vector<std::string> files_of(const TruthFiles& files) {
  std::vector<std::string> all = exposable_files(files.reference);
  all.insert(all.end(), {files.standard_error, files.interior,
                         std::filesystem::path(files.interior).replace_extension(".png").string()});
  return all;
}

std::vector<std::uint32_t> set_pixels(const Image& mask) {
  std::vector<std::uint32_t> pixels;
  for (std::size_t i = 0; i < mask.texels.size(); ++i) {
    if (mask.texels[i] > 0.0F) pixels.push_back(static_cast<std::uint32_t>(i));
  }
  return pixels;
}

Image mask_of(std::span<const std::uint32_t> pixels, int width, int height) {
  Image mask(width, height, 1);
  for (const std::uint32_t pixel : pixels) {
    if (pixel < mask.texels.size()) mask.texels[pixel] = 1.0F;
  }
  return mask;
}

}  // namespace footprint

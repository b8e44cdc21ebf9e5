// Bakes or reads one material after the other, with time, bytes, and notes on lobes that the storage cannot resolve.
#include "renderer/bake/baked_method.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <iterator>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "renderer/bake/facets.hpp"
#include "renderer/bake/normal_chain.hpp"
#include "renderer/core/bytes.hpp"
#include "renderer/core/error.hpp"
#include "renderer/scene/scene.hpp"

namespace footprint {
namespace {

// Smallest slope variances that every method reproduces over a tilted map.
constexpr double least_in_half_floats = 2e-4;
constexpr double least_in_bytes = 0.02;

double narrowest_variance(const Material& material) {
  if (!material.lobes.empty()) return mean_lobe_variance(material);
  const Image variances = lobe_variance_map(material);
  return *std::ranges::min_element(variances.texels);
}

struct Outcome {
  Prefiltered prefiltered;
  bool from_disk;
};

Prefiltered precomputed(const Method& method, const Scene& scene, std::size_t index, const Options& options,
                        const EffectSet& effects, const Progress& progress) {
  return method.precompute_on ? method.precompute_on(scene, index, options, effects, progress)
                              : method.precompute(scene.materials.at(index), options, effects, progress);
}

// Bakes one material, or takes it from `source`.
Outcome prefilter(const Method& method, const Scene& scene, std::size_t index, const Options& options,
                  const EffectSet& effects, const Progress& progress, const BakeSource& source) {
  const Material& material = scene.materials.at(index);
  if (source.given) return {source.given(index), true};
  if (source.before != nullptr && method.precompute_brdf)
    return {method.precompute_brdf(source.before->materials.at(index), material, options, effects), false};
  const DiskCache* const cache = source.cache;
  if (cache == nullptr || !method.info.slow_precompute)
    return {precomputed(method, scene, index, options, effects, progress), false};
  const std::string key = bake_key(method.info.name + method.file_content, material, options, effects);
  const std::optional<ByteSource> bytes = cache->find(key);
  if (auto cached = bytes ? from_bytes(*bytes) : std::nullopt) return {*std::move(cached), true};
  Outcome outcome{precomputed(method, scene, index, options, effects, progress), false};
  cache->store(key, byte_count(outcome.prefiltered),
               [&](const ByteSink& out) { write_bytes(outcome.prefiltered, out); });
  return outcome;
}

// Finds the textures of the last material that an earlier one has; `known` are the texels so far. Textures of a frame
// build are never shared.
void find_shared(BakedMethod& baked, std::set<std::uint64_t>& known) {
  const std::vector<PrefilteredTexture>& textures = baked.materials.back().textures;
  for (std::size_t i = 0; i < textures.size(); ++i) {
    if (!textures[i].built && !known.insert(texel_content(textures[i])).second)
      baked.shared.emplace(baked.materials.size() - 1, i);
  }
}

// The bytes of the last material without shared textures.
std::size_t added_bytes(const BakedMethod& baked) {
  std::size_t bytes = byte_count(baked.materials.back());
  for (const auto& [material, texture] : baked.shared) {
    if (material + 1 == baked.materials.size()) bytes -= byte_count(baked.materials.back().textures[texture]);
  }
  return bytes;
}

constexpr std::string_view form = "footprint bake 8";  // another number for another layout

}  // namespace

void write_bytes(const Prefiltered& prefiltered, const ByteSink& sink) { write_checksummed(form, prefiltered, sink); }

std::optional<Prefiltered> from_bytes(const ByteSource& bytes) { return read_checksummed<Prefiltered>(form, bytes); }

std::string bake_key(const std::string& method, const Material& material, const Options& options,
                     const EffectSet& effects) {
  ContentHash hash;
  add_program(hash);
  for (const auto& [name, value] : options.all()) {
    hash.add(name);
    if (const auto* word = std::get_if<std::string>(&value)) hash.add(*word);
    if (const auto* number = std::get_if<double>(&value)) hash.add(std::as_bytes(std::span(number, 1)));
  }
  hash.add(effects.to_string());
  add_content(hash, material);
  return fmt::format("{}-{}", method, hash.hex());
}

std::optional<std::string> storage_range_note(const Material& material, const MethodInfo& info, const Options& options,
                                              const EffectSet& effects) {
  if (info.lobes_as_given || !has(effects, Effect::normal_variation) || !options.all().contains("storage")) return {};
  const std::string& storage = options.word("storage");
  const double least = storage == "unorm8" ? least_in_bytes : storage == "fp16" ? least_in_half_floats : 0.0;
  if (least == 0.0) return {};
  const double narrowest = narrowest_variance(material);
  if (narrowest >= least) return {};
  return fmt::format(
      "storage={} can store slope variances from {:g} on, but this material's narrowest lobe has {:.2g}: its "
      "highlights are off (docs/results/stability.md)",
      storage, least, narrowest);
}

std::vector<std::string> common_notes(const Method& method, const Material& material, const Options& options,
                                      const EffectSet& effects) {
  std::vector<std::string> notes;
  if (auto note = storage_range_note(material, method.info, options, effects & method.info.honours))
    notes.push_back(*std::move(note));
  if (material.anisotropy && has(effects & ~method.info.honours, Effect::anisotropic_lobe))
    notes.emplace_back("uses the round mean of the anisotropic base BRDF (docs/explanation/base-brdf.md)");
  return notes;
}

Options options_of(const Method& method, const MethodSpec& spec) {
  return {method.info.options, spec.options, "method " + spec.name};
}

BakedMethod make_bake(const Method& method, const MethodSpec& spec) {
  return {.method = &method, .spec = spec, .options = options_of(method, spec)};
}

void bake_materials(BakedMethod& baked, const Scene& scene, const EffectSet& effects, const Progress& progress,
                    const BakeSource& source, const MaterialBaked& when_baked) {
  const Method& method = *baked.method;
  baked.cached = source.given || (source.cache != nullptr && method.info.slow_precompute);
  const auto count = static_cast<double>(scene.materials.size());
  std::set<std::uint64_t> known;
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const auto start = std::chrono::steady_clock::now();
    const Material& material = scene.materials[i];
    const auto done = static_cast<double>(i);
    const Progress part = [&](std::string_view what, double fraction) { progress(what, (done + fraction) / count); };
    part(fmt::format("{}: {}", baked.spec.text, material.name), 0.0);
    try {
      const EffectSet honoured = effects & method.info.honours;
      auto [prefiltered, from_disk] = prefilter(method, scene, i, baked.options, honoured, part, source);
      std::ranges::move(common_notes(method, material, baked.options, effects), std::back_inserter(prefiltered.notes));
      if (!baked.given_by.empty()) prefiltered.notes.push_back("maps from " + baked.given_by);
      baked.materials.push_back(std::move(prefiltered));
      baked.cached = baked.cached && from_disk;
    } catch (const Error& error) {
      throw error.within(fmt::format("{}, material {}, method {}", scene.source, material.name, baked.spec.text));
    }
    baked.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (scene.materials.size() > 1) find_shared(baked, known);
    baked.bytes += added_bytes(baked);
    baked.texels += finest_texels(baked.materials.back());
    when_baked(i);
  }
}

BakedMethod bake(const Method& method, const MethodSpec& spec, const Scene& scene, const EffectSet& effects,
                 const Progress& progress, const DiskCache* cache) {
  BakedMethod baked = make_bake(method, spec);
  bake_materials(baked, scene, effects, progress, {.cache = cache}, [](std::size_t) {});
  return baked;
}

BakedMethod bake_after_brdf(const BakedMethod& before, const Scene& scene, const EffectSet& effects,
                            const Progress& progress) {
  BakedMethod baked = make_bake(*before.method, before.spec);
  bake_materials(baked, scene, effects, progress, {.before = &before}, [](std::size_t) {});
  return baked;
}

}  // namespace footprint

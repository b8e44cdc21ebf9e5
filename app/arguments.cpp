// See arguments.hpp.
#include "app/arguments.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <sstream>

#include "app/options.hpp"
#include "renderer/bake/bake_cache.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/memory.hpp"
#include "scenes/surfaces/registry.hpp"

namespace footprint {
namespace {

// What the environment names, or the source tree's own.
std::filesystem::path folder_of(const char* variable, const char* otherwise) {
  const char* given = std::getenv(variable);
  return given != nullptr && *given != '\0' ? given : otherwise;
}

}  // namespace

void add_backend_options(CLI::App& command, BackendArguments& arguments) {
  command.add_option("--backend", arguments.backend, "OpenGL by auto, egl, egl-device or osmesa")
      ->capture_default_str();
  command.add_option("--device", arguments.device, "Which GPU for egl-device, as `footprint info` numbers them")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command.add_option("--tile", arguments.tile, "Side of the tiles a frame is rendered in, pixels; 0: as few as fit")
      ->check(CLI::Range(0, 1 << 16))
      ->capture_default_str();
}

gl::ContextRequest context_request(const BackendArguments& arguments) {
  return {.backend = gl::parse_backend(arguments.backend), .device = arguments.device};
}

void add_frame_options(CLI::App& command, FrameArguments& arguments, const std::string& exposed) {
  command.add_option("scene", arguments.scene, "What to render")->required();
  add_size_option(command, arguments.size);
  add_anisotropy_option(command, arguments.anisotropy);
  command.add_option("--exposure", arguments.exposure, fmt::format("Factor on radiance {}, or auto", exposed))
      ->capture_default_str();
  add_backend_options(command, arguments.backend);
  add_quiet_flag(command, arguments.quiet);
}

void add_reference_options(CLI::App& command, ReferenceArguments& arguments) {
  command.add_option("--spp", arguments.spp, "Samples a pixel of the reference")
      ->check(CLI::Range(1, 4096))
      ->capture_default_str();
  command.add_option("--seed", arguments.seed, "Seed of the reference's samples: same seed, same bytes")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command.add_option("--filter", arguments.filter, "The reference's filter: after_shading, nearest or bilinear")
      ->capture_default_str();
  command
      .add_option(
          "--environment", arguments.environment,
          "How the reference integrates an environment: sampled, or dense (6 x 32 x 32 lights for every sample)")
      ->capture_default_str();
}

void add_size_option(CLI::App& command, std::string& text) {
  command.add_option("--size", text, "Frame size WIDTHxHEIGHT, pixels; if not given the scene's, or 512x512");
}

void add_anisotropy_option(CLI::App& command, int& probes) {
  command.add_option("--anisotropy", probes, "Probes along the footprint's major axis; 1: isotropic")
      ->check(CLI::Range(1, 16))
      ->capture_default_str();
}

void add_cache_flag(CLI::App& command, bool& no_cache) {
  command.add_flag(
      "--no-cache", no_cache,
      "Bake anew: neither read nor keep slow precomputes (kept in $FOOTPRINT_CACHE, or ~/.cache/footprint)");
}

std::optional<std::filesystem::path> cache_folder(bool no_cache) {
  return no_cache ? std::nullopt : default_cache_folder();
}

void add_processes_option(CLI::App& command, int& processes) {
  command.add_option("--processes", processes, "Processes that time frames, one after the other")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
}

void add_quiet_flag(CLI::App& command, bool& quiet) {
  command.add_flag("-q,--quiet", quiet, "No progress on standard error");
}

std::optional<glm::ivec2> parse_optional_size(const std::string& text) {
  if (text.empty()) return std::nullopt;
  constexpr std::uint64_t pixel_bytes = 4 * sizeof(float);
  const glm::ivec2 size = parse_size(text);
  require_memory(frame_bytes(static_cast<std::uint64_t>(size.x), static_cast<std::uint64_t>(size.y), pixel_bytes),
                 fmt::format("a picture of {}x{}", size.x, size.y));
  return size;
}

MethodSpec parse_known_method(std::string_view option, const std::string& text) {
  if (text == "reference") return {.text = text, .name = text, .options = {}};
  const std::vector<MethodSpec> methods = parse_known_methods(text);
  if (methods.size() == 1) return methods.front();
  throw Error(ErrorKind::usage, std::string(option), fmt::format("`{}` is more than one method", text), "name one");
}

EffectSet parse_effects(std::string_view option, const std::string& text) {
  const std::vector<std::string> names = effect_names(EffectSet{}.set());
  EffectSet effects;
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, ',');) effects.set(parse_choice(option, word, names));
  return effects;
}

std::filesystem::path experiments_folder() { return folder_of("FOOTPRINT_EXPERIMENTS", FOOTPRINT_EXPERIMENTS_FOLDER); }

SceneLibrary scene_library() {
  return {.folder = folder_of("FOOTPRINT_SCENES", FOOTPRINT_SCENES_FOLDER), .surfaces = all_surfaces()};
}

}  // namespace footprint

// Arguments that several subcommands share, as the parser fills them, and what they mean.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/studies/known_methods.hpp"
#include "renderer/effects/effects.hpp"
#include "renderer/gl/context.hpp"
#include "renderer/scene/surface.hpp"

namespace footprint {

/// Which OpenGL to render with.
struct BackendArguments {
  std::string backend = "auto";
  int device = 0;
  int tile = 0;  ///< texels a side; 0: as large as the backend's limit
};

/// Adds --backend, --device and --tile.
void add_backend_options(CLI::App& command, BackendArguments& arguments);

/// Errors (usage): no such backend.
[[nodiscard]] gl::ContextRequest context_request(const BackendArguments& arguments);

/// What every command needs that renders frames of a scene.
struct FrameArguments {
  std::string scene;
  std::string size;  ///< empty: the scene's
  std::string exposure = "auto";
  int anisotropy = 1;
  BackendArguments backend;
  bool quiet = false;
};

/// Adds the scene, --size, --anisotropy, --exposure (a factor on radiance for what `exposed` says), --quiet, and the
/// backend's options.
void add_frame_options(CLI::App& command, FrameArguments& arguments, const std::string& exposed);

/// What the reference is made with.
struct ReferenceArguments {
  int spp = 64;
  std::uint64_t seed = 1;
  std::string filter = "after_shading";
  std::string environment = "sampled";
};

/// Adds --spp, --seed, --filter and --environment.
void add_reference_options(CLI::App& command, ReferenceArguments& arguments);

/// Adds --size; `text` stays empty if it is not given, and the scene's own size counts.
void add_size_option(CLI::App& command, std::string& text);

/// Adds --anisotropy.
void add_anisotropy_option(CLI::App& command, int& probes);

/// `--processes`: how many processes time frames.
void add_processes_option(CLI::App& command, int& processes);

/// Adds --no-cache.
void add_cache_flag(CLI::App& command, bool& no_cache);

/// Where slow precomputes are kept between runs; none with --no-cache, or where no folder for caches is known.
[[nodiscard]] std::optional<std::filesystem::path> cache_folder(bool no_cache);

/// Adds --quiet.
void add_quiet_flag(CLI::App& command, bool& quiet);

/// The size that --size gives; empty if it was not given. Errors (usage): no size; (machine): one picture of that size
/// is more than memory holds, known before anything is loaded.
[[nodiscard]] std::optional<glm::ivec2> parse_optional_size(const std::string& text);

/// The one method that `option` gives; `reference` counts as one. Errors (usage): more than one, or not known.
[[nodiscard]] MethodSpec parse_known_method(std::string_view option, const std::string& text);

/// The effects that `text` names, commas between; none if it is empty. Errors (usage) name `option` and the nearest
/// right name.
[[nodiscard]] EffectSet parse_effects(std::string_view option, const std::string& text);

/// Where the experiments that have a name lie: the environment variable FOOTPRINT_EXPERIMENTS, or the source tree's
/// experiments/.
[[nodiscard]] std::filesystem::path experiments_folder();

/// Where the scenes that have a name lie (the environment variable FOOTPRINT_SCENES, or the source tree's scenes/), and
/// the surfaces of this build.
[[nodiscard]] SceneLibrary scene_library();

}  // namespace footprint

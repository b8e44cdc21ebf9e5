// NUMBER.vert and NUMBER.frag have SPIR-V; NUMBER.targets the formats of the targets; NUMBER.json the outcome;
// device.txt the driver's name of the chip.
#include "renderer/gpu_cost/compiled_programs.hpp"

#include <fmt/format.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "renderer/core/error.hpp"
#include "renderer/core/files.hpp"

namespace footprint {
namespace {

namespace fs = std::filesystem;

fs::path file_of(const fs::path& folder, std::size_t program, const char* extension) {
  return folder / fmt::format("{}.{}", program, extension);
}

void write_words(const fs::path& file, const Spirv& words) {
  std::string bytes(words.size() * sizeof(Spirv::value_type), '\0');
  std::memcpy(bytes.data(), words.data(), bytes.size());
  write_file_atomically(file, bytes);
}

Spirv words_of(const fs::path& file) {
  const std::string bytes = file_text(file);
  Spirv words(bytes.size() / sizeof(Spirv::value_type));
  std::memcpy(words.data(), bytes.data(), words.size() * sizeof(Spirv::value_type));
  return words;
}

void write_targets(const fs::path& file, const std::vector<ColorTarget>& targets) {
  auto json = nlohmann::json::array();
  for (const ColorTarget& target : targets) json.push_back({target.channels, target.bits});
  write_file_atomically(file, std::string_view(json.dump()));
}

std::vector<ColorTarget> targets_of(const fs::path& file) {
  std::vector<ColorTarget> targets;
  for (const nlohmann::json& target : nlohmann::json::parse(file_text(file)))
    targets.push_back({.channels = target.at(0).get<int>(), .bits = target.at(1).get<int>()});
  return targets;
}

SpirvProgram program_of(const fs::path& folder, std::size_t program) {
  return {.vertex = words_of(file_of(folder, program, "vert")),
          .fragment = words_of(file_of(folder, program, "frag")),
          .targets = targets_of(file_of(folder, program, "targets"))};
}

nlohmann::json json_of(const CompileOutcome& outcome) {
  if (!outcome.stage) return {{"failure", outcome.failure}};
  return {
      {"statistics", outcome.stage->statistics}, {"code", outcome.stage->code}, {"seconds", outcome.stage->seconds}};
}

CompileOutcome outcome_of(const nlohmann::json& json) {
  if (json.contains("failure")) return {.stage = {}, .failure = json.at("failure").get<std::string>()};
  CompiledStage stage;
  json.at("statistics").get_to(stage.statistics);
  json.at("code").get_to(stage.code);
  json.at("seconds").get_to(stage.seconds);
  return {.stage = std::move(stage), .failure = {}};
}

void write_outcome(const fs::path& folder, std::size_t program, const CompileOutcome& outcome) {
  write_file_atomically(file_of(folder, program, "json"), std::string_view(json_of(outcome).dump()));
}

CompileOutcome compiled(const VulkanCompiler& compiler, const SpirvProgram& program) {
  try {
    return {.stage = compiler.compile(program), .failure = {}};
  } catch (const Error& error) {
    return {.stage = {}, .failure = error.what()};
  }
}

}  // namespace

void write_programs(std::span<const SpirvProgram> programs, const fs::path& folder) {
  for (std::size_t i = 0; i < programs.size(); ++i) {
    write_words(file_of(folder, i, "vert"), programs[i].vertex);
    write_words(file_of(folder, i, "frag"), programs[i].fragment);
    write_targets(file_of(folder, i, "targets"), programs[i].targets);
  }
}

void compile_programs(const fs::path& folder) {
  const VulkanCompiler compiler;
  write_file_atomically(folder / "device.txt", std::string_view(compiler.device()));
  for (std::size_t i = 0; fs::exists(file_of(folder, i, "frag")); ++i) {
    if (fs::exists(file_of(folder, i, "json"))) continue;
    write_outcome(folder, i, {.stage = {}, .failure = "the driver's compiler was interrupted by a crash"});
    write_outcome(folder, i, compiled(compiler, program_of(folder, i)));
  }
}

std::size_t compiled_count(const fs::path& folder) {
  std::size_t count = 0;
  while (fs::exists(file_of(folder, count, "json"))) ++count;
  return count;
}

ChipOutcomes read_outcomes(const fs::path& folder, std::size_t count) {
  ChipOutcomes outcomes{.device = file_text(folder / "device.txt"), .programs = {}};
  for (std::size_t i = 0; i < count; ++i) {
    const fs::path file = file_of(folder, i, "json");
    try {
      outcomes.programs.push_back(outcome_of(nlohmann::json::parse(file_text(file))));
    } catch (const nlohmann::json::exception& error) {
      throw Error(ErrorKind::machine, file.string(), error.what(), "run the command again");
    }
  }
  return outcomes;
}

}  // namespace footprint

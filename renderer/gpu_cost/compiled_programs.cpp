// NUMBER.vert and NUMBER.frag have SPIR-V; NUMBER.json the outcome; device.txt the driver's name of the chip.
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
  }
}

void compile_programs(const fs::path& folder) {
  const VulkanCompiler compiler;
  write_file_atomically(folder / "device.txt", std::string_view(compiler.device()));
  for (std::size_t i = 0; fs::exists(file_of(folder, i, "frag")); ++i) {
    if (fs::exists(file_of(folder, i, "json"))) continue;
    write_outcome(folder, i, {.stage = {}, .failure = "the driver's compiler was interrupted by a crash"});
    write_outcome(folder, i,
                  compiled(compiler, {words_of(file_of(folder, i, "vert")), words_of(file_of(folder, i, "frag"))}));
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

// Files have checksums; device.txt has the driver's name of the chip.
#include "renderer/gpu_cost/compiled_programs.hpp"

#include <fmt/format.h>

#include <utility>

#include "renderer/core/bytes.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/files.hpp"
#include "renderer/core/memory.hpp"

namespace footprint {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view form = "footprint-gpu/1";           // of the files
constexpr std::uint64_t most_memory = std::uint64_t{4} << 30;  // of a compiler, which may unroll without an end

// NUMBER.program is a program, NUMBER.outcome what became of it.
fs::path file_of(const fs::path& folder, std::size_t program, const char* extension) {
  return folder / fmt::format("{}.{}", program, extension);
}

template <class Value>
void write_value(const fs::path& file, const Value& value) {
  write_file_atomically(file, [&](const ByteSink& out) { write_checksummed(form, value, out); });
}

template <class Value>
Value read_value(const fs::path& file) {
  if (const std::optional<ByteSource> bytes = ByteSource::of_file(file)) {
    if (std::optional<Value> value = read_checksummed<Value>(form, *bytes)) return *std::move(value);
  }
  throw Error(ErrorKind::machine, file.string(), "is missing or damaged", "run the command again");
}

SpirvProgram spirv_of_program(const GlslProgram& program) {
  SpirvProgram spirv = spirv_program(program.name, program.vertex, program.fragment);
  spirv.targets = program.targets;
  return spirv;
}

CompileOutcome compile_program(const VulkanCompiler& compiler, const SpirvProgram& program) {
  try {
    return {.stage = compiler.compile(program), .failure = {}};
  } catch (const Error& error) {
    return {.stage = {}, .failure = error.what()};
  }
}

}  // namespace

void write_programs(std::span<const GlslProgram> programs, const fs::path& folder) {
  for (std::size_t i = 0; i < programs.size(); ++i)
    write_value(file_of(folder, i, "program"), spirv_of_program(programs[i]));
}

void compile_programs(const fs::path& folder) {
  limit_growth(most_memory);
  const std::string crash =
      fmt::format("the driver's compiler crashed, or needs more than {}", readable_bytes(most_memory));
  const VulkanCompiler compiler = vulkan_compiler();
  write_file_atomically(folder / "device.txt", std::string_view(compiler.device));
  for (std::size_t i = 0; fs::exists(file_of(folder, i, "program")); ++i) {
    const fs::path outcome = file_of(folder, i, "outcome");
    if (fs::exists(outcome)) continue;
    write_value(outcome, CompileOutcome{.stage = {}, .failure = crash});
    write_value(outcome, compile_program(compiler, read_value<SpirvProgram>(file_of(folder, i, "program"))));
  }
}

std::size_t compiled_count(const fs::path& folder) {
  std::size_t count = 0;
  while (fs::exists(file_of(folder, count, "outcome"))) ++count;
  return count;
}

ChipOutcomes read_outcomes(const fs::path& folder, std::size_t count) {
  ChipOutcomes outcomes{.device = file_text(folder / "device.txt"), .programs = {}};
  for (std::size_t i = 0; i < count; ++i)
    outcomes.programs.push_back(read_value<CompileOutcome>(file_of(folder, i, "outcome")));
  return outcomes;
}

}  // namespace footprint

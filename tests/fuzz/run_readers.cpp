// The readers of what runs are asked for and leave: experiments, what parts of a run say of themselves, lists of files,
// and what is kept of finished work.
#include <cstdio>
#include <cstdlib>

#include "app/part_file.hpp"
#include "experiments/runner/experiment.hpp"
#include "results/report/listed_files.hpp"
#include "tests/fuzz/fuzz_target.hpp"

namespace footprint::fuzz {

Reader reader_named(const std::string& name) {
  using Path = std::filesystem::path;
  using Bytes = std::span<const std::uint8_t>;
  if (name == "experiment")
    return {"experiment.toml", [](const Path& file, Bytes) { static_cast<void>(read_experiment(file)); }};
  if (name == "part")
    return {"part.json", [](const Path& file, Bytes) { static_cast<void>(read_part_file(file.parent_path())); }};
  if (name == "results")
    return {"results.json", [](const Path& file, Bytes) { static_cast<void>(listed_files(file)); }};
  std::fprintf(stderr, "there is no reader %s\n", name.c_str());
  std::abort();
}

}  // namespace footprint::fuzz

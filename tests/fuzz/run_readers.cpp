// The readers of the files that runs read and leave: experiments, parts of a run, lists of files, and finished work.
#include <cstdio>
#include <cstdlib>

#include "app/part_file.hpp"
#include "experiments/runner/experiment.hpp"
#include "results/report/report.hpp"
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
  std::fprintf(stderr, "%s is not a reader\n", name.c_str());
  std::abort();
}

}  // namespace footprint::fuzz

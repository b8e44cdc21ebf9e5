// `footprint cost`: what each method costs on GPUs, estimated from a driver's compiler.
#include "app/child_process.hpp"
#include "app/subcommand.hpp"
#include "experiments/studies/frame_times.hpp"
#include "experiments/studies/gpu_cost.hpp"
#include "renderer/languages/compilers.hpp"

namespace footprint {
namespace {

constexpr const char* cost_examples =
    R"(Compiles each method's program with Mesa's compiler for AMD GPUs, which needs no GPU, and combines the instructions
with the loop counts of the frame and the published rates of each chip (docs/explanation/gpu-cost.md).

Examples:
  footprint cost model.gltf
  footprint cost carved_disk --methods direct,toksvig,lean,tan_gmm --gpu "Steam Deck,RX 6800"
  footprint cost carved_disk --methods lean,tan_gmm:n=2,tan_gmm:n=4 --gpu all -o cost)";

struct CostArguments : RunArguments {
  explicit CostArguments(CLI::App& command) : RunArguments(command) {
    add_output_folder(command, output, "Folder for cost.json, cost.csv, table.md; default: none");
  }

  std::string output;  // empty: the table is only printed
};

void run_cost(const CostArguments& arguments) {
  const RunSettings settings = arguments.settings();
  require_compilers("cost");
  ProgressDisplay display(progress_style(arguments.quiet));
  CostReport report = estimate_costs(settings, amd_compiler(), display.callback());
  display.finish();
  sign(report.tool, report.backend);
  if (!arguments.output.empty()) {
    const auto [made, path, lost] = write_whole(arguments.output, [&](OutputFolder& folder) {
      write_cost(report, folder.run());
      keep(folder);
      return true;
    });
    write_output(fmt::format("{}\ncosts: {}\n", cost_table(report), (path / "cost.json").string()));
    throw_first({lost});
  } else {
    write_output(cost_table(report));
  }
}

}  // namespace

void add_cost_command(CLI::App& app) {
  add_command(app, "cost", "Estimate what methods cost on GPUs, without a GPU", cost_examples, run_cost);
}

}  // namespace footprint

// `footprint cost`: what each method costs on GPUs, estimated from a driver's compiler.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "app/child_process.hpp"
#include "app/commands.hpp"
#include "app/messages.hpp"
#include "app/output.hpp"
#include "app/run_options.hpp"
#include "experiments/studies/gpu_cost.hpp"

namespace footprint {
namespace {

constexpr const char* cost_examples =
    "Compiles each method's program with Mesa's compiler for AMD GPUs, which needs no GPU, and combines the "
    "instructions\n"
    "with the loop counts of the frame and the published rates of each chip (docs/explanation/gpu-cost.md).\n"
    "\n"
    "Examples:\n"
    "  footprint cost model.gltf\n"
    "  footprint cost carved_disk --methods direct,toksvig,lean,tan_gmm --gpu \"Steam Deck,RX 6800\"\n"
    "  footprint cost carved_disk --methods lean,tan_gmm:n=2,tan_gmm:n=4 --gpu all -o cost";

struct CostArguments {
  explicit CostArguments(CLI::App& command) : run(command) {}

  RunOptions run;
  std::string output;  // empty: the table is only printed
  bool quiet = false;
};

void run_cost(const CostArguments& arguments) {
  const RunSettings settings = arguments.run.settings();
  ProgressDisplay display(progress_style(arguments.quiet));
  CostReport report = estimate_costs(settings, amd_compiler(), display.callback());
  display.finish();
  sign(report.tool, report.backend);
  if (!arguments.output.empty()) {
    const auto path = write_whole(arguments.output, [&](OutputFolder& folder) {
                        write_cost(report, folder.path());
                        keep(folder);
                        return true;
                      }).second;
    write_output(fmt::format("{}\ncosts: {}\n", cost_table(report), (path / "cost.json").string()));
  } else {
    write_output(cost_table(report));
  }
}

}  // namespace

void add_cost_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("cost", "Estimate what methods cost on GPUs, without a GPU");
  const auto arguments = std::make_shared<CostArguments>(*command);
  command->add_option("-o,--output", arguments->output, "Folder for cost.json, cost.csv, table.md; default: none")
      ->type_name("DIR");
  add_quiet_flag(*command, arguments->quiet);
  command->footer(cost_examples);
  command->callback([arguments] { run_cost(*arguments); });
}

}  // namespace footprint

// Compares the schemas of docs/ with the fields of results/report/record_fields.hpp: footprint_schemas FOLDER.
// With --write it gives them that structure, and a new property the description of its figure, or an empty one to fill
// in.
#include <fmt/format.h>

#include <array>
#include <exception>
#include <filesystem>
#include <fstream>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "renderer/core/files.hpp"
#include "results/report/record_fields.hpp"
#include "results/report/region_report.hpp"
#include "results/report/report.hpp"
#include "tests/report/schema_archive.hpp"
#include "tests/report/schema_structure.hpp"

namespace footprint::test {
namespace {

using Json = nlohmann::ordered_json;

// The structure of results.json, in which a figure of any two images is described by its row.
Json results_structure() {
  Json structure = SchemaArchive::schema_of(Results{});
  Json& errors = structure["properties"]["records"]["items"]["properties"]["error"]["properties"];
  for (const Figure& figure : record_figures()) {
    if (figure.metric)
      errors[metric_name(figure)]["description"] = fmt::format("{} Unit: {}.", plain(figure.meaning), figure.unit);
  }
  return structure;
}

// Each schema by its file, with the structure that the fields give.
std::array<std::pair<std::string_view, Json>, 5> structures() {
  const MatrixResults matrix{.report = {}, .left_out = {}, .members = {MatrixMember{}}};
  return {{{"results.schema.json", results_structure()},
           {"matrix.schema.json", SchemaArchive::schema_of(matrix)},
           {"ndf.schema.json", SchemaArchive::schema_of(NdfResults{})},
           {"recommend.schema.json", SchemaArchive::schema_of(Recommendation{})},
           {"region.schema.json", SchemaArchive::schema_of(RegionReport{})}}};
}

// Returns the number of differences, after printing them.
std::size_t compare(const std::filesystem::path& folder, bool write) {
  std::size_t count = 0;
  for (const auto& [name, structure] : structures()) {
    const std::filesystem::path file = folder / name;
    std::ifstream stream(file, std::ios::binary);
    Json schema = Json::parse(stream);
    if (write) {
      schema = with_structure(structure, std::move(schema));
      write_file_atomically(file, json_text(schema, 2) + "\n");
    }
    for (const std::string& difference : schema_differences(structure, schema)) {
      fmt::print("{}: {}\n", file.string(), difference);
      ++count;
    }
  }
  return count;
}

}  // namespace
}  // namespace footprint::test

int main(int argc, char** argv) {
  try {
    const std::span arguments(argv, static_cast<std::size_t>(argc));
    const bool write = argc == 3 && std::string_view(arguments[1]) == "--write";
    if (argc != 2 && !write) throw std::invalid_argument("usage: footprint_schemas [--write] FOLDER");
    if (footprint::test::compare(arguments.back(), write) == 0) return 0;
    fmt::print("{}", write ? "describe the new properties\n"
                           : "footprint_schemas --write FOLDER gives the schemas the structure of the fields\n");
    return 1;
  } catch (const std::exception& fault) {
    fmt::print(stderr, "{}\n", fault.what());
    return 2;
  }
}

// Every text in the document that names a file below images/, and the PNG beside each EXR.
#include "results/report/listed_files.hpp"

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

namespace footprint {
namespace {

constexpr const char* pictures = "images/";

void collect(const nlohmann::json& value, std::vector<std::filesystem::path>& files) {
  if (value.is_string() && value.get_ref<const std::string&>().starts_with(pictures)) {
    const std::filesystem::path file = value.get_ref<const std::string&>();
    files.push_back(file);
    if (file.extension() == ".exr") files.push_back(std::filesystem::path(file).replace_extension(".png"));
  }
  if (!value.is_structured()) return;
  for (const nlohmann::json& inner : value) collect(inner, files);
}

}  // namespace

std::vector<std::filesystem::path> listed_files(const std::filesystem::path& results_json) {
  std::ifstream stream(results_json, std::ios::binary);
  const nlohmann::json document = nlohmann::json::parse(stream, nullptr, false);
  std::vector<std::filesystem::path> files;
  const auto schema = document.is_object() ? document.find("schema") : document.end();
  const bool ours = schema != document.end() && schema->is_string() &&
                    schema->get_ref<const std::string&>().starts_with("footprint-");
  if (ours) collect(document, files);
  return files;
}

}  // namespace footprint

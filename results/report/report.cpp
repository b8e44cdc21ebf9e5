// results.json as the document of docs/results.schema.json, the four files of a run, and the files of an earlier one.
#include "results/report/report.hpp"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "renderer/core/files.hpp"
#include "results/report/ranking.hpp"
#include "results/report/record_fields.hpp"

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

// Null where it cannot be read.
nlohmann::json document_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return nlohmann::json::parse(stream, nullptr, false);
}

// Empty if the text is missing.
std::string text_in(const nlohmann::json& object, const char* key) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

}  // namespace

nlohmann::ordered_json json_number(const std::optional<double>& value) { return to_json_value(value); }

nlohmann::ordered_json results_document(const Results& results) { return to_json_value(results); }

std::string json_text(const nlohmann::ordered_json& document, int indent) {
  return document.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string results_json(const Results& results) { return json_text(results_document(results), 2) + "\n"; }

void write_report(const Results& results, const std::filesystem::path& folder) {
  write_file_atomically(folder / "results.json", results_json(results));
  write_file_atomically(folder / "results.csv", results_csv(results));
  write_file_atomically(folder / "table.md", results_table(results));
  write_file_atomically(folder / "index.html", results_page(results));
}

std::vector<std::string> images_in(const std::filesystem::path& folder) {
  std::vector<std::string> files;
  if (!std::filesystem::is_directory(folder / pictures)) return files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / pictures)) {
    if (entry.is_regular_file()) files.push_back(entry.path().lexically_relative(folder).generic_string());
  }
  std::ranges::sort(files);
  return files;
}

std::vector<std::filesystem::path> listed_files(const std::filesystem::path& results_json) {
  const nlohmann::json document = document_of(results_json);
  std::vector<std::filesystem::path> files;
  if (text_in(document, "schema").starts_with("footprint-")) collect(document, files);
  return files;
}

std::optional<ListedReference> listed_reference(const std::filesystem::path& reference) {
  const std::filesystem::path folder = std::filesystem::absolute(reference).parent_path().parent_path();
  const nlohmann::json document = document_of(folder / "results.json");
  if (text_in(document, "schema") != results_schema) return {};
  const std::string name = pictures + reference.filename().string();
  const nlohmann::json exposure = document.value(nlohmann::json::json_pointer("/scene/exposure"), nlohmann::json());
  const nlohmann::json records = document.value("records", nlohmann::json::array());
  if (!exposure.is_number() || !records.is_array()) return {};
  for (const nlohmann::json& record : records) {
    const nlohmann::json images = record.is_object() ? record.value("images", nlohmann::json()) : nlohmann::json();
    if (text_in(images, "reference") != name) continue;
    return ListedReference{.exposure = exposure.get<float>(),
                           .standard_error = folder / text_in(images, "standard_error")};
  }
  return {};
}

}  // namespace footprint

// Counts by method and group. Figures have two digits, to which kinds of processors agree.
#include "tests/hard_cases/hard_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/hard_cases/hard_case.hpp"

namespace footprint::hard_cases {
namespace {

constexpr std::array<std::string_view, 4> verdict_words{"passed", "guarded", "out of range", "failed"};

std::string_view word_of(Verdict verdict) { return verdict_words[static_cast<std::size_t>(verdict)]; }

// Distinct values in the order of their first rows.
std::vector<std::string> distinct(const std::vector<HardRow>& rows, std::string HardRow::*member) {
  std::vector<std::string> out;
  for (const HardRow& row : rows) {
    if (std::ranges::find(out, row.*member) == out.end()) out.push_back(row.*member);
  }
  return out;
}

// "passed", or the number of cases of each other verdict; "not tested" without a row.
std::string cell(const std::vector<HardRow>& rows, const std::string& method, const std::string& group) {
  std::map<Verdict, std::set<std::string>> cases;
  for (const HardRow& row : rows) {
    if (row.method == method && row.group == group) cases[row.verdict].insert(row.hard_case);
  }
  if (cases.empty()) return "not tested";
  std::string out;
  for (const Verdict verdict : {Verdict::guarded, Verdict::out_of_range, Verdict::failed}) {
    if (!cases.contains(verdict)) continue;
    out += fmt::format("{}{} {}", out.empty() ? "" : ", ", cases[verdict].size(), word_of(verdict));
  }
  return out.empty() ? "passed" : out;
}

std::string verdict_table(const std::vector<HardRow>& rows) {
  const std::vector<std::string> groups = distinct(rows, &HardRow::group);
  std::string out = "| method |", rule = "|---|";
  for (const std::string& group : groups) {
    out += fmt::format(" {} |", group);
    rule += "---|";
  }
  out += "\n" + rule + "\n";
  for (const std::string& method : distinct(rows, &HardRow::method)) {
    out += fmt::format("| `{}` |", method);
    for (const std::string& group : groups) out += fmt::format(" {} |", cell(rows, method, group));
    out += "\n";
  }
  return out;
}

std::string rows_of(const std::vector<HardRow>& rows, Verdict verdict) {
  std::string out;
  for (const HardRow& row : rows) {
    if (row.verdict != verdict) continue;
    out += fmt::format("| `{}` | `{}` | {} | {:.2g} | {:.2g} | {} |\n", row.method, row.hard_case, row.figure,
                       row.value, row.bound, row.why);
  }
  if (out.empty()) return "None.\n";
  return "| method | case | figure | measured | bound | why |\n|---|---|---|---:|---:|---|\n" + out;
}

std::string case_table(const std::vector<HardRow>& rows) {
  std::string out = "| case | group | description |\n|---|---|---|\n";
  std::set<std::string> seen;
  for (const HardRow& row : rows) {
    if (seen.insert(row.hard_case).second)
      out += fmt::format("| `{}` | {} | {} |\n", row.hard_case, row.group, row.description);
  }
  return out;
}

constexpr const char* page_head = R"(# Where methods stay stable

Written by `scripts/stability` from a run of `footprint check hard_cases`, which tests every method with every hard
case. Only properties measured in that run are reported. Cases are entries of the tables in
[`tests/hard_cases/`](../../tests/hard_cases), and apply to every method, new ones too.

| figure | meaning | bound |
|---|---|---|
| finite | number of values that are not finite or below 0, before any clamp | 0, for every method |
| energy | relative difference of the integral over the hemisphere from that of the sum over texels | the case's |
| limit | largest difference from the sum, where the method must equal it, relative to the sum's peak | the case's |
| direct | relative error of the image against `direct`, where nothing needs filtering | 0.001 |
| twin | relative error of the image against that of another scene which must look the same | 0.001 |
| mean | relative error of the mean over the surface against its closed form | 0.05 |
| coat | largest relative difference of a pixel from the coat's formula over the method's own image without coat | the case's |
| history | relative error of a history of three frames of a still camera, without jitter, against one frame | 0.00001 |
| moving | number of values that are not finite or below 0 in a history of three frames of a turning camera, with jitter | 0 |
| step | largest change of the distribution from one step of a parameter to the next, as a share of the whole | four times the sum's own, or the case's |
| threads | number of materials that one thread bakes to other bytes than two | 0 |
| backends | number of values that differ between EGL (all threads) and OSMesa (one thread) | 0 |

The sum over texels is in double precision and shares no code with the shaders (`renderer/ndf/reference_ndf.hpp`). The
same is true of the sum over a pixel's coats (`tests/hard_cases/coat_sum.hpp`). Under a coat, energy is that of the
image, and a step is the change from one pixel to the next.

- *Guarded*: a clamp is active there; the figure is the error it introduces.
- *Out of range*: a known limit. The method's README gives the range, or [base-brdf.md](../explanation/base-brdf.md#clear-coat) for
  coats. Each figure has its own bound. A run fails if the figure exceeds it, or if the case passes after all.

)";

}  // namespace

std::string stability_page(const std::vector<HardRow>& rows) {
  return page_head + verdict_table(rows) + "\n## Guarded\n\n" + rows_of(rows, Verdict::guarded) +
         "\n## Out of range\n\n" + rows_of(rows, Verdict::out_of_range) + "\n## Failed\n\n" +
         rows_of(rows, Verdict::failed) + "\n## Cases\n\n" + case_table(rows);
}

std::string hard_cases_json(const std::vector<HardRow>& rows) {
  nlohmann::json list = nlohmann::json::array();
  for (const HardRow& row : rows) {
    list.push_back({{"method", row.method},
                    {"case", row.hard_case},
                    {"group", row.group},
                    {"figure", row.figure},
                    {"value", row.value},
                    {"bound", row.bound},
                    {"verdict", word_of(row.verdict)},
                    {"why", row.why},
                    {"picture", row.picture}});
  }
  return nlohmann::json{{"schema", "footprint-hard-cases/2"}, {"rows", std::move(list)}}.dump(1) + "\n";
}

std::vector<std::string> failures_of(const std::vector<HardRow>& rows) {
  std::vector<std::string> out;
  for (const HardRow& row : rows) {
    if (row.verdict == Verdict::failed)
      out.push_back(fmt::format("{}, {}, {}: {}", row.method, row.hard_case, row.figure, row.why));
  }
  return out;
}

}  // namespace footprint::hard_cases

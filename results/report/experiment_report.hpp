// The outcome of an experiment: its figures and the published ones, its claims and thresholds (experiments.md).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "renderer/core/names.hpp"

namespace footprint {

/// The verdict on a claim, measured or expected.
enum class Verdict {
  reproduced,
  not_reproduced,
  undecided  ///< a figure is missing; never expected
};

/// As reports write it.
inline constexpr std::array<Word<Verdict>, 3> verdict_words{{
    {Verdict::reproduced, "reproduced"},
    {Verdict::not_reproduced, "not_reproduced"},
    {Verdict::undecided, "undecided"},
}};
constexpr const auto& words_of(Verdict /*verdict*/) { return verdict_words; }

/// Whose statement a claim is. Only a paper's own count as reproduced or not; the others are counted apart.
enum class ClaimSource {
  paper,        ///< the paper says or shows it
  gpu_time,     ///< the paper says it of times on a GPU, which frames of a software renderer cannot decide
  closed_form,  ///< a formula of the paper, evaluated
  our_measure,  ///< the paper says it, but the measure, the setting or the limit is our choice
  ours          ///< no paper says it
};

/// As experiment files and reports write it, the paper's own first.
inline constexpr std::array<Word<ClaimSource>, 5> claim_source_words{{
    {ClaimSource::paper, "paper"},
    {ClaimSource::gpu_time, "gpu_time"},
    {ClaimSource::closed_form, "closed_form"},
    {ClaimSource::our_measure, "our_measure"},
    {ClaimSource::ours, "ours"},
}};
constexpr const auto& words_of(ClaimSource /*source*/) { return claim_source_words; }

/// A figure that a paper prints, and the one that was measured.
struct PublishedFigure {
  std::string figure;   ///< where it is printed: "Figure 4"
  std::string measure;  ///< the expression that was measured: "error(tan_gmm, spp=16)"
  std::string unit;     ///< "fps", "s"; empty for errors and ratios
  double published = 0;
  std::optional<double> measured;
  std::string note;  ///< how the paper measured, or why it is not measured here
};

/// A figure that a claim was decided by.
struct ClaimFigure {
  std::string measure;
  double value = 0;
  bool at_noise_floor = false;  ///< an error that the reference's own noise explains
};

/// The outcome of a claim.
struct ClaimOutcome {
  std::string name, text;
  ClaimSource source = ClaimSource::ours;
  std::string inequality;
  Verdict expect = Verdict::reproduced;
  Verdict outcome = Verdict::undecided;
  std::string reason;   ///< why that is expected
  std::string problem;  ///< of an undecided one
  std::optional<double> left, right;
  std::vector<ClaimFigure> figures;
  std::string place{};  ///< FILE:LINE of the claim

  [[nodiscard]] bool as_expected() const { return outcome == expect; }
};

/// A claim over times, decided by estimated cost in place of measured times (gpu-cost.md). It is never expected or
/// counted with the claims.
struct SecondVerdict {
  std::string claim;  ///< its name
  std::string gpu;
  std::optional<double> left, right;
  Verdict outcome = Verdict::undecided;
  std::string problem;  ///< of an undecided one
};

/// An upper bound and what was measured.
struct ThresholdOutcome {
  std::string measure;
  double limit = 0;
  std::optional<double> measured;
  std::string problem;  ///< why it was not measured, or empty
  std::string place{};  ///< FILE:LINE of the threshold

  [[nodiscard]] bool passed() const { return measured && *measured <= limit; }
};

/// The part of results.json that an experiment adds.
struct ExperimentReport {
  std::string name, title, description;
  std::string file;    ///< the TOML, as given
  bool quick = false;  ///< smaller than the file says: the figures are no measurement
  std::vector<PublishedFigure> published;
  std::vector<ClaimOutcome> claims;
  std::vector<SecondVerdict> second_verdicts;
  std::vector<ThresholdOutcome> thresholds;
  std::vector<std::string> pictures;  ///< composed figures, paths from the output folder

  /// Claims and thresholds that did not come out as they should, one line each.
  [[nodiscard]] std::vector<std::string> shortfalls() const;
};

/// The fault of a claim or a threshold, in one line without its name.
[[nodiscard]] std::string shortfall_of(const ClaimOutcome& claim);
[[nodiscard]] std::string shortfall_of(const ThresholdOutcome& threshold);

/// The sections of table.md that an experiment adds, each with its heading.
[[nodiscard]] std::string experiment_markdown(const ExperimentReport& report);

/// The same for index.html: a <section> with the composed figures, every text escaped.
[[nodiscard]] std::string experiment_html(const ExperimentReport& report);

}  // namespace footprint

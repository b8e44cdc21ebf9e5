// The choice among candidates (limits first, then errors and costs, each with its noise), as sentences and as JSON.
#include "results/report/recommendation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "renderer/core/memory.hpp"
#include "results/report/page.hpp"
#include "results/report/record_fields.hpp"

namespace footprint {
namespace {

constexpr double sure_standard_errors = 3;  // beyond which a difference is none of chance

using Candidates = std::vector<Candidate>;
using Indices = std::vector<std::size_t>;

bool passes(const Candidate& candidate, const Limits& limits) {
  return candidate.worst <= limits.max_error.value_or(std::numeric_limits<double>::infinity()) &&
         candidate.cost.median <= limits.max_cost.value_or(std::numeric_limits<double>::infinity()) &&
         candidate.bytes <= limits.max_bytes.value_or(std::numeric_limits<std::uint64_t>::max());
}

// The factor by which a limit is missed.
double excess(const Candidate& candidate, const Limits& limits) {
  if (limits.max_error) return candidate.worst / *limits.max_error;
  if (limits.max_cost) return candidate.cost.median / *limits.max_cost;
  return limits.max_bytes ? static_cast<double>(candidate.bytes) / std::max(static_cast<double>(*limits.max_bytes), 1.0)
                          : 1.0;
}

template <typename Value>
std::size_t least(const Candidates& candidates, const Indices& among, Value value) {
  return *std::ranges::min_element(among, {}, [&](std::size_t i) { return value(candidates[i]); });
}

// Never where noise is unknown.
bool is_closer(const Candidate& a, const Candidate& b) {
  return a.noise && b.noise && b.error - a.error > sure_standard_errors * std::hypot(*a.noise, *b.noise);
}

// Whether the median of one is within the spread of the other.
bool cost_as_much(const Candidate& a, const Candidate& b) {
  const auto within = [](double value, const TimeRatio& range) { return value >= range.low && value <= range.high; };
  return within(a.cost.median, b.cost) || within(b.cost.median, a.cost);
}

// The candidates `among` which noise, or the spread of costs, does not part from the best.
Indices alike(const Candidates& candidates, const Indices& among, std::size_t best, bool by_cost) {
  Indices found;
  std::ranges::copy_if(among, std::back_inserter(found), [&](std::size_t i) {
    if (by_cost) return i == best || cost_as_much(candidates[i], candidates[best]);
    return !is_closer(candidates[best], candidates[i]);
  });
  return found;
}

std::string named(const Candidate& candidate) {
  return fmt::format("{} under {}", candidate.method, candidate.footprint);
}

std::string cost_text(const Candidate& candidate) {
  if (is_plain(candidate)) return "the cost of direct";
  const bool is_estimate = candidate.cost.low == candidate.cost.high;
  return fmt::format("{} times the cost of direct",
                     is_estimate ? fmt::format("{:.3g}", candidate.cost.median) : ratio_text(candidate.cost));
}

std::string figures_of(const Candidate& candidate) {
  const std::string worst =
      candidate.errors.size() > 1 ? fmt::format(" (at most {})", error_text(candidate.worst)) : std::string();
  return fmt::format("error {}{}, {}, {}", error_text(candidate.error), worst, cost_text(candidate),
                     readable_bytes(candidate.bytes));
}

std::string what_is_chosen(const MaterialAdvice& advice, const Limits& limits) {
  const Candidates& all = advice.candidates;
  if (!advice.choice.chosen) {
    if (!advice.choice.nearest) return "No recommendation: no distance shows 20 interior pixels of this material.";
    return fmt::format("None of {} candidates meets the limit, {}; {} comes closest: {}.", all.size(),
                       limits_text(limits), named(all[*advice.choice.nearest]),
                       figures_of(all[*advice.choice.nearest]));
  }
  const Candidate& chosen = all[*advice.choice.chosen];
  if (advice.choice.filter_nothing)
    return fmt::format("Do not filter: no candidate is more accurate than direct beyond noise; {}.",
                       figures_of(chosen));
  return fmt::format("Use {}: {}.", named(chosen), figures_of(chosen));
}

std::string what_is_tied(const MaterialAdvice& advice) {
  if (advice.choice.tied.empty() || advice.choice.filter_nothing) return {};
  std::vector<std::string> names;
  for (const std::size_t i : advice.choice.tied)
    names.push_back(fmt::format("{} ({})", named(advice.candidates[i]), figures_of(advice.candidates[i])));
  return fmt::format("Tied within noise: {}.", fmt::join(names, "; "));
}

std::string how_sure(const MaterialAdvice& advice) {
  if (!advice.choice.chosen || advice.pixels.empty()) return {};
  const Candidate& chosen = advice.candidates[*advice.choice.chosen];
  const std::string noise = chosen.noise ? error_text(*chosen.noise) : "unknown";
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < advice.pixels.size(); ++i)
    parts.push_back(fmt::format("{} at distance {:g}", advice.pixels[i], advice.distances[i]));
  return fmt::format("Interior pixels measured: {}. Standard error of the error: {}.", fmt::join(parts, ", "), noise);
}

std::string against_plain(const MaterialAdvice& advice) {
  const auto plain = std::ranges::find_if(advice.candidates, is_plain);
  if (!advice.choice.chosen || plain == advice.candidates.end() || is_plain(advice.candidates[*advice.choice.chosen]))
    return {};
  std::string text = fmt::format("Without filtering, the error is {}", error_text(plain->error));
  if (advice.closer_than_plain)
    text += fmt::format("; filtering improves {:.0f}% of the pixels and worsens {:.0f}%, beyond noise",
                        100.0 * (*advice.closer_than_plain)[0], 100.0 * (*advice.closer_than_plain)[1]);
  return text + ".";
}

std::string what_better_costs(const MaterialAdvice& advice) {
  if (!advice.choice.chosen) return {};
  if (!advice.choice.better) return "No candidate is more accurate beyond noise.";
  const Candidate& better = advice.candidates[*advice.choice.better];
  return fmt::format("To reduce the error further, use {}: {}.", named(better), figures_of(better));
}

PagePlot plot_of(const MaterialAdvice& advice, const Limits& limits) {
  PagePlot plot{.title = limits.gpu.empty() ? "Frame time relative to direct" : "Estimated cost relative to direct",
                .most_x = limits.max_cost,
                .most_y = limits.max_error};
  for (std::size_t i = 0; i < advice.candidates.size(); ++i) {
    const Candidate& c = advice.candidates[i];
    plot.points.push_back({.name = fmt::format("{} · {}", c.method, c.footprint),
                           .x = c.cost.median,
                           .low = c.cost.low,
                           .high = c.cost.high,
                           .y = c.error,
                           .chosen = advice.choice.chosen == i});
  }
  return plot;
}

Table table_of(const MaterialAdvice& advice) {
  Table table{.columns = {{"Method", false}, {"Footprint filter", false}, {"Error"}, {"Worst"}, {"Cost"}, {"Memory"}}};
  for (const Candidate& c : advice.candidates) {
    table.rows.push_back(
        {c.method, c.footprint,
         c.noise ? fmt::format("{} ± {}", error_text(c.error), three_figures(*c.noise)) : error_text(c.error),
         error_text(c.worst), ratio_text(c.cost), readable_bytes(c.bytes)});
  }
  return table;
}

PageSection section_of(const MaterialAdvice& advice, const Limits& limits) {
  return {.heading = advice.material,
          .sentences = advice.words,
          .command = advice.command,
          .plot = plot_of(advice, limits),
          .table = table_of(advice),
          .marked = advice.choice.chosen};
}

std::string with_end(const std::string& exr, const char* end) { return exr.substr(0, exr.rfind('.')) + end; }

PageImage image_of(const std::string& name, const std::string& exr) {
  return {.name = name, .png = with_end(exr, ".png"), .values = with_end(exr, "_values.js")};
}

// A view per distance: its reference, and the methods chosen there.
std::vector<PageView> views_of(const Recommendation& recommendation) {
  std::vector<PageView> views;
  for (const AdvicePicture& picture : recommendation.pictures) {
    const std::string label = fmt::format("{:g}", picture.distance);
    auto view = std::ranges::find(views, label, &PageView::label);
    if (view == views.end())
      view = views.insert(view, {.label = label, .images = {image_of("reference", picture.reference)}});
    PageImage image = image_of(fmt::format("{} · {}", picture.method, picture.footprint), picture.picture);
    image.error = picture.error;
    view->images.push_back(std::move(image));
  }
  return views;
}

std::vector<Provenance> provenance_of(const Recommendation& r) {
  return {{"Scene", fmt::format("{}, {} x {} pixels, distances {:g}", r.scene.source, r.width, r.height,
                                fmt::join(r.distances, ", "))},
          {"Reference", three_figures(r.reference.samples) + " samples per pixel on average"},
          {"Error", "normalised colour error over interior pixels, mean over the distances"},
          {"Cost", "frame time with the method on every material, relative to direct under trilinear lookups"},
          {"Candidates", fmt::format("{} of {} were measured in full{}", r.measured, r.tried,
                                     r.exhaustive ? "" : "; a coarse run ruled out the others")},
          {"Backend", r.backend.renderer},
          {"Processor", r.backend.cpu},
          {"Version", "footprint " + r.tool.version}};
}

std::vector<std::string> answer_of(const Recommendation& recommendation) {
  std::vector<std::string> answer;
  for (const MaterialAdvice& advice : recommendation.materials) {
    const std::string& first = advice.words.front();
    answer.push_back(recommendation.materials.size() == 1 ? first : fmt::format("{}: {}", advice.material, first));
  }
  return answer;
}

// "First answer (coarse, 25% of the pixels)".
std::string first_answer_title(const Recommendation& recommendation) {
  return fmt::format("First answer (coarse, {:.0f}% of the pixels)", 100.0 * recommendation.coarse.value());
}

std::string lede_of(const Recommendation& recommendation) {
  std::string lede = "Goal: " + limits_text(recommendation.limits) + ".";
  if (recommendation.coarse) lede += fmt::format(" {}: the run is not finished.", first_answer_title(recommendation));
  for (const auto& [method, reason] : recommendation.left_out)
    lede += fmt::format(" {} is left out because it does not run here: {}.", method, reason);
  return lede;
}

}  // namespace

bool is_plain(const Candidate& candidate) { return candidate.method == "direct" && candidate.footprint == "trilinear"; }

Choice choose(const std::vector<Candidate>& candidates, const Limits& limits) {
  Choice choice;
  Indices all, passing;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    all.push_back(i);
    if (passes(candidates[i], limits)) passing.push_back(i);
  }
  if (all.empty()) return choice;
  const auto error = [](const Candidate& c) { return c.error; };
  const auto cost = [](const Candidate& c) { return c.cost.median; };
  if (passing.empty()) {
    choice.nearest = least(candidates, all, [&](const Candidate& c) { return excess(c, limits); });
    return choice;
  }
  const bool by_cost = limits.max_error.has_value();
  const std::size_t first = by_cost ? least(candidates, passing, cost) : least(candidates, passing, error);
  const Indices group = alike(candidates, passing, first, by_cost);
  std::size_t chosen = by_cost ? least(candidates, group, error) : least(candidates, group, cost);
  const auto plain = std::ranges::find_if(passing, [&](std::size_t i) { return is_plain(candidates[i]); });
  if (plain != passing.end() && !is_closer(candidates[chosen], candidates[*plain])) chosen = *plain;
  choice.chosen = chosen;
  // Candidates are tied if neither the group's measure nor the other one separates them.
  std::ranges::copy_if(passing, std::back_inserter(choice.tied), [&](std::size_t i) {
    return i != chosen && cost_as_much(candidates[i], candidates[chosen]) &&
           !is_closer(candidates[i], candidates[chosen]) && !is_closer(candidates[chosen], candidates[i]);
  });
  Indices closer;
  std::ranges::copy_if(all, std::back_inserter(closer),
                       [&](std::size_t i) { return is_closer(candidates[i], candidates[chosen]); });
  if (!closer.empty()) choice.better = least(candidates, closer, cost);
  choice.filter_nothing = is_plain(candidates[chosen]) && closer.empty();
  return choice;
}

std::vector<std::size_t> contenders(const std::vector<Candidate>& candidates, const Limits& limits, double error_share,
                                    double cost_share) {
  const auto beats = [&](const Candidate& a, const Candidate& b) {
    const double noise = sure_standard_errors * std::hypot(a.noise.value_or(a.error), b.noise.value_or(b.error));
    return a.error * (1.0 + error_share) + noise < b.error && a.worst * (1.0 + error_share) + noise < b.worst &&
           a.cost.median * (1.0 + cost_share) < b.cost.median && (!limits.max_bytes || a.bytes <= b.bytes);
  };
  const auto is_over = [&](const Candidate& c) {
    return limits.max_cost && c.cost.median * (1.0 - cost_share) > *limits.max_cost;
  };
  Indices remaining, over;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const Candidate& candidate = candidates[i];
    const bool beaten = std::ranges::any_of(candidates, [&](const Candidate& c) { return beats(c, candidate); });
    if (is_plain(candidate) || (!beaten && !is_over(candidate))) remaining.push_back(i);
    if (!is_plain(candidate) && !beaten && is_over(candidate)) over.push_back(i);
  }
  // Also keep the cheapest over the limit that is more accurate than all within it: the price of a lower error.
  const auto error_of = [&](std::size_t i) { return candidates[i].error; };
  const double least = remaining.empty() ? INFINITY : error_of(*std::ranges::min_element(remaining, {}, error_of));
  std::erase_if(over, [&](std::size_t i) { return error_of(i) >= least; });
  if (!over.empty())
    remaining.push_back(*std::ranges::min_element(over, {}, [&](std::size_t i) { return candidates[i].cost.median; }));
  return remaining;
}

std::string limits_text(const Limits& limits) {
  if (limits.max_error) return fmt::format("an error of at most {:g} at every distance", *limits.max_error);
  if (limits.max_cost)
    return fmt::format("at most {:g} times the cost of direct{}", *limits.max_cost,
                       limits.gpu.empty() ? "" : " on " + limits.gpu);
  if (limits.max_bytes) return fmt::format("at most {}", readable_bytes(*limits.max_bytes));
  return "the smallest error";
}

std::vector<std::string> advice_sentences(const MaterialAdvice& advice, const Limits& limits) {
  std::vector<std::string> sentences{what_is_chosen(advice, limits), what_is_tied(advice), how_sure(advice),
                                     against_plain(advice), what_better_costs(advice)};
  std::erase(sentences, std::string());
  return sentences;
}

std::string recommendation_text(const Recommendation& recommendation) {
  if (recommendation.coarse) {
    std::string text = first_answer_title(recommendation) + ":\n";
    for (const MaterialAdvice& advice : recommendation.materials)
      text += fmt::format("  {}: {}\n", advice.material, advice.words.front());
    return text;
  }
  std::string text = fmt::format("{}, {}: {} of {} candidates measured in full\n", recommendation.scene.name,
                                 limits_text(recommendation.limits), recommendation.measured, recommendation.tried);
  for (const auto& [method, reason] : recommendation.left_out) text += fmt::format("left out {}: {}\n", method, reason);
  for (const MaterialAdvice& advice : recommendation.materials) {
    text += fmt::format("\n{}\n", advice.material);
    for (const std::string& sentence : advice.words) text += fmt::format("  {}\n", sentence);
    if (!advice.command.empty()) text += fmt::format("  Bake it: {}\n", advice.command);
  }
  return text;
}

std::string recommendation_json(const Recommendation& recommendation) {
  return json_text(to_json_value(recommendation), 2) + "\n";
}

std::string recommendation_page(const Recommendation& recommendation) {
  Page page{.title = recommendation.scene.name,
            .eyebrow = "which method, for each material",
            .lede = lede_of(recommendation),
            .text = recommendation_text(recommendation),
            .answer = answer_of(recommendation),
            .views = views_of(recommendation),
            .exposure = recommendation.scene.exposure,
            .provenance = provenance_of(recommendation)};
  for (const MaterialAdvice& advice : recommendation.materials)
    page.sections.push_back(section_of(advice, recommendation.limits));
  if (!page.views.empty()) {
    for (const PageImage& image : std::span(page.views.front().images).subspan(1)) page.shown.push_back(image.name);
  }
  if (!recommendation.reports.empty())
    page.sections.push_back({.heading = "Full runs", .links = recommendation.reports});
  return page_html(page);
}

}  // namespace footprint

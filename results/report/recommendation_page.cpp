// The page of a recommendation: the chosen method of each material, its images, and for each material the reasons, the
// plot of error against cost, and all candidates.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <span>

#include "renderer/core/memory.hpp"
#include "results/report/figures.hpp"
#include "results/report/page.hpp"
#include "results/report/ranking.hpp"
#include "results/report/recommendation.hpp"

namespace footprint {

namespace {

PagePlot plot_of(const MaterialAdvice& advice, const Limits& limits) {
  PagePlot plot{
      .cost_title = limits.gpu.empty() ? "Frame time relative to direct" : "Estimated cost relative to direct",
      .points = {},
      .most_cost = limits.max_cost,
      .most_error = limits.max_error};
  for (std::size_t i = 0; i < advice.candidates.size(); ++i) {
    const Candidate& c = advice.candidates[i];
    plot.points.push_back({.name = fmt::format("{} · {}", c.method, c.footprint),
                           .cost = c.cost.median,
                           .low = c.cost.low,
                           .high = c.cost.high,
                           .error = c.error,
                           .is_chosen = advice.choice.chosen == i});
  }
  return plot;
}

Table table_of(const MaterialAdvice& advice) {
  Table table{.heading = {},
              .columns = {{"Method", false}, {"Footprint filter", false}, {"Error"}, {"Worst"}, {"Cost"}, {"Memory"}},
              .rows = {}};
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
          .sentences = advice_sentences(advice, limits),
          .command = advice.command,
          .plot = plot_of(advice, limits),
          .table = table_of(advice),
          .marked_row = advice.choice.chosen};
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

// The first sentence on each material.
std::vector<std::string> answer_of(const Recommendation& recommendation) {
  std::vector<std::string> answer;
  for (const MaterialAdvice& advice : recommendation.materials) {
    const std::string first = advice_sentences(advice, recommendation.limits).front();
    answer.push_back(recommendation.materials.size() == 1 ? first : fmt::format("{}: {}", advice.material, first));
  }
  return answer;
}

std::string lede_of(const Recommendation& recommendation) {
  std::string lede = "Goal: " + limits_text(recommendation.limits) + ".";
  if (recommendation.coarse) lede += fmt::format(" {}: the run is not finished.", first_answer_title(recommendation));
  for (const auto& [method, reason] : recommendation.left_out)
    lede += fmt::format(" {} is left out because it does not run here: {}.", method, reason);
  return lede;
}

}  // namespace

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

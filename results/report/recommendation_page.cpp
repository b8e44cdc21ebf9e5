// The page of a recommendation: for each material the reasons, the front of error and cost, and all candidates; the
// pictures of those that were chosen beside the reference. No script: what it shows does not change.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "renderer/core/memory.hpp"
#include "results/report/figures.hpp"
#include "results/report/markup.hpp"
#include "results/report/ranking.hpp"
#include "results/report/recommendation.hpp"

namespace footprint {

namespace {

constexpr std::string_view words_cell = "class=\"words-column\"";  // left-aligned, as in page.css
constexpr double plot_width = 860, plot_height = 380, margin_left = 70, margin_right = 150, margin_top = 26,
                 margin_bottom = 46;

// A logarithmic axis from pixels to values.
struct Axis {
  double low, high, from, to;

  [[nodiscard]] double at(double value) const {
    const double share = (std::log(value) - std::log(low)) / (std::log(high) - std::log(low));
    return from + share * (to - from);
  }
};

Axis axis_over(const std::vector<double>& values, double from, double to) {
  const auto [low, high] = std::ranges::minmax(values);
  return {.low = low / 1.15, .high = high * 1.15, .from = from, .to = to};
}

// Round numbers, a few for each power of ten.
std::vector<double> ticks_of(const Axis& axis) {
  std::vector<double> ticks;
  for (double power = std::pow(10.0, std::floor(std::log10(axis.low))); power <= axis.high; power *= 10.0) {
    for (const double digit : {1.0, 1.5, 2.0, 3.0, 5.0, 7.0}) {
      if (digit * power >= axis.low && digit * power <= axis.high) ticks.push_back(digit * power);
    }
  }
  return ticks;
}

bool is_on_front(const std::vector<Candidate>& all, const Candidate& candidate) {
  return std::ranges::none_of(all, [&](const Candidate& other) {
    return other.error < candidate.error && other.cost.median < candidate.cost.median;
  });
}

std::string line_between(std::string_view kind, double x1, double y1, double x2, double y2) {
  return fmt::format(R"(<line class="{}" x1="{:.1f}" y1="{:.1f}" x2="{:.1f}" y2="{:.1f}"/>)", kind, x1, y1, x2, y2);
}

std::string text_at(double x, double y, std::string_view anchor, std::string_view text) {
  return fmt::format(R"(<text x="{:.1f}" y="{:.1f}" text-anchor="{}">{}</text>)", x, y, anchor, text);
}

std::string axes_svg(const Axis& x, const Axis& y) {
  std::string svg;
  for (const double tick : ticks_of(x)) {
    svg += line_between("grid", x.at(tick), y.from, x.at(tick), y.to);
    svg += text_at(x.at(tick), y.from + 16, "middle", fmt::format("{:g}", tick));
  }
  for (const double tick : ticks_of(y)) {
    svg += line_between("grid", x.from, y.at(tick), x.to, y.at(tick));
    svg += text_at(x.from - 6, y.at(tick) + 4, "end", fmt::format("{:g}", tick));
  }
  svg += text_at(0.5 * (x.from + x.to), y.from + 36, "middle", "frame time relative to direct");
  return svg + text_at(x.from, y.to - 4, "end", "error");
}

std::string limit_svg(const Limits& limits, const Axis& x, const Axis& y) {
  if (limits.max_error && *limits.max_error > y.low && *limits.max_error < y.high)
    return line_between("limit", x.from, y.at(*limits.max_error), x.to, y.at(*limits.max_error));
  if (limits.max_cost && *limits.max_cost > x.low && *limits.max_cost < x.high)
    return line_between("limit", x.at(*limits.max_cost), y.from, x.at(*limits.max_cost), y.to);
  return {};
}

std::string line_svg(std::vector<Candidate> front, const Axis& x, const Axis& y) {
  std::ranges::sort(front, {}, [](const Candidate& c) { return c.cost.median; });
  std::string points;
  for (const Candidate& candidate : front)
    points += fmt::format("{:.1f},{:.1f} ", x.at(candidate.cost.median), y.at(candidate.error));
  return fmt::format(R"(<polyline class="line" points="{}"/>)", points);
}

// Names beside their dots, moved away from those that are there.
class Labels {
 public:
  std::string beside(double x, double y, const std::string& text) {
    const double width = character_width * static_cast<double>(text.size());
    Box box{.left = x + 9, .right = x + 9 + width, .baseline = y - 6};
    for (const double step : {0.0, 22.0, -line_height, 22.0 + line_height, -2.0 * line_height}) {
      box.baseline = y - 6 + step;
      if (std::ranges::none_of(taken_, [&](const Box& other) { return overlap(box, other); })) break;
    }
    taken_.push_back(box);
    return text_at(box.left, box.baseline, "start", html_escaped(text));
  }

 private:
  struct Box {
    double left, right, baseline;
  };
  static constexpr double character_width = 6.5, line_height = 13;

  static bool overlap(const Box& a, const Box& b) {
    return a.left < b.right && b.left < a.right && std::abs(a.baseline - b.baseline) < line_height;
  }

  std::vector<Box> taken_;
};

std::string dot_svg(const Candidate& candidate, bool is_front, bool is_chosen, const Axis& x, const Axis& y,
                    Labels& labels) {
  const double at_x = x.at(candidate.cost.median), at_y = y.at(candidate.error);
  const double left = std::max(x.at(candidate.cost.low), x.from), right = std::min(x.at(candidate.cost.high), x.to);
  const std::string name = fmt::format("{} · {}", candidate.method, candidate.footprint);
  std::string svg = line_between("spread", left, at_y, right, at_y);
  svg += fmt::format(R"(<circle class="{}" cx="{:.1f}" cy="{:.1f}" r="{}">)",
                     is_chosen  ? "chosen"
                     : is_front ? "on-front"
                                : "dot",
                     at_x, at_y, is_chosen ? 7 : 4);
  svg += fmt::format("<title>{}: error {}, {} times direct</title></circle>", html_escaped(name),
                     error_text(candidate.error), three_figures(candidate.cost.median));
  if (is_front || is_chosen) svg += labels.beside(at_x, at_y, name);
  return svg;
}

std::string front_svg(const MaterialAdvice& advice, const Limits& limits) {
  std::vector<Candidate> shown;
  std::ranges::copy_if(advice.candidates, std::back_inserter(shown),
                       [](const Candidate& c) { return c.error > 0.0 && c.cost.median > 0.0; });
  if (shown.empty()) return {};
  std::vector<double> costs, errors;
  for (const Candidate& candidate : shown) {
    costs.push_back(candidate.cost.median);
    errors.push_back(candidate.error);
  }
  const Axis x = axis_over(costs, margin_left, plot_width - margin_right);
  const Axis y = axis_over(errors, plot_height - margin_bottom, margin_top);
  std::vector<Candidate> front;
  std::ranges::copy_if(shown, std::back_inserter(front), [&](const Candidate& c) { return is_on_front(shown, c); });
  std::string svg = axes_svg(x, y) + limit_svg(limits, x, y) + line_svg(front, x, y);
  const Candidate* const chosen = advice.choice.chosen ? &advice.candidates[*advice.choice.chosen] : nullptr;
  Labels labels;
  for (const Candidate& candidate : shown) {
    const bool is_chosen = chosen && chosen->method == candidate.method && chosen->footprint == candidate.footprint;
    svg += dot_svg(candidate, is_on_front(shown, candidate), is_chosen, x, y, labels);
  }
  const std::string label = "Error against cost; the table shows the same values";
  return fmt::format(
      R"(<div class="scroll"><svg class="front" viewBox="0 0 {} {}" role="img" aria-label="{}">{}</svg></div>)",
      plot_width, plot_height, label, svg);
}

std::string table_html(const MaterialAdvice& advice) {
  std::string rows;
  for (std::size_t i = 0; i < advice.candidates.size(); ++i) {
    const Candidate& c = advice.candidates[i];
    rows += fmt::format(
        "<tr{0}><td {8}>{1}</td><td {8}>{2}</td><td>{3}</td><td>{4}</td><td>{5}</td><td>{6}</td><td>{7}</td></tr>\n",
        advice.choice.chosen == i ? R"( class="chosen-row")" : "", html_escaped(c.method), html_escaped(c.footprint),
        error_text(c.error), error_text(c.worst), c.noise ? error_text(*c.noise) : "n/a", ratio_text(c.cost),
        readable_bytes(c.bytes), words_cell);
  }
  return fmt::format("<div class=\"scroll\"><table><thead><tr><th {0}>Method</th><th {0}>Footprint filter</th>",
                     words_cell) +
         "<th>Error</th><th>Worst "
         "error</th>"
         "<th>Noise</th><th>Cost</th><th>Memory</th></tr></thead><tbody>\n" +
         rows + "</tbody></table></div>\n";
}

std::string advice_html(const MaterialAdvice& advice, const Limits& limits) {
  std::string words;
  for (const std::string& sentence : advice_sentences(advice, limits))
    words += fmt::format("<li>{}</li>\n", html_escaped(sentence));
  const std::string command =
      advice.command.empty() ? "" : fmt::format("<pre class=\"scroll\">{}</pre>\n", html_escaped(advice.command));
  return fmt::format("<section><h2>{}</h2>\n<ul class=\"words\">\n{}</ul>\n{}{}{}</section>\n",
                     html_escaped(advice.material), words, command, front_svg(advice, limits), table_html(advice));
}

std::string display_picture(const std::string& exr) { return exr.substr(0, exr.rfind('.')) + ".png"; }

std::string pictures_html(const Recommendation& recommendation) {
  std::string figures;
  for (const AdvicePicture& p : recommendation.pictures) {
    const auto image = [](const std::string& file, const std::string& what) {
      return fmt::format(R"(<img src="{}" alt="{}" title="{}">)", html_escaped(file), what, what);
    };
    figures += fmt::format(
        "<figure><div class=\"trio\">{}{}{}</div><figcaption class=\"note\">Distance {:g}: the reference, "
        "{} under {}, and the error</figcaption></figure>\n",
        image(display_picture(p.reference), "reference"), image(display_picture(p.picture), "method"),
        image(p.error, "error"), p.distance, html_escaped(p.method), html_escaped(p.footprint));
  }
  return figures.empty() ? std::string()
                         : "<section><h2>Images</h2>\n<div class=\"pairs\">\n" + figures + "</div></section>\n";
}

std::string provenance_html(const Recommendation& r) {
  std::string links;
  for (const std::string& report : r.reports)
    links += fmt::format("<li><a href=\"{0}\">{0}</a></li>", html_escaped(report));
  return fmt::format(
      "<section><h2>Provenance</h2>\n<p class=\"note\">{}, {} x {} pixels, distances {:g}. Reference: "
      "{} samples per pixel on average. Error: normalised colour error over interior pixels, mean over the distances. "
      "Cost: frame time with the method on every material, relative to direct under trilinear lookups. {} of {} "
      "candidates were measured in full{}. {}; {}; {}.</p>\n<p class=\"note\">Full runs:</p><ul>{}</ul></section>\n",
      html_escaped(r.scene.source), r.width, r.height, fmt::join(r.distances, ", "), three_figures(r.reference.samples),
      r.measured, r.tried, r.exhaustive ? "" : "; a coarse run ruled out the others", html_escaped(r.backend.renderer),
      html_escaped(r.backend.cpu), "footprint " + html_escaped(r.tool.version), links);
}

}  // namespace

std::string recommendation_page(const Recommendation& recommendation) {
  std::string body;
  for (const MaterialAdvice& advice : recommendation.materials) body += advice_html(advice, recommendation.limits);
  body += pictures_html(recommendation) + provenance_html(recommendation);
  const std::string title = html_escaped(recommendation.scene.name);
  std::string lede = html_escaped("Goal: " + limits_text(recommendation.limits) + ".");
  if (recommendation.coarse)
    lede += html_escaped(fmt::format(" {}: the run is not finished.", first_answer_title(recommendation)));
  for (const auto& [method, reason] : recommendation.left_out)
    lede += html_escaped(fmt::format(" {} is left out because it does not run here: {}.", method, reason));
  return fill_page(
      {.file = "recommendation.html", .title = recommendation.scene.name + " – which method?", .scripts = false},
      {{"title", title}, {"lede", lede}, {"body", body}});
}

}  // namespace footprint

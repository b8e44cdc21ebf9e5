// The page of a command for readers in a browser: one template, one style and one set of scripts for all commands.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "results/report/figures.hpp"
#include "results/report/markup.hpp"

namespace footprint {

/// An image of the comparator. Paths are relative to the page.
struct PageImage {
  std::string name;
  std::string png;                    ///< as displayed
  std::string values = {};            ///< script with its values (renderer/image/pixel_script.hpp); empty: none
  std::string error = {}, flip = {};  ///< maps against the first image of the view, PNG; empty: none
  std::string caption = {};
};

/// The images of one view, at least one; the first is the reference.
struct PageView {
  std::string label;
  std::vector<PageImage> images;
};

/// A candidate in a plot of error against cost.
struct PagePoint {
  std::string name;
  double cost = 0, low = 0, high = 0, error = 0;  ///< the spread is that of the cost
  bool is_chosen = false;
};

/// Error against cost, on logarithmic axes.
struct PagePlot {
  std::string cost_title;
  std::vector<PagePoint> points;
  std::optional<double> most_cost = {}, most_error = {};  ///< limits, drawn as lines
};

/// A section of its own: what it has of these, in this order.
struct PageSection {
  std::string heading;
  std::vector<std::string> sentences = {};
  std::string command = {};  ///< to copy
  PagePlot plot = {};
  Table table = {};  ///< its own heading is not shown
  std::optional<std::size_t> marked_row = {};
  std::vector<std::string> links = {};  ///< pages, relative to this one
};

struct Page {
  std::string title, eyebrow = {}, lede = {};
  std::string text;                      ///< for readers without scripts
  std::vector<std::string> answer = {};  ///< sentences, the most important first
  std::vector<PageView> views = {};
  std::vector<std::string> shown = {};  ///< images on the first screen, the best last; empty: the first three
  bool in_false_color = false;          ///< images are maps of one figure: nothing is exposed, and they have no FLIP
  double exposure = 1;                  ///< from radiance to displayed values
  std::vector<PageSection> sections = {};
  std::vector<Provenance> provenance = {};
  std::string experiment = {}, gpus = {};  ///< HTML
};

/// The page, whole and self-contained but for the images beside it and their values.
[[nodiscard]] std::string page_html(const Page& page);

/// The same with further data for the page's scripts.
/// own: an object; its keys replace those of the page.
[[nodiscard]] std::string page_html(const Page& page, const nlohmann::ordered_json& own);

}  // namespace footprint

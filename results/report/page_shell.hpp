// The frame that all pages share: how a template of this folder becomes one self-contained page.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace footprint {

/// A page's own template, its title (the browser adds the program's name), and whether it runs scripts.
struct PageShell {
  std::string_view file;  ///< "page.html"
  std::string title;      ///< plain text
  bool scripts = true;
};

/// A text of this folder that is part of the program: "page.js".
[[nodiscard]] std::string_view page_text(std::string_view file);

/// The shell's template, its `{{head}}` that of all pages, everything else from `values` (fill_template).
[[nodiscard]] std::string fill_page(const PageShell& shell, std::map<std::string, std::string_view> values);

}  // namespace footprint

// The head first, then the page around it.
#include "results/report/page_shell.hpp"

#include "renderer/core/embedded_texts.hpp"
#include "results/report/text_template.hpp"

namespace footprint {

namespace embedded {
extern const EmbeddedTexts page_texts;
}

std::string_view page_text(std::string_view file) { return find_text(embedded::page_texts, file)->text; }

std::string fill_page(const PageShell& shell, std::map<std::string, std::string_view> values) {
  const std::string title = html_escaped(shell.title);
  const std::string head =
      fill_template(page_text("head.html"), {{"title", title},
                                             {"css", page_text("page.css")},
                                             {"script-policy", shell.scripts ? "; script-src 'unsafe-inline'" : ""}});
  values["head"] = head;
  return fill_template(page_text(shell.file), values);
}

}  // namespace footprint

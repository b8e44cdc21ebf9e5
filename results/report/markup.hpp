// Markup of reports: Markdown that also reads well in a terminal, HTML, and the templates that become self-contained
// pages.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace footprint {

struct MarkdownColumn {
  std::string title;
  bool numeric = true;  ///< aligned right
};

/// `text` with the characters that mean something in Markdown or HTML escaped, line breaks as spaces.
[[nodiscard]] std::string markdown_escaped(const std::string& text);

/// A table with its heading.
struct Table {
  std::string heading;
  std::vector<MarkdownColumn> columns;
  std::vector<std::vector<std::string>> rows;  ///< one cell per column
};

/// The table under its heading, every cell escaped; empty without rows.
[[nodiscard]] std::string html_table(const Table& table);

/// The table, every cell escaped; each row has one cell per column.
[[nodiscard]] std::string markdown_table(const std::vector<MarkdownColumn>& columns,
                                         const std::vector<std::vector<std::string>>& rows);

/// `page` with every `{{name}}` replaced by its value; values are not searched again. Throws std::logic_error for a
/// name without a value: template and program belong together.
[[nodiscard]] std::string fill_template(std::string_view page, const std::map<std::string, std::string_view>& values);

/// `text` for use as HTML content or in a quoted attribute.
[[nodiscard]] std::string html_escaped(std::string_view text);

/// JSON text for use inside a <script> element: `<`, which is only in strings, becomes \u003c, so that no
/// `</script>` or `<!--` ends the element early.
[[nodiscard]] std::string script_escaped(std::string_view json);

}  // namespace footprint

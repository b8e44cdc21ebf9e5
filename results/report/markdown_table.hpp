// Tables as Markdown, whose columns are padded to one width so that it also reads well in a terminal, and as HTML.
#pragma once

#include <string>
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

}  // namespace footprint

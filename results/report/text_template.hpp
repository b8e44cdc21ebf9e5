// Fills text into a page: `{{name}}` in a template, and the escaping that HTML needs.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace footprint {

/// `page` with every `{{name}}` replaced by its value; values are not searched again. Throws std::logic_error for a
/// name without a value: template and program belong together.
[[nodiscard]] std::string fill_template(std::string_view page, const std::map<std::string, std::string_view>& values);

/// `text` for use as HTML content or in a quoted attribute.
[[nodiscard]] std::string html_escaped(std::string_view text);

/// JSON text for use inside a <script> element: `<`, which is only in strings, becomes \u003c, so that no
/// `</script>` or `<!--` ends the element early.
[[nodiscard]] std::string script_escaped(std::string_view json);

}  // namespace footprint

// Directives of the shader text: conditions, includes, and the numbers of lines.
#include "renderer/pipeline/shader_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "renderer/core/error.hpp"
#include "renderer/core/names.hpp"

namespace footprint {

extern const EmbeddedTexts shared_glsl;

namespace {

constexpr std::string_view directive_mark = "//? ";
constexpr std::string_view directives =
    "directives: if CONDITION, elif CONDITION, else, end, include FILE [if CONDITION], module; at the end of a line "
    "the "
    "first three are for it alone; a condition is of flags, `not`, `and`, `or` and parentheses";

// A line of a file, for error messages.
struct Line {
  std::string_view file;
  int number;

  [[nodiscard]] Error bad(const std::string& message, std::string hint = std::string(directives)) const {
    return {ErrorKind::usage, fmt::format("{}, line {}", file, number), message, std::move(hint)};
  }
};

// A condition: `not` binds closer than `and`, and that closer than `or`. Both sides are read in any case, so that no
// unknown flag hides behind another.
class Condition {
 public:
  Condition(std::string_view text, const ShaderFlags& flags, const Line& line)
      : text_(text), flags_(flags), line_(line) {
    next();
  }

  bool is_true() {
    const bool value = either();
    if (!word_.empty()) throw malformed();
    return value;
  }

 private:
  void next() {
    text_.remove_prefix(std::min(text_.find_first_not_of(' '), text_.size()));
    const bool bracket = text_.starts_with('(') || text_.starts_with(')');
    word_ = text_.substr(0, bracket ? 1 : text_.find_first_of(" ()"));
    text_.remove_prefix(word_.size());
  }

  bool take(std::string_view word) {
    if (word_ != word) return false;
    next();
    return true;
  }

  bool either() {
    bool value = both();
    while (take("or")) value = both() || value;
    return value;
  }

  bool both() {
    bool value = single();
    while (take("and")) value = single() && value;
    return value;
  }

  bool single() {
    if (take("not")) return !single();
    if (take("(")) {
      const bool value = either();
      if (!take(")")) throw malformed();
      return value;
    }
    return flag();
  }

  bool flag() {
    if (word_.empty() || word_ == "and" || word_ == "or" || word_ == ")") throw malformed();
    const auto found = flags_.find(word_);
    if (found == flags_.end()) {
      std::vector<std::string> known;
      for (const auto& [name, on] : flags_) known.push_back(name);
      throw line_.bad(fmt::format("unknown flag `{}`", word_), suggestion(word_, known));
    }
    next();
    return found->second;
  }

  [[nodiscard]] Error malformed() const {
    return line_.bad(word_.empty() ? "a condition ends too early" : fmt::format("`{}` is out of place here", word_));
  }

  std::string_view text_, word_;
  const ShaderFlags& flags_;
  const Line& line_;
};

}  // namespace

// Reads one file. Its lines keep their numbers from `first_line` on where that is given.
class ShaderText::Reader {
 public:
  Reader(ShaderText& to, std::string_view file, int first_line) : to_(to), line_{file, 0}, first_line_(first_line) {
    mark_line();
  }

  void read(std::string_view text) {
    while (!text.empty()) {
      const std::size_t stop = std::min(text.find('\n'), text.size());
      read_line(text.substr(0, stop));
      text.remove_prefix(std::min(stop + 1, text.size()));
    }
    end_line_branches();
    if (branches_.empty()) return;
    line_.number = branches_.back().line;
    throw line_.bad("an `if` is not closed");
  }

 private:
  // An open `if`: whether its parent is included, whether one of its branches was, and whether `else` came.
  struct Branch {
    int line;
    bool outer, taken;
    bool ends = false;
  };

  void mark_line() {
    if (first_line_ > 0) to_.add(fmt::format("#line {}\n", first_line_ + line_.number));
  }

  void read_line(std::string_view text) {
    ++line_.number;
    const std::size_t mark = text.starts_with("// ") ? std::string_view::npos : text.find(directive_mark);
    if (mark == 0 || mark == std::string_view::npos) end_line_branches();
    if (mark == 0) {
      directive(text.substr(directive_mark.size()));
    } else if (mark != std::string_view::npos) {
      line_directive(text.substr(mark + directive_mark.size()));
      text = text.substr(0, text.find_last_not_of(' ', mark - 1) + 1);
    }
    if (keeping_ && mark != 0) {
      to_.text_ += text;
      to_.text_ += '\n';
    } else if (mark != std::string_view::npos) {
      mark_line();
    }
  }

  // A condition at the end of a line is for that line alone. Lines in sequence may be the branches of one `if`.
  void line_directive(std::string_view words) {
    const bool is_first = words.starts_with("if ");
    if (is_first) end_line_branches();
    if (!is_first && (!in_lines_ || (words != "else" && !words.starts_with("elif ")))) throw not_here(words);
    directive(words);
    in_lines_ = true;
  }

  void end_line_branches() {
    if (std::exchange(in_lines_, false)) directive("end");
  }

  void directive(std::string_view words) {
    if (words.starts_with("if ")) {
      const bool is_true = condition(words.substr(3));
      branches_.push_back({line_.number, keeping_, is_true});
      keeping_ = keeping_ && is_true;
    } else if (words.starts_with("elif ")) {
      go_on(words, condition(words.substr(5)));
    } else if (words == "else") {
      go_on(words, true);
      branches_.back().ends = true;
    } else if (words == "end" && !branches_.empty()) {
      keeping_ = branches_.back().outer;
      branches_.pop_back();
    } else if (words.starts_with("include ")) {
      const std::size_t file_end = words.find(" if ");
      const bool is_on = file_end == std::string_view::npos || condition(words.substr(file_end + 4));
      include(words.substr(8, file_end - 8), keeping_ && is_on);
    } else if (words == "module" && !to_.module_.file.empty()) {
      if (keeping_) to_.include_module();
    } else {
      throw not_here(words);
    }
  }

  [[nodiscard]] Error not_here(std::string_view words) const {
    return line_.bad(fmt::format("`{}` is not a directive here", words));
  }

  bool condition(std::string_view text) const { return Condition(text, to_.flags_, line_).is_true(); }

  void go_on(std::string_view words, bool is_true) {
    if (branches_.empty()) throw line_.bad(fmt::format("`{}` without an `if`", words));
    Branch& branch = branches_.back();
    if (branch.ends) throw line_.bad(fmt::format("`{}` behind an `else`", words));
    keeping_ = branch.outer && !branch.taken && is_true;
    branch.taken = branch.taken || is_true;
  }

  void include(std::string_view file, bool is_on) {
    const EmbeddedText* const shared = find_text(shared_glsl, file);
    const EmbeddedText* const own = find_text(to_.module_.folder, file);
    if (shared == nullptr && own == nullptr) throw no_text(file);
    if (!is_on) return;
    if (shared == nullptr) {
      to_.include_own(*own);
    } else {
      if (first_line_ > 0) to_.add(fmt::format("#line {}\n", to_.shared_line()));
      to_.include_shared(*shared);
    }
  }

  [[nodiscard]] Error no_text(std::string_view file) const {
    std::vector<std::string> files;
    for (const EmbeddedText& text : shared_glsl) files.emplace_back(text.file);
    for (const EmbeddedText& text : to_.module_.folder) {
      if (find_text(shared_glsl, text.file) == nullptr) files.emplace_back(text.file);
    }
    return line_.bad(fmt::format("`{}` is not a shader text", file), suggestion(file, files));
  }

  ShaderText& to_;
  Line line_;
  int first_line_;  // 0: lines are not numbered
  std::vector<Branch> branches_;
  bool keeping_ = true;
  bool in_lines_ = false;  // whether the last branch is of conditions at ends of lines
};

ShaderText::ShaderText(ShaderFlags flags, ShaderModule module) : flags_(std::move(flags)), module_(std::move(module)) {
  flags_.insert(module_.flags.begin(), module_.flags.end());
}

void ShaderText::add(std::string_view text) { text_ += text; }

void ShaderText::include(std::string_view file) { include_shared(*find_text(shared_glsl, file)); }

void ShaderText::include_module() {
  include_own({module_.file, module_.text});
  add(fmt::format("#line {}\n", shared_line()));
  lines_ += fmt::format(", from {} on shared", first_shared_line);
}

// A number that no other line has.
int ShaderText::shared_line() const { return first_shared_line + static_cast<int>(std::ranges::count(text_, '\n')); }

void ShaderText::include_shared(const EmbeddedText& text) {
  if (included_.insert(text.file).second) Reader(*this, text.file, 0).read(text.text);
}

void ShaderText::include_own(const EmbeddedText& text) {
  if (!included_.insert(text.file).second) return;
  const int first_line = next_own_line_;
  next_own_line_ += 1000 * (static_cast<int>(std::ranges::count(text.text, '\n')) / 1000 + 1);
  lines_ += fmt::format("{} {} on are of {}", lines_.empty() ? "lines from" : ", from", first_line, text.file);
  Reader(*this, text.file, first_line).read(text.text);
}

}  // namespace footprint

// Directives of the shader text: `#if` over flags, `#include`, and the numbers of lines.
#include "renderer/pipeline/shader_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "renderer/core/error.hpp"
#include "renderer/core/names.hpp"

namespace footprint {

extern const EmbeddedTexts shared_glsl;

namespace {

constexpr std::string_view directives =
    "directives: #if CONDITION, #elif CONDITION, #else, #endif, #include \"FILE\"; a condition consists of flags, !, "
    "&&, "
    "|| and parentheses";

constexpr std::array<std::string_view, 8> of_compilers{"define", "undef",   "extension", "pragma",
                                                       "line",   "version", "error",     ""};

std::string_view trimmed(std::string_view text) {
  const std::size_t first = std::min(text.find_first_not_of(" \t"), text.size());
  return text.substr(first, text.find_last_not_of(" \t") + 1 - first);
}

// A line of a file, for error messages.
struct Line {
  std::string_view file;
  int number;

  [[nodiscard]] Error bad(const std::string& message, std::string hint = std::string(directives)) const {
    return {ErrorKind::usage, fmt::format("{}, line {}", file, number), message, std::move(hint)};
  }
};

// The words of a condition: names, numbers, `&&`, `||`, and single characters.
std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  for (text = trimmed(text); !text.empty(); text = trimmed(text)) {
    std::size_t size = 1;
    while (is_in_word(text[0]) && size < text.size() && is_in_word(text[size])) ++size;
    if (text.starts_with("&&") || text.starts_with("||")) size = 2;
    words.push_back(text.substr(0, size));
    text.remove_prefix(size);
  }
  return words;
}

// The flag of a macro; the end if there is none.
ShaderFlags::const_iterator flag_of(std::string_view macro, const ShaderFlags& flags) {
  std::string name(macro);
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return macro_name(name) == macro ? flags.find(name) : flags.end();
}

// A condition of flags alone has a value. A condition with other macros or operators is left to the compiler, with
// values for its flags. All names are looked up in any case, so that no unknown flag hides behind another.
class Condition {
 public:
  Condition(std::string_view text, const ShaderFlags& flags, const std::set<std::string, std::less<>>& macros,
            const Line& line)
      : words_(words_of(text)), line_(line) {
    for (std::string_view& word : words_) {
      if (std::isdigit(static_cast<unsigned char>(word[0])) != 0) {
        of_flags_ = of_flags_ && (word == "0" || word == "1");
      } else if (!is_in_word(word[0])) {
        of_flags_ = of_flags_ && (word == "&&" || word == "||" || word == "!" || word == "(" || word == ")");
      } else if (const auto found = flag_of(word, flags); found != flags.end()) {
        if (is_asked(&word)) throw always_defined(word);
        word = found->second ? "1" : "0";
      } else if (word == "defined" || is_asked(&word) || word.starts_with("GL_") || word.starts_with("__") ||
                 macros.contains(word)) {
        of_flags_ = false;
      } else {
        throw unknown(word, flags);
      }
    }
  }

  [[nodiscard]] bool has_value() const { return of_flags_; }

  bool value() {
    next_ = 0;
    const bool value = either();
    if (next_ < words_.size()) throw malformed();
    return value;
  }

  [[nodiscard]] std::string text() const { return fmt::format("{}", fmt::join(words_, " ")); }

 private:
  // Whether a word is behind `defined`.
  bool is_asked(const std::string_view* word) const {
    const auto* const first = words_.data();
    return (word > first && word[-1] == "defined") || (word > first + 1 && word[-1] == "(" && word[-2] == "defined");
  }

  // `defined` is true of a flag that is off, too.
  [[nodiscard]] Error always_defined(std::string_view flag) const {
    return line_.bad(fmt::format("`{}` is always defined", flag), fmt::format("write #if {}", flag));
  }

  [[nodiscard]] Error unknown(std::string_view word, const ShaderFlags& flags) const {
    std::vector<std::string> known;
    for (const auto& [name, on] : flags) known.push_back(macro_name(name));
    return line_.bad(fmt::format("unknown flag `{}`", word), suggestion(word, known));
  }

  bool take(std::string_view word) {
    if (next_ == words_.size() || words_[next_] != word) return false;
    ++next_;
    return true;
  }

  bool either() {
    bool value = both();
    while (take("||")) value = both() || value;
    return value;
  }

  bool both() {
    bool value = single();
    while (take("&&")) value = single() && value;
    return value;
  }

  bool single() {
    if (take("!")) return !single();
    if (take("(")) {
      const bool value = either();
      if (!take(")")) throw malformed();
      return value;
    }
    if (take("1")) return true;
    if (take("0")) return false;
    throw malformed();
  }

  [[nodiscard]] Error malformed() const {
    return line_.bad(next_ == words_.size() ? "a condition ends too early"
                                            : fmt::format("`{}` is out of place here", words_[next_]));
  }

  std::vector<std::string_view> words_;
  std::size_t next_ = 0;
  const Line& line_;
  bool of_flags_ = true;
};

// `#WORD REST`, without comments behind it.
struct Directive {
  std::string_view word, rest;
};

std::optional<Directive> directive_in(std::string_view line) {
  line = trimmed(line.substr(0, std::min(line.find("//"), line.find("/*"))));
  if (!line.starts_with('#')) return {};
  line = trimmed(line.substr(1));
  const std::size_t size = static_cast<std::size_t>(std::ranges::find_if_not(line, is_in_word) - line.begin());
  return Directive{line.substr(0, size), trimmed(line.substr(size))};
}

// The line behind the block comments at its start. `is_open`: whether a comment is open at its start, and then at its
// end.
std::string_view behind_comments(std::string_view line, bool& is_open) {
  std::size_t code = 0, comment = 0;
  for (std::size_t at = 0; at < line.size();) {
    const std::string_view two = line.substr(at, 2);
    if (!is_open && two == "//") break;
    const bool switches = two == (is_open ? "*/" : "/*");
    if (switches && !is_open) comment = at;
    at += switches ? 2 : 1;
    if (switches && is_open && trimmed(line.substr(code, comment - code)).empty()) code = at;
    if (switches) is_open = !is_open;
  }
  return line.substr(code);
}

// The standard form of a condition of `not`, `and` and `or`.
std::string standard_condition(std::string_view former) {
  std::string text;
  for (const std::string_view word : words_of(former)) {
    if (word == "and" || word == "or") {
      text += word == "and" ? " && " : " || ";
    } else {
      text += word == "not" ? "!" : macro_name(word);
    }
  }
  return text;
}

// The standard form of a directive behind `//? `; empty if it is none.
std::string standard_directive(std::string_view former) {
  if (former == "else") return "`#else`";
  if (former == "end") return "`#endif`";
  if (former.starts_with("if ")) return fmt::format("`#if {}`", standard_condition(former.substr(3)));
  if (former.starts_with("elif ")) return fmt::format("`#elif {}`", standard_condition(former.substr(5)));
  if (!former.starts_with("include ")) return {};
  const std::size_t end = former.find(" if ");
  const std::string file = fmt::format("`#include \"{}\"`", trimmed(former.substr(8, end - 8)));
  if (end == std::string_view::npos) return file;
  return fmt::format("`#if {}`, {} and `#endif`", standard_condition(former.substr(end + 4)), file);
}

}  // namespace

bool is_in_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

std::string macro_name(std::string_view flag) {
  std::string name(flag);
  std::ranges::transform(name, name.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return name;
}

// Reads one file. Its lines keep their numbers from `first_line` on where that is given.
class ShaderText::Reader {
 public:
  Reader(ShaderText& to, std::string_view file, int first_line) : to_(to), line_{file, 0}, first_line_(first_line) {}

  void read(std::string_view text) {
    while (!text.empty()) {
      const std::size_t stop = std::min(text.find('\n'), text.size());
      read_line(text.substr(0, stop));
      text.remove_prefix(std::min(stop + 1, text.size()));
    }
    if (branches_.empty()) return;
    line_.number = branches_.back().line;
    throw line_.bad("an `#if` is not closed");
  }

 private:
  // An open `#if`: whether its parent is included, whether one of its branches was, and whether `#else` came.
  struct Branch {
    int line;
    bool outer, taken;
    bool is_left = false;  // to the compiler
    bool ends = false;
  };

  void read_line(std::string_view text) {
    ++line_.number;
    const bool begins_in_comment = in_comment_;
    const std::string_view code = behind_comments(text, in_comment_);
    if (begins_in_comment && code.data() == text.data()) return put(text);
    refuse_former(code);
    const std::optional<Directive> directive = directive_in(code);
    if (!directive || !take(*directive)) put(text);
  }

  void put(std::string_view text) {
    if (!keeping_) {
      is_behind_ = true;
      return;
    }
    if (std::exchange(is_behind_, false) && first_line_ > 0)
      to_.add(fmt::format("#line {}\n", first_line_ + line_.number - 1));
    to_.origins_.push_back({to_.text_.size(), line_.file, line_.number});
    to_.text_ += text;
    to_.text_ += '\n';
  }

  // Refuses the directives of earlier versions, which the compiler would take for comments.
  void refuse_former(std::string_view code) const {
    const std::size_t mark = code.find("//? ");
    if (mark == std::string_view::npos || code.starts_with("// ")) return;
    const std::string standard = standard_directive(trimmed(code.substr(mark + 4)));
    if (standard.empty()) return;
    const bool is_alone = trimmed(code.substr(0, mark)).empty();
    throw line_.bad(fmt::format("`{}` is a directive of earlier versions", trimmed(code.substr(mark))),
                    "write " + standard + (is_alone ? "" : " in the line before, and `#endif` behind the last branch"));
  }

  // Whether the directive is done with; others are text for the compiler.
  bool take(const Directive& directive) {
    const auto& [word, rest] = directive;
    if (word == "if") {
      open(condition(rest));
    } else if (word == "ifdef" || word == "ifndef") {
      (void)condition(std::string("defined ").append(rest));
      leave(fmt::format("#{} {}", word, rest));
    } else if (word == "elif") {
      go_on("#elif", condition(rest));
    } else if (word == "else") {
      go_on("#else", {});
    } else if (word == "endif") {
      close();
    } else if (word == "include") {
      include(rest);
    } else {
      if (std::ranges::find(of_compilers, word) == of_compilers.end())
        throw line_.bad(fmt::format("`#{}` is not a directive", word));
      if (word == "define" && keeping_) to_.macros_.emplace(words_of(rest).empty() ? "" : words_of(rest).front());
      return false;
    }
    is_behind_ = true;
    return true;
  }

  [[nodiscard]] Condition condition(std::string_view text) const { return {text, to_.flags_, to_.macros_, line_}; }

  void open(Condition condition) {
    if (!condition.has_value()) return leave("#if " + condition.text());
    const bool is_true = condition.value();
    branches_.push_back({line_.number, keeping_, is_true});
    keeping_ = keeping_ && is_true;
  }

  // Leaves an `#if` to the compiler, with all of its branches.
  void leave(const std::string& directive) {
    put(directive);
    branches_.push_back({line_.number, keeping_, true, true});
  }

  // The next branch; `#else` has no condition.
  void go_on(std::string_view word, std::optional<Condition> condition) {
    if (branches_.empty()) throw line_.bad(fmt::format("`{}` without an `#if`", word));
    Branch& branch = branches_.back();
    if (branch.ends) throw line_.bad(fmt::format("`{}` behind an `#else`", word));
    branch.ends = !condition;
    if (branch.is_left) return put(condition ? fmt::format("{} {}", word, condition->text()) : std::string(word));
    if (condition && !condition->has_value())
      throw line_.bad(fmt::format("`{}` has more than flags behind an `#if` of flags", condition->text()),
                      "write `#else` and an `#if` within it");
    const bool is_true = !condition || condition->value();
    keeping_ = branch.outer && !branch.taken && is_true;
    branch.taken = branch.taken || is_true;
  }

  void close() {
    if (branches_.empty()) throw line_.bad("`#endif` without an `#if`");
    if (branches_.back().is_left) put("#endif");
    keeping_ = branches_.back().outer;
    branches_.pop_back();
  }

  void include(std::string_view rest) {
    const bool is_quoted = rest.size() > 2 && rest.starts_with('"') && rest.find('"', 1) == rest.size() - 1;
    if (!is_quoted) throw line_.bad(fmt::format("`#include {}` names no file in quotes", rest));
    const std::string_view file = rest.substr(1, rest.size() - 2);
    if (file == method_module && !to_.module_.file.empty()) {
      if (keeping_) to_.include_module();
      return;
    }
    const EmbeddedText* const shared = find_text(shared_glsl, file);
    const EmbeddedText* const own = find_text(to_.module_.folder, file);
    if (shared == nullptr && own == nullptr) throw no_text(file);
    if (!keeping_) return;
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
  bool is_behind_ = true;  // whether the number of the next line is not that of the last one that was kept, plus 1
  bool in_comment_ = false;
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

const ShaderText::Origin* ShaderText::origin(std::size_t offset) const {
  const auto behind = std::ranges::upper_bound(origins_, offset, {}, &Origin::offset);
  return behind == origins_.begin() ? nullptr : &*std::prev(behind);
}

bool ShaderText::is_shared(std::string_view file) { return find_text(shared_glsl, file) != nullptr; }

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

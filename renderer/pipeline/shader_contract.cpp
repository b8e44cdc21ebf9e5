// Finds prototypes and definitions of functions in a stage's text, and compares their types.
#include "renderer/pipeline/shader_contract.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <vector>

#include "renderer/core/embedded_texts.hpp"
#include "renderer/core/error.hpp"

namespace footprint {

extern const EmbeddedTexts shared_glsl;

namespace {

// The text with comments and lines of directives blank, character for character.
std::string code_of(std::string text) {
  for (std::size_t at = 0; at < text.size();) {
    const bool is_block = text.compare(at, 2, "/*") == 0;
    const bool is_directive = text[at] == '#' && (at == 0 || text[at - 1] == '\n');
    if (!is_block && !is_directive && text.compare(at, 2, "//") != 0) {
      ++at;
      continue;
    }
    const std::size_t mark = is_block ? text.find("*/", at + 2) : text.find('\n', at);
    const std::size_t end = mark == std::string::npos ? text.size() : mark + (is_block ? 2 : 0);
    std::replace_if(
        text.begin() + static_cast<std::ptrdiff_t>(at), text.begin() + static_cast<std::ptrdiff_t>(end),
        [](char c) { return c != '\n'; }, ' ');
    at = end;
  }
  return text;
}

struct Token {
  std::string_view text;
  std::size_t offset;
};

// Names, numbers and single characters.
std::vector<Token> tokens_of(std::string_view code) {
  std::vector<Token> tokens;
  for (std::size_t i = 0; i < code.size();) {
    if (std::isspace(static_cast<unsigned char>(code[i])) != 0) {
      ++i;
      continue;
    }
    std::size_t end = i + 1;
    while (is_in_word(code[i]) && end < code.size() && is_in_word(code[end])) ++end;
    tokens.push_back({code.substr(i, end - i), i});
    i = end;
  }
  return tokens;
}

using Tokens = std::vector<Token>;

struct Function {
  std::string name{};
  std::string signature{};                ///< types alone: "float ndf(Effective, vec3)"
  std::string declaration{};              ///< as written
  std::vector<std::string_view> types{};  ///< in the signature
  std::size_t offset = 0;                 ///< in the text
  bool is_prototype = false;
};

bool is_qualifier(std::string_view word) {
  constexpr std::array<std::string_view, 7> without_effect{"in",   "const",   "highp",    "mediump",
                                                           "lowp", "precise", "invariant"};
  return std::ranges::find(without_effect, word) != without_effect.end();
}

// The type of one parameter or result, `tokens[first, last)`: "inout Moments[parts]". A parameter may have a name.
std::string type_of(const Tokens& tokens, std::size_t first, std::size_t last, std::vector<std::string_view>& types) {
  std::string type, size;
  bool has_type = false, in_size = false;
  for (std::size_t i = first; i < last; ++i) {
    const std::string_view word = tokens[i].text;
    if (word == "[") in_size = true;
    if (in_size) {
      size += word;
    } else if (word == "inout" || word == "out") {
      type = fmt::format("{} ", word);
    } else if (!is_qualifier(word) && !has_type) {
      has_type = true;
      types.push_back(word);
      type += word;
    }
    if (word == "]") in_size = false;
  }
  return type + size;
}

// The functions of a text at its global scope, prototypes and definitions.
class Functions {
 public:
  Functions(std::string_view code, const Tokens& tokens) : code_(code), tokens_(tokens) { read(); }

  [[nodiscard]] const std::vector<Function>& all() const { return all_; }

 private:
  void read() {
    std::size_t start = 0;
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
      const std::string_view word = tokens_[i].text;
      if (word == ";") {
        start = i + 1;
      } else if (word == "{") {
        i = closing(i, "{", "}");
        start = i + 1;
      } else if (word == "(") {
        const std::size_t end = closing(i, "(", ")");
        add(start, i, end);
        i = end;
      }
    }
  }

  [[nodiscard]] std::size_t closing(std::size_t i, std::string_view open, std::string_view close) const {
    for (int depth = 0; i < tokens_.size(); ++i) {
      if (tokens_[i].text == open) ++depth;
      if (tokens_[i].text == close && --depth == 0) return i;
    }
    return tokens_.size() - 1;
  }

  // `tokens[start]` begins a statement whose first parentheses are `open` and `close`.
  void add(std::size_t start, std::size_t open, std::size_t close) {
    const bool has_words = open >= start + 2 && std::all_of(tokens_.begin() + static_cast<std::ptrdiff_t>(start),
                                                            tokens_.begin() + static_cast<std::ptrdiff_t>(open),
                                                            [](const Token& t) { return is_in_word(t.text[0]); });
    if (!has_words || close + 1 >= tokens_.size()) return;
    const std::string_view next = tokens_[close + 1].text;
    if (next != ";" && next != "{") return;
    Function function{
        .name = std::string(tokens_[open - 1].text), .offset = tokens_[start].offset, .is_prototype = next == ";"};
    function.signature = type_of(tokens_, start, open - 1, function.types) + " " + function.name + "(";
    for (std::size_t first = open + 1; first < close;) {
      std::size_t last = first;
      while (last < close && tokens_[last].text != ",") ++last;
      if (first > open + 1) function.signature += ", ";
      function.signature += type_of(tokens_, first, last, function.types);
      first = last + 1;
    }
    function.signature += ")";
    function.declaration = plain(code_.substr(function.offset, tokens_[close].offset + 1 - function.offset));
    all_.push_back(std::move(function));
  }

  // On one line, with single blanks.
  static std::string plain(std::string_view text) {
    std::string line;
    for (const char c : text) {
      const bool is_blank = std::isspace(static_cast<unsigned char>(c)) != 0;
      if (!is_blank || (!line.empty() && line.back() != ' ')) line += is_blank ? ' ' : c;
    }
    return line;
  }

  std::string_view code_;
  const Tokens& tokens_;
  std::vector<Function> all_;
};

bool has_structure(const Tokens& tokens, std::string_view name) {
  for (std::size_t i = 1; i < tokens.size(); ++i) {
    if (tokens[i].text == name && tokens[i - 1].text == "struct") return true;
  }
  return false;
}

// The error of a module that does not define what the prototype `wanted` declares.
class Breach {
 public:
  Breach(const ShaderText& text, std::string_view module, const Function& wanted)
      : text_(text), module_(module), wanted_(wanted) {}

  [[nodiscard]] Error structure(std::string_view name) const {
    return error(module_, fmt::format("does not define `struct {}`", name));
  }

  // near: definitions of that name.
  [[nodiscard]] Error function(const std::vector<const Function*>& near) const {
    for (const Function* const definition : near) {
      const ShaderText::Origin* const at = text_.origin(definition->offset);
      if (at == nullptr || ShaderText::is_shared(at->file)) continue;
      return error(fmt::format("{}, line {}", at->file, at->line),
                   fmt::format("defines `{}` instead of `{}`", definition->declaration, wanted_.declaration));
    }
    return error(module_, fmt::format("does not define `{}`", wanted_.declaration));
  }

 private:
  [[nodiscard]] Error error(const std::string_view place, const std::string& message) const {
    const ShaderText::Origin* const declared = text_.origin(wanted_.offset);
    return {ErrorKind::usage, std::string(place), message,
            fmt::format("renderer/shaders/{} declares it on line {}", declared->file, declared->line)};
  }

  const ShaderText& text_;
  std::string_view module_;
  const Function& wanted_;
};

bool is_wanted(const Function& function, const ShaderText& text) {
  const ShaderText::Origin* const at = text.origin(function.offset);
  return function.is_prototype && at != nullptr && ShaderText::is_shared(at->file);
}

// Whether every program needs a function: a line of a shared text that is under no condition declares it.
bool is_unconditional(const Function& function, const ShaderText& text) {
  const ShaderText::Origin& at = *text.origin(function.offset);
  std::string_view lines = find_text(shared_glsl, at.file)->text;
  int depth = 0;
  for (int line = 1; line < at.line && !lines.empty(); ++line) {
    if (lines.starts_with("#if")) ++depth;
    if (lines.starts_with("#endif")) --depth;
    lines.remove_prefix(std::min(lines.find('\n'), lines.size() - 1) + 1);
  }
  return depth == 0;
}

// Whether a function is called: its name is before a parenthesis more often than declarations have it.
bool is_called(const Function& function, const Tokens& tokens, const std::vector<Function>& all) {
  std::ptrdiff_t uses = 0;
  for (std::size_t i = 0; i + 1 < tokens.size(); ++i) {
    if (tokens[i].text == function.name && tokens[i + 1].text == "(") ++uses;
  }
  return uses > std::ranges::count(all, function.name, &Function::name);
}

}  // namespace

void require_definitions(const ShaderText& text, std::string_view module) {
  const std::string code = code_of(text.text());
  const Tokens tokens = tokens_of(code);
  const Functions functions(code, tokens);
  for (const Function& wanted : functions.all()) {
    if (!is_wanted(wanted, text)) continue;
    if (!is_unconditional(wanted, text) && !is_called(wanted, tokens, functions.all())) continue;
    const Breach breach(text, module, wanted);
    for (const std::string_view type : wanted.types) {
      if (std::isupper(static_cast<unsigned char>(type[0])) != 0 && !has_structure(tokens, type))
        throw breach.structure(type);
    }
    std::vector<const Function*> near;
    for (const Function& other : functions.all()) {
      if (!other.is_prototype && other.name == wanted.name) near.push_back(&other);
    }
    if (std::ranges::none_of(near, [&](const Function* f) { return f->signature == wanted.signature; }))
      throw breach.function(near);
  }
}

}  // namespace footprint

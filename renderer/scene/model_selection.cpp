// Finds what was asked for by name, else by number.
#include "renderer/scene/model_selection.hpp"

#include <fmt/format.h>

#include "renderer/core/error.hpp"
#include "renderer/core/suggest.hpp"

namespace footprint {

std::size_t find_choice(const ModelChoice& choice, const std::string& wanted) {
  if (const auto found = find_entry(wanted, choice.names)) return *found;
  throw Error(ErrorKind::usage, choice.kind, fmt::format("the model has none that is called `{:.80}`", wanted),
              choice.names.empty() ? fmt::format("it has no {} to choose: leave it out", choice.kind)
                                   : suggestion(wanted, choice.names) + fmt::format("; or a number from 0"));
}

}  // namespace footprint

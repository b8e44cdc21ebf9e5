// Puts place, message and hint together into one sentence, and prefixes outer places.
#include "renderer/core/error.hpp"

#include <utility>

namespace footprint {
namespace {

std::string sentence(const std::string& place, const std::string& message, const std::string& hint) {
  std::string text = place.empty() ? message : place + ": " + message;
  if (!hint.empty()) text += " (" + hint + ")";
  return text;
}

}  // namespace

Error::Error(ErrorKind kind, std::string place, std::string message, std::string hint)
    : std::runtime_error(sentence(place, message, hint)),
      kind_(kind),
      place_(std::move(place)),
      message_(std::move(message)),
      hint_(std::move(hint)) {}

Error Error::within(const std::string& outer) const {
  return {kind_, place_.empty() ? outer : outer + ", " + place_, message_, hint_};
}

}  // namespace footprint

// See output.hpp.
#include "app/output.hpp"

namespace footprint {

Error at_final_place(const Error& error, const OutputFolder& folder) {
  std::string place = error.place();
  const std::string hidden = folder.path().string();
  if (place.starts_with(hidden)) place.replace(0, hidden.size(), folder.final_path().string());
  return {error.kind(), std::move(place), error.message(), error.mend()};
}

}  // namespace footprint

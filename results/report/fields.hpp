// The parameter of a function that lists the fields of a structure (json_archive.hpp).
#pragma once

#include <concepts>
#include <type_traits>

namespace footprint {

/// `Value` is `Type` or const `Type`: one list of fields serves the writer and the reader.
template <class Value, class Type>
concept Is = std::same_as<std::remove_const_t<Value>, Type>;

}  // namespace footprint

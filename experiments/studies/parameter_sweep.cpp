// Checks a sweep against the parameters of its kind, and interpolates between its ends.
#include "experiments/studies/parameter_sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "renderer/core/error.hpp"
#include "renderer/core/names.hpp"

namespace footprint {
namespace {

const OptionSpec& spec_of(const PatchKind& kind, const std::string& parameter, const std::string& place) {
  std::vector<std::string> names;
  for (const OptionSpec& spec : kind.parameters) {
    if (spec.name == parameter) return spec;
    names.push_back(spec.name);
  }
  throw Error(ErrorKind::usage, place, fmt::format("{} has no parameter `{:.80}`", kind.name, parameter),
              names.empty() ? "it has none" : suggestion(parameter, names));
}

bool is_word(const OptionSpec& spec) { return !spec.choices.empty(); }

}  // namespace

ParameterSweep parse_sweep(const std::string& text) {
  const std::string place = fmt::format("--set {:.200}", text);
  const std::size_t dot = text.find('.'), equals = text.find('=');
  if (equals == std::string::npos || dot == std::string::npos || dot > equals || dot == 0 || dot + 1 == equals) {
    throw Error(ErrorKind::usage, place, "is not KIND.PARAMETER=FROM:TO", "write --set weave.warp_width=0.1:0.5");
  }
  ParameterSweep sweep{text.substr(0, dot), text.substr(dot + 1, equals - dot - 1), {}, {}};
  const std::string values = text.substr(equals + 1);
  const std::size_t colon = values.find(':');
  sweep.from = values.substr(0, colon);
  sweep.to = colon == std::string::npos ? sweep.from : values.substr(colon + 1);
  try {
    const PatchKind& kind = find_patch_kind(sweep.kind);
    const OptionSpec& spec = spec_of(kind, sweep.parameter, "");
    for (const std::string& value : {sweep.from, sweep.to}) {
      const Options checked(kind.parameters, {{sweep.parameter, value}}, "microgeometry " + kind.name);
    }
    if (is_word(spec) && sweep.from != sweep.to) {
      throw Error(ErrorKind::usage, "", "a word has nothing between its first value and its last", "give one of them");
    }
  } catch (const Error& error) {
    throw error.within(place);
  }
  return sweep;
}

void check_sweeps(std::span<const ParameterSweep> sweeps, const PatchKind& kind) {
  for (const ParameterSweep& sweep : sweeps) {
    const std::string name = sweep.kind + "." + sweep.parameter;
    if (sweep.kind != kind.name) {
      throw Error(ErrorKind::usage, "--set " + name, fmt::format("the scene's small-scale geometry is {}", kind.name),
                  fmt::format("set a parameter of {}", kind.name));
    }
    if (std::ranges::count(sweeps, sweep.parameter, &ParameterSweep::parameter) > 1) {
      throw Error(ErrorKind::usage, "--set " + name, "is given twice", "give it once, as FROM:TO");
    }
  }
}

std::map<std::string, std::string> values_at(std::span<const ParameterSweep> sweeps, int frame, int frames) {
  std::map<std::string, std::string> values;
  for (const ParameterSweep& sweep : sweeps) {
    const OptionSpec& spec = spec_of(find_patch_kind(sweep.kind), sweep.parameter, "--set");
    if (is_word(spec) || sweep.from == sweep.to) {
      values[sweep.parameter] = sweep.from;
      continue;
    }
    const double part = frames > 1 ? static_cast<double>(frame) / (frames - 1) : 0.0;
    const double value = std::lerp(std::stod(sweep.from), std::stod(sweep.to), part);
    values[sweep.parameter] = fmt::format("{}", spec.integer ? std::round(value) : value);
  }
  return values;
}

}  // namespace footprint

// A disk that is full for the files whose names match FOOTPRINT_FAULT_FILES, a basic regular expression: they cannot be
// put in their place. Files appear by a rename (renderer/core/files.cpp), and links are made of finished ones.
// FOOTPRINT_FAULT_TIMES, if set, is after how many refusals there is space again.
#include <dlfcn.h>
#include <regex.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>

namespace {

bool is_named(const char* file) {
  const char* const pattern = std::getenv("FOOTPRINT_FAULT_FILES");
  regex_t compiled;
  if (pattern == nullptr || regcomp(&compiled, pattern, REG_NOSUB) != 0) return false;
  const bool matches = regexec(&compiled, file, 0, nullptr, 0) == 0;
  regfree(&compiled);
  return matches;
}

bool is_refused(const char* file) {
  static std::atomic<int> refusals = 0;
  if (!is_named(file)) return false;
  const char* const times = std::getenv("FOOTPRINT_FAULT_TIMES");
  return times == nullptr || refusals++ < std::atoi(times);
}

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" [[gnu::visibility("default")]] int rename(const char* from, const char* to) {
  if (is_refused(to)) {
    errno = ENOSPC;
    return -1;
  }
  return next<int (*)(const char*, const char*)>("rename")(from, to);
}

extern "C" [[gnu::visibility("default")]] int link(const char* from, const char* to) {
  if (is_refused(to)) {
    errno = ENOSPC;
    return -1;
  }
  return next<int (*)(const char*, const char*)>("link")(from, to);
}

// The signal handler stores the signal in a lock-free atomic and restores its default action: the next one ends the
// process.
#include "renderer/core/process.hpp"

#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>

#include "renderer/core/error.hpp"

namespace footprint {
namespace {

std::atomic<int> received{0};  // the one thing a signal handler may touch; lock-free, asserted below
static_assert(std::atomic<int>::is_always_lock_free);

extern "C" void remember(int signal_number) {
  received.store(signal_number);
  std::signal(signal_number, SIG_DFL);  // the next one ends the process
}

}  // namespace

std::string host_name() {
  std::array<char, 256> name{};  // POSIX: HOST_NAME_MAX is 255 at most
  if (::gethostname(name.data(), name.size() - 1) != 0 || name.front() == '\0') return "?";
  return name.data();
}

void watch_interrupts() {
  received.store(0);
  std::signal(SIGINT, remember);
  std::signal(SIGTERM, remember);
  if (std::signal(SIGHUP, remember) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // nohup: the terminal may close
}

void throw_if_interrupted() {
  if (received.load() == 0) return;
  throw Error(ErrorKind::interrupted, {}, "interrupted: nothing was written");
}

}  // namespace footprint

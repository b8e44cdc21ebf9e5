// Loaded before a program: Ctrl-C while its libraries set themselves up, before main.
#include <csignal>

namespace {

struct Interrupt {
  Interrupt() { std::raise(SIGINT); }
} const interrupt;

}  // namespace

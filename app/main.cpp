// The program `footprint`, and the handling of signals and thread failures until main starts.
//
// Some thirty libraries initialise themselves before main, which takes a tenth of a second or more. Until then, Ctrl-C
// ends the program with its exit code. A library that cannot start its thread (log4cplus, below OpenImageIO, starts one
// when it is loaded, and throws) ends it with a message instead of an abort. A program's .preinit_array runs before the
// initialisation of its libraries (System V gABI, chapter 5, Initialization and Termination Functions).
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <system_error>

#include "app/commands.hpp"
#include "renderer/core/error.hpp"

namespace footprint {
namespace {

// Uses no stream and no allocation, because neither may work yet.
[[noreturn]] void end_with(const char* message, ErrorKind kind) {
  static_cast<void>(::write(STDERR_FILENO, message, std::strlen(message)) == 0);
  ::_exit(static_cast<int>(kind));
}

extern "C" void end_before_main(int) {
  end_with("footprint: interrupted: nothing was written\n", ErrorKind::interrupted);
}

[[noreturn]] void end_without_thread() {
  try {
    if (std::current_exception()) std::rethrow_exception(std::current_exception());
  } catch (const std::system_error& error) {
    if (error.code() == std::errc::resource_unavailable_try_again)
      end_with("footprint: cannot create a thread (raise `ulimit -u`, or end other programs)\n", ErrorKind::machine);
  } catch (...) {  // an abort says more about other exceptions
  }
  std::abort();
}

void before_libraries(int, char**, char**) {
  std::set_terminate(end_without_thread);
  std::signal(SIGINT, end_before_main);  // main replaces it by a handler that ends work in order
}

[[gnu::section(".preinit_array"), gnu::used]] void (*const start)(int, char**, char**) = before_libraries;

}  // namespace
}  // namespace footprint

int main(int argc, char** argv) { return footprint::run_program(argc, argv); }

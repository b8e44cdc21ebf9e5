// fork, and execve or the function, with output and errors in files; polls them for the end, the text to interrupt at
// and the timeout.
#include "tests/support/process.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>
#include <thread>

namespace footprint::test {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

std::string read_text(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::string> full_environment(const std::map<std::string, std::string>& added) {
  std::vector<std::string> variables;
  variables.reserve(added.size());
  for (const auto& [name, value] : added) variables.emplace_back(name).append("=").append(value);
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string text = *variable;
    if (!added.contains(text.substr(0, text.find('=')))) variables.push_back(text);
  }
  return variables;
}

// The form that execve takes; valid as long as `texts` is.
std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> result;
  result.reserve(texts.size() + 1);
  for (std::string& text : texts) result.push_back(text.data());
  result.push_back(nullptr);
  return result;
}

void redirect(int descriptor, const char* file) {
  const int opened = open(file, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  if (opened < 0 || dup2(opened, descriptor) < 0) _exit(126);
}

// In the child.
void redirect_and_limit(const char* output, const char* errors, const std::optional<std::uint64_t>& file_size_limit) {
  redirect(STDOUT_FILENO, output);
  redirect(STDERR_FILENO, errors);
  if (file_size_limit) {
    const rlimit limit{*file_size_limit, *file_size_limit};
    if (setrlimit(RLIMIT_FSIZE, &limit) != 0) _exit(126);
  }
}

// The child: only async-signal-safe calls between fork and exec.
[[noreturn]] void become(char* const* command, char* const* environment) {
  execve(command[0], command, environment);
  _exit(127);
}

std::ptrdiff_t threads_now() {
  return std::distance(fs::directory_iterator("/proc/self/task"), fs::directory_iterator());
}

// A library that OpenImageIO's formats load, log4cplus, starts four when it is loaded, which wait for work ever after.
const std::ptrdiff_t threads_of_libraries = threads_now();

// A fork has the thread that made it alone, and the locks of all others as they were.
void require_no_threads() {
  if (threads_now() > threads_of_libraries)
    throw std::logic_error("a process that has started threads runs no function in its fork");
}

// The child that stays what it is. What runs at a program's end is left out: log4cplus would wait for its threads,
// which a fork does not have.
[[noreturn]] void run_function(const ProcessRequest& request, const std::vector<char*>& arguments) {
  for (const auto& [name, value] : request.environment) setenv(name.c_str(), value.c_str(), 1);
  const int code = request.function(static_cast<int>(arguments.size()) - 1, arguments.data());
  std::fflush(nullptr);
  _exit(code);
}

// Waits for the end of `child`, interrupting it on request and killing it at the timeout.
int wait_for(pid_t child, const ProcessRequest& request, const fs::path& errors, bool& interrupted) {
  const auto deadline = Clock::now() + request.timeout;
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0) {
    const bool due = !interrupted && !request.interrupt_at.empty() &&
                     read_text(errors).find(request.interrupt_at) != std::string::npos;
    if (due) {
      kill(child, SIGINT);
      interrupted = true;
    }
    if (Clock::now() > deadline) kill(child, SIGKILL);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return status;
}

}  // namespace

ProcessResult run_process(const ProcessRequest& request) {
  const bool elsewhere = !request.standard_output.empty();
  const fs::path output = elsewhere ? request.standard_output : request.folder / "standard_output.txt";
  const fs::path errors = request.folder / "standard_error.txt";
  std::vector<std::string> command = request.command;
  std::vector<std::string> environment = full_environment(request.environment);
  const std::vector<char*> argv = pointers(command);
  const std::vector<char*> envp = pointers(environment);

  if (request.function != nullptr) require_no_threads();
  const auto start = Clock::now();
  std::fflush(nullptr);  // a copy of this process would write what is not yet written once more
  const pid_t child = fork();
  if (child < 0) throw std::system_error(errno, std::generic_category(), "fork");
  if (child == 0) {
    redirect_and_limit(output.c_str(), errors.c_str(), request.file_size_limit);
    if (request.function != nullptr) run_function(request, argv);
    become(argv.data(), envp.data());
  }

  ProcessResult result;
  const int status = wait_for(child, request, errors, result.interrupted);
  result.duration = Clock::now() - start;
  if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
  result.errors = read_text(errors);
  fs::remove(errors);
  if (!elsewhere) {
    result.output = read_text(output);
    fs::remove(output);
  }
  return result;
}

}  // namespace footprint::test

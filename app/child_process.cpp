// Starts the program by posix_spawn with standard error in a file, and polls it so that interrupts are noticed.
#include "app/child_process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <thread>

namespace footprint {
namespace {

// This program's environment with some variables replaced; null at the end.
std::vector<char*> environment_with(std::vector<std::string>& replaced) {
  const auto name_of = [](std::string_view variable) { return variable.substr(0, variable.find('=')); };
  std::vector<char*> variables;
  for (std::string& own : replaced) variables.push_back(own.data());
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const bool is_replaced =
        std::ranges::any_of(replaced, [&](const std::string& own) { return name_of(own) == name_of(*variable); });
    if (!is_replaced) variables.push_back(*variable);
  }
  variables.push_back(nullptr);
  return variables;
}

}  // namespace

ChildProcess::ChildProcess(ChildCommand command, const Error& failure) {
  std::vector<char*> pointers;
  pointers.reserve(command.arguments.size() + 1);
  for (std::string& argument : command.arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  std::vector<char*> variables = environment_with(command.variables);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, command.errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (!command.folder.empty()) posix_spawn_file_actions_addchdir_np(&actions, command.folder.c_str());
  const int status = posix_spawn(&id_, command.program.c_str(), &actions, nullptr, pointers.data(), variables.data());
  posix_spawn_file_actions_destroy(&actions);
  if (status == 0) return;
  id_ = 0;
  throw failure;
}

ChildProcess::~ChildProcess() {
  if (id_ == 0) return;
  kill(id_, SIGKILL);
  waitpid(id_, nullptr, 0);
}

std::optional<int> ChildProcess::poll() {
  int status = 0;
  if (waitpid(id_, &status, WNOHANG) == 0) return std::nullopt;
  id_ = 0;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

int ChildProcess::wait(const std::function<void()>& tick) {
  for (;;) {
    tick();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    if (const std::optional<int> exit_code = poll()) return *exit_code;
  }
}

}  // namespace footprint

// Starts the program by posix_spawn with standard error in a file, and polls it so that interrupts are noticed.
#include "app/child_process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <thread>

namespace footprint {

ChildProcess::ChildProcess(ChildCommand command, const Error& failure) {
  std::vector<char*> pointers;
  pointers.reserve(command.arguments.size() + 1);
  for (std::string& argument : command.arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, command.errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (!command.folder.empty()) posix_spawn_file_actions_addchdir_np(&actions, command.folder.c_str());
  const int status = posix_spawn(&id_, command.program.c_str(), &actions, nullptr, pointers.data(), environ);
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

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace footprint

#include "worker_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

#include "slalom/base/error.hpp"

namespace slalom::sweep {
namespace {

constexpr std::size_t kLastWords = 2000;  ///< bytes kept of a worker's standard error

[[noreturn]] void fail(const char* what) {
  throw Error(fmt::format("a worker process cannot be started: {} ({})", what, strerror(errno)));
}

void make_non_blocking(int descriptor) {
  fcntl(descriptor, F_SETFL, fcntl(descriptor, F_GETFL) | O_NONBLOCK);
}

/// What the child does between fork and exec: only calls that are safe there.
[[noreturn]] void become(char* const* command, int socket, int messages, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  // The parent may have died before prctl.
  if (getppid() != parent) _exit(127);
  dup2(socket, STDIN_FILENO);
  dup2(socket, STDOUT_FILENO);
  dup2(messages, STDERR_FILENO);
  execv(command[0], command);
  _exit(127);
}

/// The last line that says anything.
std::string last_line(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
  const auto at = text.rfind('\n');
  return at == std::string::npos ? text : text.substr(at + 1);
}

}  // namespace

WorkerProcess::WorkerProcess(const std::vector<std::string>& command) {
  std::vector<char*> arguments;
  for (const auto& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  int sockets[2], pipe[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets) != 0) fail("socketpair");
  if (::pipe2(pipe, O_CLOEXEC) != 0) {
    ::close(sockets[0]);
    ::close(sockets[1]);
    fail("pipe");
  }
  socket_ = sockets[0];
  messages_ = pipe[0];
  const pid_t parent = ::getpid();
  process_ = ::fork();
  if (process_ == 0) become(arguments.data(), sockets[1], pipe[1], parent);
  ::close(sockets[1]);
  ::close(pipe[1]);
  if (process_ < 0) {
    close_all();
    fail("fork");
  }
  make_non_blocking(socket_);
  make_non_blocking(messages_);
}

WorkerProcess::~WorkerProcess() {
  if (process_ > 0) (void)finish();
  close_all();
}

WorkerProcess::WorkerProcess(WorkerProcess&& other) noexcept {
  *this = std::move(other);
}

WorkerProcess& WorkerProcess::operator=(WorkerProcess&& other) noexcept {
  std::swap(process_, other.process_);
  std::swap(socket_, other.socket_);
  std::swap(messages_, other.messages_);
  std::swap(incoming_, other.incoming_);
  std::swap(outgoing_, other.outgoing_);
  std::swap(last_words_, other.last_words_);
  return *this;
}

void WorkerProcess::close_all() {
  for (int* descriptor : {&socket_, &messages_}) {
    if (*descriptor >= 0) ::close(*descriptor);
    *descriptor = -1;
  }
}

void WorkerProcess::send(const std::string& line) {
  outgoing_ += line;
  outgoing_ += '\n';
  flush();
}

void WorkerProcess::flush() {
  while (!outgoing_.empty()) {
    const auto n = ::send(socket_, outgoing_.data(), outgoing_.size(), MSG_NOSIGNAL);
    if (n < 0 && errno == EINTR) continue;
    // A worker that is gone shows when it is read from.
    if (n < 0 && errno != EAGAIN) outgoing_.clear();
    if (n <= 0) return;
    outgoing_.erase(0, static_cast<std::size_t>(n));
  }
}

bool WorkerProcess::receive() {
  char buffer[65536];
  for (;;) {
    const auto n = ::read(socket_, buffer, sizeof buffer);
    if (n > 0) {
      incoming_.append(buffer, static_cast<std::size_t>(n));
    } else if (n == 0 || (errno != EINTR && errno != EAGAIN)) {
      return false;
    } else if (errno == EAGAIN) {
      return true;
    }
  }
}

void WorkerProcess::receive_messages() {
  char buffer[4096];
  while (messages_ >= 0) {
    const auto n = ::read(messages_, buffer, sizeof buffer);
    if (n > 0) {
      last_words_.append(buffer, static_cast<std::size_t>(n));
      if (last_words_.size() > kLastWords) last_words_.erase(0, last_words_.size() - kLastWords);
    } else if (n < 0 && errno == EINTR) {
      continue;
    } else {
      if (n == 0) {
        ::close(messages_);
        messages_ = -1;
      }
      return;
    }
  }
}

std::optional<std::string> WorkerProcess::take_line() {
  const auto end = incoming_.find('\n');
  if (end == std::string::npos) return std::nullopt;
  auto line = incoming_.substr(0, end);
  incoming_.erase(0, end + 1);
  return line;
}

WorkerEnd WorkerProcess::finish() {
  int status = 0;
  ::kill(process_, SIGKILL);  // no effect on one that has ended: it is still to be waited for
  while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  receive_messages();
  const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  WorkerEnd end;
  end.text = signal != 0
                 ? fmt::format("the worker was killed by signal {} ({})", signal, strsignal(signal))
                 : fmt::format("the worker ended with exit code {}", WEXITSTATUS(status));
  if (const auto words = last_line(last_words_); !words.empty()) end.text += ": " + words;
  for (const int sent : {SIGKILL, SIGTERM, SIGINT, SIGHUP, SIGQUIT}) end.killed |= signal == sent;
  return end;
}

}  // namespace slalom::sweep

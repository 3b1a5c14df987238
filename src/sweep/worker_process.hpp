#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

namespace slalom::sweep {

/// How a worker ended.
struct WorkerEnd {
  /// "the worker was killed by signal 11 (Segmentation fault)", "the worker ended with exit code
  /// 4", and its last words.
  std::string text;
  bool killed = false;  ///< by a signal that others send: SIGKILL, SIGTERM, SIGINT, SIGHUP, SIGQUIT
};

/// A child process that talks in lines over a socket as its standard input and output. It is killed
/// when this object or this process ends.
class WorkerProcess {
 public:
  /// Throws Error when the child cannot be started.
  explicit WorkerProcess(const std::vector<std::string>& command);
  ~WorkerProcess();
  WorkerProcess(WorkerProcess&&) noexcept;
  WorkerProcess& operator=(WorkerProcess&&) noexcept;

  pid_t process() const { return process_; }
  int socket() const { return socket_; }  ///< to poll for answers
  int message_pipe() const {
    return messages_;
  }  ///< to poll for its standard error; -1 once closed
  bool wants_to_write() const { return !outgoing_.empty(); }

  /// Sends a line; what the socket does not take now is sent by flush().
  void send(const std::string& line);
  void flush();
  /// Takes in what has come without waiting; false once the other end has closed.
  bool receive();
  void receive_messages();
  /// The next whole line that has come, if any.
  std::optional<std::string> take_line();

  /// Kills the process if it still runs, waits for it, and says how it ended.
  WorkerEnd finish();

 private:
  void close_all();

  pid_t process_ = -1;
  int socket_ = -1, messages_ = -1;
  std::string incoming_, outgoing_, last_words_;
};

}  // namespace slalom::sweep

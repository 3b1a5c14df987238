#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace slalom::nlp {

/// A folder under the system's temporary one, gone with this object. Throws Error if it cannot be.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// The executable file that a shell would run for `name`; empty if there is none.
std::filesystem::path find_executable(const std::string& name);

/// How a process ended.
struct ProcessEnd {
  bool stopped = false;  ///< by `stop`
  int exit_code = 0;     ///< 128 + its signal, where one ended it
  double cpu_s = 0;      ///< processor time that it took
};

/// Runs `command` in `folder` with its output in the file `log`, or, if that is empty, where this
/// process's goes. `stop` is asked every few milliseconds with the processor time taken so far;
/// true kills the process. Throws Error if it cannot be started.
ProcessEnd run_process(const std::vector<std::string>& command, const std::filesystem::path& folder,
                       const std::filesystem::path& log,
                       const std::function<bool(double cpu_s)>& stop);

}  // namespace slalom::nlp

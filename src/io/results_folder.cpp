#include "slalom/io/results_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "slalom/base/error.hpp"
#include "slalom/io/drive_files.hpp"

namespace slalom::io {

ResultsFolder::ResultsFolder(const std::filesystem::path& folder, bool force) {
  prepare_folder(folder, force);
  // The folder itself is locked, so that nothing is left in it. A process that is killed lets go.
  descriptor_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor_ < 0)
    throw Error(fmt::format("{}: cannot be opened ({})", folder.string(), std::strerror(errno)));
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
    const bool taken = errno == EWOULDBLOCK;
    ::close(std::exchange(descriptor_, -1));
    // A file system that has no locks is no reason to fail.
    if (taken)
      throw Error(fmt::format("{}: another process writes its results there", folder.string()));
    return;
  }
  try {
    prepare_folder(folder, force);  // whoever held it may just have written
  } catch (...) {
    ::close(std::exchange(descriptor_, -1));
    throw;
  }
}

ResultsFolder::~ResultsFolder() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

ResultsFolder::ResultsFolder(ResultsFolder&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)) {}

ResultsFolder& ResultsFolder::operator=(ResultsFolder&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

}  // namespace slalom::io

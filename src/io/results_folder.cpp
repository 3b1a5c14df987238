#include "slalom/io/results_folder.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <utility>

#include "file_lock.hpp"
#include "slalom/base/error.hpp"
#include "slalom/io/drive_files.hpp"

namespace slalom::io {
namespace {

/// A file of its own, for the folder itself is locked by all that write aside in it (FileSet).
std::filesystem::path lock_file(const std::filesystem::path& folder) {
  return folder / ".results.lock";
}

}  // namespace

ResultsFolder::ResultsFolder() = default;

ResultsFolder::ResultsFolder(const std::filesystem::path& folder, bool force) : folder_(folder) {
  prepare_folder(folder, force);
  do {
    try {
      lock_ = std::make_unique<FileLock>(lock_file(folder), FileLock::Wait::no);
    } catch (const Error&) {
      return;  // A file system that has no locks is no reason to fail.
    }
    if (!lock_->held()) {
      lock_.reset();
      throw Error(fmt::format("{}: another process writes its results there", folder.string()));
    }
  } while (!lock_->stands());
  try {
    prepare_folder(folder, force);  // whoever held it may just have written
  } catch (...) {
    release();
    throw;
  }
}

/// The file goes while it is held, so that nobody else's is removed.
void ResultsFolder::release() {
  if (lock_ != nullptr) ::unlink(lock_file(folder_).c_str());
  lock_.reset();
}

ResultsFolder::~ResultsFolder() {
  release();
}

ResultsFolder::ResultsFolder(ResultsFolder&& other) noexcept = default;

ResultsFolder& ResultsFolder::operator=(ResultsFolder&& other) noexcept {
  std::swap(folder_, other.folder_);
  std::swap(lock_, other.lock_);
  return *this;
}

}  // namespace slalom::io

#include "file_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "slalom/base/error.hpp"

namespace slalom::io {

FileLock::FileLock(const std::filesystem::path& file, Wait wait) : file_(file) {
  const auto fail = [&](const char* what) {
    const int reason = errno;
    if (descriptor_ >= 0) ::close(descriptor_);
    throw Error(fmt::format("{}: cannot be {} ({})", file.string(), what, std::strerror(reason)));
  };
  std::error_code error;
  const int flags = std::filesystem::is_directory(file, error) ? O_RDONLY | O_DIRECTORY
                                                               : O_RDWR | O_CREAT | O_NOFOLLOW;
  descriptor_ = ::open(file.c_str(), flags | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail("written");
  int code = 0;
  do code = ::flock(descriptor_, wait == Wait::yes ? LOCK_EX : LOCK_EX | LOCK_NB);
  while (code != 0 && errno == EINTR);
  held_ = code == 0;
  if (!held_ && errno != EWOULDBLOCK) fail("locked");
}

bool FileLock::stands() const {
  struct stat ours {
  }, there{};
  return ::fstat(descriptor_, &ours) == 0 && ::lstat(file_.c_str(), &there) == 0 &&
         ours.st_dev == there.st_dev && ours.st_ino == there.st_ino;
}

FileLock::~FileLock() {
  ::close(descriptor_);
}

}  // namespace slalom::io

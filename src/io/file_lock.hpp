#pragma once

#include <filesystem>

namespace slalom::io {

/// Keeps other processes out of something while it lives, also when this process is killed. What it
/// is held by stays: a file, which is made if need be, or a folder that is there.
class FileLock {
 public:
  enum class Wait { no, yes };  ///< for another process that holds it

  /// Throws Error when the file cannot be made or locked.
  FileLock(const std::filesystem::path& file, Wait wait);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

  /// False where another process holds it and was not waited for.
  bool held() const { return held_; }
  /// Whether what it is held by is still what stands at its path: who ends a lock may have removed
  /// it.
  bool stands() const;

 private:
  const std::filesystem::path file_;
  int descriptor_ = -1;
  bool held_ = false;
};

}  // namespace slalom::io

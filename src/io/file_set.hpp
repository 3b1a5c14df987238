#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace slalom::io {

/// Files that appear together or not at all: each is written aside in its own folder and flushed;
/// commit() renames them into place. What was not committed is removed.
class FileSet {
 public:
  FileSet() = default;
  FileSet(const FileSet&) = delete;
  FileSet& operator=(const FileSet&) = delete;
  ~FileSet();

  /// Writes `text` aside for `path`, making its folder if need be. Throws Error naming path and
  /// reason.
  void add(const std::filesystem::path& path, const std::string& text);
  /// The same for text that comes in parts, up to an empty one.
  void add(const std::filesystem::path& path, const std::function<std::string()>& next_part);
  /// Puts all files in place, in the order of add(). Throws Error when a name cannot be taken.
  void commit();

 private:
  struct Pending {
    std::filesystem::path aside, path;
  };
  std::vector<Pending> pending_;
  std::vector<std::filesystem::path> made_folders_;
};

}  // namespace slalom::io

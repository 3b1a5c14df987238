#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace slalom::io {

/// Files that appear together or not at all: each is written aside in its own folder, under a name
/// that nobody can foresee, and flushed; commit() renames them into place. What was not committed
/// is removed; what a killed process left aside is removed by the next to write in that folder.
class FileSet {
 public:
  FileSet();
  FileSet(const FileSet&) = delete;
  FileSet& operator=(const FileSet&) = delete;
  ~FileSet();

  /// Writes `text` aside for `path`, making its folder if need be. Throws Error naming path and
  /// reason.
  void add(const std::filesystem::path& path, const std::string& text);
  /// The same for text that comes in parts, up to an empty one.
  void add(const std::filesystem::path& path, const std::function<std::string()>& next_part);
  /// On commit, the results of one drive, plan or lap go that stand in the folder and are not in
  /// this set: they are of a run whose other results this set replaces.
  void replace_results(const std::filesystem::path& folder);
  /// Puts all files in place, in the order of add(). Throws Error when a name cannot be taken.
  void commit();

  /// 0 where a file can be written in a folder, which is there, or the errno of what stands in the
  /// way. It leaves nothing but what killed runs had left, which is gone.
  static int probe(const std::filesystem::path& folder);

 private:
  class Folder;
  struct Pending {
    std::filesystem::path aside, path;
  };

  /// 0 or the errno of what went wrong.
  int write_aside(const std::filesystem::path& path, const std::function<std::string()>& next_part);
  void remove_replaced() const;

  std::vector<Pending> pending_;
  std::map<std::filesystem::path, Folder> folders_;  ///< with a file aside
  std::vector<std::filesystem::path> made_folders_, replaced_;
};

}  // namespace slalom::io

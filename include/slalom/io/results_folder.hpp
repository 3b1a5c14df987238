#pragma once

#include <filesystem>
#include <memory>

namespace slalom::io {

class FileLock;

/// A folder for results that this process alone writes to while this lives.
class ResultsFolder {
 public:
  ResultsFolder();  ///< of no folder
  /// Makes the folder as prepare_folder() does, and throws as it does; and where another process
  /// writes its results there, `force` or not.
  ResultsFolder(const std::filesystem::path& folder, bool force);
  ~ResultsFolder();
  ResultsFolder(ResultsFolder&& other) noexcept;
  ResultsFolder& operator=(ResultsFolder&& other) noexcept;

 private:
  void release();

  std::filesystem::path folder_;
  std::unique_ptr<FileLock> lock_;
};

}  // namespace slalom::io

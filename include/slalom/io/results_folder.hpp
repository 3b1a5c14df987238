#pragma once

#include <filesystem>

namespace slalom::io {

/// A folder for results that this process alone writes to while this lives.
class ResultsFolder {
 public:
  ResultsFolder() = default;  ///< of no folder
  /// Makes the folder as prepare_folder() does, and throws as it does; and where another process
  /// writes its results there, `force` or not.
  ResultsFolder(const std::filesystem::path& folder, bool force);
  ~ResultsFolder();
  ResultsFolder(ResultsFolder&& other) noexcept;
  ResultsFolder& operator=(ResultsFolder&& other) noexcept;

 private:
  int descriptor_ = -1;
};

}  // namespace slalom::io

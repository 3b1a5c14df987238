#pragma once

#include <stdlib.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "slalom/base/error.hpp"

namespace slalom::test {

/// A folder of this process, in memory where there is such a place.
inline const std::filesystem::path& fuzz_folder() {
  static const std::filesystem::path folder = [] {
    std::error_code error;
    const auto parent = std::filesystem::is_directory("/dev/shm", error)
                            ? std::filesystem::path("/dev/shm")
                            : std::filesystem::temp_directory_path();
    std::string name = (parent / "slalom-fuzz-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) abort();
    return std::filesystem::path(name);
  }();
  static const int kept = std::atexit([] {
    std::error_code error;
    std::filesystem::remove_all(fuzz_folder(), error);
  });
  (void)kept;
  return folder;
}

/// The input as a file.
inline std::string fuzz_file(const std::string& input, const char* name = "input") {
  const auto file = fuzz_folder() / name;
  std::ofstream(file, std::ios::binary) << input;
  return file.string();
}

/// Lets `read` have an input. It may refuse it by an Error; anything else ends the fuzzer.
template <class F>
int fuzz(const std::uint8_t* data, std::size_t size, const F& read) {
  try {
    read(std::string(reinterpret_cast<const char*>(data), size));
  } catch (const Error&) {
  }
  return 0;
}

}  // namespace slalom::test

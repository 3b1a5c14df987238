#pragma once

#include <filesystem>
#include <string>

namespace slalom::io {

/// The bytes of a regular file. Throws InvalidValue naming the file when it is missing, a folder,
/// not a regular file, unreadable or longer than `max_bytes`; `content` is what was expected.
std::string read_file(const std::filesystem::path& file, std::size_t max_bytes,
                      const std::string& content);

/// Throws InvalidValue with line and column unless `text` is printable UTF-8.
void check_text(const std::string& text, const std::string& source, const std::string& content);

}  // namespace slalom::io

#include "text_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "slalom/base/error.hpp"

namespace slalom::io {
namespace {

/// Length of the well-formed UTF-8 sequence at `at`, or 0. Overlong forms and surrogates are not
/// well-formed.
std::size_t utf8_length(const std::string& text, std::size_t at) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
  };
  const auto continues = [&](std::size_t from, std::size_t count) {
    for (std::size_t i = from; i < from + count; ++i)
      if ((byte(i) & 0xC0U) != 0x80U) return false;
    return true;
  };
  const unsigned lead = byte(at), next = byte(at + 1);
  if (lead < 0x80U) return 1;
  if (lead >= 0xC2U && lead <= 0xDFU) return continues(at + 1, 1) ? 2 : 0;
  if (lead >= 0xE0U && lead <= 0xEFU) {
    if ((lead == 0xE0U && next < 0xA0U) || (lead == 0xEDU && next > 0x9FU)) return 0;
    return continues(at + 1, 2) ? 3 : 0;
  }
  if (lead >= 0xF0U && lead <= 0xF4U) {
    if ((lead == 0xF0U && next < 0x90U) || (lead == 0xF4U && next > 0x8FU)) return 0;
    return continues(at + 1, 3) ? 4 : 0;
  }
  return 0;
}

bool is_control(unsigned char byte) {
  return byte < 0x20 && byte != '\n' && byte != '\r' && byte != '\t';
}

}  // namespace

std::string read_file(const std::filesystem::path& file, std::size_t max_bytes,
                      const std::string& content) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  const auto where = file.string();
  if (status.type() == std::filesystem::file_type::not_found)
    throw InvalidValue(where, "no such file", content);
  if (status.type() == std::filesystem::file_type::none)
    throw InvalidValue(where, fmt::format("an unreadable path ({})", error.message()), content);
  if (status.type() == std::filesystem::file_type::directory)
    throw InvalidValue(where, "a folder", content);
  // A pipe or device could block or never end.
  if (status.type() != std::filesystem::file_type::regular)
    throw InvalidValue(where, "something that is not a regular file", content);

  std::ifstream stream(file, std::ios::binary);
  if (!stream)
    throw InvalidValue(where, fmt::format("an unreadable file ({})", std::strerror(errno)),
                       content);
  // One byte more than it has: a file that is growing still ends at the limit.
  const auto size = std::filesystem::file_size(file, error);
  std::string text(error || size > max_bytes ? max_bytes + 1 : size + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (stream.bad()) throw InvalidValue(where, "an unreadable file (read error)", content);
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.size() > max_bytes)
    throw InvalidValue(where, fmt::format("a file of more than {} bytes", max_bytes), content);
  return text;
}

void check_text(const std::string& text, const std::string& source, const std::string& content) {
  int line = 1, column = 1;
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const std::size_t length = is_control(byte) ? 0 : utf8_length(text, i);
    if (length == 0)
      throw InvalidValue(fmt::format("{}:{}:{}", source, line, column),
                         fmt::format("binary data (byte 0x{:02x})", byte),
                         content + " in UTF-8 text");
    i += length;
    ++column;
    if (byte == '\n') {
      ++line;
      column = 1;
    }
  }
}

}  // namespace slalom::io

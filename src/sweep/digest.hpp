#pragma once

#include <string>
#include <string_view>

namespace slalom::sweep {

/// The 128-bit FNV-1a hash of some text as 32 hexadecimal digits: tells configurations apart, and
/// is no protection against forgery. Parts are hashed with their lengths, so that ("ab", "c") and
/// ("a", "bc") differ.
class Digest {
 public:
  Digest& add(std::string_view part);
  std::string hex() const;

 private:
  void byte(unsigned char value);

  __extension__ using Word = unsigned __int128;
  Word state_ = (Word{0x6c62272e07bb0142U} << 64U) | Word{0x62b821756295c58dU};
};

}  // namespace slalom::sweep

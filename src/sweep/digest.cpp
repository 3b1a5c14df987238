#include "digest.hpp"

#include <fmt/format.h>

#include <cstdint>

namespace slalom::sweep {

void Digest::byte(unsigned char value) {
  // http://www.isthe.com/chongo/tech/comp/fnv: prime 2^88 + 2^8 + 0x3b.
  constexpr Word kPrime = (Word{1} << 88U) + 0x13bU;
  state_ = (state_ ^ value) * kPrime;
}

Digest& Digest::add(std::string_view part) {
  for (std::uint64_t size = part.size(), i = 0; i < 8; ++i, size >>= 8U)
    byte(static_cast<unsigned char>(size & 0xffU));
  for (const char c : part) byte(static_cast<unsigned char>(c));
  return *this;
}

std::string Digest::hex() const {
  return fmt::format("{:016x}{:016x}", static_cast<std::uint64_t>(state_ >> 64U),
                     static_cast<std::uint64_t>(state_));
}

}  // namespace slalom::sweep

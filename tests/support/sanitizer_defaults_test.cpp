// The address sanitizer's defaults are the program's own, so that ASAN_OPTIONS are left to users.

#include <gtest/gtest.h>

#include <string>

// NOLINTNEXTLINE(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)
extern "C" __attribute__((weak)) const char* __asan_default_options();

namespace slalom {
namespace {

TEST(SanitizerDefaults, AreLinkedToPrograms) {
#ifdef __SANITIZE_ADDRESS__
  EXPECT_EQ(std::string(__asan_default_options()), "intercept_tls_get_addr=0");
#else
  EXPECT_TRUE(__asan_default_options == nullptr);
#endif
}

}  // namespace
}  // namespace slalom

// Linked to programs that the address sanitizer watches.

/// The sanitizer asks for it as the program starts; ASAN_OPTIONS add to it, and win. GCC 12's leak
/// sanitizer takes rubbish for a library's thread-local blocks ("Tracer caught signal 11", as
/// memory happens to lie) unless it is told not to follow them.
// NOLINTNEXTLINE(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)
extern "C" const char* __asan_default_options() {
  return "intercept_tls_get_addr=0";
}

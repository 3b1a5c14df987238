#include "support/allocation_count.hpp"

#include "support/sanitized.hpp"

#ifdef SLALOM_SANITIZED

namespace slalom {
bool AllocationCount::available() {
  return false;
}
AllocationCount::AllocationCount() = default;
AllocationCount::~AllocationCount() = default;
std::size_t AllocationCount::allocations() const {
  return 0;
}
std::string AllocationCount::first() {
  return "";
}
}  // namespace slalom

#else

#include <dlfcn.h>
#include <execinfo.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>

// glibc's own allocator, behind the names that a program may define anew (glibc manual, "Replacing
// malloc").
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* p, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void __libc_free(void* p);
}

namespace {

constexpr int kMostCalls = 24;

/// Of one thread; plain numbers, for what stands here must not allocate.
struct Watch {
  bool counting;
  std::size_t count;
  int calls;
  void* call[kMostCalls];
};
thread_local Watch watch{};

void note() {
  if (!watch.counting) return;
  if (watch.count++ > 0) return;
  watch.counting = false;  // backtrace may allocate
  watch.calls = backtrace(watch.call, kMostCalls);
  watch.counting = true;
}

}  // namespace

extern "C" {
void* malloc(std::size_t size) noexcept {
  note();
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) noexcept {
  note();
  return __libc_calloc(count, size);
}
void* realloc(void* p, std::size_t size) noexcept {
  note();
  return __libc_realloc(p, size);
}
void* memalign(std::size_t alignment, std::size_t size) noexcept {
  note();
  return __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  note();
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** p, std::size_t alignment, std::size_t size) noexcept {
  note();
  if (alignment % sizeof(void*) != 0 || (alignment & (alignment - 1)) != 0 || alignment == 0)
    return EINVAL;
  void* result = __libc_memalign(alignment, size);
  if (result == nullptr) return ENOMEM;
  *p = result;
  return 0;
}
void free(void* p) noexcept {
  __libc_free(p);
}
}

namespace slalom {

bool AllocationCount::available() {
  return true;
}

AllocationCount::AllocationCount() {
  void* call[1];
  backtrace(call, 1);  // loads what it needs the first time
  watch = {};
  watch.counting = true;
}
AllocationCount::~AllocationCount() {
  watch.counting = false;
}

std::size_t AllocationCount::allocations() const {
  return watch.count;
}

std::string AllocationCount::first() {
  watch.counting = false;
  std::string text;
  for (int i = 2; i < watch.calls; ++i) {  // behind note and the allocator itself
    Dl_info info{};
    if (dladdr(watch.call[i], &info) == 0) continue;
    char line[64];
    const auto offset = reinterpret_cast<std::uintptr_t>(watch.call[i]) -
                        reinterpret_cast<std::uintptr_t>(info.dli_fbase);
    std::snprintf(line, sizeof line, "(+0x%zx) ", static_cast<std::size_t>(offset));
    text += info.dli_fname;
    text += line;
    text += info.dli_sname != nullptr ? info.dli_sname : "";
    text += '\n';
  }
  return text;
}

}  // namespace slalom

#endif

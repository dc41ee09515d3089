#include "scantet/base/large_pages.h"

#include <sys/mman.h>

#include <cstdlib>

namespace scantet {
namespace {

constexpr std::size_t kPage = std::size_t{1} << 21;

}  // namespace

void* allocate_on_large_pages(std::size_t bytes) {
  constexpr std::size_t kCacheLine = 64;
  const std::size_t alignment = bytes >= kPage ? kPage : kCacheLine;
  void* const memory = std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
  if (memory == nullptr) throw std::bad_alloc();
  if (bytes >= kPage) madvise(memory, bytes, MADV_HUGEPAGE);  // only advice: a refusal changes nothing
  return memory;
}

void populate_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes,
                    [[maybe_unused]] const std::atomic<bool>& enough) {
#ifdef MADV_POPULATE_WRITE
  for (std::size_t at = 0; at + kPage <= bytes && !enough; at += kPage) {
    // Only advice: systems before Linux 5.14 refuse.
    if (madvise(static_cast<char*>(memory) + at, kPage, MADV_POPULATE_WRITE) != 0) return;
  }
#endif
}

void free_large_pages(void* memory) {
  std::free(memory);
}

}  // namespace scantet

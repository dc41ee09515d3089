#include "scantet/base/large_pages.h"

#include <sys/mman.h>

#include <cstdlib>

namespace scantet {
namespace {

constexpr std::size_t kPage = std::size_t{1} << 21;
constexpr std::size_t kWorthAPage = kPage / 4;  // bytes: clearing a large page takes less than so many small ones

}  // namespace

void* allocate_on_large_pages(std::size_t bytes) {
  constexpr std::size_t kCacheLine = 64;
  const std::size_t alignment = bytes >= kWorthAPage ? kPage : kCacheLine;
  const std::size_t whole = (bytes + alignment - 1) / alignment * alignment;
  void* const memory = std::aligned_alloc(alignment, whole);  // NOLINT(cppcoreguidelines-owning-memory): an allocator
  if (memory == nullptr) throw std::bad_alloc();
  if (bytes >= kWorthAPage) madvise(memory, whole, MADV_HUGEPAGE);  // only advice: a refusal changes nothing
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
  std::free(memory);  // NOLINT(cppcoreguidelines-owning-memory): an allocator
}

}  // namespace scantet

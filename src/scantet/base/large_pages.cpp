#include "scantet/base/large_pages.h"

#include <sys/mman.h>

#include <cstdlib>

namespace scantet {

void* allocate_on_large_pages(std::size_t bytes) {
  constexpr std::size_t kPage = std::size_t{1} << 21;
  constexpr std::size_t kCacheLine = 64;
  const std::size_t alignment = bytes >= kPage ? kPage : kCacheLine;
  void* const memory = std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
  if (memory == nullptr) throw std::bad_alloc();
  if (bytes >= kPage) madvise(memory, bytes, MADV_HUGEPAGE);  // only advice: a refusal changes nothing
  return memory;
}

void free_large_pages(void* memory) {
  std::free(memory);
}

}  // namespace scantet

// Memory for large arrays that are read here and there.
#pragma once

#include <atomic>
#include <cstddef>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace scantet {

/// Memory that begins at the start of a cache line at least. Throws std::bad_alloc.
void* allocate_on_large_pages(std::size_t bytes);
void free_large_pages(void* memory);
/// Has the system give the pages now, one after the other, until `enough` is true; otherwise each would be given when
/// it is first written. Their contents stay. memory: from allocate_on_large_pages(); if it is given back meanwhile,
/// that does no harm.
void populate_pages(void* memory, std::size_t bytes, const std::atomic<bool>& enough);

/// Asks the system for large pages under large arrays: with small pages, a read out of order spends most of its time on
/// finding the page. Where the system has no large pages the array is like any other.
template <class T>
struct LargePages {
  using value_type = T;
  LargePages() = default;
  template <class U>
  LargePages(const LargePages<U>&) {}  // NOLINT(google-explicit-constructor): as the standard asks of allocators

  T* allocate(std::size_t count) { return static_cast<T*>(allocate_on_large_pages(count * sizeof(T))); }
  void deallocate(T* memory, std::size_t) { free_large_pages(memory); }
  /// resize() does not initialise new elements: the thread that fills them writes them. So the default values of
  /// members do not hold.
  template <class U>
  void construct(U*) noexcept {
    static_assert(std::is_trivially_copyable_v<U> && std::is_trivially_destructible_v<U>);
  }
  template <class U, class... Arguments>
  void construct(U* element, Arguments&&... arguments) {
    ::new (static_cast<void*>(element)) U(std::forward<Arguments>(arguments)...);
  }
  friend bool operator==(const LargePages&, const LargePages&) { return true; }
};

/// Where all threads wait for an array to grow: for how many times the elements that are known it has room. Memory that
/// is not written costs nothing; to grow is to copy all to new pages.
inline constexpr std::size_t kRoomAhead = 3;

template <class T>
using LargeVector = std::vector<T, LargePages<T>>;

}  // namespace scantet

// A vector whose numbers are not set before they are written, in large pages where it is large.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace contact::component {

/// Asks for pages of 2 MiB in some memory, where the system has such. A wish, which may go unheard.
inline void ask_for_large_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) {
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  constexpr std::size_t kPage = std::size_t{1} << 21;
  const auto address = reinterpret_cast<std::uintptr_t>(memory);
  const std::size_t before = (kPage - address % kPage) % kPage;
  if (bytes < before + kPage) return;
  ::madvise(static_cast<std::byte*>(memory) + before, (bytes - before) / kPage * kPage, MADV_HUGEPAGE);
#endif
}

/// Memory of a large vector is taken in pages of 2 MiB where the system has such: the first touch of a page takes
/// longer than all that is done with the numbers in it. The vector's elements are made by T's default constructor,
/// which sets nothing where T is made of numbers.
template <class T>
struct LargePages {
  using value_type = T;
  LargePages() = default;
  template <class U>
  explicit LargePages(const LargePages<U>&) {}

  [[nodiscard]] T* allocate(std::size_t n) {
    const std::size_t bytes = n * sizeof(T);
    const std::align_val_t align = alignment(bytes);
    void* memory = ::operator new(bytes, align);
    ask_for_large_pages(memory, bytes);
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t n) { ::operator delete(memory, alignment(n * sizeof(T))); }

  template <class U, class... Given>
  void construct(U* at, Given&&... given) {
    if constexpr (sizeof...(Given) == 0)
      ::new (static_cast<void*>(at)) U;
    else
      ::new (static_cast<void*>(at)) U(std::forward<Given>(given)...);
  }
  friend bool operator==(const LargePages&, const LargePages&) { return true; }

 private:
  static constexpr std::align_val_t kPage{std::size_t{1} << 21};
  static std::align_val_t alignment(std::size_t bytes) {
    if (bytes >= static_cast<std::size_t>(kPage)) return kPage;
    return std::align_val_t{alignof(T) > 64 ? alignof(T) : 64};
  }
};

template <class T>
using LargeVector = std::vector<T, LargePages<T>>;

}  // namespace contact::component

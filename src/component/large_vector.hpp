// A vector whose numbers are not set before they are written, in large pages where it is large.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace contact::component {

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
#if defined(__linux__) && defined(MADV_HUGEPAGE)
    if (align == kPage) ::madvise(memory, bytes, MADV_HUGEPAGE);  // a wish, which may go unheard
#endif
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

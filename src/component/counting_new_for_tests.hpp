// What a program takes from the heap: this test's operator new counts.
#pragma once

#include <cstddef>

namespace contact::component {

/// All that operator new has given so far.
[[nodiscard]] std::size_t bytes_allocated();

}  // namespace contact::component

// The batch functions of two shapes of any kind: for code that knows no pair by name.
#pragma once

#include "contact/batch.hpp"
#include "contact/shapes.hpp"

namespace contact::inline CONTACT_ABI::batch {

/// The columns of n shapes: their spans in the order of the shape's numbers, and nothing else.
template <class Shape>
struct ColumnsFor;
#define CONTACT_COLUMNS(Shape)   \
  template <>                    \
  struct ColumnsFor<Shape> {     \
    using Type = Shape##Columns; \
  };
CONTACT_COLUMNS(Ball)
CONTACT_COLUMNS(Box)
CONTACT_COLUMNS(Capsule)
CONTACT_COLUMNS(Triangle)
CONTACT_COLUMNS(Plane)
CONTACT_COLUMNS(Ray)
CONTACT_COLUMNS(Line)
#undef CONTACT_COLUMNS
template <class Shape>
using ColumnsOf = typename ColumnsFor<Shape>::Type;

// test, compute and compute_hits are test_sphere_sphere, compute_sphere_sphere, compute_sphere_sphere_hits and so on.
#define CONTACT_TEST(name, A, B)                                                                           \
  inline Count test(const A##Columns& a, const B##Columns& b, double alarm, std::span<std::uint8_t> hit) { \
    return test_##name(a, b, alarm, hit);                                                                  \
  }
#define CONTACT_COMPUTE(name, A, B)                                                                                 \
  inline Count compute(const A##Columns& a, const B##Columns& b, Distances distances, const ContactColumns& out,    \
                       ContactPoints points = {}) {                                                                 \
    return compute_##name(a, b, distances, out, points);                                                            \
  }                                                                                                                 \
  inline Count compute_hits(const A##Columns& a, const B##Columns& b, Distances distances,                          \
                            std::span<std::uint32_t> index, const ContactColumns& out, ContactPoints points = {}) { \
    return compute_##name##_hits(a, b, distances, index, out, points);                                              \
  }
CONTACT_BATCH_PAIRS(CONTACT_TEST)
CONTACT_BATCH_CONTACTS(CONTACT_COMPUTE)
#undef CONTACT_TEST
#undef CONTACT_COMPUTE

/// Whether two shapes have these functions, and whether their contacts do.
template <class A, class B>
concept Decides = requires(const ColumnsOf<A>& a, const ColumnsOf<B>& b, std::span<std::uint8_t> hit) {
  test(a, b, 0.0, hit);
};
template <class A, class B>
concept Computes = requires(const ColumnsOf<A>& a, const ColumnsOf<B>& b, const ContactColumns& out) {
  compute(a, b, Distances{}, out);
};

}  // namespace contact::inline CONTACT_ABI::batch

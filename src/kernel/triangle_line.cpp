// Triangle against line: three points that a segment crosses.
#include "contact/triangle_line.hpp"

#include "contact/pair_functions.hpp"
#include "kernel/cores_stages.hpp"
#include "kernel/crossing_cores.hpp"

namespace contact::inline CONTACT_ABI {
namespace {

kernel::Segment segment_of(const Line& line) { return {line.start, line.end}; }

}  // namespace

bool out_of_line::test_triangle_line(const Triangle& a, const Line& b) {
  return kernel::decide(kernel::Corners{a.vertices}, segment_of(b), {0, 0, 0, 0});
}

std::optional<Contact> out_of_line::compute_triangle_line(const Triangle& a, const Line& b) {
  return kernel::contact_between(kernel::Corners{a.vertices}, segment_of(b), {0, 0, 0, 0}, {});
}

std::optional<Contact> of_hit::compute_triangle_line(const Triangle& a, const Line& b) {
  return kernel::contact_of_hit(a, b, 0, {}, [&] { return out_of_line::compute_triangle_line(a, b); });
}

bool test_triangle_line(const Triangle& a, const Line& b) { return out_of_line::test_triangle_line(a, b); }
std::optional<Contact> compute_triangle_line(const Triangle& a, const Line& b) {
  return out_of_line::compute_triangle_line(a, b);
}

bool is_hit(const TriangleAndLine& shapes, Distances /*distances*/) { return test_triangle_line(shapes.a, shapes.b); }
std::optional<Contact> contact_of(const TriangleAndLine& shapes, Distances /*distances*/, ContactPoints /*points*/) {
  return compute_triangle_line(shapes.a, shapes.b);
}

}  // namespace contact::inline CONTACT_ABI

// Capsule against capsule: two segments.
#include "contact/capsule_capsule.hpp"

#include "contact/pair_functions.hpp"
#include "kernel/cores_stages.hpp"
#include "kernel/segment_cores.hpp"

namespace contact::inline CONTACT_ABI {

bool out_of_line::test_capsule_capsule(const Capsule& a, const Capsule& b, double alarm) {
  return kernel::decide(kernel::Segment{a.start, a.end}, kernel::Segment{b.start, b.end},
                        {a.radius, b.radius, alarm, 0});
}

std::optional<Contact> out_of_line::compute_capsule_capsule(const Capsule& a, const Capsule& b, Distances distances,
                                                            ContactPoints points) {
  return kernel::contact_between(kernel::Segment{a.start, a.end}, kernel::Segment{b.start, b.end},
                                 {a.radius, b.radius, distances.alarm, distances.contact}, points);
}

bool test_capsule_capsule(const Capsule& a, const Capsule& b, double alarm) {
  return out_of_line::test_capsule_capsule(a, b, alarm);
}
std::optional<Contact> compute_capsule_capsule(const Capsule& a, const Capsule& b, Distances distances,
                                               ContactPoints points) {
  return out_of_line::compute_capsule_capsule(a, b, distances, points);
}

bool is_hit(const Capsules& shapes, Distances distances) {
  return test_capsule_capsule(shapes.a, shapes.b, distances.alarm);
}
std::optional<Contact> contact_of(const Capsules& shapes, Distances distances, ContactPoints points) {
  return compute_capsule_capsule(shapes.a, shapes.b, distances, points);
}

}  // namespace contact::inline CONTACT_ABI

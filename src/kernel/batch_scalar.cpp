// Many pairs, one after the other: the specification of the vector kernels.
#include <optional>

#include "contact/pair_functions.hpp"
#include "kernel/batch.hpp"
#include "kernel/batch_pairs.hpp"
#include "kernel/sphere_sphere_numbers.hpp"

namespace contact::kernel {

void round_numbers(const SpherePairs& pairs, const ContactQuestion& question, std::size_t i, unsigned numbers,
                   const ContactRows& out) {
  Contact contact{};
  round_numbers(pairs.first(i), pairs.second(i), question.distances.contact, question.points, numbers, contact);
  for (std::size_t k = 0; k < ContactRows::kNumbers; ++k)
    if ((numbers >> k & 1) != 0) out.number[k][i] = batch::number_of(contact, k);
}

template <class A, class B>
void contact_of_one_pair(const PairColumns<A, B>& pairs, const ContactQuestion& question, std::size_t i,
                         const ContactRows& out, std::size_t row) {
  auto contact = contact_of(Two<A, B>{pairs.first(i), pairs.second(i)}, question.distances, question.points);
  for (std::size_t k = 0; k < ContactRows::kNumbers; ++k)
    out.number[k][row] = contact ? batch::number_of(*contact, k) : 0.0;
  out.state[row] = contact ? batch::state_of(*contact) : batch::PairState::miss;
}

template <class A, class B>
batch::Count test_scalar(const PairColumns<A, B>& pairs, double alarm, std::uint8_t* hit) {
  batch::Count count{0, pairs.size};
  for (std::size_t i = 0; i < pairs.size; ++i) {
    hit[i] = is_hit(Two<A, B>{pairs.first(i), pairs.second(i)}, {alarm, 0}) ? 1 : 0;
    count.hits += hit[i];
  }
  return count;
}

template <class A, class B>
batch::Count compute_scalar(const PairColumns<A, B>& pairs, const ContactQuestion& question, const ContactRows& out) {
  batch::Count count{0, pairs.size};
  for (std::size_t i = 0; i < pairs.size; ++i) {
    contact_of_one_pair(pairs, question, i, out, i);
    count.hits += out.state[i] != batch::PairState::miss ? 1U : 0U;
  }
  return count;
}

template <class A, class B>
batch::Count compute_hits_scalar(const PairColumns<A, B>& pairs, const ContactQuestion& question, std::uint32_t* index,
                                 const ContactRows& out) {
  batch::Count count{0, pairs.size};
  for (std::size_t i = 0; i < pairs.size; ++i) {
    contact_of_one_pair(pairs, question, i, out, count.hits);
    if (out.state[count.hits] != batch::PairState::miss) index[count.hits++] = static_cast<std::uint32_t>(i);
  }
  return count;
}

#define CONTACT_TEST(name, A, B) template batch::Count test_scalar(const PairColumns<A, B>&, double, std::uint8_t*);
#define CONTACT_COMPUTE(name, A, B)                                                                                    \
  template void contact_of_one_pair(const PairColumns<A, B>&, const ContactQuestion&, std::size_t, const ContactRows&, \
                                    std::size_t);                                                                      \
  template batch::Count compute_scalar(const PairColumns<A, B>&, const ContactQuestion&, const ContactRows&);          \
  template batch::Count compute_hits_scalar(const PairColumns<A, B>&, const ContactQuestion&, std::uint32_t*,          \
                                            const ContactRows&);
CONTACT_BATCH_PAIRS(CONTACT_TEST)
CONTACT_BATCH_CONTACTS(CONTACT_COMPUTE)
#undef CONTACT_TEST
#undef CONTACT_COMPUTE

}  // namespace contact::kernel

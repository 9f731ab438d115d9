// An engine as an adapter sees it: a declaration and one function a question; adapter.cpp makes a contact_engine.h
// library of them. C++17, since some engines' headers are no C++20. An adapter asks its engine as any user would, and
// mends nothing of what it says.
#pragma once

#include <string>

#include "engines/protocol/contact_engine.h"

namespace contact::adapters {

/// One question: two spheres (centre and radius), two boxes (min and max), or a sphere and a box.
struct Question {
  contact_pair pair;
  const double* a;
  const double* b;
  double alarm;
};

/// A box as most engines take it. Nothing is rounded: a declaration with the shapes `centered` keeps away the boxes
/// whose centre or size is no number.
struct CenteredBox {
  explicit CenteredBox(const double* x) {
    for (int i = 0; i < 3; ++i) {
      size[i] = x[3 + i] - x[i];
      half[i] = size[i] / 2;
      center[i] = x[i] + half[i];
    }
  }
  double center[3];
  double size[3];
  double half[3];
};

/// What is said of one question; of a hit, all that the declaration claims.
class Answer {
 public:
  Answer(const contact_answers& all, std::size_t i)
      : said_(all.said + i),
        normal_(all.normal + 3 * i),
        point1_(all.point1 + 3 * i),
        point2_(all.point2 + 3 * i),
        value_(all.value + i) {}

  void overlap(bool yes) { say(CONTACT_SAYS_OVERLAP | (yes ? CONTACT_OVERLAPS : 0)); }
  void contact(bool yes) { say(CONTACT_SAYS_CONTACT | (yes ? CONTACT_TOUCHES : 0)); }
  /// Both: for engines whose overlap test is that they find a contact.
  void hit(bool yes) {
    overlap(yes);
    contact(yes);
  }
  template <class Vector>
  void normal(const Vector& v) {
    vector(CONTACT_NORMAL, normal_, v);
  }
  template <class Vector>
  void point1(const Vector& v) {
    vector(CONTACT_POINT1, point1_, v);
  }
  template <class Vector>
  void point2(const Vector& v) {
    vector(CONTACT_POINT2, point2_, v);
  }
  template <class Vector>
  void midpoint(const Vector& v) {
    vector(CONTACT_MIDPOINT, point1_, v);
  }
  void value(double v) {
    say(CONTACT_VALUE);
    *value_ = v;
  }
  /// Instead of an answer: the engine refuses such a shape.
  void unsupported() { say(CONTACT_UNSUPPORTED); }

 private:
  void say(int what) { *said_ |= static_cast<std::uint32_t>(what); }
  template <class Vector>
  void vector(int what, double* to, const Vector& v) {
    say(what);
    for (int i = 0; i < 3; ++i) to[i] = static_cast<double>(v[i]);
  }

  std::uint32_t* said_;
  double* normal_;
  double* point1_;
  double* point2_;
  double* value_;
};

// Each adapter defines these two.

/// The engine's declaration, contact_engine_declaration().
[[nodiscard]] std::string declaration();
/// What the engine says. An exception becomes the error of this question.
void answer(const Question& question, Answer& said);

}  // namespace contact::adapters

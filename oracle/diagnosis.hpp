// Why answers are wrong: the conventions under which they would be right, and the mistakes that explain them.
#pragma once

#include <bitset>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "oracle/hypotheses.hpp"
#include "oracle/judge.hpp"

namespace contact::oracle {

/// What is wrong as declared but right under another convention, such as {"point1", "points", "published"}.
struct Explanation {
  std::string field;
  std::string convention;
  std::string value;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(field, convention, value);
  }
  // NOLINTNEXTLINE(modernize-use-nullptr): the 0 is in what the compiler makes
  friend auto operator<=>(const Explanation&, const Explanation&) = default;
};

/// The conventions under which a wrong field of this answer would have been right.
[[nodiscard]] std::vector<Explanation> explain_wrong(const Query& query, const Truth& truth, const Claim& claim,
                                                     const Declaration& declared, const Verdict& verdict,
                                                     const Expectation* rounded = nullptr);

/// One thing that an answer claims.
enum class Aspect { overlap, contact, normal, point1, point2, point, value };
inline constexpr std::array<std::string_view, 7> kAspectNames{"overlap", "contact", "normal", "point1",
                                                              "point2",  "point",   "value"};

/// A mistake that explains wrong answers of a run.
struct Finding {
  std::string cause;     ///< its id; empty for what no known mistake explains
  std::string sentence;  ///< what is wrong, in words, where it is, and how much it explains
  std::uint64_t explained;
};

/// The sentence of a cause, by the id that findings have. Throws std::out_of_range where there is none.
[[nodiscard]] std::string_view sentence_of(std::string_view cause);

/// Holds every known mistake against everything that an engine said. A mistake explains a wrong claim where its formula
/// gives what was claimed, and is contradicted by a right claim where it gives something else. Memory is bounded: of
/// more than kSample wrong claims, those to the questions with the smallest keys speak for the others of their aspect.
/// What is found does not depend on the order of the answers, nor on how they were divided before `merge`.
class Diagnosis {
 public:
  static constexpr std::size_t kSample = 16384;

  /// What was said to a question inside the domain, right or wrong. What is right in it speaks `weight`-fold against
  /// the mistakes that say otherwise, for so many answers like it; an answer of weight 0 must be right. `key` is the
  /// question's own: 64 bits of a digest of it.
  void add(std::uint64_t key, const Query& query, const Truth& truth, const Claim& claim, const Declaration& declared,
           const Verdict& verdict, const Expectation* rounded = nullptr, std::uint64_t weight = 1);
  /// An answer to a question outside the domain.
  void add_outside_domain(const Query& query);
  void merge(const Diagnosis& other);

  /// How many claims of each kind ("overlap", "normal", ...) are wrong.
  [[nodiscard]] const std::map<std::string, std::uint64_t>& wrong() const { return wrong_; }
  /// The fewest mistakes that explain the most, the one that explains the most first.
  [[nodiscard]] std::vector<Finding> findings() const;
  /// Findings, then the conventions under which wrong answers would be right: a sentence each.
  [[nodiscard]] std::vector<std::string> lines() const;

  /// All that was counted, for an archive of Cereal's.
  template <class Archive>
  void serialize(Archive& archive) {
    archive(explanations_, wrong_, sample_, contradicted_, answered_, silent_, outside_);
  }
  /// Whether it could have been counted: what an archive holds may name what there is not.
  [[nodiscard]] bool is_sound() const;

 private:
  static constexpr std::size_t kMostCauses = 256;
  using Set = std::bitset<kMostCauses>;
  /// Where claims are counted apart: a mistake may be made in some places only.
  struct Place {
    Aspect aspect;
    Pair pair;
    Region region;

    template <class Archive>
    void serialize(Archive& archive) {
      archive(aspect, pair, region);
    }
    [[nodiscard]] bool is_sound() const;
    // NOLINTNEXTLINE(modernize-use-nullptr): the 0 is in what the compiler makes
    friend auto operator<=>(const Place&, const Place&) = default;
  };
  struct Wrong {
    std::uint64_t key;  ///< of its question
    Place place;
    Set by;  ///< the mistakes that explain it

    template <class Archive>
    void serialize(Archive& archive) {
      archive(key, place, by);
    }
    friend bool operator<(const Wrong& x, const Wrong& y) {
      if (x.key != y.key) return x.key < y.key;
      if (x.place != y.place) return x.place < y.place;
      return x.by.to_string() < y.by.to_string();
    }
  };
  /// Wrong claims of a place that the same mistakes explain, and how many: estimated where only a sample is kept.
  struct Alike {
    Place place;
    Set by;
    double n;
  };
  class Gain;

  void count(std::uint64_t key, const Place& place, bool is_right, const Set& agree, const Set& differ,
             std::uint64_t weight);
  void add_wrong(const Wrong& wrong, std::uint64_t n);
  [[nodiscard]] std::vector<Alike> alike() const;
  [[nodiscard]] bool is_sampled() const;

  std::map<Explanation, std::uint64_t> explanations_;
  std::map<std::string, std::uint64_t> wrong_;
  std::map<Wrong, std::uint64_t> sample_;                     ///< wrong claims, the smallest keys
  std::map<Place, std::vector<std::uint64_t>> contradicted_;  ///< right claims, by mistake
  std::map<Pair, std::uint64_t> answered_;
  std::map<Pair, std::uint64_t> silent_;                       ///< questions without an answer
  std::map<std::string, std::uint64_t, std::less<>> outside_;  ///< answers outside the domain, by what is wrong there
};

}  // namespace contact::oracle

// Why answers are wrong: the conventions under which they would be right, and the causes that explain them.
#pragma once

#include <bitset>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "oracle/diagnosis/cover.hpp"
#include "oracle/diagnosis/hypotheses.hpp"
#include "oracle/judge/judge.hpp"

namespace contact::oracle {

/// A field that is wrong as declared and right under another convention, such as {"point1", "points", "published"}.
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

/// The conventions under which wrong fields of this answer would be right.
[[nodiscard]] std::vector<Explanation> explain_wrong(const Query& query, const Truth& truth, const Claim& claim,
                                                     const Declaration& declared, const Verdict& verdict,
                                                     const Expectation* rounded = nullptr);

/// A cause that explains wrong answers of a run.
struct Finding {
  std::string cause;     ///< its id; empty for wrong claims that no cause explains
  std::string sentence;  ///< what is wrong, where, and how much that explains
  std::uint64_t explained;
};

/// The sentence of a cause, by the id that a finding has. Throws std::out_of_range where there is none.
[[nodiscard]] std::string_view sentence_of(std::string_view cause);

/// Compares every cause with all claims of an engine. A cause explains a wrong claim if its formula gives that claim. A
/// right claim contradicts a cause whose formula gives another. Memory is bounded: a sample of kSample wrong claims,
/// those with the smallest keys, stands for all others of their aspect. The findings depend neither on the order of the
/// answers nor on how they were divided before `merge`.
///
/// What the causes say of an answer costs more than to judge it, and of right answers alone it tells nothing. So up to
/// kPostponed of them are kept as they are until something is wrong.
class Diagnosis {
 public:
  static constexpr std::size_t kSample = 16384;
  static constexpr std::size_t kPostponed = 32768;

  /// Adds the answer to a question inside the domain. Its right claims count `weight` times, for so many answers like
  /// it; an answer of weight 0 must be right. `key` is 64 bits of a digest of the question.
  void add(std::uint64_t key, const Query& query, const Truth& truth, const Claim& claim, const Declaration& declared,
           const Verdict& verdict, const Expectation* rounded = nullptr, std::uint64_t weight = 1);
  /// Adds an answer to a question outside the domain.
  void add_outside_domain(const Query& query);
  void merge(const Diagnosis& other);
  /// Whether another right answer would be compared with the causes, so that whoever shares the work does that at once.
  [[nodiscard]] bool compares_at_once() const { return at_once_ || !wrong_.empty() || postponed_.size() >= kPostponed; }
  /// From now on every answer is compared as it comes.
  void compare_at_once() {
    at_once_ = true;
    settle();
  }

  /// How many claims of each kind ("overlap", "normal", ...) are wrong.
  [[nodiscard]] const std::map<std::string, std::uint64_t>& wrong() const { return wrong_; }
  /// How many answers to hits lack a field that the engine declares.
  [[nodiscard]] std::uint64_t missing(const std::string& field) const {
    const auto found = missing_.find(field);
    return found == missing_.end() ? 0 : found->second;
  }
  /// Few causes that together explain the wrong claims, in the order in which `greedy_cover` chooses them.
  [[nodiscard]] std::vector<Finding> findings() const;
  /// The sentences of the findings, then one for each field that another convention would make right.
  [[nodiscard]] std::vector<std::string> lines() const;

  /// Everything that was counted, for an archive: what passes values in their order, to write or to read them.
  template <class Archive>
  void serialize(Archive& archive) {
    settle();
    archive(explanations_, wrong_, sample_, contradicted_, answered_, silent_, outside_, missing_, upheld_, denied_);
  }
  /// Whether every name and count in it exists: an archive may hold others.
  [[nodiscard]] bool is_sound() const;

 private:
  using Set = std::bitset<kMostCauses>;
  /// Claims are counted by place, for an engine may make a mistake in some places only.
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
    Set by;  ///< the causes that explain it

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
  using Counts = std::map<Place, std::vector<std::uint64_t>>;  ///< for each cause
  /// Wrong claims of one place that the same causes explain. Their number is an estimate where only a sample is kept.
  struct Alike {
    Place place;
    Set by;
    double n;
  };
  /// A right answer that no cause has been asked about.
  struct Postponed {
    Query query;
    Side at_alarm;
    Side at_zero;
    Claim claim;
    std::shared_ptr<const Declaration> declared;
    std::uint64_t weight;
  };
  void postpone(const Query& query, const Truth& truth, const Claim& claim, const Declaration& declared,
                std::uint64_t weight);
  /// Asks the causes about what was postponed.
  void settle();
  void compare(const Postponed& p);
  void compare(std::uint64_t key, const Query& query, const Truth& truth, const Claim& claim,
               const Declaration& declared, const Verdict& verdict, const Expectation* rounded, std::uint64_t weight);
  void count(std::uint64_t key, const Place& place, bool is_right, const Set& agree, const Set& differ,
             std::uint64_t weight);
  void add_wrong(const Wrong& wrong, std::uint64_t n);
  [[nodiscard]] std::vector<Alike> alike() const;
  [[nodiscard]] bool is_sampled() const;
  /// How many of the wrong claims that a cause explains at a place are more than it would explain by chance.
  [[nodiscard]] double beyond_chance(std::size_t cause, const Place& place, double explained) const;
  /// For each cause and place that share of the explained claims.
  [[nodiscard]] std::vector<std::map<Place, double>> shares(std::span<const Alike> wrong) const;
  /// What a cause explains of the wrong claims that are left.
  [[nodiscard]] Gain gain(std::size_t cause, std::span<const Alike> wrong, std::span<const std::size_t> left,
                          const std::map<Place, double>& share) const;
  /// The sentence of a finding: what is wrong, where, and how much of each aspect it explains.
  [[nodiscard]] std::string sentence(std::size_t cause, std::span<const Alike> wrong,
                                     std::span<const std::size_t> explained) const;

  std::vector<Postponed> postponed_;  ///< none where anything is wrong
  bool at_once_ = false;
  std::map<Explanation, std::uint64_t> explanations_;
  std::map<std::string, std::uint64_t> wrong_;
  std::map<std::string, std::uint64_t> missing_;  ///< by field that is declared: answers to hits without it
  std::map<Wrong, std::uint64_t> sample_;         ///< how often each wrong claim was made
  Counts contradicted_;                           ///< right claims against it
  Counts upheld_;                                 ///< right decisions for it
  Counts denied_;                                 ///< wrong decisions that it says otherwise
  std::map<Pair, std::uint64_t> answered_;
  std::map<Pair, std::uint64_t> silent_;                       ///< questions without an answer
  std::map<std::string, std::uint64_t, std::less<>> outside_;  ///< by cause: answers outside the domain
};

}  // namespace contact::oracle

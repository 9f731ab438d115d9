// What the laws said of an engine, for people, for JUnit (pugixml) and as JSON.
#include "tool/reports/law_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <pugixml.hpp>
#include <sstream>

#include "formats/json.hpp"
#include "golden/dataset.hpp"
#include "golden/right_case.hpp"
#include "tool/reports/fitness.hpp"

namespace contact::tool {
namespace {

using formats::json_string;
using proptests::LawResult;
using proptests::Violation;

std::string verdict(const LawResult& r) {
  if (r.skipped) return "skipped: " + *r.skipped;
  if (r.violation) return fmt::format("VIOLATED in case {}", r.tested);
  if (r.given_up) return fmt::format("GIVEN UP: only {} cases suited it", r.tested);
  return fmt::format("holds in {} cases", r.tested);
}

std::string truth(const Query& query, Scalar scalar) {
  return outside_domain(query) ? std::string("outside the domain: to be refused")
                               : golden::answer_line(golden::make_case(query, scalar));
}

std::string details(const LawRun& run, const LawResult& r) {
  const Violation& v = *r.violation;
  const Scalar scalar = run.result.engine.declared.scalar;
  std::string text = fmt::format("  {}\n  {}\n", r.law->sentence, v.why);
  for (std::size_t i = 0; i < v.queries.size(); ++i)
    text += fmt::format("  question {}  {}\n    said      {}\n    true      {}\n", i + 1,
                        golden::query_line(v.queries[i], scalar), engines::claim_object(v.claims[i]),
                        truth(v.queries[i], scalar));
  return text + fmt::format("  again       {} --law {}\n", run.again, r.law->name);
}

}  // namespace

std::string terminal_text(const LawRun& run) {
  const oracle::Declaration& declared = run.result.engine.declared;
  std::string text =
      fmt::format("{} {} ({}), seed {}{}\n\n", run.result.engine.name, run.result.engine.version, name(declared.scalar),
                  run.seed, declared.tolerance ? ", within " + tolerance_text(*declared.tolerance) : "");
  std::size_t width = 0;
  for (const LawResult& r : run.result.laws) width = std::max(width, r.law->name.size());
  for (const LawResult& r : run.result.laws) text += fmt::format("{:<{}}  {}\n", r.law->name, width, verdict(r));
  std::size_t violated = 0;
  for (const LawResult& r : run.result.laws) {
    if (!r.violation) continue;
    text += fmt::format("\n{} VIOLATED\n", r.law->name) + details(run, r);
    ++violated;
  }
  if (run.result.shares.questions != 0) {
    text += fmt::format("\nShares of {} questions:\n", run.result.shares.questions);
    for (std::size_t i = 0; i < proptests::kClassNames.size(); ++i)
      text += fmt::format("  {:5.1f} %  {}\n", run.result.shares.percent(static_cast<proptests::Class>(i)),
                          proptests::kClassNames[i]);
  }
  const std::size_t asked = run.result.laws.size() - run.result.skipped();
  text += fmt::format("\n{} of {} laws were asked{}\n", asked, run.result.laws.size(),
                      asked == run.result.laws.size() ? "" : "; the others were skipped");
  if (violated != 0)
    return text + fmt::format("{} violates {} of {} laws; the first names the mistake best: {}\n",
                              run.result.engine.name, violated, run.result.laws.size(),
                              run.result.first_violated()->law->name);
  return text + fmt::format("{}: {}\n", run.result.engine.name,
                            run.result.holds() ? "every law asked holds"
                            : asked == 0       ? "nothing can be said: no law was asked"
                                               : "nothing can be said: too few cases were tested");
}

std::string junit_text(const LawRun& run) {
  pugi::xml_document document;
  auto suite = document.append_child("testsuites").append_child("testsuite");
  suite.append_attribute("name") = ("contact-oracle properties: " + run.result.engine.name).c_str();
  std::uint64_t failures = 0;
  std::uint64_t skipped = 0;
  for (const LawResult& r : run.result.laws) {
    auto test = suite.append_child("testcase");
    test.append_attribute("classname") = "laws";
    test.append_attribute("name") = std::string(r.law->name).c_str();
    if (r.skipped) {
      ++skipped;
      test.append_child("skipped").append_attribute("message") = r.skipped->c_str();
    } else if (!r.holds()) {
      ++failures;
      auto failure = test.append_child("failure");
      failure.append_attribute("message") = (r.violation ? r.violation->why : verdict(r)).c_str();
      if (r.violation) failure.append_child(pugi::node_pcdata).set_value(details(run, r).c_str());
    }
  }
  suite.append_attribute("tests") = run.result.laws.size();
  suite.append_attribute("failures") = failures;
  suite.append_attribute("skipped") = skipped;
  std::ostringstream text;
  document.save(text, "  ");
  return text.str();
}

std::string json_text(const LawRun& run) {
  const Scalar scalar = run.result.engine.declared.scalar;
  std::string laws;
  for (const LawResult& r : run.result.laws) {
    laws += fmt::format(R"({}{{"law":{},"verdict":"{}","cases":{})", laws.empty() ? "" : ",", json_string(r.law->name),
                        r.skipped     ? "skipped"
                        : r.violation ? "violated"
                        : r.given_up  ? "given up"
                                      : "holds",
                        r.tested);
    if (r.skipped) laws += R"(,"why":)" + json_string(*r.skipped);
    if (r.violation) {
      std::string asked;
      for (std::size_t i = 0; i < r.violation->queries.size(); ++i)
        asked += fmt::format(R"({}{{"query":{},"said":{}}})", i == 0 ? "" : ",",
                             golden::query_line(r.violation->queries[i], scalar),
                             engines::claim_object(r.violation->claims[i]));
      laws += fmt::format(R"(,"sentence":{},"why":{},"questions":[{}],"again":{})", json_string(r.law->sentence),
                          json_string(r.violation->why), asked,
                          json_string(fmt::format("{} --law {}", run.again, r.law->name)));
    }
    laws += "}";
  }
  std::string shares;
  for (std::size_t i = 0; i < proptests::kClassNames.size(); ++i)
    shares +=
        fmt::format("{}{}:{}", i == 0 ? "" : ",", json_string(proptests::kClassNames[i]), run.result.shares.counts[i]);
  return fmt::format(
      R"({{"format":"contact-oracle/properties","version":1,{},"seed":{},"cases":{},"holds":{},"asked":{},"not_asked":{},"laws":[{}],"questions":{},"classes":{{{}}}}})"
      "\n",
      engines::engine_text(run.result.engine), run.seed, run.cases, run.result.holds(),
      run.result.laws.size() - run.result.skipped(), run.result.skipped(), laws, run.result.shares.questions, shares);
}

}  // namespace contact::tool

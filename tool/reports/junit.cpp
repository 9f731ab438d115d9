// The report as JUnit XML: one test suite, one test case a family (pugixml).
#include <fmt/format.h>

#include <pugixml.hpp>
#include <sstream>

#include "golden/dataset.hpp"
#include "tool/reports/report.hpp"

namespace contact::tool {

std::string junit_text(const Report& report) {
  pugi::xml_document document;
  auto suites = document.append_child("testsuites");
  auto suite = suites.append_child("testsuite");
  suite.append_attribute("name") = ("contact-oracle: " + report.who()).c_str();
  auto property = suite.append_child("properties").append_child("property");
  property.append_attribute("name") = "verdict";
  property.append_attribute("value") = report.sentence().c_str();
  std::uint64_t failures = 0;
  for (const FamilyReport& f : report.families) {
    auto test = suite.append_child("testcase");
    test.append_attribute("classname") = fmt::format("{}.{}", name(f.pair), name(f.scalar)).c_str();
    test.append_attribute("name") = (f.family + (f.fresh ? ", fresh" : "")).c_str();
    if (report.none_fails(f)) continue;  // whether they are enough is a question about all of them
    ++failures;
    auto failure = test.append_child("failure");
    failure.append_attribute("message") =
        fmt::format(
            "{} cases: {} missed hits, {} false hits, {} without an answer, {} with missing fields, {} not finite, {} "
            "numbers beyond the bound; level reached: {}",
            f.cases, f.missed_hits, f.false_hits, f.unanswered(), f.incomplete, f.not_finite,
            f.all_fields().at(oracle::Grade::beyond_bound), name(f.level_but_accepted(report.allow_unsupported)))
            .c_str();
  }
  for (const Skipped& s : report.skipped) {
    auto test = suite.append_child("testcase");
    test.append_attribute("classname") = "skipped";
    test.append_attribute("name") = (s.what + (s.fresh ? ", fresh" : "")).c_str();
    test.append_child("skipped").append_attribute("message") = s.why.c_str();
  }
  auto verdict = suite.append_child("testcase");
  verdict.append_attribute("classname") = "verdict";
  verdict.append_attribute("name") = fmt::format("required: {}", report.demand()).c_str();
  if (!report.certified()) {
    ++failures;
    std::string detail;
    for (const WorstCase& w : report.worst)
      detail += fmt::format("{}\n{}\n", w.what(), golden::query_line(w.query, w.scalar));
    auto failure = verdict.append_child("failure");
    failure.append_attribute("message") = report.sentence().c_str();
    failure.append_child(pugi::node_pcdata).set_value(detail.c_str());
  }
  suite.append_attribute("tests") = report.families.size() + report.skipped.size() + 1;
  suite.append_attribute("failures") = failures;
  suite.append_attribute("skipped") = report.skipped.size();
  std::ostringstream text;
  document.save(text, "  ");
  return text.str();
}

}  // namespace contact::tool

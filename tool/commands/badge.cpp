// badge: what a certificate states, as a small picture.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <array>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>
#include <sstream>

#include "engines/protocol/results.hpp"
#include "formats/json.hpp"
#include "formats/output_file.hpp"
#include "tool/commands/commands.hpp"
#include "tool/reports/certificate.hpp"
#include "tool/run/printing.hpp"
#include "tool/run/process.hpp"

namespace contact::tool {
namespace {

struct BadgeOptions {
  std::string certificate;
  std::string output;
  std::string label = "contact-oracle";
};

constexpr int kHeight = 20;
constexpr int kMargin = 6;  // on either side of a text
constexpr double kFontSize = 11;

/// Colours on which white text has a contrast of 4.5 and more: by level, and two more.
constexpr std::array<std::string_view, oracle::kLevelNames.size()> kLevelColours{"#17692f", "#34702a", "#55701c",
                                                                                 "#7a6410", "#94530f", "#a5281b"};
constexpr std::string_view kToleranceColour = "#1f5fa8";
constexpr std::string_view kLabelColour = "#4a4a4a";

/// How wide a text is, in pixels, from Verdana's advance widths in thousandths of the size, from the space to the
/// tilde. The picture says that the text is that wide, so that another font does not leave its field.
int width_of(std::string_view text) {
  constexpr std::array kAdvances{352,  394, 459, 818, 636, 1076, 727, 269, 454, 454, 636, 818, 364, 454, 364, 454,
                                 636,  636, 636, 636, 636, 636,  636, 636, 636, 636, 454, 454, 818, 818, 818, 545,
                                 1000, 684, 686, 698, 771, 632,  575, 775, 751, 421, 455, 693, 557, 843, 748, 787,
                                 603,  787, 695, 684, 616, 732,  684, 989, 685, 615, 685, 454, 454, 454, 818, 636,
                                 636,  601, 623, 521, 623, 596,  352, 623, 633, 274, 344, 592, 274, 973, 633, 607,
                                 623,  623, 427, 521, 394, 633,  592, 818, 592, 592, 525, 635, 454, 635, 818};
  static_assert(kAdvances.size() == '~' - ' ' + 1);
  double width = 0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x80 && byte < 0xC0) continue;  // of a character that has begun
    width += byte >= ' ' && byte <= '~' ? kAdvances[byte - std::size_t{' '}] : 1000;
  }
  return static_cast<int>(std::ceil(width * kFontSize / 1000));
}

/// "length 0.001, angle 0.01 rad": what of a tolerance allows anything.
std::string short_text(const Tolerance& t) {
  std::string text;
  const auto add = [&](std::string_view what, double x, std::string_view unit) {
    if (x != 0) text += fmt::format("{}{} {}{}", text.empty() ? "" : ", ", what, x, unit);
  };
  add("length", t.length, "");
  add("relative", t.relative, "");
  add("angle", t.angle, " rad");
  if (text.empty()) text = "tolerance 0";
  if (t.scale_min != 0 || std::isfinite(t.scale_max))
    text += fmt::format(", numbers {} to {}", t.scale_min, t.scale_max);
  return text;
}

/// What stands to the right, and on which colour.
struct Says {
  std::string text;
  std::string_view colour;
};

Says says(const formats::Node& certificate) {
  const formats::Node found = certificate.at("found");
  if (!found.at("certified").boolean())
    return {found.at("falls_short").items().empty() ? "refuted" : "too little judged", kLevelColours.back()};
  const std::size_t level = found.at("level_but_accepted").one_of(oracle::kLevelNames);
  const auto tolerance = found.find("tolerance");
  const std::size_t accepted = certificate.at("accepted").items().size();
  return {fmt::format("certified: {}{}",
                      tolerance ? short_text(engines::read_tolerance(*tolerance)) : oracle::kLevelNames[level],
                      accepted == 0   ? ""
                      : accepted == 1 ? " but for 1 failure"
                                      : fmt::format(" but for {} failures", accepted)),
          tolerance ? kToleranceColour : kLevelColours[level]};
}

/// What the fresh questions add; nothing where no published one was asked.
std::string beside(const formats::Node& found) {
  const formats::Node fresh = found.at("fresh");
  if (fresh.is_null()) return "";
  if (fresh.at("each").count() == 0) return ", published questions alone";
  const std::uint64_t judged = fresh.at("total").at("judged").count();
  return fmt::format(", and {} fresh {}", judged, judged == 1 ? "one" : "ones");
}

void put_text(pugi::xml_node group, const std::string& text, int x) {
  auto node = group.append_child("text");
  node.append_attribute("x") = x;
  node.append_attribute("y") = 14;
  node.append_attribute("textLength") = width_of(text);
  node.append_attribute("lengthAdjust") = "spacingAndGlyphs";
  node.append_child(pugi::node_pcdata).set_value(text.c_str());
}

std::string svg(const std::string& label, const Says& right, const std::string& title) {
  const int middle = 2 * kMargin + width_of(label);
  const int width = middle + 2 * kMargin + width_of(right.text);
  pugi::xml_document document;
  auto root = document.append_child("svg");
  root.append_attribute("xmlns") = "http://www.w3.org/2000/svg";
  root.append_attribute("width") = width;
  root.append_attribute("height") = kHeight;
  root.append_attribute("role") = "img";
  root.append_attribute("aria-label") = fmt::format("{}: {}", label, right.text).c_str();
  root.append_child("title").append_child(pugi::node_pcdata).set_value(title.c_str());
  const auto field = [&](std::string_view colour, const std::string& path) {
    auto node = root.append_child("path");
    node.append_attribute("fill") = std::string(colour).c_str();
    node.append_attribute("d") = path.c_str();
  };
  field(kLabelColour, fmt::format("M{} 0H3a3 3 0 0 0-3 3v14a3 3 0 0 0 3 3H{}z", middle, middle));
  field(right.colour, fmt::format("M{} 0H{}a3 3 0 0 1 3 3v14a3 3 0 0 1-3 3H{}z", middle, width - 3, middle));
  auto group = root.append_child("g");
  group.append_attribute("fill") = "#fff";
  group.append_attribute("font-family") = "Verdana,Geneva,DejaVu Sans,sans-serif";
  group.append_attribute("font-size") = kFontSize;
  put_text(group, label, kMargin);
  put_text(group, right.text, middle + kMargin);
  std::ostringstream text;
  document.save(text, "  ", pugi::format_indent | pugi::format_no_declaration);
  return text.str();
}

void write_badge(const BadgeOptions& options) {
  require_apart({options.output}, {options.certificate});
  formats::OutputFile file(options.output);
  const CertificateText certificate(options.certificate);
  for (const Difference& wrong : certificate.in_itself())
    throw formats::InputError({options.certificate, 0}, wrong.pointer.empty() ? "" : "sha256",
                              fmt::format("states {}, and has {}", wrong.stated, wrong.derived));
  const formats::Node root = certificate.node();
  const formats::Node engine = root.at("engine");
  const formats::Node found = root.at("found");
  const Says right = says(root);
  const std::string label = formats::visible(options.label);
  const std::string title =
      fmt::format("{}: {}. {} {}, issued {}; {} cases, {} of those given{}; certificate {}", label, right.text,
                  engine.at("name").text(), engine.at("version").text(), root.at("issued").text(),
                  found.at("total").at("judged").count(), found.at("share_judged").text(), beside(found),
                  root.at("sha256").text().substr(0, 12));
  file.write(svg(label, right, title));
  file.commit();
  say("Badge: {}, which says \"{}: {}\"\n", options.output, label, right.text);
}

}  // namespace

void add_badge(CLI::App& app, int& exit) {
  auto* command = app.add_subcommand(
      "badge",
      "What a certificate states, as a small picture (SVG)\nWhether it is true `verify` says, and not a badge.");
  auto options = std::make_shared<BadgeOptions>();
  command->add_option("certificate", options->certificate, "What certify --certificate wrote")->required();
  command->add_option("-o,--output", options->output, "The picture, *.svg")->type_name("FILE")->required();
  command->add_option("--label", options->label, "What stands to the left")->capture_default_str();
  command->callback([options, &exit] {
    write_badge(*options);
    exit = kCertified;
  });
}

}  // namespace contact::tool

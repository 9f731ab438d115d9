// What stands around every HTML page: it fetches nothing from anywhere.
#include <fmt/format.h>

#include "formats/visible.hpp"
#include "tool/reports/page.hpp"

namespace contact::tool::page {

std::string for_html(std::string_view text) {
  std::string out;
  for (const char c : formats::visible_lines(text)) {
    if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '&')
      out += "&amp;";
    else if (c == '"')
      out += "&quot;";
    else if (c == '\'')
      out += "&#39;";
    else
      out += c;
  }
  return out;
}

std::string inside_script(std::string_view text) {
  std::string out;
  for (const char c : formats::visible_json(std::string(text)))
    if (c == '<')
      out += "\\u003c";
    else
      out += c;
  return out;
}

std::string command_to_copy(std::string_view question) {
  return fmt::format("<div class=copy><code>echo '{}' | ./run explain</code><button type=button>Copy</button></div>",
                     for_html(question));
}

std::string whole(std::string_view title, std::string_view content, std::string_view footer, bool with_views) {
  // The browser is told, too, that nothing is fetched.
  std::string html = fmt::format(
      "<!doctype html>\n<html lang=en><meta charset=utf-8><meta name=viewport content=\"width=device-width,"
      "initial-scale=1\">\n<meta http-equiv=Content-Security-Policy content=\"default-src 'none'; "
      "style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:\">\n"
      "<title>{}: contact-oracle</title>\n<style>{}</style>\n<main><h1>contact-oracle</h1>\n{}<footer>{}",
      for_html(title), kStyle, content, footer);
  if (!kLicences.empty())
    html +=
        fmt::format("<details><summary>Libraries in this page</summary><pre>{}</pre></details>", for_html(kLicences));
  html += "</footer></main>\n";
  // What draws in space is large: it is text until the first view is looked at.
  if (with_views) html += fmt::format("<script type=\"text/plain\" id=space>{}</script>\n", kSpace);
  return html + fmt::format("<script>{}</script>\n<script>{}</script>\n</html>\n", kCharts, kScript);
}

}  // namespace contact::tool::page

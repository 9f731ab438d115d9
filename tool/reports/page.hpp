// What the HTML pages have in common: the files of tool/page/, the libraries that CMake found, and the frame around
// both.
#pragma once

#include <string>
#include <string_view>

namespace contact::tool::page {

extern const std::string_view kStyle;
extern const std::string_view kScript;
extern const std::string_view kCharts;    ///< D3; empty where it was not there to build with
extern const std::string_view kSpace;     ///< three.js and its OrbitControls; likewise
extern const std::string_view kLicences;  ///< of both

/// Text as it stands in an element or an attribute.
[[nodiscard]] std::string for_html(std::string_view text);
/// JSON inside a script element: nothing in it may end the element.
[[nodiscard]] std::string inside_script(std::string_view text);
/// A line for `explain` in the command that asks it, with a button that copies.
[[nodiscard]] std::string command_to_copy(std::string_view question);

/// The whole page, self-contained. `title` is text; `content` and `footer` are HTML.
[[nodiscard]] std::string whole(std::string_view title, std::string_view content, std::string_view footer,
                                bool with_views);

}  // namespace contact::tool::page

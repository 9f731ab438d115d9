// The files that a page is made of: tool/page/, and the libraries that CMake found.
#pragma once

#include <string_view>

namespace contact::tool::page {

extern const std::string_view kStyle;
extern const std::string_view kScript;
extern const std::string_view kCharts;    ///< D3; empty where it was not there to build with
extern const std::string_view kSpace;     ///< three.js and its OrbitControls; likewise
extern const std::string_view kLicences;  ///< of both

}  // namespace contact::tool::page

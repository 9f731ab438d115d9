// What standalone tests are made of: the files beside this one whose names end in .in. @WORDS@ stand for what
// standalone.cpp puts there.
#pragma once

#include <string_view>

namespace contact::tool::templates {

extern const std::string_view kC;
extern const std::string_view kCpp;
extern const std::string_view kCuda;
extern const std::string_view kTypes;  ///< of the three above
extern const std::string_view kCheck;  ///< of them too
extern const std::string_view kPython;
extern const std::string_view kJs;
extern const std::string_view kRust;

}  // namespace contact::tool::templates

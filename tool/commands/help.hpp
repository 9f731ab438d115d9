// Help: what --help, --help-all and the command `help` print.
#pragma once

#include <CLI/App.hpp>
#include <memory>
#include <string>

namespace contact::tool {

/// Prints of the program the commands that are used most, or with CLI::AppFormatMode::All every one, and of a command
/// its options under their headings.
[[nodiscard]] std::shared_ptr<CLI::FormatterBase> help_formatter();

}  // namespace contact::tool

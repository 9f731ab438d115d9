// An engine in a shared library with the C interface of contact_engine.h, called in this process.
#pragma once

#include <filesystem>
#include <memory>

#include "engines/engine.hpp"

namespace contact::engines {

/// Loads the library. Throws HarnessInvalid where it cannot be loaded, lacks a function, was built for another
/// interface, or declares nothing or something malformed. What it throws while it answers is an error of these answers.
/// It is asked by one thread at a time, and about the pairs that it declares: others are unsupported.
/// A crash of the library is a crash of this process: `serve` calls it, and a subprocess engine asks `serve`.
[[nodiscard]] std::unique_ptr<Engine> make_library(const std::filesystem::path& file);

}  // namespace contact::engines

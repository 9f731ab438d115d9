// A callable of Python as an engine, held against the oracle.
#pragma once

#include <pybind11/pybind11.h>

#include <string>

namespace contact::python {

namespace py = pybind11;

/// What `certify` of the command line does, of ask(pair, scalar, questions) -> answers; both by the names of
/// docs/formats.md. The texts are JSON. Gives {"exit": ..., "json": ..., "html": ..., "text": ..., "junit": ...,
/// "markdown": ...}. (Laws are asked by the command line: Debian's RapidCheck cannot be part of a shared library.)
[[nodiscard]] py::dict certify(const py::function& ask, const std::string& engine, const std::string& sources,
                               const std::string& options);

}  // namespace contact::python

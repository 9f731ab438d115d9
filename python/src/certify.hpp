// A callable of Python as an engine, held against the oracle.
#pragma once

#include <pybind11/pybind11.h>

#include <string>

namespace contact::python {

namespace py = pybind11;

/// What `certify` and `properties` of the command line do, of ask(pair, scalar, questions) -> answers; both by the
/// names of docs/formats.md. The texts are JSON. Gives {"exit": ..., "json": ..., "html": ..., "text": ..., "junit":
/// ..., "markdown": ...}, of laws without the pages.
[[nodiscard]] py::dict certify(const py::function& ask, const std::string& engine, const std::string& sources,
                               const std::string& options);
[[nodiscard]] py::dict properties(const py::function& ask, const std::string& engine, const std::string& options);

}  // namespace contact::python

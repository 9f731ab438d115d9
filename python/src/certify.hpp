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

/// Whether the tolerance that an engine declares allows an answer: an engine as in the header of a results file, a
/// question as `explain` reads it, and an answer as in a line of a results file. All three are JSON.
[[nodiscard]] bool is_within(const std::string& engine, const std::string& question, const std::string& answer);

}  // namespace contact::python

// Plug-ins: shared libraries that bring model types and intersectors at run time.
#pragma once

#include <filesystem>
#include <stdexcept>

#include "contact/intersector_factory.hpp"
#include "contact/model_factory.hpp"

namespace contact {

/// Where a plug-in registers what it brings.
struct PluginHost {
  IntersectorFactory& intersectors;
  ModelFactory& models;
};

/// What a plug-in exports. Plug-in and host are C++ on both sides: build them with the same compiler, standard library
/// and version of these headers.
struct PluginEntry {
  int interface;  ///< kPluginInterface of the headers that it was built with
  void (*enter)(PluginHost& host);
};

/// Changes whenever a class that crosses the border changes.
inline constexpr int kPluginInterface = 2;

class PluginError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Loads a shared library, and has it register with the instances of both factories. It stays loaded until the program
/// ends; a library that is loaded already is left alone. Throws PluginError where it cannot be loaded, is no plug-in,
/// was built for another interface, or throws while it registers (what it had registered by then stays).
void load_plugin(const std::filesystem::path& library);

}  // namespace contact

/// In one source file of the plug-in: CONTACT_PLUGIN(function); where `void function(contact::PluginHost&)` registers.
#define CONTACT_PLUGIN(function)                                                                     \
  extern "C" __attribute__((visibility("default"))) const contact::PluginEntry contact_plugin_entry; \
  const contact::PluginEntry contact_plugin_entry { contact::kPluginInterface, function }

// Plug-ins: shared libraries that add model types and intersectors at run time.
#pragma once

#include <filesystem>
#include <stdexcept>

#include "contact/intersector_factory.hpp"
#include "contact/model_factory.hpp"

namespace contact::inline CONTACT_ABI {

/// The factories in which a plug-in registers its model types and creators.
struct PluginHost {
  IntersectorFactory& intersectors;
  ModelFactory& models;
};

/// What a plug-in exports. The interface is C++ on both sides, so build plug-in and host with the same compiler,
/// standard library and version of these headers.
struct PluginEntry {
  int interface;  ///< kPluginInterface of the headers that it was built with
  void (*enter)(PluginHost& host);
};

/// Changes whenever a class that both the plug-in and the host use changes.
inline constexpr int kPluginInterface = 3;

class PluginError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Loads a shared library and lets it register with the instances of both factories. The library stays loaded until the
/// program ends. If it is loaded already, nothing happens. Throws PluginError if no file is named, or if the library
/// cannot be loaded, is no plug-in, was built for another interface, exports no function, or throws anything while it
/// registers (what it has registered by then stays registered). An exception that leaves one of the library's static
/// constructors, before it registers, ends the program.
void load_plugin(const std::filesystem::path& library);

}  // namespace contact::inline CONTACT_ABI

/// In one source file of the plug-in: CONTACT_PLUGIN(function); where `void function(contact::PluginHost&)` registers.
#define CONTACT_PLUGIN(function)                                                                     \
  extern "C" __attribute__((visibility("default"))) const contact::PluginEntry contact_plugin_entry; \
  const contact::PluginEntry contact_plugin_entry { contact::kPluginInterface, function }

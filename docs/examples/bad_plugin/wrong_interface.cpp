// A plug-in built for another interface: its function must not be called.
#include <cstdlib>

#include "contact/plugin.hpp"

namespace {
void enter(contact::PluginHost&) { std::abort(); }
}  // namespace

extern "C" __attribute__((visibility("default"))) const contact::PluginEntry contact_plugin_entry;
const contact::PluginEntry contact_plugin_entry{contact::kPluginInterface + 1, enter};

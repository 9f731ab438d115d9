// A plug-in that throws what is no std::exception.
#include "contact/plugin.hpp"

namespace {
void enter(contact::PluginHost&) { throw 1; }
}  // namespace

CONTACT_PLUGIN(enter);

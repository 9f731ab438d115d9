// A plug-in that registers a creator that is nothing.
#include "contact/plugin.hpp"

namespace {
void enter(contact::PluginHost& host) { host.intersectors.registerCreator("Nothing", nullptr); }
}  // namespace

CONTACT_PLUGIN(enter);

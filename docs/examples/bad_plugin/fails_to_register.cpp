// A plug-in that registers something and then fails.
#include "contact/plugin.hpp"

namespace {

void enter(contact::PluginHost& host) {
  host.intersectors.registerCreator("HalfDone", [](contact::DiscreteIntersection&) { return nullptr; });
  throw std::runtime_error("no licence found");
}

}  // namespace

CONTACT_PLUGIN(enter);

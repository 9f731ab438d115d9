// The other half: it brings the intersector, and knows the class from the same header.
#define DROP_NUMBERS double size = 3;
#define DROP_IDENTITY "org.example.Drop/1"
#include "drop.hpp"

namespace {

void enter(contact::PluginHost& host) {
  host.intersectors.registerCreator("SharedDropIntersector", contact::creator_of<example::DropIntersector>());
}

}  // namespace

CONTACT_PLUGIN(enter);

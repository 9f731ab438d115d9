// The first plug-in with a class Drop.
#define DROP_NUMBERS double size = 1;
#include "drop.hpp"

namespace {

void enter(contact::PluginHost& host) {
  host.models.registerModel({PLUGIN_NAME, {}, [](std::string name, const contact::ModelColumns&) {
                               return std::make_unique<example::Drop>(std::move(name));
                             }});
  host.intersectors.registerCreator(PLUGIN_NAME, contact::creator_of<example::DropIntersector>());
}

}  // namespace

CONTACT_PLUGIN(enter);

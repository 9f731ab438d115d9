// The second plug-in with a class Drop: the size lies elsewhere in it.
#define DROP_NUMBERS                 \
  double temperature[3] = {7, 8, 9}; \
  double size = 2;
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

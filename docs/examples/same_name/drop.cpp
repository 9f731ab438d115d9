// A plug-in with a class Drop, which brings its models, its intersector, or both.
#include "drop.hpp"

namespace {

void enter(contact::PluginHost& host) {
#ifdef DROP_MODELS
  host.models.registerModel({DROP_MODELS, {}, [](std::string name, const contact::ModelColumns&) {
                               return std::make_unique<example::Drop>(std::move(name));
                             }});
#endif
#ifdef DROP_INTERSECTOR
  host.intersectors.registerCreator(DROP_INTERSECTOR, contact::creator_of<example::DropIntersector>());
#endif
}

}  // namespace

CONTACT_PLUGIN(enter);

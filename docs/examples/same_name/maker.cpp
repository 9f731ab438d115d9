// Half of a pair of plug-ins that mean one class Drop: it brings the models.
#define DROP_NUMBERS double size = 3;
#define DROP_IDENTITY "org.example.Drop/1"
#include "drop.hpp"

namespace {

void enter(contact::PluginHost& host) {
  host.models.registerModel({"SharedDrop", {}, [](std::string name, const contact::ModelColumns&) {
                               return std::make_unique<example::Drop>(std::move(name));
                             }});
}

}  // namespace

CONTACT_PLUGIN(enter);

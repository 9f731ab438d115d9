// A plug-in that has nothing to register with.
#include "contact/plugin.hpp"

CONTACT_PLUGIN(nullptr);

// The plug-in ContactOracle: what SOFA's plug-in manager asks for, and the two components.
#include <sofa/core/ObjectFactory.h>

#include "contact/version.h"
#include "engines/sofa/plugin/exact_discrete_intersection.hpp"
#include "engines/sofa/plugin/recording_intersection.hpp"

#define CONTACT_SOFA_EXPORT extern "C" __attribute__((visibility("default")))

CONTACT_SOFA_EXPORT void initExternalModule() {}
CONTACT_SOFA_EXPORT const char* getModuleName() { return "ContactOracle"; }
CONTACT_SOFA_EXPORT const char* getModuleVersion() { return CONTACT_VERSION_STRING; }
CONTACT_SOFA_EXPORT const char* getModuleLicense() { return "MIT"; }
CONTACT_SOFA_EXPORT const char* getModuleDescription() {
  return "Exact discrete intersection of spheres and cubes, and a record of what an intersection component answers";
}
CONTACT_SOFA_EXPORT void registerObjects(sofa::core::ObjectFactory* factory) {
  using sofa::core::ObjectRegistrationData;
  factory->registerObjects(ObjectRegistrationData("Detect intersection using discrete methods: exact decisions, and "
                                                  "numbers that are rounded once.")
                               .add<contact::sofa_plugin::ExactDiscreteIntersection>());
  factory->registerObjects(
      ObjectRegistrationData("Write down the questions and answers of another intersection component.")
          .add<contact::sofa_plugin::RecordingIntersection>());
}

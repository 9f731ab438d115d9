// sofa-contacts: runs a .scn file in SOFA and writes the contacts that its pipeline finds, in the form of
// `contact-oracle detect --json`. Plug-ins are found in the folders of SOFA_PLUGIN_PATH, data in those of
// SOFA_DATA_PATH.
#include <sofa/core/collision/DetectionOutput.h>
#include <sofa/core/collision/Intersection.h>
#include <sofa/core/collision/NarrowPhaseDetection.h>
#include <sofa/core/collision/Pipeline.h>
#include <sofa/simulation/Node.h>
#include <sofa/simulation/Simulation.h>
#include <sofa/simulation/common/init.h>
#include <sofa/simulation/graph/init.h>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "engines/sofa/quiet.hpp"

namespace {

namespace core = sofa::core;
using core::collision::DetectionOutput;
using core::collision::NarrowPhaseDetection;

std::string number(double x) {
  if (std::isnan(x)) return "\"NaN\"";
  if (std::isinf(x)) return x > 0 ? "\"Infinity\"" : "\"-Infinity\"";
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, x).ptr};
}
std::string row(const sofa::type::Vec3& x) {
  return '[' + number(x[0]) + ',' + number(x[1]) + ',' + number(x[2]) + ']';
}
/// A text in JSON: names of models are whatever a scene says.
std::string quoted(const std::string& text) {
  std::string json = "\"";
  for (const char c : text) {
    char code[8];
    if (static_cast<unsigned char>(c) < 0x20) {
      std::snprintf(code, sizeof code, "\\u%04x", static_cast<unsigned>(c));
      json += code;
    } else {
      if (c == '"' || c == '\\') json += '\\';
      json += c;
    }
  }
  return json + '"';
}
std::string element(const core::CollisionElementIterator& e) {
  return R"({"model":)" + quoted(e.getCollisionModel()->getPathName()) + R"(,"index":)" + std::to_string(e.getIndex()) +
         '}';
}

/// The contacts of every narrow phase below `root`, as they stand.
std::vector<DetectionOutput> contacts_of(sofa::simulation::Node& root) {
  std::vector<NarrowPhaseDetection*> phases;
  root.getTreeObjects<NarrowPhaseDetection>(&phases);
  std::vector<DetectionOutput> all;
  for (const NarrowPhaseDetection* phase : phases)
    for (const auto& [models, outputs] : phase->getDetectionOutputs())
      if (const auto* found = dynamic_cast<const sofa::type::vector<DetectionOutput>*>(outputs))
        all.insert(all.end(), found->begin(), found->end());
  return all;
}

/// One step of detection without the simulation's step: positions stay as they are.
void detect(sofa::simulation::Node& root) {
  std::vector<core::collision::Pipeline*> pipelines;
  root.getTreeObjects<core::collision::Pipeline>(&pipelines);
  for (core::collision::Pipeline* pipeline : pipelines) {
    pipeline->computeCollisionReset();
    pipeline->computeCollisionDetection();
  }
}

void write(std::ostream& to, const std::vector<DetectionOutput>& contacts, sofa::simulation::Node& root) {
  std::vector<core::collision::Intersection*> intersections;
  root.getTreeObjects<core::collision::Intersection>(&intersections);
  const bool none = intersections.empty();
  to << R"({"format":"contact-oracle/contacts","version":1,"alarm":)"
     << number(none ? 0 : intersections[0]->getAlarmDistance()) << R"(,"contact":)"
     << number(none ? 0 : intersections[0]->getContactDistance()) << R"(,"points":"center"})" << '\n';
  for (const DetectionOutput& c : contacts)
    to << R"({"first":)" << element(c.elem.first) << R"(,"second":)" << element(c.elem.second) << R"(,"id":)" << c.id
       << R"(,"normal":)" << row(c.normal) << R"(,"point1":)" << row(c.point[0]) << R"(,"point2":)" << row(c.point[1])
       << R"(,"value":)" << number(c.value) << "}\n";
}

int usage(const std::string& what) {
  std::cerr << what << "\nusage: sofa-contacts SCENE.scn [--steps N] [-o CONTACTS.jsonl]\n";
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  std::string scene;
  std::string output;
  unsigned steps = 0;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    const bool is_option = argument == "--steps" || argument == "-o";
    if (is_option && i + 1 == argc) return usage(argument + " asks for a value");
    if (argument == "--steps") {
      const char* text = argv[++i];
      const auto [end, error] = std::from_chars(text, text + std::strlen(text), steps);
      if (error != std::errc() || *end != '\0')
        return usage("--steps: expected a count, got '" + std::string(text) + "'");
    } else if (argument == "-o") {
      output = argv[++i];
    } else if (argument.starts_with('-') || !scene.empty()) {
      return usage("unexpected '" + argument + "'");
    } else {
      scene = argument;
    }
  }
  if (scene.empty()) return usage("no scene is given");
  if (!std::ifstream(scene)) return usage(scene + ": cannot be read");

  contact::sofa_engine::speak_on_standard_error();
  sofa::simulation::common::init();
  sofa::simulation::graph::init();
  const sofa::simulation::Node::SPtr root = sofa::simulation::node::load(scene);
  if (!root) {
    std::cerr << scene << ": SOFA cannot load it\n";
    return 2;
  }
  sofa::simulation::node::initRoot(root.get());
  detect(*root);
  std::vector<DetectionOutput> contacts = contacts_of(*root);
  std::cout << "step 0: " << contacts.size() << " contacts\n";
  for (unsigned step = 1; step <= steps; ++step) {
    sofa::simulation::node::animate(root.get(), root->getDt());
    contacts = contacts_of(*root);
    std::cout << "step " << step << ": " << contacts.size() << " contacts\n";
  }
  if (!output.empty()) {
    std::ofstream to(output);
    write(to, contacts, *root);
    if (!to.flush()) {
      std::cerr << output << ": cannot be written\n";
      return 2;
    }
  }
  sofa::simulation::node::unload(root);
  sofa::simulation::graph::cleanup();
  sofa::simulation::common::cleanup();
  return 0;
}

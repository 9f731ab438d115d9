// A scene, of SOFA where it begins with <: refused, or read; the pairs of its models that are near are among those that
// may meet, and the others have no contact.
#include "tool/run/scene.hpp"

#include <algorithm>

#include "contact/detect.hpp"
#include "contact/discrete_intersection.hpp"
#include "formats/input_error.hpp"
#include "fuzz/fuzz.hpp"
#include "tool/run/near_models.hpp"

namespace contact::fuzz::scene {
namespace {

tool::Scene read(const MemoryFile& file, bool of_sofa) {
  if (!of_sofa) return tool::read_scene({file.path()}, ModelFactory::getInstance());
  tool::SofaScene read = tool::read_sofa_scene(file.path(), ModelFactory::getInstance());
  tool::Scene scene;
  scene.alarm = read.alarm;
  for (tool::SofaScene::Model& one : read.models) {
    scene.models.push_back(std::move(one.model));
    scene.rules.push_back(std::move(one.rules));
  }
  return scene;
}

void try_input(Bytes bytes) {
  const MemoryFile file(text_of(bytes));
  tool::Scene scene;
  try {
    scene = read(file, !bytes.empty() && bytes[0] == '<');
  } catch (const formats::InputError&) {
    return;
  }
  constexpr std::size_t kFew = 12;
  constexpr Index kSmall = 200;
  const ProximityIntersection intersection({scene.alarm.value_or(0), 0});
  const tool::NearModels pairs = tool::near_models(scene, intersection, false);
  require(std::is_sorted(pairs.near.begin(), pairs.near.end()), "pairs in another order");
  require(std::includes(pairs.listed.begin(), pairs.listed.end(), pairs.near.begin(), pairs.near.end()),
          "models are near that do not meet");
  if (scene.models.size() > kFew) return;
  for (const tool::ModelPair& pair : pairs.listed) {
    const CollisionModel& first = *scene.models[pair.first];
    const CollisionModel& second = *scene.models[pair.second];
    if (first.getSize() > kSmall || second.getSize() > kSmall) continue;
    const auto contacts = detect(intersection, first, second);
    require(contacts.has_value(), "a pair is listed that has no intersector");
    require(contacts->empty() || std::binary_search(pairs.near.begin(), pairs.near.end(), pair),
            first.getName() + " and " + second.getName() + " have a contact and are not near");
  }
}

const Target target("scene", try_input);

}  // namespace
}  // namespace contact::fuzz::scene

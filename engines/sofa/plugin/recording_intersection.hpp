// RecordingIntersection: writes down what another intersection component is asked and answers while a simulation runs.
#pragma once

#include <sofa/core/collision/Intersection.h>
#include <sofa/core/objectmodel/Data.h>
#include <sofa/core/objectmodel/Link.h>

#include <fstream>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>

#include "contact/pairs.hpp"
#include "oracle/truth/query.hpp"

namespace contact::sofa_plugin {

/// It stands before the component that it names, so that the pipeline finds it first, and passes every call on.
/// `filename`.PAIR.queries.jsonl gets the questions, one a line as `annotate` reads them, and `filename`.answers.jsonl
/// the answers, as `certify --results` reads them. Both are whole after each narrow phase. Of a pair of spheres both
/// functions are written down, whichever the pipeline calls; of two cubes testIntersection, which is all there is. A
/// question that comes again is not written again, and a second answer that differs is told.
/// Left out, and counted: a cube against itself, a number that is not finite, models with a contact distance of their
/// own, and everything beyond `limit`.
class RecordingIntersection : public sofa::core::collision::Intersection {
 public:
  SOFA_CLASS(RecordingIntersection, sofa::core::collision::Intersection);
  using Current = sofa::core::collision::Intersection;

  void init() override;
  void cleanup() override;

  sofa::core::collision::ElementIntersector* findIntersector(sofa::core::CollisionModel* object1,
                                                             sofa::core::CollisionModel* object2,
                                                             bool& swapModels) override;
  bool useProximity() const override { return l_intersection->useProximity(); }
  bool useContinuous() const override { return l_intersection->useContinuous(); }
  sofa::core::CollisionModel::ContinuousIntersectionTypeFlag continuousIntersectionType() const override {
    return l_intersection->continuousIntersectionType();
  }
  SReal getAlarmDistance() const override { return l_intersection->getAlarmDistance(); }
  SReal getContactDistance() const override { return l_intersection->getContactDistance(); }
  void setAlarmDistance(SReal distance) override { l_intersection->setAlarmDistance(distance); }
  void setContactDistance(SReal distance) override { l_intersection->setContactDistance(distance); }
  void beginBroadPhase() override { l_intersection->beginBroadPhase(); }
  void endBroadPhase() override { l_intersection->endBroadPhase(); }
  void beginNarrowPhase() override { l_intersection->beginNarrowPhase(); }
  void endNarrowPhase() override;

  /// What was answered: of two spheres both, of two cubes `overlap` alone.
  struct Answer {
    bool overlap;
    std::optional<sofa::core::collision::DetectionOutput> contact;
  };
  void record(const Query& query, const Answer& answer);
  void leave_out();

  sofa::core::objectmodel::Data<std::string> d_filename;
  sofa::core::objectmodel::Data<std::string> d_contactPoints;
  sofa::core::objectmodel::Data<unsigned int> d_limit;

 protected:
  RecordingIntersection();
  ~RecordingIntersection() override;

 private:
  [[nodiscard]] bool open(std::ofstream& file, const std::string& ending);
  [[nodiscard]] bool open(Pair pair);

  sofa::core::objectmodel::SingleLink<RecordingIntersection, Current,
                                      sofa::BaseLink::FLAG_STOREPATH | sofa::BaseLink::FLAG_STRONGLINK>
      l_intersection;
  std::map<sofa::core::collision::ElementIntersector*, std::unique_ptr<sofa::core::collision::ElementIntersector>>
      recorded_;
  std::mutex mutex_;  // guards what is below
  std::map<Pair, std::ofstream> queries_;
  std::ofstream answers_;
  std::unordered_map<std::string, std::string> lines_;  // by id
  std::size_t left_out_ = 0;
  std::size_t differing_ = 0;
};

}  // namespace contact::sofa_plugin

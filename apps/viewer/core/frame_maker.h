// Frames of a live run: what the world tells of its bodies, and what views ask for besides.
#pragma once
#include <memory>
#include <vector>

#include "viewer_core/live_run.h"

namespace brickfall::viewer {

// Of a scene, for RunInfo.
std::shared_ptr<const RunInfo> infoOf(const SceneRun& run);

// Everything of a frame but the session's part (number, times, status, log).
class FrameMaker {
 public:
  void fill(Frame& frame, const LiveRun& run, const FrameNeeds& needs, Serial selected);
  // Whatever comes next is not reached by moving there.
  void jump() { last_.reset(); }

 private:
  void listPlaces(const BodyList& list);
  int placeOf(BodyId id) const;
  void fillBodies(Frame& frame, const LiveRun& run);
  void fillContacts(Frame& frame, const LiveRun& run, const FrameNeeds& needs, int selected);
  void fillCollisions(Frame& frame, const ReportRun& run) const;
  void fillIslands(Frame& frame, const World& world) const;
  void fillBounds(Frame& frame, const World& world) const;
  void fillMortar(Frame& frame, const World& world) const;
  std::vector<std::string> mortarOf(const LiveRun& run, BodyId body) const;
  void fillSettings(Frame& frame, const LiveRun& run);
  void select(Frame& frame, const LiveRun& run, int place) const;

  std::shared_ptr<const BodyList> last_;  // of the last frame, and where its bodies were
  std::vector<Transform> poses_;
  std::shared_ptr<const BodyList> placedList_;
  std::vector<int> placeByIndex_;  // by BodyId::index: place in the list, -1: none
  // Of the panel, as long as nothing is changed.
  std::uint64_t changesShown_ = 0;
  std::shared_ptr<const BodyList> materialsOf_;
  std::vector<double> settings_;
  std::vector<MaterialRow> materials_;
};

}  // namespace brickfall::viewer

// A scene run live: its steps, what the user does to it, undoing and rewinding, recording. Knows neither threads nor clocks: who
// calls decides when a step is made.
#pragma once
#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "brickfall/take_recorder.h"
#include "viewer_core/event_log.h"
#include "viewer_core/history.h"
#include "viewer_core/state_file.h"

namespace brickfall::viewer {

class LiveRun {
 public:
  // `nextSerial` and `log` are the session's: they outlive runs.
  static Result<std::unique_ptr<LiveRun>> start(const SceneSource& source, const SceneDescription& scene,
                                                const HistoryLimits& limits, Serial& nextSerial, EventLog& log);
  // As it was saved; `scene` with the settings that were saved.
  static Result<std::unique_ptr<LiveRun>> resume(const SavedState& saved, const SceneDescription& scene,
                                                 const HistoryLimits& limits, Serial& nextSerial, EventLog& log);

  // One step. An error: the run can't go on.
  Status step();
  // A command that is about a run: hands, settings, saving, recording, rewinding. The answer's message says what was done.
  Result<std::string> execute(const Command& command);
  Result<std::string> rewind(double time);
  Result<std::string> stepBack(int steps);
  Result<std::string> undo();
  // The scene as it is to be at the next start: with all settings that were changed.
  const SceneDescription& wanted() const { return wanted_; }
  const SceneSource& source() const { return source_; }
  // The take is whole then; nothing happens if there is none. What it says is in the log, too.
  Result<std::string> stopRecording();
  // Stops it because of something else that happens; what went wrong then is one of the problems.
  void endRecording();
  // What went wrong and no command answers for, since the last call: a recording that died.
  std::vector<std::string> takeProblems() { return std::exchange(problems_, {}); }

  // --- What frames are made of.
  const SceneRun& run() const { return run_; }
  const std::shared_ptr<const BodyList>& list() const { return list_; }
  const std::optional<DragSpring>& drag() const { return drag_; }
  const std::optional<StepReport>& report() const { return report_; }
  const std::deque<StepSample>& samples() const { return samples_; }
  double sinceHit(BodyId id) const;  // s
  double hitSpeed(BodyId id) const;  // m/s, of that hit
  std::string recording() const { return recorder_ ? recordingPath_ : std::string(); }
  std::uint64_t settingsWait() const;
  std::uint64_t changes() const { return changes_; }  // grows when settings or materials may have changed
  const History& history() const { return history_; }
  std::string undoLabel() const;

 private:
  LiveRun(SceneSource source, SceneDescription scene, SceneRun run, const HistoryLimits& limits, Serial& nextSerial,
          EventLog& log);
  void begin();  // the history, from the run as it is

  // live_run.cpp
  Moment now() const { return {run_.stepCount(), commandsDone_}; }
  Result<StepReport> advance();  // a step with the spring's force
  void hear(const StepReport& report);
  void sample(const StepReport& report);
  Kept asItIs() const;
  void keep(Kept kept);
  void takeSettings();  // the run's into what is wanted
  void goOn();          // what lay ahead after a rewind is forgotten
  Status goTo(const Moment& moment);
  Status put(const Kept& kept);
  Status doAgain(const Moment& moment);

  // live_commands.cpp: what changes the world. `made`: the serial that a new body is to have; 0: the next one.
  Result<std::string> makeChange(const Command& command);
  Result<std::string> carryOut(const Command& command, Serial& made);
  Result<std::string> carryOut(const ShootBall& shot, Serial& made);
  Result<std::string> carryOut(const DragBegin& begin);
  Result<std::string> carryOut(const DragMove& move);
  Result<std::string> carryOut(const DragEnd&);
  Result<std::string> carryOut(const RemoveBody& remove);
  Result<std::string> carryOut(const WakeBody& wake);
  Result<std::string> carryOut(const Explode& blast);
  Result<std::string> carryOut(const CutJoints& cut);
  Result<std::string> carryOut(const TiltGround& tilt);
  Result<std::string> carryOut(const KickGround& kick);
  Result<std::string> carryOut(const ChangeSetting& change);
  Result<std::string> carryOut(const ChangeMaterial& change);
  Result<std::string> save(const std::string& path) const;
  Result<std::string> startRecording(const std::string& path);
  Result<BodyId> bodyOf(Serial serial) const;
  std::string nameOfBody(BodyId id) const;
  void relist();  // masses or bodies changed
  void listBody(BodyId id, Serial serial);
  bool continuesLast(const ChangeSetting& change) const;

  SceneSource source_;
  SceneDescription wanted_;
  SceneRun run_;
  History history_;
  Serial* nextSerial_;
  EventLog* log_;
  std::shared_ptr<const BodyList> list_;
  std::uint64_t commandsDone_ = 0;
  std::uint64_t changes_ = 1;
  double workSinceKept_ = 0;  // ms
  bool quiet_ = false;        // steps are made again: nothing new happens
  std::optional<DragSpring> drag_;
  std::optional<StepReport> report_;
  std::deque<StepSample> samples_;
  struct Hit {
    double time = -1e9;  // s
    float speed = 0;     // m/s
  };
  std::vector<Hit> lastHit_;  // by BodyId::index
  std::optional<TakeRecorder> recorder_;
  std::string recordingPath_;
  std::vector<std::string> problems_;
  // The last change of a setting: those of one setting in a row are one to undo.
  std::string lastSetting_;
  double lastSettingTime_ = 0;
  std::uint64_t lastSettingCommand_ = 0;
};

// What a list says of a body.
ListedBody listed(const SceneRun& run, BodyId id, Serial serial);

}  // namespace brickfall::viewer

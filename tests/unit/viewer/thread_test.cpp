// With a thread of its own: a window that reads frames and sends commands all the while. Runs under the thread sanitizer, too.
#include <thread>

#include "brickfall/take.h"
#include "unit/viewer/viewer_support.h"
#include "viewer_core/picking.h"

namespace brickfall::viewer {
namespace {

// Until it holds, or so many tries with a little sleep between: only how soon depends on the machine.
template <class Condition> bool becomes(Condition condition) {
  for (int i = 0; i < 5000; i++) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return false;
}

TEST(Thread, AWindowReadsAndSendsWhileItRuns) {
  TempFile scene("threaded.toml", kWall);
  Session session;
  session.ask({true, true, true, true, true});
  session.send(Open{scene.path(), {}, true});
  ASSERT_TRUE(becomes([&] { return session.latest()->info->kind == RunKind::live; }));
  Picker picker;
  std::uint64_t last = 0, answered = 0, sent = 1;
  const auto send = [&](Command command) { EXPECT_EQ(session.send(std::move(command)), ++sent); };
  const auto answers = [&] {
    for (const CommandResult& result : session.takeResults()) EXPECT_EQ(result.ticket, ++answered);
    return answered;
  };
  std::size_t found = 0;
  for (int i = 0; i < 120; i++) {
    const std::shared_ptr<const Frame> frame = session.latest();
    EXPECT_GE(frame->number, last);
    last = frame->number;
    EXPECT_EQ(frame->bodies.size(), frame->list->bodies.size());
    double sum = 0;
    for (const FrameBody& body : frame->bodies) sum += poseAt(body, blendAt(*frame, session.now())).position.y;
    EXPECT_TRUE(std::isfinite(sum));
    const auto hit = picker.pick(*frame, {{0.4, 0.2, 3}, {0, 0, -1}}, blendAt(*frame, session.now()));
    found += hit.has_value();
    if (i % 10 == 0) send(ShootBall{{{0.4, 0.2, 2}, {0, 0, -1}}, 0.05, 6, "steel"});
    if (i % 10 == 2 && hit) send(DragBegin{hit->serial, hit->local, 20});
    if (i % 10 == 4) send(DragMove{{0, 1, 1}});
    if (i % 10 == 6) send(DragEnd{});
    if (i % 30 == 8) send(Undo{});
    if (i % 40 == 9) send(Restart{});
    if (i % 7 == 0) session.ask({i % 2 == 0, true, true, true, true});
    answers();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  EXPECT_GT(found, 0u);
  send(Pause{});
  // Each was answered, once and in order.
  ASSERT_TRUE(becomes([&] { return answers() == sent; }));
}

// Ctrl+S and Ctrl+Q in one go.
TEST(Thread, SavesWhatWasToBeSavedBeforeItEnds) {
  TempFile scene("threaded.toml", kWall), state("threaded.state");
  Session session;
  session.send(Open{scene.path(), {}, true});
  ASSERT_TRUE(becomes([&] { return session.latest()->info->kind == RunKind::live; }));
  session.send(SaveState{state.path()});
  EXPECT_TRUE(session.finish().ok());
  EXPECT_TRUE(state.exists());
  session.send(SaveState{"no/such/folder/x.state"});
  EXPECT_FALSE(session.finish().ok());
}

TEST(Thread, EndsAtOnceWithARecordingWhole) {
  TempFile scene("threaded.toml", kWall), take("threaded.take");
  {
    Session session;
    session.send(Open{scene.path(), {}, true});
    session.send(StartRecording{take.path()});
    ASSERT_TRUE(becomes([&] { return session.latest()->status.step > 3; }));
    EXPECT_TRUE(session.finish().ok());
    const std::uint64_t last = session.latest()->number;
    const Result<TakeReader> read = TakeReader::open(take.path());
    ASSERT_TRUE(read.ok()) << read.error().message;
    EXPECT_TRUE(read->complete());
    EXPECT_GT(read->frameCount(), 3u);
    session.send(Undo{});  // nobody carries it out
    EXPECT_EQ(session.latest()->number, last);
  }
  EXPECT_TRUE(TakeReader::open(take.path())->complete());
}

}  // namespace
}  // namespace brickfall::viewer

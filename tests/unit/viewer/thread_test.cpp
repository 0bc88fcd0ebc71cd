// With a thread of its own: a window that reads frames and sends commands all the while. Runs under the thread sanitizer, too.
#include <thread>

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
  std::uint64_t last = 0, answered = 0;
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
    if (i % 10 == 0) session.send(ShootBall{{{0.4, 0.2, 2}, {0, 0, -1}}, 0.05, 6, "steel"});
    if (i % 10 == 2 && hit) session.send(DragBegin{hit->serial, hit->local, 20});
    if (i % 10 == 4) session.send(DragMove{{0, 1, 1}});
    if (i % 10 == 6) session.send(DragEnd{});
    if (i % 30 == 8) session.send(Undo{});
    if (i % 40 == 9) session.send(Restart{});
    if (i % 7 == 0) session.ask({i % 2 == 0, true, true, true, true});
    answered += session.takeResults().size();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  EXPECT_GT(found, 0u);
  const std::uint64_t ticket = session.send(Pause{});
  ASSERT_TRUE(becomes([&] {
    for (const CommandResult& result : session.takeResults())
      if (result.ticket == ticket) return true;
    return false;
  }));
}

TEST(Thread, EndsAtOnceWithARecordingWhole) {
  TempFile scene("threaded.toml", kWall), take("threaded.take");
  {
    Session session;
    session.send(Open{scene.path(), {}, true});
    session.send(StartRecording{take.path()});
    ASSERT_TRUE(becomes([&] { return session.latest()->status.step > 3; }));
  }
  EXPECT_TRUE(take.exists());
}

}  // namespace
}  // namespace brickfall::viewer

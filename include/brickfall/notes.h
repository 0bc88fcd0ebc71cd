// Lines for the program's log: what the engine did on its own, that nobody asked for. Each also stands in what a call returns, or in
// the world itself, so nobody need listen; without a handler nothing is written and nothing is made.
#pragma once
#include <atomic>
#include <cstdint>

namespace brickfall {

enum class NoteKind : std::uint8_t {
  quarantined,  // a body became non-finite or lost (limits.h) and is held since then (StepReport::quarantined)
  tiesEnded,    // joints and mortar went with a body that was destroyed
};

struct Note {
  NoteKind kind = NoteKind::quarantined;
  const char* text = "";        // one line, without its end; gone when the handler returns
  std::uint64_t stepIndex = 0;  // of the step in which it was, or the last one
  std::uint32_t bodyIndex = 0;  // BodyId::index
  int count = 0;                // of ties that ended
};

// Called on the thread of the call, at its end. It may read the world, not change it.
using NoteHandler = void (*)(const Note&);

namespace detail {
inline std::atomic<NoteHandler> noteHandler{nullptr};
}

// null: nobody. Of the whole process; any thread, any time; returns the handler there was.
inline NoteHandler setNoteHandler(NoteHandler handler) { return detail::noteHandler.exchange(handler); }

}  // namespace brickfall

// One job at a time: pieces are handed out by a counter, the calling thread takes part. A worker that wakes late must
// not take a piece of the next job for one of its own, nor need the next job wait for it: the counter carries the
// number of the job, and a claim with an old number fails.
#include "parallel/worker_pool.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

#include "base/assert.h"

namespace brickfall {
namespace {

// Loops follow each other within microseconds during a step: look that often before going to sleep.
constexpr int kSpins = 2000;

inline void pauseBriefly() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#endif
}

struct Job {
  const std::function<void(int, int)>* body = nullptr;
  int count = 0, grain = 1;
  std::uint32_t pieces = 0, number = 0;
};

// Set while this thread runs a piece: a loop inside a piece runs on this thread alone.
thread_local bool insidePiece = false;

void runPiece(const Job& job, std::uint32_t piece) {
  int begin = int(piece) * job.grain;
  int end = job.count - begin > job.grain ? begin + job.grain : job.count;
  (*job.body)(begin, end);
}

}  // namespace

struct WorkerPool::Impl {
  std::mutex mutex;
  std::condition_variable started, finished;
  Job job;                               // guarded by mutex
  bool stopping = false;                 // guarded by mutex
  std::atomic<std::uint32_t> newest{0};  // job.number, for spinning
  std::atomic<std::uint64_t> ticket{0};  // number of the job << 32 | next piece
  std::atomic<std::uint32_t> left{0};    // pieces of the job that are not done
  std::vector<std::thread> workers;

  // Runs pieces of this job until there are none left to claim.
  void work(const Job& mine) {
    insidePiece = true;
    std::uint64_t seen = ticket.load(std::memory_order_acquire);
    while (std::uint32_t(seen >> 32) == mine.number && std::uint32_t(seen) < mine.pieces) {
      if (!ticket.compare_exchange_weak(seen, seen + 1, std::memory_order_acq_rel, std::memory_order_acquire)) continue;
      runPiece(mine, std::uint32_t(seen));
      if (left.fetch_sub(1, std::memory_order_acq_rel) == 1) {
        std::lock_guard<std::mutex> lock(mutex);
        finished.notify_all();
      }
      seen = ticket.load(std::memory_order_acquire);
    }
    insidePiece = false;
  }

  void run() {
    std::uint32_t done = 0;
    for (;;) {
      for (int spin = 0; spin < kSpins && newest.load(std::memory_order_acquire) == done; spin++) pauseBriefly();
      Job mine;
      {
        std::unique_lock<std::mutex> lock(mutex);
        started.wait(lock, [&] { return stopping || job.number != done; });
        if (stopping) return;
        mine = job;
      }
      done = mine.number;
      work(mine);
    }
  }
};

WorkerPool::WorkerPool(int threads) : impl_(std::make_unique<Impl>()) {
  BRICKFALL_ASSERT(threads >= 1 && threads <= 64, "1 to 64 threads");
  for (int i = 1; i < std::min(threads, 64); i++) impl_->workers.emplace_back([impl = impl_.get()] { impl->run(); });
}

WorkerPool::WorkerPool(int threads, TaskSystem* host) : WorkerPool(host ? 1 : threads) { host_ = host; }

WorkerPool::~WorkerPool() {
  {
    std::lock_guard<std::mutex> lock(impl_->mutex);
    impl_->stopping = true;
    impl_->newest.fetch_add(1, std::memory_order_release);
  }
  impl_->started.notify_all();
  for (std::thread& worker : impl_->workers) worker.join();
}

int WorkerPool::threads() const { return host_ ? std::clamp(host_->threads(), 1, 64) : int(impl_->workers.size()) + 1; }

void WorkerPool::forRange(int count, int grain, const std::function<void(int begin, int end)>& body) {
  if (count <= 0) return;
  Job job{&body, count, std::max(1, grain), 0, 0};
  job.pieces = std::uint32_t((count - 1) / job.grain + 1);
  if (host_ && job.pieces > 1 && !insidePiece && threads() > 1) {
    host_->forRange(count, job.grain, [&body](int begin, int end) {
      insidePiece = true;
      body(begin, end);
      insidePiece = false;
    });
    return;
  }
  if (impl_->workers.empty() || job.pieces == 1 || insidePiece) {
    for (std::uint32_t piece = 0; piece < job.pieces; piece++) runPiece(job, piece);
    return;
  }
  {
    std::lock_guard<std::mutex> lock(impl_->mutex);
    job.number = impl_->job.number + 1;
    impl_->job = job;
    impl_->left.store(job.pieces, std::memory_order_relaxed);
    impl_->ticket.store(std::uint64_t(job.number) << 32, std::memory_order_release);
    impl_->newest.store(job.number, std::memory_order_release);
  }
  impl_->started.notify_all();
  impl_->work(job);
  for (int spin = 0; spin < kSpins && impl_->left.load(std::memory_order_acquire) != 0; spin++) pauseBriefly();
  std::unique_lock<std::mutex> lock(impl_->mutex);
  impl_->finished.wait(lock, [&] { return impl_->left.load(std::memory_order_acquire) == 0; });
}

}  // namespace brickfall
